// A session from C++: it has nothing to run, and says so. Ends with 0 where the library answers as it should.
#include <cstdio>
#include <cstring>
#include <memory>

#include <bespoke.h>
#if __has_include(<bespoke.hpp>)
#include <bespoke.hpp>

// The same by the header for C++.
static bool refuses() {
    auto session = bespoke::Session::create();
    return session && !session->run();
}
#else
static bool refuses() { return true; }
#endif

struct Destroy {
    void operator()(BespokeSession *session) const { bespoke_session_destroy(session); }
};

int main() {
    BespokeSession *made = nullptr;
    if (bespoke_abi_version() != BESPOKE_ABI_VERSION || bespoke_session_create(&made) != BESPOKE_STATUS_OK) {
        std::fprintf(stderr, "session: no session\n");
        return 1;
    }
    const std::unique_ptr<BespokeSession, Destroy> session(made);
    const BespokeStatus status = bespoke_session_run(session.get());
    char sentence[512] = "";
    bespoke_session_last_message(session.get(), sentence, sizeof sentence, nullptr);
    std::printf("%s: %s\n", bespoke_status_name(status), sentence);
    const bool is_refused = status == BESPOKE_STATUS_INVALID_STATE && std::strstr(sentence, "garment") != nullptr;
    return is_refused && refuses() ? 0 : 1;
}

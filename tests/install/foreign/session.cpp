// A session by the header for C++: it has nothing to run, and says so. Ends with 0 where the library answers as it should.
#include <cstdio>

#include <bespoke.hpp>

int main() {
    auto session = bespoke::Session::create();
    if (!session) {
        std::fprintf(stderr, "session: %s\n", session.message().c_str());
        return 1;
    }
    const auto ran = session->run();
    std::printf("%s: %s\n", bespoke::status_name(ran.status()), ran.message().c_str());
    const bool is_refused = ran.status() == bespoke::Status::invalid_state;
    return is_refused && ran.message().find("garment") != std::string::npos ? 0 : 1;
}

/* Cancel: by the session, a control, a token, std::stop_token and the answer of who watches. */
#include "check.hpp"

#include <chrono>
#include <thread>

namespace {

using namespace bespoke;
using Clock = std::chrono::steady_clock;

// Machines that run tests are busy: far above what is promised, far below a run that is not stopped.
constexpr std::chrono::milliseconds prompt(1000);

/// A scene that takes seconds.
Scene large_scene() {
    Scene scene;
    scene.garment = Tube(0.3, 0.5, 60, 80);
    scene.body = Tube(0.4, 0.9, 30, 40);
    return scene;
}

// Ways to stop a session, each with the run that it stops.

struct BySession {
    Session &session;

    Result<void> run() const { return session.run([](const Progress &) {}); }
    void stop() const { ACCEPTED(session.cancel()); }
};

struct ByControl {
    Session &session;
    Control control = session.create_control().value();

    Result<void> run() const { return session.run(); }
    void stop() const { ACCEPTED(control.cancel()); }
};

struct ByToken {
    Session &session;
    StopSource source{};

    Result<void> run() const { return session.run(source.get_token()); }
    void stop() const {
        CHECK(!source.get_token().stop_requested());
        CHECK(source.request_stop() && !source.request_stop());
        CHECK(source.stop_requested() && source.get_token().stop_requested());
    }
};

#ifdef __cpp_lib_jthread
struct ByStandardToken {
    Session &session;
    std::stop_source source{};

    Result<void> run() const { return session.run(source.get_token(), [](const Progress &) {}); }
    void stop() { CHECK(source.request_stop()); }
};
#endif

/// Another thread stops a run promptly once it has come to this stage; SETUP stands for the middle of prepare.
template <class Way> void stopped(Session &session, Stage stage) {
    const Control control = session.create_control().value();
    const Stage expected = stage == Stage::setup ? Stage::setup : Stage::cancelled;
    for (int tries = 0; tries < 20; tries++) {
        Way way{session};
        Clock::time_point asked;
        std::thread other([&] {
            while (control.read_progress()->stage < stage) std::this_thread::yield();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            asked = Clock::now();
            way.stop();
        });
        const Result<void> outcome = way.run();
        const auto returned = Clock::now();
        other.join();
        REFUSED(outcome, Status::cancelled, "cancelled");
        CHECK(returned - asked < prompt);
        const Stage end = session.read_progress()->stage;
        // The request stays until reset.
        CHECK(!session.run());
        ACCEPTED(session.reset());
        if (end == expected) return;
        // On a busy machine the other thread may come when prepare is over.
        CHECK(end == Stage::cancelled);
    }
    CHECK(false);
}

void by_other_threads() {
    Session session = session_with(large_scene());
    for (const Stage stage : {Stage::setup, Stage::inflate}) {
        stopped<BySession>(session, stage);
        stopped<ByControl>(session, stage);
        stopped<ByToken>(session, stage);
#ifdef __cpp_lib_jthread
        stopped<ByStandardToken>(session, stage);
#endif
    }
#ifdef __cpp_lib_jthread
    // A thread that brings its own token.
    std::jthread thread([&](std::stop_token token) { REFUSED(session.run(token), Status::cancelled, "cancelled"); });
    while (session.read_progress()->stage < Stage::inflate) std::this_thread::yield();
    thread.request_stop();
    thread.join();
#endif
}

/// One source for several sessions; who comes late is stopped at the beginning.
void one_source_for_all() {
    const Scene scene = large_scene();
    StopSource source;
    const StopToken token = source.get_token();
    std::vector<std::thread> threads;
    std::atomic<int> running{0};
    for (int k = 0; k < 2; k++) {
        threads.emplace_back([&] {
            Session session = session_with(scene);
            bool is_counted = false;
            REFUSED(session.run(token,
                                [&](const Progress &progress) {
                                    if (progress.stage == Stage::inflate && !is_counted) {
                                        is_counted = true;
                                        running++;
                                    }
                                }),
                    Status::cancelled, "cancelled");
        });
    }
    while (running < 2) std::this_thread::yield();
    StopSource copy = source;
    CHECK(copy.request_stop() && source.stop_requested() && !source.request_stop());
    for (std::thread &thread : threads) thread.join();
    Session late = session_with(scene);
    REFUSED(late.run(token), Status::cancelled, "cancelled");
    CHECK(late.read_progress()->stage == Stage::setup);
    // The token of no source never stops, and a source that was moved from does nothing.
    CHECK(!StopToken().stop_requested());
    const StopSource moved = std::move(source);
    CHECK(moved.stop_requested() && !source.stop_requested() && !source.request_stop());
    CHECK(!source.get_token().stop_requested());
}

/// A session that ran with a token is not touched by a request that comes later.
void a_late_request() {
    const Scene scene;
    Session session = session_with(scene);
    StopSource source;
    ACCEPTED(session.run(source.get_token(), [](const Progress &) { return true; }));
    CHECK(source.request_stop());
    ACCEPTED(session.verify());
}

/// Any other token, which can only be looked at.
struct Counter {
    int *left;
    bool stop_requested() const { return --*left < 0; }
};

void by_looking() {
    const Scene scene = large_scene();
    Session session = session_with(scene);
    int left = 3;
    REFUSED(session.run(Counter{&left}), Status::cancelled, "cancelled");
    CHECK(left == -1 && session.read_progress()->stage == Stage::cancelled);
    CHECK(session.read_garment_vertices()->size() == scene.garment.points.size());

    ACCEPTED(session.reset());
    int calls = 0;
    REFUSED(session.run([&](const Progress &) { return ++calls < 3; }), Status::cancelled, "cancelled");
    CHECK(calls == 3 && session.read_progress()->stage == Stage::cancelled);

    // At the beginning, before prepare.
    ACCEPTED(session.reset());
    REFUSED(session.run([](const Progress &) { return false; }), Status::cancelled, "cancelled");
    CHECK(session.read_progress()->stage == Stage::setup);
    // A "no" that comes with DONE is too late.
    Session quick = session_with(Scene());
    ACCEPTED(quick.run([](const Progress &progress) { return progress.stage != Stage::done; }));
    ACCEPTED(quick.verify());
}

/// A control outlives its session, and knows its last moment.
void controls() {
    Session session = session_with(Scene());
    const Control control = session.create_control().value();
    CHECK(control.read_progress()->stage == Stage::setup);
    ACCEPTED(session.run());
    ACCEPTED(session.destroy());
    CHECK(control.read_progress()->stage == Stage::done && control.read_progress()->t == 1.0);
    ACCEPTED(control.cancel());
}

#ifdef __cpp_exceptions
/// Who watches may throw: it comes out of run, and the session can go on.
void a_throwing_watcher() {
    Session session = session_with(Scene());
    StopSource source;
    bool is_caught = false;
    try {
        static_cast<void>(session.run(source.get_token(), [](const Progress &progress) {
            if (progress.stage != Stage::setup) throw 7;
        }));
    } catch (const int thrown) {
        is_caught = thrown == 7;
    }
    // The source no longer knows the session.
    CHECK(is_caught && source.request_stop());
    ACCEPTED(session.run());
}
#endif

} // namespace

void stops() {
    by_other_threads();
    one_source_for_all();
    a_late_request();
    by_looking();
    controls();
#ifdef __cpp_exceptions
    a_throwing_watcher();
#endif
}

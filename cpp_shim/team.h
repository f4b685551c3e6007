// Threads for the parallel loops of OpenVDB that are our own, so that oneTBB starts none.
//
// A thread that TBB cannot start is an exception out of whatever loop asked for it, or, in one of its workers, the end of
// the process; and its workers stay until the process ends. So the loops run in an arena in which every place is
// reserved: TBB has no worker to ask for. The caller has one place, helpers that end with the work have the others.
#ifndef BESPOKE_CPP_SHIM_TEAM_H
#define BESPOKE_CPP_SHIM_TEAM_H

#include <algorithm>
#include <list>
#include <system_error>
#include <thread>

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

class Team {
public:
    // The caller and up to `threads - 1` helpers; fewer where a thread cannot be started.
    explicit Team(unsigned threads)
        : places_(static_cast<int>(std::clamp(threads, 1u, MOST))), arena_(places_, static_cast<unsigned>(places_)) {}

    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    // Runs `work` in the calling thread; its parallel loops are shared with the helpers. What it throws comes out.
    template <class Work>
    void run(const Work& work) {
        arena_.execute([&] {
            Helpers helpers;
            for (int place = 1; place < places_ && helpers.add(arena_); ++place) {}
            work();
        });
    }

private:
    static constexpr unsigned MOST = 256;

    // In the arena a helper waits for a task that never runs, and does meanwhile what it finds there.
    struct Helper {
        tbb::task_group wait;
        tbb::task_handle held = wait.defer([] {});
        std::thread thread;
    };

    class Helpers {
    public:
        // Whether one more could be started.
        bool add(tbb::task_arena& arena) {
            Helper& helper = helpers_.emplace_back();
            try {
                helper.thread = std::thread([&arena, &helper] { help(arena, helper); });
                return true;
            } catch (const std::system_error&) {
                release(helper);
                helpers_.pop_back();
                return false;
            }
        }

        ~Helpers() {
            for (Helper& helper : helpers_) {
                release(helper);
            }
            for (Helper& helper : helpers_) {
                if (helper.thread.joinable()) {
                    helper.thread.join();
                }
            }
        }

    private:
        static void help(tbb::task_arena& arena, Helper& helper) noexcept {
            try {
                arena.execute([&helper] { helper.wait.wait(); });
            } catch (...) {
                // One helper fewer: what a loop throws is its caller's, and does not come here.
            }
        }

        static void release(Helper& helper) { helper.held = tbb::task_handle(); }

        // A helper stays where it is: its thread and its task point to it.
        std::list<Helper> helpers_;
    };

    int places_;
    tbb::task_arena arena_;
};

#endif

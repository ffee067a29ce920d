// Threads, all of them: a pool that runs jobs off the main thread and a parallel_for for bakers. A job's
// exception becomes its result. Results are collected on the main thread by poll(); nothing else is shared.
#pragma once

#include "renderer/ibl/bake.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace patina {

/// What a running job may say; safe to call from its thread and from those of its parallel_for.
struct JobContext {
    std::stop_token stop;
    std::function<void(float fraction)> progress;  ///< 0…1; only ever grows
};

class Jobs {
public:
    /// wake is called from a worker whenever there is something new to poll (progress or a result); at most
    /// every few hundredths of a second for progress.
    explicit Jobs(
        int threads, std::function<void()> wake = [] {});
    ~Jobs();
    /// Stops all jobs, waits for them and drops their results; nothing is started afterwards. For whoever
    /// owns what the jobs refer to; the destructor does it as well.
    void end();
    Jobs(const Jobs&) = delete;
    Jobs& operator=(const Jobs&) = delete;

    using Id = std::uint64_t;  ///< 0 is never given out
    /// What work returns is done on the main thread, by poll().
    using Done = std::function<void()>;
    using Work = std::function<Done(JobContext&)>;

    /// work runs on a worker; failed gets one sentence, on the main thread, if it or its main-thread part
    /// threw. All three closures are destroyed on the main thread, so they may hold handles that live there.
    /// A job without a label is not listed by running().
    Id start(std::string label, Work work, std::function<void(const std::string& error)> failed = {});
    void stop(Id id);              ///< asks it to end; its result and its failure are dropped
    bool is_running(Id id) const;  ///< until poll() has run its main-thread part, or stop()
    bool idle() const;             ///< nothing queued, running or waiting for poll(), stopped jobs included
    /// Runs the finished jobs' main-thread parts, in the order they finished. True if any ran.
    bool poll();

    struct Status {
        Id id = 0;
        std::string label;
        float progress = 0.0f;  ///< 0…1
        bool started = false;   ///< false: waits for a free worker
        bool operator==(const Status&) const = default;
    };
    std::vector<Status> running() const;

    /// Spreads over the workers, the caller included; nested calls run serially. If bodies throw, the one
    /// with the lowest index is rethrown to the caller, the rest not begun. Outlives the pool (serially).
    ParallelFor parallel_for() const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

/// work goes on beside, on a thread of its own. What is returned waits for it and rethrows what it threw.
std::function<void()> begin_beside(std::function<void()> work);

/// As many workers as the machine has cores.
int worker_count();

}  // namespace patina

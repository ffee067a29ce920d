// Threads, all of them: a pool that runs jobs off the main thread and a parallel_for for bakers. A job's exception becomes
// its result. Results are collected on the main thread by poll(); nothing else is shared.
#pragma once

#include "renderer/ibl/bake.h"

#include <functional>
#include <memory>
#include <stop_token>
#include <string>

namespace patina {

/// What a running job may say; safe to call from its thread.
struct JobContext {
    std::stop_token stop;
    std::function<void(float fraction)> progress;
};

class Jobs {
public:
    /// wake is called from a worker whenever there is something new to poll (progress or a result).
    explicit Jobs(int threads, std::function<void()> wake = [] {});
    ~Jobs();                                  ///< stops all jobs and waits for them
    Jobs(const Jobs&) = delete;
    Jobs& operator=(const Jobs&) = delete;

    using Id = std::uint64_t;
    /// work runs on a worker and returns what is to be done on the main thread; failed gets one sentence if it threw.
    Id start(std::string label, std::function<std::function<void()>(JobContext&)> work,
             std::function<void(const std::string& error)> failed);
    void stop(Id id);                         ///< asks it to end; its result is dropped
    bool is_running(Id id) const;
    /// Runs the finished jobs' main-thread parts. True if any ran.
    bool poll();

    struct Status {
        Id id = 0;
        std::string label;
        float progress = 0.0f;                ///< 0…1
    };
    std::vector<Status> running() const;

    /// Spreads over all cores, the caller included; nested calls run serially.
    ParallelFor parallel_for() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace patina

#include "app/jobs.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <future>
#include <limits>
#include <mutex>
#include <thread>

namespace patina {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::int64_t kProgressWakeNs = 40'000'000;

/// One parallel_for in flight. Indices are handed out by next; whoever works on it is counted by helpers
/// (under the pool's mutex), so that body outlives every use of it.
struct Loop {
    int count = 0;
    const std::function<void(int)>* body = nullptr;
    std::atomic<int> next{0};
    int helpers = 0;
    int error_index = std::numeric_limits<int>::max();
    std::exception_ptr error;
};

/// True while this thread runs a body of some parallel_for.
thread_local bool in_loop = false;

struct Job {
    Jobs::Id id = 0;
    std::string label;
    Jobs::Work work;
    std::function<void(const std::string&)> failed;
    std::stop_source stop;
    std::atomic<float> progress{0.0f};
    bool started = false;
    Jobs::Done done;
    std::string error;
    bool threw = false;
};

std::string sentence_of(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const std::exception& e) {
        return e.what();
    } catch (...) {
        return "an unknown error";
    }
}

}  // namespace

struct Jobs::State {
    mutable std::mutex mutex;
    std::condition_variable work_or_end;  ///< for workers
    std::condition_variable loop_left;    ///< for callers of parallel_for
    std::deque<std::shared_ptr<Job>> queued;
    std::vector<std::shared_ptr<Job>> active;
    std::vector<std::shared_ptr<Job>> finished;
    std::vector<Loop*> loops;          ///< each lives on its caller's stack
    std::atomic<int> waiting_jobs{0};  ///< queued.size(), readable without the mutex
    Id next_id = 1;
    bool ending = false;
    std::function<void()> wake;
    std::atomic<std::int64_t> last_progress_wake_ns{0};
    std::vector<std::thread> workers;

    void run_worker();
    void run_job(std::shared_ptr<Job> job);
    void help(Loop& loop);
    void run_loop(int count, const std::function<void(int)>& body);
    void report_progress(Job& job, float fraction);
    bool take_indices(Loop& loop, bool give_way);
};

/// Runs bodies until none is left (true) or, with give_way, until a job waits for a worker (false).
bool Jobs::State::take_indices(Loop& loop, bool give_way) {
    in_loop = true;
    bool drained = true;
    for (;;) {
        if (give_way && waiting_jobs.load(std::memory_order_relaxed) > 0) {
            drained = false;
            break;
        }
        const int index = loop.next.fetch_add(1, std::memory_order_relaxed);
        if (index >= loop.count) break;
        std::exception_ptr error;
        try {
            (*loop.body)(index);
        } catch (...) {
            error = std::current_exception();
        }
        if (!error) continue;
        loop.next.store(loop.count, std::memory_order_relaxed);
        const std::lock_guard lock(mutex);
        if (index < loop.error_index) {
            loop.error_index = index;
            loop.error = std::move(error);
        }
    }
    in_loop = false;
    return drained;
}

void Jobs::State::help(Loop& loop) {
    take_indices(loop, true);
    const std::lock_guard lock(mutex);
    if (--loop.helpers == 0) loop_left.notify_all();
}

void Jobs::State::run_loop(int count, const std::function<void(int)>& body) {
    if (in_loop || count <= 1 || workers.empty()) {
        for (int i = 0; i < count; ++i) body(i);
        return;
    }
    Loop loop;
    loop.count = count;
    loop.body = &body;
    {
        const std::lock_guard lock(mutex);
        loops.push_back(&loop);
    }
    work_or_end.notify_all();
    take_indices(loop, false);
    std::unique_lock lock(mutex);
    std::erase(loops, &loop);
    loop_left.wait(lock, [&] { return loop.helpers == 0; });
    lock.unlock();
    if (loop.error) std::rethrow_exception(std::move(loop.error));
}

void Jobs::State::report_progress(Job& job, float fraction) {
    const float wanted = std::clamp(fraction, 0.0f, 1.0f);
    float seen = job.progress.load(std::memory_order_relaxed);
    while (wanted > seen && !job.progress.compare_exchange_weak(seen, wanted, std::memory_order_relaxed)) {
    }
    const std::int64_t now = Clock::now().time_since_epoch().count();
    std::int64_t last = last_progress_wake_ns.load(std::memory_order_relaxed);
    if (now - last < kProgressWakeNs) return;
    if (last_progress_wake_ns.compare_exchange_strong(last, now, std::memory_order_relaxed)) wake();
}

void Jobs::State::run_job(std::shared_ptr<Job> job) {
    JobContext context{job->stop.get_token(),
                       [this, job = job.get()](float fraction) { report_progress(*job, fraction); }};
    try {
        if (!job->stop.stop_requested()) job->done = job->work(context);
    } catch (...) {
        job->threw = true;
        job->error = sentence_of(std::current_exception());
    }
    {
        const std::lock_guard lock(mutex);
        std::erase(active, job);
        finished.push_back(std::move(job));  // the only reference: its closures die on the main thread
    }
    wake();
}

void Jobs::State::run_worker() {
    std::unique_lock lock(mutex);
    for (;;) {
        Loop* loop = nullptr;
        const auto find_loop = [&] {
            const auto open = std::find_if(loops.begin(), loops.end(), [](const Loop* candidate) {
                return candidate->next.load(std::memory_order_relaxed) < candidate->count;
            });
            loop = open == loops.end() ? nullptr : *open;
            return loop != nullptr;
        };
        work_or_end.wait(lock, [&] { return ending || !queued.empty() || find_loop(); });
        if (ending) return;
        if (!queued.empty()) {
            std::shared_ptr<Job> job = queued.front();
            queued.pop_front();
            waiting_jobs.store(static_cast<int>(queued.size()), std::memory_order_relaxed);
            job->started = true;
            active.push_back(job);
            lock.unlock();
            run_job(std::move(job));
            lock.lock();
        } else {
            ++loop->helpers;
            lock.unlock();
            help(*loop);
            lock.lock();
        }
    }
}

Jobs::Jobs(int threads, std::function<void()> wake) : state_(std::make_shared<State>()) {
    state_->wake = std::move(wake);
    for (int i = 0; i < std::max(threads, 1); ++i)
        state_->workers.emplace_back([state = state_.get()] { state->run_worker(); });
}

Jobs::~Jobs() { end(); }

void Jobs::end() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->ending = true;
        for (const auto& job : state_->active) job->stop.request_stop();
    }
    state_->work_or_end.notify_all();
    for (std::thread& worker : state_->workers) worker.join();
    std::deque<std::shared_ptr<Job>> queued;
    std::vector<std::shared_ptr<Job>> finished;
    const std::lock_guard lock(state_->mutex);
    state_->workers.clear();
    queued.swap(state_->queued);
    finished.swap(state_->finished);
    state_->waiting_jobs = 0;
}

Jobs::Id Jobs::start(std::string label, Work work, std::function<void(const std::string&)> failed) {
    const auto job = std::make_shared<Job>();
    job->label = std::move(label);
    job->work = std::move(work);
    job->failed = std::move(failed);
    {
        const std::lock_guard lock(state_->mutex);
        job->id = state_->next_id++;
        if (state_->ending) return job->id;
        state_->queued.push_back(job);
        state_->waiting_jobs.store(static_cast<int>(state_->queued.size()), std::memory_order_relaxed);
    }
    state_->work_or_end.notify_one();
    return job->id;
}

void Jobs::stop(Id id) {
    std::shared_ptr<Job> dropped;  // destroyed after the lock is given up: its closures may call back
    const std::lock_guard lock(state_->mutex);
    for (const auto& job : state_->active)
        if (job->id == id) job->stop.request_stop();
    for (const auto& job : state_->finished)
        if (job->id == id) job->stop.request_stop();
    const auto waiting = std::find_if(state_->queued.begin(), state_->queued.end(),
                                      [id](const auto& job) { return job->id == id; });
    if (waiting == state_->queued.end()) return;
    dropped = *waiting;
    state_->queued.erase(waiting);
    state_->waiting_jobs.store(static_cast<int>(state_->queued.size()), std::memory_order_relaxed);
}

bool Jobs::is_running(Id id) const {
    const std::lock_guard lock(state_->mutex);
    const auto is_it = [id](const auto& job) { return job->id == id && !job->stop.stop_requested(); };
    return std::any_of(state_->queued.begin(), state_->queued.end(), is_it) ||
           std::any_of(state_->active.begin(), state_->active.end(), is_it) ||
           std::any_of(state_->finished.begin(), state_->finished.end(), is_it);
}

bool Jobs::idle() const {
    const std::lock_guard lock(state_->mutex);
    return state_->queued.empty() && state_->active.empty() && state_->finished.empty();
}

bool Jobs::poll() {
    std::vector<std::shared_ptr<Job>> finished;
    {
        const std::lock_guard lock(state_->mutex);
        finished.swap(state_->finished);
    }
    bool any = false;
    for (const auto& job : finished) {
        if (job->stop.stop_requested()) continue;  // also when a part that ran just now stopped it
        any = true;
        try {
            if (!job->threw && job->done) job->done();
        } catch (...) {
            job->threw = true;
            job->error = sentence_of(std::current_exception());
        }
        if (job->threw && job->failed) job->failed(job->error);
    }
    return any;
}

std::vector<Jobs::Status> Jobs::running() const {
    const std::lock_guard lock(state_->mutex);
    std::vector<Status> list;
    const auto add = [&](const Job& job) {
        if (!job.label.empty() && !job.stop.stop_requested())
            list.push_back({job.id, job.label, job.progress.load(std::memory_order_relaxed), job.started});
    };
    for (const auto& job : state_->active) add(*job);
    for (const auto& job : state_->queued) add(*job);
    return list;
}

ParallelFor Jobs::parallel_for() const {
    return
        [state = state_](int count, const std::function<void(int)>& body) { state->run_loop(count, body); };
}

std::function<void()> begin_beside(std::function<void()> work) {
    return [done = std::async(std::launch::async, std::move(work)).share()] { done.get(); };
}

int worker_count() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

}  // namespace patina

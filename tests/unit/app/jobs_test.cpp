#include "app/jobs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <numeric>
#include <stdexcept>
#include <thread>

namespace {

using patina::JobContext;
using patina::Jobs;
using namespace std::chrono_literals;

template <class Condition>
bool within(std::chrono::milliseconds limit, Condition condition) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(1ms);
    }
    return true;
}

void poll_until_idle(Jobs& jobs) {
    ASSERT_TRUE(within(20s, [&] {
        jobs.poll();
        return jobs.idle();
    }));
}

TEST(Jobs, run_the_second_part_on_the_polling_thread) {
    Jobs jobs(2);
    std::thread::id worked, done;
    jobs.start("a job", [&](JobContext&) {
        worked = std::this_thread::get_id();
        return [&] { done = std::this_thread::get_id(); };
    });
    poll_until_idle(jobs);
    EXPECT_NE(worked, std::this_thread::get_id());
    EXPECT_EQ(done, std::this_thread::get_id());
}

TEST(Jobs, hand_over_what_was_thrown_as_a_sentence) {
    Jobs jobs(1);
    std::string error;
    bool done = false;
    jobs.start(
        "a job", [&](JobContext&) -> Jobs::Done { throw std::runtime_error("sky.hdr: truncated."); },
        [&](const std::string& e) { error = e; });
    poll_until_idle(jobs);
    EXPECT_EQ(error, "sky.hdr: truncated.");

    jobs.start(
        "a job",
        [&](JobContext&) {
            return [&] {
                done = true;
                throw std::runtime_error("no texture memory left.");
            };
        },
        [&](const std::string& e) { error = e; });
    poll_until_idle(jobs);
    EXPECT_TRUE(done);
    EXPECT_EQ(error, "no texture memory left.");

    jobs.start(
        "a job", [&](JobContext&) -> Jobs::Done { throw 7; }, [&](const std::string& e) { error = e; });
    poll_until_idle(jobs);
    EXPECT_EQ(error, "an unknown error");
}

TEST(Jobs, drop_the_result_of_a_stopped_job_and_tell_the_job_to_end) {
    Jobs jobs(1);
    std::atomic<bool> entered = false;
    bool done = false, failed = false;
    const Jobs::Id id = jobs.start(
        "slow",
        [&](JobContext& job) -> Jobs::Done {
            entered = true;
            while (!job.stop.stop_requested()) std::this_thread::sleep_for(1ms);
            return [&] { done = true; };
        },
        [&](const std::string&) { failed = true; });
    ASSERT_TRUE(within(5s, [&] { return entered.load(); }));
    EXPECT_TRUE(jobs.is_running(id));
    jobs.stop(id);
    EXPECT_FALSE(jobs.is_running(id));
    EXPECT_TRUE(jobs.running().empty());
    poll_until_idle(jobs);
    EXPECT_FALSE(done);
    EXPECT_FALSE(failed);
}

TEST(Jobs, never_begin_a_job_that_was_stopped_while_it_waited) {
    Jobs jobs(1);
    std::atomic<bool> release = false, ran = false;
    jobs.start("first", [&](JobContext&) -> Jobs::Done {
        while (!release) std::this_thread::sleep_for(1ms);
        return {};
    });
    const Jobs::Id second = jobs.start("second", [&](JobContext&) -> Jobs::Done {
        ran = true;
        return {};
    });
    EXPECT_TRUE(jobs.is_running(second));
    jobs.stop(second);
    release = true;
    poll_until_idle(jobs);
    EXPECT_FALSE(ran);
}

TEST(Jobs, drop_a_finished_result_that_is_stopped_before_it_is_polled) {
    Jobs jobs(1);
    bool done = false;
    std::atomic<bool> worked = false;
    const Jobs::Id id = jobs.start("job", [&](JobContext&) {
        worked = true;
        return [&] { done = true; };
    });
    ASSERT_TRUE(within(5s, [&] { return worked.load(); }));
    jobs.stop(id);
    poll_until_idle(jobs);
    EXPECT_FALSE(done);
}

TEST(Jobs, report_label_and_growing_progress_and_hide_unlabelled_ones) {
    std::atomic<int> wakes = 0;
    Jobs jobs(2, [&] { ++wakes; });
    std::atomic<bool> release = false;
    const auto wait_for_release = [&](JobContext& job) -> Jobs::Done {
        job.progress(0.4f);
        job.progress(0.2f);
        while (!release) std::this_thread::sleep_for(1ms);
        return {};
    };
    jobs.start("baking studio", wait_for_release);
    jobs.start("", wait_for_release);
    EXPECT_TRUE(within(5s, [&] { return jobs.running().size() == 1 && jobs.running()[0].progress == 0.4f; }));
    EXPECT_EQ(jobs.running()[0].label, "baking studio");
    EXPECT_TRUE(jobs.running()[0].started);
    EXPECT_GE(wakes.load(), 1);
    release = true;
    poll_until_idle(jobs);
    EXPECT_GE(wakes.load(), 3);
}

TEST(Jobs, destroy_their_closures_on_the_thread_that_polls) {
    struct Marker {
        std::thread::id* where;
        explicit Marker(std::thread::id* w) : where(w) {}
        Marker(const Marker&) = delete;
        Marker& operator=(const Marker&) = delete;
        ~Marker() { *where = std::this_thread::get_id(); }
    };
    for (int round = 0; round < 200; ++round) {
        std::thread::id destroyed;
        Jobs jobs(2);
        const auto id =
            jobs.start("job", [marker = std::make_shared<Marker>(&destroyed)](JobContext&) -> Jobs::Done {
                return [marker] {};
            });
        if (round % 2 == 0) jobs.stop(id);
        poll_until_idle(jobs);
        ASSERT_EQ(destroyed, std::this_thread::get_id());
    }
}

TEST(Jobs, end_at_once_with_running_and_waiting_jobs) {
    std::atomic<int> ran = 0;
    {
        Jobs jobs(2);
        for (int i = 0; i < 10; ++i)
            jobs.start("job", [&](JobContext& job) -> Jobs::Done {
                ++ran;
                while (!job.stop.stop_requested()) std::this_thread::sleep_for(1ms);
                return {};
            });
        ASSERT_TRUE(within(5s, [&] { return ran == 2; }));
    }
    EXPECT_EQ(ran, 2);
}

TEST(ParallelFor, runs_every_index_exactly_once_on_several_threads) {
    Jobs jobs(3);
    std::vector<std::atomic<int>> counts(5000);
    std::atomic<int> threads_seen = 0;
    thread_local bool counted = false;
    jobs.parallel_for()(5000, [&](int i) {
        if (!counted) {
            counted = true;
            ++threads_seen;
            std::this_thread::sleep_for(2ms);
        }
        ++counts[i];
    });
    for (const auto& count : counts) ASSERT_EQ(count, 1);
    EXPECT_GE(threads_seen.load(), 2);
}

TEST(ParallelFor, works_inside_jobs_and_nested_without_deadlock) {
    Jobs jobs(2);
    const auto parallel_for = jobs.parallel_for();
    std::atomic<int> total = 0;
    for (int j = 0; j < 8; ++j)
        jobs.start("job", [&](JobContext&) -> Jobs::Done {
            parallel_for(20, [&](int) { parallel_for(30, [&](int) { ++total; }); });
            return {};
        });
    parallel_for(20, [&](int) { parallel_for(30, [&](int) { ++total; }); });
    poll_until_idle(jobs);
    EXPECT_EQ(total, 9 * 600);
}

TEST(ParallelFor, rethrows_the_failure_with_the_lowest_index) {
    Jobs jobs(4);
    for (int round = 0; round < 50; ++round) {
        try {
            jobs.parallel_for()(1000, [](int i) {
                if (i >= 300) throw std::runtime_error(std::to_string(i));
            });
            FAIL() << "nothing was thrown";
        } catch (const std::runtime_error& e) {
            EXPECT_STREQ(e.what(), "300");
        }
    }
}

TEST(ParallelFor, serves_no_indices_and_outlives_its_pool) {
    patina::ParallelFor parallel_for;
    {
        Jobs jobs(2);
        parallel_for = jobs.parallel_for();
        parallel_for(0, [](int) { FAIL(); });
    }
    int sum = 0;
    parallel_for(10, [&](int i) { sum += i; });
    EXPECT_EQ(sum, 45);
}

TEST(ParallelFor, lets_a_waiting_job_in_before_it_is_finished) {
    Jobs jobs(2);
    std::atomic<bool> other_done = false, in_time = false;
    jobs.start("long", [&, parallel_for = jobs.parallel_for()](JobContext&) -> Jobs::Done {
        parallel_for(400, [&](int) { std::this_thread::sleep_for(5ms); });
        in_time = other_done.load();
        return {};
    });
    std::this_thread::sleep_for(50ms);
    jobs.start("short", [&](JobContext&) -> Jobs::Done {
        other_done = true;
        return {};
    });
    poll_until_idle(jobs);
    EXPECT_TRUE(in_time);
}

TEST(Jobs, use_no_processor_time_while_they_wait) {
    Jobs jobs(4);
    jobs.parallel_for()(100, [](int) {});
    const std::clock_t before = std::clock();
    std::this_thread::sleep_for(300ms);
    EXPECT_LT(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC, 0.02);
}

}  // namespace

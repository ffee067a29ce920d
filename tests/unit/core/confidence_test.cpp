#include "renderer/core/confidence.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace patina {
namespace {

TEST(Confidence, knows_student_s_table) {
    EXPECT_NEAR(student_t95(2), 12.706, 1e-3);
    EXPECT_NEAR(student_t95(8), 2.3646, 1e-3);
    EXPECT_NEAR(student_t95(61), 2.0003, 1e-3);
    EXPECT_NEAR(student_t95(100000), 1.96, 1e-3);
}

TEST(Confidence, covers_the_truth_95_times_in_100) {
    std::mt19937 random(3);
    std::normal_distribution<float> noise(10.0f, 1.0f);
    int covered = 0;
    constexpr int trials = 2000;
    for (int i = 0; i < trials; ++i) {
        float values[8], sum = 0.0f;
        for (float& each : values) sum += each = noise(random);
        const double mean = double(sum) / 8;
        covered += std::abs(mean - 10.0) <= confidence_of(half_widths_of(values, 8)).max * mean;
    }
    EXPECT_NEAR(covered / double(trials), 0.95, 0.015);
}

TEST(Confidence, is_relative_and_leaves_out_what_was_never_drawn) {
    // Two pictures of three pixels: known exactly, within 10 %, never drawn.
    const std::vector<float> values{4.0f, 9.0f, 0.0f, 4.0f, 11.0f, 0.0f};
    const ConfidenceInterval known = confidence_of(half_widths_of(values, 2));
    EXPECT_NEAR(known.max, 12.706 * 1.0 / 10.0, 1e-3);
    EXPECT_NEAR(known.median, 0.0, 1e-9);
    EXPECT_EQ(confidence_of(half_widths_of(std::vector<float>(4, 0.0f), 2)).max, 0.0);
}

}  // namespace
}  // namespace patina

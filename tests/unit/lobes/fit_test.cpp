// The fit of the lobes and the judge of their table, on small environments that the fit never saw.
#include "renderer/lobes/fit_environments.h"
#include "renderer/lobes/fit_judge.h"
#include "renderer/lobes/fit_solve.h"
#include "renderer/lobes/fit_truth.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace patina::lobes {
namespace {

Environment built_in(std::string_view id, int width) {
    for (const BuiltinEnvironment& environment : builtin_environments())
        if (environment.id == id) return environment.make(width);
    return {};
}

const FitLight& unseen_light() {
    static const FitLight light = make_fit_light({built_in("sky", 256), built_in("sunset", 256)}, 128);
    return light;
}

TEST(LobeTruth, weights_sum_to_the_albedo_and_constant_light_comes_back_constant) {
    const BrdfTable table = bake_brdf_table(16);
    for (const int x : {3, 8, 15}) {
        for (const int y : {4, 10, 15}) {
            const double NoV = (x + 0.5) * (x + 0.5) / 256.0, roughness = (y + 0.5) / 16.0;
            const Lobe lobe = sample_lobe(NoV, roughness * roughness, 4096);
            const glm::vec2 ab = table.ab[y * 16 + x];
            EXPECT_NEAR(lobe.Ess, ab.x + ab.y, 2e-3) << NoV << " " << roughness;
            EXPECT_NEAR(lobe.B, ab.y, 2e-3) << NoV << " " << roughness;
        }
    }
    const FitLight furnace = make_fit_light({built_in("furnace", 64)}, 16);
    const Lobe lobe = sample_lobe(0.4, 0.1, 256);
    const LobeSums sums = sum_lobe(lobe, furnace, spread_frames(3)[1]);
    EXPECT_NEAR(sums.plain[0], lobe.Ess, 1e-4);
    EXPECT_NEAR(lobe_radiance(furnace, lobe_at(lobe_nodes(), 0.4f, 0.3f, 0.5f).four, true,
                              {{0, 1, 0}, {0, 0, 1}, 0.3f})[0],
                1.0f, 1e-4f);
}

TEST(LobeTruth, reflects_a_light_as_the_samples_do) {
    // The density of the sampled lobe around a direction is what the closed form says.
    const double NoV = 0.5, alpha = 0.3;
    const glm::dvec3 towards = glm::normalize(glm::dvec3(-0.7, 0.1, 0.6));
    const Lobe lobe = sample_lobe(NoV, alpha, 400000);
    const double cosine = std::cos(0.05);
    double sampled = 0.0;
    for (const LobeSample& sample : lobe.samples)
        if (glm::dot(glm::dvec3(sample.L), towards) > cosine) sampled += sample.weight;
    const double area = 2.0 * std::numbers::pi * (1.0 - cosine);
    EXPECT_NEAR(sampled / area / reflection(NoV, towards, alpha * alpha).plain, 1.0, 0.02);
}

TEST(LobeTable, is_nearer_to_the_integral_than_split_sum_in_light_it_was_not_fitted_to) {
    JudgeSettings settings;
    settings.roughness = {0.3f, 0.6f};
    settings.pixels = 80;
    settings.truth_samples = 1024;
    for (const Judgement& row : judge(unseen_light(), lobe_nodes(), settings)) {
        const double split = row.rms[0], two = row.rms[1], four = row.rms[2];
        EXPECT_LT(two, 0.6 * split) << row.roughness << " " << row.reflectance;
        EXPECT_LT(four, 0.8 * two) << row.roughness << " " << row.reflectance;
    }
}

TEST(LobeTable, errs_by_no_more_than_was_reached_in_environments_like_those_it_was_fitted_to) {
    // Softboxes, sky, lamps of all sizes, strip lights: kinds of the fit set, numbers that are not in it.
    std::vector<Environment> set;
    for (const int number : {18, 20, 21, 23}) {
        ASSERT_GE(number, kFitEnvironments);
        set.push_back(make_fit_environment(number, 512));
    }
    JudgeSettings settings;
    settings.roughness = {0.13f, 0.2f, 0.35f};
    settings.pixels = 120;
    settings.truth_samples = 1024;
    std::array<double, kMethods> mean[2] = {};
    for (const Judgement& row : judge(make_fit_light(set, 256), lobe_nodes(), settings))
        for (int m = 0; m < kMethods; ++m)
            mean[row.reflectance == 1.0f ? 0 : 1][m] += row.rms[m] / double(settings.roughness.size());
    EXPECT_LT(mean[0][1], 0.155);
    EXPECT_LT(mean[0][2], 0.115);
    EXPECT_LT(mean[1][1], 0.030);
    EXPECT_LT(mean[1][2], 0.022);
}

TEST(SlowLobeFit, of_a_few_environments_already_halves_the_error_of_split_sum) {
    std::vector<Environment> set;
    for (int number = 0; number < 4; ++number) set.push_back(make_fit_environment(number, 256));
    FitSettings settings;
    settings.frames = 24;
    settings.truth_samples = 256;
    settings.passes = 8;
    const std::vector<LobePair> nodes = fit_lobes(make_fit_light(set, 64), settings);
    ASSERT_EQ(nodes.size(), lobe_nodes().size());
    JudgeSettings judging;
    judging.roughness = {0.35f, 0.6f};
    judging.pixels = 80;
    judging.truth_samples = 1024;
    for (const Judgement& row : judge(unseen_light(), nodes, judging))
        EXPECT_LT(row.rms[1], 0.75 * row.rms[0]) << row.roughness << " " << row.reflectance;
}

TEST(LobeTable, reaches_over_all_levels_that_a_lobe_is_made_of) {
    for (const bool four : {false, true}) {
        const LobeReach all = lobe_reach(0.1f, 1.0f, four);
        for (float r = 0.1f; r <= 1.0f; r *= 1.03f) {
            const LobeReach reach = lobe_reach(r, r, four);
            EXPECT_GE(reach.sharpest, all.sharpest);
            EXPECT_LE(reach.widest, all.widest);
            for (const float NoV : {0.001f, 0.1f, 0.37f, 0.8f, 1.0f}) {
                const LobeNode node = lobe_at(lobe_nodes(), NoV, r, 0.3f);
                const LobeSweep& sweep = four ? node.four : node.two;
                const float level = FitLight::level_index(std::log2(r) + sweep.log2_ratio);
                // The outermost levels are those that enclose the reach.
                const float first = FitLight::level_index(std::log2(r * reach.sharpest)) - 1.0f;
                const float last = FitLight::level_index(std::log2(r * reach.widest)) + 1.0f;
                for (const SweptLevel& each : swept_levels(sweep, level, four)) {
                    if (each.weight < 1e-6f) continue;
                    EXPECT_GT(float(each.level), first) << r << " " << NoV;
                    EXPECT_LT(float(each.level), last) << r << " " << NoV;
                }
            }
        }
    }
}

TEST(LobeSweep, gives_levels_no_weight_where_they_enter_and_leave) {
    const LobeSweep sweep{-0.3f, 0.4f, 1.3f, 0.2f, {2.0f, 1.5f}};
    for (const bool four : {false, true}) {
        for (float level = -3.0f; level < 17.0f; level += 0.125f) {
            float sum = 0.0f;
            for (const SweptLevel& each : swept_levels(sweep, level, four)) sum += each.weight;
            EXPECT_NEAR(sum, 0.8f, 1e-6f);
        }
        // On both sides each has the same weight and the same direction.
        const float change = 7.0f;
        const auto below = swept_levels(sweep, change - 1e-4f, four),
                   above = swept_levels(sweep, change, four);
        for (const SweptLevel& b : below)
            for (const SweptLevel& a : above)
                if (a.level == b.level) {
                    EXPECT_NEAR(a.weight, b.weight, 1e-3f);
                    EXPECT_NEAR(a.kappa, b.kappa, 1e-3f);
                }
        EXPECT_LT(below[0].weight, 1e-3f);
        EXPECT_LT(above[3].weight, 1e-3f);
    }
}

TEST(LobeSweep, without_a_lean_is_as_long_wherever_it_lies_between_levels) {
    for (const bool four : {false, true})
        for (float level = 3.0f; level < 5.0f; level += 0.0625f) {
            double mean = 0.0, square = 0.0;
            for (const SweptLevel& each : swept_levels({0.0f, 0.7f, 1.0f}, level, four)) {
                mean += double(each.weight) * each.level;
                square += double(each.weight) * (each.kappa - 0.7) * (each.kappa - 0.7);
            }
            EXPECT_NEAR(mean, level, 1e-5);
            if (four) {
                EXPECT_NEAR(square, 1.0 / 3.0, 1e-5);
            }
        }
}

}  // namespace
}  // namespace patina::lobes

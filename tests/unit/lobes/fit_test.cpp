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
    EXPECT_NEAR(lobe_radiance(furnace, lobe_at(lobe_nodes(), 0.4f, 0.3f, 0.5f), true,
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
        const double split = row.rms[0], one = row.rms[1], three = row.rms[2];
        EXPECT_LT(one, 0.6 * split) << row.roughness << " " << row.reflectance;
        EXPECT_LT(three, 0.8 * one) << row.roughness << " " << row.reflectance;
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
    settings.sweeps = 8;
    const std::vector<LobePair> nodes = fit_lobes(make_fit_light(set, 64), settings);
    ASSERT_EQ(nodes.size(), lobe_nodes().size());
    JudgeSettings judging;
    judging.roughness = {0.35f, 0.6f};
    judging.pixels = 80;
    judging.truth_samples = 1024;
    for (const Judgement& row : judge(unseen_light(), nodes, judging))
        EXPECT_LT(row.rms[1], 0.75 * row.rms[0]) << row.roughness << " " << row.reflectance;
}

TEST(LobeTable, reaches_no_sharper_and_no_wider_than_its_nodes) {
    const LobeReach all = lobe_reach(0.1f, 1.0f, false);
    for (const LobePair& pair : lobe_nodes())
        for (const LobeNode& node : pair.by_reflectance) {
            EXPECT_GE(std::exp2(node.one.log2_ratio), all.sharpest);
            EXPECT_LE(std::exp2(node.one.log2_ratio), all.widest);
        }
    const LobeReach narrow = lobe_reach(0.4f, 0.41f, false);
    EXPECT_GE(narrow.sharpest, all.sharpest);
    EXPECT_LE(narrow.widest, all.widest);
    const LobeNode node = lobe_at(lobe_nodes(), 0.3f, 0.405f, 0.3f);
    EXPECT_GE(std::exp2(node.one.log2_ratio), narrow.sharpest);
    EXPECT_LE(std::exp2(node.one.log2_ratio), narrow.widest);
}

}  // namespace
}  // namespace patina::lobes

#include "tests/unit/ibl/oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace patina {
namespace {

using namespace test;

struct Error {
    double rms = 0.0, p95 = 0.0, max = 0.0;
};

/// Relative error of a cube against the oracle at texels anywhere and around the brightest one.
Error error_of(const CubeMap& cube, const Environment& environment, double roughness, int count) {
    std::vector<int> texels;
    std::mt19937 random(7);
    for (int i = 0; i < count; ++i) texels.push_back(int(random() % cube.texels.size()));
    const auto brightest = std::max_element(cube.texels.begin(), cube.texels.end(),
                                            [](glm::vec3 a, glm::vec3 b) { return a.y < b.y; });
    for (const int offset : {0, 1, cube.size, 3, 3 * cube.size})
        texels.push_back(
            std::min(int(brightest - cube.texels.begin()) + offset, int(cube.texels.size()) - 1));
    const glm::dvec3 mean = mean_radiance(environment);
    std::vector<double> errors;
    for (const int i : texels) {
        const int face = i / (cube.size * cube.size);
        const glm::dvec3 N = cube_texel_direction(cube.size, face, i % cube.size, i / cube.size % cube.size);
        const glm::dvec3 truth = prefiltered_radiance(environment, N, roughness);
        for (int c = 0; c < 3; ++c)
            errors.push_back(std::abs(cube.texels[i][c] - truth[c]) / std::max(truth[c], 1e-3 * mean[c]));
    }
    std::sort(errors.begin(), errors.end());
    double square = 0.0;
    for (const double e : errors) square += e * e;
    return {std::sqrt(square / double(errors.size())), errors[errors.size() * 95 / 100], errors.back()};
}

void expect_accurate(const Environment& environment, const std::vector<float>& roughness, int count) {
    BakeSettings settings;
    settings.roughness = roughness;
    const auto baked = bake_environment(environment, settings, {});
    ASSERT_TRUE(baked);
    for (const PrefilteredLevel& level : baked->levels) {
        const Error e = error_of(level.cube, environment, level.roughness, count);
        const double limit = level.roughness < 0.15f ? 0.0015 : 0.001;
        EXPECT_LE(e.rms, limit) << "roughness " << level.roughness;
        EXPECT_LE(e.p95, 3 * limit) << "roughness " << level.roughness;
        EXPECT_LE(e.max, 0.015) << "roughness " << level.roughness;
        if (std::getenv("PATINA_SHOW_ERRORS"))
            std::printf("r %.3f  rms %.4f %%  p95 %.4f %%  max %.4f %%\n", double(level.roughness),
                        100 * e.rms, 100 * e.p95, 100 * e.max);
    }
    const Error e = error_of(baked->irradiance, environment, 1.0, count);
    EXPECT_LE(e.rms, 0.001) << "irradiance";
}

TEST(BakeAccuracy, holds_under_a_strong_sun) {
    expect_accurate(sunny_panorama(256, 128, 5e4, 0.02), {0.1f, 0.15f, 0.3f, 0.6f, 1.0f}, 25);
}
TEST(BakeAccuracy, holds_in_a_dark_studio) {
    expect_accurate(studio_panorama(256, 128), {0.1f, 0.2f, 0.5f}, 25);
}
TEST(BakeAccuracy, holds_for_noise) { expect_accurate(noise_panorama(128, 64, 5), {0.1f, 0.25f, 0.7f}, 25); }
TEST(BakeAccuracy, holds_for_odd_and_tiny_sizes) {
    expect_accurate(noise_panorama(2, 1, 1), {0.1f, 0.3f, 1.0f}, 10);
    expect_accurate(noise_panorama(97, 11, 1), {0.3f}, 10);  // a prime width: Bluestein's transform
    expect_accurate(noise_panorama(62, 31, 1), {0.3f}, 10);  // a large odd radix
    expect_accurate(noise_panorama(37, 23, 1), {0.12f, 0.5f}, 10);
    expect_accurate(noise_panorama(1, 5, 1), {0.2f, 0.9f}, 10);
}

}  // namespace
}  // namespace patina

// Properties the transform must have whatever the picture.
#include "renderer/ibl/sh_simd.h"
#include "renderer/ibl/sh_transform.h"
#include "tests/unit/ibl/oracle.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <hwy/targets.h>
#include <numbers>
#include <thread>

namespace patina {
namespace {

using namespace test;

BakeSettings few_levels() {
    BakeSettings settings;
    settings.roughness = {0.1f, 0.2f, 0.45f, 1.0f};
    settings.max_face_size = 32;
    return settings;
}

ParallelFor threads(int count) {
    return [count](int n, const std::function<void(int)>& body) {
        std::atomic<int> next{0};
        std::vector<std::thread> all;
        for (int t = 0; t < count; ++t)
            all.emplace_back([&] {
                for (int i = next++; i < n; i = next++) body(i);
            });
        for (std::thread& thread : all) thread.join();
    };
}

void expect_same_texels(const BakedEnvironment& a, const BakedEnvironment& b) {
    for (std::size_t i = 0; i < a.levels.size(); ++i)
        EXPECT_EQ(a.levels[i].cube.texels, b.levels[i].cube.texels);
    EXPECT_EQ(a.irradiance.texels, b.irradiance.texels);
}

TEST(Transform, gives_the_same_bits_on_any_number_of_threads) {
    const Environment environment = sunny_panorama(64, 32, 1e4, 0.05);
    BakeSettings settings = few_levels();
    settings.roughness.insert(settings.roughness.begin(), 0.0f);
    const auto one = bake_environment(environment, settings, {});
    BakeControl control;
    control.parallel_for = threads(3);
    const auto many = bake_environment(environment, settings, control);
    ASSERT_TRUE(one && many);
    expect_same_texels(*one, *many);
}

TEST(Transform, scales_by_powers_of_two_bit_for_bit) {
    Environment environment = noise_panorama(64, 32, 3);
    const auto before = bake_environment(environment, few_levels(), {});
    for (glm::vec3& texel : environment.radiance) texel *= 1024.0f;
    auto after = bake_environment(environment, few_levels(), {});
    ASSERT_TRUE(before && after);
    for (PrefilteredLevel& level : after->levels)
        for (glm::vec3& texel : level.cube.texels) texel /= 1024.0f;
    for (glm::vec3& texel : after->irradiance.texels) texel /= 1024.0f;
    expect_same_texels(*before, *after);
}

TEST(Transform, is_linear) {
    const Environment a = noise_panorama(64, 32, 1), b = sunny_panorama(64, 32, 100.0, 0.1);
    Environment sum = a;
    for (std::size_t i = 0; i < sum.radiance.size(); ++i) sum.radiance[i] += b.radiance[i];
    const LegendreTables tables(64, serial_for);
    const ShCoefficients ca = analyse(view_of(a), tables, {}), cb = analyse(view_of(b), tables, {}),
                         cs = analyse(view_of(sum), tables, {});
    const double scale = std::abs(cs.at(0, 0)[0]);
    for (int m = 0; m <= 64; ++m)
        for (int l = m; l <= 64; ++l)
            for (int part = 0; part < 6; ++part)
                ASSERT_NEAR((ca.at(l, m)[part] + cb.at(l, m)[part] - cs.at(l, m)[part]) / scale, 0.0, 1e-5);
}

TEST(Transform, turns_a_yaw_by_whole_texels_into_a_phase) {
    const Environment environment = noise_panorama(96, 48, 4);
    const int shift = 17;
    Environment turned = environment;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 96; ++x)
            turned.radiance[y * 96 + (x + shift) % 96] = environment.radiance[y * 96 + x];
    const LegendreTables tables(80, serial_for);
    const ShCoefficients a = analyse(view_of(environment), tables, {}),
                         b = analyse(view_of(turned), tables, {});
    const double scale = std::abs(a.at(0, 0)[0]);
    for (int m = 0; m <= 80; ++m)
        for (int l = m; l <= 80; ++l)
            for (int channel = 0; channel < 3; ++channel) {
                const double angle = -2.0 * std::numbers::pi * m * shift / 96.0;
                const float* z = a.at(l, m) + 2 * channel;
                const double re = z[0] * std::cos(angle) - z[1] * std::sin(angle);
                const double im = z[0] * std::sin(angle) + z[1] * std::cos(angle);
                ASSERT_NEAR((b.at(l, m)[2 * channel] - re) / scale, 0.0, 1e-6);
                ASSERT_NEAR((b.at(l, m)[2 * channel + 1] - im) / scale, 0.0, 1e-6);
            }
}

TEST(Transform, finds_the_coefficients_of_known_harmonics) {
    // Y_10 = √(3/4π) y, and with φ = 2πu: Y_1±1 ∝ x, z; a smooth picture, fine texels.
    const Environment environment =
        make_panorama(512, 256, [](glm::dvec3 d) { return glm::dvec3(1.0, 1.0 + d.y, 1.0 + d.x); });
    const LegendreTables tables(8, serial_for);
    const ShCoefficients c = analyse(view_of(environment), tables, {});
    const auto coefficient = [&](int l, int m, int part) {
        return c.at(l, m)[part] / std::sqrt(tables.norm_square[tables.at(l, m)]);
    };
    const double pi = std::numbers::pi;
    EXPECT_NEAR(coefficient(0, 0, 0), std::sqrt(4.0 * pi), 1e-5);
    EXPECT_NEAR(coefficient(1, 0, 2), std::sqrt(4.0 * pi / 3.0), 1e-4);
    // x = sin θ sin(φ − π) = −sin θ (e^iφ − e^−iφ)/2i: a_11 = (i/2)·∫ sin θ P̄_11 2π sin θ dθ, P̄_11 = √(3/8π)
    // sin θ
    EXPECT_NEAR(coefficient(1, 1, 5), 0.5 * std::sqrt(3.0 / (8.0 * pi)) * 2.0 * pi * 4.0 / 3.0, 1e-4);
    EXPECT_NEAR(coefficient(1, 1, 4), 0.0, 1e-5);
    for (int l = 2; l <= 8; ++l)
        for (int m = 0; m <= l; ++m)
            for (int part = 0; part < 6; ++part)
                EXPECT_NEAR(coefficient(l, m, part), 0.0, 2e-4) << l << " " << m;
}

TEST(Transform, keeps_the_mean) {
    const Environment environment = sunny_panorama(128, 64, 1e3, 0.05);
    const glm::dvec3 mean = mean_radiance(environment);
    const LegendreTables tables(20, serial_for);
    const ShCoefficients c = analyse(view_of(environment), tables, {});
    for (int channel = 0; channel < 3; ++channel)  // c_0 = 1/√4π is part of the stored coefficient
        EXPECT_NEAR(c.at(0, 0)[2 * channel] / mean[channel], 1.0, 1e-6);
    BakeSettings settings;
    settings.roughness = {0.3f, 0.6f, 1.0f};
    const auto baked = bake_environment(environment, settings, {});
    ASSERT_TRUE(baked);
    for (const PrefilteredLevel& level : baked->levels) {  // the sum over texels errs itself
        glm::dvec3 sum(0.0);
        const int n = level.cube.size;
        for (int i = 0; i < 6 * n * n; ++i)
            sum += cube_texel_solid_angle(n, i % n, i / n % n) * glm::dvec3(level.cube.texels[i]);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(sum[channel] / (4.0 * std::numbers::pi) / mean[channel], 1.0, 2e-4);
    }
}

TEST(Transform, stays_between_the_darkest_and_the_brightest) {
    const Environment environment = sunny_panorama(64, 32, 1e5, 0.05);
    glm::vec3 lowest = environment.radiance[0], highest = environment.radiance[0];
    for (const glm::vec3& texel : environment.radiance) {
        lowest = glm::min(lowest, texel);
        highest = glm::max(highest, texel);
    }
    const auto baked = bake_environment(environment, few_levels(), {});
    ASSERT_TRUE(baked);
    for (const PrefilteredLevel& level : baked->levels)
        for (const glm::vec3& texel : level.cube.texels)
            for (int c = 0; c < 3; ++c) {
                ASSERT_GE(texel[c], lowest[c]);
                ASSERT_LE(texel[c], highest[c]);
            }
}

/// Where the same direction can be reached from two faces, and across the panorama's seam, there must be no
/// step.
TEST(Transform, leaves_no_seam_between_faces) {
    const Environment environment = sunny_panorama(128, 64, 2e3, 0.1);
    BakeSettings settings;
    settings.roughness = {0.3f};
    const auto baked = bake_environment(environment, settings, {});
    ASSERT_TRUE(baked);
    const CubeMap& cube = baked->levels[0].cube;
    const int n = cube.size;
    const auto at = [&](int face, int x, int y) { return cube.texels[(std::size_t(face) * n + y) * n + x]; };
    // Linear extrapolation from both sides to the shared edge, +X | −Z, whose texels meet row by row.
    double worst = 0.0;
    for (int y = 0; y < n; ++y) {
        const glm::vec3 left = 1.5f * at(0, n - 1, y) - 0.5f * at(0, n - 2, y);
        const glm::vec3 right = 1.5f * at(5, 0, y) - 0.5f * at(5, 1, y);
        worst = std::max(worst, double(std::abs(left.y - right.y) / std::max(left.y, right.y)));
    }
    // +Z | −X lies on the seam of the panorama's azimuth plus a quarter; +Z's middle is the seam itself.
    for (int y = 0; y < n; ++y) {
        const glm::vec3 left = 1.5f * at(4, n / 2 - 1, y) - 0.5f * at(4, n / 2 - 2, y);
        const glm::vec3 right = 1.5f * at(4, n / 2, y) - 0.5f * at(4, n / 2 + 1, y);
        worst = std::max(worst, double(std::abs(left.y - right.y) / std::max(left.y, right.y)));
    }
    EXPECT_LE(worst, 2e-2);  // the extrapolation's own error; a seam in the data would show as 10 % and more
}

TEST(Transform, keeps_a_zonal_picture_zonal) {
    const Environment environment = make_panorama(128, 64, [](glm::dvec3 d) {
        return glm::dvec3(1.0 + d.y, d.y > 0.6 ? 20.0 : 0.5, d.y > 0.97 ? 100.0 : 1.0);
    });
    const auto baked = bake_environment(environment, few_levels(), {});
    ASSERT_TRUE(baked);
    for (const PrefilteredLevel& level : baked->levels) {
        const int n = level.cube.size;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const auto at = [&](int face, int i, int j) {
                    return level.cube.texels[(std::size_t(face) * n + j) * n + i];
                };
                for (int c = 0; c < 3; ++c) {
                    const float value = at(0, x, y)[c];
                    for (const int face : {1, 4, 5}) ASSERT_NEAR(at(face, x, y)[c] / value, 1.0f, 1e-5f);
                    ASSERT_NEAR(at(0, n - 1 - x, y)[c] / value, 1.0f, 1e-5f);
                    ASSERT_NEAR(at(2, y, n - 1 - x)[c] / at(2, x, y)[c], 1.0f,
                                1e-5f);  // a quarter turn of the top
                }
            }
    }
}

/// The same bake on every instruction set this machine has, the plainest included.
TEST(Transform, agrees_on_every_instruction_set) {
    const Environment environment = noise_panorama(96, 48, 8);
    const auto best = bake_environment(environment, few_levels(), {});
    ASSERT_TRUE(best);
    for (std::int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
        hwy::SetSupportedTargetsForTest(targets & -targets);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        const auto other = bake_environment(environment, few_levels(), {});
        ASSERT_TRUE(other);
        for (std::size_t i = 0; i < best->levels.size(); ++i)
            for (std::size_t k = 0; k < best->levels[i].cube.texels.size(); ++k)
                ASSERT_NEAR(other->levels[i].cube.texels[k].x / best->levels[i].cube.texels[k].x, 1.0f, 2e-4f)
                    << simd::instruction_set() << " roughness " << best->levels[i].roughness;
        RecordProperty(simd::instruction_set(), "agrees");
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace
}  // namespace patina

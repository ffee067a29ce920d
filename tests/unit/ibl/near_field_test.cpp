// Levels sharper than the transform can do: quadrature near the lobe's middle, the transform for the rest.
#include "renderer/ibl/near_field.h"

#include "renderer/ibl/lights.h"
#include "renderer/ibl/near_simd.h"
#include "renderer/ibl/reference.h"
#include "tests/unit/ibl/oracle.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patina {
namespace {

using namespace test;

void expect_sharp_levels(const Environment& environment, const std::vector<float>& roughness, int size,
                         int texels) {
    BakeSettings settings;
    settings.roughness = roughness;
    settings.max_face_size = size;
    const auto baked = bake_environment(environment, settings, {});
    ASSERT_TRUE(baked);
    PrefilterProbe probe;
    probe.texels = texels;
    for (const PrefilteredLevel& level : baked->levels) {
        const PrefilterError e = prefilter_error(level.cube, level.roughness, environment, probe);
        EXPECT_LE(e.rms, 0.004) << "roughness " << level.roughness;
        EXPECT_LE(e.max, 0.02) << "roughness " << level.roughness;
    }
}

TEST(KernelSplit, window_falls_smoothly_from_one_to_zero) {
    const KernelSplit split{0.01, 0.04};
    EXPECT_EQ(split.window(0.0), 1.0);
    EXPECT_EQ(split.window(0.01), 1.0);
    EXPECT_NEAR(split.window(0.025), 0.5, 1e-12);
    EXPECT_NEAR(split.window(0.04), 0.0, 1e-12);
    EXPECT_EQ(split.window(1.0), split.window(0.04));
    for (double d = 0.01; d < 0.04; d += 0.001) EXPECT_GT(split.window(d), split.window(d + 0.001));
}

TEST(KernelSplit, far_part_is_the_whole_where_nothing_is_near) {
    const KernelSplit nothing{0.0, 1e-12};
    const std::vector<double> whole = ggx_zonal(0.2, 60), far = ggx_far_zonal(0.2, nothing, 60);
    for (std::size_t l = 0; l < far.size(); ++l) EXPECT_NEAR(far[l], whole[l], 1e-9);
}

TEST(KernelSplit, far_part_of_a_sharp_lobe_is_its_power_law) {
    // K ~ 16 α² θ⁻⁴ far out, π · 4 α²/θ² of the whole 4π/4 beyond θ.
    const double alpha = 1e-3;
    const KernelSplit split{0.0099, 0.0101};
    EXPECT_NEAR(ggx_far_zonal(alpha, split, 0).front() / (4.0 * alpha * alpha / 0.01), 1.0, 0.05);
}

TEST(NearField, integrates_a_rectangle_exactly) {
    const double spread = 0.3, x[] = {-0.4, 0.1, 0.9}, top = -0.2, bottom = 0.5;
    double padded[3 + simd::kNearPadding] = {x[0], x[1], x[2]}, out[3 + simd::kNearPadding];
    simd::near_corners({padded, 3, top, bottom}, spread, out);
    for (int k = 0; k < 2; ++k) {
        double sum = 0.0;
        constexpr int steps = 400;
        for (int i = 0; i < steps * steps; ++i) {
            const double u = x[k] + (x[k + 1] - x[k]) * (i % steps + 0.5) / steps;
            const double v = top + (bottom - top) * (i / steps + 0.5) / steps;
            sum += 1.0 / std::pow(u * u + v * v + spread, 2.0);
        }
        sum *= (x[k + 1] - x[k]) * (bottom - top) / (steps * steps);
        EXPECT_NEAR(out[k + 1] - out[k], sum, 1e-5 * sum);
    }
}

TEST(NearField, holds_for_noise_at_any_sharpness) {
    expect_sharp_levels(noise_panorama(192, 96, 3), {0.004f, 0.03f, 0.07f}, 8, 6);
}
TEST(NearField, holds_with_a_sun_left_in) {
    expect_sharp_levels(sunny_panorama(192, 96, 5e4, 0.03), {0.01f, 0.05f}, 8, 6);
}
TEST(NearField, holds_for_odd_and_tiny_sizes) {
    expect_sharp_levels(noise_panorama(2, 1, 1), {0.05f}, 8, 6);
    expect_sharp_levels(noise_panorama(97, 11, 1), {0.05f}, 8, 4);
    expect_sharp_levels(noise_panorama(1, 5, 1), {0.02f}, 8, 6);
}
TEST(SlowNearField, holds_for_a_dark_studio_and_a_sun_a_million_times_the_mean) {
    expect_sharp_levels(studio_panorama(512, 256), {0.01f, 0.03f, 0.06f}, 64, 30);
    expect_sharp_levels(sunny_panorama(512, 256, 1e8, 0.005), {0.02f, 0.06f}, 64, 20);
}

TEST(NearField, is_right_around_the_poles) {
    // A lamp just beside the zenith, seen from all around it.
    const Environment environment = make_panorama(256, 128, [](glm::dvec3 d) {
        return glm::dvec3(d.x > 0.0 && d.x < 0.05 && std::abs(d.z) < 0.03 && d.y > 0.0 ? 5.0 : 0.1);
    });
    const KernelSplit split = NearField(view_of(environment), {}).split();
    ASSERT_GT(split.outer_square, 0.0);
    BakeSettings settings;
    settings.roughness = {0.03f, 0.06f};
    settings.max_face_size = 64;
    const auto baked = bake_environment(environment, settings, {});
    ASSERT_TRUE(baked);
    const PrefilterReference reference(environment);
    for (const PrefilteredLevel& level : baked->levels)
        for (int y = 30; y < 34; ++y)
            for (int x = 30; x < 35; ++x) {
                const glm::dvec3 N = glm::normalize(glm::dvec3(cube_texel_direction(64, 2, x, y)));
                const double truth = reference.radiance(N, level.roughness).y;
                EXPECT_NEAR(level.cube.texels[(2 * 64 + y) * 64 + x].y / truth, 1.0, 0.01)
                    << level.roughness << " at " << x << ' ' << y;
            }
}

TEST(NearField, meets_the_transform_without_a_step) {
    const Environment environment = sunny_panorama(512, 256, 1e3, 0.02);
    BakeSettings settings;
    settings.roughness = {0.0748f, 0.075f};
    settings.max_face_size = 32;
    const auto baked = bake_environment(environment, settings, {});
    ASSERT_TRUE(baked);
    double square = 0.0;
    const std::size_t count = baked->levels[0].cube.texels.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double error = baked->levels[0].cube.texels[i].y / baked->levels[1].cube.texels[i].y - 1.0;
        square += error * error;
    }
    EXPECT_LE(std::sqrt(square / double(count)), 0.01);  // ¼ % apart in roughness
}

}  // namespace
}  // namespace patina

// Levels against double-precision quadrature over every texel, lights left in the map.
#include "renderer/ibl/reference.h"
#include "tests/unit/ibl/oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patina {
namespace {

using namespace test;

void expect_level(const CubeMap& cube, double roughness, const Environment& environment, int texels) {
    PrefilterProbe probe;
    probe.texels = texels;
    const PrefilterError e = prefilter_error(cube, roughness, environment, probe);
    const double limit = roughness < 0.0999 ? 0.01 : roughness < 0.1499 ? 0.0015 : 0.001;
    EXPECT_LE(e.rms, limit) << "roughness " << roughness;
    if (roughness > 0.0999) {
        EXPECT_LE(e.p95, 3 * limit) << "roughness " << roughness;
        EXPECT_LE(e.max, 0.015) << "roughness " << roughness;
    }
    testing::Test::RecordProperty("rms_" + std::to_string(roughness), std::to_string(e.rms));
}

void expect_accurate(const Environment& environment, const std::vector<float>& roughness, int texels) {
    BakeSettings settings;
    settings.roughness = roughness;
    const auto baked = bake_environment(environment, settings, {});
    ASSERT_TRUE(baked);
    for (const PrefilteredLevel& level : baked->levels)
        expect_level(level.cube, level.roughness, environment, texels);
    expect_level(baked->irradiance, 1.0, environment, texels);
}

TEST(PrefilterReference, is_exact_for_a_cosine_lobe_on_a_half_lit_sphere) {
    // Upper half 1, lower half 0, roughness 1: E/π = (1 + cos θ)/2.
    const Environment environment =
        make_panorama(64, 32, [](glm::dvec3 d) { return glm::dvec3(d.y > 0.0 ? 1.0 : 0.0); });
    const PrefilterReference reference(environment);
    for (const double theta : {0.0, 0.3, 1.0, 1.5, 2.0, 3.0})
        EXPECT_NEAR(reference.radiance({std::sin(theta), std::cos(theta), 0.0}, 1.0).x,
                    0.5 * (1.0 + std::cos(theta)), 1e-5);
}

TEST(PrefilterReference, gives_one_in_a_white_room) {
    const Environment environment = constant_panorama(64, 32, glm::vec3(1.0f));
    const PrefilterReference reference(environment);
    for (const double roughness : {0.02, 0.1, 0.3, 0.7, 1.0})
        for (const double theta : {0.0, 0.01, 0.8, 1.6})
            EXPECT_NEAR(reference.radiance({0.0, std::cos(theta), std::sin(theta)}, roughness).x, 1.0, 3e-5)
                << roughness;
}

TEST(BakeAccuracy, holds_under_a_strong_sun) {
    expect_accurate(sunny_panorama(256, 128, 5e4, 0.02), {0.1f, 0.3f}, 10);
}
TEST(SlowBakeAccuracy, holds_under_a_strong_sun_at_every_standard_level) {
    expect_accurate(sunny_panorama(512, 256, 5e4, 0.01), standard_roughness_levels(), 30);
}
TEST(SlowBakeAccuracy, holds_under_a_sun_a_million_times_the_mean) {
    expect_accurate(sunny_panorama(512, 256, 1e8, 0.005), {0.1f, 0.3f}, 8);
}
TEST(BakeAccuracy, holds_in_a_dark_studio) { expect_accurate(studio_panorama(256, 128), {0.1f, 0.2f}, 10); }
TEST(BakeAccuracy, holds_for_noise) { expect_accurate(noise_panorama(128, 64, 5), {0.1f, 0.25f, 0.7f}, 20); }
TEST(SlowBakeAccuracy, holds_for_sharper_levels) {
    expect_accurate(sunny_panorama(256, 128, 5e4, 0.012), {0.06f, 0.08f}, 10);
}
TEST(BakeAccuracy, holds_for_odd_and_tiny_sizes) {
    expect_accurate(noise_panorama(2, 1, 1), {0.1f, 0.3f, 1.0f}, 10);
    expect_accurate(noise_panorama(97, 11, 1), {0.3f}, 10);  // a prime width: Bluestein's transform
    expect_accurate(noise_panorama(62, 31, 1), {0.3f}, 10);  // a large odd radix
    expect_accurate(noise_panorama(37, 23, 1), {0.12f, 0.5f}, 10);
    expect_accurate(noise_panorama(1, 5, 1), {0.2f, 0.9f}, 10);
}

}  // namespace
}  // namespace patina

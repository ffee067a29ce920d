#include "renderer/core/builtin_env.h"
#include "renderer/core/sky_model.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Direction at that zenith angle; the sun stands at azimuth 0.
glm::vec3 at_angles(float zenith_deg, float azimuth_deg) {
    const float theta = zenith_deg * kPi / 180.0f;
    const float phi = azimuth_deg * kPi / 180.0f;
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

struct Point {
    float turbidity, sun_zenith_deg, zenith_deg, azimuth_deg;
    glm::vec3 xyy;
};
// Evaluated from the paper's formulas with a separate double-precision script.
constexpr std::array kPoints{
    Point{3, 45, 0, 0, {0.245678f, 0.251476f, 7.32036f}},
    Point{3, 45, 60, 180, {0.243216f, 0.258031f, 5.83670f}},
    Point{3, 45, 30, 0, {0.267215f, 0.273952f, 16.30487f}},
    Point{3, 45, 75, 90, {0.267882f, 0.282860f, 8.22020f}},
    Point{2, 20, 0, 0, {0.259102f, 0.265611f, 7.36739f}},
    Point{2, 20, 60, 180, {0.240599f, 0.251435f, 5.60369f}},
    Point{6, 75, 30, 0, {0.294094f, 0.306517f, 7.92773f}},
    Point{6, 75, 75, 90, {0.335196f, 0.354969f, 5.03936f}},
};

TEST(PreethamSky, follows_the_papers_formulas_at_known_points) {
    for (const Point& point : kPoints) {
        const PreethamSky sky(at_angles(point.sun_zenith_deg, 0.0f), point.turbidity);
        const glm::vec3 value = sky.xyy(at_angles(point.zenith_deg, point.azimuth_deg));
        EXPECT_NEAR(value.x, point.xyy.x, 1e-4f);
        EXPECT_NEAR(value.y, point.xyy.y, 1e-4f);
        EXPECT_NEAR(value.z / point.xyy.z, 1.0f, 1e-3f);
    }
}

TEST(PreethamSky, is_finite_and_positive_down_to_the_horizon_for_every_sun_and_haze) {
    for (float sun = 0.0f; sun <= 89.0f; sun += 8.9f)
        for (const float turbidity : {2.0f, 3.0f, 4.5f, 6.0f}) {
            const PreethamSky sky(at_angles(sun, 0.0f), turbidity);
            for (float zenith = 0.0f; zenith <= 90.0f; zenith += 7.5f)
                for (float azimuth = 0.0f; azimuth < 360.0f; azimuth += 45.0f) {
                    glm::vec3 direction = at_angles(zenith, azimuth);
                    direction.y = std::max(direction.y, 0.0f);
                    const glm::vec3 radiance = sky.radiance(direction);
                    ASSERT_TRUE(std::isfinite(radiance.x + radiance.y + radiance.z))
                        << sun << " " << turbidity;
                    ASSERT_GT(radiance.y, 0.0f) << sun << " " << turbidity;
                }
        }
}

TEST(PreethamSky, sun_is_as_bright_as_measured_and_reddens_towards_the_horizon) {
    const auto luminance = [](glm::vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; };
    const float solid_angle = 2.0f * kPi * (1.0f - std::cos(kSunAngularRadius));
    // Direct normal illuminance of a clear day with the sun at 45° to 60°: 80 to 105 klx.
    const float high = luminance(PreethamSky(at_angles(35.0f, 0.0f), 2.5f).sun_radiance()) * solid_angle;
    EXPECT_GT(high, 80.0f);
    EXPECT_LT(high, 105.0f);
    const glm::vec3 low = PreethamSky(at_angles(85.0f, 0.0f), 3.0f).sun_radiance();
    EXPECT_GT(low.x, 1.5f * low.y);
    EXPECT_GT(low.y, 1.5f * low.z);
    EXPECT_LT(luminance(low) * solid_angle, 0.3f * high);
}

TEST(PreethamSky, clear_sky_at_noon_is_blue) {
    const glm::vec3 zenith = PreethamSky(at_angles(40.0f, 0.0f), 2.5f).radiance({0.0f, 1.0f, 0.0f});
    EXPECT_GT(zenith.z, 1.3f * zenith.x);
}

/// Energy of the texels that only the sun can brighten so much.
double sun_energy(const Environment& environment) {
    constexpr float kBrighterThanSky = 20.0f;
    double sum = 0.0;
    for (int y = 0; y < environment.height; ++y)
        for (int x = 0; x < environment.width; ++x) {
            const float value = environment.radiance[static_cast<std::size_t>(y) * environment.width + x].y;
            if (value > kBrighterThanSky) sum += value * texel_solid_angle(environment, y);
        }
    return sum;
}

TEST(Sky, sun_holds_the_same_energy_at_every_width) {
    const double reference = sun_energy(make_sky(1024));
    for (const int width : {256, 333})
        EXPECT_NEAR(sun_energy(make_sky(width)) / reference, 1.0, 0.005) << width;
}

TEST(Sky, sun_outshines_the_sky_ten_thousand_times) {
    const Environment environment = make_sky(1024);
    float sun = 0.0f;
    for (const glm::vec3& texel : environment.radiance) sun = std::max(sun, texel.y);
    const float sky_away_from_sun = environment.radiance[1024 * 100 + 650].y;
    EXPECT_GT(sun, 1e4f * sky_away_from_sun);
}

TEST(Xyy, white_is_white_and_primaries_are_themselves) {
    const glm::vec3 white = xyy_to_rgb({0.3127f, 0.3290f, 1.0f});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1.0f, 2e-3f);
    const glm::vec3 green = xyy_to_rgb({0.30f, 0.60f, 0.7152f});
    EXPECT_NEAR(green.x, 0.0f, 2e-3f);
    EXPECT_NEAR(green.y, 1.0f, 2e-3f);
    EXPECT_NEAR(green.z, 0.0f, 2e-3f);
}

}  // namespace
}  // namespace patina

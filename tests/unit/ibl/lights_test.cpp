#include "renderer/ibl/lights.h"

#include "renderer/ibl/reference.h"
#include "tests/unit/ibl/oracle.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patina {
namespace {

using namespace test;

glm::dvec3 flux_of(const RadianceView& view) {
    glm::dvec3 sum(0.0);
    const double step = std::numbers::pi / view.height;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            sum += (std::cos(y * step) - std::cos((y + 1) * step)) * 2.0 * std::numbers::pi / view.width *
                   glm::dvec3(view.rows[y][x]);
    return sum;
}

LightExtraction extract(const Environment& environment) {
    return extract_lights(environment, radiance_statistics(view_of(environment), serial_for), {});
}

TEST(Lights, find_the_sun_and_keep_the_energy) {
    const Environment environment = sunny_panorama(512, 256, 5e4, 0.008);
    const LightExtraction extraction = extract(environment);
    ASSERT_EQ(extraction.lights.size(), 1u);
    const glm::vec3 sun = glm::normalize(glm::vec3(0.4f, 0.6f, -0.7f));
    EXPECT_GT(glm::dot(extraction.lights[0].direction, sun), std::cos(0.004f));
    const glm::dvec3 before = flux_of(view_of(environment)), after = flux_of(extraction.residual);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR((after[c] + extraction.lights[0].irradiance[c]) / before[c], 1.0, 1e-6);
    EXPECT_GT(extraction.lights[0].irradiance.y, 0.5 * before.y);
    EXPECT_LT(extraction.lights[0].angular_radius_rad, 0.02f);
}

TEST(Lights, leave_softboxes_in_the_map) { EXPECT_TRUE(extract(studio_panorama(512, 256)).lights.empty()); }

TEST(Lights, find_a_sun_within_a_bright_glow) {
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.2, 0.3, 0.9));
    const Environment environment = make_panorama(512, 256, [&](glm::dvec3 d) {
        const double angle = std::acos(std::min(1.0, glm::dot(d, sun)));
        return glm::dvec3(0.1 + 40.0 * std::exp(-angle * angle / 0.02) + (angle < 0.01 ? 3e4 : 0.0));
    });
    const LightExtraction extraction = extract(environment);
    ASSERT_EQ(extraction.lights.size(), 1u);
    EXPECT_LT(extraction.lights[0].angular_radius_rad, 0.0173f);
}

TEST(Lights, find_a_lamp_across_the_seam) {
    const Environment environment = make_panorama(512, 256, [](glm::dvec3 d) {
        return glm::dvec3(0.1 +
                          (d.z > std::cos(0.011) ? 1e4 : 0.0));  // +Z is the picture's left and right edge
    });
    const LightExtraction extraction = extract(environment);
    ASSERT_EQ(extraction.lights.size(), 1u);
    EXPECT_NEAR(extraction.lights[0].direction.z, 1.0f, 1e-4f);
}

TEST(Lights, put_back_give_what_the_kernel_makes_of_them) {
    const Environment environment = sunny_panorama(512, 256, 5e4, 0.01);
    const LightExtraction extraction = extract(environment);
    ASSERT_FALSE(extraction.lights.empty());
    Environment taken = environment;
    for (int y = 0; y < taken.height; ++y)
        for (int x = 0; x < taken.width; ++x)
            taken.radiance[std::size_t(y) * taken.width + x] -= extraction.residual.rows[y][x];
    const int size = 32;
    const PrefilterReference reference(taken);
    for (const double roughness : {0.06, 0.1, 0.4, 1.0}) {
        CubeMap cube{size, std::vector<glm::vec3>(std::size_t(6) * size * size, glm::vec3(0.0f))};
        fold_back(extraction, float(roughness), std::nullopt, cube, {});
        float largest = 0.0f;
        for (const glm::vec3& texel : cube.texels) largest = std::max(largest, texel.y);
        for (int i = 0; i < int(cube.texels.size()); i += 13) {
            const glm::dvec3 N = cube_texel_direction(size, i / size / size, i % size, i / size % size);
            const double truth = reference.radiance(glm::normalize(N), roughness).y;
            ASSERT_NEAR(cube.texels[i].y, truth, 1e-3 * truth + 2e-5 * largest) << roughness << " at " << i;
        }
    }
}

TEST(Bake, gives_lights_only_when_asked) {
    const Environment environment = sunny_panorama(256, 128, 5e4, 0.015);
    BakeSettings settings;
    settings.roughness = {0.5f};
    const auto kept = bake_environment(environment, settings, {});
    settings.extract_lights = true;
    const auto taken = bake_environment(environment, settings, {});
    ASSERT_TRUE(kept && taken);
    EXPECT_TRUE(kept->lights.empty());
    ASSERT_EQ(taken->lights.size(), 1u);
    EXPECT_LT(taken->irradiance.texels[0].y, kept->irradiance.texels[0].y + 1e-6f);
}

}  // namespace
}  // namespace patina

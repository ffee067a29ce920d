#include "tests/unit/ibl/oracle.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

namespace patina {
namespace {

using namespace test;

TEST(Bake, keeps_a_constant_environment_constant_at_every_roughness) {
    BakeSettings settings;
    settings.roughness = {0.0f, 0.05f, 0.3f, 1.0f};
    settings.max_face_size = 16;
    for (const auto& [width, height] : {std::pair{1, 1}, {51, 33}}) {
        const Environment environment = constant_panorama(width, height, {0.5f, 1.0f, 3.0f});
        const auto baked = bake_environment(environment, settings, {});
        ASSERT_TRUE(baked);
        ASSERT_EQ(baked->levels.size(), settings.roughness.size());
        for (std::size_t i = 0; i < baked->levels.size(); ++i)
            for (const glm::vec3& texel : baked->levels[i].cube.texels)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(texel[c] / glm::vec3(0.5f, 1.0f, 3.0f)[c], 1.0f, 1e-5f)
                        << settings.roughness[i];
        for (const glm::vec3& texel : baked->irradiance.texels) ASSERT_NEAR(texel.y, 1.0f, 1e-5f);
    }
}

TEST(Bake, shows_the_environment_itself_at_roughness_zero) {
    const Environment environment = make_panorama(256, 128, [](glm::dvec3 d) { return 0.5 + 0.5 * d; });
    BakeSettings settings;
    settings.roughness = {0.0f};
    settings.max_face_size = 32;
    const auto baked = bake_environment(environment, settings, {});
    ASSERT_TRUE(baked);
    const CubeMap& cube = baked->levels[0].cube;
    for (int i = 0; i < int(cube.texels.size()); ++i) {
        const glm::vec3 d = cube_texel_direction(cube.size, i / (cube.size * cube.size), i % cube.size,
                                                 i / cube.size % cube.size);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(cube.texels[i][c], 0.5f + 0.5f * d[c], 2e-3f);
    }
}

TEST(Bake, gives_exactly_the_requested_levels_no_larger_than_asked) {
    const Environment environment = constant_panorama(8, 4, glm::vec3(1.0f));
    BakeSettings settings;
    settings.roughness = {0.2f, 0.55f, 0.9f};
    settings.max_face_size = 8;
    const auto baked = bake_environment(environment, settings, {});
    ASSERT_TRUE(baked);
    ASSERT_EQ(baked->levels.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(baked->levels[i].roughness, settings.roughness[i]);
        EXPECT_LE(baked->levels[i].cube.size, 8);
        EXPECT_EQ(baked->levels[i].cube.texels.size(),
                  std::size_t(6) * baked->levels[i].cube.size * baked->levels[i].cube.size);
    }
}

TEST(FirstLight, has_every_level_and_is_near_where_it_is_rough) {
    const Environment environment = sunny_panorama(256, 128, 100.0, 0.05);
    const auto first = bake_first_light(environment, {}, {});
    BakeSettings settings;
    settings.max_face_size = 32;
    const auto full = bake_environment(environment, settings, {});
    ASSERT_TRUE(first && full);
    ASSERT_EQ(first->levels.size(), full->levels.size());
    for (std::size_t i = 0; i < full->levels.size(); ++i) {
        EXPECT_EQ(first->levels[i].roughness, full->levels[i].roughness);
        ASSERT_EQ(first->levels[i].cube.size, 32);
        if (full->levels[i].roughness < 0.6f) continue;
        for (std::size_t k = 0; k < full->levels[i].cube.texels.size(); ++k)
            ASSERT_NEAR(first->levels[i].cube.texels[k].y / full->levels[i].cube.texels[k].y, 1.0f, 0.02f);
    }
    for (std::size_t k = 0; k < full->irradiance.texels.size(); ++k)
        ASSERT_NEAR(first->irradiance.texels[k].y / full->irradiance.texels[k].y, 1.0f, 0.01f);
}

TEST(FirstLight, has_a_small_sun_as_a_light_and_no_rings_around_it) {
    const Environment environment = sunny_panorama(1024, 512, 3e4, 0.006);
    BakeSettings settings = {.max_face_size = 32, .face_sizes = {}};
    settings.extract_lights = true;
    const auto first = bake_first_light(environment, settings, {});
    const auto full = bake_environment(environment, settings, {});
    ASSERT_TRUE(first && full);
    ASSERT_EQ(full->lights.size(), 1u);
    ASSERT_EQ(first->lights.size(), 1u);
    EXPECT_GT(glm::dot(first->lights[0].direction, full->lights[0].direction), std::cos(0.02f));
    EXPECT_NEAR(first->lights[0].irradiance.y / full->lights[0].irradiance.y, 1.0f, 0.05f);
    for (std::size_t i = 0; i < full->levels.size(); ++i) {
        if (full->levels[i].roughness < 0.25f || full->levels[i].cube.size != 32) continue;
        for (std::size_t k = 0; k < full->levels[i].cube.texels.size(); ++k)
            ASSERT_NEAR(first->levels[i].cube.texels[k].y / full->levels[i].cube.texels[k].y, 1.0f, 0.1f)
                << full->levels[i].roughness;
    }
}

TEST(Bake, meets_without_a_step_where_methods_change) {
    const Environment environment = sunny_panorama(512, 256, 1e3, 0.02);
    BakeSettings settings;
    settings.roughness = {0.0995f, 0.1f};  // lights put back; lights left in
    const auto baked = bake_environment(environment, settings, {});
    ASSERT_TRUE(baked);
    const CubeMap &sharp = baked->levels[0].cube, &smooth = baked->levels[1].cube;
    ASSERT_EQ(sharp.size, 2 * smooth.size);
    const int n = smooth.size;
    double square = 0.0;
    for (int i = 0; i < 6 * n * n; ++i) {
        const int face = i / (n * n), x = i % n, y = i / n % n;
        glm::vec3 mean(0.0f);
        for (int k = 0; k < 4; ++k)
            mean += sharp.texels[(std::size_t(face) * 2 * n + 2 * y + k / 2) * 2 * n + 2 * x + k % 2] / 4.0f;
        const double error = mean.y / smooth.texels[i].y - 1.0;
        square += error * error;
    }
    EXPECT_LE(std::sqrt(square / (6 * n * n)), 0.01);  // roughness ½ % apart, faces of half the size
}

TEST(Bake, stops_when_asked) {
    std::stop_source stop;
    BakeControl control;
    control.stop = stop.get_token();
    control.progress = [&](float) { stop.request_stop(); };
    EXPECT_FALSE(bake_environment(constant_panorama(64, 32, glm::vec3(1.0f)), {}, control));
}

TEST(Bake, reports_monotone_progress_that_ends_at_one) {
    std::vector<float> seen;
    BakeControl control;
    control.progress = [&](float fraction) { seen.push_back(fraction); };
    BakeSettings settings;
    settings.max_face_size = 8;
    ASSERT_TRUE(bake_environment(constant_panorama(16, 8, glm::vec3(1.0f)), settings, control));
    ASSERT_FALSE(seen.empty());
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_EQ(seen.back(), 1.0f);
}

}  // namespace
}  // namespace patina

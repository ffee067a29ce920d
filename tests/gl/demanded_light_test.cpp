// Light baked for one picture against all light: the same picture.
#include "renderer/needed_light.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

using namespace test;

glm::vec3 lamps_and_sky(glm::vec3 d) {
    const float lamp = glm::dot(d, glm::normalize(glm::vec3(0.5f, 0.6f, 0.7f))) > 0.97f ? 40.0f : 0.0f;
    return glm::vec3(0.3f + 0.5f * std::max(d.y, 0.0f) + lamp, 0.4f + 0.2f * d.x + lamp,
                     0.5f + 0.3f * d.z * d.z);
}

/// The environment with these levels only, as an artist's picture would have them made.
EnvironmentHandle light_with(const Environment& environment, const BakedEnvironment& baked) {
    renderer();  // makes the context
    auto light = std::make_shared<PreparedLight>(
        PreparedLight{make_panorama_levels(environment), make_light_levels(baked)});
    light->levels.sharpest = kSharpestLevel;
    return Renderer::begin_upload(light).finish();
}

/// Root mean square of the differences over that of the picture.
double relative_rms(const Image& a, const Image& b) {
    double difference = 0.0, size = 0.0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double from = texel(a, x, y, c), to = texel(b, x, y, c);
                difference += (from - to) * (from - to);
                size += from * from;
            }
    return std::sqrt(difference / size);
}

TEST(DemandedLight, draws_the_same_picture_as_all_light) {
    const Environment environment = make_panorama(lamps_and_sky, 128);
    BakeSettings settings;
    settings.max_face_size = 32;
    const EnvironmentHandle all = light_with(environment, *bake_environment(environment, settings, {}));
    for (const float roughness : {0.0f, 0.05f, 0.12f, 0.17f, 0.37f, 0.8f, 1.0f})
        for (const int way : {0, 1, 2, 3}) {
            Scene scene = make_scene(all, sphere());
            scene.material.metallic.value = way % 2 ? 1.0f : 0.0f;
            scene.material.roughness.value = roughness;
            scene.view.quality = way / 2 ? Quality::High : Quality::Standard;
            const NeededLight needed = needed_light(scene.material, {}, scene.view);
            settings.roughness = missing_levels(needed, {});
            settings.irradiance = needed.irradiance;
            BakedEnvironment few = *bake_environment(environment, settings, {});
            const CubeMap nothing{1, std::vector<glm::vec3>(6, glm::vec3(0.5f))};
            if (few.levels.empty()) few.levels = {{kSharpestLevel, nothing}};
            if (few.irradiance.size == 0) few.irradiance = nothing;
            const Image expected = radiance_of(scene, glm::ivec2(64));
            scene.environment = light_with(environment, few);
            // Levels lie on faces of other sizes.
            EXPECT_LT(relative_rms(expected, radiance_of(scene, glm::ivec2(64))), 3e-3)
                << "way " << way << ", roughness " << roughness;
        }
}

TEST(DemandedLight, is_drawn_alike_where_a_level_lies_between_standard_ones) {
    // As split sum had it baked for one roughness before.
    const Environment environment = make_panorama(lamps_and_sky, 128);
    BakeSettings settings;
    settings.max_face_size = 32;
    const EnvironmentHandle standard = light_with(environment, *bake_environment(environment, settings, {}));
    settings.roughness.insert(settings.roughness.begin() + 9, 0.37f);
    const EnvironmentHandle more = light_with(environment, *bake_environment(environment, settings, {}));
    for (const Quality quality : {Quality::Standard, Quality::High})
        for (const float roughness : {0.3f, 0.37f, 0.45f}) {
            Scene scene = make_scene(standard, sphere());
            scene.material.metallic.value = 1.0f;
            scene.material.roughness.value = roughness;
            scene.view.quality = quality;
            const Image expected = radiance_of(scene, glm::ivec2(64));
            scene.environment = more;
            EXPECT_LT(relative_rms(expected, radiance_of(scene, glm::ivec2(64))), 0.02)
                << "quality " << int(quality) << ", roughness " << roughness;
        }
}

TEST(DemandedLight, shares_the_panorama_of_light_that_is_there) {
    // A small sun straight ahead, which the panorama keeps apart.
    const Environment environment =
        make_panorama([](glm::vec3 d) { return glm::vec3(d.z < -0.99995f ? 3000.0f : 0.5f); }, 512);
    ASSERT_FALSE(make_panorama_levels(environment).lights.empty());
    BakeSettings settings;
    settings.max_face_size = 16;
    settings.roughness = {0.5f, 1.0f};
    const BakedEnvironment baked = *bake_environment(environment, settings, {});
    EnvironmentHandle first = light_with(environment, baked);
    Scene scene = make_scene(first, nullptr);
    const Image expected = radiance_of(scene);
    const auto added = std::make_shared<PreparedLight>(PreparedLight{{}, make_light_levels(baked), first});
    scene.environment = Renderer::begin_upload(added).finish();
    first.reset();
    EXPECT_EQ(radiance_of(scene).bytes, expected.bytes);
}

}  // namespace
}  // namespace patina

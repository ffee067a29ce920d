#include "renderer/brdf.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

using namespace test;

constexpr float kRoughnesses[] = {0.0f,  0.01f, 0.03f, 0.06f, 0.09f, 0.0999f, 0.1f,
                                  0.13f, 0.2f,  0.35f, 0.5f,  0.75f, 0.9f,    1.0f};

/// Smallest and largest channel over all pixels.
std::pair<float, float> range(const Image& image) {
    float least = INFINITY;
    float most = -INFINITY;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const float v = texel(image, x, y, c);
                least = std::min(least, v);
                most = std::max(most, v);
                EXPECT_TRUE(std::isfinite(v)) << x << ", " << y;
            }
        }
    }
    return {least, most};
}

TEST(WhiteFurnace, a_white_metal_sphere_cannot_be_seen_at_any_roughness_and_angle) {
    Scene scene = make_scene(constant_light(1.0f), sphere());
    scene.material.albedo.value = glm::vec3(1.0f);
    scene.material.metallic.value = 1.0f;
    for (const float roughness : kRoughnesses) {
        scene.material.roughness.value = roughness;
        const auto [least, most] = range(radiance_of(scene));
        EXPECT_NEAR(least, 1.0f, 2e-3f) << "roughness " << roughness;
        EXPECT_NEAR(most, 1.0f, 2e-3f) << "roughness " << roughness;
    }
}

TEST(WhiteFurnace, a_white_dielectric_sphere_cannot_be_seen_at_any_roughness_and_angle) {
    Scene scene = make_scene(constant_light(1.0f), sphere());
    scene.material.albedo.value = glm::vec3(1.0f);
    for (const float roughness : kRoughnesses) {
        scene.material.roughness.value = roughness;
        const auto [least, most] = range(radiance_of(scene));
        EXPECT_NEAR(least, 1.0f, 2e-3f) << "roughness " << roughness;
        EXPECT_NEAR(most, 1.0f, 2e-3f) << "roughness " << roughness;
    }
}

TEST(WhiteFurnace, no_darker_material_sends_back_more_than_it_receives) {
    Scene scene = make_scene(constant_light(1.0f), sphere());
    for (const float albedo : {0.0f, 0.2f, 0.8f}) {
        for (const float metallic : {0.0f, 0.5f, 1.0f}) {
            for (const float roughness : {0.0f, 0.05f, 0.3f, 1.0f}) {
                scene.material.albedo.value = glm::vec3(albedo);
                scene.material.metallic.value = metallic;
                scene.material.roughness.value = roughness;
                const auto [least, most] = range(radiance_of(scene, glm::ivec2(48)));
                EXPECT_LE(most, 1.0f + 2e-3f) << albedo << " " << metallic << " " << roughness;
                EXPECT_GE(least, 0.0f);
            }
        }
    }
}

/// In the middle of the picture the quad is seen straight on, but for half a pixel.
glm::vec3 straight_on(const Scene& scene) { return center(radiance_of(scene, glm::ivec2(65))); }

TEST(Shading, split_sum_follows_its_formula) {
    Scene scene = make_scene(constant_light(1.0f), quad());
    scene.material.albedo.value = {0.9f, 0.5f, 0.1f};
    const BrdfTable table = bake_brdf_table(16);
    for (const float metallic : {0.0f, 0.4f, 1.0f}) {
        const float roughness = (12 + 0.5f) / 16;
        scene.material.metallic.value = metallic;
        scene.material.roughness.value = roughness;
        // The table's last column is NoV = 0.94, so the formula is evaluated there and the camera turned by
        // 20°.
        scene.camera.yaw_deg = glm::degrees(std::acos(15.5f * 15.5f / 256.0f));
        const auto w = brdf::split_sum_weights(scene.material.albedo.value, metallic, table.ab[12 * 16 + 15]);
        const glm::vec3 expected = w.single + w.multiple + w.diffuse;
        const glm::vec3 seen = straight_on(scene);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 2e-3f) << metallic;
    }
}

TEST(Shading, course_follows_the_lecture) {
    Scene scene = make_scene(constant_light(1.0f), quad());
    scene.view.shading = Shading::Course;
    scene.material.albedo.value = {0.9f, 0.5f, 0.1f};
    scene.material.ao.value = 0.7f;
    scene.camera.yaw_deg = glm::degrees(std::acos(15.5f * 15.5f / 256.0f));
    const BrdfTable table = bake_brdf_table(16);
    for (const float metallic : {0.0f, 1.0f}) {
        const float roughness = (4 + 0.5f) / 16;
        scene.material.metallic.value = metallic;
        scene.material.roughness.value = roughness;
        const glm::vec2 ab = table.ab[4 * 16 + 15];
        const float NoV = 15.5f * 15.5f / 256.0f;
        const glm::vec3 F0 = glm::mix(glm::vec3(0.04f), scene.material.albedo.value, metallic);
        const glm::vec3 F =
            F0 + (glm::max(glm::vec3(1.0f - roughness), F0) - F0) * std::pow(1.0f - NoV, 5.0f);
        const glm::vec3 kD = (1.0f - F) * (1.0f - metallic);
        const glm::vec3 expected = (kD * scene.material.albedo.value + F * ab.x + ab.y) * 0.7f;
        const glm::vec3 seen = straight_on(scene);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 2e-3f) << metallic;
    }
}

TEST(Shading, occlusion_darkens_the_environments_light_and_not_what_the_surface_emits) {
    Scene scene = make_scene(constant_light(1.0f), quad());
    scene.material.ao.value = 0.0f;
    EXPECT_LT(straight_on(scene).x, 1e-5f);
    scene.material.emission.value = {3.0f, 0.5f, 0.0f};
    const glm::vec3 seen = straight_on(scene);
    EXPECT_NEAR(seen.x, 3.0f, 1e-3f);
    EXPECT_NEAR(seen.y, 0.5f, 1e-3f);
    EXPECT_NEAR(seen.z, 0.0f, 1e-5f);
}

TEST(Shading, exposure_doubles_the_light_with_every_stop) {
    Scene scene = make_scene(linear_light(), sphere());
    scene.material.emission.value = glm::vec3(0.1f);
    const Image plain = radiance_of(scene, glm::ivec2(32));
    for (const float stops : {-20.0f, -3.0f, 1.0f, 20.0f}) {
        scene.view.exposure_ev = stops;
        const Image exposed = radiance_of(scene, glm::ivec2(32));
        for (int i = 0; i < 32; ++i) {
            const glm::vec3 expected = pixel(plain, i, i) * std::exp2(stops);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(pixel(exposed, i, i)[c] / expected[c], 1.0f, 1e-5f) << stops;
        }
    }
}

TEST(Shading, diffuse_and_specular_views_add_up_to_the_picture) {
    Scene scene = make_scene(linear_light(), sphere());
    scene.material.roughness.value = 0.3f;
    const Image all = radiance_of(scene, glm::ivec2(33));
    scene.view.debug = DebugView::Diffuse;
    const Image diffuse = radiance_of(scene, glm::ivec2(33));
    scene.view.debug = DebugView::Specular;
    const Image specular = radiance_of(scene, glm::ivec2(33));
    for (const auto& [x, y] : {std::pair{16, 16}, {9, 20}, {22, 8}}) {
        const glm::vec3 sum = pixel(diffuse, x, y) + pixel(specular, x, y);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], pixel(all, x, y)[c], 1e-5f);
        EXPECT_GT(pixel(diffuse, x, y).x, 0.05f);
        EXPECT_GT(pixel(specular, x, y).x, 0.004f);
    }
}

TEST(Shading, an_extracted_light_adds_what_its_formula_says) {
    BakedEnvironment baked = make_baked([](glm::vec3, float) { return glm::vec3(0.0f); }, 8);
    ExtractedLight light;
    light.direction = glm::normalize(glm::vec3(0.0f, 1.0f, 2.0f));
    light.irradiance = {2.0f, 1.0f, 0.5f};
    baked.lights = {light};
    const auto environment =
        renderer().upload_environment(make_panorama([](glm::vec3) { return glm::vec3(0.0f); }, 16), baked);
    Scene scene = make_scene(environment, quad());
    scene.material.albedo.value = glm::vec3(0.6f);
    scene.material.roughness.value = 0.5f;
    const glm::vec3 V(0.0f, 0.0f, 1.0f);
    const glm::vec3 N = V;
    const glm::vec3 H = glm::normalize(V + light.direction);
    const float NoL = light.direction.z;
    const glm::vec3 side = glm::cross(N, H);
    const BrdfTable table = bake_brdf_table(128);
    const glm::vec2 ab = 0.5f * (table.ab[63 * 128 + 127] + table.ab[64 * 128 + 127]);
    const auto w = brdf::split_sum_weights(scene.material.albedo.value, 0.0f, ab);
    const glm::vec3 F0(0.04f);
    const glm::vec3 f = brdf::light_specular(F0, glm::dot(side, side), glm::vec3(1.0f, NoL, glm::dot(V, H)),
                                             glm::vec2(0.0625f, 0.0f));
    const glm::vec3 expected = light.irradiance * (f + (w.multiple + w.diffuse) * NoL / brdf::kPi);
    const glm::vec3 seen = straight_on(scene);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / expected[c], 1.0f, 3e-3f);
    // Turned by 180° it shines on the quad's back.
    scene.view.env_rotation_deg = 180.0f;
    EXPECT_LT(straight_on(scene).x, 1e-6f);
}

TEST(Shading, without_an_environment_only_emission_is_seen) {
    Scene scene = make_scene(nullptr, quad());
    scene.material.emission.value = glm::vec3(0.25f);
    EXPECT_NEAR(straight_on(scene).x, 0.25f, 1e-5f);
}

}  // namespace
}  // namespace patina

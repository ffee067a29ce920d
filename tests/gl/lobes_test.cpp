// Fitted lobes and extracted lights as drawn, against the same formulas in C++.
#include "renderer/brdf.h"
#include "renderer/core/metrics.h"
#include "renderer/lobes/lobe_table.h"
#include "renderer/reference.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

using namespace test;

/// A quad turned away from the camera, so that its middle is seen under a cosine.
Scene tilted_quad(EnvironmentHandle light, float NoV) {
    Scene scene = make_scene(std::move(light), quad());
    scene.camera.yaw_deg = glm::degrees(std::acos(NoV));
    return scene;
}

struct Case {
    float NoV, roughness, metallic;
    Quality quality;
};
constexpr Case kCases[] = {
    {0.95f, 0.2f, 1.0f, Quality::Standard}, {0.5f, 0.35f, 1.0f, Quality::Standard},
    {0.2f, 0.6f, 1.0f, Quality::Standard},  {0.3f, 0.45f, 0.0f, Quality::Standard},
    {0.5f, 0.35f, 0.5f, Quality::High},     {0.2f, 0.6f, 1.0f, Quality::High},
    {0.4f, 0.8f, 0.0f, Quality::High},
};

glm::vec2 table_at(float NoV, float roughness) {
    static const BrdfTable table = bake_brdf_table(128);
    const auto at = [](float x) { return std::clamp(x * 128.0f - 0.5f, 0.0f, 127.0f); };
    const float x = at(std::sqrt(NoV)), y = at(roughness);
    const int i = std::min(int(x), 126), j = std::min(int(y), 126);
    const auto row = [&](int k) {
        return glm::mix(table.ab[k * 128 + i], table.ab[k * 128 + i + 1], x - float(i));
    };
    return glm::mix(row(j), row(j + 1), y - float(j));
}

/// What a white surface sends back of L = ½ + slope(roughness) · direction.
glm::vec3 expected_light(const Case& c, glm::vec3 N, glm::vec3 V) {
    const glm::vec2 ab = table_at(c.NoV, c.roughness);
    const glm::vec3 F0 = brdf::base_reflectance(glm::vec3(1.0f), c.metallic);
    const LobeNode lobe =
        lobe_at(lobe_nodes(), c.NoV, c.roughness, brdf::fresnel_share(brdf::luminance(F0), ab));
    const glm::vec3 R = glm::reflect(-V, N);
    const bool four = c.quality == Quality::High;
    const LobeSweep& sweep = four ? lobe.four : lobe.two;
    const std::vector<float> standard = standard_roughness_levels();
    const float level = 15.0f * (1.0f + std::log10(c.roughness * std::exp2(sweep.log2_ratio)));
    const glm::vec3 irradiance = linear_radiance(N, linear_slope(1.0f));
    glm::vec3 P = sweep.irradiance * irradiance;
    for (const SweptLevel& each : swept_levels(sweep, level, four)) {
        const glm::vec3 d = brdf::swept_direction(R, N, each.kappa, c.roughness * c.roughness);
        const float roughness = standard[std::size_t(std::clamp(each.level, 0, 15))];
        P += each.weight * linear_radiance(glm::normalize(d), linear_slope(roughness));
    }
    const auto w = brdf::split_sum_weights(glm::vec3(1.0f), c.metallic, ab);
    return w.single * P + (w.multiple + w.diffuse) * irradiance;
}

TEST(FittedLobes, are_read_as_the_table_says) {
    for (const Case& c : kCases) {
        Scene scene = tilted_quad(linear_light(), c.NoV);
        scene.material.albedo.value = glm::vec3(1.0f);
        scene.material.metallic.value = c.metallic;
        scene.material.roughness.value = c.roughness;
        scene.view.quality = c.quality;
        const glm::vec3 seen = center(radiance_of(scene, glm::ivec2(129)));
        const glm::vec3 V = glm::normalize(camera_position(scene.camera));
        const glm::vec3 expected = expected_light(c, glm::vec3(0.0f, 0.0f, 1.0f), V);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(seen[i], expected[i], 3e-3f) << c.NoV << " " << c.roughness << " " << c.metallic;
    }
}

TEST(FittedLobes, mix_their_tables_between_white_metal_and_dielectric) {
    const glm::vec2 ab(0.7f, 0.1f);
    EXPECT_EQ(brdf::fresnel_share(1.0f, ab), 0.0f);
    EXPECT_NEAR(brdf::fresnel_share(0.04f, ab), 1.0f, 1e-6f);
    float last = 1.0f;
    for (float f0 = 0.05f; f0 < 1.0f; f0 += 0.05f) {
        EXPECT_LT(brdf::fresnel_share(f0, ab), last);
        last = brdf::fresnel_share(f0, ab);
    }
    EXPECT_EQ(brdf::fresnel_share(0.0f, ab), 1.0f);  // darker than any fitted one
    EXPECT_NEAR(brdf::fresnel_share(0.5f, glm::vec2(1.0f, 0.0f)), 0.5f * 0.04f / (0.96f * 0.5f), 1e-5f);
}

/// How much a curve of values bends between neighbours, relative to its mean.
float largest_bend(const std::vector<float>& values) {
    float bend = 0.0f, sum = 0.0f;
    for (std::size_t i = 1; i + 1 < values.size(); ++i)
        bend = std::max(bend, std::abs(values[i - 1] - 2.0f * values[i] + values[i + 1]));
    for (const float v : values) sum += v;
    return bend / (sum / float(values.size()));
}

TEST(FittedLobes, change_smoothly_with_roughness) {
    for (const Quality quality : {Quality::Standard, Quality::High}) {
        for (const float NoV : {0.15f, 0.5f, 0.9f}) {
            Scene scene = tilted_quad(linear_light(), NoV);
            scene.material.metallic.value = 1.0f;
            scene.view.quality = quality;
            std::vector<float> sweep;
            for (int i = 0; i <= 60; ++i) {
                scene.material.roughness.value = 0.1f + 0.015f * float(i);
                sweep.push_back(center(radiance_of(scene, glm::ivec2(9))).x);
            }
            EXPECT_LT(largest_bend(sweep), 0.025f) << NoV;
        }
    }
}

/// A dim sky with one sun, as the renderer gets it: its compact light apart, or left in.
struct SunLight {
    Environment environment = make_panorama(
        [](glm::vec3 d) {
            const bool sun = glm::dot(d, glm::normalize(glm::vec3(0.5f, 0.6f, 0.8f))) > 0.99985f;
            return glm::vec3(0.3f) + 0.2f * d + (sun ? glm::vec3(9e3f, 8e3f, 6e3f) : glm::vec3(0.0f));
        },
        1024);

    EnvironmentHandle upload(bool apart) const {
        BakeSettings settings;
        settings.extract_lights = apart;
        const auto baked = bake_environment(environment, settings, {});
        EXPECT_EQ(baked->lights.empty(), !apart);
        return renderer().upload_environment(environment, *baked);
    }
};
const SunLight& sun_light() {
    static const SunLight light;
    return light;
}

double mean_of(const Image& image) {
    double sum = 0.0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) sum += texel(image, x, y, 0);
    return sum / (double(image.width) * image.height);
}

TEST(ExtractedLights, are_neither_lost_nor_counted_twice_at_any_roughness) {
    const EnvironmentHandle apart = sun_light().upload(true), left_in = sun_light().upload(false);
    Scene scene = make_scene(apart, sphere());
    scene.view.shading = Shading::SplitSum;  // whose lobe is the levels' own
    scene.view.background = Background::Plain;
    scene.view.plain_color = glm::vec3(0.0f);
    for (const float metallic : {1.0f, 0.0f}) {
        for (const float roughness : {0.0f, 0.02f, 0.045f, 0.07f, 0.095f, 0.12f, 0.3f}) {
            scene.material.metallic.value = metallic;
            scene.material.roughness.value = roughness;
            scene.environment = apart;
            const double seen = mean_of(radiance_of(scene, glm::ivec2(192), 4));
            scene.environment = left_in;
            const double expected = mean_of(radiance_of(scene, glm::ivec2(192), 4));
            // A small light meets the exact model, the levels their lobe of N = V: they agree on the whole
            // only.
            EXPECT_NEAR(seen / expected, 1.0, 0.12) << metallic << " " << roughness;
        }
    }
}

TEST(ExtractedLights, are_seen_in_the_background_as_they_are_in_the_picture) {
    const EnvironmentHandle apart = sun_light().upload(true);
    Scene scene = make_scene(apart, nullptr);
    const glm::vec3 sun = glm::normalize(glm::vec3(0.5f, 0.6f, 0.8f));
    scene.camera.pitch_deg = glm::degrees(std::asin(-sun.y));
    scene.camera.yaw_deg = glm::degrees(std::atan2(-sun.x, -sun.z));
    scene.camera.fov_deg = 3.0f;
    const glm::vec3 seen = center(radiance_of(scene, glm::ivec2(65)));
    const glm::vec3 expected = glm::vec3(0.3f) + 0.2f * sun + glm::vec3(9e3f, 8e3f, 6e3f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / expected[c], 1.0f, 0.01f);
    scene.view.background = Background::Blurred;
    const glm::vec3 blurred = center(radiance_of(scene, glm::ivec2(65)));
    scene.environment = sun_light().upload(false);
    const glm::vec3 left_in = center(radiance_of(scene, glm::ivec2(65)));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(blurred[c] / left_in[c], 1.0f, 0.02f);
}

/// Relative rms error of a small sphere in sun_light against the integral over its pixels.
double small_sphere_error(float roughness, int side_px) {
    Scene scene = make_scene(sun_light().upload(true), sphere());
    scene.view.background = Background::Plain;
    scene.material.metallic.value = 1.0f;
    scene.material.albedo.value = glm::vec3(1.0f);
    scene.material.roughness.value = roughness;
    Reference reference(renderer(), glm::ivec2(side_px), {.max_samples = 1024, .tolerance = 0.0});
    reference.restart(scene);
    reference.finish();
    const TargetHandle target = renderer().make_target(glm::ivec2(side_px), 1, TargetPrecision::Full);
    reference.write(*target);
    return picture_error(radiance_of(scene, glm::ivec2(side_px)), renderer().read_radiance(*target),
                         reference.inner_pixels())
        .rms;
}

TEST(ExtractedLights, are_as_wide_as_the_pixels_of_a_small_sphere_make_them) {
    // Around the sun's highlight lies the dark tail of a narrow lobe: too wide a lobe errs by a multiple of
    // it.
    for (const float roughness : {0.06f, 0.1f, 0.2f})
        EXPECT_LT(small_sphere_error(roughness, 64), 0.06) << roughness;
}

TEST(Occlusion, follows_its_formulas_and_leaves_open_surfaces_alone) {
    for (const float NoV : {0.05f, 0.5f, 1.0f})
        for (const float alpha : {0.0f, 0.3f, 1.0f}) {
            EXPECT_NEAR(brdf::specular_occlusion(NoV, 1.0f, alpha), 1.0f, 1e-6f);
            EXPECT_EQ(brdf::specular_occlusion(NoV, 0.0f, alpha), 0.0f);
        }
    EXPECT_NEAR(brdf::multi_bounce_occlusion(1.0f, glm::vec3(0.7f)).x, 1.0f, 1e-3f);
    const glm::vec3 open = brdf::multi_bounce_occlusion(0.4f, glm::vec3(0.0f, 0.5f, 1.0f));
    EXPECT_NEAR(open.x, 0.4f, 0.02f);  // black lights nothing
    EXPECT_GT(open.y, open.x);
    EXPECT_GT(open.z, open.y);
    EXPECT_LT(open.z, 1.0f);
}

}  // namespace
}  // namespace patina

#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

using namespace test;

constexpr glm::ivec2 kSize{96, 96};

/// Turned by ψ about +Y, counter-clockwise seen from above, the environment shows in direction d what it had
/// at the direction turned back.
glm::vec3 turned_back(glm::vec3 d, float degrees) {
    const float a = glm::radians(degrees);
    return {d.x * std::cos(a) - d.z * std::sin(a), d.y, d.x * std::sin(a) + d.z * std::cos(a)};
}

/// Compares every pixel with the light its ray brings: straight from the environment, or mirrored by the unit
/// sphere.
void expect_directions(const Scene& scene, bool mirrored) {
    const Image image = radiance_of(scene, kSize);
    const glm::vec3 eye = camera_position(scene.camera);
    int seen = 0;
    for (int y = 0; y < kSize.y; ++y) {
        for (int x = 0; x < kSize.x; ++x) {
            glm::vec3 d = ray_through(scene.camera, kSize, x, y);
            if (mirrored) {
                const float t = hit_unit_sphere(eye, d);
                if (t < 0.0f) continue;
                const glm::vec3 normal = eye + t * d;
                if (glm::dot(normal, -d) < 0.25f) continue;  // towards the rim a pixel sees too wide an angle
                d = glm::reflect(d, normal);
            }
            const glm::vec3 expected = linear_radiance(turned_back(d, scene.view.env_rotation_deg));
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(pixel(image, x, y)[c], expected[c], 6e-3f) << x << "," << y;
            ++seen;
        }
    }
    EXPECT_GT(seen, 3000);
}

TEST(Orientation, the_background_shows_each_direction_where_it_lies) {
    Scene scene = make_scene(linear_light(), nullptr);
    for (const glm::vec3 pose :
         {glm::vec3(0, 0, 0), glm::vec3(90, 0, 0), glm::vec3(200, 40, 30), glm::vec3(10, -80, 90)}) {
        scene.camera.yaw_deg = pose.x;
        scene.camera.pitch_deg = pose.y;
        scene.view.env_rotation_deg = pose.z;
        expect_directions(scene, false);
    }
}

TEST(Orientation, a_mirror_ball_reflects_each_direction_from_where_it_lies) {
    Scene scene = make_scene(linear_light(), sphere());
    scene.material.albedo.value = glm::vec3(1.0f);
    scene.material.metallic.value = 1.0f;
    scene.material.roughness.value = 0.0f;
    for (const glm::vec3 pose : {glm::vec3(0, 0, 0), glm::vec3(120, -30, 0), glm::vec3(-70, 50, 90)}) {
        scene.camera.yaw_deg = pose.x;
        scene.camera.pitch_deg = pose.y;
        scene.view.env_rotation_deg = pose.z;
        expect_directions(scene, true);
    }
}

TEST(Orientation, a_quarter_turn_moves_what_lay_ahead_to_the_left) {
    // Only −Z shines.
    const auto light = renderer().upload_environment(
        make_panorama([](glm::vec3 d) { return glm::vec3(d.z < -0.9f ? 1.0f : 0.0f); }, 256),
        make_baked([](glm::vec3, float) { return glm::vec3(0.0f); }));
    Scene scene = make_scene(light, nullptr);
    EXPECT_NEAR(center(radiance_of(scene)).x, 1.0f, 1e-3f);  // the default camera looks along −Z
    scene.view.env_rotation_deg = 90.0f;
    EXPECT_NEAR(center(radiance_of(scene)).x, 0.0f, 1e-3f);
    scene.camera.yaw_deg = 90.0f;  // from +X, along −X
    EXPECT_NEAR(center(radiance_of(scene)).x, 1.0f, 1e-3f);
}

TEST(Orientation, rough_and_diffuse_light_come_from_the_same_side_as_the_mirror_image) {
    Scene scene = make_scene(linear_light(), quad());
    scene.material.albedo.value = glm::vec3(1.0f);
    scene.material.metallic.value = 1.0f;
    scene.view.env_rotation_deg = 90.0f;
    const auto front = turned_back({0, 0, 1}, 90.0f);
    for (const float roughness : {0.0f, 0.05f, 0.1f, 0.12f, 0.3f, 0.77f, 1.0f}) {
        scene.material.roughness.value = roughness;
        scene.view.debug = DebugView::Specular;
        const glm::vec3 seen = center(radiance_of(scene, glm::ivec2(65)));
        // A white metal returns single-scattered light of the level and the rest of the irradiance: between
        // the two.
        for (int c = 0; c < 3; ++c) {
            const float level = linear_radiance(front, linear_slope(std::max(roughness, 0.1f)))[c];
            const float mirror = linear_radiance(front)[c];
            const float diffuse = linear_radiance(front, linear_slope(1.0f))[c];
            EXPECT_GE(seen[c], std::min({level, mirror, diffuse}) - 2e-3f) << roughness;
            EXPECT_LE(seen[c], std::max({level, mirror, diffuse}) + 2e-3f) << roughness;
        }
    }
}

TEST(Orientation, the_quad_shows_a_picture_upright_and_unmirrored) {
    // Red upper left, green upper right, blue lower left, white lower right.
    const Image picture = make_picture(64, 64, [](int x, int y) {
        if (y < 32) return x < 32 ? glm::ivec3(255, 0, 0) : glm::ivec3(0, 255, 0);
        return x < 32 ? glm::ivec3(0, 0, 255) : glm::ivec3(255, 255, 255);
    });
    Scene scene = make_scene(nullptr, quad());
    scene.maps[std::size_t(MapSlot::Albedo)] =
        renderer().upload_map(make_map_levels(picture, MapKind::Color, ColorSpace::Srgb));
    scene.material.albedo.value = glm::vec3(1.0f);
    scene.view.debug = DebugView::Albedo;
    const Image seen = display_of(scene, glm::ivec2(64));
    EXPECT_EQ(pixel(seen, 20, 20), glm::vec3(1, 0, 0));
    EXPECT_EQ(pixel(seen, 44, 20), glm::vec3(0, 1, 0));
    EXPECT_EQ(pixel(seen, 20, 44), glm::vec3(0, 0, 1));
    EXPECT_EQ(pixel(seen, 44, 44), glm::vec3(1, 1, 1));
    // Turned a quarter counter-clockwise, what was at the upper left is at the lower left.
    scene.material.uv.rotation_deg = 90.0f;
    const Image turned = display_of(scene, glm::ivec2(64));
    EXPECT_EQ(pixel(turned, 20, 44), glm::vec3(1, 0, 0));
    EXPECT_EQ(pixel(turned, 20, 20), glm::vec3(0, 1, 0));
    // Moving the coordinates by half a picture brings the right half to the left.
    scene.material.uv = {};
    scene.material.uv.offset = {0.5f, 0.0f};
    EXPECT_EQ(pixel(display_of(scene, glm::ivec2(64)), 20, 20), glm::vec3(0, 1, 0));
    // Twice the scale, twice as many: all four quarters within the lower left one.
    scene.material.uv = {};
    scene.material.uv.scale = glm::vec2(2.0f);
    const Image twice = display_of(scene, glm::ivec2(64));
    EXPECT_EQ(pixel(twice, 14, 38), glm::vec3(1, 0, 0));
    EXPECT_EQ(pixel(twice, 26, 50), glm::vec3(1, 1, 1));
}

}  // namespace
}  // namespace patina

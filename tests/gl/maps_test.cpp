#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

using namespace test;

MapHandle upload(const Image& image, MapKind kind, ColorSpace color_space = ColorSpace::Srgb) {
    return renderer().upload_map(make_map_levels(image, kind, color_space));
}

Scene flat_scene(DebugView view) {
    Scene scene = make_scene(nullptr, quad());
    scene.view.debug = view;
    scene.material.albedo.value = glm::vec3(1.0f);
    scene.material.roughness.value = 1.0f;
    scene.material.metallic.value = 1.0f;
    return scene;
}

/// Distance at which the quad (2 × 2) fills the picture's height.
constexpr float kFilling = 3.7320508f;

TEST(Maps, an_srgb_picture_comes_back_byte_for_byte) {
    // 16 × 16 cells hold all bytes in red, backwards in green, shuffled in blue; each cell is 8 pixels on
    // screen.
    const Image picture = make_picture(16, 16, [](int x, int y) {
        const int i = 16 * y + x;
        return glm::ivec3(i, 255 - i, i * 167 % 256);
    });
    Scene scene = flat_scene(DebugView::Albedo);
    scene.camera.distance = kFilling;
    scene.maps[std::size_t(MapSlot::Albedo)] = upload(picture, MapKind::Color);
    for (const int samples : {1, 4}) {
        const Image seen = display_of(scene, glm::ivec2(16 * 9), samples);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                for (int c = 0; c < 3; ++c)
                    EXPECT_EQ(std::lround(255 * texel(seen, 9 * x + 4, 9 * y + 4, c)),
                              std::lround(255 * texel(picture, x, y, c)))
                        << x << "," << y << "," << c;
    }
}

TEST(Maps, scalars_come_from_their_channel_multiplied_and_inverted) {
    const Image picture = make_picture(4, 4, [](int, int) { return glm::ivec3(51, 102, 204); });
    Scene scene = flat_scene(DebugView::Roughness);
    const MapHandle map = upload(picture, MapKind::Data);
    scene.maps[std::size_t(MapSlot::Roughness)] = map;
    scene.maps[std::size_t(MapSlot::Metallic)] = map;
    scene.maps[std::size_t(MapSlot::Ao)] = map;
    const auto seen = [&] { return int(std::lround(255 * center(display_of(scene, glm::ivec2(32))).x)); };
    scene.material.roughness.channel = Channel::G;
    EXPECT_EQ(seen(), 102);
    scene.material.roughness.invert = true;
    EXPECT_EQ(seen(), 153);
    scene.material.roughness.value = 0.5f;
    EXPECT_NEAR(seen(), 76.5, 0.6);
    scene.view.debug = DebugView::Metallic;
    EXPECT_EQ(seen(), 204);
    scene.view.debug = DebugView::Ao;
    EXPECT_EQ(seen(), 51);
}

TEST(Maps, any_channel_of_a_grey_picture_is_its_grey) {
    Image grey = make_image(4, 4, 1, PixelType::U8);
    for (int i = 0; i < 16; ++i) set_texel(grey, i % 4, i / 4, 0, 0.2f);
    Scene scene = flat_scene(DebugView::Roughness);
    scene.maps[std::size_t(MapSlot::Roughness)] = upload(grey, MapKind::Data);
    for (const Channel channel : {Channel::R, Channel::G, Channel::B}) {
        scene.material.roughness.channel = channel;
        EXPECT_NEAR(center(display_of(scene, glm::ivec2(32))).x, 0.2f, 1e-6f);
    }
    scene.maps[std::size_t(MapSlot::Albedo)] = upload(grey, MapKind::Color);
    scene.view.debug = DebugView::Albedo;
    EXPECT_NEAR(center(display_of(scene, glm::ivec2(32))).y, 0.2f, 1e-6f);
}

TEST(Maps, values_multiply_colours_in_linear_light) {
    const Image picture = make_picture(4, 4, [](int, int) { return glm::ivec3(188, 255, 0); });
    Scene scene = flat_scene(DebugView::Albedo);
    scene.maps[std::size_t(MapSlot::Albedo)] = upload(picture, MapKind::Color);
    scene.material.albedo.value = {0.5f, 0.25f, 1.0f};
    const glm::vec3 seen = center(radiance_of(scene, glm::ivec2(32)));
    EXPECT_NEAR(seen.x, 0.5f * srgb_to_linear(188.0f / 255.0f), 1e-3f);
    EXPECT_NEAR(seen.y, 0.25f, 1e-3f);
}

/// A floating-point map holds radiance as it is, beyond 1 too.
TEST(Maps, an_emission_map_in_floats_keeps_its_range) {
    Image picture = make_image(2, 2, 3, PixelType::F32);
    for (int i = 0; i < 4; ++i) set_texel(picture, i % 2, i / 2, 0, 37.5f);
    Scene scene = flat_scene(DebugView::Final);
    scene.maps[std::size_t(MapSlot::Emission)] = upload(picture, MapKind::Color);
    scene.material.emission.value = glm::vec3(2.0f);
    EXPECT_NEAR(center(radiance_of(scene, glm::ivec2(32))).x, 75.0f, 0.1f);
}

/// A round bump as an OpenGL normal map: green grows upwards.
Image bump(bool green_up) {
    return make_picture(128, 128, [&](int x, int y) {
        const glm::vec2 p((float(x) + 0.5f) / 64.0f - 1.0f, 1.0f - (float(y) + 0.5f) / 64.0f);
        glm::vec3 n(0.0f, 0.0f, 1.0f);
        if (glm::length(p) < 0.9f) n = glm::vec3(p, std::sqrt(1.0f - glm::dot(p, p)));
        if (!green_up) n.y = -n.y;
        return glm::ivec3(glm::round(255.0f * (0.5f * n + 0.5f)));
    });
}

/// The normals of a picture, as they are shaded, at points of the quad.
glm::vec3 normal_at(const Image& seen, int x, int y) { return 2.0f * pixel(seen, x, y) - 1.0f; }

void expect_bump(const Scene& scene) {
    Scene shown = scene;
    shown.camera.distance = kFilling;
    shown.view.debug = DebugView::Normal;
    const Image seen = display_of(shown, glm::ivec2(128));
    EXPECT_LT(normal_at(seen, 32, 64).x, -0.3f);  // its left side faces left
    EXPECT_GT(normal_at(seen, 96, 64).x, 0.3f);
    EXPECT_GT(normal_at(seen, 64, 32).y, 0.3f);  // its upper side faces up
    EXPECT_LT(normal_at(seen, 64, 96).y, -0.3f);
    // The light: L grows to the left in the map of linear_light turned so that −X is bright.
    shown.view.debug = DebugView::Diffuse;
    shown.environment = linear_light();
    shown.view.env_rotation_deg = 180.0f;
    const Image lit = radiance_of(shown, glm::ivec2(128));
    EXPECT_GT(pixel(lit, 32, 64).x, pixel(lit, 96, 64).x + 0.02f);
    EXPECT_GT(pixel(lit, 64, 32).y, pixel(lit, 64, 96).y + 0.02f);
}

TEST(NormalMaps, light_from_the_left_and_above_lights_the_left_and_upper_side_of_a_bump) {
    Scene scene = flat_scene(DebugView::Final);
    scene.material.metallic.value = 0.0f;
    scene.maps[std::size_t(MapSlot::Normal)] = upload(bump(true), MapKind::Normal);
    expect_bump(scene);
}

TEST(NormalMaps, a_directx_map_read_as_one_looks_the_same) {
    Scene scene = flat_scene(DebugView::Final);
    scene.material.metallic.value = 0.0f;
    scene.material.normal.convention = NormalConvention::DirectX;
    scene.maps[std::size_t(MapSlot::Normal)] = upload(bump(false), MapKind::Normal);
    expect_bump(scene);
}

TEST(NormalMaps, a_bump_stays_a_bump_however_the_picture_is_turned_and_mirrored) {
    Scene scene = flat_scene(DebugView::Final);
    scene.material.metallic.value = 0.0f;
    scene.maps[std::size_t(MapSlot::Normal)] = upload(bump(true), MapKind::Normal);
    for (const float degrees : {90.0f, 180.0f, 270.0f}) {
        scene.material.uv.rotation_deg = degrees;
        expect_bump(scene);
    }
    scene.material.uv.rotation_deg = 0.0f;
    for (const glm::vec2 scale : {glm::vec2(-1, 1), glm::vec2(1, -1), glm::vec2(-1, -1)}) {
        scene.material.uv.scale = scale;
        expect_bump(scene);
    }
}

TEST(NormalMaps, work_without_tangents_too) {
    Mesh mesh = builtin_meshes()[1].make();
    ASSERT_EQ(mesh.name, "quad");
    ASSERT_FALSE(mesh.has_tangents);
    Scene scene = flat_scene(DebugView::Final);
    scene.mesh = renderer().upload_mesh(mesh);
    scene.material.metallic.value = 0.0f;
    scene.maps[std::size_t(MapSlot::Normal)] = upload(bump(true), MapKind::Normal);
    expect_bump(scene);
}

TEST(NormalMaps, value_scales_the_slope_and_nought_is_flat) {
    const Image slope = make_picture(4, 4, [](int, int) { return glm::ivec3(204, 128, 230); });
    Scene scene = flat_scene(DebugView::Normal);
    scene.maps[std::size_t(MapSlot::Normal)] = upload(slope, MapKind::Normal);
    const auto tangent = [&] {
        const glm::vec3 n = 2.0f * center(display_of(scene, glm::ivec2(32))) - 1.0f;
        return n.x / n.z;
    };
    const float full = tangent();
    EXPECT_NEAR(full, (2 * 204.0f / 255 - 1) / (2 * 230.0f / 255 - 1), 0.02f);
    scene.material.normal.value = 0.5f;
    EXPECT_NEAR(tangent(), 0.5f * full, 0.02f);
    scene.material.normal.value = 0.0f;
    EXPECT_NEAR(tangent(), 0.0f, 0.01f);
}

TEST(NormalMaps, the_back_of_the_quad_is_shaded_as_a_surface_facing_the_viewer) {
    Scene scene = flat_scene(DebugView::Normal);
    scene.camera.yaw_deg = 180.0f;
    const glm::vec3 n = 2.0f * center(display_of(scene, glm::ivec2(32))) - 1.0f;
    EXPECT_LT(n.z, -0.99f);
}

TEST(Maps, the_placeholder_is_seen_for_what_it_is) {
    Scene scene = flat_scene(DebugView::Albedo);
    scene.camera.distance = kFilling;
    scene.maps[std::size_t(MapSlot::Albedo)] = upload(make_placeholder_map(), MapKind::Color);
    const Image seen = display_of(scene, glm::ivec2(128));
    int magenta = 0;
    int black = 0;
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x) {
            magenta += pixel(seen, x, y) == glm::vec3(1, 0, 1) ? 1 : 0;
            black += pixel(seen, x, y) == glm::vec3(0) ? 1 : 0;
        }
    }
    EXPECT_GT(magenta, 128 * 128 / 4);
    EXPECT_GT(black, 128 * 128 / 4);
}

TEST(Maps, an_upload_in_portions_ends_in_the_same_picture) {
    const Image picture =
        make_picture(300, 173, [](int x, int y) { return glm::ivec3(x % 256, y, (x * y) % 256); });
    const MapLevels levels = make_map_levels(picture, MapKind::Color, ColorSpace::Srgb);
    Scene scene = flat_scene(DebugView::Albedo);
    scene.maps[std::size_t(MapSlot::Albedo)] = renderer().upload_map(levels);
    const Image at_once = display_of(scene);
    const Upload<GpuMap> upload = Renderer::begin_upload(std::make_shared<MapLevels>(levels));
    int steps = 1;
    while (!upload.step(10'000)) ++steps;
    EXPECT_GT(steps, 20);
    scene.maps[std::size_t(MapSlot::Albedo)] = upload.finish();
    EXPECT_EQ(display_of(scene).bytes, at_once.bytes);
}

TEST(Maps, seen_from_afar_a_fine_checkerboard_has_the_brightness_of_its_light) {
    const Image checker = make_picture(
        256, 256, [](int x, int y) { return (x + y) % 2 == 0 ? glm::ivec3(255) : glm::ivec3(0); });
    Scene scene = flat_scene(DebugView::Albedo);
    scene.camera.distance = 40.0f;
    scene.maps[std::size_t(MapSlot::Albedo)] = upload(checker, MapKind::Color);
    EXPECT_NEAR(center(radiance_of(scene, glm::ivec2(256))).x, 0.5f, 0.01f);
}

}  // namespace
}  // namespace patina

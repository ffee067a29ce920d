#include "renderer/brdf.h"
#include "renderer/gl/half.h"
#include "renderer/gl/light_levels.h"
#include "renderer/gl/mesh_prepare.h"
#include "renderer/needed_light.h"
#include "renderer/shaders/blocks.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

using namespace test;

/// Light that varies smoothly over the sphere: any jump in a picture of it is the renderer's.
glm::vec3 waves(glm::vec3 d) {
    return {1.0f + 0.5f * std::sin(5.0f * d.x + 1.0f), 1.0f + 0.5f * std::cos(4.0f * d.y - 2.0f * d.z),
            1.0f + 0.5f * std::sin(3.0f * d.z + 2.0f * d.x)};
}

EnvironmentHandle smooth_light() {
    static const EnvironmentHandle handle = renderer().upload_environment(
        make_panorama(waves, 1024), make_baked([](glm::vec3 d, float) { return waves(d); }, 32));
    return handle;
}

/// A camera inside nothing, looking along a direction with so narrow a view that neighbouring pixels see
/// nearly the same.
Camera towards(glm::vec3 d, float fov_deg) {
    Camera camera;
    d = glm::normalize(d);
    camera.pitch_deg = glm::degrees(std::asin(-d.y));
    camera.yaw_deg = glm::degrees(std::atan2(-d.x, -d.z));
    camera.fov_deg = fov_deg;
    return camera;
}

/// Largest relative difference between neighbouring pixels.
float largest_jump(const Image& image) {
    float jump = 0.0f;
    for (int y = 0; y + 1 < image.height; ++y) {
        for (int x = 0; x + 1 < image.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const float v = texel(image, x, y, c);
                jump = std::max({jump, std::abs(texel(image, x + 1, y, c) - v) / v,
                                 std::abs(texel(image, x, y + 1, c) - v) / v});
            }
        }
    }
    return jump;
}

TEST(Light, the_panorama_has_no_seam_behind_the_viewer_and_none_at_the_poles) {
    Scene scene = make_scene(smooth_light(), nullptr);
    for (const glm::vec3 d : {glm::vec3(0, 0, 1), glm::vec3(0.0f, 0.5f, 0.9f), glm::vec3(0.0f, -0.9f, 0.4f),
                              glm::vec3(0.0f, 1.0f, 1e-3f), glm::vec3(0.0f, -1.0f, 1e-3f)}) {
        scene.camera = towards(d, 0.8f);
        // At a pole the texels themselves, half a texel from it, differ by half a percent in this light.
        const float most = std::abs(d.y) == 1.0f ? 1e-2f : 1e-3f;
        EXPECT_LT(largest_jump(radiance_of(scene, glm::ivec2(64))), most) << d.x << " " << d.y << " " << d.z;
        scene.camera.fov_deg = 120.0f;  // minified: lower levels of the chain
        EXPECT_LT(largest_jump(radiance_of(scene, glm::ivec2(400))), 0.03f)
            << d.x << " " << d.y << " " << d.z;
    }
}

TEST(Light, prefiltered_levels_have_no_seam_at_the_twelve_edges_and_eight_corners) {
    Scene scene = make_scene(smooth_light(), nullptr);
    scene.view.background = Background::Blurred;
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                if (std::abs(x) + std::abs(y) + std::abs(z) < 2) continue;
                scene.camera = towards(glm::vec3(x, y, z), 0.8f);
                EXPECT_LT(largest_jump(radiance_of(scene, glm::ivec2(64))), 1e-3f)
                    << x << " " << y << " " << z;
            }
        }
    }
}

TEST(Light, prefiltered_levels_lie_where_their_directions_are) {
    Scene scene = make_scene(linear_light(), nullptr);
    scene.view.background = Background::Blurred;
    const float slope = linear_slope(0.35f);
    for (const glm::vec3 d : {glm::vec3(1, 0.1, 0.2), glm::vec3(-1, 0.3, 0), glm::vec3(0.2, 0.9, 0.1),
                              glm::vec3(-0.1, -0.9, 0.3), glm::vec3(0.3, 0.2, 1), glm::vec3(0.4, -0.2, -1)}) {
        scene.camera = towards(d, 1.0f);
        const glm::vec3 expected = linear_radiance(glm::normalize(d), slope);
        const glm::vec3 seen = center(radiance_of(scene, glm::ivec2(33)));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 3e-3f);
    }
}

TEST(Light, levels_are_mixed_in_the_logarithm_of_roughness) {
    // Each level is constant and holds its own log₂ r + 4, so what is read back is the position between
    // levels.
    const auto light = renderer().upload_environment(
        make_panorama([](glm::vec3) { return glm::vec3(1.0f); }, 16),
        make_baked([](glm::vec3, float r) { return glm::vec3(std::log2(r) + 4.0f); }, 16));
    Scene scene = make_scene(light, quad());
    scene.material.albedo.value = glm::vec3(1.0f);
    scene.material.metallic.value = 1.0f;
    scene.view.shading = Shading::SplitSum;
    for (const float r : {0.1f, 0.105f, 0.14f, 0.2f, 0.314f, 0.5f, 0.66f, 0.9f}) {
        scene.material.roughness.value = r;
        const glm::vec3 seen = center(radiance_of(scene, glm::ivec2(33)));
        // White metal: E_F of the level plus 1 − E_F of the irradiance, which is 4 here.
        const BrdfTable table = bake_brdf_table(64);
        const glm::vec2 ab = table.ab[std::size_t(std::min(int(r * 64), 63)) * 64 + 63];
        const float E = ab.x + ab.y;
        EXPECT_NEAR(seen.x, E * (std::log2(r) + 4.0f) + (1.0f - E) * 4.0f, 0.012f) << r;
    }
}

TEST(Light, there_is_no_step_where_the_sharpest_level_begins) {
    const auto radiance = [](glm::vec3 d) {
        return glm::vec3(0.2f + (d.x > 0.3f ? 3.0f : 0.0f) + (d.y > 0.9f ? 40.0f : 0.0f));
    };
    const Environment environment = make_panorama(radiance, 256);
    BakeSettings settings = drawing_bake_settings();
    settings.max_face_size = 64;
    const auto baked = bake_environment(environment, settings, {});
    Scene scene = make_scene(renderer().upload_environment(environment, *baked), sphere());
    scene.material.albedo.value = glm::vec3(1.0f);
    scene.material.metallic.value = 1.0f;
    const auto picture = [&](float roughness) {
        scene.material.roughness.value = roughness;
        return radiance_of(scene, glm::ivec2(96));
    };
    const auto difference = [](const Image& a, const Image& b) {
        double sum = 0.0;
        double total = 0.0;
        for (int y = 0; y < a.height; ++y) {
            for (int x = 0; x < a.width; ++x) {
                sum += std::abs(texel(a, x, y, 0) - texel(b, x, y, 0));
                total += texel(a, x, y, 0);
            }
        }
        return sum / total;
    };
    const auto expect_smooth = [&](float edge) {
        const double across = difference(picture(edge - 5e-4f), picture(edge + 5e-4f));
        const double above = difference(picture(edge + 5e-4f), picture(edge + 1.5e-3f));
        EXPECT_LT(across, 3.0 * above + 1e-3) << edge;
    };
    for (const Quality quality : {Quality::Standard, Quality::High}) {
        scene.view.quality = quality;
        expect_smooth(brdf::kCoreReach * kSharpestLevel);  // no samples of the panorama from there on
        expect_smooth(brdf::kSharpestFitted);
    }
    scene.view.shading = Shading::SplitSum;
    expect_smooth(kSharpestLevel);
    scene.view.shading = Shading::Fitted;
    // And towards the mirror: the lobe closes continuously.
    EXPECT_LT(difference(picture(0.0f), picture(1e-3f)), 1e-3);
    EXPECT_LT(difference(picture(0.0f), picture(5e-3f)), 0.02);
}

TEST(Light, a_sharp_lobe_keeps_the_light_of_what_it_covers) {
    // Inside a wide uniform patch every lobe narrower than it sees the patch.
    const auto radiance = [](glm::vec3 d) { return glm::vec3(d.z > 0.5f ? 2.0f : 0.0f); };
    const auto light = renderer().upload_environment(
        make_panorama(radiance, 512), make_baked([&](glm::vec3 d, float) { return radiance(d); }, 32));
    Scene scene = make_scene(light, quad());
    scene.material.albedo.value = glm::vec3(1.0f);
    scene.material.metallic.value = 1.0f;
    scene.view.debug = DebugView::Specular;
    for (const float roughness : {0.0f, 0.01f, 0.03f, 0.06f, 0.09f}) {
        scene.material.roughness.value = roughness;
        EXPECT_NEAR(center(radiance_of(scene, glm::ivec2(33))).x, 2.0f, 0.01f) << roughness;
    }
}

TEST(Light, an_upload_in_portions_ends_in_the_same_picture) {
    const auto radiance = [](glm::vec3 d) { return glm::vec3(1.0f + d.x, 1.0f + d.y, 1.0f + d.z); };
    const Environment environment = make_panorama(radiance, 256);
    const BakedEnvironment baked = make_baked([&](glm::vec3 d, float r) { return r * radiance(d); }, 32);
    Scene scene = make_scene(renderer().upload_environment(environment, baked), sphere());
    const Image at_once = radiance_of(scene);
    const auto light = std::make_shared<PreparedLight>(
        PreparedLight{make_panorama_levels(environment), make_light_levels(baked)});
    const Upload<GpuEnvironment> upload = Renderer::begin_upload(light);
    int steps = 1;
    while (!upload.step(20'000)) ++steps;
    EXPECT_GT(steps, 12);
    scene.environment = upload.finish();
    EXPECT_EQ(radiance_of(scene).bytes, at_once.bytes);
}

TEST(Mesh, an_upload_in_portions_ends_in_the_same_picture) {
    Scene scene = make_scene(linear_light(), nullptr);
    const Mesh torus = builtin_meshes()[3].make();
    scene.mesh = renderer().upload_mesh(torus);
    const Image at_once = radiance_of(scene);
    const Upload<GpuMesh> upload =
        Renderer::begin_upload(std::make_shared<PreparedMesh>(prepare_mesh(torus)));
    int steps = 1;
    while (!upload.step(50'000)) ++steps;
    EXPECT_GT(steps, 5);
    scene.mesh = upload.finish();
    EXPECT_EQ(radiance_of(scene).bytes, at_once.bytes);
}

TEST(Panorama, levels_keep_the_mean_of_every_row_and_agree_at_the_poles) {
    const Environment environment = make_panorama([](glm::vec3 d) { return waves(d); }, 64);
    const PanoramaLevels levels = make_panorama_levels(environment);
    EXPECT_EQ(levels.levels.size(), 7u);
    EXPECT_EQ(levels.levels.back().width, 1);
    EXPECT_EQ(levels.exponent, half_exponent(1.5f));
    const PanoramaLevels narrow = make_panorama_levels(environment, 16);
    EXPECT_EQ(narrow.levels[0].width, 16);
}

TEST(Panorama, the_exponent_fills_a_half_float_without_overflow) {
    for (const float largest : {1e-20f, 1e-3f, 1.0f, 65504.0f, 1e6f, 3e38f}) {
        const float stored = std::ldexp(largest, -half_exponent(largest));
        EXPECT_LE(stored, 32768.0f) << largest;
        EXPECT_GT(stored, 16383.0f) << largest;
    }
    EXPECT_EQ(half_exponent(0.0f), 0);
}

TEST(Panorama, halves_round_to_nearest_even) {
    EXPECT_EQ(gl::to_half(0.0f), 0x0000);
    EXPECT_EQ(gl::to_half(1.0f), 0x3c00);
    EXPECT_EQ(gl::to_half(-2.0f), 0xc000);
    EXPECT_EQ(gl::to_half(65504.0f), 0x7bff);
    EXPECT_EQ(gl::to_half(1.0f + 0x1p-11f), 0x3c00);  // halfway: to even
    EXPECT_EQ(gl::to_half(1.0f + 3 * 0x1p-11f), 0x3c02);
    EXPECT_EQ(gl::to_half(0x1p-14f), 0x0400);  // smallest normal
    EXPECT_EQ(gl::to_half(0x1p-24f), 0x0001);  // smallest subnormal
    EXPECT_EQ(gl::to_half(0x1p-26f), 0x0000);
}

TEST(Levels, the_fewest_layers_that_give_each_level_its_size) {
    EXPECT_EQ(layers_for({64}), 1);
    EXPECT_EQ(layers_for({128, 64, 32}), 1);
    EXPECT_EQ(layers_for({128, 128, 64, 64, 32}), 2);
    EXPECT_EQ(layers_for({128, 128, 128, 128, 128, 64, 64, 64, 64, 64, 64, 64, 32, 32, 32, 32}), 6);
    EXPECT_EQ(layers_for({64, 64, 64}), 3);
}

TEST(Levels, enlarging_a_cube_keeps_smooth_light_and_has_no_seams) {
    CubeMap cube{16, {}};
    for (int row = 0; row < 96; ++row)
        for (int x = 0; x < 16; ++x)
            cube.texels.push_back(linear_radiance(cube_texel_direction(16, row / 16, x, row % 16)));
    const CubeMap large = enlarged(cube, 64);
    for (int row = 0; row < 6 * 64; ++row) {
        for (int x = 0; x < 64; ++x) {
            const glm::vec3 expected = linear_radiance(cube_texel_direction(64, row / 64, x, row % 64));
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(large.texels[std::size_t(row) * 64 + x][c], expected[c], 8e-3f)
                    << row << "," << x;
        }
    }
}

TEST(Light, levels_far_apart_get_others_between) {
    const auto level = [](float roughness, int size, float light) {
        return PrefilteredLevel{
            roughness, {size, std::vector<glm::vec3>(std::size_t(6) * size * size, glm::vec3(light))}};
    };
    const auto closed = close_gaps({level(0.1f, 8, 1.0f), level(0.11f, 8, 2.0f), level(0.4f, 4, 3.0f)});
    ASSERT_EQ(closed.size(), 11u);  // log(0.4/0.11)/log(10) · 15 = 8.4
    for (std::size_t i = 1; i < closed.size(); ++i) {
        const float ratio = closed[i].roughness / closed[i - 1].roughness;
        EXPECT_GT(ratio, 1.0f);
        EXPECT_LT(ratio, std::pow(10.0f, 1.0f / 15.0f) + 1e-4f);
        EXPECT_EQ(closed[i].cube.size, i + 1 < closed.size() ? 8 : 4);
    }
    EXPECT_NEAR(closed[5].roughness, 0.11f * std::pow(0.4f / 0.11f, 4.0f / 9.0f), 1e-6f);
    EXPECT_NEAR(closed[5].cube.texels[0].x, 2.0f + 4.0f / 9.0f, 1e-5f);
    std::vector<PrefilteredLevel> standard;
    for (const float roughness : standard_roughness_levels()) standard.push_back(level(roughness, 1, 0.0f));
    EXPECT_EQ(close_gaps(standard).size(), standard.size());
    // More than the shaders hold is never made.
    std::vector<PrefilteredLevel> many;
    for (int i = 0; i < 30; ++i) many.push_back(level(0.01f * float(i + 1), 1, 0.0f));
    many.push_back(level(1.0f, 1, 0.0f));
    EXPECT_EQ(close_gaps(many).size(), std::size_t(blocks::kMaxLevels));
}

TEST(Meshes, are_closed_where_nothing_can_be_seen_from_inside) {
    for (const BuiltinMesh& builtin : builtin_meshes()) {
        const Mesh mesh = builtin.make();
        const bool expected = builtin.id != "quad";
        EXPECT_EQ(is_closed(mesh.vertices, mesh.indices), expected) << builtin.id;
        if (!expected) continue;
        Mesh open = mesh;
        open.indices.resize(open.indices.size() - 3);
        EXPECT_FALSE(is_closed(open.vertices, open.indices)) << builtin.id;
        Mesh inside_out = mesh;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            std::swap(inside_out.indices[i], inside_out.indices[i + 1]);
        EXPECT_FALSE(is_closed(inside_out.vertices, inside_out.indices)) << builtin.id;
    }
}

TEST(Meshes, wound_against_their_normals_look_the_same) {
    Mesh mesh = builtin_meshes()[0].make();
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i], mesh.indices[i + 1]);
    Scene scene = make_scene(linear_light(), sphere());
    const Image expected = radiance_of(scene, glm::ivec2(64));
    scene.mesh = renderer().upload_mesh(mesh);
    const Image seen = radiance_of(scene, glm::ivec2(64));
    for (int i = 8; i < 56; ++i) EXPECT_NEAR(pixel(seen, i, 32).x, pixel(expected, i, 32).x, 2e-3f) << i;
}

}  // namespace
}  // namespace patina

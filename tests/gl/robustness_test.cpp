#include "app/headless.h"
#include "renderer/gl/handles.h"
#include "tests/gl/scene.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace patina {
namespace {

using namespace test;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

void expect_sane(const Image& image, const char* what) {
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < image.channels; ++c) {
                const float v = texel(image, x, y, c);
                ASSERT_TRUE(std::isfinite(v) && v >= 0.0f) << what << ": " << v << " at " << x << "," << y;
            }
        }
    }
}

/// A grid of triangles over the picture whose attributes are ordinary, extreme or broken.
Mesh broken_mesh(std::mt19937& random) {
    const float odd[] = {0.0f, -0.0f, 1e-30f, -1e-8f, 1.0f, -1.0f, 1e20f, kNan, kInf, -kInf};
    const auto any = [&] { return odd[random() % std::size(odd)]; };
    const auto some = [&](float usual) { return random() % 3 == 0 ? any() : usual; };
    Mesh mesh;
    constexpr int kSide = 24;
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::vec2 corner(float(i % kSide) / 12.0f - 1.0f, float(i / kSide) / 12.0f - 1.0f);
        for (int k = 0; k < 3; ++k) {
            Vertex v;
            v.position = glm::vec3(corner + glm::vec2(k == 1, k == 2) / 12.0f, 0.0f);
            v.normal = {some(0.0f), some(0.0f), some(1.0f)};
            v.uv = {some(0.3f), some(0.6f)};
            v.tangent = {some(1.0f), some(0.0f), some(0.0f), some(1.0f)};
            mesh.vertices.push_back(v);
            mesh.indices.push_back(std::uint32_t(mesh.indices.size()));
        }
    }
    mesh.has_tangents = random() % 2 == 0;
    return mesh;
}

Image broken_map(std::mt19937& random) {
    Image image = make_image(8, 8, 4, PixelType::F32);
    const float odd[] = {0.0f, 1.0f, -1.0f, 0.5f, 1e30f, -1e30f, kNan, kInf, -kInf};
    for (int i = 0; i < 256; ++i) set_texel(image, i / 4 % 8, i / 32, i % 4, odd[random() % std::size(odd)]);
    return image;
}

TEST(Robustness, no_pixel_is_nan_infinite_or_negative_whatever_the_mesh_and_maps_hold) {
    std::mt19937 random(7);
    for (int round = 0; round < 12; ++round) {
        Scene scene = make_scene(linear_light(), renderer().upload_mesh(broken_mesh(random)));
        for (MapHandle& map : scene.maps)
            if (random() % 2 == 0)
                map = renderer().upload_map(
                    make_map_levels(broken_map(random), MapKind::Data, ColorSpace::Linear));
        scene.material.metallic.value = float(random() % 2);
        scene.material.roughness.value = float(random() % 3) * 0.5f;
        scene.material.emission.value = glm::vec3(float(random() % 2));
        scene.material.normal.value = 2.0f;
        scene.view.shading = kShadings[random() % kShadings.size()].value;
        scene.view.quality = kQualities[random() % kQualities.size()].value;
        scene.view.debug =
            round % 3 == 0 ? kDebugViews[random() % kDebugViews.size()].value : DebugView::Final;
        scene.camera.yaw_deg = round % 2 == 0 ? 0.0f : 179.0f;
        expect_sane(radiance_of(scene, glm::ivec2(48), round % 4 == 0 ? 4 : 1), "fuzz");
    }
}

TEST(Robustness, mapped_normals_that_face_away_are_bent_towards_the_viewer) {
    Image away = make_picture(1, 1, [](int, int) { return glm::ivec3(255, 128, 0); });  // below the surface
    Scene scene = make_scene(constant_light(1.0f), sphere());
    scene.maps[std::size_t(MapSlot::Normal)] =
        renderer().upload_map(make_map_levels(away, MapKind::Normal, ColorSpace::Linear));
    scene.material.albedo.value = glm::vec3(1.0f);
    for (const float metallic : {0.0f, 1.0f}) {
        scene.material.metallic.value = metallic;
        const Image image = radiance_of(scene);
        for (int i = 0; i < 128; ++i)  // still a white furnace: energy is neither lost nor made
            EXPECT_NEAR(pixel(image, i, 64).x, 1.0f, 2e-3f);
    }
}

TEST(Robustness, a_sun_of_a_million_stays_finite_and_keeps_its_size) {
    const auto radiance = [](glm::vec3 d) { return glm::vec3(d.y > 0.999f ? 1e6f : 0.25f); };
    const auto light = renderer().upload_environment(
        make_panorama(radiance, 512),
        make_baked([](glm::vec3, float r) { return glm::vec3(0.5f / (r * r)); }));
    Scene scene = make_scene(light, sphere());
    scene.material.metallic.value = 1.0f;
    for (const float roughness : {0.0f, 0.02f, 0.3f}) {
        scene.material.roughness.value = roughness;
        expect_sane(radiance_of(scene), "sun");
        const TargetHandle half = renderer().make_target(glm::ivec2(64), 4);
        renderer().draw(scene, *half);
        expect_sane(renderer().read_radiance(*half), "sun in half floats");
    }
    scene.mesh = nullptr;
    scene.camera.pitch_deg = -89.0f;
    scene.camera.fov_deg = 3.0f;
    EXPECT_NEAR(center(radiance_of(scene)).x, 1e6f, 500.0f);
    scene.camera.pitch_deg = 0.0f;
    EXPECT_NEAR(center(radiance_of(scene)).x, 0.25f, 2e-3f);  // what is dark beside it is still there
}

/// Of pixels of the picture's middle that are brighter than that: the widest extent along the axes and along
/// the diagonals, in pixels.
glm::vec2 extents_above(const Image& image, float limit) {
    glm::vec4 low(1e9f), high(-1e9f);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (texel(image, x, y, 0) <= limit) continue;
            const float s = std::sqrt(0.5f);
            const glm::vec4 at(float(x), float(y), s * float(x + y), s * float(x - y));
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
    const glm::vec4 wide = high - low;
    return {std::max(wide.x, wide.y), std::max(wide.z, wide.w)};
}

TEST(Robustness, a_lamp_of_one_texel_looks_round_in_a_sharp_background) {
    Environment environment{.width = 256, .height = 128};
    environment.radiance.assign(256 * 128, glm::vec3(0.01f));
    environment.radiance[64 * 256 + 128] = glm::vec3(400.0f);  // ahead, on the horizon
    environment.content_hash = environment_hash(environment);
    Scene scene = make_scene(
        renderer().upload_environment(environment, make_baked([](glm::vec3, float) { return glm::vec3(0); })),
        nullptr);
    scene.camera.fov_deg = 10.0f;  // a texel is nine pixels wide
    const glm::vec2 wide = extents_above(radiance_of(scene, glm::ivec2(64)), 1.0f);
    ASSERT_GT(wide.x, 10.0f);
    EXPECT_LT(wide.y, 1.2f * wide.x) << "a block is 1.41 times as wide across its corners";
}

TEST(Robustness, the_same_scene_twice_gives_the_same_bytes) {
    Scene scene = make_scene(linear_light(), sphere());
    scene.material.roughness.value = 0.05f;
    scene.view.tonemap = Tonemap::Neutral;
    const Image first = display_of(scene, glm::ivec2(200, 150), 4);
    Scene other = scene;
    other.view.debug = DebugView::UvChecker;
    other.view.background = Background::Blurred;
    display_of(other);
    EXPECT_EQ(display_of(scene, glm::ivec2(200, 150), 4).bytes, first.bytes);
    EXPECT_EQ(first.width, 200);
    EXPECT_EQ(first.height, 150);
}

TEST(Robustness, edges_are_smooth_with_samples_and_the_average_is_unbiased) {
    Scene scene = make_scene(nullptr, quad());
    scene.material.emission.value = glm::vec3(100.0f);
    scene.view.plain_color = glm::vec3(0.0f);
    scene.view.background = Background::Plain;
    scene.camera.yaw_deg = 31.0f;
    scene.camera.pitch_deg = 17.0f;
    const Image radiance = radiance_of(scene, glm::ivec2(64), 4);
    const Image display = display_of(scene, glm::ivec2(64), 4);
    int partial = 0;
    int between = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const float covered = pixel(radiance, x, y).x / 100.0f;
            EXPECT_NEAR(covered * 4.0f, std::round(covered * 4.0f), 1e-4f);
            const bool edge = covered > 0.1f && covered < 0.9f;
            partial += edge ? 1 : 0;
            // Each sample is tone-mapped before they are averaged: the edge of a lamp has all its steps.
            if (edge && std::abs(pixel(display, x, y).x - linear_to_srgb(covered)) < 2.0f / 255.0f) ++between;
        }
    }
    EXPECT_GT(partial, 60);
    EXPECT_EQ(between, partial);
}

TEST(Robustness, the_plain_background_is_untouched_by_exposure_and_tone_mapping) {
    Scene scene = make_scene(linear_light(), nullptr);
    scene.view.background = Background::Plain;
    scene.view.plain_color = {0.18f, 0.5f, 0.05f};
    scene.view.exposure_ev = 5.0f;
    scene.view.tonemap = Tonemap::Neutral;
    for (const int samples : {1, 4}) {
        const glm::vec3 seen = center(display_of(scene, glm::ivec2(8), samples));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], linear_to_srgb(scene.view.plain_color[c]), 0.51f / 255.0f);
        EXPECT_NEAR(center(radiance_of(scene, glm::ivec2(8), samples)).x, 0.18f, 1e-6f);
    }
}

TEST(Robustness, other_peoples_state_is_found_and_left_as_it_was) {
    Scene scene = make_scene(linear_light(), sphere());
    const Image expected = display_of(scene);
    const TargetHandle target = renderer().make_target(glm::ivec2(128), 1);
    const gl::Framebuffer framebuffer = gl::Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glViewport(3, 5, 7, 11);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 2, 2);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_ONE);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    glDepthFunc(GL_NEVER);
    glDisable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CW);
    glActiveTexture(GL_TEXTURE3);
    glPixelStorei(GL_PACK_ALIGNMENT, 8);
    renderer().draw(scene, *target);
    EXPECT_EQ(renderer().read_display(*target).bytes, expected.bytes);
    GLint viewport[4];
    GLint bound = 0;
    GLint unit = 0;
    GLint front = 0;
    glGetIntegerv(GL_VIEWPORT, viewport);
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    glGetIntegerv(GL_ACTIVE_TEXTURE, &unit);
    glGetIntegerv(GL_FRONT_FACE, &front);
    EXPECT_EQ(viewport[3], 11);
    EXPECT_EQ(GLuint(bound), framebuffer.name());
    EXPECT_EQ(unit, GL_TEXTURE3);
    EXPECT_EQ(front, GL_CW);
    EXPECT_TRUE(glIsEnabled(GL_SCISSOR_TEST) && glIsEnabled(GL_BLEND) && glIsEnabled(GL_CULL_FACE));
    EXPECT_FALSE(glIsEnabled(GL_DEPTH_TEST));
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    for (const GLenum on : {GL_SCISSOR_TEST, GL_BLEND, GL_CULL_FACE}) glDisable(on);
    glFrontFace(GL_CCW);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glActiveTexture(GL_TEXTURE0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

TEST(Robustness, views_share_handles_and_do_not_disturb_each_other) {
    Scene one = make_scene(linear_light(), sphere());
    Scene two = one;
    two.material.albedo.value = {1.0f, 0.0f, 0.0f};
    two.view.env_rotation_deg = 120.0f;
    const TargetHandle left = renderer().make_target(glm::ivec2(64), 1);
    const TargetHandle right = renderer().make_target(glm::ivec2(48, 80), 1);
    renderer().draw(one, *left);
    const Image alone = renderer().read_display(*left);
    renderer().draw(two, *right);
    renderer().draw(one, *left);
    EXPECT_EQ(renderer().read_display(*left).bytes, alone.bytes);
    EXPECT_EQ(Renderer::size_px(*right), glm::ivec2(48, 80));
    EXPECT_NE(Renderer::display_texture(*left), Renderer::display_texture(*right));
}

TEST(Headless, a_context_says_what_it_is) {
    renderer();
    const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    ASSERT_NE(version, nullptr);
    EXPECT_GE(epoxy_gl_version(), 41);
    const HeadlessContext second;  // another one in the same process; the first is not current any more
    EXPECT_NE(second.description().find("OpenGL"), std::string::npos);
    const Renderer its_own;
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

}  // namespace
}  // namespace patina

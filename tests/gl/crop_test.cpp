// Pictures drawn part by part, and for themselves alone from what lies under their samples.
#include "renderer/gl/target.h"
#include "renderer/gl/texture.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace patina {
namespace {

using namespace test;

EnvironmentHandle striped_light() {
    static const EnvironmentHandle handle = [] {
        const Environment panorama = make_panorama([](glm::vec3 d) {
            return glm::vec3(1.0f) + 0.8f * glm::vec3(std::sin(9.0f * d.x), std::sin(7.0f * d.y), d.z);
        });
        return renderer().upload_environment(panorama,
                                             bake_environment(panorama, drawing_bake_settings(), {}).value());
    }();
    return handle;
}

Scene bumpy_scene() {
    Scene scene = make_scene(striped_light(), sphere());
    scene.maps[std::size_t(MapSlot::Normal)] = renderer().upload_map(make_map_levels(
        make_picture(32, 32,
                     [](int x, int y) { return glm::ivec3(128 + 3 * (x % 16), 128 - 3 * (y % 16), 220); }),
        MapKind::Normal, ColorSpace::Linear));
    scene.camera.yaw_deg = 20.0f;
    return scene;
}

constexpr glm::ivec2 kSize{96, 76};

Image drawn(const Scene& scene, glm::ivec2 size, Reuse reuse = Reuse::None) {
    const TargetHandle target = renderer().make_target(size, 4, TargetPrecision::Full);
    renderer().draw(scene, *target, reuse);
    return renderer().read_radiance(*target);
}

float distance(const Image& a, int x, int y, const Image& b, glm::ivec2 in_b) {
    const glm::vec3 apart = glm::abs(pixel(a, x, y) - pixel(b, in_b.x, in_b.y));
    return std::max({apart.x, apart.y, apart.z});
}

/// Of the pixels of the part, how many differ from the whole picture's there.
int different_pixels(const Image& whole, const Image& part, const Crop& crop) {
    int count = 0;
    const int top = crop.whole_px.y - crop.at_px.y - part.height;
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x)
            if (distance(part, x, y, whole, {crop.at_px.x + x, top + y}) > 2e-3f) ++count;
    return count;
}

/// Where an edge passes a sample closely, rounding decides.
TEST(Crop, shows_that_part_of_the_picture) {
    for (const Background background : {Background::Environment, Background::Blurred, Background::Plain}) {
        Scene scene = bumpy_scene();
        scene.view.background = background;
        const Image whole = drawn(scene, kSize);
        for (const auto& [at, size] : {std::pair{glm::ivec2(0, 0), glm::ivec2(96, 20)},
                                       std::pair{glm::ivec2(0, 20), glm::ivec2(96, 56)},
                                       std::pair{glm::ivec2(32, 8), glm::ivec2(40, 64)}}) {
            scene.crop = {kSize, at};
            const Image part = drawn(scene, size);
            EXPECT_LE(different_pixels(whole, part, scene.crop), size.x * size.y / 200)
                << at.x << ' ' << at.y;
            scene.crop.at_px.y += at.y > 0 ? -4 : 4;  // the measure sees a shift
            EXPECT_GT(different_pixels(whole, part, scene.crop), size.x * size.y / 20) << at.x << ' ' << at.y;
        }
        scene.crop = {};
    }
}

TEST(Crop, of_sharp_lobes_is_shaded_from_its_fragments_as_while_rasterising) {
    Scene scene = bumpy_scene();
    scene.material.roughness.value = 0.05f;
    scene.crop = {kSize, {0, 0}};
    const WorkLedger before = renderer().work();
    const Image apart = drawn(scene, {96, 32}, Reuse::Within);
    const Image again = drawn(scene, {96, 32}, Reuse::Within);
    const WorkLedger drawn_twice = since(renderer().work(), before);
    EXPECT_EQ(drawn_twice.views_drawn, 2u);
    EXPECT_EQ(drawn_twice.views_from_surfaces, gl::is_software() ? 2u : 0u);
    EXPECT_EQ(drawn_twice.surfaces_rasterised, drawn_twice.views_from_surfaces) << "none is kept";
    EXPECT_EQ(apart.bytes, again.bytes);
    const Image at_once = drawn(scene, {96, 32});
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 96; ++x)
            EXPECT_LE(distance(apart, x, y, at_once, {x, y}), 1e-3f) << x << ' ' << y;
}

TEST(Crop, without_sharp_lobes_is_drawn_at_once) {
    Scene scene = bumpy_scene();
    scene.material.roughness.value = 0.5f;
    const WorkLedger before = renderer().work();
    drawn(scene, {96, 32}, Reuse::Within);
    EXPECT_EQ(since(renderer().work(), before).views_from_surfaces, 0u);
}

TEST(Crop, counts_as_a_picture_once) {
    Scene scene = bumpy_scene();
    const WorkLedger before = renderer().work();
    for (const int y : {0, 32}) {
        scene.crop = {kSize, {0, y}};
        drawn(scene, {96, 32}, Reuse::Within);
    }
    EXPECT_EQ(renderer().work().views_drawn, before.views_drawn + 1);
}

/// Counts the textures that are made while it lives, and those made beside what it watches.
class TextureWatch {
public:
    explicit TextureWatch(std::weak_ptr<const GpuSurfaces> watched) {
        watched_ = std::move(watched);
        made_ = made_beside_ = 0;
        texture_ = std::exchange(epoxy_glTexImage2D, tex_image);
    }
    ~TextureWatch() { epoxy_glTexImage2D = texture_; }
    TextureWatch(const TextureWatch&) = delete;
    TextureWatch& operator=(const TextureWatch&) = delete;
    static int made() { return made_; }
    static int made_beside() { return made_beside_; }

private:
    static void tex_image(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height,
                          GLint border, GLenum format, GLenum type, const void* pixels) {
        ++made_;
        if (!watched_.expired()) ++made_beside_;
        texture_(target, level, internal, width, height, border, format, type, pixels);
    }
    static inline std::weak_ptr<const GpuSurfaces> watched_;
    static inline int made_ = 0, made_beside_ = 0;
    static inline PFNGLTEXIMAGE2DPROC texture_ = nullptr;
};

TEST(Crop, lets_the_fragments_of_one_part_go_before_it_makes_those_of_the_next) {
    Scene scene = bumpy_scene();
    if (!gl::is_software()) GTEST_SKIP() << "other drivers draw such a part at once";
    scene.material.roughness.value = 0.05f;
    const TargetHandle target = renderer().make_target({96, 32});
    scene.crop = {kSize, {0, 0}};
    renderer().draw(scene, *target, Reuse::Within);
    ASSERT_TRUE(target->stored.surfaces);
    scene.crop.at_px.y = 32;
    const TextureWatch watch(target->stored.surfaces);
    renderer().draw(scene, *target, Reuse::Within);
    EXPECT_GT(TextureWatch::made(), 0);
    EXPECT_EQ(TextureWatch::made_beside(), 0);
}

TEST(Crop, is_a_whole_number_of_quads_and_all_of_a_picture_of_large_triangles) {
    Scene scene = make_scene(striped_light(), sphere());
    for (const glm::ivec2 size :
         {glm::ivec2(512), glm::ivec2(700, 331), glm::ivec2(1), glm::ivec2(4096, 17)}) {
        const int rows = Renderer::rows_at_once(scene, size);
        EXPECT_EQ(rows % 4, 0);
        EXPECT_GT(rows, 0);
    }
    scene.mesh = quad();
    EXPECT_GE(Renderer::rows_at_once(scene, glm::ivec2(512)), 512);
    scene.mesh = {};
    EXPECT_GE(Renderer::rows_at_once(scene, glm::ivec2(512)), 512);
    EXPECT_LT(Renderer::rows_at_once(scene, glm::ivec2(16384)), 2048) << "no driver has room for all of it";
}

}  // namespace
}  // namespace patina

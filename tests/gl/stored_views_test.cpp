// Pictures shaded from a surface that was rasterised before are the pictures that are drawn at once.
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace patina {
namespace {

using namespace test;

struct Case {
    const char* name;
    std::function<void(Scene&)> change;
};
void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }

MapHandle bumpy_map() {
    static const MapHandle handle = [] {
        const Image picture = make_picture(64, 64, [](int x, int y) {
            return glm::ivec3(128 + 60 * ((x / 8 + y / 8) % 2), 128 - 40 * ((x / 8) % 2), 220);
        });
        return renderer().upload_map(make_map_levels(picture, MapKind::Normal, ColorSpace::Linear));
    }();
    return handle;
}

MapHandle striped_map(MapKind kind) {
    const Image picture = make_picture(64, 64, [](int x, int y) {
        return glm::ivec3(40 + 3 * x, 250 - 3 * y, (x + y) % 16 < 8 ? 30 : 220);
    });
    return renderer().upload_map(make_map_levels(picture, kind, ColorSpace::Srgb));
}

void put_all_maps(Scene& scene) {
    scene.maps.fill(striped_map(MapKind::Data));
    scene.maps[std::size_t(MapSlot::Albedo)] = striped_map(MapKind::Color);
    scene.maps[std::size_t(MapSlot::Normal)] = bumpy_map();
    scene.material.metallic = {.value = 0.7f, .channel = Channel::B};
    scene.material.roughness = {.value = 0.9f, .channel = Channel::R, .invert = true};
    scene.material.ao = {.value = 0.8f, .channel = Channel::G};
    scene.material.normal.value = 0.6f;
    scene.material.emission.value = glm::vec3(0.1f, 0.0f, 0.3f);
    scene.material.uv = {.scale = {2.0f, -1.5f}, .offset = {0.2f, 0.1f}, .rotation_deg = 25.0f};
}

const Case kCases[] = {
    {"plastic", [](Scene&) {}},
    {"mirror",
     [](Scene& scene) {
         scene.material.metallic.value = 1.0f;
         scene.material.roughness.value = 0.05f;
     }},
    {"every map", put_all_maps},
    {"course, blurred",
     [](Scene& scene) {
         scene.view.shading = Shading::Course;
         scene.view.background = Background::Blurred;
         scene.view.env_rotation_deg = 50.0f;
     }},
    {"high quality on a quad before nothing",
     [](Scene& scene) {
         scene.mesh = quad();
         scene.view.quality = Quality::High;
         scene.view.background = Background::Plain;
         scene.view.tonemap = Tonemap::Aces;
         scene.camera.yaw_deg = 130.0f;
     }},
    {"no environment", [](Scene& scene) { scene.environment = {}; }},
};

/// A studio of one small lamp, so that edges and highlights are bright beside what they border on.
EnvironmentHandle lamp_light() {
    static const EnvironmentHandle handle = [] {
        const Environment panorama = make_panorama([](glm::vec3 d) {
            return glm::vec3(0.2f) + glm::vec3(40.0f, 30.0f, 20.0f) * std::pow(std::max(d.y, 0.0f), 200.0f);
        });
        return renderer().upload_environment(panorama,
                                             bake_environment(panorama, drawing_bake_settings(), {}).value());
    }();
    return handle;
}

/// Relative to the first, or to `floor` where that is darker.
float largest_difference(const Image& a, const Image& b, float floor) {
    float largest = 0.0f;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float first = texel(a, x, y, c);
                const float apart = std::abs(first - texel(b, x, y, c));
                largest = std::max(largest, apart / std::max(std::abs(first), floor));
            }
    return largest;
}

class StoredViews : public testing::TestWithParam<Case> {};

TEST_P(StoredViews, are_the_pictures_drawn_at_once) {
    for (const int samples : {1, 4}) {
        Scene scene = make_scene(lamp_light(), sphere());
        GetParam().change(scene);
        const TargetHandle target = renderer().make_target({97, 75}, samples, TargetPrecision::Full);
        renderer().draw(scene, *target);
        const Image radiance = renderer().read_radiance(*target);
        const Image display = renderer().read_display(*target);
        const std::uint64_t before = renderer().work().views_from_surfaces;
        renderer().draw(scene, *target, Reuse::Expected);
        EXPECT_EQ(renderer().work().views_from_surfaces, before + 1);
        const Image again = renderer().read_radiance(*target);
        // The same arithmetic on the same numbers; a compiler may round it in another order.
        EXPECT_LE(largest_difference(radiance, again, 0.05f), 1e-3f) << samples;
        EXPECT_LE(largest_difference(display, renderer().read_display(*target), 1.0f), 1.01f / 255.0f)
            << samples;
    }
}

INSTANTIATE_TEST_SUITE_P(All, StoredViews, testing::ValuesIn(kCases));

class StoredSurface : public testing::Test {
protected:
    StoredSurface() {
        scene_.maps[std::size_t(MapSlot::Normal)] = bumpy_map();
        draw();
    }
    /// Whether the mesh was rasterised for the picture.
    bool rasterises(const std::function<void(Scene&)>& change) {
        change(scene_);
        const std::uint64_t before = renderer().work().surfaces_rasterised;
        draw();
        return renderer().work().surfaces_rasterised > before;
    }
    void draw() { renderer().draw(scene_, *target_, Reuse::Expected); }

    Scene scene_ = make_scene(lamp_light(), sphere());
    TargetHandle target_ = renderer().make_target({40, 30}, 4);
};

TEST_F(StoredSurface, is_shaded_again_for_values_light_and_view) {
    EXPECT_FALSE(rasterises([](Scene&) {}));
    EXPECT_FALSE(rasterises([](Scene& scene) { scene.material.roughness.value = 0.2f; }));
    EXPECT_FALSE(rasterises([](Scene& scene) { scene.material.albedo.value = glm::vec3(0.1f, 0.5f, 0.9f); }));
    EXPECT_FALSE(rasterises([](Scene& scene) { scene.view.env_rotation_deg = 77.0f; }));
    EXPECT_FALSE(rasterises([](Scene& scene) { scene.view.exposure_ev = -1.0f; }));
    EXPECT_FALSE(rasterises([](Scene& scene) { scene.environment = linear_light(); }));
}

TEST_F(StoredSurface, is_rasterised_anew_for_what_lies_in_it) {
    EXPECT_TRUE(rasterises([](Scene& scene) { scene.camera.yaw_deg += 1.0f; }));
    EXPECT_TRUE(rasterises([](Scene& scene) { scene.material.normal.value = 0.5f; }));
    EXPECT_TRUE(rasterises([](Scene& scene) { scene.material.uv.scale.x = 3.0f; }));
    EXPECT_TRUE(rasterises([](Scene& scene) { scene.mesh = quad(); }));
    EXPECT_TRUE(rasterises([](Scene& scene) { scene.maps = {}; }));
    // Sharp lobes need more of it; what others need is kept beside that.
    EXPECT_TRUE(rasterises([](Scene& scene) { scene.material.roughness.value = 0.02f; }));
    EXPECT_FALSE(rasterises([](Scene& scene) { scene.material.roughness.value = 0.03f; }));
    EXPECT_FALSE(rasterises([](Scene& scene) { scene.material.roughness.value = 0.47f; })) << "never was";
    const Image from_sharp = renderer().read_display(*target_);
    renderer().draw(scene_, *target_);
    EXPECT_LE(largest_difference(renderer().read_display(*target_), from_sharp, 1.0f), 1.01f / 255.0f);
    // Without maps their transform is nobody's concern.
    EXPECT_FALSE(rasterises([](Scene& scene) { scene.material.uv.scale.x = 4.0f; }));
}

TEST(StoredShading, is_done_inside_the_bounds_of_the_mesh_and_counted_where_the_driver_counts) {
    Scene scene = make_scene(lamp_light(), sphere());
    scene.view.background = Background::Plain;
    constexpr int side = 256;
    const TargetHandle target = renderer().make_target(glm::ivec2(side), 1);
    const auto shaded = [&](float distance) {
        scene.camera.distance = distance;
        renderer().draw(scene, *target, Reuse::Expected);
        renderer().read_display(*target);
        const std::uint64_t before = renderer().work().fragments_shaded;
        scene.material.roughness.value += 0.01f;  // shaded once more
        renderer().draw(scene, *target, Reuse::Expected);
        renderer().read_display(*target);
        return double(renderer().work().fragments_shaded - before);
    };
    const double near = shaded(4.5f), far = shaded(30.0f);
    if (near == 0.0) GTEST_SKIP() << "this driver counts no fragments";
    // Every pixel once for the display; the sphere takes a half of the picture, and then an 80th.
    constexpr double pixels = double(side) * side;
    EXPECT_GT(near, 1.4 * pixels);
    EXPECT_LT(near, 1.8 * pixels);
    EXPECT_GT(far, 1.0 * pixels);
    EXPECT_LT(far, 1.1 * pixels);
}

TEST(StoredPrograms, are_taken_again_unless_they_are_damaged) {
    renderer();  // its context
    std::map<std::string, std::vector<std::byte>> kept;
    const ProgramStore store{[&](const std::string& key) { return kept[key]; },
                             [&](const std::string& key, std::span<const std::byte> bytes) {
                                 kept[key].assign(bytes.begin(), bytes.end());
                             }};
    const Scene scene = make_scene(linear_light(), sphere());
    const auto drawn = [&](WorkLedger& work) {
        Renderer other;
        other.set_program_store(store);
        const TargetHandle target = other.make_target({24, 24}, 1);
        other.draw(scene, *target);
        work = other.work();
        return other.read_display(*target);
    };
    WorkLedger first, second, third;
    const Image picture = drawn(first);
    EXPECT_GT(first.programs_compiled, 0u);
    if (kept.empty()) GTEST_SKIP() << "this driver hands no programs out";
    EXPECT_EQ(drawn(second).bytes, picture.bytes);
    EXPECT_EQ(second.programs_compiled, 0u);
    EXPECT_EQ(second.programs_from_disk, first.programs_compiled);
    for (auto& [key, bytes] : kept) bytes[bytes.size() / 2] ^= std::byte{0x10};
    EXPECT_EQ(drawn(third).bytes, picture.bytes);
    EXPECT_EQ(third.programs_compiled, first.programs_compiled);
}

TEST_F(StoredSurface, is_not_kept_where_that_is_not_wanted) {
    renderer().set_reuse(false);
    EXPECT_FALSE(rasterises([](Scene& scene) { scene.camera.yaw_deg += 2.0f; }));
    renderer().set_reuse(true);
}

}  // namespace
}  // namespace patina

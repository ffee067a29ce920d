// Maps from a photo with a known truth: a known relief drawn under a lamp stands for the photo, and its
// normals have to be found again.
#include "renderer/maps/photo_maps.h"
#include "renderer/maps/relief.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace patina {
namespace {

using namespace test;

constexpr int kSide = 128;
constexpr float kAzimuth = 125.0f, kElevation = 45.0f;  ///< of the lamp, degrees

/// Smooth bumps without a direction of their own, heights in widths.
Plane relief() {
    Plane height(kSide, kSide);
    std::mt19937 random(11);
    const auto pick = [&](int n) { return double(random() % unsigned(n)); };
    for (int wave = 0; wave < 40; ++wave) {
        const double angle = 0.001 * pick(6283), waves = 2.0 + 0.01 * pick(600), phase = 0.001 * pick(6283);
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                height.at(x, y) += float(0.006 / waves *
                                         std::sin(2.0 * std::numbers::pi * waves *
                                                      (x * std::cos(angle) + y * std::sin(angle)) / kSide +
                                                  phase));
    }
    return height;
}

Image stored(const Colors& normals) {
    Image image = make_image(normals.width, normals.height, 3, PixelType::U16);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) set_texel(image, x, y, c, 0.5f + 0.5f * normals.at(x, y)[c]);
    return image;
}

EnvironmentHandle lamp() {
    const float a = glm::radians(kAzimuth), e = glm::radians(kElevation);
    const glm::vec3 at(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e));
    const Environment environment = make_panorama(
        [&](glm::vec3 d) { return glm::vec3(300.0f * std::exp(150.0f * (glm::dot(d, at) - 1.0f))); }, 256);
    const auto baked = bake_environment(environment, BakeSettings{}, {});
    return renderer().upload_environment(environment, *baked);
}

/// The quad filling the picture, as good as without perspective.
Image photo_of(const Colors& normals) {
    Scene scene = make_scene(lamp(), quad());
    scene.material.albedo.value = {0.4f, 0.35f, 0.3f};
    scene.material.roughness.value = 1.0f;
    scene.material.normal.map = "normals";
    scene.maps[std::size_t(MapSlot::Normal)] =
        renderer().upload_map(make_map_levels(stored(normals), MapKind::Normal, ColorSpace::Linear));
    scene.camera = {.distance = 1.0f / std::tan(glm::radians(5.0f)), .fov_deg = 10.0f};
    scene.view.background = Background::Plain;
    return radiance_of(scene, {2 * kSide, 2 * kSide}, 4);
}

/// Mean angle in degrees away from the borders, where the photo's end is felt.
double mean_angle(const Image& found, const Colors& truth, bool flat) {
    double sum = 0.0;
    int count = 0;
    for (int y = kSide / 8; y < kSide * 7 / 8; ++y)
        for (int x = kSide / 8; x < kSide * 7 / 8; ++x, ++count) {
            glm::vec3 n(0, 0, 1);
            for (int c = 0; !flat && c < 3; ++c) n[c] = 2.0f * texel(found, x, y, c) - 1.0f;
            const glm::vec3 t = truth.at(x, y);
            sum += double(glm::degrees(std::atan2(glm::length(glm::cross(n, t)), glm::dot(n, t))));
        }
    return sum / count;
}

TEST(MapTruth, the_normals_of_a_drawn_relief_come_back_from_its_picture) {
    const Colors truth = normals_of(relief(), false);
    const Image photo = photo_of(truth);
    const MapSettings settings{.size_px = {kSide, kSide},
                               .even_degree = 1,
                               .tileable = false,
                               .relief_from = ReliefFrom::Light,
                               .light_azimuth_deg = kAzimuth,
                               .light_elevation_deg = kElevation,
                               .relief_scale = 1.0f};
    const auto maps = make_photo_maps(photo, settings, fourier_transform());
    ASSERT_TRUE(maps);
    const double flat = mean_angle(maps->normal, truth, true), found = mean_angle(maps->normal, truth, false);
    RecordProperty("flat_deg", std::to_string(flat));
    RecordProperty("found_deg", std::to_string(found));
    EXPECT_GT(flat, 8.0) << "there must be something to find";
    EXPECT_LT(found, 0.65 * flat) << "degrees, where a flat map errs by " << flat;
    // From the wrong side bumps become hollows: worse than nothing.
    MapSettings wrong = settings;
    wrong.light_azimuth_deg += 180.0f;
    EXPECT_GT(mean_angle(make_photo_maps(photo, wrong, fourier_transform())->normal, truth, false), flat);
}

TEST(ReadPixel, is_what_the_whole_picture_has_there) {
    Scene scene = make_scene(linear_light(), sphere());
    const TargetHandle target = renderer().make_target({40, 30}, 4);
    renderer().draw(scene, *target);
    const Image radiance = renderer().read_radiance(*target), display = renderer().read_display(*target);
    for (const glm::ivec2 at : {glm::ivec2(0, 0), {20, 15}, {39, 29}, {12, 9}}) {
        const Renderer::PixelValue value = renderer().read_pixel(*target, at);
        for (int c = 0; c < 3; ++c) {
            EXPECT_FLOAT_EQ(value.radiance[c], texel(radiance, at.x, at.y, c));
            EXPECT_EQ(value.display[c], int(std::lround(255.0f * texel(display, at.x, at.y, c))));
        }
    }
}

}  // namespace
}  // namespace patina

// Photos with a known truth: a render under gain, tint and perspective stands for the photo, and everything
// that was done to it has to be found again.
#include "app/photo_hints.h"
#include "app/shoot.h"
#include "renderer/core/color_difference.h"
#include "renderer/core/environment.h"
#include "renderer/core/homography.h"
#include "renderer/ibl/bake.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace patina {
namespace {

using namespace test;

constexpr glm::ivec2 kView{96, 96};
constexpr glm::ivec2 kPhoto{400, 300};
const glm::vec3 kTint{1.25f, 1.0f, 0.7f};
constexpr float kGainEv = -0.8f;

ShootRadiance radiance() {
    return [](const Scene& scene) { return radiance_of(scene, kView, 4); };
}

/// A glossy red sphere under two lamps in a grey room: highlights and body colour both matter.
Scene truth_scene() {
    static const EnvironmentHandle light = [] {
        const auto room = [](glm::vec3 d) {
            const auto lamp = [&](glm::vec3 at, float power) {
                return power * std::exp(40.0f * (glm::dot(d, glm::normalize(at)) - 1.0f));
            };
            return glm::vec3(0.3f + lamp({1, 1, 1}, 20.0f) + lamp({-1, 0.2f, 1}, 12.0f));
        };
        const Environment environment = make_panorama(room, 128);
        const auto baked = bake_environment(environment, BakeSettings{}, {});
        return renderer().upload_environment(environment, *baked);
    }();
    Scene scene = make_scene(light, sphere());
    scene.material.albedo.value = {0.5f, 0.12f, 0.08f};
    scene.material.roughness.value = 0.35f;
    scene.view.background = Background::Plain;
    scene.view.shading = Shading::SplitSum;
    return scene;
}

FourPoints corners_in_photo() { return {glm::dvec2{61, 22}, {342, 40}, {360, 281}, {38, 262}}; }
FourPoints view_corners() { return {glm::dvec2{0, 0}, {kView.x, 0}, {kView.x, kView.y}, {0, kView.y}}; }

constexpr glm::vec2 kCardAt{14.0f / 400.0f, 12.0f / 300.0f};  ///< middle of the card, which is 24 × 18

/// What the camera saw: the render in perspective, darker and tinted, on a black table with a grey card.
Image synthetic_photo(const Image& render) {
    Image photo = warped(render, *homography(corners_in_photo(), view_corners()), kPhoto);
    Image result = make_image(kPhoto.x, kPhoto.y, 3, PixelType::F32);
    for (int y = 0; y < kPhoto.y; ++y)
        for (int x = 0; x < kPhoto.x; ++x)
            for (int c = 0; c < 3; ++c)
                set_texel(result, x, y, c,
                          (x >= 2 && x < 26 && y >= 3 && y < 21 ? kGreyCard : texel(photo, x, y, c)) *
                              kTint[c] * std::exp2(kGainEv));
    return result;
}

/// The fit a careful hand makes: within half a pixel of the truth.
Photo fitted() {
    Photo photo{.file = "synthetic.exr", .fit = PhotoFit{}};
    const FourPoints truth = corners_in_photo();
    const glm::dvec2 slips[] = {{0.4, -0.3}, {-0.3, 0.4}, {0.2, 0.4}, {-0.4, -0.2}};
    for (std::size_t i = 0; i < 4; ++i)
        photo.fit->photo[i] = glm::vec2((truth[i] + slips[i]) / glm::dvec2(kPhoto));
    photo.region = Region{0.3f, 0.3f, 0.7f, 0.7f};  // on the sphere, away from its edge
    return photo;
}

struct Found {
    Photo photo;
    Image in_view;
};
Found found_again(const Scene& truth) {
    const Image photo = synthetic_photo(radiance()(truth));
    Found f{.photo = fitted()};
    const auto balance = balance_to(*card_patch(photo, kCardAt), glm::vec3(kGreyCard));
    f.photo.exposure_ev = balance->exposure_ev;
    f.photo.white_balance = balance->white_balance;
    f.in_view = photo_in_view(f.photo, photo, kView);
    return f;
}
Found found() {
    static const Found result = found_again(truth_scene());
    return result;
}

float delta_e(const Material& material) {
    Scene scene = truth_scene();
    scene.material = material;
    return residual_of(found().in_view, radiance()(scene), found().photo.region).delta_e;
}

TEST(PhotoTruth, the_fit_recovers_the_perspective_within_a_pixel) {
    const auto to_photo = view_to_photo(found().photo, kPhoto, kView);
    const auto truth = homography(view_corners(), corners_in_photo());
    ASSERT_TRUE(to_photo && truth);
    for (int y = 0; y <= kView.y; y += 12)
        for (int x = 0; x <= kView.x; x += 12)
            EXPECT_LT(glm::distance(mapped(*to_photo, {x, y}), mapped(*truth, {x, y})), 1.0);
}

TEST(PhotoTruth, the_card_gives_exposure_and_white_balance) {
    const Found f = found();
    const glm::vec3 restored =
        kTint * std::exp2(kGainEv) * f.photo.white_balance * std::exp2(f.photo.exposure_ev);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(std::log2(restored[c]), 0.0f, 0.05f);
}

TEST(PhotoTruth, the_residual_is_small_at_the_truth_and_grows_with_roughness_and_albedo_away_from_it) {
    const Material truth = truth_scene().material;
    const float at_truth = delta_e(truth);
    EXPECT_LT(at_truth, 0.6f);
    for (const float direction : {-1.0f, 1.0f}) {
        float before = at_truth;
        for (const float step : {0.05f, 0.1f, 0.2f, 0.3f}) {
            Material moved = truth;
            moved.roughness.value += direction * step;
            const float now = delta_e(moved);
            EXPECT_GT(now, before) << "roughness " << moved.roughness.value;
            before = now;
        }
        before = at_truth;
        for (const float stops : {0.1f, 0.25f, 0.5f, 1.0f}) {
            Material moved = truth;
            moved.albedo.value *= std::exp2(direction * stops);
            const float now = delta_e(moved);
            EXPECT_GT(now, before) << "albedo " << moved.albedo.value.x;
            before = now;
        }
    }
}

TEST(PhotoTruth, hints_lead_back_to_the_truth_and_say_nothing_there) {
    Scene scene = truth_scene();
    EXPECT_TRUE(hints_for(found().in_view, found().photo.region, scene, radiance()).empty());
    scene.material.roughness.value = 0.2f;
    const auto smooth = hints_for(found().in_view, found().photo.region, scene, radiance());
    ASSERT_FALSE(smooth.empty());
    EXPECT_TRUE(
        smooth[0].starts_with("The highlights are narrower than in the photo: try roughness about 0.1"))
        << smooth[0];
    scene = truth_scene();
    scene.material.albedo.value *= 2.0f;
    const auto light = hints_for(found().in_view, found().photo.region, scene, radiance());
    ASSERT_FALSE(light.empty());
    EXPECT_TRUE(
        light[0].starts_with("The surface is lighter than in the photo: try the base colour about 5") ||
        light[0].starts_with("The surface is lighter than in the photo: try the base colour about 4"))
        << light[0];
}

// ---- other materials under other lights ----

struct Truth {
    const char* environment;
    Material material;
};
std::vector<Truth> truths() {
    const auto material = [](glm::vec3 albedo, float roughness, float metallic) {
        Material result;
        result.albedo.value = albedo;
        result.roughness.value = roughness;
        result.metallic.value = metallic;
        return result;
    };
    const std::array materials{material({0.95f, 0.64f, 0.54f}, 0.35f, 1.0f),  // copper
                               material({0.03f, 0.03f, 0.035f}, 0.4f, 0.0f),  // black plastic
                               material({0.45f, 0.42f, 0.38f}, 0.5f, 0.0f),   // clay
                               material({0.05f, 0.12f, 0.4f}, 0.35f, 0.0f)};  // blue paint
    std::vector<Truth> all;
    for (const char* environment : {"studio", "sky", "sunset", "night"})
        for (const Material& each : materials) all.push_back({environment, each});
    return all;
}

Scene scene_of(const Truth& truth) {
    static std::map<std::string, EnvironmentHandle> lights;
    EnvironmentHandle& light = lights[truth.environment];
    if (!light)
        for (const BuiltinEnvironment& each : builtin_environments())
            if (each.id == truth.environment) {
                const Environment environment = each.make(256);
                light = renderer().upload_environment(environment,
                                                      *bake_environment(environment, BakeSettings{}, {}));
            }
    Scene scene = truth_scene();
    scene.environment = light;
    scene.material = truth.material;
    return scene;
}

/// Of materials with one value moved away from the truth, further each time, the mean ΔE.
struct Away {
    const char* what;
    std::vector<Material> moved;
};
std::vector<Away> ways_off(const Material& truth) {
    std::vector<Away> ways{{"smoother", {}}, {"rougher", {}}, {"darker", {}}, {"brighter", {}}};
    for (const float step : {0.1f, 0.2f, 0.3f})
        for (const int direction : {0, 1}) {
            Material moved = truth;
            moved.roughness.value += direction == 0 ? -step : step;
            ways[std::size_t(direction)].moved.push_back(moved);
        }
    for (const float stops : {0.25f, 0.5f, 1.0f})
        for (const int direction : {0, 1}) {
            Material moved = truth;
            moved.albedo.value *= std::exp2(direction == 0 ? -stops : stops);
            ways[std::size_t(2 + direction)].moved.push_back(moved);
        }
    return ways;
}

TEST(SlowPhotoTruth, the_residual_is_least_at_the_truth_for_other_materials_and_lights) {
    for (const Truth& truth : truths()) {
        const Scene scene = scene_of(truth);
        const Found f = found_again(scene);
        SCOPED_TRACE(std::string(truth.environment) + ", albedo " +
                     std::to_string(truth.material.albedo.value.x));
        EXPECT_NEAR(f.photo.exposure_ev, -kGainEv - std::log2(luminance(kTint)), 0.05f);
        const auto delta_e = [&](const Material& material) {
            Scene trial = scene;
            trial.material = material;
            return residual_of(f.in_view, radiance()(trial), f.photo.region).delta_e;
        };
        const float at_truth = delta_e(truth.material);
        EXPECT_LT(at_truth, 0.6f);
        std::string row = std::string(truth.environment) + " " + std::to_string(at_truth).substr(0, 4) + " |";
        for (const Away& way : ways_off(truth.material)) {
            float before = at_truth;
            for (const Material& moved : way.moved) {
                const float now = delta_e(moved);
                EXPECT_GT(now, before) << way.what;
                before = now;
                row += " " + std::to_string(now).substr(0, 4);
            }
            row += " |";
        }
        std::printf("%s\n", row.c_str());
    }
}

TEST(SlowPhotoTruth, hints_never_lead_away_from_the_truth) {
    int given = 0, tried = 0;
    for (const Truth& truth : truths()) {
        const Scene scene = scene_of(truth);
        const Found f = found_again(scene);
        SCOPED_TRACE(std::string(truth.environment) + ", albedo " +
                     std::to_string(truth.material.albedo.value.x));
        EXPECT_TRUE(hints_for(f.in_view, f.photo.region, scene, radiance()).empty()) << "nothing is off";
        for (const float off : {-0.2f, 0.2f}) {
            Scene wrong = scene;
            wrong.material.roughness.value += off;
            const auto hints = hints_for(f.in_view, f.photo.region, wrong, radiance());
            ++tried;
            if (hints.empty() || hints[0].find("roughness") == std::string::npos) continue;
            ++given;
            EXPECT_NE(hints[0].find(off < 0.0f ? "higher" : "lower"), std::string::npos) << hints[0];
            const std::size_t at = hints[0].find("about ");
            EXPECT_NEAR(std::stof(hints[0].substr(at + 6)), std::abs(off), 0.06f) << hints[0];
        }
    }
    std::printf("%d hints about roughness for %d wrong ones\n", given, tried);
    EXPECT_GT(given, tried * 3 / 4);
}

TEST(PhotoTruth, the_shot_carries_picture_numbers_and_heat) {
    Scene scene = truth_scene();
    scene.material.albedo.value = {0.1f, 0.4f, 0.1f};
    const LoadedPhoto loaded{.linear = synthetic_photo(radiance()(truth_scene()))};
    const PhotoShot shot = shoot_photo(found().photo, loaded, radiance()(scene));
    EXPECT_EQ(shot.title, "synthetic.exr");
    EXPECT_GT(shot.residual.delta_e, 10.0f);
    EXPECT_EQ(shot.picture.channels, 3);
    EXPECT_GT(texel(shot.heat, 48, 48, 0), 0.2f);
    EXPECT_NEAR(texel(shot.heat, 10, 48, 0), 0.5f, 0.01f) << "outside of the region";
    EXPECT_NE(short_text(shot.residual).find("ΔE"), std::string::npos);
}

}  // namespace
}  // namespace patina

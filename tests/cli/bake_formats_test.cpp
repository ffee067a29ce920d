// Baked light leaves the program and comes back: KTX for others, face strips for itself.
#include "renderer/core/file_io.h"
#include "renderer/core/image_io.h"
#include "tests/cli/program.h"
#include "tests/unit/app/ktx_reader.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

using test::Outcome;
using test::Workspace;

/// Mean |a − b| over mean a.
double mean_difference(const Image& a, const Image& b) {
    double difference = 0.0;
    double sum = 0.0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) {
                difference += std::abs(double(texel(a, x, y, c)) - double(texel(b, x, y, c)));
                sum += double(texel(a, x, y, c));
            }
    return difference / sum;
}

Image rendered(const Workspace& work, const std::string& light, const std::vector<std::string>& options) {
    std::vector<std::string> words{"render", "-", "-o", "picture.exr", "--env", light, "--size", "96x96"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = work.run(words);
    EXPECT_EQ(outcome.exit_status, 0) << outcome.errors;
    EXPECT_EQ(outcome.errors, "");
    return load_image(work.folder() / "picture.exr").image;
}

/// A bake that lists its lights holds the very light that the renderer makes of the source. One that folds
/// them back has the sun looked up along a fitted lobe instead of shaded as a disc: alike where the lobe is
/// wide.
TEST(BakeFormats, a_picture_under_a_bake_is_the_picture_under_its_source) {
    const Workspace work;
    ASSERT_EQ(work.run({"bake", "sunset", "-o", "taken"}).exit_status, 0);
    ASSERT_EQ(work.run({"bake", "sunset", "-o", "kept", "--keep-lights"}).exit_status, 0);
    for (const auto& [roughness, folded] : {std::pair{"roughness=0.15", 0.06}, {"roughness=0.6", 0.015}}) {
        const std::vector<std::string> options{"--background", "none",  "--set",
                                               "metallic=0.5", "--set", roughness};
        const Image expected = rendered(work, "sunset", options);
        EXPECT_LE(mean_difference(expected, rendered(work, "taken", options)), 1e-4) << roughness;
        EXPECT_LE(mean_difference(expected, rendered(work, "kept/bake.json", options)), folded) << roughness;
    }
}

/// A sky of 1 with one bright texel above the horizon, towards +X.
void write_lamp(const Workspace& work, const std::string& name) {
    Image sky = make_image(128, 64, 3, PixelType::F32);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x)
            for (int c = 0; c < 3; ++c) set_texel(sky, x, y, c, x == 96 && y == 20 ? 5e4f : 1.0f);
    save_image(work.folder() / name, sky);
}

TEST(BakeFormats, lights_are_taken_out_and_listed_unless_they_are_to_be_kept) {
    const Workspace work;
    write_lamp(work, "lamp.exr");
    const std::vector<std::string> rest{"--levels", "0.05,0.3,1", "--size", "32"};
    const auto bake = [&](const std::string& folder, std::vector<std::string> more) {
        std::vector<std::string> words{"bake", "lamp.exr", "-o", folder};
        words.insert(words.end(), rest.begin(), rest.end());
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(work.run(words).exit_status, 0);
        return nlohmann::json::parse(work.read(folder + "/bake.json"));
    };
    const auto taken = bake("taken", {}), kept = bake("kept", {"--keep-lights"});
    EXPECT_TRUE(kept.at("lights").empty());
    ASSERT_EQ(taken.at("lights").size(), 1u);
    const auto& light = taken["lights"][0];
    const double theta = 20.5 * kPi / 64, phi = 96.5 * 2.0 * kPi / 128;
    EXPECT_NEAR(light["direction"][0].get<double>(), -std::sin(theta) * std::sin(phi), 1e-4);
    EXPECT_NEAR(light["direction"][1].get<double>(), std::cos(theta), 1e-4);
    const double area = 2.0 * kPi / 128 * (std::cos(20 * kPi / 64) - std::cos(21 * kPi / 64));
    EXPECT_NEAR(light["irradiance"][1].get<double>() / (area * (5e4 - 1.0)), 1.0, 1e-5);
    EXPECT_GT(light["angular_radius"].get<double>(), 0.0);

    // What is left is the sky; what was kept is the sky and, at roughness 1, the lamp's cosine lobe.
    const auto strip = [&](const std::string& folder, int level) {
        return load_image(work.folder() / folder / ("level_0" + std::to_string(level) + ".exr")).image;
    };
    for (int level = 0; level < 3; ++level) {
        const Image without = strip("taken", level), with = strip("kept", level);
        const int size = without.height;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < 6 * size; ++x) {
                EXPECT_NEAR(texel(without, x, y, 1), 1.0f, 2e-3f);
                EXPECT_GE(texel(with, x, y, 1), 0.99f);
            }
    }
    const Image lobe = strip("kept", 2);
    const float facing = texel(lobe, lobe.height / 2, lobe.height / 2, 1);  // near +X
    const double cosine = std::sin(theta) * std::abs(std::sin(phi));
    EXPECT_NEAR(facing, 1.0 + area * 5e4 / kPi * cosine, 0.05 * facing);
}

TEST(BakeFormats, a_bake_read_back_still_has_the_light_that_was_taken_out) {
    const Workspace work;
    write_lamp(work, "lamp.exr");
    ASSERT_EQ(work.run({"bake", "lamp.exr", "-o", "out"}).exit_status, 0);
    ASSERT_EQ(work.run({"bake", "lamp.exr", "-o", "kept", "--keep-lights"}).exit_status, 0);
    const std::vector<std::string> options{"--background", "none", "--set", "roughness=0.7"};
    const Image expected = rendered(work, "lamp.exr", options);
    EXPECT_LE(mean_difference(expected, rendered(work, "kept", options)), 0.05);
    EXPECT_LE(mean_difference(expected, rendered(work, "out", options)), 0.05);
}

TEST(BakeFormats, the_environment_is_seen_behind_the_object) {
    const Workspace work;
    ASSERT_EQ(work.run({"bake", "sky", "-o", "out"}).exit_status, 0);
    const std::vector<std::string> options{"--env-rotation", "40", "--camera", "30,10,4.5"};
    // The sharpest level is blurred, not moved.
    EXPECT_LE(mean_difference(rendered(work, "sky", options), rendered(work, "out", options)), 0.05);
}

TEST(BakeFormats, ktx_is_written_beside_a_json_that_describes_it) {
    const Workspace work;
    const Outcome outcome = work.run({"bake", "test", "-o", "out", "--format", "ktx", "--size", "64"});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.errors;
    EXPECT_EQ(work.files(),
              (std::vector<std::string>{"out/bake.json", "out/test_ibl.ktx", "out/test_ibl.ktx2"}));
    const auto json = nlohmann::json::parse(work.read("out/bake.json"));
    const auto one = test::read_ktx1(read_file(work.folder() / "out/test_ibl.ktx"));
    const auto two = test::read_ktx2(read_file(work.folder() / "out/test_ibl.ktx2"));
    EXPECT_EQ(one.base, 64);
    EXPECT_EQ(two.base, 64);
    ASSERT_EQ(json.at("mips").size(), one.mips.size());
    EXPECT_EQ(json.at("scale"), 1.0);
    std::istringstream roughness(one.values.at("PatinaRoughness"));
    for (const auto& mip : json.at("mips")) {
        float value = -1.0f;
        roughness >> value;
        EXPECT_FLOAT_EQ(value, mip.at("roughness").get<float>());
    }
    EXPECT_TRUE(json.at("timings_ms").contains("write"));
}

TEST(BakeFormats, what_cannot_be_read_back_is_one_sentence) {
    const Workspace work;
    ASSERT_EQ(work.run({"bake", "furnace", "-o", "ktx", "--format", "ktx", "--size", "16"}).exit_status, 0);
    ASSERT_EQ(work.run({"bake", "furnace", "-o", "exr", "--levels", "0.5,1", "--size", "16"}).exit_status, 0);
    work.write("broken/bake.json", "{\"levels\": 5}");
    const auto expect_sentence = [&](const std::vector<std::string>& words, const std::string& part) {
        const Outcome outcome = work.run(words);
        EXPECT_EQ(outcome.exit_status, 1);
        EXPECT_EQ(outcome.error_lines(), 1) << outcome.errors;
        EXPECT_NE(outcome.errors.find(part), std::string::npos) << outcome.errors;
    };
    expect_sentence({"render", "-", "-o", "a.png", "--env", "ktx"}, "--format exr");
    expect_sentence({"render", "-", "-o", "a.png", "--env", "broken"},
                    "broken/bake.json:1:12: levels is not a list");
    expect_sentence({"render", "-", "-o", "a.png", "--env", "none/bake.json"}, "none/bake.json");
    expect_sentence({"bake", "exr", "-o", "again"}, "baked light already");
}

}  // namespace
}  // namespace patina

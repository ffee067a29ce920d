// patina maps on the command line: a preset with its maps from a photo, and what is said when that cannot be.
#include "renderer/core/image_io.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

namespace patina {
namespace {

using test::Outcome;
using test::Workspace;

/// A lit wall of 96×80 with a card of 18 % at its right edge, seen at half its light.
Image wall(float card = 0.18f) {
    Image image = make_image(96, 80, 3, PixelType::F32);
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 96; ++x)
            for (int c = 0; c < 3; ++c) {
                const float stone = 0.4f + 0.1f * std::sin(0.9f * float(x)) * std::cos(0.7f * float(y));
                set_texel(image, x, y, c, 0.5f * (x >= 80 ? card : stone));
            }
    return image;
}

void save_wall(const Workspace& work) { save_image(work.path("wall.exr"), wall()); }

std::vector<std::string> maps_command(std::vector<std::string> more = {}) {
    std::vector<std::string> words{"maps", "wall.exr", "-o", "out", "--size", "64x48"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

const std::vector<std::string> kAll{
    "out/wall.json",       "out/wall_albedo.png",    "out/wall_ao.png", "out/wall_height.png",
    "out/wall_normal.png", "out/wall_roughness.png", "wall.exr"};

TEST(Maps, writes_a_preset_that_draws_with_its_maps) {
    const Workspace work;
    save_wall(work);
    const Outcome outcome =
        work.run(maps_command({"--corners", "0,0", "80,0", "80,80", "0,80", "--grey", "88,40"}));
    ASSERT_EQ(outcome.exit_status, 0) << outcome.errors;
    EXPECT_EQ(work.files(), kAll);
    const Image albedo = load_image(work.path("out/wall_albedo.png")).image;
    EXPECT_EQ(albedo.width, 64);
    EXPECT_EQ(albedo.height, 48);
    double mean = 0.0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) mean += double(srgb_to_linear(texel(albedo, x, y, 0))) / (64.0 * 48.0);
    EXPECT_NEAR(mean, 0.4, 0.02) << "the card says how much light there was";
    EXPECT_EQ(load_image(work.path("out/wall_height.png")).image.type, PixelType::U16);
    EXPECT_EQ(load_image(work.path("out/wall_normal.png")).image.type, PixelType::U16);
    EXPECT_NE(work.read("out/wall.json").find("\"wall_albedo.png\""), std::string::npos) << "relative paths";
    const Outcome check = work.run({"check", "out/wall.json"});
    EXPECT_EQ(check.exit_status, 0) << check.errors;
    const Outcome drawn = work.run({"render", "out/wall.json", "-o", "wall.png", "--mesh", "quad", "--size",
                                    "32x32", "--env", "furnace"});
    EXPECT_EQ(drawn.exit_status, 0) << drawn.errors;
}

TEST(Maps, replaces_nothing_unless_told_to) {
    const Workspace work;
    save_wall(work);
    std::filesystem::create_directory(work.path("out"));
    work.write("out/wall_normal.png", "mine");
    const Outcome refused = work.run(maps_command());
    EXPECT_EQ(refused.exit_status, 1);
    EXPECT_EQ(refused.error_lines(), 1);
    EXPECT_NE(refused.errors.find("wall_normal.png: exists already"), std::string::npos) << refused.errors;
    EXPECT_EQ(work.files(), (std::vector<std::string>{"out/wall_normal.png", "wall.exr"}));
    EXPECT_EQ(work.read("out/wall_normal.png"), "mine");
    EXPECT_EQ(work.run(maps_command({"--name", "other"})).exit_status, 0);
    EXPECT_EQ(work.read("out/wall_normal.png"), "mine");
    EXPECT_EQ(work.run(maps_command({"--force"})).exit_status, 0);
    EXPECT_NE(work.read("out/wall_normal.png"), "mine");
}

TEST(Maps, only_those_asked_for_are_written) {
    const Workspace work;
    save_wall(work);
    ASSERT_EQ(work.run(maps_command({"--only", "albedo,ao", "--no-tile"})).exit_status, 0);
    EXPECT_EQ(work.files(), (std::vector<std::string>{"out/wall.json", "out/wall_albedo.png",
                                                      "out/wall_ao.png", "wall.exr"}));
    EXPECT_EQ(work.read("out/wall.json").find("wall_normal"), std::string::npos);
}

TEST(Maps, what_cannot_be_is_one_sentence_and_leaves_nothing) {
    const Workspace work;
    save_wall(work);
    const std::string whole = work.read("wall.exr");
    work.write("half.exr", whole.substr(0, whole.size() / 2));
    save_image(work.path("dot.png"), make_image(1, 1, 3, PixelType::U8));
    Image broken = make_image(64, 64, 3, PixelType::F32);
    for (int i = 0; i < 64 * 64 * 3; ++i)
        set_texel(broken, i / 3 % 64, i / 192, i % 3, std::numeric_limits<float>::quiet_NaN());
    save_image(work.path("nan.exr"), broken);
    const std::vector<std::string> before = work.files();
    const auto says = [&](std::vector<std::string> words, const std::string& part) {
        const Outcome outcome = work.run(words);
        EXPECT_EQ(outcome.exit_status, 1) << part;
        EXPECT_EQ(outcome.error_lines(), 1) << outcome.errors;
        EXPECT_NE(outcome.errors.find(part), std::string::npos) << outcome.errors;
        EXPECT_EQ(work.files(), before);
    };
    says({"maps", "none.jpg", "-o", "out"}, "none.jpg");
    says({"maps", "half.exr", "-o", "out"}, "half.exr");
    says({"maps", "dot.png", "-o", "out"}, "dot.png: the sample is only 1 pixels wide");
    says({"maps", "nan.exr", "-o", "out"}, "nan.exr: holds no finite number");
    says(maps_command({"--corners", "0,0", "0,80", "80,80", "80,0"}), "order upper left");
    says(maps_command({"--grey", "500,500"}), "at the card");
    says({"maps", "wall.exr", "-o", "half.exr", "--size", "32x32"}, "half.exr");
}

TEST(Maps, wrong_words_are_wrong_usage) {
    const Workspace work;
    EXPECT_EQ(work.run(maps_command({"--corners", "0,0", "1,1"})).exit_status, 2);
    EXPECT_EQ(work.run(maps_command({"--lit-from", "90"})).exit_status, 2);
    EXPECT_EQ(work.run(maps_command({"--lit-from", "90,89"})).exit_status, 2);
    EXPECT_EQ(work.run(maps_command({"--even", "7"})).exit_status, 2);
    EXPECT_EQ(work.run(maps_command({"--size", "0x4"})).exit_status, 2);
    const Outcome help = work.run({"maps", "--help"});
    EXPECT_EQ(help.exit_status, 0);
    for (const char* option : {"--corners", "--grey", "--lit-from", "--strength", "--no-tile", "--force"})
        EXPECT_NE(help.output.find(option), std::string::npos) << option;
}

}  // namespace
}  // namespace patina

// What a command computes and what it leaves out, as --stats tells it; what is left out changes no picture.
#include "renderer/core/image_io.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace patina {
namespace {

using test::Outcome;
using test::Workspace;
namespace fs = std::filesystem;

nlohmann::json stats_of(const Workspace& work, std::vector<std::string> words) {
    words.insert(words.end(), {"--stats", "s.json"});
    fs::remove(work.path("s.json"));
    const Outcome outcome = work.run(words);
    EXPECT_EQ(outcome.exit_status, 0) << outcome.errors;
    return nlohmann::json::parse(work.read("s.json"));
}

TEST(Stats, say_what_was_computed_and_what_was_skipped) {
    const Workspace work;
    const auto stats = [&](const std::vector<std::string>& words) { return stats_of(work, words); };
    const std::vector<std::string> render{"render", "-", "-o", "a.png", "--size", "32x16", "--env", "studio"};
    const nlohmann::json cold = stats(render);
    EXPECT_EQ(cold["work"]["environments_decoded"], 1);
    EXPECT_GE(cold["work"]["levels_baked"], 1);
    EXPECT_EQ(cold["work"]["views_drawn"], 1);
    EXPECT_EQ(cold["work"]["pixels_drawn"], 32 * 16);
    EXPECT_GE(cold["work"]["fragments_shaded"], 32 * 16);  // what the tests run on counts them
    EXPECT_EQ(cold["work"]["maps_decoded"], 0);
    EXPECT_EQ(cold["work"]["tangent_frames"], 0);
    EXPECT_FALSE(cold["skipped"].empty());
    EXPECT_GT(cold["peak_memory_bytes"], 0);
    const nlohmann::json warm = stats(render);
    EXPECT_EQ(warm["work"]["levels_baked"], 0);
    EXPECT_EQ(warm["work"]["bakes_from_disk"], 1);
    const nlohmann::json textured = stats({"render", "worn-paint", "-o", "b.png", "--size", "32x16"});
    EXPECT_GE(textured["work"]["maps_uploaded"], 1);
    EXPECT_GT(textured["work"]["map_bytes_uploaded"], 0);
    const nlohmann::json baked =
        stats({"bake", "studio", "-o", "light", "--size", "16", "--levels", "0.5,1"});
    EXPECT_EQ(baked["work"]["levels_baked"], 2);
}

TEST(Stats, are_written_where_there_was_nothing_to_do) {
    const Workspace work;
    const std::vector<std::string> words{"render", "-",     "-o",      "a.png",       "--size",
                                         "16x16",  "--env", "furnace", "--up-to-date"};
    EXPECT_EQ(stats_of(work, words)["work"]["views_drawn"], 1);
    EXPECT_EQ(stats_of(work, words)["work"]["views_drawn"], 0);
}

/// Whether this is among what was skipped, and how often.
int times_skipped(const nlohmann::json& stats, const std::string& what) {
    for (const nlohmann::json& each : stats["skipped"])
        if (each["what"] == what) return each["times"];
    return 0;
}

TEST(Skipping, bakes_what_the_picture_looks_up_and_says_what_not) {
    const Workspace work;
    const auto baked = [&](std::vector<std::string> more) {
        fs::remove_all(work.folder() / ".cache");
        std::vector<std::string> words{"render", "-", "-o", "a.png", "--size", "16x16", "--env", "studio"};
        words.insert(words.end(), more.begin(), more.end());
        return stats_of(work, words);
    };
    const auto mirror = baked({"--set", "metallic=1", "--set", "roughness=0"});
    EXPECT_EQ(mirror["work"]["sphere_transforms"], 0);
    EXPECT_EQ(mirror["work"]["levels_baked"], 0);
    EXPECT_EQ(mirror["work"]["irradiance_bakes"], 0);
    EXPECT_EQ(times_skipped(mirror, "prefiltered levels"), 1);
    EXPECT_EQ(times_skipped(mirror, "irradiance"), 1);
    const auto uniform = baked({"--shading", "split-sum"});
    EXPECT_EQ(uniform["work"]["levels_baked"], 1);
    EXPECT_EQ(uniform["work"]["irradiance_bakes"], 1);
    EXPECT_EQ(times_skipped(uniform, "further roughness levels"), 1);
    const auto metal = baked({"--shading", "course", "--set", "metallic=1"});
    EXPECT_EQ(metal["work"]["levels_baked"], 1);
    EXPECT_EQ(metal["work"]["irradiance_bakes"], 0);
    const auto swept = baked({});
    EXPECT_LE(swept["work"]["levels_baked"],
              6);  // of 16: those that fitted lobes of one roughness sweep over
    const auto numbers = baked({"--debug-view", "albedo"});
    EXPECT_EQ(numbers["work"]["sphere_transforms"], 0);
    // With that light there, nothing is baked for what is looked up as it is.
    stats_of(work, {"render", "-", "-o", "a.png", "--size", "16x16", "--env", "studio"});
    for (const std::vector<std::string>& change : {std::vector<std::string>{"--env-rotation", "40"},
                                                   {"--exposure", "2"},
                                                   {"--tonemap", "aces"},
                                                   {"--background", "none"}}) {
        std::vector<std::string> words{"render", "-", "-o", "a.png", "--size", "16x16", "--env", "studio"};
        words.insert(words.end(), change.begin(), change.end());
        EXPECT_EQ(stats_of(work, words)["work"]["levels_baked"], 0) << change[0];
    }
}

TEST(Skipping, bakes_nothing_for_the_reference_which_samples_the_panorama) {
    const Workspace work;
    std::vector<std::string> words{"render", "-",      "-o",        "few.exr",   "--size",    "24x24",
                                   "--env",  "studio", "--shading", "reference", "--samples", "16"};
    const auto few = stats_of(work, words);
    EXPECT_EQ(few["work"]["sphere_transforms"], 0);
    words[3] = "all.exr";
    words.emplace_back("--no-skip");
    EXPECT_EQ(stats_of(work, words)["work"]["levels_baked"], 16);
    EXPECT_TRUE(load_image(work.path("few.exr")).image.bytes == load_image(work.path("all.exr")).image.bytes);
}

TEST(Skipping, bakes_for_a_sheet_what_its_maps_reach) {
    const Workspace work;
    Image grey = make_image(8, 8, 1, PixelType::U8);
    for (int i = 0; i < 64; ++i) set_texel(grey, i % 8, i / 8, 0, i % 2 ? 0.5f : 0.52f);
    save_image(work.path("rough.png"), grey);
    work.write("m.json",
               R"({"name": "Mapped", "roughness": {"value": 1, "map": "rough.png", "channel": "r"}})");
    work.write("sheet.json", R"({"rows": [{"preset": "m.json"}, {"preset": "-"}],
        "columns": [{"environment": "studio"}, {"environment": "studio", "rotation_deg": 30}]})");
    const std::vector<std::vector<std::string>> sheets{
        {"compare", "m.json", "-", "-o", "few.png", "--size", "48x48", "--env", "studio"},
        {"compare", "sheet.json", "-o", "few.png", "--size", "48x48"}};
    for (std::vector<std::string> words : sheets) {
        fs::remove_all(work.folder() / ".cache");
        EXPECT_LE(stats_of(work, words)["work"]["levels_baked"], 7) << words[1];
        *std::find(words.begin(), words.end(), "few.png") = "all.png";
        words.emplace_back("--no-skip");
        fs::remove_all(work.folder() / ".cache");
        EXPECT_EQ(stats_of(work, words)["work"]["levels_baked"], 16) << words[1];
        EXPECT_TRUE(load_image(work.path("few.png")).image.bytes ==
                    load_image(work.path("all.png")).image.bytes)
            << words[1];
    }
}

/// One colour all over.
Image plain_picture(int side) {
    Image plain = make_image(side, side, 3, PixelType::U8);
    for (std::size_t i = 0; i < plain.bytes.size(); ++i) plain.bytes[i] = std::byte(40 * (i % 3) + 90);
    return plain;
}

TEST(Skipping, says_what_was_not_kept_of_maps) {
    const Workspace work;
    save_image(work.path("plain.png"), plain_picture(64));
    Image busy = plain_picture(256);
    for (std::size_t i = 0; i < busy.bytes.size(); ++i) busy.bytes[i] = std::byte(i * 37 % 251);
    save_image(work.path("busy.png"), busy);
    work.write("m.json", R"({"name": "Mapped", "albedo": {"map": "busy.png"},
        "roughness": {"map": "plain.png", "channel": "r"}, "ao": {"map": "plain.png", "channel": "g"}})");
    const std::vector<std::string> words{"render", "m.json", "-o",    "a.png",
                                         "--size", "32x32",  "--env", "furnace"};
    const auto few = stats_of(work, words);
    EXPECT_EQ(times_skipped(few, "finer levels of a map"), 1);
    EXPECT_EQ(times_skipped(few, "all texels of a map but one"), 1);
    EXPECT_EQ(times_skipped(few, "tangent frames"), 1);
    EXPECT_EQ(few["work"]["maps_decoded"], 2);  // three slots
    EXPECT_EQ(few["work"]["maps_from_memory"], 1);
    std::vector<std::string> all = words;
    all.emplace_back("--no-skip");
    EXPECT_TRUE(stats_of(work, all)["skipped"].empty());
}

}  // namespace
}  // namespace patina

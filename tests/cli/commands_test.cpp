// The command line end to end: what comes out, and what happens when something is wrong.
#include "renderer/core/file_io.h"
#include "renderer/core/image_io.h"
#include "renderer/ibl/bake.h"
#include "tests/cli/program.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

namespace patina {
namespace {

using test::Outcome;
using test::Workspace;
namespace fs = std::filesystem;

constexpr const char* kPlainPreset = R"({"name": "Plain", "albedo": {"value": [0.5, 0.25, 0.125]}})";

Image picture(int width, int height, float value) {
    Image image = make_image(width, height, 3, PixelType::F32);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) set_texel(image, x, y, c, value);
    return image;
}

/// It failed as it should: status 1, one line that names the culprit, and no file beyond those that were
/// there.
void expect_one_sentence(const Workspace& work, const std::vector<std::string>& words,
                         const std::string& culprit) {
    const std::vector<std::string> before = work.files();
    const Outcome outcome = work.run(words);
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_EQ(outcome.error_lines(), 1) << outcome.errors;
    EXPECT_TRUE(outcome.errors.starts_with("patina: ")) << outcome.errors;
    EXPECT_NE(outcome.errors.find(culprit), std::string::npos) << outcome.errors;
    EXPECT_EQ(work.files(), before);
}

TEST(Render, writes_a_png_of_the_size_asked_for) {
    const Workspace work;
    const Outcome outcome = work.run({"render", "-", "-o", "a.png", "--size", "96x64", "--env", "furnace"});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.errors;
    const Image image = load_image(work.path("a.png")).image;
    EXPECT_EQ(image.width, 96);
    EXPECT_EQ(image.height, 64);
    EXPECT_EQ(image.type, PixelType::U8);
    EXPECT_EQ(work.files(), std::vector<std::string>{"a.png"});
}

TEST(Render, exr_holds_linear_radiance_that_exposure_scales) {
    const Workspace work;
    for (const char* exposure : {"0", "3"})
        ASSERT_EQ(work.run({"render", "-", "-o", std::string("e") + exposure + ".exr", "--size", "32x32",
                            "--env", "furnace", "--exposure", exposure})
                      .exit_status,
                  0);
    const Image dark = load_image(work.path("e0.exr")).image;
    const Image bright = load_image(work.path("e3.exr")).image;
    ASSERT_EQ(dark.type, PixelType::F32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) EXPECT_NEAR(texel(bright, x, y, 1), 8.0f * texel(dark, x, y, 1), 8e-3f);
}

/// A picture as a foreign program writes it.
void write_jpeg(const fs::path& file, const Image& image) {
    const auto output = OIIO::ImageOutput::create(path_text(file));
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    spec["Compression"] = "jpeg:90";
    ASSERT_TRUE(output && output->open(path_text(file), spec)) << OIIO::geterror();
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, image.bytes.data())) << output->geterror();
    ASSERT_TRUE(output->close());
}

/// As fine as it gets: blocks of one texel among slow waves, different in every channel.
Image busy_picture(int side, int phase) {
    Image picture = make_image(side, side, 3, PixelType::U8);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (int c = 0; c < 3; ++c) {
                const float wave = std::sin(0.1f * float(x + phase * c)) * std::cos(0.07f * float(y));
                const float speck = (x * 7 + y * 13 + c * 5 + phase) % 11 == 0 ? 0.2f : 0.0f;
                set_texel(picture, x, y, c, 0.5f + 0.25f * wave + speck);
            }
    return picture;
}

/// Maps four times as fine as the picture shows: what stays of them is filtered as the whole is, and on a
/// surface that is stretched evenly nothing finer is looked up.
TEST(Render, leaves_out_only_what_the_picture_does_not_show) {
    const Workspace work;
    Image orm = busy_picture(512, 1);
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x) set_texel(orm, x, y, 0, 0.8f);  // occlusion: one number
    Image normals = busy_picture(512, 2);
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x) set_texel(normals, x, y, 2, 0.9f);
    save_image(work.path("orm.png"), orm);
    write_jpeg(work.path("albedo.jpg"), busy_picture(512, 3));
    write_jpeg(work.path("normal.jpg"), normals);
    work.write("m.json", R"({"name": "Mapped", "albedo": {"map": "albedo.jpg", "color_space": "srgb"},
        "ao": {"value": 1, "map": "orm.png", "channel": "r"},
        "roughness": {"value": 1, "map": "orm.png", "channel": "g"},
        "metallic": {"value": 1, "map": "orm.png", "channel": "b"},
        "normal": {"value": 0.5, "map": "normal.jpg"}})");
    for (const char* mesh : {"sphere", "quad"}) {
        std::array<nlohmann::json, 2> done;
        for (const bool skip : {true, false}) {
            std::vector<std::string> words{"render", "m.json", "-o",      skip ? "few.png" : "all.png",
                                           "--size", "48x48",  "--env",   "studio",
                                           "--mesh", mesh,     "--stats", "s.json"};
            if (!skip) words.emplace_back("--no-skip");
            const Outcome outcome = work.run(words);
            ASSERT_EQ(outcome.exit_status, 0) << outcome.errors;
            done[skip ? 0 : 1] = nlohmann::json::parse(work.read("s.json"))["work"];
        }
        EXPECT_TRUE(load_image(work.path("few.png")).image.bytes ==
                    load_image(work.path("all.png")).image.bytes)
            << mesh;
        // Of three pictures of 768 KiB never one whole; without skipping five, with their levels beside them.
        EXPECT_LT(done[0]["map_bytes_held"], 3 * 512 * 512) << mesh;
        EXPECT_GT(done[1]["map_bytes_held"], 5 * 3 * 512 * 512) << mesh;
        EXPECT_EQ(done[0]["map_bytes_decoded"], 3 * 3 * 512 * 512);
    }
}

TEST(Render, the_same_command_twice_gives_the_same_bytes) {
    const Workspace work;
    for (const char* extension : {"png", "exr"}) {
        const std::string name = std::string("a.") + extension;
        ASSERT_EQ(
            work.run({"render", "worn-paint", "-o", name, "--size", "80x80", "--env", "night"}).exit_status,
            0);
        const std::string first = work.read(name);
        ASSERT_EQ(
            work.run({"render", "worn-paint", "-o", name, "--size", "80x80", "--env", "night"}).exit_status,
            0);
        EXPECT_FALSE(first.empty());
        EXPECT_TRUE(first == work.read(name)) << name;
    }
}

TEST(Render, the_reference_stops_where_it_is_known_and_says_so) {
    const Workspace work;
    const std::vector<std::string> words{
        "render", "-",       "-o",        "a.exr",     "--size", "24x24",         "--camera", "0,0,1.5",
        "--env",  "furnace", "--shading", "reference", "--set",  "roughness=0.8", "--error",  "5%"};
    const Outcome outcome = work.run(words);
    EXPECT_EQ(outcome.exit_status, 0);
    EXPECT_NE(outcome.errors.find("on average"), std::string::npos) << outcome.errors;
    EXPECT_EQ(outcome.errors.find("asked for"), std::string::npos) << outcome.errors;
    const std::string first = work.read("a.exr");
    EXPECT_EQ(work.run(words).errors, outcome.errors);
    EXPECT_EQ(work.read("a.exr"), first);

    std::vector<std::string> strict = words;
    strict.back() = "0.001%";
    strict.insert(strict.end(), {"--samples", "64"});
    EXPECT_NE(work.run(strict).errors.find("not the 0.001 % asked for"), std::string::npos);
}

TEST(Render, a_set_value_reaches_the_picture) {
    const Workspace work;
    ASSERT_EQ(work.run({"render", "-", "-o", "a.png", "--size", "64x64", "--debug-view", "albedo",
                        "--tonemap", "none", "--set", "albedo=1,0,0"})
                  .exit_status,
              0);
    const Image image = load_image(work.path("a.png")).image;
    EXPECT_EQ(texel(image, 32, 32, 0), 1.0f);
    EXPECT_EQ(texel(image, 32, 32, 1), 0.0f);
}

TEST(Render, reads_maps_beside_the_preset_from_a_folder_with_any_name) {
    const Workspace work;
    fs::create_directories(work.folder() / "Übung 1 – 木");
    Image map = make_image(4, 4, 3, PixelType::U8);
    for (int i = 0; i < 16; ++i) set_texel(map, i % 4, i / 4, 1, 1.0f);
    save_image(work.folder() / "Übung 1 – 木" / "grün.png", map);
    work.write("Übung 1 – 木/p.json", R"({"albedo": {"value": [1, 1, 1], "map": "grün.png"}})");
    const Outcome outcome =
        work.run({"render", "Übung 1 – 木/p.json", "-o", "Übung 1 – 木/aus.png", "--size", "32x32", "--mesh",
                  "quad", "--debug-view", "albedo", "--tonemap", "none"});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.errors;
    const Image image = load_image(work.folder() / "Übung 1 – 木" / "aus.png").image;
    EXPECT_EQ(texel(image, 16, 16, 0), 0.0f);
    EXPECT_EQ(texel(image, 16, 16, 1), 1.0f);
}

TEST(Render, a_missing_map_is_one_sentence_that_names_it) {
    const Workspace work;
    work.write("p.json", R"({"roughness": {"map": "gone.png"}})");
    expect_one_sentence(work, {"render", "p.json", "-o", "a.png"}, "gone.png");
}

TEST(Render, of_several_missing_maps_the_first_slot_is_named) {
    const Workspace work;
    work.write("p.json", R"({"albedo": {"map": "z.png"}, "roughness": {"map": "a.png"}})");
    expect_one_sentence(work, {"render", "p.json", "-o", "a.png"}, "z.png");
}

TEST(Render, a_missing_map_may_be_allowed_and_is_told) {
    const Workspace work;
    work.write("p.json", R"({"albedo": {"map": "gone.png"}})");
    const Outcome outcome =
        work.run({"render", "p.json", "-o", "a.png", "--size", "32x32", "--allow-missing-maps"});
    EXPECT_EQ(outcome.exit_status, 0) << outcome.errors;
    EXPECT_NE(outcome.errors.find("gone.png"), std::string::npos);
    EXPECT_TRUE(fs::exists(work.folder() / "a.png"));
}

TEST(Render, a_broken_preset_is_one_sentence_with_its_line) {
    const Workspace work;
    work.write("p.json", "{\n  \"name\": \"x\",\n  \"albedo\": {\n}");
    expect_one_sentence(work, {"render", "p.json", "-o", "a.png"}, "p.json");
}

TEST(Render, a_truncated_environment_is_one_sentence) {
    const Workspace work;
    save_image(work.folder() / "whole.exr", picture(64, 32, 1.0f));
    const std::string whole = work.read("whole.exr");
    work.write("half.exr", whole.substr(0, whole.size() / 2));
    expect_one_sentence(work, {"render", "-", "-o", "a.png", "--env", "half.exr"}, "half.exr");
}

TEST(Render, pixels_that_are_no_number_are_repaired_and_told) {
    const Workspace work;
    Image sky = picture(64, 32, 1.0f);
    set_texel(sky, 3, 4, 0, std::numeric_limits<float>::quiet_NaN());
    set_texel(sky, 5, 6, 1, std::numeric_limits<float>::infinity());
    set_texel(sky, 7, 8, 2, -2.0f);
    save_image(work.folder() / "sky.exr", sky);
    const Outcome outcome = work.run({"render", "-", "-o", "a.exr", "--size", "48x48", "--env", "sky.exr"});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.errors;
    EXPECT_NE(outcome.errors.find("NaN"), std::string::npos) << outcome.errors;
    const Image image = load_image(work.path("a.exr")).image;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x)
            for (int c = 0; c < 3; ++c) {
                const float value = texel(image, x, y, c);
                ASSERT_TRUE(std::isfinite(value) && value >= 0.0f && value < 4.0f) << value;
            }
}

TEST(Render, a_mesh_without_area_is_one_sentence) {
    const Workspace work;
    work.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    expect_one_sentence(work, {"render", "-", "-o", "a.png", "--mesh", "flat.obj"}, "flat.obj");
}

TEST(Render, a_folder_that_is_not_there_is_one_sentence) {
    const Workspace work;
    expect_one_sentence(work, {"render", "-", "-o", "no/such/folder/a.png", "--size", "16x16"},
                        "no/such/folder");
}

TEST(Render, an_unknown_kind_of_picture_is_refused_before_any_work) {
    const Workspace work;
    expect_one_sentence(work, {"render", "-", "-o", "a.gif"}, "a.gif");
}

TEST(Render, unknown_names_say_what_there_is) {
    const Workspace work;
    expect_one_sentence(work, {"render", "no-such-preset", "-o", "a.png"}, "no-such-preset");
    expect_one_sentence(work, {"render", "-", "-o", "a.png", "--env", "mars"}, "studio");
    expect_one_sentence(work, {"render", "-", "-o", "a.png", "--mesh", "teapot"}, "sphere");
    expect_one_sentence(work, {"render", "-", "-o", "a.png", "--set", "shininess=3"}, "roughness");
}

TEST(Compare, lays_out_presets_as_rows_and_lightings_as_columns) {
    const Workspace work;
    const Outcome outcome = work.run({"compare", "gold", "rubber", "--env", "sky", "--env", "night", "--env",
                                      "furnace", "-o", "s.png", "--size", "64x64"});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.errors;
    const Image sheet = load_image(work.path("s.png")).image;
    EXPECT_GT(sheet.width, 3 * 64);
    EXPECT_LT(sheet.width, 3 * 64 + 64);
    EXPECT_GT(sheet.height, 2 * 64);
    EXPECT_LT(sheet.height, 2 * 64 + 128);
}

TEST(Compare, each_cell_is_the_picture_that_render_makes) {
    const Workspace work;
    ASSERT_EQ(
        work.run({"compare", "gold", "--env", "sky", "--env", "night", "-o", "s.png", "--size", "64x64"})
            .exit_status,
        0);
    ASSERT_EQ(work.run({"render", "gold", "--env", "night", "-o", "c.png", "--size", "64x64"}).exit_status,
              0);
    const Image sheet = load_image(work.path("s.png")).image;
    const Image cell = load_image(work.path("c.png")).image;
    // The second column's cell ends one gap before the lower right corner.
    int matches = 0;
    for (int y = 0; y + 64 <= sheet.height; ++y)
        for (int x = 64; x + 64 <= sheet.width; ++x) {
            bool same = true;
            for (int row = 0; row < 64 && same; ++row)
                same = std::memcmp(sheet.bytes.data() +
                                       (std::size_t(y + row) * std::size_t(sheet.width) + std::size_t(x)) * 3,
                                   cell.bytes.data() + std::size_t(row) * 64 * 3, 64 * 3) == 0;
            matches += same ? 1 : 0;
        }
    EXPECT_EQ(matches, 1);
}

TEST(Bake, writes_what_its_json_lists) {
    const Workspace work;
    const Outcome outcome = work.run({"bake", "furnace", "-o", "out", "--levels", "0.5,1", "--size", "32"});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.errors;
    const auto json = nlohmann::json::parse(work.read("out/bake.json"));
    ASSERT_EQ(json.at("levels").size(), 2u);
    EXPECT_FLOAT_EQ(json["levels"][0].at("roughness").get<float>(), 0.5f);
    EXPECT_FLOAT_EQ(json["levels"][1].at("roughness").get<float>(), 1.0f);
    auto strips =
        std::vector<nlohmann::json>{json.at("levels")[0], json.at("levels")[1], json.at("irradiance")};
    for (const auto& entry : strips) {
        const Image strip = load_image(work.folder() / "out" / entry.at("file").get<std::string>()).image;
        const int size = entry.at("size");
        EXPECT_LE(size, 32);
        ASSERT_EQ(strip.width, 6 * size);
        ASSERT_EQ(strip.height, size);
        ASSERT_EQ(strip.type, PixelType::F32);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < 6 * size; ++x) EXPECT_NEAR(texel(strip, x, y, 1), 1.0f, 1e-5f);
    }
    EXPECT_EQ(json.at("brdf").at("x"), "sqrt(NoV)");
    const Image table =
        load_image(work.folder() / "out" / json.at("brdf").at("file").get<std::string>()).image;
    for (int y = 0; y < table.height; ++y)
        for (int x = 0; x < table.width; ++x)
            EXPECT_LE(texel(table, x, y, 0) + texel(table, x, y, 1), 1.0f + 1e-6f);
    for (const char* stage : {"decode", "transform", "levels", "irradiance", "lights", "write"})
        EXPECT_TRUE(json.at("timings_ms").contains(stage)) << stage;
}

TEST(Bake, face_strips_follow_the_cube_order) {
    const Workspace work;
    // Light from +X only: the right half's middle of the picture.
    Image sky = picture(64, 32, 0.0f);
    for (int y = 8; y < 24; ++y)
        for (int x = 40; x < 56; ++x)
            for (int c = 0; c < 3; ++c) set_texel(sky, x, y, c, 1.0f);
    save_image(work.folder() / "sky.exr", sky);
    ASSERT_EQ(work.run({"bake", "sky.exr", "-o", "out", "--levels", "0.3"}).exit_status, 0);
    const auto json = nlohmann::json::parse(work.read("out/bake.json"));
    const Image strip =
        load_image(work.folder() / "out" / json["levels"][0].at("file").get<std::string>()).image;
    const int size = strip.height;
    EXPECT_GT(texel(strip, size / 2, size / 2, 0), 0.9f);             // +X
    EXPECT_LT(texel(strip, size + size / 2, size / 2, 0), 0.01f);     // −X
    EXPECT_LT(texel(strip, 5 * size + size / 2, size / 2, 0), 0.2f);  // −Z
}

TEST(Bake, replaces_an_earlier_bake_but_no_other_folder) {
    const Workspace work;
    const std::vector<std::string> words{"bake", "furnace", "-o", "out", "--levels", "1"};
    ASSERT_EQ(work.run(words).exit_status, 0);
    ASSERT_EQ(work.run(words).exit_status, 0);
    work.write("mine/thesis.txt", "irreplaceable");
    expect_one_sentence(work, {"bake", "furnace", "-o", "mine"}, "mine");
    EXPECT_EQ(work.read("mine/thesis.txt"), "irreplaceable");
}

TEST(Bake, bad_environments_are_one_sentence_and_leave_nothing) {
    const Workspace work;
    work.write("empty.hdr", "");
    work.write("garbage.exr", "this is no picture");
    work.write("cut.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 512 +X 1024\n\x02\x02\x04");
    for (const char* name : {"empty.hdr", "garbage.exr", "cut.hdr", "missing.hdr"})
        expect_one_sentence(work, {"bake", name, "-o", "out"}, name);
}

TEST(Check, says_ok_of_a_sound_preset) {
    const Workspace work;
    work.write("p.json", kPlainPreset);
    const Outcome outcome = work.run({"check", "p.json", "gold"});
    EXPECT_EQ(outcome.exit_status, 0) << outcome.output << outcome.errors;
    EXPECT_EQ(outcome.output, "p.json: ok\ngold: ok\n");
}

TEST(Check, names_every_problem_and_fails) {
    const Workspace work;
    work.write("maps.json", R"({"albedo": {"map": "gone.png"}, "normal": {"map": "also_gone.png"}})");
    work.write("type.json", "{\n  \"roughness\": {\n    \"value\": \"rough\"\n  }\n}");
    work.write("fine.json", kPlainPreset);
    const Outcome outcome = work.run({"check", "maps.json", "type.json", "fine.json"});
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_NE(outcome.output.find("gone.png"), std::string::npos);
    EXPECT_NE(outcome.output.find("also_gone.png"), std::string::npos);
    EXPECT_NE(outcome.output.find("/roughness/value"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("fine.json: ok"), std::string::npos);
    EXPECT_NE(outcome.errors.find("2 of 3"), std::string::npos);
}

TEST(List, shows_what_can_be_named) {
    const Workspace work;
    const auto lists = [&](const std::string& what, const std::vector<std::string>& names) {
        const Outcome outcome = work.run({"list", what});
        EXPECT_EQ(outcome.exit_status, 0);
        for (const std::string& name : names)
            EXPECT_NE(outcome.output.find(name), std::string::npos) << what << ' ' << name;
    };
    lists("environments", {"studio", "sky", "sunset", "overcast", "night", "furnace", "test"});
    lists("meshes", {"sphere", "quad", "cube", "torus", "shaderball"});
    lists("presets", {"gold", "silver", "copper", "chromium", "rubber", "porcelain"});
    lists("plugins", {"built-in", "openimageio", "openmesh", "png", "openexr", "sphere", "panel"});
}

TEST(Presets, at_least_sixteen_ship_and_all_are_sound) {
    const Workspace work;
    std::vector<std::string> words{"check"};
    for (const auto& entry : fs::directory_iterator(fs::path(PATINA_SHARE_DIR) / "presets"))
        if (entry.path().extension() == ".json" && !entry.path().stem().has_extension())
            words.push_back(entry.path().string());
    EXPECT_GE(words.size(), 17u);
    const Outcome outcome = work.run(words);
    EXPECT_EQ(outcome.exit_status, 0) << outcome.output;
    EXPECT_EQ(outcome.output.find("note:"), std::string::npos) << outcome.output;
}

TEST(Cache, a_second_render_gives_the_same_picture_from_the_cache) {
    const Workspace work;
    ASSERT_EQ(work.run({"render", "-", "-o", "a.exr", "--size", "48x48", "--env", "sky"}).exit_status, 0);
    EXPECT_TRUE(fs::exists(work.folder() / ".cache"));
    const std::string cold = work.read("a.exr");
    ASSERT_EQ(work.run({"render", "-", "-o", "a.exr", "--size", "48x48", "--env", "sky"}).exit_status, 0);
    EXPECT_TRUE(cold == work.read("a.exr"));
    // Whatever lies in the cache, the picture is the same.
    for (const auto& entry : fs::recursive_directory_iterator(work.folder() / ".cache"))
        if (entry.is_regular_file()) fs::resize_file(entry.path(), entry.file_size() / 2);
    ASSERT_EQ(work.run({"render", "-", "-o", "a.exr", "--size", "48x48", "--env", "sky"}).exit_status, 0);
    EXPECT_TRUE(cold == work.read("a.exr"));
}

/// A 1×1 24-bit BMP: the program's module for further formats reads it.
std::string small_bmp() {
    const std::string zeros(4, '\0');
    return "BM" + std::string{58, 0, 0, 0} + zeros +
           std::string{54, 0, 0, 0, 40, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0} + std::string{1, 0, 24, 0} + zeros +
           zeros + zeros + zeros + zeros + zeros + std::string{10, 20, 30, 0};
}

TEST(Module, is_needed_by_rare_formats_alone_and_its_absence_is_one_sentence) {
    const Workspace work;
    work.write("dot.bmp", small_bmp());
    work.write("rare.json", R"({"name": "Rare", "albedo": {"map": "dot.bmp"}})");
    const std::vector<std::string> rare{"render", "rare.json", "-o",    "a.png",
                                        "--size", "16x16",     "--env", "furnace"};
    const Outcome with = work.run(rare);
    EXPECT_EQ(with.exit_status, 0) << with.errors;
    fs::remove(work.path("a.png"));
    setenv("PATINA_MODULE_DIR", work.path("nowhere").c_str(), 1);
    expect_one_sentence(work, rare, "dot.bmp: is a picture of the kind \"bmp\"");
    // PNG maps, a Radiance panorama and EXR output never ask for it.
    const Outcome without =
        work.run({"render", "worn-paint", "-o", "b.exr", "--size", "16x16", "--env", "furnace"});
    unsetenv("PATINA_MODULE_DIR");
    EXPECT_EQ(without.exit_status, 0) << without.errors;
}

#ifdef __linux__
TEST(Module, is_not_what_the_program_is_linked_to) {
    const Workspace work;
    setenv("LD_TRACE_LOADED_OBJECTS", "1", 1);  // the loader lists what it would load, and starts nothing
    const Outcome outcome = work.run({"--help"});
    unsetenv("LD_TRACE_LOADED_OBJECTS");
    EXPECT_NE(outcome.output.find("libc.so"), std::string::npos) << outcome.output << outcome.errors;
    EXPECT_EQ(outcome.output.find("OpenImageIO"), std::string::npos) << outcome.output;
}
#endif

TEST(Edit, without_a_display_is_one_sentence) {
    const Workspace work;
    expect_one_sentence(work, {"edit"}, "display");
}

}  // namespace
}  // namespace patina

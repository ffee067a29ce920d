#include "app/bake_files.h"

#include "app/args.h"
#include "app/ktx.h"
#include "renderer/core/file_io.h"
#include "renderer/core/image_io.h"
#include "tests/unit/app/ktx_reader.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <span>

namespace patina {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class BakeFiles : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("patina-bake-files-" + std::to_string(std::random_device{}()));
        fs::create_directories(folder_);
    }
    void TearDown() override {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }

    /// A small bake whose every texel differs, with one light.
    static BakedEnvironment example() {
        BakedEnvironment baked;
        float value = 0.0f;
        const auto cube = [&](int size) {
            CubeMap map{size, {}};
            for (int i = 0; i < 6 * size * size; ++i) {
                map.texels.emplace_back(value, 2.0f * value + 1.0f, 70000.0f + value);
                value += 0.37f;
            }
            return map;
        };
        baked.levels = {{0.25f, cube(8)}, {0.5f, cube(4)}, {0.7f, cube(3)}};
        baked.irradiance = cube(4);
        baked.lights = {{glm::normalize(glm::vec3(1, 2, -3)), {5.0f, 6.0f, 7.5f}, 0.03f}};
        return baked;
    }
    static Environment source() {
        Environment environment;
        environment.id = "/somewhere/Ein Licht.hdr";
        environment.width = 16;
        environment.height = 8;
        environment.radiance.assign(128, glm::vec3(1.0f));
        environment.content_hash = environment_hash(environment);
        return environment;
    }
    void write_json(const Json& json) const { write_text(json.dump(1)); }
    void write_text(const std::string& text) const {
        write_file(folder_ / "bake.json", std::as_bytes(std::span(text)));
    }
    Json write_example() const {
        Json json = write_bake_exr(folder_, source(), example());
        json["timings_ms"] = Json::object();
        write_json(json);
        return json;
    }
    std::string error_of_loading() const {
        try {
            load_bake(folder_);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    }

    fs::path folder_;
};

TEST_F(BakeFiles, read_back_are_bit_for_bit_what_was_written) {
    write_example();
    for (const fs::path& path : {folder_, folder_ / "bake.json"}) {
        ASSERT_TRUE(is_bake(path));
        const BakedLight light = load_bake(path);
        const BakedEnvironment expected = example();
        ASSERT_EQ(light.baked.levels.size(), 4u);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(light.baked.levels[i].roughness, expected.levels[i].roughness);
            EXPECT_EQ(light.baked.levels[i].cube.size, expected.levels[i].cube.size);
            EXPECT_EQ(light.baked.levels[i].cube.texels, expected.levels[i].cube.texels);
        }
        EXPECT_EQ(light.baked.irradiance.texels, expected.irradiance.texels);
        ASSERT_EQ(light.baked.lights.size(), 1u);
        EXPECT_LE(glm::distance(light.baked.lights[0].direction, expected.lights[0].direction), 1e-6f);
        EXPECT_EQ(light.baked.lights[0].irradiance, expected.lights[0].irradiance);
        EXPECT_EQ(light.baked.lights[0].angular_radius_rad, expected.lights[0].angular_radius_rad);
    }
}

TEST_F(BakeFiles, the_irradiance_stands_in_for_a_missing_level_of_roughness_one) {
    write_example();
    const BakedLight light = load_bake(folder_);
    EXPECT_EQ(light.baked.levels.back().roughness, 1.0f);
    EXPECT_EQ(light.baked.levels.back().cube.texels, light.baked.irradiance.texels);
}

TEST_F(BakeFiles, a_level_too_sharp_to_shade_with_is_only_seen_behind_things) {
    Json json = write_example();
    json["levels"][0]["roughness"] = 0.0;
    write_json(json);
    const BakedLight light = load_bake(folder_);
    EXPECT_EQ(light.baked.levels.front().roughness, 0.5f);
    EXPECT_EQ(light.environment.width, 64);
}

TEST_F(BakeFiles, levels_far_apart_are_noted_and_standard_ones_are_not) {
    write_example();
    ASSERT_EQ(load_bake(folder_).environment.notes.size(), 1u);
    BakedEnvironment baked = example();
    baked.levels.clear();
    for (const float roughness : standard_roughness_levels())
        baked.levels.push_back({roughness, example().irradiance});
    write_json(write_bake_exr(folder_, source(), baked));
    EXPECT_TRUE(load_bake(folder_).environment.notes.empty());
}

TEST_F(BakeFiles, the_panorama_shows_the_sharpest_level_where_it_lies) {
    BakedEnvironment baked = example();
    baked.lights.clear();
    CubeMap& cube = baked.levels[0].cube;
    cube.size = 32;
    cube.texels.clear();
    for (int row = 0; row < 6 * 32; ++row)
        for (int x = 0; x < 32; ++x)
            cube.texels.push_back(1.5f + cube_texel_direction(32, row / 32, x, row % 32));
    write_json(write_bake_exr(folder_, source(), baked));
    const Environment panorama = load_bake(folder_).environment;
    ASSERT_EQ(panorama.width, 128);
    ASSERT_EQ(panorama.height, 64);
    for (int y = 0; y < panorama.height; ++y)
        for (int x = 0; x < panorama.width; ++x) {
            const glm::vec3 d =
                equirect_to_direction({(float(x) + 0.5f) / 128.0f, (float(y) + 0.5f) / 64.0f});
            EXPECT_LE(glm::distance(panorama.radiance[std::size_t(y) * 128 + x], 1.5f + d), 0.05f);
        }
}

TEST_F(BakeFiles, lights_are_drawn_into_the_panorama_with_all_their_irradiance) {
    for (const glm::vec3 towards : {glm::vec3(1, 2, -3), glm::vec3(0, 1, 0), glm::vec3(-1, -0.1f, 0.01f)}) {
        BakedEnvironment baked = example();
        for (glm::vec3& texel : baked.levels[0].cube.texels) texel = glm::vec3(0.0f);
        baked.lights[0].direction = glm::normalize(towards);
        write_json(write_bake_exr(folder_, source(), baked));
        const Environment panorama = load_bake(folder_).environment;
        double irradiance = 0.0;
        for (int y = 0; y < panorama.height; ++y)
            for (int x = 0; x < panorama.width; ++x) {
                const glm::vec3 d = equirect_to_direction(
                    {(float(x) + 0.5f) / float(panorama.width), (float(y) + 0.5f) / float(panorama.height)});
                const double area = 2.0 * std::numbers::pi / panorama.width *
                                    (std::cos(std::numbers::pi * y / panorama.height) -
                                     std::cos(std::numbers::pi * (y + 1) / panorama.height));
                irradiance += area * std::max(0.0f, glm::dot(d, glm::normalize(towards))) *
                              double(panorama.radiance[std::size_t(y) * panorama.width + x].g);
            }
        EXPECT_NEAR(irradiance, 6.0, 1e-3);
    }
}

TEST_F(BakeFiles, every_wrong_entry_is_one_sentence_that_names_file_and_key) {
    struct Wrong {
        std::string key;
        Json value;  ///< null: the key is removed
        std::string said;
    };
    const std::vector<Wrong> all{
        {"/levels", nullptr, "levels is missing"},
        {"/levels", 3, "levels is not a list"},
        {"/levels", Json::array(), "levels is empty"},
        {"/levels/1/roughness", nullptr, "levels.1.roughness is missing"},
        {"/levels/1/roughness", "0.5", "levels.1.roughness is not a number"},
        {"/levels/1/roughness", 1.5, "levels.1.roughness is 1.5"},
        {"/levels/1/roughness", 0.25, "levels.1.roughness is not above the one before"},
        {"/levels/0/size", 0, "levels.0.size is 0"},
        {"/levels/0/size", 1e9, "levels.0.size is"},
        {"/levels/0/size", 8.5, "levels.0.size is not a whole number"},
        {"/levels/0/size", 4, "level_00.exr: is 48x8, not the 24x4"},
        {"/levels/0/file", 7, "levels.0.file is not a file name"},
        {"/levels/0/file", "../level_00.exr", "levels.0.file is not the plain name"},
        {"/levels/0/file", "/etc/passwd", "levels.0.file is not the plain name"},
        {"/levels/0/file", "missing.exr", "missing.exr"},
        {"/irradiance", nullptr, "irradiance.size is missing"},
        {"/irradiance/size", true, "irradiance.size is not a number"},
        {"/lights", nullptr, "lights is missing"},
        {"/lights/0/direction", Json::array({0, 0}), "lights.0.direction does not have three entries"},
        {"/lights/0/direction", Json::array({0, 0, 0}), "lights.0.direction does not have length 1"},
        {"/lights/0/irradiance/1", -1, "lights.0.irradiance.1 is -1"},
        {"/lights/0/angular_radius", "wide", "lights.0.angular_radius is not a number"},
    };
    const Json good = write_example();
    for (const Wrong& wrong : all) {
        Json json = good;
        const Json::json_pointer pointer(wrong.key);
        if (wrong.value.is_null())
            json.at(pointer.parent_pointer()).erase(pointer.back());
        else
            json[pointer] = wrong.value;
        write_json(json);
        const std::string error = error_of_loading();
        EXPECT_NE(error.find(wrong.said), std::string::npos) << wrong.key << ": " << error;
        EXPECT_NE(error.find(folder_.string()), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

TEST_F(BakeFiles, text_that_is_no_bake_is_refused) {
    write_example();
    for (const char* text :
         {"", "{", "[]", "null", "\"levels\"", "{\"levels\": [1]}", "{\"levels\": [{}]}"}) {
        write_text(text);
        EXPECT_NE(error_of_loading().find("bake.json"), std::string::npos)
            << text << ": " << error_of_loading();
    }
    write_text(std::string(2 << 20, ' '));
    EXPECT_NE(error_of_loading().find("larger than"), std::string::npos);
    fs::remove(folder_ / "bake.json");
    EXPECT_FALSE(is_bake(folder_));
    EXPECT_THROW(load_bake(folder_ / "bake.json"), std::runtime_error);
}

TEST_F(BakeFiles, a_damaged_strip_is_refused) {
    write_example();
    const fs::path strip = folder_ / "level_01.exr";
    const std::vector<std::byte> bytes = read_file(strip);
    write_file(strip, std::span(bytes).first(bytes.size() / 2));
    EXPECT_NE(error_of_loading().find("level_01.exr"), std::string::npos);
    Image picture = make_image(24, 4, 3, PixelType::F32);
    set_texel(picture, 3, 1, 1, -0.5f);
    save_image(strip, picture);
    EXPECT_NE(error_of_loading().find("level_01.exr: holds light that is negative"), std::string::npos);
    set_texel(picture, 3, 1, 1, std::numeric_limits<float>::infinity());
    save_image(strip, picture);
    EXPECT_NE(error_of_loading().find("level_01.exr: holds light that is negative or not finite"),
              std::string::npos);
}

TEST_F(BakeFiles, more_levels_than_the_renderer_takes_are_refused) {
    Json json = write_example();
    for (int i = 0; i < 40; ++i) json["levels"].push_back(json["levels"][2]);
    write_json(json);
    EXPECT_NE(error_of_loading().find("levels has more than"), std::string::npos);
}

TEST_F(BakeFiles, ktx_files_are_named_by_bake_json_and_hold_the_same_light) {
    const BakedEnvironment baked = *bake_for_ktx(source(), 16, {});
    const Json json = write_bake_ktx(folder_, source(), baked);
    write_json(json);
    EXPECT_EQ(json["ktx"]["file"], "Ein_Licht_ibl.ktx");
    EXPECT_EQ(json["ktx2"]["file"], "Ein_Licht_ibl.ktx2");
    EXPECT_EQ(json["scale"], 1.0);
    const test::KtxFile one = test::read_ktx1(read_file(folder_ / "Ein_Licht_ibl.ktx"));
    const test::KtxFile two = test::read_ktx2(read_file(folder_ / "Ein_Licht_ibl.ktx2"));
    ASSERT_EQ(json["mips"].size(), one.mips.size());
    ASSERT_EQ(json["mips"].size(), two.mips.size());
    for (std::size_t mip = 0; mip < one.mips.size(); ++mip) {
        EXPECT_EQ(json["mips"][mip]["size"], 16 >> mip);
        EXPECT_EQ(json["mips"][mip]["roughness"].get<float>(), baked.levels[mip].roughness);
        EXPECT_NEAR(one.mips[mip][0], 1.0f, 2e-3f);  // a white furnace at every roughness
    }
    ASSERT_EQ(json["irradiance_sh"].size(), 9u);
    EXPECT_NEAR(json["irradiance_sh"][0][0].get<float>(), 1.0f, 1e-3f);
    EXPECT_NE(error_of_loading().find("--format exr"), std::string::npos);
}

TEST(BakeArguments, ktx_takes_a_power_of_two_and_no_levels) {
    EXPECT_EQ(parse_args({"bake", "sky", "-o", "d", "--format", "ktx", "--size", "64"}).args->bake.format,
              "ktx");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"bake", "sky", "-o", "d", "--format", "ktx", "--size", "100"},
          {"bake", "sky", "-o", "d", "--format", "ktx", "--levels", "0.5"},
          {"bake", "sky", "-o", "d", "--format", "dds"}}) {
        const ParsedArgs parsed = parse_args(words);
        EXPECT_FALSE(parsed.args.has_value());
        EXPECT_EQ(parsed.exit_status, 2);
    }
}

TEST(BakeArguments, a_bake_among_the_lightings_of_compare_is_no_preset) {
    const ParsedArgs parsed =
        parse_args({"compare", "gold.json", "-o", "s.png", "--env", "sky", "there/bake.json", "iron.json"});
    ASSERT_TRUE(parsed.args.has_value());
    EXPECT_EQ(parsed.args->render.presets, (std::vector<std::string>{"gold.json", "iron.json"}));
    EXPECT_EQ(parsed.args->render.scene.environments, (std::vector<std::string>{"sky", "there/bake.json"}));
}

}  // namespace
}  // namespace patina

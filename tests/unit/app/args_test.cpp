#include "app/args.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patina {
namespace {

Args parsed(const std::vector<std::string>& words) {
    const ParsedArgs result = parse_args(words);
    EXPECT_TRUE(result.args.has_value()) << result.message;
    return result.args.value_or(Args{});
}

TEST(Args, no_words_open_the_editor) { EXPECT_EQ(parsed({}).command, Command::Edit); }

TEST(Args, a_preset_alone_is_opened_in_the_editor) {
    const Args args = parsed({"rust.json", "--mesh", "quad", "--env", "sky"});
    EXPECT_EQ(args.command, Command::Edit);
    EXPECT_EQ(args.edit.preset, "rust.json");
    EXPECT_EQ(args.edit.mesh, "quad");
    EXPECT_EQ(args.edit.environment, "sky");
}

TEST(Args, the_reference_stops_at_a_count_or_an_error) {
    const auto scene = [](std::vector<std::string> words) {
        words.insert(words.begin(), {"render", "gold", "-o", "a.png"});
        return parsed(words).render.scene;
    };
    EXPECT_EQ(scene({}).error, 0.0) << "as many points as asked for";
    EXPECT_EQ(scene({"--samples", "96"}).samples, 96);
    EXPECT_DOUBLE_EQ(scene({"--samples", "auto"}).error, 0.01);
    EXPECT_GT(scene({"--samples", "auto"}).samples, 10000);
    EXPECT_NEAR(scene({"--error", "0.5%"}).error, 0.005, 1e-9);
    EXPECT_NEAR(scene({"--error", "0.005"}).error, 0.005, 1e-9);
    EXPECT_EQ(scene({"--samples", "2048", "--error", "1%"}).samples, 2048) << "the most";
    EXPECT_EQ(scene({"--error", "1%", "--samples", "2048"}).samples, 2048);
    for (const char* wrong : {"0", "x", "-1%", "80%", "", "%"})
        EXPECT_FALSE(parse_args({"render", "gold", "-o", "a.png", "--error", wrong}).args) << wrong;
    for (const char* wrong : {"0", "12x", "-1", "", "99999999"})
        EXPECT_FALSE(parse_args({"render", "gold", "-o", "a.png", "--samples", wrong}).args) << wrong;
}

TEST(Args, render_reads_every_option) {
    const Args args = parsed({"render",
                              "gold",
                              "-o",
                              "a.exr",
                              "--mesh",
                              "torus",
                              "--env",
                              "sky",
                              "--env-rotation",
                              "-90",
                              "--exposure",
                              "-1.5",
                              "--size",
                              "64x32",
                              "--camera",
                              "-30,20,6",
                              "--shading",
                              "course",
                              "--tonemap",
                              "aces",
                              "--background",
                              "none",
                              "--set",
                              "roughness=0.3",
                              "--set",
                              "albedo=0.8,0.1,0.1"});
    EXPECT_EQ(args.command, Command::Render);
    const SceneOptions& scene = args.render.scene;
    EXPECT_EQ(args.render.presets, std::vector<std::string>{"gold"});
    EXPECT_EQ(args.render.output, "a.exr");
    EXPECT_EQ(scene.mesh, "torus");
    EXPECT_EQ(scene.environments, std::vector<std::string>{"sky"});
    EXPECT_EQ(scene.view.env_rotation_deg, -90.0f);
    EXPECT_EQ(scene.view.exposure_ev, -1.5f);
    EXPECT_EQ(scene.size_px, glm::ivec2(64, 32));
    EXPECT_EQ(scene.camera.yaw_deg, -30.0f);
    EXPECT_EQ(scene.camera.pitch_deg, 20.0f);
    EXPECT_EQ(scene.camera.distance, 6.0f);
    EXPECT_EQ(scene.view.shading, Shading::Course);
    EXPECT_EQ(scene.view.tonemap, Tonemap::Aces);
    EXPECT_EQ(scene.view.background, Background::Plain);
    const std::vector<std::pair<std::string, std::string>> overrides{{"roughness", "0.3"},
                                                                     {"albedo", "0.8,0.1,0.1"}};
    EXPECT_EQ(scene.overrides, overrides);
}

TEST(Args, the_dash_preset_is_the_default_material) {
    EXPECT_EQ(parsed({"render", "-", "-o", "a.png"}).render.presets, std::vector<std::string>{"-"});
}

TEST(Args, compare_takes_several_presets_and_environments_in_any_order) {
    const std::vector<std::string> presets{"a.json", "b.json"};
    const std::vector<std::string> environments{"sky", "night"};
    for (const auto& words : std::vector<std::vector<std::string>>{
             {"compare", "a.json", "b.json", "--env", "sky", "--env", "night", "-o", "s.png"},
             {"compare", "-o", "s.png", "--env", "sky", "night", "a.json", "b.json"}}) {
        const Args args = parsed(words);
        EXPECT_EQ(args.render.presets, presets);
        EXPECT_EQ(args.render.scene.environments, environments);
    }
}

TEST(Args, bake_sorts_its_levels) {
    const Args args =
        parsed({"bake", "sky", "-o", "d", "--levels", "0.5,0.1,1", "--size", "64", "--keep-lights"});
    EXPECT_EQ(args.bake.roughness, (std::vector<float>{0.1f, 0.5f, 1.0f}));
    EXPECT_EQ(args.bake.size, 64);
    EXPECT_TRUE(args.bake.keep_lights);
}

TEST(Args, help_and_version_are_no_error) {
    for (const char* word : {"--help", "--version"}) {
        const ParsedArgs result = parse_args({word});
        EXPECT_FALSE(result.args.has_value());
        EXPECT_EQ(result.exit_status, 0);
        EXPECT_NE(result.message.find("atina"), std::string::npos);
    }
}

class WrongUsage : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(WrongUsage, is_exit_status_2_with_one_line) {
    const ParsedArgs result = parse_args(GetParam());
    EXPECT_FALSE(result.args.has_value());
    EXPECT_EQ(result.exit_status, 2);
    EXPECT_EQ(result.message.rfind("patina: ", 0), 0u);
    EXPECT_EQ(std::count(result.message.begin(), result.message.end(), '\n'), 1) << result.message;
}

INSTANTIATE_TEST_SUITE_P(
    Args, WrongUsage,
    testing::Values(std::vector<std::string>{"render"}, std::vector<std::string>{"compare", "-o", "x.png"},
                    std::vector<std::string>{"render", "gold"},
                    std::vector<std::string>{"render", "a", "b", "-o", "x.png"},
                    std::vector<std::string>{"render", "a", "-o", "x.png", "--size", "0x10"},
                    std::vector<std::string>{"render", "a", "-o", "x.png", "--size", "10"},
                    std::vector<std::string>{"render", "a", "-o", "x.png", "--size", "1e9x1e9"},
                    std::vector<std::string>{"render", "a", "-o", "x.png", "--camera", "1,2"},
                    std::vector<std::string>{"render", "a", "-o", "x.png", "--camera", "nan,0,1"},
                    std::vector<std::string>{"render", "a", "-o", "x.png", "--tonemap", "filmic"},
                    std::vector<std::string>{"render", "a", "-o", "x.png", "--exposure", "1000"},
                    std::vector<std::string>{"render", "a", "-o", "x.png", "--set", "roughness"},
                    std::vector<std::string>{"bake", "sky", "-o", "d", "--levels", "2"},
                    std::vector<std::string>{"bake", "sky"}, std::vector<std::string>{"list", "everything"},
                    std::vector<std::string>{"--no-such-option"}));

}  // namespace
}  // namespace patina

// Baked light leaves the program and comes back: KTX for others, face strips for itself.
#include "renderer/core/file_io.h"
#include "renderer/core/image_io.h"
#include "tests/cli/program.h"
#include "tests/unit/app/ktx_reader.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace patina {
namespace {

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

TEST(BakeFormats, a_picture_under_a_bake_is_the_picture_under_its_source) {
    const Workspace work;
    for (const char* environment : {"sunset", "studio"}) {
        const std::string folder = std::string("baked-") + environment;
        ASSERT_EQ(work.run({"bake", environment, "-o", folder}).exit_status, 0);
        for (const char* roughness : {"roughness=0.15", "roughness=0.6"}) {
            const std::vector<std::string> options{"--background", "none",  "--set",
                                                   "metallic=0.5", "--set", roughness};
            const Image expected = rendered(work, environment, options);
            EXPECT_LE(mean_difference(expected, rendered(work, folder, options)), 0.01) << roughness;
            EXPECT_LE(mean_difference(expected, rendered(work, folder + "/bake.json", options)), 0.01)
                << roughness;
        }
    }
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

#include "app/bench_markdown.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

TEST(BenchMarkdown, lists_methods_by_roughness_with_the_worst_error) {
    Json result{{"environments", Json::array()}};
    for (const double rms : {0.01, 0.02})
        result["environments"].push_back(
            {{"levels",
              Json::array({{{"method", "transform"}, {"roughness", 1.0}, {"ms", 2.0}, {"rms", rms}},
                           {{"method", "transform"}, {"roughness", 0.1}, {"ms", 3.0}, {"rms", rms}},
                           {{"method", "sampling 64"}, {"roughness", 1.0}, {"ms", 9.0}, {"rms", 0.5}}})}});
    result["scaling"] = Json::array({{{"width", 512},
                                      {"height", 256},
                                      {"threads", 2},
                                      {"bake_ms", 30.0},
                                      {"first_light_ms", 1.25},
                                      {"peak_growth_mib", 20.0}}});
    result["fetch"] = Json::array({{{"roughness", 0.1}, {"face_size", 128}, {"rms", 0.015}}});
    const std::string text = bench_markdown("ibl", result);
    EXPECT_NE(text.find("| method | r 0.10 | r 1.00 |"), std::string::npos) << text;
    EXPECT_NE(text.find("| transform | 3.0 ms, 2.000 % | 2.0 ms, 2.000 % |"), std::string::npos) << text;
    EXPECT_NE(text.find("| sampling 64 |  | 9.0 ms, 50.000 % |"), std::string::npos) << text;
    EXPECT_NE(text.find("| 512×256 | 2 | 30.0 ms | 1.2 ms | 20 MiB |"), std::string::npos) << text;
    EXPECT_NE(text.find("| 0.100 | 128² | 1.500 % |"), std::string::npos) << text;
    EXPECT_TRUE(bench_markdown("light", result).empty());
}

TEST(BenchMarkdown, means_shading_errors_by_roughness_and_by_angle) {
    Json result{{"roughness_range", "0.1 to 1"}, {"NoV_bands", {0.0, 0.5, 1.0}}};
    result["modes"] = Json::array(
        {{{"name", "split-sum"}, {"cost", 1.0}, {"rms", {{"metal", 0.3}, {"dielectric", 0.05}}}}});
    result["cases"] = Json::array();
    for (const double rms : {0.1, 0.3})
        result["cases"].push_back({{"mode", "split-sum"},
                                   {"mesh", "sphere"},
                                   {"material", "metal"},
                                   {"roughness", 0.1},
                                   {"rms", rms},
                                   {"rms_by_NoV", {2.0 * rms, 0.5 * rms}}});
    const std::string text = bench_markdown("shading", result);
    EXPECT_NE(text.find("| split-sum | 30.00 % | 5.00 % | 1.00 |"), std::string::npos) << text;
    EXPECT_NE(text.find("| mode | 0.10 |"), std::string::npos) << text;
    EXPECT_NE(text.find("| split-sum | 20.00 % |"), std::string::npos) << text;
    EXPECT_NE(text.find("| mode | 0.0–0.5 | 0.5–1.0 |"), std::string::npos) << text;
    EXPECT_NE(text.find("| split-sum | 40.00 % | 10.00 % |"), std::string::npos) << text;
}

TEST(BenchMarkdown, gives_time_memory_and_ledger_of_every_row_with_skipping_and_without) {
    const auto step = [](double ms, double mib, int calls) {
        return Json{{"ms", ms}, {"mib", mib}, {"work", {{"draw_calls", calls}, {"views_drawn", 4}}}};
    };
    const auto visit = [](double ms, int decoded) {
        return Json{{"light_ready_ms", ms},
                    {"first_picture_ms", ms + 2.0},
                    {"drawing_ms", 8.0},
                    {"seen_ms", ms + 8.5},
                    {"seen_less_drawing_ms", ms + 0.5},
                    {"mib", 9.0},
                    {"work", {{"environments_decoded", decoded}}}};
    };
    const auto command = [](double ms, int levels) {
        return Json{{"cpu_ms", ms},
                    {"wall_ms", 2.0 * ms},
                    {"peak_mib", 0.5 * ms},
                    {"work", {{"levels_baked", levels}}}};
    };
    const Json result{
        {"commands", Json::array({{{"name", "gold"},
                                   {"side_px", 256},
                                   {"skip", command(100, 2)},
                                   {"no_skip", command(200, 16)},
                                   {"largest_code_step", 0}}})},
        {"steps", Json::array({{{"name", "orbit"},
                                {"skip", step(3.0, 20.0, 5)},
                                {"no_skip", step(4.0, 30.0, 12)},
                                {"ratio", 0.75}}})},
        {"shared_views", Json::array({{{"name", "four / one"}, {"ratio", 1.25}}})},
        {"environment_switch", Json::array({{{"environment", "room.hdr"},
                                             {"decode_ms", 11.0},
                                             {"cases", Json::array({{{"name", "disk cache"},
                                                                     {"skip", visit(7.0, 0)},
                                                                     {"no_skip", visit(60.0, 1)}}})}}})}};
    const std::string text = bench_markdown("skip", result);
    EXPECT_NE(text.find("| gold | 256 | 100 (200) | 200 (400) | 50 (100) | 0 | levels_baked 2 (16) |"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("| orbit | 3.0 (4.0) | 0.75 | 20.0 (30.0) | draw_calls 5 (12) |"), std::string::npos)
        << text;
    EXPECT_NE(text.find("Another environment (room.hdr)"), std::string::npos) << text;
    EXPECT_NE(
        text.find(
            "| disk cache | 7.0 (60.0) | 9.0 (62.0) | 8.0 (8.0) | 15.5 (68.5) | 7.5 (60.5) | 9.0 (9.0) | "
            "environments_decoded 0 (1) |"),
        std::string::npos)
        << text;
}

}  // namespace
}  // namespace patina

#include "app/plot_bench.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

Json level(const char* method, double roughness, double ms, double rms) {
    return {{"method", method}, {"roughness", roughness}, {"ms", ms}, {"rms", rms}};
}

TEST(BenchPlots, ibl_has_one_plot_a_roughness_with_medians_over_environments) {
    Json result{{"instruction_set", "AVX2"}, {"environments", Json::array()}};
    for (int i = 0; i < 3; ++i)
        result["environments"].push_back(
            {{"levels",
              Json::array({level("transform", 0.3, 2.0 + i, 1e-4),
                           level("sampling 64", 0.3, 10.0, 0.1 * (i + 1)),
                           level("sampling 1024", 0.3, 100.0, 0.01), level("transform", 1.0, 1.0, 1e-5)})}});
    const std::vector<NamedPlot> plots = bench_plots("ibl", result);
    ASSERT_EQ(plots.size(), 2u);
    EXPECT_EQ(plots[0].stem, "ibl-roughness-030");
    EXPECT_EQ(plots[1].stem, "ibl-roughness-100");
    const Plot& plot = plots[0].plot;
    EXPECT_TRUE(plot.pareto);
    ASSERT_EQ(plot.series.size(), 2u);
    EXPECT_EQ(plot.series[0].name, "transform");
    EXPECT_DOUBLE_EQ(plot.series[0].points.at(0).x, 3.0);
    EXPECT_EQ(plot.series[1].name, "sampling");
    ASSERT_EQ(plot.series[1].points.size(), 2u);
    EXPECT_EQ(plot.series[1].points[0].label, "64");
    EXPECT_DOUBLE_EQ(plot.series[1].points[0].y, 20.0);
    EXPECT_EQ(pareto_front(plot), (std::vector<ParetoPoint>{{0, 0}}));
}

TEST(BenchPlots, frame_has_a_series_a_case) {
    Json result{{"renderer", "GL"}, {"cases", Json::array()}};
    for (const int side : {256, 512})
        for (const char* name : {"split-sum", "course"})
            result["cases"].push_back({{"name", name}, {"side_px", side}, {"ms", side / 100.0}});
    const std::vector<NamedPlot> plots = bench_plots("frame", result);
    ASSERT_EQ(plots.size(), 1u);
    ASSERT_EQ(plots[0].plot.series.size(), 2u);
    EXPECT_EQ(plots[0].plot.series[1].name, "course");
    EXPECT_EQ(plots[0].plot.series[1].points.size(), 2u);
}

TEST(BenchPlots, light_is_plotted_only_over_different_sizes) {
    Json result{{"environments", Json::array()}};
    const auto add = [&](int width) {
        result["environments"].push_back({{"id", "e"},
                                          {"width", width},
                                          {"height", width / 2},
                                          {"load_ms", 1.0},
                                          {"bake_and_save_ms", 2.0},
                                          {"cached_ms", 0.1}});
    };
    add(1024);
    add(1024);
    EXPECT_TRUE(bench_plots("light", result).empty());
    add(2048);
    ASSERT_EQ(bench_plots("light", result).size(), 1u);
    EXPECT_EQ(bench_plots("light", result)[0].plot.series[0].points.size(), 3u);
}

TEST(BenchPlots, an_unknown_benchmark_has_none) {
    EXPECT_TRUE(bench_plots("weather", Json::object()).empty());
}

}  // namespace
}  // namespace patina

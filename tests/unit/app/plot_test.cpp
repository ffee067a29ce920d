#include "app/plot.h"

#include "app/plot_drawing.h"
#include "app/plot_io.h"
#include "renderer/core/image_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <set>

namespace patina {
namespace {

namespace fs = std::filesystem;

Plot example() {
    Plot plot;
    plot.title = "Error over time";
    plot.x = {"time (ms)", true};
    plot.y = {"error (%)", true};
    plot.series = {{"transform", {{1, 10, "L = 1"}, {2, 3, "L = 2"}, {8, 0.5, "L = 3"}}},
                   {"sampling", {{4, 20, "16"}, {16, 9, "64"}, {64, 0.4, "256"}}}};
    plot.pareto = true;
    return plot;
}

std::vector<std::string> texts(const PlotDrawing& drawing) {
    std::vector<std::string> found;
    for (const PlotShape& shape : drawing.shapes)
        if (const auto* text = std::get_if<PlotText>(&shape.geometry)) found.push_back(text->text);
    return found;
}
bool says(const PlotDrawing& drawing, const std::string& part) {
    return std::ranges::any_of(texts(drawing),
                               [&](const std::string& t) { return t.find(part) != std::string::npos; });
}
std::vector<std::string> labels(const PlotScale& scale) {
    std::vector<std::string> found;
    for (const PlotTick& tick : scale.ticks)
        if (!tick.text.empty()) found.push_back(tick.text);
    return found;
}

TEST(Plot, pareto_front_holds_what_nothing_beats_in_both) {
    const std::vector<ParetoPoint> expected{{0, 0}, {0, 1}, {0, 2}, {1, 2}};
    EXPECT_EQ(pareto_front(example()), expected);
}

TEST(Plot, pareto_front_keeps_equal_points_and_drops_ties_in_one) {
    Plot plot;
    plot.series = {{"a", {{1, 5, ""}, {1, 4, ""}, {2, 4, ""}, {3, 1, ""}}}, {"b", {{1, 4, ""}, {3, 1, ""}}}};
    const std::vector<ParetoPoint> expected{{0, 1}, {1, 0}, {0, 3}, {1, 1}};
    EXPECT_EQ(pareto_front(plot), expected);
}

TEST(Plot, pareto_front_agrees_with_the_definition_on_random_points) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> coordinate(0, 12);
    for (int round = 0; round < 200; ++round) {
        Plot plot;
        plot.series.resize(2);
        for (int i = 0; i < 24; ++i)
            plot.series[std::size_t(i % 2)].points.push_back(
                {double(coordinate(random)), double(coordinate(random)), ""});
        std::set<std::pair<std::size_t, std::size_t>> found;
        for (const ParetoPoint& each : pareto_front(plot)) found.insert({each.series, each.point});
        for (std::size_t s = 0; s < 2; ++s)
            for (std::size_t p = 0; p < plot.series[s].points.size(); ++p) {
                const PlotPoint& point = plot.series[s].points[p];
                bool beaten = false;
                for (const PlotSeries& series : plot.series)
                    for (const PlotPoint& other : series.points)
                        beaten |= other.x <= point.x && other.y <= point.y &&
                                  (other.x < point.x || other.y < point.y);
                EXPECT_EQ(found.count({s, p}) == 1, !beaten) << point.x << "," << point.y;
            }
    }
}

TEST(Plot, points_that_a_logarithm_cannot_show_are_left_out_and_counted) {
    Plot plot = example();
    plot.series[0].points.push_back({0.0, 1e-9, ""});
    plot.series[0].points.push_back({0.5, std::numeric_limits<double>::quiet_NaN(), ""});
    EXPECT_EQ(pareto_front(plot), pareto_front(example()));
    EXPECT_TRUE(says(layout_plot(plot), "2 points are not drawn"));
    EXPECT_FALSE(says(layout_plot(example()), "not drawn"));
}

TEST(Plot, lists_the_pareto_front_with_names_and_values) {
    const PlotDrawing drawing = layout_plot(example());
    EXPECT_TRUE(says(drawing, "transform, L = 3  (8, 0.5)"));
    EXPECT_TRUE(says(drawing, "sampling, 256  (64, 0.4)"));
    EXPECT_FALSE(says(drawing, "sampling, 16 "));
    Plot plain = example();
    plain.pareto = false;
    EXPECT_FALSE(says(layout_plot(plain), "transform, L = 3"));
}

TEST(Plot, legend_and_text_stay_inside_the_picture_and_off_the_data) {
    Plot plot = example();
    plot.title =
        "A title that is a good deal longer than the plot is wide, so that the picture has to grow with it";
    plot.subtitle = plot.title + ", and a subtitle";
    plot.notes = {plot.title + " " + plot.title + " " + plot.title};
    for (int i = 0; i < 30; ++i)
        plot.series.push_back({"series with a long name " + std::to_string(i), {{3.0 + i, 5.0, ""}}});
    const PlotDrawing drawing = layout_plot(plot);
    double data_right = 0.0;
    for (const PlotShape& shape : drawing.shapes)
        if (const auto* polygon = std::get_if<Polygon>(&shape.geometry))
            if (polygon->corners.size() == 4 && polygon->stroke_width == 0.0)
                data_right = polygon->corners[2].x;
    ASSERT_GT(data_right, 100.0);
    for (const PlotShape& shape : drawing.shapes)
        if (const auto* text = std::get_if<PlotText>(&shape.geometry)) {
            const double width = plot_text_width(text->text, text->size);
            const double share = text->anchor == TextAnchor::Start    ? 0.0
                                 : text->anchor == TextAnchor::Middle ? 0.5
                                                                      : 1.0;
            const double left = text->baseline.x - share * width;
            EXPECT_GE(left, 0.0) << text->text;
            EXPECT_LE(left + width, drawing.width) << text->text;
            EXPECT_GE(text->baseline.y - text->size, 0.0) << text->text;
            EXPECT_LE(text->baseline.y + 0.3 * text->size, drawing.height) << text->text;
            const bool legend = text->text.starts_with("series with");
            EXPECT_TRUE(!legend || left > data_right) << text->text;
        }
}

TEST(Plot, linear_ticks_stand_at_one_two_five) {
    EXPECT_EQ(labels(make_scale(false, {0.0, 95.0})),
              (std::vector<std::string>{"0", "20", "40", "60", "80"}));
    EXPECT_EQ(labels(make_scale(false, {-0.001, 0.0021})),
              (std::vector<std::string>{"-0.001", "-0.0005", "0", "0.0005", "0.001", "0.0015", "0.002"}));
    const PlotScale scale = make_scale(false, {10.0, 11.0});
    EXPECT_EQ(labels(scale), (std::vector<std::string>{"10", "10.2", "10.4", "10.6", "10.8", "11"}));
    EXPECT_LT(scale.low, 10.0);
    EXPECT_GT(scale.high, 11.0);
}

TEST(Plot, logarithmic_ticks_stand_at_decades_with_a_minor_grid) {
    EXPECT_EQ(labels(make_scale(true, {1.0, 1000.0})), (std::vector<std::string>{"1", "10", "100", "1000"}));
    EXPECT_EQ(labels(make_scale(true, {0.9, 30.0})), (std::vector<std::string>{"1", "2", "5", "10", "20"}));
    EXPECT_EQ(labels(make_scale(true, {2e-9, 4e-7})),
              (std::vector<std::string>{"2×10⁻⁹", "5×10⁻⁹", "10⁻⁸", "2×10⁻⁸", "5×10⁻⁸", "10⁻⁷", "2×10⁻⁷",
                                        "5×10⁻⁷"}));
    const PlotScale scale = make_scale(true, {1.0, 1000.0});
    EXPECT_GT(scale.ticks.size(), 25u);
    EXPECT_NEAR(scale.position(std::sqrt(1000.0)), 0.5, 1e-9);
    EXPECT_LE(labels(make_scale(true, {1e-30, 1e30})).size(), 10u);
}

TEST(Plot, every_axis_has_labels_whatever_the_values) {
    for (const bool log : {false, true})
        for (const std::vector<double>& values :
             {std::vector<double>{}, {5.0}, {1e-300}, {1e300}, {1.0, 1.0 + 1e-12}, {3.0, 3.1}, {1e-5, 1e5}}) {
            const PlotScale scale = make_scale(log, values);
            EXPECT_GE(labels(scale).size(), 1u);
            EXPECT_LE(scale.ticks.size(), 200u);
            for (const double value : values) {
                EXPECT_GE(scale.position(value), 0.0);
                EXPECT_LE(scale.position(value), 1.0);
            }
            const std::vector<std::string> all = labels(scale);
            EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
        }
}

TEST(Plot, numbers_are_short) {
    EXPECT_EQ(plot_number(0.0), "0");
    EXPECT_EQ(plot_number(1.0), "1");
    EXPECT_EQ(plot_number(0.012345), "0.0123");
    EXPECT_EQ(plot_number(1234.5), "1230");
    EXPECT_EQ(plot_number(-2.5), "-2.5");
    EXPECT_EQ(plot_number(0.9999), "1");
    EXPECT_EQ(plot_number(3.21e-6), "3.21×10⁻⁶");
    EXPECT_EQ(plot_number(1e9), "10⁹");
}

TEST(Plot, svg_escapes_what_xml_reserves) {
    Plot plot = example();
    plot.title = "a < b & \"c\" > d\n";
    const std::string svg = plot_to_svg(plot);
    EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot; &gt; d </title>"), std::string::npos);
    EXPECT_TRUE(svg.starts_with("<?xml"));
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Plot, svg_and_picture_show_the_same_shapes) {
    const PlotDrawing drawing = layout_plot(example());
    const std::string svg = drawing_to_svg(drawing);
    std::size_t elements = 0;
    for (const char* name : {"<polyline ", "<polygon ", "<circle ", "<text "})
        for (std::size_t at = svg.find(name); at != std::string::npos; at = svg.find(name, at + 1))
            ++elements;
    EXPECT_EQ(elements, drawing.shapes.size());
    const Image picture = drawing_to_image(drawing, 2.0);
    EXPECT_EQ(picture.width, int(2.0 * drawing.width));
    EXPECT_EQ(picture.height, int(2.0 * drawing.height));
    for (const PlotShape& shape : drawing.shapes)
        if (const auto* disc = std::get_if<Disc>(&shape.geometry); disc && disc->fill) {
            const int x = int(2.0 * disc->center.x);
            const int y = int(2.0 * disc->center.y);
            EXPECT_NEAR(texel(picture, x, y, 0) * 255.0f, disc->fill->r, 0.5f);
            EXPECT_NEAR(texel(picture, x, y, 2) * 255.0f, disc->fill->b, 0.5f);
        }
}

TEST(Plot, lines_are_anti_aliased_to_their_width) {
    PlotDrawing drawing{.title = "", .width = 40, .height = 20, .paper = {255, 255, 255}, .shapes = {}};
    drawing.shapes.push_back({Polyline{{{-10, 10.25}, {50, 10.25}}, 3.0, {0, 0, 0}}, ""});
    const Image picture = drawing_to_image(drawing, 1.0);
    double covered = 0.0;
    for (int y = 0; y < picture.height; ++y) covered += 1.0 - double(texel(picture, 20, y, 0));
    EXPECT_NEAR(covered, 3.0, 0.01);
    PlotDrawing round = drawing;
    round.shapes = {{Disc{{20, 10}, 6.0, PlotColor{0, 0, 0}}, ""}};
    const Image disc = drawing_to_image(round, 1.0);
    double area = 0.0;
    for (int y = 0; y < disc.height; ++y)
        for (int x = 0; x < disc.width; ++x) area += 1.0 - double(texel(disc, x, y, 0));
    EXPECT_NEAR(area, 36.0 * 3.14159265, 0.6);
}

TEST(Plot, is_deterministic) {
    EXPECT_EQ(plot_to_svg(example()), plot_to_svg(example()));
    EXPECT_EQ(plot_to_image(example(), 1.0).bytes, plot_to_image(example(), 1.0).bytes);
}

TEST(Plot, is_written_as_svg_and_png_side_by_side) {
    const fs::path folder =
        fs::temp_directory_path() / ("patina-plot-test-" + std::to_string(std::random_device{}()));
    fs::create_directories(folder);
    const std::vector<fs::path> files = save_plot(folder / "error.time", example());
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(files[0].filename(), "error.time.svg");
    EXPECT_EQ(files[1].filename(), "error.time.png");
    std::ifstream svg(files[0], std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(svg), {}), plot_to_svg(example()));
    EXPECT_EQ(load_image(files[1]).image.bytes, plot_to_image(example()).bytes);
    fs::remove_all(folder);
}

}  // namespace
}  // namespace patina

// A small scientific plot: plain data in, SVG text or a picture out, both from one layout, so that they show
// the same. Knows no file and no GPU. Deterministic.
#pragma once

#include "renderer/core/image.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace patina {

/// Auto gives each series the next shape in turn, so that a plot can be read without colours.
enum class PlotMarker { Auto, Disc, Square, Diamond, Triangle, TriangleDown, Pentagon, Plus, Cross, None };

struct PlotAxis {
    std::string title;  ///< with its unit: "time (ms)"
    bool log = false;   ///< values ≤ 0 are then not drawn (said in the plot)
};
struct PlotPoint {
    double x = 0.0;
    double y = 0.0;
    std::string label;  ///< what was chosen to get here, such as "L = 200"; may be empty
};
struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;  ///< joined in this order
    PlotMarker marker = PlotMarker::Auto;
    bool line = true;
};
/// A value worth comparing with, drawn across the plot.
struct PlotGuide {
    double y = 0.0;
    std::string label;  ///< "target 0.1 %"
};
struct Plot {
    std::string title;
    std::string subtitle;  ///< one line that says what is compared; may be empty
    PlotAxis x;
    PlotAxis y;
    std::vector<PlotSeries> series;
    std::vector<PlotGuide> guides;
    std::vector<std::string> notes;  ///< below the plot, wrapped
    bool pareto = false;  ///< mark and list the points that no other beats in both x and y (less is better)
};

struct ParetoPoint {
    std::size_t series = 0;
    std::size_t point = 0;
    bool operator==(const ParetoPoint&) const = default;
};
/// The points that are drawn and that no other point equals or beats in both coordinates while beating it in
/// one; by ascending x.
std::vector<ParetoPoint> pareto_front(const Plot& plot);

/// A self-contained SVG file.
std::string plot_to_svg(const Plot& plot);
/// 3 channels, U8, sRGB. scale: pixels per SVG unit (the layout is some 960 × 600 units). Precondition: 0 <
/// scale ≤ 8.
Image plot_to_image(const Plot& plot, double scale = 2.0);

}  // namespace patina

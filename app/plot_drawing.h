// What a plot is drawn from: lines, shapes and text at places, in units of an SVG file, y downwards. One
// layout makes it, each back-end draws it.
#pragma once

#include "app/plot.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace patina {

struct PlotColor {
    std::uint8_t r = 0, g = 0, b = 0;
    bool operator==(const PlotColor&) const = default;
};
struct Polyline {
    std::vector<glm::dvec2> points;
    double width = 1.0;
    PlotColor color;
};
/// Convex or not, without holes.
struct Polygon {
    std::vector<glm::dvec2> corners;
    std::optional<PlotColor> fill;
    PlotColor stroke;
    double stroke_width = 0.0;
};
struct Disc {
    glm::dvec2 center{0.0};
    double radius = 1.0;
    std::optional<PlotColor> fill;
    PlotColor stroke;
    double stroke_width = 0.0;
};
enum class TextAnchor { Start, Middle, End };
struct PlotText {
    std::string text;
    glm::dvec2 baseline{0.0};  ///< where the anchor stands
    double size = 12.0;        ///< em
    TextAnchor anchor = TextAnchor::Start;
    PlotColor color;
};
struct PlotShape {
    std::variant<Polyline, Polygon, Disc, PlotText> geometry;
    std::string tip;  ///< shown by SVG viewers under the pointer
};
struct PlotDrawing {
    std::string title;
    double width = 0.0;
    double height = 0.0;
    PlotColor paper;
    std::vector<PlotShape> shapes;  ///< later ones cover earlier ones
};

/// Of the interface font, in ems.
inline constexpr double kFontAscent = 0.96875;
inline constexpr double kFontHeight = 1.21023;
double plot_text_width(std::string_view text, double size);

PlotDrawing layout_plot(const Plot& plot);
std::string drawing_to_svg(const PlotDrawing& drawing);
Image drawing_to_image(const PlotDrawing& drawing, double scale);

/// An axis: which values are drawn where, and what is written along it.
struct PlotTick {
    double value = 0.0;
    std::string text;  ///< empty: a line of the minor grid
};
struct PlotScale {
    bool log = false;
    double low = 0.0;  ///< in data units
    double high = 1.0;
    std::vector<PlotTick> ticks;
    /// 0 at low, 1 at high.
    double position(double value) const;
};
/// Whether the axis can show it.
bool drawable(const PlotAxis& axis, double value);
/// values: all drawable; may be empty.
PlotScale make_scale(bool log, const std::vector<double>& values);
/// Three significant digits, as short as it goes: "0.0123", "1.5", "2400", "3.2×10⁻⁶".
std::string plot_number(double value);

}  // namespace patina

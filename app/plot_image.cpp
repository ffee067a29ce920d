// A plot's drawing as pixels. Coverage of a pixel is its signed distance to the edge, clamped over one pixel;
// colours mix as SVG viewers mix them, on encoded values.
#include "app/plot_drawing.h"
#include "app/sheet.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace patina {

namespace {

double distance_to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 edge = b - a;
    const double squared = glm::dot(edge, edge);
    const double t = squared > 0.0 ? glm::clamp(glm::dot(p - a, edge) / squared, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * edge);
}

/// Negative inside (even-odd).
double signed_distance(glm::dvec2 p, const std::vector<glm::dvec2>& corners) {
    double nearest = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i];
        const glm::dvec2 b = corners[(i + 1) % corners.size()];
        nearest = std::min(nearest, distance_to_segment(p, a, b));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside ? -nearest : nearest;
}

class Canvas {
public:
    Canvas(glm::ivec2 size, PlotColor paper, double scale)
        : image_(make_image(size.x, size.y, 3, PixelType::U8)), scale_(scale) {
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) mix({x, y}, paper, 1.0);
    }
    Image take() { return std::move(image_); }

    void draw(const Polyline& line) {
        for (const glm::dvec2& point : line.points) bounds_add(point);
        cover(line.color, 0.5 * line.width, [&](glm::dvec2 p) {
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
                nearest = std::min(nearest, distance_to_segment(p, line.points[i], line.points[i + 1]));
            return nearest - 0.5 * line.width;
        });
    }
    void draw(const Polygon& polygon) {
        fill_and_stroke(
            polygon,
            [&] {
                for (const glm::dvec2& corner : polygon.corners) bounds_add(corner);
            },
            [&](glm::dvec2 p) { return signed_distance(p, polygon.corners); });
    }
    void draw(const Disc& disc) {
        fill_and_stroke(
            disc,
            [&] {
                bounds_add(disc.center - disc.radius);
                bounds_add(disc.center + disc.radius);
            },
            [&](glm::dvec2 p) { return glm::distance(p, disc.center) - disc.radius; });
    }
    void draw(const PlotText& text) {
        const double size = text.size * scale_;
        const Image coverage = text_coverage(text.text, float(size * kFontHeight));
        const double share = text.anchor == TextAnchor::Start    ? 0.0
                             : text.anchor == TextAnchor::Middle ? 0.5
                                                                 : 1.0;
        const int left = int(std::lround(text.baseline.x * scale_ - share * coverage.width));
        const int top = int(std::lround(text.baseline.y * scale_) - std::lround(size * kFontAscent));
        for (int y = 0; y < coverage.height; ++y)
            for (int x = 0; x < coverage.width; ++x)
                mix({left + x, top + y}, text.color, double(texel(coverage, x, y, 0)));
    }

private:
    void mix(glm::ivec2 at, PlotColor color, double share) {
        if (share <= 0.0 || at.x < 0 || at.y < 0 || at.x >= image_.width || at.y >= image_.height) return;
        std::byte* pixel =
            image_.bytes.data() + 3 * (std::size_t(at.y) * std::size_t(image_.width) + std::size_t(at.x));
        const std::uint8_t channels[3] = {color.r, color.g, color.b};
        for (int c = 0; c < 3; ++c) {
            const double old = double(std::to_integer<int>(pixel[c]));
            pixel[c] = std::byte(std::lround(old + (channels[c] - old) * std::min(share, 1.0)));
        }
    }
    void bounds_add(glm::dvec2 point) {
        low_ = glm::min(low_, point);
        high_ = glm::max(high_, point);
    }
    /// distance: from a point in units to the covered region, negative inside; within margin of the bounds
    /// added.
    template <class Distance>
    void cover(PlotColor color, double margin, const Distance& distance) {
        const glm::ivec2 from = glm::max(glm::ivec2(glm::floor((low_ - margin) * scale_)) - 1, glm::ivec2(0));
        const glm::ivec2 to = glm::min(glm::ivec2(glm::ceil((high_ + margin) * scale_)) + 1,
                                       glm::ivec2(image_.width - 1, image_.height - 1));
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x)
                mix({x, y}, color, 0.5 - scale_ * distance((glm::dvec2(x, y) + 0.5) / scale_));
        low_ = glm::dvec2(std::numeric_limits<double>::infinity());
        high_ = -low_;
    }
    template <class Shape, class Bounds, class Distance>
    void fill_and_stroke(const Shape& shape, const Bounds& add_bounds, const Distance& distance) {
        if (shape.fill) {
            add_bounds();
            cover(*shape.fill, 0.0, distance);
        }
        if (shape.stroke_width > 0.0) {
            add_bounds();
            cover(shape.stroke, 0.5 * shape.stroke_width,
                  [&](glm::dvec2 p) { return std::abs(distance(p)) - 0.5 * shape.stroke_width; });
        }
    }

    Image image_;
    double scale_;
    glm::dvec2 low_{std::numeric_limits<double>::infinity()};
    glm::dvec2 high_{-std::numeric_limits<double>::infinity()};
};

}  // namespace

double plot_text_width(std::string_view text, double size) {
    constexpr double measured_at = 64.0;  // pixels an em: rounding to whole pixels then matters little
    return text_coverage(text, float(measured_at * kFontHeight)).width * size / measured_at;
}

Image drawing_to_image(const PlotDrawing& drawing, double scale) {
    assert(scale > 0.0 && scale <= 8.0);
    Canvas canvas({int(std::ceil(drawing.width * scale)), int(std::ceil(drawing.height * scale))},
                  drawing.paper, scale);
    for (const PlotShape& shape : drawing.shapes)
        std::visit([&](const auto& geometry) { canvas.draw(geometry); }, shape.geometry);
    return canvas.take();
}

Image plot_to_image(const Plot& plot, double scale) { return drawing_to_image(layout_plot(plot), scale); }

}  // namespace patina

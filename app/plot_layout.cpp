// Where everything of a plot stands. The legend has a column of its own right of the data, so that it never
// covers any.
#include "app/plot_drawing.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace patina {

namespace {

constexpr double kMargin = 28.0;
constexpr double kDataWidth = 600.0;
constexpr double kDataHeight = 400.0;
constexpr double kLegendGap = 30.0;
constexpr double kMarkerRadius = 4.4;
constexpr double kRingRadius = 8.4;
constexpr double kTitleSize = 20.0;
constexpr double kTextSize = 13.0;
constexpr double kSmallSize = 11.5;
constexpr double kLineHeight = 1.5;  ///< ems

constexpr PlotColor kPaper{251, 250, 246};
constexpr PlotColor kDataPaper{255, 255, 255};
constexpr PlotColor kMajorGrid{219, 216, 208};
constexpr PlotColor kMinorGrid{240, 238, 233};
constexpr PlotColor kAxis{92, 90, 86};
constexpr PlotColor kInk{28, 28, 30};
constexpr PlotColor kFaint{104, 102, 98};
constexpr PlotColor kFront{28, 28, 30};

// Okabe and Ito's colours, told apart with every kind of colour vision; yellow, too pale for lines on white,
// is left out.
constexpr std::array kColors{PlotColor{0, 114, 178},   PlotColor{213, 94, 0},   PlotColor{0, 158, 115},
                             PlotColor{204, 121, 167}, PlotColor{86, 180, 233}, PlotColor{230, 159, 0},
                             PlotColor{70, 70, 74}};
constexpr std::array kMarkers{PlotMarker::Disc,    PlotMarker::Square,       PlotMarker::Triangle,
                              PlotMarker::Diamond, PlotMarker::TriangleDown, PlotMarker::Pentagon,
                              PlotMarker::Cross,   PlotMarker::Plus};

struct Style {
    PlotColor color;
    PlotMarker marker = PlotMarker::Disc;
    bool line = true;
};
Style style_of(const Plot& plot, std::size_t series) {
    const PlotSeries& each = plot.series[series];
    return {kColors[series % kColors.size()],
            each.marker == PlotMarker::Auto ? kMarkers[series % kMarkers.size()] : each.marker, each.line};
}

struct Box {
    glm::dvec2 low{0.0};
    glm::dvec2 high{0.0};
};
bool overlap(const Box& a, const Box& b) {
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

std::vector<glm::dvec2> regular_corners(glm::dvec2 center, double radius, int count, double first_angle) {
    std::vector<glm::dvec2> corners;
    for (int i = 0; i < count; ++i) {
        const double angle = first_angle + 2.0 * std::numbers::pi * i / count;
        corners.push_back(center + radius * glm::dvec2(std::cos(angle), -std::sin(angle)));
    }
    return corners;
}

/// A white rim keeps markers apart from lines and from each other.
void add_marker(PlotDrawing& drawing, glm::dvec2 at, const Style& style, const std::string& tip) {
    constexpr double up = std::numbers::pi / 2.0;
    const auto polygon = [&](int count, double size, double angle) {
        drawing.shapes.push_back(
            {Polygon{regular_corners(at, size * kMarkerRadius, count, angle), style.color, kDataPaper, 1.0},
             tip});
    };
    const auto strokes = [&](double angle) {
        const std::vector<glm::dvec2> ends = regular_corners(at, 1.15 * kMarkerRadius, 4, angle);
        for (const auto& [width, color] : {std::pair{4.2, kDataPaper}, std::pair{2.2, style.color}})
            for (std::size_t i = 0; i < 2; ++i)
                drawing.shapes.push_back({Polyline{{ends[i], ends[i + 2]}, width, color}, tip});
    };
    switch (style.marker) {  // sizes give all shapes about the same area
        case PlotMarker::Disc:
        case PlotMarker::Auto:
            drawing.shapes.push_back({Disc{at, kMarkerRadius, style.color, kDataPaper, 1.0}, tip});
            break;
        case PlotMarker::Square:
            polygon(4, 1.25, up / 2.0);
            break;
        case PlotMarker::Diamond:
            polygon(4, 1.35, up);
            break;
        case PlotMarker::Triangle:
            polygon(3, 1.45, up);
            break;
        case PlotMarker::TriangleDown:
            polygon(3, 1.45, -up);
            break;
        case PlotMarker::Pentagon:
            polygon(5, 1.18, up);
            break;
        case PlotMarker::Plus:
            strokes(0.0);
            break;
        case PlotMarker::Cross:
            strokes(up / 2.0);
            break;
        case PlotMarker::None:
            break;
    }
}

void add_text(PlotDrawing& drawing, PlotText text) {
    if (!text.text.empty()) drawing.shapes.push_back({std::move(text), ""});
}

std::vector<std::string> wrapped(const std::string& text, double size, double width) {
    std::vector<std::string> lines;
    std::string line;
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t space = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, space - at);
        std::string longer = line;
        if (!longer.empty()) longer += ' ';
        longer += word;
        if (!line.empty() && plot_text_width(longer, size) > width) {
            lines.push_back(line);
            line = word;
        } else {
            line = longer;
        }
        at = space + 1;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

void add_dashed(PlotDrawing& drawing, glm::dvec2 from, glm::dvec2 to, const Polyline& look,
                glm::dvec2 on_off) {
    const double length = glm::distance(from, to);
    for (double at = 0.0; at < length; at += on_off.x + on_off.y)
        drawing.shapes.push_back({Polyline{{glm::mix(from, to, at / length),
                                            glm::mix(from, to, std::min(1.0, (at + on_off.x) / length))},
                                           look.width,
                                           look.color},
                                  ""});
}

/// What of a plot can be drawn, and along which axes.
struct Prepared {
    PlotScale x;
    PlotScale y;
    std::vector<ParetoPoint> front;
    std::vector<std::string> notes;
};
bool is_drawn(const Plot& plot, const PlotPoint& p) { return drawable(plot.x, p.x) && drawable(plot.y, p.y); }

Prepared prepare(const Plot& plot) {
    Prepared prepared;
    std::vector<double> x;
    std::vector<double> y;
    std::size_t left_out = 0;
    for (const PlotSeries& series : plot.series)
        for (const PlotPoint& p : series.points)
            if (is_drawn(plot, p)) {
                x.push_back(p.x);
                y.push_back(p.y);
            } else {
                ++left_out;
            }
    for (const PlotGuide& guide : plot.guides)
        if (drawable(plot.y, guide.y)) y.push_back(guide.y);
    prepared.x = make_scale(plot.x.log, x);
    prepared.y = make_scale(plot.y.log, y);
    if (plot.pareto) prepared.front = pareto_front(plot);
    prepared.notes = plot.notes;
    if (left_out > 0)
        prepared.notes.push_back(std::to_string(left_out) + (left_out == 1 ? " point is" : " points are") +
                                 " not drawn: not finite, or not above 0 on a logarithmic axis.");
    return prepared;
}

class Layout {
public:
    Layout(const Plot& plot, Prepared prepared) : plot_(plot), prepared_(std::move(prepared)) {}

    PlotDrawing make() {
        drawing_.title = plot_.title;
        drawing_.paper = kPaper;
        place_frame();
        draw_grid();
        draw_guides();
        draw_front_line();
        draw_series();
        draw_front_rings();
        draw_titles();
        const double legend_right = draw_legend();
        drawing_.width = std::ceil(std::max(legend_right, data_.high.x) + kMargin);
        draw_notes();
        return std::move(drawing_);
    }

private:
    glm::dvec2 place(const PlotPoint& p) const {
        return {glm::mix(data_.low.x, data_.high.x, prepared_.x.position(p.x)),
                glm::mix(data_.high.y, data_.low.y, prepared_.y.position(p.y))};
    }

    void place_frame() {
        double labels = 0.0;
        for (const PlotTick& tick : prepared_.y.ticks)
            labels = std::max(labels, plot_text_width(tick.text, kSmallSize));
        const double top = kMargin + kTitleSize * kLineHeight +
                           (plot_.subtitle.empty() ? 0.0 : kTextSize * kLineHeight) +
                           (plot_.y.title.empty() ? 10.0 : 16.0 + kTextSize * kLineHeight);
        data_.low = {std::ceil(kMargin + labels + 10.0), std::ceil(top)};
        data_.high = data_.low + glm::dvec2(kDataWidth, kDataHeight);
    }

    void draw_grid() {
        drawing_.shapes.push_back(
            {Polygon{{data_.low, {data_.high.x, data_.low.y}, data_.high, {data_.low.x, data_.high.y}},
                     kDataPaper},
             ""});
        for (const bool major : {false, true}) {
            const PlotColor color = major ? kMajorGrid : kMinorGrid;
            for (const PlotTick& tick : prepared_.x.ticks) {
                if (tick.text.empty() == major) continue;
                const double x = glm::mix(data_.low.x, data_.high.x, prepared_.x.position(tick.value));
                drawing_.shapes.push_back({Polyline{{{x, data_.low.y}, {x, data_.high.y}}, 1.0, color}, ""});
                if (major)
                    add_text(drawing_,
                             {tick.text, {x, data_.high.y + 18.0}, kSmallSize, TextAnchor::Middle, kFaint});
            }
            for (const PlotTick& tick : prepared_.y.ticks) {
                if (tick.text.empty() == major) continue;
                const double y = glm::mix(data_.high.y, data_.low.y, prepared_.y.position(tick.value));
                drawing_.shapes.push_back({Polyline{{{data_.low.x, y}, {data_.high.x, y}}, 1.0, color}, ""});
                if (major)
                    add_text(drawing_, {tick.text,
                                        {data_.low.x - 9.0, y + 0.36 * kSmallSize},
                                        kSmallSize,
                                        TextAnchor::End,
                                        kFaint});
            }
        }
        drawing_.shapes.push_back(
            {Polyline{{data_.low, {data_.low.x, data_.high.y}, data_.high}, 1.2, kAxis}, ""});
        taken_.push_back({{data_.low.x - 1.0, data_.low.y}, {data_.low.x + 1.0, data_.high.y}});
    }

    void draw_guides() {
        for (const PlotGuide& guide : plot_.guides) {
            if (!drawable(plot_.y, guide.y)) continue;
            const double y = glm::mix(data_.high.y, data_.low.y, prepared_.y.position(guide.y));
            add_dashed(drawing_, {data_.low.x, y}, {data_.high.x, y}, {{}, 1.2, kFaint}, {6.0, 4.0});
            add_text(drawing_,
                     {guide.label, {data_.high.x - 6.0, y - 5.0}, kSmallSize, TextAnchor::End, kFaint});
            const double width = plot_text_width(guide.label, kSmallSize);
            taken_.push_back({{data_.high.x - 6.0 - width, y - 5.0 - kSmallSize}, {data_.high.x, y}});
        }
    }

    /// The staircase below and left of which nothing was reached.
    void draw_front_line() {
        for (std::size_t i = 0; i + 1 < prepared_.front.size(); ++i) {
            const glm::dvec2 from = place(point(prepared_.front[i]));
            const glm::dvec2 to = place(point(prepared_.front[i + 1]));
            const glm::dvec2 corner{to.x, from.y};
            add_dashed(drawing_, from, corner, {{}, 1.1, kFront}, {2.5, 3.5});
            add_dashed(drawing_, corner, to, {{}, 1.1, kFront}, {2.5, 3.5});
        }
    }

    void draw_series() {
        for (std::size_t i = 0; i < plot_.series.size(); ++i) {
            Polyline line{{}, 1.8, style_of(plot_, i).color};
            for (const PlotPoint& p : plot_.series[i].points)
                if (is_drawn(plot_, p)) line.points.push_back(place(p));
            for (const glm::dvec2& at : line.points)
                taken_.push_back({at - kMarkerRadius, at + kMarkerRadius});
            if (plot_.series[i].line && line.points.size() > 1) {
                segments_.insert(segments_.end(), line.points.begin(), line.points.end() - 1);
                segment_ends_.insert(segment_ends_.end(), line.points.begin() + 1, line.points.end());
                drawing_.shapes.push_back({std::move(line), plot_.series[i].name});
            }
        }
        for (std::size_t i = 0; i < plot_.series.size(); ++i)
            for (const PlotPoint& p : plot_.series[i].points)
                if (is_drawn(plot_, p)) add_marker(drawing_, place(p), style_of(plot_, i), tip(i, p));
    }

    void draw_front_rings() {
        for (const ParetoPoint& each : prepared_.front) {
            const glm::dvec2 at = place(point(each));
            drawing_.shapes.push_back(
                {Disc{at, kRingRadius, std::nullopt, kFront, 1.5}, tip(each.series, point(each))});
            taken_.push_back({at - kRingRadius, at + kRingRadius});
        }
        for (std::size_t i = 0; i < prepared_.front.size(); ++i)
            add_number(place(point(prepared_.front[i])), std::to_string(i + 1));
    }

    /// Beside a ring, where it covers least.
    void add_number(glm::dvec2 at, const std::string& text) {
        constexpr std::array directions_deg{225.0, 180.0, 270.0, 135.0, 315.0, 90.0, 0.0, 45.0};
        const glm::dvec2 half{0.5 * plot_text_width(text, kSmallSize) + 1.5, 0.5 * kSmallSize};
        Box best;
        double best_cost = 1e9;
        for (std::size_t i = 0; i < directions_deg.size(); ++i) {
            const double angle = std::numbers::pi / 180.0 * directions_deg[i];
            const glm::dvec2 direction{std::cos(angle), -std::sin(angle)};
            const glm::dvec2 center = at + direction * (kRingRadius + 2.0) + direction * half;
            const Box box{center - half, center + half};
            const double cost = crowding(box) + 0.1 * double(i);
            if (cost < best_cost) {
                best_cost = cost;
                best = box;
            }
        }
        add_text(drawing_, {text,
                            {0.5 * (best.low.x + best.high.x), best.high.y - 0.14 * kSmallSize},
                            kSmallSize,
                            TextAnchor::Middle,
                            kFront});
        taken_.push_back(best);
    }
    double crowding(const Box& box) const {
        double cost = 0.0;
        for (const Box& other : taken_)
            if (overlap(box, other)) cost += 3.0;
        if (box.low.x < data_.low.x || box.high.x > data_.high.x || box.low.y < data_.low.y ||
            box.high.y > data_.high.y)
            cost += 5.0;
        for (std::size_t i = 0; i < segments_.size(); ++i)
            for (int k = 0; k <= 32; ++k) {
                const glm::dvec2 p = glm::mix(segments_[i], segment_ends_[i], k / 32.0);
                if (overlap(box, {p - 0.5, p + 0.5})) {
                    cost += 1.0;
                    break;
                }
            }
        return cost;
    }

    void draw_titles() {
        double y = kMargin + kTitleSize;
        add_text(drawing_, {plot_.title, {kMargin, y}, kTitleSize, TextAnchor::Start, kInk});
        if (!plot_.subtitle.empty()) {
            y += kTextSize * kLineHeight + 2.0;
            add_text(drawing_, {plot_.subtitle, {kMargin, y}, kTextSize, TextAnchor::Start, kFaint});
        }
        add_text(drawing_,
                 {plot_.y.title, {kMargin, data_.low.y - 13.0}, kTextSize, TextAnchor::Start, kInk});
        add_text(drawing_,
                 {plot_.x.title, {data_.high.x, data_.high.y + 38.0}, kTextSize, TextAnchor::End, kInk});
        title_right_ = kMargin + std::max(plot_text_width(plot_.title, kTitleSize),
                                          plot_text_width(plot_.subtitle, kTextSize));
        bottom_ = data_.high.y + 44.0;
    }

    /// The right end of what it wrote.
    double draw_legend() {
        const double left = data_.high.x + kLegendGap;
        double right = std::max(left, title_right_);
        double y = data_.low.y + 2.0;
        for (std::size_t i = 0; i < plot_.series.size(); ++i) {
            y += 0.5 * kTextSize * kLineHeight;
            const Style style = style_of(plot_, i);
            if (style.line)
                drawing_.shapes.push_back({Polyline{{{left, y}, {left + 26.0, y}}, 1.8, style.color}, ""});
            add_marker(drawing_, {left + 13.0, y}, style, "");
            add_text(drawing_, {plot_.series[i].name,
                                {left + 36.0, y + 0.36 * kTextSize},
                                kTextSize,
                                TextAnchor::Start,
                                kInk});
            right = std::max(right, left + 36.0 + plot_text_width(plot_.series[i].name, kTextSize));
            y += 0.5 * kTextSize * kLineHeight + 3.0;
        }
        if (!prepared_.front.empty())
            right = std::max(right, draw_front_list({left, y + 16.0}));
        else
            bottom_ = std::max(bottom_, y);
        return right;
    }

    double draw_front_list(glm::dvec2 at) {
        double right = at.x;
        double y = at.y + kTextSize;
        drawing_.shapes.push_back(
            {Disc{{at.x + 13.0, y - 0.36 * kTextSize}, kRingRadius, std::nullopt, kFront, 1.5}, ""});
        const std::string heading = "Pareto front: no other is lower in both";
        add_text(drawing_, {heading, {at.x + 36.0, y}, kTextSize, TextAnchor::Start, kInk});
        right = std::max(right, at.x + 36.0 + plot_text_width(heading, kTextSize));
        y += 5.0;
        for (std::size_t i = 0; i < prepared_.front.size(); ++i) {
            y += kSmallSize * kLineHeight;
            const PlotPoint& p = point(prepared_.front[i]);
            const std::string text =
                name(prepared_.front[i].series, p) + "  (" + plot_number(p.x) + ", " + plot_number(p.y) + ")";
            add_text(drawing_,
                     {std::to_string(i + 1), {at.x + 26.0, y}, kSmallSize, TextAnchor::End, kFront});
            add_text(drawing_, {text, {at.x + 36.0, y}, kSmallSize, TextAnchor::Start, kFaint});
            right = std::max(right, at.x + 36.0 + plot_text_width(text, kSmallSize));
        }
        bottom_ = std::max(bottom_, y + 6.0);
        return right;
    }

    void draw_notes() {
        double y = bottom_ + 6.0;
        for (const std::string& note : prepared_.notes)
            for (const std::string& line : wrapped(note, kSmallSize, drawing_.width - 2.0 * kMargin)) {
                y += kSmallSize * kLineHeight;
                add_text(drawing_, {line, {kMargin, y}, kSmallSize, TextAnchor::Start, kFaint});
            }
        drawing_.height = std::ceil(y + kMargin - 4.0);
    }

    const PlotPoint& point(const ParetoPoint& at) const { return plot_.series[at.series].points[at.point]; }
    std::string name(std::size_t series, const PlotPoint& p) const {
        return plot_.series[series].name + (p.label.empty() ? "" : ", " + p.label);
    }
    std::string tip(std::size_t series, const PlotPoint& p) const {
        return name(series, p) + ": " + plot_number(p.x) + ", " + plot_number(p.y);
    }

    const Plot& plot_;
    Prepared prepared_;
    PlotDrawing drawing_;
    Box data_;                              ///< where data is drawn
    std::vector<Box> taken_;                ///< what numbers must not cover
    std::vector<glm::dvec2> segments_;      ///< starts of the series' lines
    std::vector<glm::dvec2> segment_ends_;  ///< and their ends
    double title_right_ = 0.0;
    double bottom_ = 0.0;
};

}  // namespace

std::vector<ParetoPoint> pareto_front(const Plot& plot) {
    std::vector<ParetoPoint> points;
    for (std::size_t s = 0; s < plot.series.size(); ++s)
        for (std::size_t p = 0; p < plot.series[s].points.size(); ++p)
            if (is_drawn(plot, plot.series[s].points[p])) points.push_back({s, p});
    const auto at = [&](const ParetoPoint& each) -> const PlotPoint& {
        return plot.series[each.series].points[each.point];
    };
    std::ranges::stable_sort(points, [&](const ParetoPoint& a, const ParetoPoint& b) {
        return at(a).x != at(b).x ? at(a).x < at(b).x : at(a).y < at(b).y;
    });
    std::vector<ParetoPoint> front;
    for (const ParetoPoint& each : points) {
        const bool same =
            !front.empty() && at(front.back()).x == at(each).x && at(front.back()).y == at(each).y;
        if (front.empty() || same || at(each).y < at(front.back()).y) front.push_back(each);
    }
    return front;
}

PlotDrawing layout_plot(const Plot& plot) { return Layout(plot, prepare(plot)).make(); }

}  // namespace patina

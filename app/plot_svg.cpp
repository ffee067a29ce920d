// A plot's drawing as an SVG file.
#include "app/plot_drawing.h"
#include "app/xml_text.h"

#include <array>
#include <charconv>

namespace patina {

namespace {

std::string number(double value) {
    std::array<char, 64> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 2).ptr;
    std::string text(buffer.data(), end);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string color(PlotColor value) {
    constexpr std::string_view hex = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t channel : {value.r, value.g, value.b}) {
        text += hex[channel >> 4];
        text += hex[channel & 15];
    }
    return text;
}

std::string points(const std::vector<glm::dvec2>& list) {
    std::string text;
    for (const glm::dvec2& p : list) text += (text.empty() ? "" : " ") + number(p.x) + "," + number(p.y);
    return text;
}

std::string paint(const std::optional<PlotColor>& fill, PlotColor stroke, double stroke_width) {
    std::string text = " fill=\"" + (fill ? color(*fill) : "none") + "\"";
    if (stroke_width > 0.0)
        text += " stroke=\"" + color(stroke) + "\" stroke-width=\"" + number(stroke_width) + "\"";
    return text;
}

struct Element {
    std::string name;
    std::string attributes;
    std::string content;
};

Element element(const Polyline& line) {
    return {"polyline",
            " points=\"" + points(line.points) + "\"" + paint(std::nullopt, line.color, line.width) +
                " stroke-linecap=\"round\" stroke-linejoin=\"round\"",
            ""};
}
Element element(const Polygon& polygon) {
    return {"polygon",
            " points=\"" + points(polygon.corners) + "\"" +
                paint(polygon.fill, polygon.stroke, polygon.stroke_width) + " stroke-linejoin=\"round\"",
            ""};
}
Element element(const Disc& disc) {
    return {"circle",
            " cx=\"" + number(disc.center.x) + "\" cy=\"" + number(disc.center.y) + "\" r=\"" +
                number(disc.radius) + "\"" + paint(disc.fill, disc.stroke, disc.stroke_width),
            ""};
}
Element element(const PlotText& text) {
    constexpr std::array anchors{"start", "middle", "end"};
    return {"text",
            " x=\"" + number(text.baseline.x) + "\" y=\"" + number(text.baseline.y) + "\" font-size=\"" +
                number(text.size) + "\" text-anchor=\"" + anchors[std::size_t(text.anchor)] + "\" fill=\"" +
                color(text.color) + "\"",
            xml_escaped(text.text)};
}

}  // namespace

std::string drawing_to_svg(const PlotDrawing& drawing) {
    const std::string width = number(drawing.width);
    const std::string height = number(drawing.height);
    std::string svg =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
        width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height +
        "\" role=\"img\" font-family=\"Inter, 'Helvetica Neue', Arial, 'Liberation Sans', "
        "'DejaVu Sans', sans-serif\">\n<title>" +
        xml_escaped(drawing.title) + "</title>\n<rect width=\"" + width + "\" height=\"" + height +
        "\" fill=\"" + color(drawing.paper) + "\"/>\n";
    for (const PlotShape& shape : drawing.shapes) {
        Element e = std::visit([](const auto& geometry) { return element(geometry); }, shape.geometry);
        if (!shape.tip.empty()) e.content = "<title>" + xml_escaped(shape.tip) + "</title>" + e.content;
        svg += "<" + e.name + e.attributes +
               (e.content.empty() ? "/>\n" : ">" + e.content + "</" + e.name + ">\n");
    }
    return svg + "</svg>\n";
}

std::string plot_to_svg(const Plot& plot) { return drawing_to_svg(layout_plot(plot)); }

}  // namespace patina

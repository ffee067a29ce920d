#include "app/report.h"
#include "app/xml_text.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <memory>
#include <string_view>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace patina {

namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light; }
body { font: 15px/1.5 Inter, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; color: #1c1c1e; background: #fff;
  max-width: 1080px; margin: 2.5em auto; padding: 0 1.5em; }
h1 { font-size: 1.9em; line-height: 1.2; margin: 0; }
.author { color: #5c5c62; margin: .3em 0 2em; }
h2 { font-size: 1.25em; border-bottom: 1px solid #d8d8dc; padding-bottom: .25em; margin: 2em 0 .8em; break-after: avoid; }
h3 { font-size: 1em; margin: 1em 0 .4em; break-after: avoid; }
.row { display: grid; gap: 8px; margin-bottom: 8px; break-inside: avoid; }
figure { margin: 0; }
figure img { width: 100%; display: block; border-radius: 3px; }
figcaption { font-size: .82em; min-width: 0; color: #5c5c62; margin-top: .2em; overflow-wrap: anywhere; }
table { border-collapse: collapse; font-size: .9em; break-inside: avoid; }
th, td { text-align: left; vertical-align: top; padding: .25em 1em .25em 0; border-bottom: 1px solid #ececef; }
td.long { overflow-wrap: anywhere; }
th { color: #5c5c62; font-weight: 600; white-space: nowrap; }
thead { display: table-header-group; }
tr { break-inside: avoid; }
.note { font-size: .85em; color: #5c5c62; margin: .4em 0; }
pre { font: 12px/1.5 ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; background: #f4f4f6; padding: .8em 1em;
  border-radius: 4px; white-space: pre-wrap; overflow-wrap: anywhere; }
footer { margin-top: 3em; font-size: .82em; color: #77777d; }
@page { size: A4; margin: 16mm; }
@media print { body { margin: 0; padding: 0; max-width: none; font-size: 10.5pt; } pre { font-size: 8pt; }
  * { -webkit-print-color-adjust: exact; print-color-adjust: exact; } }
)";

std::string element(std::string_view tag, std::string_view text) {
    const std::string name(tag.substr(0, tag.find(' ')));
    return "<" + std::string(tag) + ">" + xml_escaped(text) + "</" + name + ">\n";
}

void write_picture(std::string& html, const ReportPicture& picture) {
    html += "<figure>";
    if (!picture.image.empty())
        html += "<img alt=\"" + xml_escaped(picture.caption) + "\" width=\"" +
                std::to_string(picture.image.width) + "\" height=\"" + std::to_string(picture.image.height) +
                "\" style=\"height:auto\" src=\"data:image/png;base64," + base64(png_bytes(picture.image)) +
                "\">";
    if (!picture.caption.empty()) html += "<figcaption>" + xml_escaped(picture.caption) + "</figcaption>";
    html += "</figure>\n";
}

void write_pictures(std::string& html, const ReportSection& section) {
    std::size_t columns = std::size_t(std::max(section.picture_columns, 0));
    if (columns == 0)
        for (const ReportPictureRow& row : section.pictures) columns = std::max(columns, row.pictures.size());
    for (const ReportPictureRow& row : section.pictures) {
        if (!row.heading.empty()) html += element("h3", row.heading);
        html += "<div class=\"row\" style=\"grid-template-columns:repeat(" + std::to_string(columns) +
                ",1fr)\">\n";
        for (const ReportPicture& picture : row.pictures) write_picture(html, picture);
        html += "</div>\n";
    }
}

/// A word that a page may have no room for; shorter ones keep their column as wide as they are.
bool has_long_word(std::string_view text) {
    constexpr std::size_t longest = 24;
    while (text.size() > longest) {
        const std::size_t end = text.find(' ');
        if (end == std::string_view::npos || end > longest) return true;
        text.remove_prefix(end + 1);
    }
    return false;
}

void write_table(std::string& html, const ReportTable& table) {
    const auto row = [&](std::string_view tag, const std::vector<std::string>& cells) {
        html += "<tr>";
        for (const std::string& cell : cells)
            html += "<" + std::string(tag) + (has_long_word(cell) ? " class=\"long\">" : ">") +
                    xml_escaped(cell) + "</" + std::string(tag) + ">";
        html += "</tr>\n";
    };
    html += "<table>\n";
    if (!table.header.empty()) {
        html += "<thead>";
        row("th", table.header);
        html += "</thead>\n";
    }
    for (const auto& cells : table.rows) row("td", cells);
    html += "</table>\n";
}

}  // namespace

std::string base64(const std::vector<unsigned char>& bytes) {
    static constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        const unsigned group = unsigned(bytes[i]) << 16 | (left > 1 ? unsigned(bytes[i + 1]) << 8 : 0u) |
                               (left > 2 ? unsigned(bytes[i + 2]) : 0u);
        text += digits[group >> 18];
        text += digits[group >> 12 & 63];
        text += left > 1 ? digits[group >> 6 & 63] : '=';
        text += left > 2 ? digits[group & 63] : '=';
    }
    return text;
}

std::vector<unsigned char> png_bytes(const Image& image) {
    assert(image.type == PixelType::U8);
    std::vector<unsigned char> bytes;
    const auto append = [](void* to, void* data, int size) {
        auto& target = *static_cast<std::vector<unsigned char>*>(to);
        const auto* from = static_cast<const unsigned char*>(data);
        target.insert(target.end(), from, from + size);
    };
    stbi_write_png_to_func(append, &bytes, image.width, image.height, image.channels, image.bytes.data(),
                           image.width * image.channels);
    return bytes;
}

std::string to_html(const Report& report) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    html += element("title", report.title) + "<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n";
    html += element("h1", report.title);
    if (!report.author.empty()) html += element("p class=\"author\"", report.author);
    for (const ReportSection& section : report.sections) {
        html += "<section>\n" + element("h2", section.heading);
        for (const std::string& paragraph : section.paragraphs) html += element("p", paragraph);
        write_pictures(html, section);
        if (section.table) write_table(html, *section.table);
        for (const std::string& note : section.notes) html += element("p class=\"note\"", note);
        if (!section.commands.empty()) {
            html += "<pre>";
            for (const std::string& command : section.commands) html += xml_escaped(command) + "\n";
            html += "</pre>\n";
        }
        html += "</section>\n";
    }
    html += element("footer", report.made_with) + "</body>\n</html>\n";
    return html;
}

}  // namespace patina

// A report as plain values, and as the text of a self-contained web page. Knows no file and no GPU.
#pragma once

#include "renderer/core/image.h"

#include <optional>
#include <string>
#include <vector>

namespace patina {

struct ReportPicture {
    std::string caption;  ///< below it; may be empty
    Image image;          ///< 3 channels of U8; empty: a gap in the grid
};

/// A row of pictures of one width, with a heading of its own.
struct ReportPictureRow {
    std::string heading;
    std::vector<ReportPicture> pictures;
};

struct ReportTable {
    std::vector<std::string> header;  ///< may be empty
    std::vector<std::vector<std::string>> rows;
};

/// Everything but the heading may be empty; it follows in this order.
struct ReportSection {
    std::string heading;
    std::vector<std::string> paragraphs;
    std::vector<ReportPictureRow> pictures;
    int picture_columns = 0;  ///< all rows share this grid; 0: as many as the longest row has
    std::optional<ReportTable> table;
    std::vector<std::string> notes;     ///< small print
    std::vector<std::string> commands;  ///< typewriter lines
};

struct Report {
    std::string title, author;
    std::string made_with;  ///< program and version; stands in the foot
    std::vector<ReportSection> sections;
};

/// One HTML 5 file with pictures and style inside it: needs no network, prints on A4.
std::string to_html(const Report& report);

/// A PNG file's bytes. Precondition: U8, 1…4 channels.
std::vector<unsigned char> png_bytes(const Image& image);
std::string base64(const std::vector<unsigned char>& bytes);

}  // namespace patina

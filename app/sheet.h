// A labelled sheet of pictures: presets as rows, lightings as columns. Plain pixels; knows no GL and no file.
#pragma once

#include "renderer/core/image.h"

#include <glm/vec2.hpp>

#include <string>
#include <string_view>

namespace patina {

/// Text as coverage: one U8 channel, height_px high (ascent and descent), as wide as the text; embedded
/// interface font. UTF-8; a character the font lacks becomes its replacement box. Empty text gives an empty
/// image.
Image text_coverage(std::string_view text, float height_px);

class Sheet {
public:
    /// cell_px: size of every picture. type: U8 for display pictures, F32 for radiance. Throws
    /// std::runtime_error when the whole would exceed kMaxImagePixels. footer: room for a line below.
    Sheet(int columns, int rows, glm::ivec2 cell_px, PixelType type, bool footer = false);
    void set_column_title(int column, std::string_view title);
    /// columns: over how many it may run.
    void set_row_title(int row, std::string_view title, int columns = 1 << 16);
    /// Above one cell, where the row's title leaves room.
    void set_cell_title(int column, int row, std::string_view title);
    /// Text, then a strip of colours (3 channels of U8, stretched to a line's height), then text.
    void set_footer(std::string_view before, const Image& strip, std::string_view after);
    /// Precondition: 3 channels, of the sheet's type and cell size.
    void set_cell(int column, int row, const Image& picture);
    const Image& image() const { return image_; }

private:
    int write(std::string_view text, glm::ivec2 top_left, int width_px);  ///< gives the width used
    glm::ivec2 cell_corner(int column, int row) const;

    glm::ivec2 cell_px_;
    int gap_px_ = 0;
    float text_px_ = 0.0f;
    int row_title_px_ = 0;
    int column_title_px_ = 0;
    Image image_;
};

}  // namespace patina

#include "app/sheet.h"

#include "app/utf8.h"
#include "renderer/core/image_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <stdexcept>
#include <utility>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace patina {

namespace embedded {
std::span<const unsigned char> fonts(std::string_view file_name);
}

namespace {

// Display values of a dark neutral sheet: the surround does not tint the judgement of the pictures.
constexpr float kPaper = 0.13f;
constexpr float kInk = 0.85f;

const stbtt_fontinfo& label_font() {
    static const stbtt_fontinfo label = [] {
        stbtt_fontinfo font{};
        const std::span<const unsigned char> file = embedded::fonts("Inter-Regular.otf");
        if (file.empty() || !stbtt_InitFont(&font, file.data(), 0))
            throw std::runtime_error("the embedded font cannot be read");
        return font;
    }();
    return label;
}

struct Glyph {
    int code = 0;
    float x = 0.0f;  ///< pen position, pixels
};

std::vector<Glyph> laid_out(std::string_view text, float scale, float& width) {
    std::vector<Glyph> glyphs;
    float pen = 0.0f;
    while (!text.empty()) {
        const int code = next_code_point(text);
        if (!glyphs.empty())
            pen += scale * float(stbtt_GetCodepointKernAdvance(&label_font(), glyphs.back().code, code));
        glyphs.push_back({code, pen});
        int advance = 0;
        int bearing = 0;
        stbtt_GetCodepointHMetrics(&label_font(), code, &advance, &bearing);
        pen += scale * float(advance);
    }
    width = pen;
    return glyphs;
}

float width_of(std::string_view text, float scale) {
    float width = 0.0f;
    laid_out(text, scale, width);
    return width;
}

/// As much of the text as fits, with an ellipsis where something is left out.
std::string shortened(std::string_view text, float height_px, float width_px) {
    const float scale = stbtt_ScaleForPixelHeight(&label_font(), height_px);
    if (width_of(text, scale) + 1.0f <= width_px) return std::string(text);
    std::string best;
    for (std::string_view rest = text; !rest.empty();) {
        next_code_point(rest);
        std::string shorter(text.substr(0, text.size() - rest.size()));
        while (shorter.ends_with(' ')) shorter.pop_back();
        shorter += "…";
        if (width_of(shorter, scale) + 1.0f > width_px) break;
        best = std::move(shorter);
    }
    return best;
}

/// Adds one glyph's coverage at a sub-pixel pen position.
void stamp(Image& target, const Glyph& glyph, float scale, float baseline) {
    const float fraction = glyph.x - std::floor(glyph.x);
    int width = 0;
    int height = 0;
    int left = 0;
    int top = 0;
    unsigned char* bitmap = stbtt_GetCodepointBitmapSubpixel(&label_font(), scale, scale, fraction, 0.0f,
                                                             glyph.code, &width, &height, &left, &top);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int to_x = int(std::floor(glyph.x)) + left + x;
            const int to_y = int(baseline) + top + y;
            if (to_x < 0 || to_y < 0 || to_x >= target.width || to_y >= target.height) continue;
            std::byte& at = target.bytes[std::size_t(to_y) * std::size_t(target.width) + std::size_t(to_x)];
            at = std::max(at, std::byte(bitmap[y * width + x]));
        }
    stbtt_FreeBitmap(bitmap, nullptr);
}

}  // namespace

Image text_coverage(std::string_view text, float height_px) {
    if (text.empty()) return {};
    int ascent = 0;
    int descent = 0;
    int line_gap = 0;
    stbtt_GetFontVMetrics(&label_font(), &ascent, &descent, &line_gap);
    const float scale = stbtt_ScaleForPixelHeight(&label_font(), height_px);
    float width = 0.0f;
    const std::vector<Glyph> glyphs = laid_out(text, scale, width);
    Image coverage =
        make_image(std::max(1, int(std::ceil(width)) + 1), int(std::ceil(height_px)), 1, PixelType::U8);
    for (const Glyph& glyph : glyphs) stamp(coverage, glyph, scale, std::round(scale * float(ascent)));
    return coverage;
}

Sheet::Sheet(int columns, int rows, glm::ivec2 cell_px, PixelType type, bool footer) : cell_px_(cell_px) {
    const int side = std::min(cell_px.x, cell_px.y);
    gap_px_ = std::max(4, side / 64);
    text_px_ = std::clamp(float(side) / 16.0f, 10.0f, 48.0f);
    column_title_px_ = int(std::ceil(text_px_ * 1.6f));
    row_title_px_ = column_title_px_;
    const std::int64_t width = gap_px_ + std::int64_t{columns} * (cell_px.x + gap_px_);
    const std::int64_t height = gap_px_ + column_title_px_ +
                                std::int64_t{rows} * (cell_px.y + row_title_px_ + gap_px_) +
                                (footer ? column_title_px_ : 0);
    if (width > kMaxImageSide || height > kMaxImageSide || width * height > kMaxImagePixels)
        throw std::runtime_error("the sheet would be " + std::to_string(width) + "x" +
                                 std::to_string(height) + " pixels; choose a smaller --size");
    image_ = make_image(int(width), int(height), 3, type);
    const float paper = type == PixelType::F32 ? srgb_to_linear(kPaper) : kPaper;
    for (int c = 0; c < 3; ++c) set_texel(image_, 0, 0, c, paper);
    const std::size_t pixel = 3 * bytes_per_channel(type);
    for (std::size_t at = pixel; at < image_.bytes.size(); at += pixel)
        std::memcpy(image_.bytes.data() + at, image_.bytes.data(), pixel);
}

int Sheet::write(std::string_view text, glm::ivec2 top_left, int width_px) {
    const Image coverage = text_coverage(shortened(text, text_px_, float(width_px)), text_px_);
    const bool linear = image_.type == PixelType::F32;
    for (int y = 0; y < coverage.height; ++y)
        for (int x = 0; x < std::min(coverage.width, width_px); ++x) {
            const float display = kPaper + (kInk - kPaper) * texel(coverage, x, y, 0);
            for (int c = 0; c < 3; ++c)
                set_texel(image_, top_left.x + x, top_left.y + y, c,
                          linear ? srgb_to_linear(display) : display);
        }
    return std::min(coverage.width, width_px);
}

glm::ivec2 Sheet::cell_corner(int column, int row) const {
    return {gap_px_ + column * (cell_px_.x + gap_px_),
            gap_px_ + column_title_px_ + row * (cell_px_.y + row_title_px_ + gap_px_) + row_title_px_};
}

void Sheet::set_column_title(int column, std::string_view title) {
    write(title, {gap_px_ + column * (cell_px_.x + gap_px_), gap_px_}, cell_px_.x);
}

void Sheet::set_row_title(int row, std::string_view title, int columns) {
    const int top = cell_corner(0, row).y - row_title_px_;
    const std::int64_t width = std::int64_t{columns} * (cell_px_.x + gap_px_) - gap_px_;
    write(title, {gap_px_, top + (row_title_px_ - int(text_px_)) / 2},
          int(std::min<std::int64_t>(width, image_.width - 2 * gap_px_)));
}

void Sheet::set_cell_title(int column, int row, std::string_view title) {
    const glm::ivec2 corner = cell_corner(column, row);
    write(title, {corner.x, corner.y - row_title_px_ + (row_title_px_ - int(text_px_)) / 2}, cell_px_.x);
}

void Sheet::set_footer(std::string_view before, const Image& strip, std::string_view after) {
    const int top = image_.height - column_title_px_;
    const int height = int(text_px_);
    int left = gap_px_;
    left += write(before, {left, top}, image_.width - 2 * gap_px_) + gap_px_;
    const int width = std::min(6 * height, image_.width - left - gap_px_);
    const bool linear = image_.type == PixelType::F32;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float value = texel(strip, x * strip.width / width, 0, c);
                set_texel(image_, left + x, top + y, c, linear ? srgb_to_linear(value) : value);
            }
    left += std::max(width, 0) + gap_px_;
    if (left < image_.width - gap_px_) write(after, {left, top}, image_.width - gap_px_ - left);
}

void Sheet::set_cell(int column, int row, const Image& picture) {
    const auto [left, top] = std::pair(cell_corner(column, row).x, cell_corner(column, row).y);
    const std::size_t pixel = 3 * bytes_per_channel(image_.type);
    for (int y = 0; y < cell_px_.y; ++y)
        std::memcpy(image_.bytes.data() +
                        (std::size_t(top + y) * std::size_t(image_.width) + std::size_t(left)) * pixel,
                    picture.bytes.data() + std::size_t(y) * std::size_t(cell_px_.x) * pixel,
                    std::size_t(cell_px_.x) * pixel);
}

}  // namespace patina

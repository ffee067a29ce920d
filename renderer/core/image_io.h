// Pictures from and to disk. PNG, JPEG, EXR and Radiance HDR are decoded in the program; the other formats by
// the module patina_images, loaded by the first picture that needs it (on that thread). Every function throws
// std::runtime_error with one sentence that names the file and the way out; nothing is half written.
#pragma once

#include "renderer/core/image.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace patina {

/// Refused before any allocation: a header that promises more than this.
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 28;  ///< 16384 × 16384
inline constexpr int kMaxImageSide = 32768;

struct ImageInfo {
    int width = 0, height = 0, channels = 0;
    PixelType type = PixelType::U8;  ///< what load_image would return (half becomes F32)
    std::string format;              ///< "png", "openexr", …
};

struct LoadedImage {
    Image image;
    std::vector<std::string> notes;  ///< what was tolerated, one sentence each
};

/// Takes a picture a row at a time.
struct ImageRows {
    std::function<void(const Image& shape)> begin;  ///< once, first: the picture without its bytes
    std::function<void(const std::byte* row)> row;  ///< each of its rows, from the top
};

/// Text stored beside the pixels (PNG text chunks, EXR attributes), in order. Names of one's own, such as
/// "patina:preset", come back as they are; camera data under one name whatever the format (ExposureTime).
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

/// Reads only the header.
ImageInfo load_image_info(const std::filesystem::path& file);

/// PNG, JPEG, TIFF, TGA, BMP, EXR, Radiance HDR, told by content rather than extension (noted where they
/// differ).
///
/// Of more than four channels R, G, B and A are kept, by name where they have names, else the first (noted);
/// of several parts the first with colours; palettes are expanded; CMYK becomes RGB; alpha is left as stored,
/// not multiplied in; camera orientation is honoured; an EXR comes in its display window.
LoadedImage load_image(const std::filesystem::path& file);
/// The same picture row by row, and the notes: a PNG that is not interlaced and an upright JPEG are never
/// whole in memory. Damage may show only after some rows were given.
std::vector<std::string> load_image_rows(const std::filesystem::path& file, const ImageRows& rows);
/// A picture in memory as rows.
void give_rows(const Image& image, const ImageRows& rows);

/// Text and numbers stored in the header, as text.
ImageMetadata load_image_metadata(const std::filesystem::path& file);

/// Format from the extension: .png (U8, U16) or .exr (F32, 32-bit float, ZIP). Atomic: temporary file, then
/// rename. The same picture and metadata give the same bytes.
void save_image(const std::filesystem::path& file, const Image& image, const ImageMetadata& metadata = {});

}  // namespace patina

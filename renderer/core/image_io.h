// Pictures from and to disk, the only door to OpenImageIO. Every function throws std::runtime_error with one
// sentence that names the file and the way out; nothing is half written.
#pragma once

#include "renderer/core/image.h"

#include <cstdint>
#include <filesystem>
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

/// Reads only the header.
ImageInfo load_image_info(const std::filesystem::path& file);

/// PNG, JPEG, TIFF, TGA, BMP, EXR, Radiance HDR; more than 4 channels keep the first 4 (noted); palette is
/// expanded; alpha is left unassociated; camera orientation is honoured.
LoadedImage load_image(const std::filesystem::path& file);

/// Text stored beside the pixels (PNG text chunks, EXR attributes), in order.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

/// Format from the extension: .png (U8, U16) or .exr (F32, 32-bit float, ZIP). Atomic: temporary file, then
/// rename.
void save_image(const std::filesystem::path& file, const Image& image, const ImageMetadata& metadata = {});

}  // namespace patina

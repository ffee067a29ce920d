// What image_io and the decoders of single formats say to each other. PNG, JPEG and OpenEXR are decoded in
// the program; the other formats by the module patina_images, which exports such a codec. Decoders throw
// std::runtime_error with what follows the file's name in a sentence ("is damaged (…); copy or export it
// again").
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/image_format.h"
#include "renderer/core/image_io.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

struct ImageSource {
    const std::filesystem::path& file;
    ImageFormat format = ImageFormat::Unknown;
    std::span<const std::byte>
        bytes;  ///< the whole file; empty where only its header is wanted, read from file
};

struct DecodedHeader {
    ImageInfo info;  ///< as the picture is to be seen
    ImageMetadata metadata;
};
struct DecodedImage {
    LoadedImage loaded;
    int orientation = 1;  ///< EXIF orientation 1…8 that is still to be applied
};

/// Where a decoder that need not hold the whole picture puts it.
struct StoredRows {
    /// Once, first: the picture's shape as stored, without bytes, and the EXIF orientation that is still to
    /// be applied.
    std::function<void(const Image& shape, int orientation)> begin;
    std::function<void(const std::byte* row)> row;  ///< each, from the first that is stored
};

/// Decodes in one of two ways; the other is null.
struct ImageCodec {
    DecodedHeader (*header)(const ImageSource&) = nullptr;
    DecodedImage (*decode)(const ImageSource&) = nullptr;
    void (*decode_rows)(const ImageSource&, const StoredRows&) = nullptr;
};

const ImageCodec& png_codec();
const ImageCodec& exr_codec();
/// Decodes what jpeg_is_plain says.
const ImageCodec& jpeg_codec();
/// The whole file. image is U8 or U16 for a PNG, F32 for an EXR (ZIP).
std::vector<std::byte> encode_png(const Image& image, const ImageMetadata& metadata);
std::vector<std::byte> encode_exr(const Image& image, const ImageMetadata& metadata);

inline constexpr const char* kImageModule = "patina_images";
/// extern "C" const patina::ImageCodec* of this name, without arguments, that is never null.
inline constexpr const char* kImageModuleEntry = "patina_image_codec";

/// What a decoder says of a size before it allocates anything; empty where that is acceptable.
std::string size_problem(std::int64_t width, std::int64_t height);
/// A library's own words: on one line, without the closing stop, not too long.
std::string one_line(std::string text);
/// "is damaged (reason); copy or export it again"
std::string damaged(const std::string& reason);

}  // namespace patina

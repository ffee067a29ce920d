// What kind of picture some bytes are and what their header promises, told from the bytes alone. Decodes no
// pixels and knows no file: it stands before the decoders, so that nothing is allocated on the word of a
// broken header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace patina {

enum class ImageFormat : std::uint8_t { Unknown, Png, Jpeg, Tiff, Targa, Bmp, OpenExr, Hdr };

/// From the first bytes; targa, which has no magic number, from a header that makes sense.
ImageFormat image_format_of(std::span<const std::byte> bytes);
/// From a file's extension (with its dot, any case).
ImageFormat image_format_of_extension(std::string_view extension);

/// "png", "jpeg", "tiff", "targa", "bmp", "openexr", "hdr"; "" where unknown.
std::string_view image_format_id(ImageFormat format);

struct PromisedSize {
    std::int64_t width = 0, height = 0;
};
/// From the headers of PNG, TGA, BMP and TIFF, whose decoders would rather complain in their own words;
/// nothing for the others.
std::optional<PromisedSize> promised_size(ImageFormat format, std::span<const std::byte> bytes);

/// Whether a PNG carries EXIF data (camera, orientation) before its pixels. A part of the file will do.
bool png_has_camera_data(std::span<const std::byte> bytes);

/// Whether a JPEG is grey or of three colours, as far as the part of the file at hand tells.
bool jpeg_is_plain(std::span<const std::byte> bytes);
/// Whether a JPEG carries EXIF data. A part of the file will do.
bool jpeg_has_camera_data(std::span<const std::byte> bytes);

/// What is wrong with the bytes as a whole, as far as the format's structure tells without decoding; empty
/// where nothing.
std::string image_structure_problem(ImageFormat format, std::span<const std::byte> bytes);

/// Whether a file of that size can possibly hold so many pixels.
bool can_hold(ImageFormat format, std::uint64_t file_bytes, std::uint64_t pixels);

}  // namespace patina

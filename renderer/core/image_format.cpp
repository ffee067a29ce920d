#include "renderer/core/image_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

namespace patina {
namespace {

using Bytes = std::span<const std::byte>;

unsigned byte_at(Bytes bytes, std::size_t i) { return std::to_integer<unsigned>(bytes[i]); }

std::uint32_t big_endian_32(Bytes bytes, std::size_t i) {
    return byte_at(bytes, i) << 24 | byte_at(bytes, i + 1) << 16 | byte_at(bytes, i + 2) << 8 |
           byte_at(bytes, i + 3);
}

bool starts_with(Bytes bytes, std::string_view magic) {
    return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

/// Targa has no magic number: the fields of its 18-byte header must make sense together.
bool looks_like_targa(Bytes bytes) {
    if (bytes.size() < 18 || byte_at(bytes, 1) > 1) return false;
    const unsigned type = byte_at(bytes, 2);
    const unsigned depth = byte_at(bytes, 16);
    const bool known_type = (type >= 1 && type <= 3) || (type >= 9 && type <= 11);
    const bool known_depth = depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32;
    const bool has_size =
        (byte_at(bytes, 12) | byte_at(bytes, 13)) != 0 && (byte_at(bytes, 14) | byte_at(bytes, 15)) != 0;
    return known_type && known_depth && has_size && (byte_at(bytes, 17) & 0xC0u) == 0;
}

constexpr std::string_view kCutShort = "is cut short; copy or export it again";

/// Walks the chunks: length, name, data, checksum; the last one is IEND.
std::string png_problem(Bytes bytes) {
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
        const std::uint32_t length = big_endian_32(bytes, at);
        if (length > bytes.size() - at - 12) break;
        if (std::memcmp(bytes.data() + at + 4, "IEND", 4) == 0) return {};
        at += 12 + std::size_t{length};
    }
    return std::string(kCutShort);
}

/// The next marker at or after `at` that is neither stuffing (FF00), a restart (FFD0–D7) nor padding (FFFF).
std::size_t next_jpeg_marker(Bytes bytes, std::size_t at) {
    while (at + 1 < bytes.size()) {
        const void* found = std::memchr(bytes.data() + at, 0xFF, bytes.size() - at - 1);
        if (found == nullptr) break;
        at = static_cast<std::size_t>(static_cast<const std::byte*>(found) - bytes.data());
        const unsigned code = byte_at(bytes, at + 1);
        if (code != 0x00 && code != 0xFF && (code < 0xD0 || code > 0xD7)) return at;
        ++at;
    }
    return bytes.size();
}

/// Walks the segments to the end-of-image marker, skipping over embedded previews and entropy-coded data.
std::string jpeg_problem(Bytes bytes) {
    for (std::size_t at = next_jpeg_marker(bytes, 2); at + 1 < bytes.size();
         at = next_jpeg_marker(bytes, at)) {
        if (byte_at(bytes, at + 1) == 0xD9) return {};
        if (at + 4 > bytes.size()) break;
        at += 2 + (byte_at(bytes, at + 2) << 8 | byte_at(bytes, at + 3));
    }
    return std::string(kCutShort);
}

constexpr std::array<std::string_view, 8> kIds{"", "png", "jpeg", "tiff", "targa", "bmp", "openexr", "hdr"};

struct Extension {
    std::string_view text;
    ImageFormat format;
};
constexpr std::array kExtensions{
    Extension{".png", ImageFormat::Png},   Extension{".jpg", ImageFormat::Jpeg},
    Extension{".jpeg", ImageFormat::Jpeg}, Extension{".jpe", ImageFormat::Jpeg},
    Extension{".jfif", ImageFormat::Jpeg}, Extension{".tif", ImageFormat::Tiff},
    Extension{".tiff", ImageFormat::Tiff}, Extension{".tga", ImageFormat::Targa},
    Extension{".bmp", ImageFormat::Bmp},   Extension{".exr", ImageFormat::OpenExr},
    Extension{".hdr", ImageFormat::Hdr},   Extension{".pic", ImageFormat::Hdr},
    Extension{".rgbe", ImageFormat::Hdr},  Extension{".xyze", ImageFormat::Hdr},
};

}  // namespace

ImageFormat image_format_of(Bytes bytes) {
    using namespace std::string_view_literals;
    if (starts_with(bytes, "\x89PNG\r\n\x1a\n"sv)) return ImageFormat::Png;
    if (starts_with(bytes, "\xFF\xD8\xFF"sv)) return ImageFormat::Jpeg;
    if (starts_with(bytes, "II*\0"sv) || starts_with(bytes, "MM\0*"sv)) return ImageFormat::Tiff;
    if (starts_with(bytes, "II+\0"sv) || starts_with(bytes, "MM\0+"sv)) return ImageFormat::Tiff;
    if (starts_with(bytes, "BM"sv)) return ImageFormat::Bmp;
    if (starts_with(bytes, "\x76\x2f\x31\x01"sv)) return ImageFormat::OpenExr;
    if (starts_with(bytes, "#?"sv)) return ImageFormat::Hdr;
    return looks_like_targa(bytes) ? ImageFormat::Targa : ImageFormat::Unknown;
}

ImageFormat image_format_of_extension(std::string_view extension) {
    std::string lower(extension);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const Extension& row : kExtensions)
        if (row.text == lower) return row.format;
    return ImageFormat::Unknown;
}

std::string_view image_format_id(ImageFormat format) { return kIds[static_cast<std::size_t>(format)]; }

std::string image_structure_problem(ImageFormat format, Bytes bytes) {
    if (format == ImageFormat::Png) return png_problem(bytes);
    if (format == ImageFormat::Jpeg) return jpeg_problem(bytes);
    return {};
}

}  // namespace patina

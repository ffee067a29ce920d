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

/// CRC-32 as in ISO 3309 and PNG, eight bytes at a time: table k holds the checksum of a byte with k zero
/// bytes behind it.
class Crc32 {
public:
    constexpr Crc32() {
        for (std::uint32_t i = 0; i < 256; ++i) {
            std::uint32_t crc = i;
            for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0xEDB88320u & (0u - (crc & 1u)));
            tables_[0][i] = crc;
        }
        for (std::size_t k = 1; k < 8; ++k)
            for (std::size_t i = 0; i < 256; ++i)
                tables_[k][i] = tables_[k - 1][i] >> 8 ^ tables_[0][tables_[k - 1][i] & 0xFF];
    }
    std::uint32_t of(Bytes bytes) const {
        std::uint32_t crc = ~0u;
        for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
            std::uint32_t next = 0;
            for (std::size_t i = 0; i < 4; ++i)
                next ^= tables_[7 - i][(crc >> 8 * i ^ byte_at(bytes, i)) & 0xFF] ^
                        tables_[3 - i][byte_at(bytes, 4 + i)];
            crc = next;
        }
        for (const std::byte byte : bytes)
            crc = crc >> 8 ^ tables_[0][(crc ^ std::to_integer<std::uint32_t>(byte)) & 0xFF];
        return ~crc;
    }

private:
    std::array<std::array<std::uint32_t, 256>, 8> tables_{};
};
constexpr Crc32 kCrc32;

/// Walks the chunks: length, name (with a capital where the picture cannot do without), data, checksum; the
/// last one is IEND.
std::string png_problem(Bytes bytes) {
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
        const std::uint32_t length = big_endian_32(bytes, at);
        if (length > bytes.size() - at - 12) break;
        if (kCrc32.of(bytes.subspan(at + 4, length + std::size_t{4})) !=
            big_endian_32(bytes, at + 8 + length))
            return "is damaged (a checksum is wrong); copy or export it again";
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

/// Calls see(marker, its place) for each segment before the pixels until it says true.
template <class See>
bool any_jpeg_segment(Bytes bytes, See see) {
    for (std::size_t at = next_jpeg_marker(bytes, 2); at + 4 <= bytes.size();
         at = next_jpeg_marker(bytes, at + 2 + (byte_at(bytes, at + 2) << 8 | byte_at(bytes, at + 3)))) {
        const unsigned marker = byte_at(bytes, at + 1);
        if (see(marker, at)) return true;
        if (marker == 0xDA) return false;
    }
    return false;
}

/// The first directory of a TIFF: enough to see whether all strips or tiles lie within the file.
class TiffDirectory {
public:
    explicit TiffDirectory(Bytes bytes)
        : bytes_(bytes),
          big_endian_(byte_at(bytes, 0) == 'M'),
          big_(number(2, 2) == 43),
          word_(big_ ? 8 : 4) {}

    bool data_is_complete() const {
        constexpr std::uint64_t strip_offsets = 273, strip_sizes = 279, tile_offsets = 324, tile_sizes = 325;
        const std::uint64_t start = number(big_ ? 8 : 4, word_);
        const std::uint64_t entries = number(start, big_ ? 8 : 2);
        const std::uint64_t first = start + (big_ ? 8 : 2);
        const std::size_t entry_size = big_ ? 20 : 12;
        if (truncated_ || entries > bytes_.size() / entry_size) return false;
        Field offsets;
        Field sizes;
        for (std::uint64_t i = 0; i < entries; ++i) {
            const std::uint64_t at = first + i * entry_size;
            const std::uint64_t tag = number(at, 2);
            if (tag == strip_offsets || tag == tile_offsets) offsets = field(at);
            if (tag == strip_sizes || tag == tile_sizes) sizes = field(at);
        }
        const std::uint64_t count = std::min(offsets.count, sizes.count);
        if (count > bytes_.size()) return false;
        for (std::uint64_t i = 0; i < count && !truncated_; ++i)
            if (!inside(element(offsets, i), element(sizes, i))) return false;
        return !truncated_;
    }

private:
    struct Field {
        std::uint64_t at = 0, count = 0;
        std::size_t size = 4;  ///< bytes of one element
    };
    bool inside(std::uint64_t at, std::uint64_t size) const {
        return at <= bytes_.size() && size <= bytes_.size() - at;
    }
    std::uint64_t number(std::uint64_t at, std::size_t size) const {
        if (!inside(at, size)) {
            truncated_ = true;
            return 0;
        }
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size; ++i)
            value = value << 8 | byte_at(bytes_, at + (big_endian_ ? i : size - 1 - i));
        return value;
    }
    Field field(std::uint64_t entry) const {
        constexpr std::uint64_t short_type = 3, long8_type = 16;
        const std::uint64_t type = number(entry + 2, 2);
        Field result{.count = number(entry + 4, word_),
                     .size = std::size_t{type == short_type   ? 2u
                                         : type == long8_type ? 8u
                                                              : 4u}};
        const std::uint64_t value = entry + 4 + word_;
        // Short lists stand in the entry itself.
        result.at = result.count <= word_ / result.size ? value : number(value, word_);
        return result;
    }
    std::uint64_t element(const Field& list, std::uint64_t i) const {
        return number(list.at + i * list.size, list.size);
    }

    Bytes bytes_;
    mutable bool truncated_ = false;
    bool big_endian_;
    bool big_;          ///< BigTIFF
    std::size_t word_;  ///< bytes of an offset
};

std::string tiff_problem(Bytes bytes) {
    return TiffDirectory(bytes).data_is_complete() ? "" : std::string(kCutShort);
}

/// Pixels that one byte of file can stand for at most; 0 where there is no useful bound.
std::uint64_t most_pixels_per_byte(ImageFormat format) {
    switch (format) {
        case ImageFormat::Png:  // deflate packs 1032 bytes, of eight one-bit pixels each
        case ImageFormat::Jpeg:
            return 8300;  // a block of 64 in a fraction of a bit
        case ImageFormat::Targa:
            return 64;  // a packet of 128 takes two bytes
        case ImageFormat::Bmp:
            return 130;  // a run of 255 takes two bytes
        case ImageFormat::OpenExr:
            return 33000;  // DWA keeps a half for a block of 64, and deflate packs 1032 bytes
        default:
            return 0;
    }
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

bool jpeg_is_plain(Bytes bytes) {
    return any_jpeg_segment(bytes, [&](unsigned marker, std::size_t at) {
        const bool frame =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (!frame || at + 10 > bytes.size()) return false;
        const unsigned components = byte_at(bytes, at + 9);
        return components == 1 || components == 3;
    });
}

bool jpeg_has_camera_data(Bytes bytes) {
    return any_jpeg_segment(bytes, [&](unsigned marker, std::size_t at) {
        return marker == 0xE1 && at + 10 <= bytes.size() &&
               std::memcmp(bytes.data() + at + 4, "Exif", 5) == 0;
    });
}

bool png_has_camera_data(Bytes bytes) {
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
        const auto is = [&](const char* name) { return std::memcmp(bytes.data() + at + 4, name, 4) == 0; };
        if (is("eXIf")) return true;
        if (is("IDAT") || is("IEND")) return false;
        at += 12 + std::size_t{big_endian_32(bytes, at)};
    }
    return false;
}

std::string image_structure_problem(ImageFormat format, Bytes bytes) {
    if (format == ImageFormat::Png) return png_problem(bytes);
    if (format == ImageFormat::Jpeg) return jpeg_problem(bytes);
    if (format == ImageFormat::Tiff) return tiff_problem(bytes);
    return {};
}

namespace {

std::uint32_t number_at(Bytes bytes, std::size_t i, int size, bool big_end_first) {
    std::uint32_t number = 0;
    for (int k = 0; k < size; ++k)
        number |= byte_at(bytes, i + std::size_t(k)) << 8 * (big_end_first ? size - 1 - k : k);
    return number;
}

/// BITMAPINFOHEADER and its successors; the height of a picture stored from the top is negative.
std::optional<PromisedSize> promised_by_bmp(Bytes bytes) {
    if (bytes.size() < 26 || number_at(bytes, 14, 4, false) < 40) return std::nullopt;
    const auto height = std::int64_t(std::int32_t(number_at(bytes, 22, 4, false)));
    return PromisedSize{.width = std::int64_t(std::int32_t(number_at(bytes, 18, 4, false))),
                        .height = height < 0 ? -height : height};
}

/// ImageWidth and ImageLength of the first directory (TIFF 6.0, section 2); BigTIFF is left to its decoder.
std::optional<PromisedSize> promised_by_tiff(Bytes bytes) {
    if (bytes.size() < 8) return std::nullopt;
    const bool big_end_first = byte_at(bytes, 0) == 'M';
    const std::uint64_t first = number_at(bytes, 4, 4, big_end_first);
    if (number_at(bytes, 2, 2, big_end_first) != 42 || first + 2 > bytes.size()) return std::nullopt;
    PromisedSize size;
    const std::uint32_t count = number_at(bytes, std::size_t(first), 2, big_end_first);
    for (std::uint32_t i = 0; i < count && first + 14 + 12 * std::uint64_t(i) <= bytes.size(); ++i) {
        const auto entry = std::size_t(first + 2 + 12 * std::uint64_t(i));
        const std::uint32_t tag = number_at(bytes, entry, 2, big_end_first);
        const int bytes_each = number_at(bytes, entry + 2, 2, big_end_first) == 3 ? 2 : 4;
        const std::int64_t value = number_at(bytes, entry + 8, bytes_each, big_end_first);
        if (tag == 256) size.width = value;
        if (tag == 257) size.height = value;
    }
    if (size.width == 0 || size.height == 0) return std::nullopt;
    return size;
}

}  // namespace

std::optional<PromisedSize> promised_size(ImageFormat format, Bytes bytes) {
    if (format == ImageFormat::Bmp) return promised_by_bmp(bytes);
    if (format == ImageFormat::Tiff) return promised_by_tiff(bytes);
    if (format == ImageFormat::Png && bytes.size() >= 24)
        return PromisedSize{.width = big_endian_32(bytes, 16), .height = big_endian_32(bytes, 20)};
    if (format == ImageFormat::Targa && bytes.size() >= 18)
        return PromisedSize{.width = byte_at(bytes, 12) | byte_at(bytes, 13) << 8,
                            .height = byte_at(bytes, 14) | byte_at(bytes, 15) << 8};
    return std::nullopt;
}

bool can_hold(ImageFormat format, std::uint64_t file_bytes, std::uint64_t pixels) {
    const std::uint64_t ratio = most_pixels_per_byte(format);
    return ratio == 0 || pixels / ratio <= file_bytes;
}

}  // namespace patina

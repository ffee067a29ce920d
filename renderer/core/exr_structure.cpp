#include "renderer/core/exr_structure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>

namespace patina {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::uint64_t kFirstHeader = 8;  ///< behind the magic number and the version
constexpr std::size_t kLongestName = 255;
constexpr std::uint32_t kSingleTiled = 0x200, kMultiPart = 0x1000;  ///< flags beside the version

/// Little-endian, the first four bytes.
std::uint32_t word(Bytes bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[i]) << 8 * i;
    return value;
}

struct Attribute {
    std::string_view name, type;
    Bytes value;
};

/// Bytes of a list of channels as the library reads it: to the first that has no name, whatever size is told.
std::size_t bytes_of_channels(Bytes value) {
    constexpr std::size_t behind_name = 16;
    std::size_t at = 0;
    while (at < value.size() && value[at] != std::byte{0}) {
        while (at < value.size() && value[at] != std::byte{0}) ++at;
        at += 1 + behind_name;
    }
    return at + 1;
}

/// The library does not look at the size that is told of these; where it is another one, all that follows
/// would be read as something else than what is checked here.
bool has_its_size(const Attribute& attribute) {
    struct Fixed {
        std::string_view type;
        std::size_t bytes;
    };
    static constexpr Fixed fixed[] = {{"box2f", 16},      {"box2i", 16},   {"chromaticities", 32},
                                      {"compression", 1}, {"double", 8},   {"envmap", 1},
                                      {"float", 4},       {"int", 4},      {"keycode", 28},
                                      {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
                                      {"m44f", 64},       {"m44d", 128},   {"rational", 8},
                                      {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
                                      {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
                                      {"v3f", 12},        {"v3d", 24}};
    if (attribute.type == "chlist") return bytes_of_channels(attribute.value) == attribute.value.size();
    const auto known = std::ranges::find(fixed, attribute.type, &Fixed::type);
    return known == std::end(fixed) || known->bytes == attribute.value.size();
}

/// Rows of pixels in a block, by the number of the compression; what is not known is refused by the library.
double rows_of_block(std::size_t compression) {
    constexpr std::array rows{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    return compression < rows.size() ? rows[compression] : rows.back();
}

/// What decides how many blocks a part has.
struct PartShape {
    double width = 0.0, height = 0.0;
    double tile_width = 0.0, tile_height = 0.0;
    double rows = 1.0;
    double told_chunks = 0.0;
    bool tiled = false;

    void take(const Attribute& attribute) {
        const std::string_view name = attribute.name;
        const Bytes value = attribute.value;
        const auto signed_word = [&](std::size_t i) {
            return double(static_cast<std::int32_t>(word(value.subspan(4 * i))));
        };
        if (name == "dataWindow" && value.size() == 16) {
            width = signed_word(2) - signed_word(0) + 1.0;
            height = signed_word(3) - signed_word(1) + 1.0;
        } else if (name == "tiles" && value.size() == 9) {
            tile_width = word(value);
            tile_height = word(value.subspan(4));
        } else if (name == "compression" && value.size() == 1) {
            rows = rows_of_block(std::to_integer<std::size_t>(value[0]));
        } else if (name == "chunkCount" && value.size() == 4) {
            told_chunks = signed_word(0);
        } else if (name == "type") {
            const std::string_view type(reinterpret_cast<const char*>(value.data()), value.size());
            tiled = type.find("tile") != std::string_view::npos;
        }
    }
    /// At least so many; smaller levels of a tiled part would come on top.
    double chunks() const {
        const double counted = tiled ? std::ceil(width / tile_width) * std::ceil(height / tile_height)
                                     : std::ceil(height / rows);
        return std::max(counted, told_chunks);
    }
};

class Walk {
public:
    Walk(Bytes start, std::uint64_t file_bytes) : start_(start), file_bytes_(file_bytes) {}

    ExrStructure headers() {
        if (!take(kFirstHeader)) return ended();
        const std::uint32_t version = word(start_.subspan(4));
        const bool many = (version & kMultiPart) != 0;
        double chunks = 0.0;
        do {
            PartShape part{.tiled = !many && (version & kSingleTiled) != 0};
            std::size_t attributes = 0;
            for (std::optional<Attribute> next; (next = attribute()) && !next->name.empty(); ++attributes) {
                if (!has_its_size(*next)) return {.problem = "is damaged; copy or export it again"};
                part.take(*next);
            }
            if (short_) return ended();
            if (attributes == 0) break;
            chunks += part.chunks();
        } while (many);
        // NaN, where a tile has no size, is no promise that can be kept either.
        if (!(8.0 * chunks <= double(file_bytes_ - at_))) return cut_short();
        return {.header_bytes = at_};
    }

private:
    static ExrStructure cut_short() { return {.problem = "is cut short; copy or export it again"}; }
    ExrStructure ended() const { return at_ > file_bytes_ ? cut_short() : ExrStructure{}; }

    /// Goes on by that many bytes; false where they are not all at hand.
    bool take(std::uint64_t bytes) {
        at_ += bytes;
        short_ = at_ > start_.size();
        return !short_;
    }
    /// A text that a zero byte ends.
    std::string_view text() {
        const std::uint64_t from = at_;
        while (take(1))
            if (start_[at_ - 1] == std::byte{0} || at_ - from > kLongestName)
                return {reinterpret_cast<const char*>(start_.data()) + from, std::size_t(at_ - from - 1)};
        return {};
    }
    /// Without a name at a header's end; nothing where the bytes end first.
    std::optional<Attribute> attribute() {
        Attribute result{.name = text()};
        if (short_) return std::nullopt;
        if (result.name.empty()) return result;
        result.type = text();
        if (short_ || !take(4)) return std::nullopt;
        const std::uint32_t size = word(start_.subspan(at_ - 4));
        const std::uint64_t from = at_;
        if (!take(size)) return std::nullopt;
        result.value = start_.subspan(from, size);
        return result;
    }

    Bytes start_;
    std::uint64_t file_bytes_ = 0, at_ = 0;
    bool short_ = false;
};

}  // namespace

ExrStructure exr_structure(Bytes start, std::uint64_t file_bytes) {
    return Walk(start, file_bytes).headers();
}

}  // namespace patina

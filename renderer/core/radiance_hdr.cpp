#include "renderer/core/radiance_hdr.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string_view>

namespace patina {
namespace {

using Bytes = std::span<const std::byte>;
using Rgbe = std::array<std::uint8_t, 4>;

constexpr std::string_view kCutShort = "is cut short; copy or export it again";
constexpr std::string_view kDamaged = "has damaged pixels; copy or export it again";
constexpr std::size_t kMaxHeaderBytes = 1 << 20;

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
        text.remove_suffix(1);
    return text;
}

/// The next line without its end; nothing where the text ends first.
std::optional<std::string_view> take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    return trimmed(line);
}

template <class Number>
std::optional<Number> take_number(std::string_view& text) {
    text = trimmed(text);
    Number number{};
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
    return number;
}

std::string plain(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", number);
    return text.data();
}

void read_exposure(std::string_view value, RadianceHeader& header) {
    const auto exposure = take_number<double>(value);
    if (!exposure || !(*exposure > 0.0) || !std::isfinite(*exposure)) {
        header.notes.emplace_back("an EXPOSURE line without a positive number was passed over");
        return;
    }
    header.exposure *= *exposure;
}

void read_color_correction(std::string_view value, RadianceHeader& header) {
    glm::dvec3 factors(0.0);
    for (int c = 0; c < 3; ++c) factors[c] = take_number<double>(value).value_or(0.0);
    if (factors.x > 0.0 && factors.y > 0.0 && factors.z > 0.0) header.exposure *= factors;
}

/// Chromaticities of red, green, blue and white; all zero where a program did not know them.
void read_primaries(std::string_view value, RadianceHeader& header) {
    constexpr std::array rec709{0.64, 0.33, 0.30, 0.60, 0.15, 0.06};
    constexpr double tolerance = 0.025;  // Radiance's own default lies this close
    bool same = true;
    bool unknown = true;
    for (const double expected : rec709) {
        const double number = take_number<double>(value).value_or(0.0);
        same = same && std::abs(number - expected) < tolerance;
        unknown = unknown && number == 0.0;
    }
    if (!same && !unknown)
        header.notes.emplace_back("a PRIMARIES line was passed over: colours are taken as Rec. 709");
}

void read_variable(std::string_view line, RadianceHeader& header) {
    const std::size_t equals = line.find('=');
    if (line.starts_with('#') || equals == std::string_view::npos) return;
    const std::string_view name = trimmed(line.substr(0, equals));
    std::string_view value = trimmed(line.substr(equals + 1));
    if (name == "EXPOSURE") read_exposure(value, header);
    if (name == "COLORCORR") read_color_correction(value, header);
    if (name == "GAMMA" && take_number<double>(value).value_or(1.0) != 1.0)
        header.notes.emplace_back("a GAMMA line was passed over: the pixels are taken as linear");
    if (name == "PRIMARIES") read_primaries(value, header);
    if (name != "FORMAT") return;
    header.xyz = value == "32-bit_rle_xyze";
    if (!header.xyz && value != "32-bit_rle_rgbe")
        header.problem =
            "holds pixels of the kind \"" + std::string(value.substr(0, 40)) + "\"; save it as RGBE";
}

struct Axis {
    char name = 0;
    bool reversed = false;  ///< has a minus sign
    std::int64_t length = 0;
};

std::optional<Axis> take_axis(std::string_view& text) {
    text = trimmed(text);
    if (text.size() < 3 || (text[0] != '+' && text[0] != '-') || (text[1] != 'X' && text[1] != 'Y'))
        return std::nullopt;
    Axis axis{.name = text[1], .reversed = text[0] == '-'};
    text.remove_prefix(2);
    const auto length = take_number<std::int64_t>(text);
    if (!length || *length < 1) return std::nullopt;
    axis.length = *length;
    return axis;
}

/// "-Y 512 +X 1024" and its seven relatives.
bool read_resolution(std::string_view line, RadianceHeader& header) {
    const auto first = take_axis(line);
    const auto second = take_axis(line);
    if (!first || !second || first->name == second->name || !line.empty()) return false;
    const Axis& x = first->name == 'X' ? *first : *second;
    const Axis& y = first->name == 'Y' ? *first : *second;
    header.width = x.length;
    header.height = y.length;
    header.columns_first = first->name == 'X';
    header.bottom_up = !y.reversed;
    header.right_to_left = x.reversed;
    return true;
}

/// Decodes one scanline after the other into RGBE quadruples.
class ScanlineReader {
public:
    ScanlineReader(Bytes bytes, std::size_t length) : bytes_(bytes), line_(length) {}

    const std::vector<Rgbe>& line() const { return line_; }
    std::string_view problem() const { return problem_; }
    bool next() {
        constexpr std::size_t shortest = 8;
        constexpr std::size_t longest = 32767;
        const bool may_be_packed = line_.size() >= shortest && line_.size() <= longest;
        if (may_be_packed && bytes_.size() >= 4 && byte(0) == 2 && byte(1) == 2 && byte(2) < 128)
            return next_packed();
        return next_flat();
    }

private:
    unsigned byte(std::size_t i) const { return std::to_integer<unsigned>(bytes_[i]); }
    bool fail(std::string_view problem) {
        problem_ = problem;
        return false;
    }

    /// Each of the four components by itself: a count above 128 repeats one byte count − 128 times, others
    /// copy count bytes.
    bool next_packed() {
        if ((byte(2) << 8 | byte(3)) != line_.size()) return fail(kDamaged);
        bytes_ = bytes_.subspan(4);
        for (std::size_t component = 0; component < 4; ++component)
            for (std::size_t i = 0; i < line_.size();) {
                if (bytes_.size() < 2) return fail(kCutShort);
                const bool run = byte(0) > 128;
                const std::size_t count = run ? byte(0) - 128 : byte(0);
                const std::size_t stored = run ? 1 : count;
                if (count == 0 || count > line_.size() - i) return fail(kDamaged);
                if (bytes_.size() < 1 + stored) return fail(kCutShort);
                for (std::size_t k = 0; k < count; ++k)
                    line_[i + k][component] = static_cast<std::uint8_t>(byte(run ? 1 : 1 + k));
                i += count;
                bytes_ = bytes_.subspan(1 + stored);
            }
        return true;
    }

    /// Four bytes a pixel; 1, 1, 1, n repeats the last pixel n times, a following one n · 256 times and so
    /// on.
    bool next_flat() {
        int shift = 0;
        for (std::size_t i = 0; i < line_.size();) {
            if (bytes_.size() < 4) return fail(kCutShort);
            Rgbe pixel;
            std::memcpy(pixel.data(), bytes_.data(), 4);
            bytes_ = bytes_.subspan(4);
            if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
                line_[i++] = pixel;
                shift = 0;
                continue;
            }
            const std::size_t count = shift > 24 ? 0 : std::size_t{pixel[3]} << shift;
            if (i == 0 || count > line_.size() - i) return fail(kDamaged);
            for (std::size_t k = 0; k < count; ++k, ++i) line_[i] = line_[i - 1];
            shift += 8;
        }
        return true;
    }

    Bytes bytes_;
    std::vector<Rgbe> line_;
    std::string_view problem_;
};

/// From RGBE (or XYZE) to radiance.
class Colorimeter {
public:
    explicit Colorimeter(const RadianceHeader& header) : xyz_(header.xyz), gain_(1.0 / header.exposure) {
        for (int e = 1; e < 256; ++e) scale_[e] = std::ldexp(1.0f, e - (128 + 8));
    }
    glm::vec3 radiance(const Rgbe& pixel) const {
        const float scale = scale_[pixel[3]];
        const glm::vec3 value = glm::vec3(pixel[0], pixel[1], pixel[2]) * scale * gain_;
        if (!xyz_) return value;
        return {3.2406f * value.x - 1.5372f * value.y - 0.4986f * value.z,
                -0.9689f * value.x + 1.8758f * value.y + 0.0415f * value.z,
                0.0557f * value.x - 0.2040f * value.y + 1.0570f * value.z};
    }

private:
    std::array<float, 256> scale_{};  ///< 2^(e − 136); an exponent of 0 is black
    bool xyz_;
    glm::vec3 gain_;
};

/// A header that promises far more pixels than the bytes can hold: two bytes give at most 127 of a pixel's
/// four parts.
bool promises_too_much(const RadianceHeader& header, std::size_t bytes) {
    constexpr std::int64_t packed_pixels_per_byte = 16;
    constexpr std::int64_t slack =
        1 << 20;  // the older run lengths may say more; a picture this small harms nobody
    return header.width * header.height > slack + packed_pixels_per_byte * static_cast<std::int64_t>(bytes);
}

}  // namespace

RadianceHeader parse_radiance_header(Bytes bytes) {
    RadianceHeader header;
    const std::string_view whole(reinterpret_cast<const char*>(bytes.data()),
                                 std::min(bytes.size(), kMaxHeaderBytes));
    std::string_view text = whole;
    auto line = take_line(text);
    for (line = take_line(text); line && !line->empty(); line = take_line(text)) read_variable(*line, header);
    const auto resolution = line ? take_line(text) : std::nullopt;
    if (!header.problem.empty()) return header;
    if (!resolution)
        header.problem = kCutShort;
    else if (!read_resolution(*resolution, header))
        header.problem = "has no size such as \"-Y 512 +X 1024\" in its header; export it again";
    header.size = whole.size() - text.size();
    if (header.exposure != glm::dvec3(1.0))
        header.notes.push_back("the header's EXPOSURE (" + plain(header.exposure.y) +
                               ") was undone: radiance is divided by it");
    return header;
}

RadiancePicture parse_radiance_pixels(Bytes bytes, const RadianceHeader& header) {
    RadiancePicture picture{.notes = header.notes};
    if (promises_too_much(header, bytes.size())) {
        picture.problem = kCutShort;
        return picture;
    }
    const int width = static_cast<int>(header.width);
    const int height = static_cast<int>(header.height);
    const int lines = header.columns_first ? width : height;
    const int length = header.columns_first ? height : width;
    picture.image = make_image(width, height, 3, PixelType::F32);
    auto* pixels = reinterpret_cast<glm::vec3*>(picture.image.bytes.data());
    ScanlineReader reader(bytes.subspan(header.size), static_cast<std::size_t>(length));
    const Colorimeter colorimeter(header);
    for (int line = 0; line < lines; ++line) {
        if (!reader.next()) return {.problem = std::string(reader.problem())};
        for (int i = 0; i < length; ++i) {
            const int along_x = header.columns_first ? line : i;
            const int along_y = header.columns_first ? i : line;
            const int x = header.right_to_left ? width - 1 - along_x : along_x;
            const int y = header.bottom_up ? height - 1 - along_y : along_y;
            pixels[static_cast<std::size_t>(y) * width + x] = colorimeter.radiance(reader.line()[i]);
        }
    }
    return picture;
}

}  // namespace patina

#include "renderer/map_levels.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace patina {

namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr int kBuckets = 4096;

/// What the numbers of a level mean, which is what an average of them must respect.
enum class Meaning { Number, SrgbLight, Direction };

/// The sRGB code whose decoded value is nearest in code values, exactly as rounding linear_to_srgb would give
/// it: a table of the code at the start of each bucket, then the few thresholds inside it.
class SrgbEncoder {
public:
    SrgbEncoder() {
        for (int code = 1; code < 256; ++code)
            threshold_[code] = srgb_to_linear((float(code) - 0.5f) / 255.0f);
        threshold_[256] = 2.0f;
        int code = 0;
        for (int b = 0; b < kBuckets; ++b) {
            while (threshold_[code + 1] <= float(b) / kBuckets) ++code;
            start_[b] = std::uint8_t(code);
        }
    }
    std::uint8_t operator()(float linear) const {
        const float x = std::clamp(linear, 0.0f, 1.0f);
        int code = start_[std::min(int(x * kBuckets), kBuckets - 1)];
        while (threshold_[code + 1] <= x) ++code;
        return std::uint8_t(code);
    }

private:
    std::array<float, 257> threshold_{};
    std::array<std::uint8_t, kBuckets> start_{};
};

const SrgbEncoder& srgb_encoder() {
    static const SrgbEncoder encoder;
    return encoder;
}

/// Decoded value of each byte: as a number and as sRGB light.
struct ByteTables {
    std::array<float, 256> number{};
    std::array<float, 256> light{};
};
const ByteTables& byte_tables() {
    static const ByteTables shared = [] {
        ByteTables tables;
        for (int i = 0; i < 256; ++i) {
            tables.number[i] = float(i) / 255.0f;
            tables.light[i] = srgb_to_linear(tables.number[i]);
        }
        return tables;
    }();
    return shared;
}

/// 0…1 to the nearest code.
template <class T>
T rounded(float x) {
    const float code = x * float(std::numeric_limits<T>::max()) + 0.5f;
    return T(code);
}

float finite(float x) { return std::isfinite(x) ? std::clamp(x, -kLargestHalf, kLargestHalf) : 0.0f; }

template <class T>
const T* row_of(const Image& image, int y) {
    return reinterpret_cast<const T*>(image.bytes.data()) + std::size_t(y) * image.width * image.channels;
}
template <class T>
T* row_of(Image& image, int y) {
    return reinterpret_cast<T*>(image.bytes.data()) + std::size_t(y) * image.width * image.channels;
}

/// Unit; (0, 0, 1) for what has no direction.
glm::vec3 direction_or_up(glm::vec3 sum) {
    const float size2 = glm::dot(sum, sum);
    return size2 > 1e-12f ? sum / std::sqrt(size2) : glm::vec3(0.0f, 0.0f, 1.0f);
}

/// One row as numbers that may be averaged.
void decode_row(const Image& image, int y, Meaning meaning, float* out) {
    const int count = image.width * image.channels;
    if (image.type == PixelType::U8) {
        const auto* in = row_of<std::uint8_t>(image, y);
        const float* number = byte_tables().number.data();
        if (meaning == Meaning::SrgbLight) {
            const float* light = byte_tables().light.data();
            for (int i = 0; i < count; i += 4) {
                for (int c = 0; c < 3; ++c) out[i + c] = light[in[i + c]];
                out[i + 3] = number[in[i + 3]];
            }
        } else {
            for (int i = 0; i < count; ++i) out[i] = number[in[i]];
        }
    } else if (image.type == PixelType::U16) {
        const auto* in = row_of<std::uint16_t>(image, y);
        for (int i = 0; i < count; ++i) out[i] = float(in[i]) / 65535.0f;
    } else {
        std::memcpy(out, row_of<float>(image, y), std::size_t(count) * sizeof(float));
    }
    if (meaning != Meaning::Direction) return;
    for (int i = 0; i < count; i += image.channels) {
        const glm::vec3 unit = direction_or_up(2.0f * glm::vec3(out[i], out[i + 1], out[i + 2]) - 1.0f);
        for (int c = 0; c < 3; ++c) out[i + c] = unit[c];
    }
}

/// What an average of unit normals, of that squared length, adds to alpha²: 1/2κ of the von Mises-Fisher lobe
/// with the same mean, κ = (3R − R³)/(1 − R²) (Banerjee et al. 2005).
float spread_of(float length2) {
    const float squared = std::clamp(length2, 0.0f, 1.0f);
    const float R = std::sqrt(squared);
    return std::min(0.5f * (1.0f - squared) / std::max(R * (3.0f - squared), 1e-3f), 1.0f);
}

/// In place: averaged directions to unit ones, coded 0…1, and alpha = 1 − √spread.
void normalize_row(float* row, int width, int channels) {
    for (int i = 0; i < width * channels; i += channels) {
        const glm::vec3 sum(row[i], row[i + 1], row[i + 2]);
        const glm::vec3 unit = direction_or_up(sum);
        for (int c = 0; c < 3; ++c) row[i + c] = 0.5f * unit[c] + 0.5f;
        row[i + 3] = 1.0f - std::sqrt(spread_of(glm::dot(sum, sum)));
    }
}

void encode_row(std::vector<float> row, Meaning meaning, Image& image, int y) {
    if (meaning == Meaning::Direction) normalize_row(row.data(), image.width, image.channels);
    const int count = image.width * image.channels;
    if (image.type == PixelType::U8) {
        auto* out = row_of<std::uint8_t>(image, y);
        const SrgbEncoder& encode = srgb_encoder();
        const bool light = meaning == Meaning::SrgbLight;
        for (int i = 0; i < count; ++i)
            out[i] = light && i % 4 != 3 ? encode(row[i]) : rounded<std::uint8_t>(row[i]);
    } else if (image.type == PixelType::U16) {
        auto* out = row_of<std::uint16_t>(image, y);
        for (int i = 0; i < count; ++i) out[i] = rounded<std::uint16_t>(row[i]);
    } else {
        std::memcpy(row_of<float>(image, y), row.data(), std::size_t(count) * sizeof(float));
    }
}

/// Box filter from size to half of it (rounded down, at least 1): an odd size n = 2m + 1 has windows of n/m
/// texels, so each output takes three, the outer two in part.
struct Box {
    int size = 1;
    int smaller = 1;
    float weight(int output, int input) const {
        if (size == 1) return 1.0f;
        const int k = input - 2 * output;
        if (k < 0 || k > 2) return 0.0f;
        if (size % 2 == 0) return k < 2 ? 0.5f : 0.0f;
        const int m = smaller;
        return float(k == 0 ? m - output : k == 1 ? m : output + 1) / float(size);
    }
    int last_input(int output) const { return size == 1 ? 0 : 2 * output + (size % 2 == 0 ? 1 : 2); }
};

/// Makes one level from the rows of the one above as they come, and hands its own rows down before rounding
/// them: the whole chain is filtered from full-precision values in one pass, with two rows of memory a level.
class Reducer {
public:
    Reducer(const Image& source, Meaning meaning, Image& target)
        : target_(target),
          meaning_(meaning),
          across_{source.width, target.width},
          down_{source.height, target.height} {
        const std::size_t count = std::size_t(target.width) * target.channels;
        for (auto& sum : sums_) sum.assign(count, 0.0f);
        reduced_.resize(count);
    }

    /// next gets each finished row, unrounded.
    template <class Next>
    void push(const float* row, const Next& next) {
        reduce(row);
        for (int k = 0; k < 2; ++k) {
            const int output = output_ + k;
            const float weight = output < down_.smaller ? down_.weight(output, input_) : 0.0f;
            if (weight == 0.0f) continue;
            for (std::size_t i = 0; i < reduced_.size(); ++i) sums_[k][i] += weight * reduced_[i];
        }
        if (input_++ != down_.last_input(output_)) return;
        if (!target_.empty()) encode_row(sums_[0], meaning_, target_, output_);
        ++output_;
        next(sums_[0].data());
        std::swap(sums_[0], sums_[1]);
        std::fill(sums_[1].begin(), sums_[1].end(), 0.0f);
    }

private:
    void reduce(const float* row) {
        const int channels = target_.channels;
        if (across_.size % 2 == 0) {
            for (int x = 0; x < target_.width; ++x)
                for (int c = 0; c < channels; ++c)
                    reduced_[x * channels + c] =
                        0.5f * (row[2 * x * channels + c] + row[(2 * x + 1) * channels + c]);
            return;
        }
        for (int x = 0; x < target_.width; ++x) {
            const int first = across_.size == 1 ? 0 : 2 * x;
            const int taps = across_.size == 1 ? 1 : 3;
            for (int c = 0; c < channels; ++c) {
                float sum = 0.0f;
                for (int k = 0; k < taps; ++k)
                    sum += across_.weight(x, first + k) * row[(first + k) * channels + c];
                reduced_[x * channels + c] = sum;
            }
        }
    }

    Image& target_;
    Meaning meaning_;
    Box across_;
    Box down_;
    std::array<std::vector<float>, 2> sums_;
    std::vector<float> reduced_;
    int input_ = 0;
    int output_ = 0;
};

void push_down(std::vector<Reducer>& chain, std::size_t level, const float* row) {
    if (level == chain.size()) return;
    chain[level].push(row, [&](const float* finished) { push_down(chain, level + 1, finished); });
}

/// Nothing but its shape.
Image without_texels(int width, int height, const Image& like) {
    return {.width = width, .height = height, .channels = like.channels, .type = like.type, .bytes = {}};
}

bool is_too_fine(int width, int height, int finest_side) {
    return finest_side > 0 && (width > 1 || height > 1) &&
           std::min(std::max(width / 2, 1), std::max(height / 2, 1)) >= finest_side;
}

/// row_at(y): of the finest level, as it is sampled. Levels that are finer than need be get no texels.
template <class RowAt>
void fill_chain(std::vector<Image>& levels, Meaning meaning, int finest_side, const RowAt& row_at) {
    for (int w = levels[0].width, h = levels[0].height; w > 1 || h > 1;) {
        w = std::max(w / 2, 1);
        h = std::max(h / 2, 1);
        levels.push_back(is_too_fine(w, h, finest_side)
                             ? without_texels(w, h, levels[0])
                             : make_image(w, h, levels[0].channels, levels[0].type));
    }
    std::vector<Reducer> chain;
    for (std::size_t i = 1; i < levels.size(); ++i) chain.emplace_back(levels[i - 1], meaning, levels[i]);
    std::vector<float> row(std::size_t(levels[0].width) * levels[0].channels);
    for (int y = 0; y < levels[0].height; ++y) {
        row_at(y, row.data());
        push_down(chain, 0, row.data());
    }
}

/// Channels spread to four: grey into red, green and blue; alpha kept, or 1.
template <class T>
Image spread(const Image& image, T one) {
    Image result = make_image(image.width, image.height, 4, image.type);
    const auto* in = row_of<T>(image, 0);
    auto* out = row_of<T>(result, 0);
    const std::size_t count = std::size_t(image.width) * image.height;
    const int channels = image.channels;
    const bool grey = channels <= 2;
    for (std::size_t i = 0; i < count; ++i, in += channels, out += 4) {
        out[0] = in[0];
        out[1] = grey ? in[0] : in[1];
        out[2] = grey ? in[0] : in[2];
        out[3] = channels == 2 ? in[1] : channels == 4 ? in[3] : one;
    }
    return result;
}
Image spread_to_four(const Image& image) {
    if (image.type == PixelType::U8) return spread<std::uint8_t>(image, 255);
    if (image.type == PixelType::U16) return spread<std::uint16_t>(image, 65535);
    return spread<float>(image, 1.0f);
}

/// A normal map of two channels holds x and y; z follows from the length 1.
Image with_third_axis(const Image& image) {
    Image result = make_image(image.width, image.height, 4, image.type);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const float nx = 2.0f * texel(image, x, y, 0) - 1.0f;
            const float ny = 2.0f * texel(image, x, y, 1) - 1.0f;
            const float nz = std::sqrt(std::max(1.0f - nx * nx - ny * ny, 0.0f));
            set_texel(result, x, y, 0, texel(image, x, y, 0));
            set_texel(result, x, y, 1, texel(image, x, y, 1));
            set_texel(result, x, y, 2, 0.5f * nz + 0.5f);
            set_texel(result, x, y, 3, 1.0f);
        }
    }
    return result;
}

/// A normal map's own alpha means nothing; that of its smaller levels is spread, of which the full size has
/// none.
void clear_alpha(Image& image) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) set_texel(image, x, y, 3, 1.0f);
}

void make_finite(Image& image) {
    if (image.type != PixelType::F32) return;
    auto* values = row_of<float>(image, 0);
    const std::size_t count = image.bytes.size() / sizeof(float);
    for (std::size_t i = 0; i < count; ++i) values[i] = finite(values[i]);
}

/// There is no 16-bit sRGB texture format; 16 linear bits are fine enough to hold the decoded light.
void decode_16_bits(Image& image) {
    static const std::vector<std::uint16_t> light = [] {
        std::vector<std::uint16_t> codes(65536);
        for (int i = 0; i < 65536; ++i)
            codes[i] = rounded<std::uint16_t>(srgb_to_linear(float(i) / 65535.0f));
        return codes;
    }();
    auto* values = row_of<std::uint16_t>(image, 0);
    const std::size_t count = image.bytes.size() / sizeof(std::uint16_t);
    const bool has_alpha = image.channels % 2 == 0;
    for (std::size_t i = 0; i < count; ++i)
        if (!has_alpha || int(i % image.channels) != image.channels - 1) values[i] = light[values[i]];
}

/// Of rows or the whole: as it goes into the finest level.
Image as_sampled(Image top, MapKind kind, bool encoded) {
    const int channels = top.channels;
    make_finite(top);
    if (encoded && top.type == PixelType::U16) decode_16_bits(top);
    const bool is_srgb = encoded && top.type == PixelType::U8;
    if (kind == MapKind::Normal && channels == 2)
        top = with_third_axis(top);
    else if (channels == 3 || (channels < 3 && (is_srgb || kind == MapKind::Normal)))
        top = spread_to_four(top);
    if (kind == MapKind::Normal && channels == 4) clear_alpha(top);
    return top;
}

Image one_row(const Image& image, int y) {
    Image row = make_image(image.width, 1, image.channels, image.type);
    std::memcpy(row.bytes.data(), image.bytes.data() + std::size_t(y) * row.bytes.size(), row.bytes.size());
    return row;
}

/// 8 bits of three equal channels.
bool is_grey(const Image& image) {
    if (image.channels != 3 || image.type != PixelType::U8) return false;
    const std::byte* const end = image.bytes.data() + image.bytes.size();
    for (const std::byte* at = image.bytes.data(); at != end; at += 3)
        if (at[0] != at[1] || at[0] != at[2]) return false;
    return true;
}

Image first_channel(const Image& image) {
    Image grey = make_image(image.width, image.height, 1, image.type);
    for (std::size_t i = 0; i < grey.bytes.size(); ++i)
        grey.bytes[i] = image.bytes[i * std::size_t(image.channels)];
    return grey;
}

MapLevels levels_of(const Image& image, MapKind kind, bool encoded, int finest_side) {
    MapLevels result;
    result.srgb = encoded && image.type == PixelType::U8;
    const Meaning meaning = kind == MapKind::Normal ? Meaning::Direction
                            : result.srgb           ? Meaning::SrgbLight
                                                    : Meaning::Number;
    if (is_too_fine(image.width, image.height, finest_side)) {
        const Image first = as_sampled(one_row(image, 0), kind, encoded);
        result.levels.push_back(without_texels(image.width, image.height, first));
        fill_chain(result.levels, meaning, finest_side, [&](int y, float* out) {
            decode_row(as_sampled(one_row(image, y), kind, encoded), 0, meaning, out);
        });
        std::erase_if(result.levels, [](const Image& level) { return level.empty(); });
    } else {
        result.levels.push_back(as_sampled(image, kind, encoded));
        fill_chain(result.levels, meaning, finest_side,
                   [&](int y, float* out) { decode_row(result.levels[0], y, meaning, out); });
    }
    return result;
}

}  // namespace

MapLevels make_map_levels(const Image& image, MapKind kind, ColorSpace color_space, int finest_side) {
    const bool encoded = kind == MapKind::Color && color_space == ColorSpace::Srgb;
    if (finest_side > 0 && kind == MapKind::Data && is_grey(image))
        return levels_of(first_channel(image), kind, encoded, finest_side);
    return levels_of(image, kind, encoded, finest_side);
}

MapKind map_kind(MapSlot slot) {
    switch (slot) {
        case MapSlot::Albedo:
        case MapSlot::Emission:
            return MapKind::Color;
        case MapSlot::Normal:
            return MapKind::Normal;
        default:
            return MapKind::Data;
    }
}

Image make_placeholder_map() {
    constexpr int size = 64;
    constexpr int cell = 8;
    Image image = make_image(size, size, 3, PixelType::U8);
    auto* out = row_of<std::uint8_t>(image, 0);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x, out += 3) {
            const bool lit = (x / cell + y / cell) % 2 == 0;
            out[0] = out[2] = lit ? 255 : 0;
            out[1] = 0;
        }
    }
    return image;
}

}  // namespace patina

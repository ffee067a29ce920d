#include "renderer/map_filter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace patina {

namespace {

constexpr int kBuckets = 4096;

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

/// size2: at least as long as what has a direction; the square root of what has none is never shown.
constexpr float kNoLength2 = 1e-12f;

/// One channel of a row as numbers that may be averaged.
template <class T, class Decode>
void decode_plane(const std::byte* row, int channels, int width, const Decode& decode, float* out) {
    const T* in = reinterpret_cast<const T*>(row);
    for (int x = 0; x < width; ++x) out[x] = decode(in[std::size_t(x) * channels]);
}

void decode_plane(const Image& shape, const std::byte* row, int channels, const std::array<float, 256>& table,
                  float* out) {
    if (shape.type == PixelType::U8)
        decode_plane<std::uint8_t>(
            row, channels, shape.width, [&](std::uint8_t code) { return table[code]; }, out);
    else if (shape.type == PixelType::U16)
        decode_plane<std::uint16_t>(
            row, channels, shape.width, [](std::uint16_t code) { return float(code) / 65535.0f; }, out);
    else
        decode_plane<float>(
            row, channels, shape.width, [](float number) { return number; }, out);
}

/// In place, from 0…1: unit; (0, 0, 1) for what has no direction.
void decode_directions(float* nx, float* ny, float* nz, int width) {
    for (int x = 0; x < width; ++x) {
        const float a = 2.0f * nx[x] - 1.0f, b = 2.0f * ny[x] - 1.0f, c = 2.0f * nz[x] - 1.0f;
        const float size2 = a * a + b * b + c * c;
        const float size = std::sqrt(std::max(size2, kNoLength2));
        const float ua = a / size, ub = b / size, uc = c / size;
        nx[x] = size2 > kNoLength2 ? ua : 0.0f;
        ny[x] = size2 > kNoLength2 ? ub : 0.0f;
        nz[x] = size2 > kNoLength2 ? uc : 1.0f;
    }
}

/// What an average of unit normals, of that squared length, adds to alpha²: 1/2κ of the von Mises-Fisher lobe
/// with the same mean, κ = (3R − R³)/(1 − R²) (Banerjee et al. 2005).
float spread_of(float length2) {
    const float squared = std::clamp(length2, 0.0f, 1.0f);
    const float R = std::sqrt(squared);
    return std::min(0.5f * (1.0f - squared) / std::max(R * (3.0f - squared), 1e-3f), 1.0f);
}

/// The texel's direction coded 0…1, and alpha = 1 − √spread.
std::array<float, 4> normal_texel(const float* row, int width, int x) {
    const float a = row[x], b = row[width + x], c = row[2 * width + x];
    const float size2 = a * a + b * b + c * c;
    const float alpha = 1.0f - std::sqrt(spread_of(size2));
    if (!(size2 > kNoLength2)) return {0.5f, 0.5f, 1.0f, alpha};
    const float size = std::sqrt(size2);
    return {0.5f * (a / size) + 0.5f, 0.5f * (b / size) + 0.5f, 0.5f * (c / size) + 0.5f, alpha};
}

/// A texel's channels from planes that may be fewer.
std::array<float, 4> plain_texel(const float* row, int width, int planes, int x) {
    const float first = row[x];
    std::array<float, 4> texel{first, first, first, 1.0f};
    for (int c = 1; c < planes; ++c) texel[std::size_t(c)] = row[c * width + x];
    return texel;
}

template <class T, class Encode>
void encode_texels(Image& image, int y, const Encode& texel_at) {
    const int channels = image.channels;
    T* out = reinterpret_cast<T*>(image.bytes.data()) + std::size_t(y) * image.width * channels;
    for (int x = 0; x < image.width; ++x, out += channels) {
        const std::array<float, 4> texel = texel_at(x);
        for (int c = 0; c < channels; ++c) {
            if constexpr (std::is_same_v<T, float>)
                out[c] = texel[std::size_t(c)];
            else
                out[c] = rounded<T>(texel[std::size_t(c)]);
        }
    }
}

void encode_light(const float* row, int planes, Image& image, int y) {
    const SrgbEncoder& encode = srgb_encoder();
    const int channels = image.channels;
    auto* out = reinterpret_cast<std::uint8_t*>(image.bytes.data()) + std::size_t(y) * image.width * channels;
    for (int x = 0; x < image.width; ++x, out += channels) {
        const std::array<float, 4> texel = plain_texel(row, image.width, planes, x);
        for (int c = 0; c < channels; ++c)
            out[c] = c == 3 ? rounded<std::uint8_t>(texel[std::size_t(c)]) : encode(texel[std::size_t(c)]);
    }
}

void encode_row(const float* row, int planes, Meaning meaning, Image& image, int y) {
    if (meaning == Meaning::SrgbLight) return encode_light(row, planes, image, y);
    const auto encode = [&](const auto& texel_at) {
        if (image.type == PixelType::U8)
            encode_texels<std::uint8_t>(image, y, texel_at);
        else if (image.type == PixelType::U16)
            encode_texels<std::uint16_t>(image, y, texel_at);
        else
            encode_texels<float>(image, y, texel_at);
    };
    if (meaning == Meaning::Direction)
        encode([&](int x) { return normal_texel(row, image.width, x); });
    else
        encode([&](int x) { return plain_texel(row, image.width, planes, x); });
}

void repeat_first(Planes& planes, std::size_t width) {
    if (planes.size() < width) return;
    planes.resize(3 * width);
    for (std::size_t c = 1; c < 3; ++c)
        std::copy_n(planes.begin(), width, planes.begin() + std::ptrdiff_t(c * width));
}

}  // namespace

float Box::weight(int output, int input) const {
    if (size == 1) return 1.0f;
    const int k = input - 2 * output;
    if (k < 0 || k > 2) return 0.0f;
    if (size % 2 == 0) return k < 2 ? 0.5f : 0.0f;
    const int m = smaller;
    return float(k == 0 ? m - output : k == 1 ? m : output + 1) / float(size);
}

LevelFilter::LevelFilter(const Image& above, const Image& own)
    : across_{above.width, own.width}, down_{above.height, own.height} {}

const float* LevelFilter::push(const float* row, int planes) {
    const std::size_t count = std::size_t(planes) * across_.smaller;
    for (Planes& sums : sums_) sums.resize(count);
    reduced_.resize(count);
    reduce(row, planes);
    for (int k = 0; k < 2; ++k) {
        const int output = output_ + k;
        const float weight = output < down_.smaller ? down_.weight(output, input_) : 0.0f;
        if (weight == 0.0f) continue;
        float* sums = sums_[std::size_t(k)].data();
        const float* reduced = reduced_.data();
        for (std::size_t i = 0; i < count; ++i) sums[i] += weight * reduced[i];
    }
    if (input_++ != down_.last_input(output_)) return nullptr;
    ++output_;
    std::swap(finished_, sums_[0]);
    std::swap(sums_[0], sums_[1]);
    sums_[1].assign(count, 0.0f);
    return finished_.data();
}

void LevelFilter::reduce(const float* row, int planes) {
    const int width = across_.smaller;
    for (int c = 0; c < planes; ++c) {
        const float* in = row + std::size_t(c) * across_.size;
        float* out = reduced_.data() + std::size_t(c) * width;
        if (across_.size == 1) {
            out[0] = in[0];
        } else if (across_.size % 2 == 0) {
            for (int x = 0; x < width; ++x) out[x] = 0.5f * (in[2 * x] + in[2 * x + 1]);
        } else {
            for (int x = 0; x < width; ++x) {
                float sum = 0.0f;
                for (int k = 0; k < 3; ++k) sum += across_.weight(x, 2 * x + k) * in[2 * x + k];
                out[x] = sum;
            }
        }
    }
}

std::size_t LevelFilter::floats() const {
    return sums_[0].capacity() + sums_[1].capacity() + reduced_.capacity() + finished_.capacity();
}

void LevelFilter::widen() {
    for (Planes& sums : sums_) repeat_first(sums, std::size_t(across_.smaller));
}

MipChain::MipChain(std::vector<Image>& levels, Meaning meaning, int planes)
    : levels_(levels), meaning_(meaning), planes_(planes) {
    for (std::size_t i = 1; i < levels.size(); ++i) filters_.emplace_back(levels[i - 1], levels[i]);
}

void MipChain::push(const std::byte* row, int channels) {
    const Image& finest = levels_.front();
    const int width = finest.width;
    top_.resize(std::size_t(planes_) * width);
    for (int c = 0; c < planes_; ++c) {
        const bool is_light = meaning_ == Meaning::SrgbLight && c < 3;
        decode_plane(finest, row + std::size_t(c) * bytes_per_channel(finest.type), channels,
                     is_light ? byte_tables().light : byte_tables().number,
                     top_.data() + std::size_t(c) * width);
    }
    if (meaning_ == Meaning::Direction)
        decode_directions(top_.data(), top_.data() + width, top_.data() + 2 * width, width);
    const float* from = top_.data();
    for (std::size_t i = 0; i < filters_.size(); ++i) {
        from = filters_[i].push(from, planes_);
        if (!from) return;
        Image& level = levels_[i + 1];
        if (!level.empty()) encode_row(from, planes_, meaning_, level, filters_[i].rows_done() - 1);
    }
}

std::size_t MipChain::bytes() const {
    std::size_t floats = top_.capacity();
    for (const LevelFilter& filter : filters_) floats += filter.floats();
    return floats * sizeof(float);
}

void MipChain::widen() {
    planes_ = 3;
    for (LevelFilter& filter : filters_) filter.widen();
}

}  // namespace patina

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
/// it: a table of the code at the start of each bucket, of which none is as wide as the step between two
/// codes (at least 1/(12.92 · 255)), so that one comparison is left.
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
        const int code = start_[std::min(int(x * kBuckets), kBuckets - 1)];
        return std::uint8_t(code + (threshold_[code + 1] <= x ? 1 : 0));
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

/// A row's first channels as planes of numbers that may be averaged. decode(number, channel).
template <int kPlanes, class T, class Decode>
void decode_planes(const T* in, int channels, int width, const Decode& decode, float* out) {
    for (int x = 0; x < width; ++x, in += channels)
        for (int c = 0; c < kPlanes; ++c) out[c * width + x] = decode(in[c], c);
}

template <class T, class Decode>
void decode_planes(const std::byte* row, int channels, const Decode& decode, Planes& out, int width) {
    const T* in = reinterpret_cast<const T*>(row);
    switch (out.size() / std::size_t(width)) {
        case 1:
            return decode_planes<1>(in, channels, width, decode, out.data());
        case 2:
            return decode_planes<2>(in, channels, width, decode, out.data());
        case 3:
            return decode_planes<3>(in, channels, width, decode, out.data());
        default:
            return decode_planes<4>(in, channels, width, decode, out.data());
    }
}

void decode_row(const std::byte* row, int channels, const Image& shape, Meaning meaning, Planes& out) {
    const float* number = byte_tables().number.data();
    const float* light = byte_tables().light.data();
    const auto byte_light = [=](std::uint8_t code, int c) { return c < 3 ? light[code] : number[code]; };
    const auto byte_number = [=](std::uint8_t code, int) { return number[code]; };
    const auto short_number = [](std::uint16_t code, int) { return float(code) / 65535.0f; };
    if (shape.type == PixelType::U8 && meaning == Meaning::SrgbLight)
        decode_planes<std::uint8_t>(row, channels, byte_light, out, shape.width);
    else if (shape.type == PixelType::U8)
        decode_planes<std::uint8_t>(row, channels, byte_number, out, shape.width);
    else if (shape.type == PixelType::U16)
        decode_planes<std::uint16_t>(row, channels, short_number, out, shape.width);
    else
        decode_planes<float>(
            row, channels, [](float number, int) { return number; }, out, shape.width);
}

/// In place, from 0…1: unit; (0, 0, 1) for what has no direction.
void decode_directions(Planes& row, int width) {
    float* const nx = row.data();
    float* const ny = nx + width;
    float* const nz = ny + width;
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
    const float squared = std::min(std::max(length2, 0.0f), 1.0f);
    const float R = std::sqrt(squared);
    return std::min(0.5f * (1.0f - squared) / std::max(R * (3.0f - squared), 1e-3f), 1.0f);
}

/// Averaged directions as unit ones coded 0…1, and alpha = 1 − √spread.
void code_directions(const float* row, int width, Planes& out) {
    out.resize(std::size_t(4) * width);
    std::copy_n(row, 3 * width, out.begin());
    float* const nx = out.data();
    float* const ny = nx + width;
    float* const nz = ny + width;
    float* const alpha = nz + width;
    for (int x = 0; x < width; ++x) {
        const float a = nx[x], b = ny[x], c = nz[x];
        const float size2 = a * a + b * b + c * c;
        const float half = 0.5f / std::sqrt(std::max(size2, kNoLength2));
        const float ca = half * a + 0.5f, cb = half * b + 0.5f, cc = half * c + 0.5f;
        nx[x] = size2 > kNoLength2 ? ca : 0.5f;
        ny[x] = size2 > kNoLength2 ? cb : 0.5f;
        nz[x] = size2 > kNoLength2 ? cc : 1.0f;
        alpha[x] = size2;
    }
    for (int x = 0; x < width; ++x) alpha[x] = 1.0f - std::sqrt(spread_of(alpha[x]));
}

template <class T, class Encode>
void encode_channels(const float* row, int planes, Image& image, int y, const Encode& encode) {
    const int channels = image.channels, width = image.width;
    T* const out = reinterpret_cast<T*>(image.bytes.data()) + std::size_t(y) * width * channels;
    for (int c = 0; c < channels; ++c) {
        const bool is_alpha = c == 3 && planes < 4;
        const T one = is_alpha ? encode(1.0f, c) : T();
        const float* plane = row + std::size_t(c < planes ? c : 0) * width;
        for (int x = 0; x < width; ++x) out[x * channels + c] = is_alpha ? one : encode(plane[x], c);
    }
}

void encode_row(const float* row, int planes, bool is_light, Image& image, int y) {
    const SrgbEncoder& light = srgb_encoder();
    if (image.type == PixelType::U8 && is_light)
        encode_channels<std::uint8_t>(row, planes, image, y, [&](float number, int c) {
            return c < 3 ? light(number) : rounded<std::uint8_t>(number);
        });
    else if (image.type == PixelType::U8)
        encode_channels<std::uint8_t>(row, planes, image, y,
                                      [](float number, int) { return rounded<std::uint8_t>(number); });
    else if (image.type == PixelType::U16)
        encode_channels<std::uint16_t>(row, planes, image, y,
                                       [](float number, int) { return rounded<std::uint16_t>(number); });
    else
        encode_channels<float>(row, planes, image, y, [](float number, int) { return number; });
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
    decode_row(row, channels, finest, meaning_, top_);
    if (meaning_ == Meaning::Direction) decode_directions(top_, width);
    const float* from = top_.data();
    for (std::size_t i = 0; i < filters_.size(); ++i) {
        from = filters_[i].push(from, planes_);
        if (!from) return;
        Image& level = levels_[i + 1];
        if (level.empty()) continue;
        const int y = filters_[i].rows_done() - 1;
        if (meaning_ == Meaning::Direction) {
            code_directions(from, level.width, coded_);
            encode_row(coded_.data(), 4, false, level, y);
        } else {
            encode_row(from, planes_, meaning_ == Meaning::SrgbLight, level, y);
        }
    }
}

std::size_t MipChain::bytes() const {
    std::size_t floats = top_.capacity() + coded_.capacity();
    for (const LevelFilter& filter : filters_) floats += filter.floats();
    return floats * sizeof(float);
}

void MipChain::widen() {
    planes_ = 3;
    for (LevelFilter& filter : filters_) filter.widen();
}

}  // namespace patina

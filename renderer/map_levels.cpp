#include "renderer/map_levels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace patina {

namespace {

constexpr float kLargestHalf = 65504.0f;

/// 0…1 to the nearest of 16 bits.
std::uint16_t rounded(float x) {
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): never negative, and lround is slow
    return std::uint16_t(x * 65535.0f + 0.5f);
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
        for (int i = 0; i < 65536; ++i) codes[i] = rounded(srgb_to_linear(float(i) / 65535.0f));
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

/// Nothing but its shape.
Image without_texels(int width, int height, int channels, PixelType type) {
    return {.width = width, .height = height, .channels = channels, .type = type, .bytes = {}};
}

bool is_too_fine(int width, int height, int finest_side) {
    return finest_side > 0 && (width > 1 || height > 1) &&
           std::min(std::max(width / 2, 1), std::max(height / 2, 1)) >= finest_side;
}

/// 8 bits of three equal channels.
bool is_grey(const std::byte* row, int width) {
    std::byte difference{0};
    for (int x = 0; x < width; ++x, row += 3) difference |= (row[0] ^ row[1]) | (row[0] ^ row[2]);
    return difference == std::byte{0};
}

Image first_channel(const Image& image) {
    Image grey = make_image(image.width, image.height, 1, image.type);
    for (std::size_t i = 0; i < grey.bytes.size(); ++i)
        grey.bytes[i] = image.bytes[i * std::size_t(image.channels)];
    return grey;
}

}  // namespace

MapMaker::MapMaker(MapKind kind, ColorSpace color_space, int finest_side)
    : kind_(kind),
      encoded_(kind == MapKind::Color && color_space == ColorSpace::Srgb),
      finest_side_(finest_side) {}

void MapMaker::begin(const Image& shape) {
    row_ = make_image(shape.width, 1, shape.channels, shape.type);
    whole_ = {.width = shape.width, .height = shape.height, .channels = shape.channels, .type = shape.type};
    const int channels = as_sampled(row_, kind_, encoded_).channels;
    map_.srgb = encoded_ && shape.type == PixelType::U8;
    const bool is_normal = kind_ == MapKind::Normal;
    const Meaning meaning = is_normal ? Meaning::Direction : map_.srgb ? Meaning::SrgbLight : Meaning::Number;
    taken_as_stored_ =
        shape.type == PixelType::U8 && shape.channels != 2 && !(is_normal && shape.channels == 1);
    maybe_grey_ =
        finest_side_ > 0 && kind_ == MapKind::Data && shape.channels == 3 && shape.type == PixelType::U8;
    int planes = channels;
    if (is_normal || shape.channels == 3) planes = 3;
    if (maybe_grey_ || (shape.channels == 1 && !is_normal)) planes = 1;
    make_shapes(channels);
    chain_.emplace(map_.levels, meaning, planes);
}

void MapMaker::make_shapes(int channels) {
    for (int w = whole_.width, h = whole_.height;; w = std::max(w / 2, 1), h = std::max(h / 2, 1)) {
        map_.levels.push_back(is_too_fine(w, h, finest_side_) ? without_texels(w, h, channels, whole_.type)
                                                              : make_image(w, h, channels, whole_.type));
        if (w == 1 && h == 1) return;
    }
}

void MapMaker::row(const std::byte* row) {
    if (maybe_grey_ && !is_grey(row, whole_.width)) {
        maybe_grey_ = false;
        chain_->widen();
    }
    Image& finest = map_.levels.front();
    if (finest.empty() && taken_as_stored_) {
        chain_->push(row, whole_.channels);
    } else {
        std::memcpy(row_.bytes.data(), row, row_.bytes.size());
        const Image sampled = as_sampled(row_, kind_, encoded_);
        if (!finest.empty())
            std::memcpy(finest.bytes.data() + std::size_t(rows_) * sampled.bytes.size(), sampled.bytes.data(),
                        sampled.bytes.size());
        chain_->push(sampled.bytes.data(), sampled.channels);
    }
    ++rows_;
}

std::size_t MapMaker::bytes() const {
    std::size_t bytes = row_.bytes.size() + (chain_ ? chain_->bytes() : 0);
    for (const Image& level : map_.levels) bytes += level.bytes.size();
    return bytes;
}

bool MapMaker::is_whole() const { return !map_.levels.front().empty(); }

MapLevels MapMaker::take() {
    std::erase_if(map_.levels, [](const Image& level) { return level.empty(); });
    if (maybe_grey_)
        for (Image& level : map_.levels) level = first_channel(level);
    chain_.reset();
    return std::move(map_);
}

MapLevels make_map_levels(const Image& image, MapKind kind, ColorSpace color_space, int finest_side) {
    MapMaker maker(kind, color_space, finest_side);
    maker.begin(image);
    const std::size_t row = image.bytes.size() / std::size_t(image.height);
    for (std::size_t at = 0; at < image.bytes.size(); at += row) maker.row(image.bytes.data() + at);
    return maker.take();
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

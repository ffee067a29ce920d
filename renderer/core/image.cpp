#include "renderer/core/image.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace patina {
namespace {

std::size_t offset_of(const Image& image, int x, int y, int channel) {
    assert(x >= 0 && x < image.width && y >= 0 && y < image.height && channel >= 0 &&
           channel < image.channels);
    const std::size_t pixel = static_cast<std::size_t>(y) * image.width + x;
    return (pixel * image.channels + channel) * bytes_per_channel(image.type);
}

template <class T>
T read_as(const Image& image, std::size_t offset) {
    T value;
    std::memcpy(&value, image.bytes.data() + offset, sizeof value);
    return value;
}

template <class T>
void write_unsigned(Image& image, std::size_t offset, float value) {
    constexpr float highest = sizeof(T) == 1 ? 255.0f : 65535.0f;
    // A comparison with NaN is false, so that NaN becomes 0.
    const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
    const T stored = static_cast<T>(std::lround(clamped * highest));
    std::memcpy(image.bytes.data() + offset, &stored, sizeof stored);
}

}  // namespace

Image make_image(int width, int height, int channels, PixelType type) {
    assert(width >= 1 && height >= 1 && channels >= 1 && channels <= 4);
    Image image{.width = width, .height = height, .channels = channels, .type = type};
    image.bytes.resize(static_cast<std::size_t>(width) * height * channels * bytes_per_channel(type));
    return image;
}

float texel(const Image& image, int x, int y, int channel) {
    const std::size_t offset = offset_of(image, x, y, channel);
    switch (image.type) {
        case PixelType::U8:
            return static_cast<float>(read_as<std::uint8_t>(image, offset)) / 255.0f;
        case PixelType::U16:
            return static_cast<float>(read_as<std::uint16_t>(image, offset)) / 65535.0f;
        case PixelType::F32:
            break;
    }
    return read_as<float>(image, offset);
}

void set_texel(Image& image, int x, int y, int channel, float value) {
    const std::size_t offset = offset_of(image, x, y, channel);
    switch (image.type) {
        case PixelType::U8:
            write_unsigned<std::uint8_t>(image, offset, value);
            return;
        case PixelType::U16:
            write_unsigned<std::uint16_t>(image, offset, value);
            return;
        case PixelType::F32:
            break;
    }
    std::memcpy(image.bytes.data() + offset, &value, sizeof value);
}

Image oriented(Image image, int exif_orientation) {
    if (exif_orientation < 2 || exif_orientation > 8) return image;
    // 5…8 are stored by columns; the other bits say from which side rows and columns start.
    const bool transposed = exif_orientation >= 5;
    const bool mirrored =
        exif_orientation == 2 || exif_orientation == 3 || exif_orientation == 6 || exif_orientation == 7;
    const bool upside_down =
        exif_orientation == 3 || exif_orientation == 4 || exif_orientation == 7 || exif_orientation == 8;
    Image seen = make_image(transposed ? image.height : image.width, transposed ? image.width : image.height,
                            image.channels, image.type);
    const std::size_t size = image.channels * bytes_per_channel(image.type);
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x) {
            const int column = mirrored ? seen.width - 1 - x : x;
            const int row = upside_down ? seen.height - 1 - y : y;
            const std::size_t from =
                transposed ? offset_of(image, row, column, 0) : offset_of(image, column, row, 0);
            std::memcpy(seen.bytes.data() + offset_of(seen, x, y, 0), image.bytes.data() + from, size);
        }
    return seen;
}

Image placed(const Image& image, const Placement& placement) {
    Image canvas = make_image(placement.width, placement.height, image.channels, image.type);
    const int left = std::max(0, placement.x);
    const int right = std::min(placement.width, placement.x + image.width);
    const int bottom = std::min(placement.height, placement.y + image.height);
    if (left >= right) return canvas;
    const std::size_t size =
        static_cast<std::size_t>(right - left) * image.channels * bytes_per_channel(image.type);
    for (int y = std::max(0, placement.y); y < bottom; ++y)
        std::memcpy(canvas.bytes.data() + offset_of(canvas, left, y, 0),
                    image.bytes.data() + offset_of(image, left - placement.x, y - placement.y, 0), size);
    return canvas;
}

float srgb_to_linear(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float linear_to_srgb(float linear) {
    if (!(linear > 0.0f)) return 0.0f;
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

}  // namespace patina

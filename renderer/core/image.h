// A picture in memory: typed interleaved pixels, nothing else. Knows no file and no GPU.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace patina {

enum class PixelType : std::uint8_t { U8, U16, F32 };

inline constexpr std::size_t bytes_per_channel(PixelType type) {
    return type == PixelType::U8 ? 1 : type == PixelType::U16 ? 2 : 4;
}

/// width × height pixels of 1…4 interleaved channels, row 0 at the top, rows tightly packed.
/// Unsigned types mean value/max in 0…1; F32 is taken as it is. Values are as stored (no colour space is
/// applied).
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;
    PixelType type = PixelType::U8;
    std::vector<std::byte> bytes;

    bool empty() const { return bytes.empty(); }
};

/// A black image of that shape. Precondition: sizes ≥ 1, channels 1…4.
Image make_image(int width, int height, int channels, PixelType type);

/// One channel of one pixel as a float (unsigned types scaled to 0…1). Precondition: inside the image.
float texel(const Image& image, int x, int y, int channel);

/// Sets it; unsigned types round to nearest and clamp. Precondition: inside the image.
void set_texel(Image& image, int x, int y, int channel, float value);

/// The picture as it is to be seen, from one stored with EXIF orientation 1…8 (other numbers mean 1).
Image oriented(Image image, int exif_orientation);

/// A black width × height picture with image's upper left corner at (x, y); what lies outside is cut off.
/// Sizes ≥ 1.
struct Placement {
    int x = 0, y = 0, width = 1, height = 1;
};
Image placed(const Image& image, const Placement& placement);

/// IEC 61966-2-1 transfer functions, elementwise, exact piecewise form; encode clamps below 0 to 0.
float srgb_to_linear(float encoded);
float linear_to_srgb(float linear);

}  // namespace patina

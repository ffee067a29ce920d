// PNG's rarer kinds, written byte by byte.
#include "tests/unit/core/image_test_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

namespace patina {
namespace {

using test::big_endian;
using test::bytes_of;
using test::png_chunk;
using test::TempFolder;

/// zlib's stored block: any short text, not compressed.
std::string stored(const std::string& data) {
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char c : data) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<unsigned>(data.size());
    return std::string("\x78\x01\x01", 3) + static_cast<char>(size) + static_cast<char>(size >> 8) +
           static_cast<char>(~size) + static_cast<char>(~size >> 8) + data + big_endian(b << 16 | a);
}

struct Png {
    std::uint32_t width = 1, height = 1;
    char depth = 8, color = 0, interlaced = 0;
    std::string chunks;  ///< before the pixels
    std::string rows;    ///< each with its filter's number before it
};

std::string file_of(const Png& png) {
    return "\x89PNG\r\n\x1a\n" +
           png_chunk("IHDR", big_endian(png.width) + big_endian(png.height) +
                                 std::string{png.depth, png.color, 0, 0, png.interlaced}) +
           png.chunks + png_chunk("IDAT", stored(png.rows)) + png_chunk("IEND", "");
}

int byte_of(const Image& image, int x, int y, int channel) {
    return static_cast<int>(std::lround(texel(image, x, y, channel) * 255.0f));
}

Image loaded(const TempFolder& folder, const Png& png) {
    write_file(folder / "a.png", bytes_of(file_of(png)));
    return load_image(folder / "a.png").image;
}

TEST(Png, palettes_become_colours_and_their_transparency_alpha) {
    const TempFolder folder;
    const Png plain{.width = 2,
                    .color = 3,
                    .chunks = png_chunk("PLTE", std::string{10, 20, 30, 40, 50, 60}),
                    .rows = std::string{0, 1, 0}};
    const Image image = loaded(folder, plain);
    ASSERT_EQ(image.channels, 3);
    EXPECT_EQ(byte_of(image, 0, 0, 2), 60);
    EXPECT_EQ(byte_of(image, 1, 0, 0), 10);
    Png clear = plain;
    clear.chunks += png_chunk("tRNS", std::string{7});
    const Image with_alpha = loaded(folder, clear);
    ASSERT_EQ(with_alpha.channels, 4);
    EXPECT_EQ(byte_of(with_alpha, 1, 0, 3), 7);
    EXPECT_EQ(byte_of(with_alpha, 0, 0, 3), 255);
    EXPECT_EQ(load_image_info(folder / "a.png").channels, 4);
}

TEST(Png, one_bit_of_grey_is_black_or_white) {
    const TempFolder folder;
    const Image image = loaded(folder, {.width = 3, .depth = 1, .rows = std::string{0, '\x40'}});
    ASSERT_EQ(image.channels, 1);
    ASSERT_EQ(image.type, PixelType::U8);
    EXPECT_EQ(byte_of(image, 0, 0, 0), 0);
    EXPECT_EQ(byte_of(image, 1, 0, 0), 255);
}

TEST(Png, interlaced_rows_come_together) {
    const TempFolder folder;
    // Adam7 of 2 × 2: pass 1 has (0,0), pass 6 has (1,0), pass 7 has the second row.
    const Image image =
        loaded(folder, {.width = 2, .height = 2, .interlaced = 1, .rows = std::string{0, 1, 0, 2, 0, 3, 4}});
    for (int i = 0; i < 4; ++i) EXPECT_EQ(byte_of(image, i % 2, i / 2, 0), i + 1);
    std::string given;
    load_image_rows(folder / "a.png", {.begin = [](const Image&) {},
                                       .row =
                                           [&](const std::byte* row) {
                                               given += static_cast<char>(row[0]);
                                               given += static_cast<char>(row[1]);
                                           }});
    EXPECT_EQ(given, (std::string{1, 2, 3, 4}));
}

TEST(Png, sixteen_bits_keep_their_order) {
    const TempFolder folder;
    const Image image = loaded(folder, {.depth = 16, .rows = std::string{0, 1, 2}});
    ASSERT_EQ(image.type, PixelType::U16);
    EXPECT_NEAR(texel(image, 0, 0, 0), 258.0f / 65535.0f, 1e-7f);
}

TEST(Png, a_cameras_orientation_is_honoured) {
    const TempFolder folder;
    // TIFF, little-endian, one entry: Orientation (0x112), a short, 6: the first column is the top row.
    const std::string exif =
        std::string("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0", 26);
    const Image image =
        loaded(folder, {.width = 2, .chunks = png_chunk("eXIf", exif), .rows = std::string{0, 1, 2}});
    ASSERT_EQ(image.width, 1);
    ASSERT_EQ(image.height, 2);
    EXPECT_EQ(byte_of(image, 0, 0, 0), 1);
    EXPECT_EQ(byte_of(image, 0, 1, 0), 2);
}

TEST(Png, rows_that_end_too_early_are_an_error) {
    const TempFolder folder;
    write_file(folder / "a.png",
               bytes_of(file_of({.width = 2, .height = 2, .rows = std::string{0, 1, 2, 0}})));
    EXPECT_NE(test::load_error(folder / "a.png"), "");
}

}  // namespace
}  // namespace patina

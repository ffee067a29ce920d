#include "renderer/core/radiance_hdr.h"
#include "tests/unit/core/image_test_support.h"

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace patina {
namespace {

using test::bytes_of;
using test::contains;
using test::load_error;
using test::TempFolder;

std::string rgbe(glm::vec3 color) {
    int exponent = 0;
    const float most = std::max({color.x, color.y, color.z});
    if (most < 1e-32f) return std::string(4, '\0');
    const float scale = std::frexp(most, &exponent) * 256.0f / most;
    std::string pixel;
    for (int c = 0; c < 3; ++c) pixel += static_cast<char>(static_cast<int>(color[c] * scale));
    return pixel + static_cast<char>(exponent + 128);
}

/// Exactly representable, different at each place.
glm::vec3 color_at(int x, int y) {
    return {1.0f + static_cast<float>(x), 0.25f * static_cast<float>(1 + y), 0.5f};
}

std::string header(std::string_view resolution, std::string_view lines = "FORMAT=32-bit_rle_rgbe\n") {
    return "#?RADIANCE\n" + std::string(lines) + "\n" + std::string(resolution) + "\n";
}

LoadedImage load(const TempFolder& folder, const std::string& bytes) {
    write_file(folder / "picture.hdr", bytes_of(bytes));
    return load_image(folder / "picture.hdr");
}

void expect_colors(const Image& image) {
    ASSERT_EQ(image.width, 2);
    ASSERT_EQ(image.height, 3);
    ASSERT_EQ(image.type, PixelType::F32);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 2; ++x)
            for (int c = 0; c < 3; ++c) EXPECT_EQ(texel(image, x, y, c), color_at(x, y)[c]) << x << " " << y;
}

std::string upright_pixels() {
    std::string pixels;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 2; ++x) pixels += rgbe(color_at(x, y));
    return pixels;
}

TEST(RadianceHdr, reads_flat_pixels_exactly) {
    const TempFolder folder;
    const LoadedImage loaded = load(folder, header("-Y 3 +X 2") + upright_pixels());
    expect_colors(loaded.image);
    EXPECT_TRUE(loaded.notes.empty());
}

TEST(RadianceHdr, reads_all_eight_scan_orders) {
    const TempFolder folder;
    for (const bool columns_first : {false, true})
        for (const char y_sign : {'-', '+'})
            for (const char x_sign : {'-', '+'}) {
                const std::string x_axis = std::string(1, x_sign) + "X 2";
                const std::string y_axis = std::string(1, y_sign) + "Y 3";
                std::string pixels;
                for (int i = 0; i < 6; ++i) {
                    const int along_x = columns_first ? i / 3 : i % 2;
                    const int along_y = columns_first ? i % 3 : i / 2;
                    pixels += rgbe(color_at(x_sign == '+' ? along_x : 1 - along_x,
                                            y_sign == '-' ? along_y : 2 - along_y));
                }
                SCOPED_TRACE(x_axis + y_axis);
                expect_colors(
                    load(folder,
                         header(columns_first ? x_axis + " " + y_axis : y_axis + " " + x_axis) + pixels)
                        .image);
            }
}

TEST(RadianceHdr, undoes_every_exposure_and_says_so) {
    const TempFolder folder;
    const LoadedImage loaded =
        load(folder, header("-Y 1 +X 1", "EXPOSURE=2\nFORMAT=32-bit_rle_rgbe\nEXPOSURE = 4.0e+00\n") +
                         rgbe(glm::vec3(16.0f)));
    EXPECT_EQ(texel(loaded.image, 0, 0, 0), 2.0f);
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_TRUE(contains(loaded.notes[0], "EXPOSURE (8)"));
}

TEST(RadianceHdr, undoes_a_colour_correction) {
    const TempFolder folder;
    const LoadedImage loaded = load(folder, header("-Y 1 +X 1", "COLORCORR=2 1 4\n") + rgbe(glm::vec3(1.0f)));
    EXPECT_EQ(texel(loaded.image, 0, 0, 0), 0.5f);
    EXPECT_EQ(texel(loaded.image, 0, 0, 1), 1.0f);
    EXPECT_EQ(texel(loaded.image, 0, 0, 2), 0.25f);
}

TEST(RadianceHdr, passes_over_senseless_exposures) {
    const TempFolder folder;
    for (const std::string_view line :
         {"EXPOSURE=0\n", "EXPOSURE=-1\n", "EXPOSURE=nan\n", "EXPOSURE=\n", "EXPOSURE=inf\n"})
        EXPECT_EQ(texel(load(folder, header("-Y 1 +X 1", line) + rgbe(glm::vec3(1.0f))).image, 0, 0, 0), 1.0f)
            << line;
}

TEST(RadianceHdr, reads_headers_as_they_occur) {
    const TempFolder folder;
    const std::string pixels = upright_pixels();
    expect_colors(load(folder, "#?RGBE\n\n-Y 3 +X 2\n" + pixels).image);
    expect_colors(load(folder, "#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 3 +X 2\r\n" + pixels).image);
    expect_colors(
        load(folder, header("-Y 3 +X 2",
                            "# a comment = 1\nrpict -vta view.vf\nPRIMARIES=0 0 0 0 0 0 0 0\nGAMMA=1\n") +
                         pixels)
            .image);
    EXPECT_EQ(load(folder, header("-Y 3 +X 2", "GAMMA=2.2\n") + pixels).notes.size(), 1u);
    EXPECT_EQ(load(folder, header("-Y 3 +X 2", "PRIMARIES=.7 .3 .2 .7 .1 .1 .3 .3\n") + pixels).notes.size(),
              1u);
}

TEST(RadianceHdr, xyze_white_is_white) {
    const TempFolder folder;
    const LoadedImage loaded =
        load(folder, header("-Y 1 +X 1", "FORMAT=32-bit_rle_xyze\n") + rgbe({0.9505f, 1.0f, 1.089f}));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(texel(loaded.image, 0, 0, c), 1.0f, 0.02f);
}

TEST(RadianceHdr, unpacks_runs_and_literals_of_each_component) {
    const TempFolder folder;
    std::string line{2, 2, 0, 8};
    line += std::string{static_cast<char>(128 + 8), static_cast<char>(128)};  // red: a run of 8
    line += std::string{3, 10, 20, 30, static_cast<char>(128 + 5), 40};       // green: 3 literals, a run of 5
    line += std::string{8, 1, 2, 3, 4, 5, 6, 7, 8};                           // blue: literals
    line += std::string{static_cast<char>(128 + 8), static_cast<char>(136)};  // exponent: 2^0
    const Image image = load(folder, header("-Y 1 +X 8") + line).image;
    const std::array<int, 8> green{10, 20, 30, 40, 40, 40, 40, 40};
    for (int x = 0; x < 8; ++x) {
        EXPECT_EQ(texel(image, x, 0, 0), 128.0f);
        EXPECT_EQ(texel(image, x, 0, 1), static_cast<float>(green[x]));
        EXPECT_EQ(texel(image, x, 0, 2), static_cast<float>(x + 1));
    }
}

TEST(RadianceHdr, unpacks_the_older_runs) {
    const TempFolder folder;
    // 1 pixel, 3 repeats, another pixel, then 1 + 1·256 repeats.
    std::string pixels = rgbe(glm::vec3(4.0f)) + std::string{1, 1, 1, 3} + rgbe(glm::vec3(2.0f)) +
                         std::string{1, 1, 1, 1} + std::string{1, 1, 1, 1};
    const Image image = load(folder, header("-Y 1 +X 262") + pixels).image;
    EXPECT_EQ(texel(image, 3, 0, 0), 4.0f);
    EXPECT_EQ(texel(image, 4, 0, 0), 2.0f);
    EXPECT_EQ(texel(image, 261, 0, 0), 2.0f);
}

TEST(RadianceHdr, refuses_every_truncation) {
    const TempFolder folder;
    std::string whole = header("-Y 4 +X 9");
    const std::size_t header_size = whole.size();
    for (int y = 0; y < 4; ++y) {
        whole += std::string{2, 2, 0, 9};
        for (int c = 0; c < 4; ++c)
            whole += std::string{2, 10, 11, static_cast<char>(128 + 7), static_cast<char>(130)};
    }
    ASSERT_EQ(load(folder, whole).image.height, 4);
    for (std::size_t size = 2; size < whole.size(); ++size) {
        write_file(folder / "cut.hdr", bytes_of(whole.substr(0, size)));
        EXPECT_TRUE(contains(load_error(folder / "cut.hdr"), "cut short")) << size << " of " << header_size;
    }
}

TEST(RadianceHdr, refuses_damaged_pixels) {
    const TempFolder folder;
    const auto error_of = [&](const std::string& bytes) {
        write_file(folder / "bad.hdr", bytes_of(bytes));
        return load_error(folder / "bad.hdr");
    };
    const std::string nine = header("-Y 1 +X 9");
    EXPECT_TRUE(contains(error_of(nine + std::string{2, 2, 0, 8} + std::string(64, 1)), "damaged"))
        << "another width";
    EXPECT_TRUE(contains(error_of(nine + std::string{2, 2, 0, 9} + std::string(64, '\xFF')), "damaged"))
        << "a run too long";
    EXPECT_TRUE(contains(error_of(nine + std::string{2, 2, 0, 9} + std::string(64, '\0')), "damaged"))
        << "a run of nothing";
    EXPECT_TRUE(contains(error_of(header("-Y 1 +X 2") + std::string{1, 1, 1, 1}), "damaged"))
        << "a repeat of nothing";
}

TEST(RadianceHdr, refuses_sizes_that_make_no_sense_before_allocating) {
    const TempFolder folder;
    const auto error_of = [&](std::string_view resolution) {
        write_file(folder / "bad.hdr", bytes_of(header(resolution) + "12345678"));
        return load_error(folder / "bad.hdr");
    };
    EXPECT_TRUE(contains(error_of("-Y 1000000000 +X 1000000000"), "more than 16384×16384"));
    EXPECT_TRUE(contains(error_of("-Y 4294967299 +X 2"), "more than 16384×16384"));
    EXPECT_TRUE(contains(error_of("-Y 16384 +X 16384"), "cut short"));
    for (const std::string_view text :
         {"-Y 0 +X 2", "-Y -3 +X 2", "-Y 3 -Y 3", "3 2", "", "-Y 3 +X 2 7", "-Y 99999999999999999999 +X 1"})
        EXPECT_TRUE(contains(error_of(text), "no size")) << text;
}

TEST(RadianceHdr, refuses_other_pixel_kinds_by_name) {
    const TempFolder folder;
    write_file(folder / "bad.hdr", bytes_of(header("-Y 1 +X 1", "FORMAT=spectral\n") + "1234"));
    EXPECT_TRUE(contains(load_error(folder / "bad.hdr"), "\"spectral\""));
}

}  // namespace
}  // namespace patina

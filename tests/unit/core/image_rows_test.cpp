// Pictures read row by row: the same as those read at once, whatever the format, and never whole in memory
// where that can be.
#include "tests/unit/core/image_test_support.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>

namespace patina {
namespace {

namespace fs = std::filesystem;
using test::Bytes;
using test::expect_equal;
using test::gradient;
using test::load_error;
using test::TempFolder;

/// What rows amount to: a picture, or why there is none.
struct Read {
    Image image;
    std::vector<std::string> notes;
    std::string error;
    int begun = 0;
    std::size_t rows = 0;
};

Read read_rows(const fs::path& file) {
    Read read;
    const ImageRows rows{.begin =
                             [&](const Image& shape) {
                                 ++read.begun;
                                 EXPECT_TRUE(shape.bytes.empty());
                                 read.image =
                                     make_image(shape.width, shape.height, shape.channels, shape.type);
                             },
                         .row =
                             [&](const std::byte* row) {
                                 const std::size_t size = read.image.bytes.size() / read.image.height;
                                 ASSERT_LT(read.rows, std::size_t(read.image.height));
                                 std::memcpy(read.image.bytes.data() + read.rows++ * size, row, size);
                             }};
    try {
        read.notes = load_image_rows(file, rows);
    } catch (const std::runtime_error& error) {
        read.error = error.what();
    }
    return read;
}

void expect_same(const fs::path& file) {
    const LoadedImage whole = load_image(file);
    const Read read = read_rows(file);
    EXPECT_EQ(read.error, "");
    EXPECT_EQ(read.begun, 1);
    EXPECT_EQ(read.rows, std::size_t(whole.image.height));
    EXPECT_EQ(read.notes, whole.notes);
    expect_equal(read.image, whole.image);
}

struct Kind {
    const char* extension;
    OIIO::TypeDesc type;
    int channels = 3;
    int orientation = 1;
};

void write(const fs::path& file, const Kind& kind, const Image& image) {
    OIIO::ImageSpec spec(image.width, image.height, kind.channels, kind.type);
    spec["oiio:UnassociatedAlpha"] = 1;
    if (kind.orientation != 1) spec["Orientation"] = kind.orientation;
    const auto output = OIIO::ImageOutput::create(path_text(file));
    ASSERT_TRUE(output && output->open(path_text(file), spec)) << OIIO::geterror();
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, image.bytes.data())) << output->geterror();
    ASSERT_TRUE(output->close());
}

std::vector<Kind> kinds() {
    std::vector<Kind> all{{".hdr", OIIO::TypeDesc::FLOAT},    {".exr", OIIO::TypeDesc::HALF},
                          {".exr", OIIO::TypeDesc::FLOAT, 1}, {".exr", OIIO::TypeDesc::FLOAT, 6},
                          {".bmp", OIIO::TypeDesc::UINT8},    {".tga", OIIO::TypeDesc::UINT8, 4},
                          {".tif", OIIO::TypeDesc::FLOAT, 2}};
    for (const OIIO::TypeDesc type : {OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16})
        for (int channels = 1; channels <= 4; ++channels) {
            all.push_back({".png", type, channels});
            all.push_back({".tif", type, channels});
        }
    for (int orientation = 1; orientation <= 8; ++orientation)
        for (const int channels : {1, 3}) {
            all.push_back({".jpg", OIIO::TypeDesc::UINT8, channels, orientation});
            all.push_back({".tif", OIIO::TypeDesc::UINT8, channels, orientation});
            all.push_back({".png", OIIO::TypeDesc::UINT8, channels, orientation});
        }
    return all;
}

TEST(ImageRows, are_the_picture_in_every_format_depth_and_orientation) {
    const TempFolder folder;
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(std::string(kind.extension) + " of " + std::to_string(kind.channels) +
                     " channels, orientation " + std::to_string(kind.orientation));
        const fs::path file = folder / (std::string("a") + kind.extension);
        write(file, kind, gradient(57, 43, kind.channels, PixelType::F32));
        expect_same(file);
    }
}

TEST(ImageRows, of_a_turned_jpeg_are_seen_upright) {
    const TempFolder folder;
    Image dark_above = make_image(16, 32, 1, PixelType::F32);  // as stored: its lower half is white
    for (int y = 16; y < 32; ++y)
        for (int x = 0; x < 16; ++x) set_texel(dark_above, x, y, 0, 1.0f);
    // 6: the first column is the top row, so that the stored lower half is seen on the left.
    write(folder / "a.jpg", {".jpg", OIIO::TypeDesc::UINT8, 1, 6}, dark_above);
    const Read read = read_rows(folder / "a.jpg");
    ASSERT_EQ(read.image.width, 32);
    EXPECT_GT(texel(read.image, 2, 8, 0), 0.9f);
    EXPECT_LT(texel(read.image, 29, 8, 0), 0.1f);
}

TEST(ImageRows, of_a_picture_under_a_wrong_name_come_with_the_same_note) {
    const TempFolder folder;
    save_image(folder / "a.png", gradient(5, 4, 3, PixelType::U8));
    fs::rename(folder / "a.png", folder / "a.jpg");
    expect_same(folder / "a.jpg");
    EXPECT_EQ(read_rows(folder / "a.jpg").notes.size(), 1u);
}

/// Damage is told in the same sentence; whatever is given before is no more than the picture.
TEST(ImageRows, of_a_damaged_file_end_in_the_error_that_the_whole_picture_has) {
    const TempFolder folder;
    const std::vector<Kind> damaged{
        {".png", OIIO::TypeDesc::UINT8},       {".png", OIIO::TypeDesc::UINT16, 4},
        {".jpg", OIIO::TypeDesc::UINT8},       {".jpg", OIIO::TypeDesc::UINT8, 1},
        {".jpg", OIIO::TypeDesc::UINT8, 3, 6}, {".exr", OIIO::TypeDesc::HALF},
        {".tif", OIIO::TypeDesc::UINT8}};
    int errors = 0;
    for (const Kind& kind : damaged) {
        const fs::path file = folder / (std::string("a") + kind.extension);
        write(file, kind, gradient(57, 43, kind.channels, PixelType::F32));
        const Bytes whole = read_file(file);
        const auto check = [&](const Bytes& bytes, const std::string& what) {
            write_file(file, bytes);
            const std::string error = load_error(file);
            const Read read = read_rows(file);
            EXPECT_EQ(read.error, error.empty() ? "" : path_text(file) + ": " + error) << what;
            if (error.empty()) expect_same(file);
            errors += error.empty() ? 0 : 1;
        };
        for (const double share : {0.0, 0.02, 0.2, 0.5, 0.8, 0.95, 0.99})
            check(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(share * double(whole.size()))),
                  kind.extension + std::to_string(share));
        for (std::size_t i = 0; i < 60; ++i) {
            Bytes turned = whole;
            turned[(i * 7919 + 40) % turned.size()] ^= std::byte(1u << i % 8);
            check(turned, kind.extension + std::to_string(i));
        }
    }
    EXPECT_GT(errors, 49);
}

TEST(ImageRows, of_a_picture_in_memory_are_its_rows) {
    const Image image = gradient(7, 5, 2, PixelType::U16);
    Image given;
    std::size_t rows = 0;
    give_rows(image, {.begin = [&](const Image& shape) { given = make_image(7, 5, 2, shape.type); },
                      .row =
                          [&](const std::byte* row) {
                              std::memcpy(given.bytes.data() + 28 * rows, row, 28);
                              ++rows;
                          }});
    EXPECT_EQ(rows, 5u);
    expect_equal(given, image);
}

}  // namespace
}  // namespace patina

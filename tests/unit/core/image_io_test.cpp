#include "renderer/core/image_io.h"

#include "tests/unit/core/image_test_support.h"

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

namespace patina {
namespace {

namespace fs = std::filesystem;
using test::Bytes;
using test::bytes_of;
using test::contains;
using test::expect_equal;
using test::gradient;
using test::load_error;
using test::TempFolder;

/// What a foreign program would have written: any format, channel type and attributes.
struct Foreign {
    OIIO::TypeDesc type = OIIO::TypeDesc::UINT8;
    std::function<void(OIIO::ImageSpec&)> change = [](OIIO::ImageSpec&) {};
};

void write_foreign(const fs::path& file, const Image& image, const Foreign& foreign = {}) {
    OIIO::ImageSpec spec(image.width, image.height, image.channels, foreign.type);
    spec["oiio:UnassociatedAlpha"] = 1;
    foreign.change(spec);
    const auto output = OIIO::ImageOutput::create(path_text(file));
    ASSERT_TRUE(output) << OIIO::geterror();
    ASSERT_TRUE(output->open(path_text(file), spec)) << output->geterror();
    const OIIO::TypeDesc in_memory = image.type == PixelType::U8    ? OIIO::TypeDesc::UINT8
                                     : image.type == PixelType::U16 ? OIIO::TypeDesc::UINT16
                                                                    : OIIO::TypeDesc::FLOAT;
    ASSERT_TRUE(output->write_image(in_memory, image.bytes.data())) << output->geterror();
    ASSERT_TRUE(output->close());
}

// --- saving and loading again ---

TEST(ImageIo, png_keeps_every_bit_of_8_and_16_bit_pictures_of_1_to_4_channels) {
    const TempFolder folder;
    for (const PixelType type : {PixelType::U8, PixelType::U16})
        for (int channels = 1; channels <= 4; ++channels) {
            const Image image = gradient(19, 13, channels, type);
            save_image(folder / "a.png", image);
            expect_equal(load_image(folder / "a.png").image, image);
            const ImageInfo info = load_image_info(folder / "a.png");
            EXPECT_EQ(info.channels, channels);
            EXPECT_EQ(info.type, type);
            EXPECT_EQ(info.format, "png");
        }
}

TEST(ImageIo, exr_keeps_every_float_exactly_even_extreme_ones) {
    const TempFolder folder;
    for (int channels = 1; channels <= 4; ++channels) {
        Image image = gradient(19, 13, channels, PixelType::F32);
        set_texel(image, 0, 0, 0, 3e38f);
        set_texel(image, 1, 0, 0, -1e-38f);
        set_texel(image, 2, 0, 0, 1.0f / 3.0f);
        set_texel(image, 3, 0, 0, std::numeric_limits<float>::infinity());
        set_texel(image, 4, 0, 0, std::numeric_limits<float>::quiet_NaN());
        save_image(folder / "a.exr", image);
        const LoadedImage loaded = load_image(folder / "a.exr");
        expect_equal(loaded.image, image);
        EXPECT_TRUE(loaded.notes.empty());
    }
}

TEST(ImageIo, one_pixel_is_a_picture) {
    const TempFolder folder;
    save_image(folder / "a.png", gradient(1, 1, 3, PixelType::U8));
    save_image(folder / "a.exr", gradient(1, 1, 1, PixelType::F32));
    EXPECT_EQ(load_image(folder / "a.png").image.width, 1);
    EXPECT_EQ(load_image(folder / "a.exr").image.height, 1);
}

TEST(ImageIo, metadata_comes_back_in_words) {
    const TempFolder folder;
    const ImageMetadata metadata{{"patina:preset", "{\n  \"name\": \"Gr\xC3\xBCn\"\n}"},
                                 {"patina:environment", "studio"}};
    save_image(folder / "a.png", gradient(4, 4, 3, PixelType::U8), metadata);
    save_image(folder / "a.exr", gradient(4, 4, 3, PixelType::F32), metadata);
    for (const char* name : {"a.png", "a.exr"}) {
        const ImageMetadata loaded = load_image_metadata(folder / name);
        for (const auto& row : metadata)
            EXPECT_NE(std::find(loaded.begin(), loaded.end(), row), loaded.end()) << name << row.first;
    }
}

TEST(ImageIo, same_picture_gives_the_same_bytes_without_date_or_time) {
    const TempFolder folder;
    for (const auto& [name, type] : {std::pair("a.png", PixelType::U8), std::pair("a.exr", PixelType::F32)}) {
        save_image(folder / name, gradient(33, 17, 3, type), {{"a", "b"}});
        const Bytes first = read_file(folder / name);
        const std::string_view text(reinterpret_cast<const char*>(first.data()), first.size());
        EXPECT_FALSE(contains(text, "tIME"));
        EXPECT_FALSE(contains(text, ":" + std::to_string(2026) + ":"));
        EXPECT_FALSE(contains(text, "OpenImageIO"));
        for (const auto& [key, value] : load_image_metadata(folder / name))
            EXPECT_FALSE(key == "DateTime" && !value.empty());
        save_image(folder / name, gradient(33, 17, 3, type), {{"a", "b"}});
        EXPECT_TRUE(read_file(folder / name) == first);
    }
}

// --- formats of the world ---

struct Case {
    const char* name;
    OIIO::TypeDesc type;
    PixelType expected;
    float tolerance;
};
const std::array kLossless{
    Case{"a.tif", OIIO::TypeDesc::UINT8, PixelType::U8, 0.0f},
    Case{"a.tif", OIIO::TypeDesc::UINT16, PixelType::U16, 0.0f},
    Case{"a.tif", OIIO::TypeDesc::HALF, PixelType::F32, 0.001f},
    Case{"a.tif", OIIO::TypeDesc::FLOAT, PixelType::F32, 0.0f},
    Case{"a.tif", OIIO::TypeDesc::DOUBLE, PixelType::F32, 1e-6f},
    Case{"a.tga", OIIO::TypeDesc::UINT8, PixelType::U8, 0.0f},
    Case{"a.png", OIIO::TypeDesc::UINT16, PixelType::U16, 0.0f},
    Case{"a.exr", OIIO::TypeDesc::HALF, PixelType::F32, 0.001f},
    Case{"a.exr", OIIO::TypeDesc::FLOAT, PixelType::F32, 0.0f},
};

TEST(ImageIo, reads_tiff_tga_png_exr_of_every_depth_and_channel_count) {
    const TempFolder folder;
    for (const Case& row : kLossless)
        for (const int channels : {1, 3, 4}) {
            SCOPED_TRACE(std::string(row.name) + " " + row.type.c_str() + " " + std::to_string(channels));
            const Image image = gradient(21, 10, channels, row.expected);
            write_foreign(folder / row.name, image, {.type = row.type});
            const Image loaded = load_image(folder / row.name).image;
            ASSERT_EQ(loaded.type, row.expected);
            ASSERT_EQ(loaded.channels, channels);
            for (int y = 0; y < 10; ++y)
                for (int x = 0; x < 21; ++x)
                    for (int c = 0; c < channels; ++c)
                        ASSERT_NEAR(texel(loaded, x, y, c), texel(image, x, y, c), row.tolerance * 50.0f);
        }
}

TEST(ImageIo, half_and_float_exr_of_values_a_half_can_hold_are_equal) {
    const TempFolder folder;
    Image image = make_image(64, 4, 3, PixelType::F32);
    for (int x = 0; x < 64; ++x)
        for (int c = 0; c < 3; ++c)
            set_texel(image, x, c, c, std::ldexp(1.0f + static_cast<float>(c) / 4.0f, x / 3 - 10));
    write_foreign(folder / "half.exr", image, {.type = OIIO::TypeDesc::HALF});
    write_foreign(folder / "float.exr", image, {.type = OIIO::TypeDesc::FLOAT});
    expect_equal(load_image(folder / "half.exr").image, load_image(folder / "float.exr").image);
    expect_equal(load_image(folder / "half.exr").image, image);
}

TEST(ImageIo, reads_every_exr_compression) {
    const TempFolder folder;
    const Image image = gradient(64, 48, 3, PixelType::F32);
    for (const char* compression :
         {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"}) {
        write_foreign(folder / "a.exr", image,
                      {.type = OIIO::TypeDesc::HALF,
                       .change = [&](OIIO::ImageSpec& spec) { spec["compression"] = compression; }});
        const LoadedImage loaded = load_image(folder / "a.exr");
        EXPECT_EQ(loaded.image.width, 64) << compression;
        EXPECT_TRUE(loaded.notes.empty()) << compression;
        const bool lossy = contains(compression, "b44") || contains(compression, "dwa");
        EXPECT_NEAR(texel(loaded.image, 5, 7, 1), texel(image, 5, 7, 1), lossy ? 5.0f : 0.03f) << compression;
    }
}

TEST(ImageIo, jpeg_is_close_and_grey_stays_grey) {
    const TempFolder folder;
    Image image = make_image(32, 32, 3, PixelType::U8);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 3; ++c)
                set_texel(image, x, y, c, static_cast<float>(x + y + 20 * c) / 110.0f);
    write_foreign(folder / "a.jpg", image);
    const Image loaded = load_image(folder / "a.jpg").image;
    for (int i = 0; i < 32; ++i) EXPECT_NEAR(texel(loaded, i, 31 - i, 1), texel(image, i, 31 - i, 1), 0.03f);
    write_foreign(folder / "grey.jpg", gradient(16, 16, 1, PixelType::U8));
    EXPECT_EQ(load_image(folder / "grey.jpg").image.channels, 1);
}

/// A picture of three rows and two columns whose texels name where they belong once it is seen upright.
TEST(ImageIo, honours_all_eight_camera_orientations) {
    const TempFolder folder;
    const Image upright = gradient(2, 3, 3, PixelType::U8);
    for (int orientation = 1; orientation <= 8; ++orientation) {
        const bool transposed = orientation >= 5;
        Image stored = make_image(transposed ? 3 : 2, transposed ? 2 : 3, 3, PixelType::U8);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 2; ++x) {
                // From the EXIF standard: which visual side the stored row 0 and column 0 are.
                const std::array<std::array<int, 2>, 8> at{{{x, y},
                                                            {1 - x, y},
                                                            {1 - x, 2 - y},
                                                            {x, 2 - y},
                                                            {y, x},
                                                            {y, 1 - x},
                                                            {2 - y, 1 - x},
                                                            {2 - y, x}}};
                const auto [column, row] = at[orientation - 1];
                for (int c = 0; c < 3; ++c) set_texel(stored, column, row, c, texel(upright, x, y, c));
            }
        write_foreign(folder / "a.tif", stored,
                      {.change = [&](OIIO::ImageSpec& spec) { spec["Orientation"] = orientation; }});
        SCOPED_TRACE(orientation);
        expect_equal(load_image(folder / "a.tif").image, upright);
        EXPECT_EQ(load_image_info(folder / "a.tif").width, 2);
        EXPECT_EQ(load_image_info(folder / "a.tif").height, 3);
    }
}

TEST(ImageIo, tga_of_every_origin_is_seen_upright) {
    const TempFolder folder;
    for (const int origin : {0x00, 0x10, 0x20, 0x30}) {
        std::string file{0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 2, 0, 24, static_cast<char>(origin)};
        for (int row = 0; row < 2; ++row)
            for (int column = 0; column < 3; ++column) {
                const int y = (origin & 0x20) != 0 ? row : 1 - row;
                const int x = (origin & 0x10) == 0 ? column : 2 - column;
                file += std::string{0, 0, static_cast<char>(10 * (y * 3 + x))};
            }
        write_file(folder / "a.tga", bytes_of(file));
        const Image image = load_image(folder / "a.tga").image;
        for (int i = 0; i < 6; ++i)
            EXPECT_EQ(std::lround(texel(image, i % 3, i / 3, 0) * 255.0f), 10 * i) << origin;
    }
}

TEST(ImageIo, palette_bmp_is_expanded) {
    const TempFolder folder;
    // 14-byte header, 40-byte header, 2 palette entries, one row of 2 pixels of 8 bits padded to 4.
    std::string file = "BM" + std::string{66, 0, 0, 0, 0, 0, 0, 0, 62, 0, 0, 0};
    file += std::string{40, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 1, 0, 8, 0} + std::string(4, '\0') +
            std::string{4, 0, 0, 0} + std::string(8, '\0') + std::string{2, 0, 0, 0} + std::string(4, '\0');
    file += std::string{0, 0, '\xFF', 0} + std::string{0, '\xFF', 0, 0};  // red, green
    file += std::string{1, 0, 0, 0};
    write_file(folder / "a.bmp", bytes_of(file));
    const Image image = load_image(folder / "a.bmp").image;
    ASSERT_EQ(image.channels, 3);
    EXPECT_EQ(texel(image, 0, 0, 1), 1.0f) << "first pixel is green";
    EXPECT_EQ(texel(image, 1, 0, 0), 1.0f) << "second pixel is red";
}

TEST(ImageIo, alpha_is_not_multiplied_in) {
    const TempFolder folder;
    Image image = make_image(2, 1, 4, PixelType::U8);
    for (int c = 0; c < 3; ++c) set_texel(image, 0, 0, c, 0.8f);
    for (const char* name : {"a.png", "a.tga", "a.tif"}) {
        write_foreign(folder / name, image);
        EXPECT_NEAR(texel(load_image(folder / name).image, 0, 0, 0), 0.8f, 1e-6f) << name;
    }
}

// --- EXR's riches ---

TEST(ImageIo, of_many_exr_channels_red_green_blue_alpha_are_read_by_name) {
    const TempFolder folder;
    const Image image = gradient(5, 4, 6, PixelType::F32);
    ASSERT_EQ(image.channels, 6);
    write_foreign(folder / "a.exr", image,
                  {.type = OIIO::TypeDesc::FLOAT, .change = [](OIIO::ImageSpec& spec) {
                       spec.channelnames = {"Z", "B", "G", "R", "mask", "A"};
                   }});
    const LoadedImage loaded = load_image(folder / "a.exr");
    ASSERT_EQ(loaded.image.channels, 4);
    EXPECT_EQ(texel(loaded.image, 2, 3, 0), texel(image, 2, 3, 3));
    EXPECT_EQ(texel(loaded.image, 2, 3, 1), texel(image, 2, 3, 2));
    EXPECT_EQ(texel(loaded.image, 2, 3, 2), texel(image, 2, 3, 1));
    EXPECT_EQ(texel(loaded.image, 2, 3, 3), texel(image, 2, 3, 5));
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_TRUE(contains(loaded.notes[0], "of 6 channels these were read: R, G, B, A"));
    EXPECT_EQ(load_image_info(folder / "a.exr").channels, 4);
}

TEST(ImageIo, channels_of_a_layer_keep_the_order_of_colours) {
    const TempFolder folder;
    const Image image = gradient(5, 4, 3, PixelType::F32);
    write_foreign(folder / "a.exr", image,
                  {.type = OIIO::TypeDesc::FLOAT, .change = [](OIIO::ImageSpec& spec) {
                       spec.channelnames = {"light.R", "light.G", "light.B"};
                   }});
    expect_equal(load_image(folder / "a.exr").image, image);
}

TEST(ImageIo, luminance_exr_is_grey) {
    const TempFolder folder;
    write_foreign(folder / "a.exr", gradient(5, 4, 2, PixelType::F32),
                  {.type = OIIO::TypeDesc::FLOAT, .change = [](OIIO::ImageSpec& spec) {
                       spec.channelnames = {"Y", "Z"};
                   }});
    EXPECT_EQ(load_image(folder / "a.exr").image.channels, 1);
}

TEST(ImageIo, more_than_four_nameless_channels_keep_the_first_four) {
    const TempFolder folder;
    const Image image = gradient(5, 4, 5, PixelType::U8);
    write_foreign(folder / "a.tif", image, {.change = [](OIIO::ImageSpec& spec) {
                      spec.channelnames = {"c0", "c1", "c2", "c3", "c4"};
                  }});
    const LoadedImage loaded = load_image(folder / "a.tif");
    ASSERT_EQ(loaded.image.channels, 4);
    EXPECT_EQ(texel(loaded.image, 4, 3, 3), texel(image, 4, 3, 3));
    EXPECT_EQ(loaded.notes.size(), 1u);
}

TEST(ImageIo, data_window_is_placed_in_the_display_window) {
    const TempFolder folder;
    const Image image = gradient(4, 3, 3, PixelType::F32);
    const auto window = [](int x, int y, int width, int height) {
        return [=](OIIO::ImageSpec& spec) {
            spec.x = 2, spec.y = 1;
            spec.full_x = x, spec.full_y = y, spec.full_width = width, spec.full_height = height;
        };
    };
    write_foreign(folder / "inside.exr", image,
                  {.type = OIIO::TypeDesc::FLOAT, .change = window(0, 0, 8, 6)});
    const LoadedImage inside = load_image(folder / "inside.exr");
    ASSERT_EQ(inside.image.width, 8);
    ASSERT_EQ(inside.image.height, 6);
    EXPECT_EQ(texel(inside.image, 1, 1, 0), 0.0f);
    EXPECT_EQ(texel(inside.image, 5, 3, 2), texel(image, 3, 2, 2));
    EXPECT_EQ(inside.notes.size(), 1u);
    EXPECT_EQ(load_image_info(folder / "inside.exr").width, 8);
    write_foreign(folder / "beyond.exr", image,
                  {.type = OIIO::TypeDesc::FLOAT, .change = window(3, 2, 2, 9)});
    const LoadedImage beyond = load_image(folder / "beyond.exr");
    ASSERT_EQ(beyond.image.width, 2);
    EXPECT_EQ(texel(beyond.image, 0, 0, 1), texel(image, 1, 1, 1));
    EXPECT_EQ(texel(beyond.image, 1, 8, 1), 0.0f);
}

TEST(ImageIo, of_several_parts_the_first_with_colours_is_read) {
    const TempFolder folder;
    const std::string name = path_text(folder / "a.exr");
    const Image depth = gradient(6, 5, 1, PixelType::F32);
    const Image beauty = gradient(6, 5, 3, PixelType::F32);
    std::array<OIIO::ImageSpec, 2> specs{OIIO::ImageSpec(6, 5, 1, OIIO::TypeDesc::FLOAT),
                                         OIIO::ImageSpec(6, 5, 3, OIIO::TypeDesc::FLOAT)};
    specs[0].channelnames = {"depth"};
    specs[0]["oiio:subimagename"] = "depth";
    specs[1]["oiio:subimagename"] = "beauty";
    const auto output = OIIO::ImageOutput::create(name);
    ASSERT_TRUE(output->open(name, 2, specs.data())) << output->geterror();
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, depth.bytes.data()));
    ASSERT_TRUE(output->open(name, specs[1], OIIO::ImageOutput::AppendSubimage));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, beauty.bytes.data()));
    ASSERT_TRUE(output->close());
    const LoadedImage loaded = load_image(folder / "a.exr");
    expect_equal(loaded.image, beauty);
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_TRUE(contains(loaded.notes[0], "beauty"));
}

TEST(ImageIo, tiled_pictures_read_like_others) {
    const TempFolder folder;
    const Image image = gradient(40, 24, 3, PixelType::F32);
    for (const char* name : {"a.exr", "a.tif"}) {
        write_foreign(folder / name, image,
                      {.type = OIIO::TypeDesc::FLOAT, .change = [](OIIO::ImageSpec& spec) {
                           spec.tile_width = 16;
                           spec.tile_height = 16;
                       }});
        expect_equal(load_image(folder / name).image, image);
    }
}

TEST(ImageIo, deep_data_is_refused_by_name) {
    const TempFolder folder;
    const std::string name = path_text(folder / "a.exr");
    OIIO::ImageSpec spec(2, 2, 5, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"R", "G", "B", "A", "Z"};
    spec.deep = true;
    OIIO::DeepData deep(spec);
    for (int i = 0; i < 4; ++i) deep.set_samples(i, 1);
    const auto output = OIIO::ImageOutput::create(name);
    ASSERT_TRUE(output->open(name, spec));
    ASSERT_TRUE(output->write_deep_image(deep));
    ASSERT_TRUE(output->close());
    EXPECT_TRUE(contains(load_error(folder / "a.exr"), "deep data"));
}

}  // namespace
}  // namespace patina

// Pictures that are not what they promise.
#include "renderer/core/image_format.h"
#include "tests/unit/core/image_test_support.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace patina {
namespace {

namespace fs = std::filesystem;
using test::big_endian;
using test::Bytes;
using test::bytes_of;
using test::contains;
using test::gradient;
using test::load_error;
using test::png_chunk;
using test::TempFolder;

struct Kind {
    const char* extension;
    OIIO::TypeDesc type;
    const char* compression;
};
const std::vector<Kind> kKinds{
    {".png", OIIO::TypeDesc::UINT8, ""},     {".png", OIIO::TypeDesc::UINT16, ""},
    {".jpg", OIIO::TypeDesc::UINT8, ""},     {".tif", OIIO::TypeDesc::UINT8, "zip"},
    {".tif", OIIO::TypeDesc::FLOAT, "zip"},  {".tif", OIIO::TypeDesc::UINT16, "lzw"},
    {".tif", OIIO::TypeDesc::UINT8, "none"}, {".tga", OIIO::TypeDesc::UINT8, "none"},
    {".tga", OIIO::TypeDesc::UINT8, "rle"},  {".bmp", OIIO::TypeDesc::UINT8, ""},
    {".hdr", OIIO::TypeDesc::FLOAT, ""},     {".exr", OIIO::TypeDesc::HALF, "zip"},
    {".exr", OIIO::TypeDesc::HALF, "piz"},   {".exr", OIIO::TypeDesc::FLOAT, "none"},
    {".exr", OIIO::TypeDesc::HALF, "dwaa"},
};

/// A whole file of that kind, without what a TGA appends after its pixels.
Bytes whole_file(const TempFolder& folder, const Kind& kind) {
    const fs::path file = folder / (std::string("whole") + kind.extension);
    const Image image = gradient(57, 43, 3, PixelType::F32);
    OIIO::ImageSpec spec(image.width, image.height, 3, kind.type);
    if (*kind.compression != '\0') spec["compression"] = kind.compression;
    const auto output = OIIO::ImageOutput::create(path_text(file));
    EXPECT_TRUE(output->open(path_text(file), spec));
    EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, image.bytes.data()));
    EXPECT_TRUE(output->close());
    Bytes bytes = read_file(file);
    if (std::string_view(kind.extension) == ".tga") {
        constexpr std::size_t footer_size = 26;  // begins with the offset of the extension area
        std::uint32_t extension_area = 0;
        std::memcpy(&extension_area, bytes.data() + bytes.size() - footer_size, sizeof extension_area);
        EXPECT_LT(extension_area, bytes.size());
        bytes.resize(extension_area);
    }
    return bytes;
}

TEST(BrokenImage, every_truncation_is_an_error_and_never_half_a_picture) {
    const TempFolder folder;
    for (const Kind& kind : kKinds) {
        const Bytes whole = whole_file(folder, kind);
        const fs::path cut = folder / (std::string("cut") + kind.extension);
        for (const double share : {0.02, 0.2, 0.5, 0.8, 0.95, 0.99}) {
            const auto size = static_cast<std::ptrdiff_t>(share * static_cast<double>(whole.size()));
            write_file(cut, Bytes(whole.begin(), whole.begin() + size));
            const std::string error = load_error(cut);
            EXPECT_TRUE(contains(error, "copy or export it again") || contains(error, "convert it"))
                << kind.extension << " " << kind.compression << " " << share << ": " << error;
        }
        write_file(cut, Bytes(whole.begin(), whole.end() - 1));
        EXPECT_NE(load_error(cut), "") << kind.extension << " " << kind.compression << " less one byte";
    }
}

TEST(BrokenImage, changed_bytes_never_crash) {
    const TempFolder folder;
    std::mt19937 random(7);  // NOLINT: the same damage every time
    for (const Kind& kind : kKinds) {
        const Bytes whole = whole_file(folder, kind);
        const fs::path file = folder / (std::string("changed") + kind.extension);
        for (int round = 0; round < 25; ++round) {
            Bytes bytes = whole;
            for (int i = 0; i < 1 + round / 4; ++i)
                bytes[random() % (round % 2 == 0 ? bytes.size() : 200)] = static_cast<std::byte>(random());
            write_file(file, bytes);
            load_error(file);
        }
    }
}

TEST(BrokenImage, missing_empty_folder_and_garbage_each_get_their_sentence) {
    const TempFolder folder;
    EXPECT_TRUE(contains(load_error(folder / "missing.png"), "no such file"));
    EXPECT_TRUE(contains(load_error(folder.path()), "is a folder"));
    write_file(folder / "empty.exr", {});
    EXPECT_TRUE(contains(load_error(folder / "empty.exr"), "is empty"));
    write_file(folder / "text.png", bytes_of("Once upon a time there was a picture, but this is not it."));
    EXPECT_TRUE(contains(load_error(folder / "text.png"), "is not a PNG"));
    write_file(folder / "picture.gif", bytes_of("GIF89a\1\0\1\0\0\0\0;"));
    EXPECT_TRUE(contains(load_error(folder / "picture.gif"), "convert it"));
    for (const char* name : {"missing.png", "text.png", "empty.exr"}) {
        EXPECT_THROW(load_image_info(folder / name), std::runtime_error);
        EXPECT_THROW(load_image_metadata(folder / name), std::runtime_error);
    }
}

TEST(BrokenImage, unreadable_file_is_said_to_be_so) {
    const TempFolder folder;
    write_file(folder / "a.png", bytes_of("x"));
    fs::permissions(folder / "a.png", fs::perms::none);
    const std::string error = load_error(folder / "a.png");
    if (contains(error, "is not a PNG")) GTEST_SKIP() << "permissions do not bind this user";
    EXPECT_TRUE(contains(error, "check its permissions")) << error;
}

TEST(BrokenImage, content_decides_over_the_extension_with_a_note) {
    const TempFolder folder;
    for (const Kind& kind : kKinds) {
        write_file(folder / "disguised.jpeg", whole_file(folder, kind));
        if (std::string_view(kind.extension) == ".jpg") continue;
        const LoadedImage loaded = load_image(folder / "disguised.jpeg");
        EXPECT_EQ(loaded.image.width, 57) << kind.extension;
        ASSERT_EQ(loaded.notes.size(), 1u) << kind.extension;
        EXPECT_TRUE(contains(loaded.notes[0], "in spite of its name"));
        EXPECT_EQ(load_image_info(folder / "disguised.jpeg").width, 57) << kind.extension;
    }
}

TEST(BrokenImage, names_in_any_script_work) {
    const TempFolder folder;
    for (const char8_t* name : {u8"größe.png", u8"木目.png", u8"мрамор плитка.png", u8"🪵.png"}) {
        save_image(folder / fs::path(name), gradient(3, 2, 3, PixelType::U8));
        EXPECT_EQ(load_image(folder / fs::path(name)).image.width, 3);
        EXPECT_EQ(load_image_info(folder / fs::path(name)).width, 3);
    }
    EXPECT_EQ(folder.files(), 4u);
}

// --- headers that promise the moon ---

std::string png_of(std::uint32_t width, std::uint32_t height) {
    return "\x89PNG\r\n\x1a\n" +
           png_chunk("IHDR", big_endian(width) + big_endian(height) + std::string{8, 6, 0, 0, 0}) +
           png_chunk("IDAT", "x") + png_chunk("IEND", "");
}

std::string targa_of(int width, int height) {
    return std::string{0,
                       0,
                       2,
                       0,
                       0,
                       0,
                       0,
                       0,
                       0,
                       0,
                       0,
                       0,
                       static_cast<char>(width),
                       static_cast<char>(width >> 8),
                       static_cast<char>(height),
                       static_cast<char>(height >> 8),
                       32,
                       0x28} +
           "abcdefgh";
}

TEST(BrokenImage, giant_headers_are_refused_before_any_allocation) {
    const TempFolder folder;
    const auto error_of = [&](const char* name, const std::string& bytes) {
        write_file(folder / name, bytes_of(bytes));
        return load_error(folder / name);
    };
    EXPECT_TRUE(contains(error_of("a.png", png_of(1000000000, 1000000000)), "scale it down"));
    EXPECT_TRUE(contains(error_of("b.png", png_of(40000, 100)), "scale it down"));
    EXPECT_TRUE(contains(error_of("c.png", png_of(16384, 16384)), "more pixels than it holds"));
    EXPECT_TRUE(contains(error_of("d.png", png_of(0, 5)), "no pixels"));
    EXPECT_TRUE(contains(error_of("a.tga", targa_of(65535, 65535)), "scale it down"));
    EXPECT_TRUE(contains(error_of("b.tga", targa_of(16384, 16384)), "more pixels than it holds"));
    Bytes exr = whole_file(folder, {".exr", OIIO::TypeDesc::HALF, "zip"});
    const std::string text(reinterpret_cast<const char*>(exr.data()), exr.size());
    for (const char* window : {"dataWindow", "displayWindow"}) {
        // name\0box2i\0 size, then xmin, ymin, xmax, ymax
        const std::size_t corner = text.find(window) + std::string_view(window).size() + 1 + 6 + 4 + 8;
        for (std::size_t i = 0; i < 8; ++i) exr[corner + i] = static_cast<std::byte>(i % 4 == 3 ? 0x3A : 0);
    }
    write_file(folder / "a.exr", exr);
    EXPECT_NE(load_error(folder / "a.exr"), "");
    EXPECT_THROW(load_image_info(folder / "a.exr"), std::runtime_error);
}

TEST(ImageFormat, is_told_from_the_first_bytes) {
    using namespace std::string_view_literals;
    EXPECT_EQ(image_format_of(bytes_of("\xFF\xD8\xFF\xE0"sv)), ImageFormat::Jpeg);
    EXPECT_EQ(image_format_of(bytes_of("II*\0"sv)), ImageFormat::Tiff);
    EXPECT_EQ(image_format_of(bytes_of("MM\0+"sv)), ImageFormat::Tiff);
    EXPECT_EQ(image_format_of(bytes_of("#?RADIANCE\n"sv)), ImageFormat::Hdr);
    EXPECT_EQ(image_format_of(bytes_of(targa_of(3, 2))), ImageFormat::Targa);
    EXPECT_EQ(image_format_of(bytes_of(""sv)), ImageFormat::Unknown);
    EXPECT_EQ(image_format_of(bytes_of("{\"name\": \"a preset\"}"sv)), ImageFormat::Unknown);
    EXPECT_EQ(image_format_of_extension(".JPEG"), ImageFormat::Jpeg);
    EXPECT_EQ(image_format_of_extension(".obj"), ImageFormat::Unknown);
}

}  // namespace
}  // namespace patina

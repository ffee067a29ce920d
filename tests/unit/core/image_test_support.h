// What the tests of pictures share: a folder that vanishes, files of chosen bytes, and what an error says.
#pragma once

#include "renderer/core/file_io.h"
#include "renderer/core/image.h"
#include "renderer/core/image_io.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace patina::test {

namespace fs = std::filesystem;

class TempFolder {
public:
    TempFolder()
        : path_(fs::temp_directory_path() / ("patina-images-" + std::to_string(std::random_device()()))) {
        fs::create_directories(path_);
    }
    ~TempFolder() {
        std::error_code ignored;
        fs::permissions(path_, fs::perms::owner_all, ignored);
        fs::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    TempFolder(TempFolder&&) = delete;
    TempFolder& operator=(TempFolder&&) = delete;

    fs::path operator/(const fs::path& name) const { return path_ / name; }
    const fs::path& path() const { return path_; }
    std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
    }

private:
    fs::path path_;
};

using Bytes = std::vector<std::byte>;

inline Bytes bytes_of(std::string_view text) {
    Bytes bytes(text.size());
    if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

/// A picture in which every texel of every channel differs from its neighbours; floats reach well above 1.
/// Any channel count.
inline Image gradient(int width, int height, int channels, PixelType type) {
    Image image{.width = width, .height = height, .channels = channels, .type = type};
    image.bytes.resize(static_cast<std::size_t>(width) * height * channels * bytes_per_channel(type));
    const float top = type == PixelType::F32 ? 50.0f : 1.0f;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) {
                const int mixed = (x * 37 + y * 101 + c * 67) % 256;
                set_texel(image, x, y, c, top * static_cast<float>(mixed) / 255.0f);
            }
    return image;
}

inline void expect_equal(const Image& a, const Image& b) {
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    ASSERT_EQ(a.channels, b.channels);
    ASSERT_EQ(a.type, b.type);
    EXPECT_TRUE(a.bytes == b.bytes);
}

/// The one-sentence error of loading a file, "" where it loads. The sentence must name the file, once, and
/// stay on one line.
inline std::string load_error(const fs::path& file) {
    try {
        load_image(file);
    } catch (const std::runtime_error& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.rfind(path_text(file) + ": ", 0), 0u) << message;
        EXPECT_EQ(message.rfind(path_text(file)), 0u) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message.substr(path_text(file).size() + 2);
    }
    return "";
}

inline bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

// --- PNG chunk by chunk ---

inline std::string big_endian(std::uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
            static_cast<char>(value)};
}

inline std::uint32_t crc32(std::string_view text) {
    std::uint32_t crc = 0xFFFFFFFFu;
    for (const char c : text) {
        crc ^= static_cast<unsigned char>(c);
        for (int i = 0; i < 8; ++i) crc = crc >> 1 ^ (0xEDB88320u & (0u - (crc & 1u)));
    }
    return ~crc;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc32(type + data));
}

}  // namespace patina::test

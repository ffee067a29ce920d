#include "renderer/core/exr_structure.h"

#include <gtest/gtest.h>

#include <cstring>

namespace patina {
namespace {

std::string words(std::initializer_list<std::uint32_t> values) {
    std::string bytes;
    for (const std::uint32_t value : values)
        for (int i = 0; i < 4; ++i) bytes += char(value >> 8 * i & 0xFF);
    return bytes;
}
std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + words({std::uint32_t(value.size())}) + value;
}
std::string window(std::uint32_t width, std::uint32_t height) {
    return attribute("dataWindow", "box2i", words({0, 0, width - 1, height - 1}));
}
std::string compression(char number) {
    return attribute("compression", "compression", std::string(1, number));
}
std::string tiles(std::uint32_t width, std::uint32_t height) {
    return attribute("tiles", "tiledesc", words({width, height}) + '\0');
}

constexpr std::uint32_t kPlain = 2, kTiled = 0x202, kManyParts = 0x1002;

std::string file_of(std::uint32_t version, const std::string& attributes, std::size_t behind) {
    return words({0x01312f76, version}) + attributes + '\0' + std::string(behind, 'x');
}
ExrStructure structure(const std::string& file) {
    return exr_structure(std::as_bytes(std::span(file)), file.size());
}
/// Bytes behind the headers from which on the file is not refused.
std::size_t least_table(std::uint32_t version, const std::string& attributes) {
    for (std::size_t bytes = 0; bytes < 4096; ++bytes)
        if (structure(file_of(version, attributes, bytes)).problem.empty()) return bytes;
    return ~std::size_t{0};
}

TEST(ExrStructure, asks_for_eight_bytes_for_each_block_of_rows) {
    EXPECT_EQ(least_table(kPlain, window(9, 100) + compression(0)), 800u);
    EXPECT_EQ(least_table(kPlain, window(9, 100) + compression(3)), 8u * 7);
    EXPECT_EQ(least_table(kPlain, window(9, 100) + compression(4)), 8u * 4);
    EXPECT_EQ(least_table(kPlain, window(9, 100) + compression(9)), 8u);
}

TEST(ExrStructure, asks_for_eight_bytes_for_each_tile) {
    EXPECT_EQ(least_table(kTiled, window(100, 40) + tiles(32, 16)), 8u * 4 * 3);
    EXPECT_EQ(least_table(kPlain, window(100, 40) + tiles(1, 1)), 8u * 40) << "a part of rows";
    EXPECT_NE(structure(file_of(kTiled, window(100, 40) + tiles(0, 0), 4096)).problem, "");
}

TEST(ExrStructure, refuses_attributes_that_the_library_would_read_to_another_end) {
    const std::string channel = std::string("R") + '\0' + std::string(16, '\1');
    const auto problem_of = [](const std::string& attributes) {
        return structure(file_of(kPlain, attributes + window(9, 1) + compression(0), 4096)).problem;
    };
    EXPECT_EQ(problem_of(attribute("channels", "chlist", channel + '\0')), "");
    EXPECT_NE(problem_of(attribute("channels", "chlist", channel + '\0' + "more")), "");
    EXPECT_NE(problem_of(attribute("channels", "chlist", channel)), "");
    EXPECT_EQ(problem_of(attribute("gamma", "float", words({1}))), "");
    EXPECT_NE(problem_of(attribute("gamma", "float", words({1, 2}))), "");
}

TEST(ExrStructure, adds_up_the_parts_of_a_file) {
    const std::string rows = window(1, 10) + attribute("type", "string", "scanlineimage");
    const std::string tiled = window(8, 8) + tiles(4, 4) + attribute("type", "string", "tiledimage");
    EXPECT_EQ(least_table(kManyParts, rows + '\0' + tiled + '\0'), 8u * (10 + 4));
    EXPECT_EQ(least_table(kManyParts, window(1, 1) + attribute("chunkCount", "int", words({99})) + '\0'),
              8u * 99);
}

TEST(ExrStructure, refuses_a_giant_promise_of_any_kind) {
    for (const std::string& attributes :
         {attribute("a", "string", "").substr(0, 9) + words({0x7fffffff}), window(1, 0x7fffffff),
          window(0xffff, 0xffff) + attribute("chunkCount", "int", words({0x7fffffff}))})
        EXPECT_NE(structure(file_of(kPlain, attributes, 700)).problem, "");
    EXPECT_NE(structure(file_of(kTiled, window(0x7fffffff, 0x7fffffff) + tiles(1, 1), 700)).problem, "");
}

TEST(ExrStructure, a_file_cut_anywhere_before_its_table_ends_is_cut_short) {
    const std::string file = file_of(kPlain, window(3, 5) + compression(1), 40);
    ASSERT_EQ(structure(file).problem, "");
    EXPECT_EQ(structure(file).header_bytes, file.size() - 40);
    for (std::size_t size = 0; size < file.size(); ++size)
        EXPECT_NE(structure(file.substr(0, size)).problem, "") << size;
}

TEST(ExrStructure, headers_that_go_on_behind_the_first_bytes_are_no_problem_yet) {
    const std::string file =
        file_of(kPlain, attribute("preview", "preview", std::string(500, 'p')) + window(3, 5), 40);
    const auto first = [&](std::size_t bytes) {
        return exr_structure(std::as_bytes(std::span(file)).first(bytes), file.size());
    };
    EXPECT_EQ(first(100).problem, "");
    EXPECT_EQ(first(100).header_bytes, 0u);
    EXPECT_EQ(first(file.size() - 40).header_bytes, file.size() - 40);
}

}  // namespace
}  // namespace patina

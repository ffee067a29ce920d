// Presets and pictures from strangers: they are read, never obeyed. Nothing is fetched, nothing but what was
// asked for is written, depth and size are bounded.
#include "app/autosave.h"
#include "app/settings.h"
#include "materials/json_text.h"
#include "materials/material_io.h"
#include "renderer/core/image_io.h"
#include "tests/stability/process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace patina {
namespace {

namespace fs = std::filesystem;
using namespace test;

std::string refusal(const std::string& text) {
    try {
        parse_material(text, "x.json");
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(Strangers, depth_and_size_of_json_are_bounded) {
    for (const std::size_t depth : {100u, 1'000'000u}) {
        const std::string text = "{\"mine\":" + std::string(depth, '[') + std::string(depth, ']') + "}";
        EXPECT_NE(refusal(text).find("64"), std::string::npos) << refusal(text);
    }
    const Folder folder;
    const fs::path file = folder.path / "large.json";
    write_text(file, "{\"name\":\"" + std::string(kMaxPresetBytes, 'x') + "\"}");
    EXPECT_THROW(load_material(file), std::runtime_error);
    const std::string deep =
        "{\"patina_recovery\":1,\"view\":{},\"material\":{\"mine\":" + std::string(2'000'000, '[') +
        std::string(2'000'000, ']') + "}}";
    EXPECT_FALSE(parse_recovery(deep));
    EXPECT_EQ(parse_settings("{\"recent\":" + std::string(2'000'000, '[') + std::string(2'000'000, ']') + "}")
                  .settings,
              Settings{});
}

TEST(Strangers, map_paths_follow_the_rule) {
    EXPECT_EQ(resolve_map("/a/b/x.json", "maps/c.png"), fs::path("/a/b/maps/c.png"));
    EXPECT_EQ(resolve_map("/a/b/x.json", "../c.png"), fs::path("/a/c.png"));
    EXPECT_EQ(resolve_map("/a/b/x.json", "../../../../c.png"), fs::path("/c.png"));
    EXPECT_EQ(resolve_map("/a/b/x.json", "/elsewhere/c.png"), fs::path("/elsewhere/c.png"));
    for (const char* address :
         {"http://x/c.png", "https://x/c.png", "file:///c.png", "ftp://x/c.png", "data:image/png,x"})
        EXPECT_TRUE(resolve_map("/a/b/x.json", address).empty()) << address;
}

/// Through the program: every hostile map ends in one sentence, and only what was asked for is written.
TEST(Strangers, a_hostile_preset_reads_nothing_odd_and_writes_nothing) {
    const Folder folder;
    fs::create_directory(folder.path / "in");
    write_text(folder.path / "secret.txt", "not a picture");
    const char* maps[] = {"http://127.0.0.1:1/a.png",
                          "file:///etc/passwd",
                          "/dev/zero",
                          "/dev/stdin",
                          "/proc/self/mem",
                          "../secret.txt",
                          "../../../../../../../../etc/passwd",
                          "$(touch ../owned).png",
                          "`touch ../owned`.png",
                          "| touch ../owned"};
    const auto before = [&] {
        std::vector<std::string> names = files_below(folder.path);
        std::erase_if(names, [](const std::string& name) { return name.starts_with("."); });
        return names;
    };
    for (const char* map : maps) {
        write_text(folder.path / "in" / "x.json",
                   std::string("{\"name\":\"../../owned\",\"albedo\":{\"map\":\"") + map + "\"}}");
        const std::vector<std::string> names = before();
        const Ended ended =
            run_patina(folder, {"render", "in/x.json", "-o", "a.png", "--size", "8x8", "--env", "furnace"});
        EXPECT_EQ(ended.exit_status, 1) << map;
        // A web address is noted where the preset is read, and refused where the map is wanted.
        EXPECT_LE(std::ranges::count(ended.errors, '\n'), 2) << map << ": " << ended.errors;
        EXPECT_TRUE(ended.errors.starts_with("patina: in/x.json: ")) << map << ": " << ended.errors;
        EXPECT_EQ(before(), names) << map;
    }
}

/// Names and keys of a stranger's file are shown, but cannot move a terminal's cursor or add lines of their
/// own.
TEST(Strangers, what_a_file_says_cannot_command_the_terminal) {
    const Folder folder;
    write_text(folder.path / "x.json",
               "{\"albedo\":{\"map\":\"\\u001b[31mred\\nsecond \\u009b2J.png\"},\"\\u001b[2Jkey\":1}");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"check", "x.json"},
          {"render", "x.json", "-o", "a.png", "--size", "8x8", "--env", "furnace"}}) {
        const Ended ended = run_patina(folder, words);
        EXPECT_EQ(ended.exit_status, 1);
        const std::string said = ended.output + ended.errors;
        EXPECT_NE(said.find("red?second"), std::string::npos) << said;
        EXPECT_EQ(said.find_first_of(std::string("\x1b\x00\x7f", 3)), std::string::npos) << said;
        EXPECT_EQ(said.find("\xc2\x9b"), std::string::npos) << said;
    }
    EXPECT_NE(refusal("{\"albedo\":{\"map\":\"\\u0000.png\"}}").find("/albedo/map holds a zero"),
              std::string::npos);
}

TEST(Strangers, unknown_keys_and_long_names_come_back_as_they_were) {
    const std::string name(100000, 'n');
    const Material material =
        parse_material("{\"name\":\"" + name + "\",\"x\":{\"y\":[1,\"\\u0000\\u202e\"]}}", "x").material;
    EXPECT_EQ(parse_material(to_json(material), "x").material, material);
}

}  // namespace
}  // namespace patina

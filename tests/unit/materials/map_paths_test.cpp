#include "materials/material_io.h"
#include "materials/text_io.h"
#include "tests/unit/materials/temporary_folder.h"

namespace patina {

namespace fs = std::filesystem;

TEST(MapPaths, are_relative_to_the_folder_of_the_preset) {
    EXPECT_EQ(resolve_map("/a/b/m.json", "t.png"), fs::path("/a/b/t.png"));
    EXPECT_EQ(resolve_map("/a/b/m.json", "../maps/t.png"), fs::path("/a/maps/t.png"));
    EXPECT_EQ(resolve_map("m.json", "t.png"), fs::path("t.png"));
    EXPECT_EQ(resolve_map("", "maps/t.png"), fs::path("maps/t.png"));
    EXPECT_EQ(resolve_map("/a/m.json", fs::absolute("/x/t.png").string()), fs::absolute("/x/t.png"));
    EXPECT_EQ(resolve_map("/größe/m.json", "木.png"), fs::path(u8"/größe/木.png"));
    EXPECT_TRUE(resolve_map("/a/m.json", "").empty());
}

TEST(MapPaths, backslashes_are_slashes_unless_a_file_of_that_name_exists) {
    EXPECT_EQ(resolve_map("/a/m.json", "maps\\wood\\t.png"), fs::path("/a/maps/wood/t.png"));
    const auto notes = parse_material(R"({"albedo": {"map": "maps\\t.png"}})", "m.json").notes;
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0], "m.json:1:20: /albedo/map is 'maps\\t.png' with backslashes; they are taken as '/'.");
#ifndef _WIN32
    const TemporaryFolder folder;
    write_file(folder / "maps\\t.png", "");
    EXPECT_EQ(resolve_map(folder / "m.json", "maps\\t.png"), folder / "maps\\t.png");
#endif
}

TEST(MapPaths, a_web_address_is_never_a_path) {
    for (const char* address : {"http://x/t.png", "HTTPS://x/t.png", "file:///etc/passwd", "file:t.png",
                                "ftp://x", "data:image/png;base64,AA"}) {
        EXPECT_TRUE(is_web_address(address)) << address;
        EXPECT_TRUE(resolve_map("/a/m.json", address).empty()) << address;
        const auto [material, notes] =
            parse_material(std::string(R"({"albedo": {"map": ")") + address + "\"}}", "m.json");
        ASSERT_EQ(notes.size(), 1u) << address;
        EXPECT_NE(notes[0].find("never fetched"), std::string::npos);
        EXPECT_EQ(material.albedo.map, address) << "kept as it is";
    }
    for (const char* path : {"t.png", "C:/maps/t.png", "c:\\t.png", "a:b.png", "wood: oak.png", "/http/x", "",
                             ":", "//server/t.png"})
        EXPECT_FALSE(is_web_address(path)) << path;
}

TEST(MapPaths, are_written_relative_wherever_the_map_lies) {
    const TemporaryFolder folder;
    const fs::path preset = folder / "presets/m.json";
    EXPECT_EQ(relative_map(preset, folder / "presets/t.png"), "t.png");
    EXPECT_EQ(relative_map(preset, folder / "presets/maps/t.png"), "maps/t.png");
    EXPECT_EQ(relative_map(preset, folder / fs::path(u8"größe/木.png")), "../größe/木.png");
    EXPECT_EQ(relative_map("", folder / "t.png"), path_to_utf8(fs::canonical(folder.path()) / "t.png"));
    for (const char* name : {"presets/t.png", "a/b/t.png", "t.png"})
        EXPECT_EQ(resolve_map(preset, relative_map(preset, folder / name)), folder / name);
}

#ifndef _WIN32
TEST(MapPaths, lead_through_linked_folders_to_the_same_file) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "deep/er/presets");
    fs::create_directories(folder / "maps");
    write_file(folder / "maps/t.png", "picture");
    fs::create_directory_symlink(folder / "deep/er/presets", folder / "link");
    const std::string map = relative_map(folder / "link/m.json", folder / "maps/t.png");
    EXPECT_EQ(read_file(folder / "link" / map), "picture") << map;
    EXPECT_EQ(read_file(folder / "deep/er/presets" / map), "picture") << map;

    fs::create_symlink(folder / "maps/t.png", folder / "deep/er/presets/neighbour.png");
    EXPECT_EQ(relative_map(folder / "link/m.json", folder / "link/neighbour.png"), "neighbour.png");
}
#endif

TEST(MapPaths, save_as_into_another_folder_keeps_finding_the_maps) {
    const TemporaryFolder folder;
    Material material;
    material.albedo.map = "maps/color.png";
    material.normal.map = path_to_utf8(folder / "elsewhere/n.png");
    material.emission.map = "https://x/glow.png";
    const fs::path from = folder / "old/m.json";
    const fs::path to = folder / "new/place/m.json";
    const Material moved = rebase_maps(material, from, to);
    EXPECT_EQ(moved.albedo.map, "../../old/maps/color.png");
    EXPECT_EQ(resolve_map(to, moved.albedo.map), resolve_map(from, material.albedo.map));
    EXPECT_EQ(moved.normal.map, material.normal.map) << "an absolute path stays one";
    EXPECT_EQ(moved.emission.map, material.emission.map);
    EXPECT_EQ(rebase_maps(moved, to, from), material) << "and back";

    Material fresh;
    fresh.albedo.map = path_to_utf8(folder / "new/t.png");
    EXPECT_EQ(rebase_maps(fresh, "", to), fresh);
}

}  // namespace patina

// Files that are dropped on the window: sets of maps, presets, meshes, environments, and broken ones.
#include "materials/material_io.h"
#include "renderer/core/image_io.h"
#include "tests/ui/editor_harness.h"

#include <gtest/gtest.h>

#include <fstream>

namespace {

using namespace patina;
using namespace patina::test;
namespace fs = std::filesystem;

/// A scanned material as it is downloaded: metal with rust, packed maps, a DirectX normal map.
fs::path make_scan(const Folder& home) {
    const fs::path folder = home / "Rusty_Metal_2K";
    write_picture(folder / "Rusty_Metal_2K_BaseColor.png", 180, 90, 60);
    write_picture(folder / "Rusty_Metal_2K_ORM.png", 255, 128, 200);
    write_picture(folder / "Rusty_Metal_2K_NormalDX.png", 128, 128, 255);
    write_picture(folder / "Rusty_Metal_2K_Displacement.png", 10, 10, 10);
    return folder;
}

TEST(Editor, takes_a_folder_of_maps_in_and_gives_a_preset_out) {
    const Folder home;
    const fs::path scan = make_scan(home);
    EXPECT_DRIVEN(drive(home, R"(
wait idle
expect clean
drop ")" + scan.string() + R"("
wait until item import.apply
click import.apply
wait idle
expect dirty
expect albedo.state=ok
expect roughness.channel=g
expect metallic.channel=b
expect normal.convention=directx
expect roughness=1
drag material.roughness.bar -60 0
wait idle
expect roughness<0.8
expect undo=Roughness
drag material.metallic.bar -40 0
expect metallic<0.9
key ctrl+z
expect metallic=1
key ctrl+z
expect roughness=1
expect redo=Roughness
key ctrl+shift+z
expect roughness<0.8
expect metallic=1
key ctrl+s
wait until item browser.file_name
click browser.file_name
key ctrl+a
type rust
key enter
wait until clean
expect file~rust.json
expect status~Saved
)"));
    const Material saved = load_material(home / "rust.json").material;
    EXPECT_EQ(saved.albedo.map, "Rusty_Metal_2K/Rusty_Metal_2K_BaseColor.png");
    EXPECT_EQ(saved.roughness.map, "Rusty_Metal_2K/Rusty_Metal_2K_ORM.png");
    EXPECT_EQ(saved.ao.map, saved.roughness.map);
    EXPECT_EQ(saved.metallic.channel, Channel::B);
    EXPECT_EQ(saved.normal.convention, NormalConvention::DirectX);
    EXPECT_LT(saved.roughness.value, 0.8f);
    EXPECT_GT(saved.roughness.value, 0.3f);
    EXPECT_EQ(saved.metallic.value, 1.0f);
    const std::string before = read_text(home / "rust.json");
    EXPECT_DRIVEN(drive(home, R"(
wait idle
expect clean
expect roughness<0.8
expect albedo.state=ok
expect normal.state=ok
key ctrl+s
wait idle
expect clean
)",
                        {(home / "rust.json").string()}));
    EXPECT_EQ(read_text(home / "rust.json"), before);
}

TEST(Editor, shows_an_imported_set_on_the_mesh_and_under_the_light_that_lie_with_it) {
    const Folder home;
    const fs::path scan = make_scan(home);
    std::ofstream(scan / "plate.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    save_image(scan / "evening.exr", make_image(32, 16, 3, PixelType::F32));
    EXPECT_DRIVEN(drive(home, "wait idle\ndrop " + scan.string() +
                                  "\nwait until item import.apply\nclick import.apply\nwait until "
                                  "environment~evening.exr\nwait idle\nexpect "
                                  "mesh~plate.obj\nexpect triangles=2\nexpect albedo.state=ok\nexpect "
                                  "albedo.map~BaseColor\n"));
}

TEST(Editor, opens_presets_meshes_and_environments_that_are_dropped_on_it) {
    const Folder home;
    write_text(home / "gold.json", R"({"name": "Gold", "metallic": {"value": 1}})");
    write_text(home / "roof.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    Image sky = make_image(64, 32, 3, PixelType::F32);
    for (int x = 0; x < 64; ++x) set_texel(sky, x, 3, 0, 20.0f);
    save_image(home / "evening.exr", sky);
    EXPECT_DRIVEN(drive(home, "wait idle\ndrop " + (home / "gold.json").string() + " at viewport\n" +
                                  "wait until metallic=1\ndrop " + (home / "roof.obj").string() +
                                  "\nwait until mesh~roof.obj\nwait idle\nexpect triangles=2\ndrop " +
                                  (home / "evening.exr").string() +
                                  "\nwait until environment~evening.exr\nwait idle\nexpect clean\ndrop " +
                                  (home / "nothing.txt").string() + "\nwait until status~neither\n"));
}

TEST(Editor, goes_back_to_what_worked_when_a_light_or_mesh_cannot_be_read) {
    const Folder home;
    write_text(home / "broken.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\nhalf");
    write_text(home / "flat.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n");
    EXPECT_DRIVEN(
        drive(home, "wait idle\ndrop " + (home / "broken.hdr").string() +
                        "\nwait until status~broken.hdr\nwait idle\nexpect environment=studio\ndrop " +
                        (home / "flat.obj").string() +
                        "\nwait until status~flat.obj\nwait idle\nexpect mesh=sphere\nexpect clean\n"));
}

}  // namespace

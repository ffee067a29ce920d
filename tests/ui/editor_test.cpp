// The program as a person meets it: each test opens the window, does something and looks at what came of it.
#include "materials/material_io.h"
#include "renderer/core/image_io.h"
#include "renderer/core/metrics.h"
#include "tests/ui/editor_harness.h"

#include <gtest/gtest.h>

#include <fstream>
#include <unistd.h>

namespace {

using namespace patina;
using namespace patina::test;
namespace fs = std::filesystem;

TEST(Editor, gives_unsaved_work_back_after_a_crash_and_to_one_window_only) {
    const Folder home;
    const fs::path sign = home / "ready.png";
    write_text(home / "gold.json", R"({"name": "Gold", "roughness": {"value": 0.25}})");
    Program crashing(home, drive_arguments(home, R"(
wait idle
drag material.metallic.bar 90 0
expect dirty
wait 2 seconds
screenshot )" + sign.string() + R"(
wait 300 seconds
)",
                                           {(home / "gold.json").string()}));
    ASSERT_TRUE(wait_for_file(sign)) << crashing.wait().errors;
    EXPECT_DRIVEN(drive(home, "wait idle\nexpect recovery=no\nexpect metallic=0\n"));
    crashing.kill();
    EXPECT_DRIVEN(drive(home, R"(
wait idle
expect recovery=asked
click recovery.later
wait idle
expect recovery=no
)"));
    EXPECT_DRIVEN(drive(home, R"(
wait idle
expect recovery=asked
click recovery.recover
wait idle
expect recovery=no
expect dirty
expect metallic>0.3
expect roughness=0.25
expect file~gold.json
key ctrl+s
wait until clean
)"));
    EXPECT_GT(load_material(home / "gold.json").material.metallic.value, 0.3f);
    EXPECT_DRIVEN(drive(home, "wait idle\nexpect recovery=no\n"));
    for (const auto& entry : fs::directory_iterator(home / "state"))
        EXPECT_EQ(entry.path().filename(), "settings.json");
}

TEST(Editor, keeps_a_preset_with_a_missing_and_a_broken_map_as_it_is) {
    const Folder home;
    const std::string text = R"({
  "name": "Lost",
  "albedo": { "value": [1, 1, 1], "map": "gone/color.png" },
  "roughness": { "value": 0.5, "map": "./broken.png" }
}
)";
    write_text(home / "p" / "lost.json", text);
    write_text(home / "p" / "broken.png", "this is no picture");
    EXPECT_DRIVEN(drive(home, R"(
wait idle
expect albedo.state=missing
expect roughness.state=broken
expect log~color.png
expect log~broken.png
expect item material.albedo.locate
click material.name
key ctrl+a
type Found
key enter
expect dirty
key ctrl+s
wait until clean
)",
                        {(home / "p" / "lost.json").string()}));
    const Material saved = load_material(home / "p" / "lost.json").material;
    EXPECT_EQ(saved.name, "Found");
    EXPECT_EQ(saved.albedo.map, "gone/color.png");
    EXPECT_EQ(saved.roughness.map, "./broken.png");
}

TEST(Editor, reads_a_map_again_that_was_painted_over_on_disk) {
    const Folder home;
    const fs::path map = home / "color.png", sign = home / "ready.png";
    write_picture(map, 200, 30, 30);
    write_text(home / "red.json", R"({"albedo": {"value": [1, 1, 1], "map": "color.png"}})");
    Program program(home, drive_arguments(home, R"(
wait idle
expect albedo.state=ok
expect maps_loaded=1
screenshot )" + sign.string() + R"(
wait idle
mark
wait until maps_loaded=2
wait idle
expect albedo.state=ok
expect views>0
expect clean
)",
                                          {(home / "red.json").string()}));
    ASSERT_TRUE(wait_for_file(sign)) << program.wait().errors;
    write_picture(map, 30, 30, 200, 32);
    EXPECT_DRIVEN(program.wait());
}

TEST(Editor, bakes_a_light_once_and_takes_it_from_memory_the_second_time) {
    const Folder home;
    EXPECT_DRIVEN(drive(home, R"(
wait idle
click library.environments
wait idle
click "library.environments.White furnace"
wait idle
expect environment=furnace
expect lights_from_memory=0
click library.environments.Studio
wait idle
expect environment=studio
expect lights_from_memory=1
click "library.environments.White furnace"
wait idle
expect lights_from_memory=2
key ctrl+z
expect environment=studio
)"));
}

TEST(Editor, keeps_the_document_when_it_cannot_be_saved) {
    const Folder home;
    fs::create_directories(home / "taken.json");
    EXPECT_DRIVEN(drive(home, R"(
wait idle
drag material.roughness.bar 40 0
expect dirty
key ctrl+s
wait until item browser.file_name
click browser.file_name
key ctrl+a
type taken.json
key enter
wait until status~taken.json
expect dirty
expect roughness>0.55
expect file=
)"));
    EXPECT_TRUE(fs::is_directory(home / "taken.json"));
    EXPECT_TRUE(fs::is_empty(home / "taken.json"));
}

TEST(Editor, asks_before_unsaved_changes_are_lost) {
    const Folder home;
    EXPECT_DRIVEN(drive(home, R"(
wait idle
drag material.roughness.bar 40 0
close
wait until unsaved=asked
click unsaved.cancel
wait idle
expect unsaved=no
expect dirty
key ctrl+n
wait until unsaved=asked
click unsaved.discard
wait idle
expect clean
expect roughness=0.5
drag material.roughness.bar 40 0
key ctrl+n
wait until unsaved=asked
click unsaved.save
wait until item browser.cancel
click browser.cancel
wait idle
expect dirty            # the save was called off, so the new document was, too
)"));
}

TEST(Editor, exports_the_picture_for_the_screen_and_for_measuring) {
    const Folder home;
    for (const char* name : {"shot.png", "shot.exr"})
        EXPECT_DRIVEN(drive(home, R"(
wait idle
key ctrl+e
wait until item browser.file_name
click browser.file_name
key ctrl+a
type )" + std::string(name) + R"(
key enter
wait until status~Exported
)"));
    EXPECT_EQ(load_image_info(home / "shot.png").type, PixelType::U8);
    EXPECT_EQ(load_image_info(home / "shot.exr").type, PixelType::F32);
    EXPECT_EQ(load_image_info(home / "shot.png").width, load_image_info(home / "shot.exr").width);
}

TEST(SlowEditor, exports_the_reference_and_what_the_shading_misses) {
    const Folder home;
    std::string script =
        "resize 800 600\nwait idle\nclick status\nwait 3 frames\nclick drawer.accuracy\nwait until item "
        "accuracy.figures\n";
    const auto add = [&](const char* what, const char* name) {
        script +=
            "click accuracy.export\nwait until item browser.what\nclick browser.what\nwait 2 frames\n"
            "click browser.what." +
            std::string(what) + "\nwait 2 frames\nclick browser.file_name\nkey ctrl+a\ntype " + name +
            "\nkey enter\nwait until log~\"Exported " + name + "\"\n";
    };
    add("reference", "truth.exr");
    add("reference", "truth.png");
    add("relative_error", "error.exr");
    add("relative_error", "error.png");
    add("flip", "flip.exr");
    add("flip", "flip.png");
    EXPECT_DRIVEN(drive(home, script));
    const Image truth = load_image(home / "truth.exr").image;
    EXPECT_EQ(truth.channels, 3);
    EXPECT_EQ(load_image_info(home / "truth.png").width, truth.width);
    const Image error = load_image(home / "error.exr").image;
    EXPECT_EQ(error.channels, 1);
    EXPECT_EQ(error.width, truth.width);
    EXPECT_GT(mean_value(error), 0.0);
    EXPECT_EQ(load_image_info(home / "flip.exr").type, PixelType::F32);
    for (const char* map : {"error.png", "flip.png"}) {
        const ImageInfo info = load_image_info(home / map);
        EXPECT_EQ(info.type, PixelType::U8) << map;
        EXPECT_GT(info.height, truth.height) << map << " has a title and a legend";
    }
}

TEST(Editor, says_what_is_missing_for_an_export_of_the_error) {
    const Folder home;
    EXPECT_DRIVEN(drive(home, R"(
wait idle
key ctrl+e
wait until item browser.what
click browser.what
wait 2 frames
click browser.what.flip
wait 2 frames
click browser.file_name
key ctrl+a
type flip.png
key enter
wait until status~"no reference yet"
)"));
    EXPECT_FALSE(std::filesystem::exists(home / "flip.png"));
}

TEST(Editor, starts_with_corrupt_settings_and_a_preset_that_is_not_there) {
    const Folder home;
    write_text(home / "state" / "settings.json", "{ \"window_width\": ");
    EXPECT_DRIVEN(drive(home, "wait idle\nexpect log~settings\nexpect log~missing.json\nexpect clean\n",
                        {(home / "missing.json").string()}));
    const std::string settings = read_text(home / "state" / "settings.json");
    EXPECT_NE(settings.find("window_height"), std::string::npos);
}

TEST(Editor, says_in_one_line_that_there_is_no_display) {
    const Folder home;
    Program program(home, {}, {{"DISPLAY", ""}});
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.errors.find("patina: "), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.errors.find("window"), std::string::npos) << outcome.errors;
}

/// A hilly sheet of 2 · side² triangles.
void write_sheet(const fs::path& file, int side) {
    std::ofstream obj(file);
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x) obj << "v " << x << ' ' << (x * y) % 7 << ' ' << y << '\n';
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int a = y * (side + 1) + x + 1, b = a + side + 1;
            obj << "f " << a << ' ' << b << ' ' << b + 1 << '\n'
                << "f " << a << ' ' << b + 1 << ' ' << a + 1 << '\n';
        }
}

// The loop goes round many times while something large comes in: nothing of it is done in one piece there.
TEST(SlowEditor, goes_on_while_a_large_mesh_loads) {
    const Folder home;
    write_sheet(home / "sheet.obj", 700);
    EXPECT_DRIVEN(
        drive(home, "wait idle\nmark\ndrop " + (home / "sheet.obj").string() +
                        "\nwait until triangles=980000\nexpect turns>8\nwait idle\nexpect clean\n"));
}

TEST(SlowEditor, goes_on_while_a_large_map_loads) {
    const Folder home;
    write_picture(home / "cliff_albedo.png", 120, 90, 60, 8192);
    EXPECT_DRIVEN(drive(home, "wait idle\nmark\ndrop " + (home / "cliff_albedo.png").string() +
                                  " at material.albedo.card\nwait until albedo.state=loading\nwait until "
                                  "albedo.state=ok\nexpect turns>8\nwait idle\nexpect dirty\n"));
}

TEST(SlowEditor, goes_on_while_a_light_bakes) {
    const Folder home;
    const int never_twice = ::getpid();  // a light that was seen before would come from the cache
    Image room = make_image(4096, 2048, 3, PixelType::F32);
    for (int y = 0; y < room.height; ++y)
        for (int x = 0; x < room.width; ++x)
            for (int c = 0; c < 3; ++c)
                set_texel(room, x, y, c, float((x / 64 + y / 64 + c) % 5) + 1e-3f * float(never_twice));
    save_image(home / "room.exr", room);
    EXPECT_DRIVEN(drive(home, "wait idle\nmark\ndrop " + (home / "room.exr").string() +
                                  "\nwait until environment~room.exr\nwait until pending=no\nexpect "
                                  "turns>8\nexpect lights_baked>0\nwait idle\nexpect clean\n"));
}

/// A counter of a ledger that --stats wrote.
std::uint64_t counted(const fs::path& stats, const std::string& counter) {
    const std::string text = read_text(stats);
    const std::size_t at = text.find('"' + counter + "\":");
    EXPECT_NE(at, std::string::npos) << text;
    return std::strtoull(text.c_str() + at + counter.size() + 3, nullptr, 10);
}

TEST(Editor, shows_the_object_in_its_light_in_the_first_frame) {
    const Folder home;
    start_small(home, 500, 360);
    const fs::path stats = home / "stats.json";
    EXPECT_DRIVEN(drive(home, "wait idle\n", {"-"}));  // the light is kept
    EXPECT_DRIVEN(drive(home, "wait until views>0\n", {"-", "--stats", stats.string()}));
    EXPECT_EQ(counted(stats, "frames_before"), 0u);
}

TEST(Editor, reads_a_map_once_however_its_first_pictures_are_drawn) {
    const Folder home;
    start_small(home, 700, 420);
    save_image(home / "large.png", make_image(4096, 4096, 3, PixelType::U8));
    write_text(home / "p.json", R"({"albedo": {"map": "large.png"}, "emission": {"map": "large.png"}})");
    EXPECT_DRIVEN(drive(home, R"(
wait idle
expect maps_loaded=1
)",
                        {(home / "p.json").string()}));
}

TEST(SlowEditor, shows_the_interface_first_where_the_object_takes_long_to_read) {
    const Folder home;
    start_small(home, 500, 360);
    const fs::path stats = home / "stats.json", mesh = home / "fine.off";
    constexpr int side = 1000;
    std::string text =
        "OFF\n" + std::to_string(side * side) + " " + std::to_string((side - 1) * (side - 1)) + " 0\n";
    for (int i = 0; i < side * side; ++i)
        text += std::to_string(i % side) + " " + std::to_string(i / side) + " 0\n";
    for (int y = 0; y + 1 < side; ++y)
        for (int x = 0; x + 1 < side; ++x) {
            text += "4";
            for (const int at : {y * side + x, y * side + x + 1, (y + 1) * side + x + 1, (y + 1) * side + x})
                text += " " + std::to_string(at);
            text += "\n";
        }
    write_text(mesh, text);
    EXPECT_DRIVEN(
        drive(home, "wait until views>0\n", {"-", "--mesh", mesh.string(), "--stats", stats.string()}));
    EXPECT_GT(counted(stats, "frames_before"), 0u);
}

/// room.exr, an environment.
Image write_room(const Folder& home) {
    Image room = make_image(64, 32, 3, PixelType::F32);
    for (int y = 0; y < room.height; ++y)
        for (int x = 0; x < room.width; ++x) set_texel(room, x, y, x % 3, 0.5f + 0.02f * float(y));
    save_image(home / "room.exr", room);
    return room;
}

TEST(Editor, decodes_an_environment_once_and_never_again) {
    const Folder home;
    start_small(home, 500, 360);
    Image room = write_room(home);
    const auto visit = [&](bool first) {
        const fs::path stats = home / "stats.json";
        Program program(
            home,
            drive_arguments(home, "wait idle\nexpect environment~room.exr\n",
                            {"-", "--env", (home / "room.exr").string(), "--stats", stats.string()}),
            {{"PATINA_CACHE_DIR", (home / "cache").string()}});
        EXPECT_DRIVEN(program.wait());
        EXPECT_EQ(counted(stats, "environments_from_disk"), first ? 0u : 1u);
        // Its small picture is made of what was kept.
        EXPECT_EQ(counted(stats, "environments_decoded"), first ? 1u : 0u);
        EXPECT_EQ(counted(stats, "levels_baked") > 0, first);
    };
    visit(true);
    visit(false);
    set_texel(room, 3, 3, 0, 7.0f);  // another picture in the same place
    save_image(home / "room.exr", room);
    visit(true);
    visit(false);
}

TEST(Editor, has_the_light_that_a_mode_beside_the_views_own_looks_up) {
    const auto levels = [](const std::string& more) {
        const Folder home;
        start_small(home, 700, 500);
        write_room(home);
        const fs::path stats = home / "stats.json";
        Program program(home,
                        drive_arguments(home, R"(
wait idle
click toolbar.shading
wait 2 frames
click toolbar.shading.course
wait idle
drop )" + (home / "room.exr").string() + R"(
wait until environment~room.exr
wait idle
)" + more,
                                        {"-", "--env", "furnace", "--stats", stats.string()}),
                        {{"PATINA_CACHE_DIR", (home / "cache").string()}});
        EXPECT_DRIVEN(program.wait());
        return counted(stats, "levels_baked");
    };
    const std::uint64_t alone = levels("");
    EXPECT_GE(levels(R"(
click status
wait 3 frames
click drawer.accuracy
wait until item accuracy.left
click accuracy.left
wait 2 frames
click accuracy.left.fitted
wait 3 frames
wait until pending=no
)"),
              alone + 4);
}

TEST(Drive, names_the_line_of_a_script_that_fails) {
    const Folder home;
    const Outcome failed = drive(home, "wait idle\nexpect roughness=0.9\n");
    EXPECT_EQ(failed.status, 1);
    EXPECT_NE(failed.errors.find(".drive:2: roughness is '0.5'"), std::string::npos) << failed.errors;
    const Outcome unknown = drive(home, "wait idle\njump\n");
    EXPECT_EQ(unknown.status, 1);
    EXPECT_NE(unknown.errors.find(".drive:2: there is no command 'jump'"), std::string::npos)
        << unknown.errors;
}

}  // namespace

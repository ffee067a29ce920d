// The comparison from the first view to the report, two views in one, and maps made from a photo: in the real
// window, as a person does it.
#include "app/comparison_file.h"
#include "materials/material_io.h"
#include "renderer/core/image_io.h"
#include "tests/ui/editor_harness.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

using namespace test;

/// A rough wall, lit from the left.
void write_wall(const std::filesystem::path& file) {
    Image wall = make_image(160, 160, 3, PixelType::U8);
    for (int y = 0; y < 160; ++y)
        for (int x = 0; x < 160; ++x) {
            const float stone = 0.5f + 0.12f * std::sin(0.5f * float(x)) * std::cos(0.37f * float(y));
            for (int c = 0; c < 3; ++c)
                set_texel(wall, x, y, c, stone * (1.0f - 0.002f * float(x)) * (1.0f - 0.1f * float(c)));
        }
    save_image(file, wall);
}

TEST(SlowEditorSheet, goes_from_presets_and_lights_over_a_photo_to_a_report) {
    const Folder home;
    write_picture(home / "shot.png", 118, 118, 100);
    EXPECT_DRIVEN(drive(home, R"(
wait idle
key c
wait idle
click sheet.view.2
wait idle
click sheet.add_light
wait idle
click library.environments
click library.environments.Night
wait idle
click sheet.view.2
click "library.environments.Clear sky"
wait idle
click sheet.add_preset
wait idle
expect sheet_views=6
click library.presets
click library.presets.Rubber
wait idle
click sheet.view.2
key shift+right
wait idle
expect sheet_rotations=0,5,0
click sheet.view.1
click compare.photo.choose
wait until item browser.entry.shot.png
click browser.entry.shot.png
click browser.confirm
wait idle
click compare.photo.fit
wait idle
drag sheet.point.1 9 6
drag sheet.point.2 -9 6
drag sheet.point.3 -9 -6
drag sheet.point.4 9 -6
wait idle
click compare.photo.fit
click compare.photo.grey
wait idle
click sheet.view.1
wait idle
expect photo_exposure!=0
click compare.title
type wall
click compare.save
wait until item browser.file_name
click browser.confirm
wait until sheet_file~wall.json
wait idle
click compare.report
wait until item browser.file_name
click browser.file_name
key ctrl+a
type report.pdf
click browser.confirm
wait until log~Exported
wait idle
)",
                        {"gold"}));
    const Comparison saved = load_comparison(home / "wall.json").comparison;
    ASSERT_EQ(saved.rows.size(), 2u);
    ASSERT_EQ(saved.columns.size(), 3u);
    EXPECT_EQ(saved.rows[0].preset, kEditedPreset);
    EXPECT_EQ(saved.rows[1].preset, "rubber");
    EXPECT_EQ(saved.columns[0].environment, "studio");
    EXPECT_EQ(saved.columns[1].environment, "sky");
    EXPECT_EQ(saved.columns[2].environment, "night");
    EXPECT_FLOAT_EQ(saved.columns[1].rotation_deg, 5.0f);
    ASSERT_TRUE(saved.columns[0].photo && saved.columns[0].photo->fit);
    for (const glm::vec2 point : saved.columns[0].photo->fit->photo) {
        const glm::vec2 from_middle = glm::abs(point - 0.5f);
        const glm::vec2 before = glm::abs(saved.columns[0].photo->fit->view[0] - 0.5f);
        EXPECT_LT(from_middle.x, before.x - 0.01f) << "each was drawn inwards";
        EXPECT_LT(from_middle.y, before.y - 0.01f);
        EXPECT_GT(from_middle.x, 0.3f);
    }
    const std::string report = read_text(home / "report.pdf");
    EXPECT_TRUE(report.starts_with("%PDF"));
    EXPECT_GT(report.size(), 20000u) << "six pictures";
    // Opened again it is what was saved; its report as a page holds its pictures.
    EXPECT_DRIVEN(drive(home, "wait idle\ndrop \"" + (home / "wall.json").string() + R"("
wait until sheet_views=6
wait idle
expect sheet_rotations=0,5,0
expect sheet_unsaved=no
expect photo_exposure!=0
expect photo_delta_e>0
click compare.report
wait until item browser.file_name
click browser.file_name
key ctrl+a
type wall.html
click browser.confirm
wait until log~Exported
wait idle
)",
                        {"gold"}));
    const std::string page = read_text(home / "wall.html");
    EXPECT_NE(page.find("data:image/png;base64,"), std::string::npos);
    EXPECT_NE(page.find("Rubber"), std::string::npos);
    EXPECT_NE(page.find("Night"), std::string::npos);
}

TEST(SlowEditorSheet, writes_a_report_with_errors_against_the_reference_and_stays_in_reach) {
    const Folder home;
    write_picture(home / "shot.png", 118, 118, 100);
    Comparison comparison;
    comparison.rows = {{.preset = "gold"}, {.preset = "rubber"}};
    comparison.columns = {{.environment = "furnace", .photo = Photo{.file = (home / "shot.png").string()}}};
    save_comparison(home / "metals.json", comparison);
    start_small(home, 780, 360);
    EXPECT_DRIVEN(drive(home, "wait idle\ndrop \"" + (home / "metals.json").string() + R"("
wait until sheet_views=2
wait idle
click compare.report_reference
click compare.report
wait until item browser.file_name
click browser.file_name
key ctrl+a
type errors.html
click browser.confirm
wait until item status.cancel
click sheet.view.2
key shift+right                 # the work goes on; the report shows what there was when it was asked for
expect sheet_rotations!=0
wait until log~Exported
wait idle
)"));
    const std::string page = read_text(home / "errors.html");
    const std::size_t at = page.find("Against the reference");
    ASSERT_NE(at, std::string::npos);
    const std::string section = page.substr(at, page.find("</section>", at) - at);
    EXPECT_NE(section.find("<td>Gold</td>"), std::string::npos) << section;
    EXPECT_NE(section.find("<td>Rubber</td>"), std::string::npos) << section;
    EXPECT_NE(page.find("<td>0°</td>"), std::string::npos) << "turned after it was begun";
    EXPECT_EQ(page.find("<td>5°</td>"), std::string::npos);
    EXPECT_NE(page.find("patina render gold "), std::string::npos) << "shipped presets by their names";
    EXPECT_NE(page.find("patina report metals.json -o errors.html"), std::string::npos);
}

TEST(EditorSheet, a_photo_dropped_on_a_view_is_held_against_it) {
    const Folder home;
    start_small(home, 860, 340);
    write_picture(home / "shot.png", 40, 90, 160);
    EXPECT_DRIVEN(drive(
        home, "wait idle\nkey c\nwait idle\ndrop \"" + (home / "shot.png").string() + R"(" at sheet.view.2
wait idle
expect sheet_selected=2
expect no item import.apply
expect photo_delta_e>0
expect photo_hint!=        # the default material is another grey than the photo's blue: darker
double-click sheet.view.2
wait idle
click compare.photo.region  # choosing what to hold against it ends the tool
click sheet.against
click sheet.against.photo
wait idle
expect item sheet.split
expect item compare.photo.region
hover sheet.view.2 at 0.5 0.5
wait idle
expect probe_first!=none
expect probe_second~40,90,160
click sheet.how.signed
wait idle
expect item viewport.legend.signed
click sheet.how.flip
wait idle
expect item viewport.legend.flip
key escape
wait idle
expect no item sheet.back
key ctrl+z
wait idle
expect photo_opacity=none
)"));
}

TEST(EditorSheet, a_report_is_drawn_beside_the_work_and_can_be_stopped) {
    const Folder home;
    start_small(home, 780, 360);
    EXPECT_DRIVEN(drive(home, R"(
wait idle
key c
wait idle
click compare.report_reference  # many short steps: there is time to stop it
click compare.report
wait until item browser.file_name
click browser.file_name
key ctrl+a
type stopped.html
click browser.confirm
wait until item status.cancel
click status.cancel
wait idle
expect log~Cancelled
expect log!~Exported
)",
                        {"gold"}));
    EXPECT_FALSE(std::filesystem::exists(home / "stopped.html"));
}

TEST(EditorSheet, a_view_with_a_camera_of_its_own_stays_when_the_others_turn) {
    const Folder home;
    start_small(home, 780, 360);
    EXPECT_DRIVEN(drive(home, R"(
wait idle
key c
wait idle
click sheet.view.2
click compare.own_camera
wait idle
drag sheet.view.1 40 0
wait idle
expect yaw!=0
expect sheet_yaws~,0
expect sheet_yaws!=0,0
drag sheet.view.2 0 30
wait idle
expect pitch=0              # the shared camera did not follow
click compare.own_camera
wait idle
expect item sheet.view.2
)"));
}

TEST(EditorSheet, a_light_with_a_shading_mode_of_its_own_is_held_against_the_others) {
    const Folder home;
    start_small(home, 860, 400);
    Comparison twice;
    twice.rows = {{.preset = "-"}};
    twice.columns = {{.environment = "furnace"}, {.environment = "furnace", .shading = Shading::SplitSum}};
    save_comparison(home / "twice.json", twice);
    EXPECT_DRIVEN(drive(home, "wait idle\ndrop \"" + (home / "twice.json").string() + R"("
wait until sheet_views=2
wait idle
expect sheet_shadings=fitted,split-sum
click sheet.view.2
click toolbar.shading
click toolbar.shading.course
wait idle
expect sheet_shadings=fitted,course
double-click sheet.view.1
wait idle
click sheet.against
click "sheet.against.2__untitled_·_white_furnace__course"
click sheet.how.relative
wait idle
expect item viewport.legend.error
click sheet.back
click sheet.view.2
click compare.own_shading
wait idle
expect sheet_shadings=fitted,fitted
)"));
}

TEST(EditorSheet, two_views_are_held_against_each_other_in_one) {
    const Folder home;
    start_small(home, 860, 340);
    EXPECT_DRIVEN(drive(home, R"(
wait idle
key c
wait idle
double-click sheet.view.1
wait idle
expect no item sheet.split
click sheet.against
click "sheet.against.2__untitled_(edited)_·_sunset"
wait idle
expect item sheet.split
hover sheet.view.1 at 0.5 0.5
wait idle
expect item probe.first
expect item probe.second
expect probe_first!=none
expect probe_second!=none
drag sheet.split 80 0
wait idle
click sheet.how.signed
wait idle
expect item viewport.legend.signed
expect no item sheet.split
click sheet.how.relative
wait idle
expect item viewport.legend.error
click sheet.how.flip
wait idle
expect item viewport.legend.flip
click sheet.how.blink
hover sheet.view.1 at 0.5 0.5
wait 5 frames
mark
wait 2 seconds
expect frames<20
click sheet.how.split
wait idle
click sheet.back
wait idle
expect item sheet.view.2
)"));
}

const std::string kChoosesTheWall = R"(
wait idle
click inspector.maps
click maps.choose
wait until item browser.entry.wall.png
click browser.entry.wall.png
click browser.confirm
wait idle
)";

TEST(EditorMaps, are_made_from_a_photo_worn_and_undone) {
    const Folder home;
    start_small(home, 780, 360);
    write_wall(home / "wall.png");
    EXPECT_DRIVEN(drive(home, kChoosesTheWall + R"(
expect item maps.preview.albedo
drag maps.corner.1 12 8
wait idle
click maps.size.512
wait idle
click maps.make                # never saved: the maps lie beside the preset
wait until item browser.file_name
click browser.confirm
wait until file~.json
wait idle
click maps.make
wait until log~Made
wait idle
expect albedo.map~wall_albedo.png
expect albedo.state=ok
expect normal.map~wall_normal.png
expect normal.state=ok
expect roughness.map~wall_roughness.png
expect ao.map~wall_ao.png
key ctrl+z
wait idle
expect albedo.map=
key ctrl+shift+z
wait idle
expect albedo.map~wall_albedo.png
key ctrl+s
wait idle
expect clean
)"));
    EXPECT_EQ(load_image_info(home / "wall_albedo.png").width, 512);
    EXPECT_EQ(load_image_info(home / "wall_normal.png").type, PixelType::U16);
    EXPECT_EQ(load_image_info(home / "wall_height.png").type, PixelType::U16);
    const Material saved = load_material(home / "Untitled.json").material;
    EXPECT_EQ(saved.albedo.map, "wall_albedo.png") << "relative to the preset";
    EXPECT_EQ(saved.albedo.value, glm::vec3(1.0f));
}

TEST(EditorMaps, never_replace_a_file_nor_a_slot_that_was_left_out) {
    const Folder home;
    start_small(home, 780, 360);
    write_wall(home / "wall.png");
    write_picture(home / "wall_albedo.png", 1, 2, 3);
    write_text(home / "mine.json", R"({"name": "Mine"})");
    const std::string before = read_text(home / "wall_albedo.png");
    EXPECT_DRIVEN(drive(home, kChoosesTheWall + R"(
click maps.size.512
click maps.use.normal
wait idle
click maps.make
wait until albedo.map~wall-2_albedo.png
wait idle
expect normal.map=
)",
                        {(home / "mine.json").string()}));
    EXPECT_EQ(read_text(home / "wall_albedo.png"), before);
    EXPECT_TRUE(std::filesystem::exists(home / "wall-2_albedo.png"));
    EXPECT_FALSE(std::filesystem::exists(home / "wall-2_normal.png"));
}

}  // namespace
}  // namespace patina

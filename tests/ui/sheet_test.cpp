// Views side by side as a person meets them: built, turned, undone, saved, opened again.
#include "app/comparison_file.h"
#include "renderer/core/color_difference.h"
#include "tests/ui/editor_harness.h"
#include "tests/ui/panels_stage.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace patina {
namespace {

using namespace test;

TEST(EditorSheet, is_built_turned_undone_and_saved) {
    const Folder home;
    start_small(home, 780, 360);
    EXPECT_DRIVEN(drive(home, R"(
wait idle
key c
wait idle
expect sheet_views=2
click sheet.view.2
wait idle
click sheet.add_light
wait idle
expect sheet_views=3
expect sheet_selected=3
click sheet.add_preset
wait idle
expect sheet_views=6
drop ")" + shipped_preset("gold").string() +
                                  R"("
wait idle
expect sheet_selected=6
mark
click sheet.view.5
key shift+right          # turns the light of the middle column by five degrees
wait idle
expect sheet_rotations=0,5,0
expect views=2           # of six views only those of that column were drawn again
key ctrl+z
wait idle
expect sheet_rotations=0,0,0
key ctrl+shift+z
wait idle
expect sheet_rotations=0,5,0
click sheet.turn_all
key shift+right
wait idle
expect sheet_rotations=5,10,5
double-click sheet.view.1
wait idle
expect item sheet.back
expect no item sheet.view.2
click sheet.back
wait idle
expect item sheet.view.6
click compare.title
type metals
click compare.save
wait until item browser.file_name
click browser.confirm
wait until sheet_file~metals.json
wait idle
key c
wait idle
expect sheet_views=0
)"));
    const Comparison saved = load_comparison(home / "metals.json").comparison;
    ASSERT_EQ(saved.rows.size(), 2u);
    ASSERT_EQ(saved.columns.size(), 3u);
    EXPECT_EQ(saved.title, "metals");
    EXPECT_EQ(saved.rows[0].preset, kEditedPreset);
    EXPECT_EQ(saved.rows[1].preset, "gold");
    EXPECT_FLOAT_EQ(saved.columns[1].rotation_deg, 10.0f);
}

TEST(EditorSheet, opened_it_stands_beside_what_was_there_and_undo_goes_across) {
    const Folder home;
    start_small(home, 780, 360);
    Comparison metals;
    metals.rows = {{}, {.preset = "gold"}};
    metals.columns = {{.environment = "studio", .rotation_deg = 5.0f}, {.environment = "furnace"}};
    save_comparison(home / "metals.json", metals);
    EXPECT_DRIVEN(drive(home, "wait idle\nkey c\nwait idle\ndrop \"" + (home / "metals.json").string() + R"("
wait until sheet_views=4
wait idle
expect unsaved=no            # of two views that nobody has changed nothing is lost
key ctrl+z
wait idle
expect sheet_views=2
expect sheet_file=           # saving it does not replace the other's
key ctrl+shift+z
wait idle
expect sheet_file~metals.json
expect sheet_unsaved=no
expect sheet_rotations=5,0
click sheet.remove
wait idle
expect sheet_views=2
)"));
}

/// For what a crash would leave.
bool wait_for_kept_work(const std::filesystem::path& state) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(state, ignored)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with("recovery-") && name.ends_with(".json")) return true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

TEST(EditorSheet, is_asked_about_before_it_is_lost_and_comes_back_after_a_crash) {
    const Folder home;
    start_small(home, 640, 360);
    Comparison one;
    one.rows = {{.preset = "-"}};
    one.columns = {{.environment = "furnace"}};
    save_comparison(home / "one.json", one);
    save_comparison(home / "two.json", one);
    const std::string turned = "wait idle\ndrop \"" + (home / "one.json").string() + R"("
wait until sheet_views=1
click sheet.view.1
key shift+right
wait until sheet_unsaved=yes
)";
    EXPECT_DRIVEN(drive(home, turned + "drop \"" + (home / "two.json").string() + R"("
wait until unsaved=asked
click unsaved.cancel
wait idle
expect sheet_file~one.json
expect sheet_rotations=5
close
wait until unsaved=asked
click unsaved.save
)"));
    EXPECT_FLOAT_EQ(load_comparison(home / "one.json").comparison.columns[0].rotation_deg, 5.0f);
    Program crashing(home, drive_arguments(home, turned + "wait 300 seconds\n"));
    ASSERT_TRUE(wait_for_kept_work(home / "state")) << crashing.wait().errors;
    crashing.kill();
    EXPECT_DRIVEN(drive(home, R"(
wait until recovery=asked
click recovery.recover
wait idle
expect sheet_rotations=10
expect sheet_file~one.json
expect sheet_unsaved=yes
close
wait until unsaved=asked
click unsaved.discard
)"));
    EXPECT_FLOAT_EQ(load_comparison(home / "one.json").comparison.columns[0].rotation_deg, 5.0f);
}

TEST(EditorSheet, a_missing_preset_is_said_in_its_view_and_the_others_are_drawn) {
    const Folder home;
    start_small(home, 640, 360);
    Comparison comparison;
    comparison.rows = {{.preset = "gold"}, {.preset = (home / "none.json").string()}};
    comparison.columns = {{.environment = "studio"}};
    save_comparison(home / "sheet.json", comparison);
    EXPECT_DRIVEN(drive(home, "wait idle\ndrop \"" + (home / "sheet.json").string() + R"("
wait until sheet_views=2
wait idle
expect log~none.json
expect views>1
)"));
}

TEST(EditorSheet, what_would_help_is_tried_in_light_that_serves_the_trials) {
    const Folder home;
    start_small(home, 780, 500);
    const auto metal = [](const char* roughness) {
        return std::string(
                   R"({"albedo": {"value": [0.9, 0.9, 0.9]}, "metallic": {"value": 1}, "roughness": {"value": )") +
               roughness + "}}";
    };
    write_text(home / "mirror.json", metal("0"));  // which needs no baked light at all
    write_text(home / "satin.json", metal("0.2"));
    Program photo(home, {"render", (home / "satin.json").string(), "-o", (home / "shot.png").string(),
                         "--env", "studio", "--size", "300x300", "--tonemap", "none"});
    EXPECT_DRIVEN(photo.wait());
    write_text(home / "sheet.json",
               R"({"rows": [{"preset": "mirror.json"}], "columns": [{"environment": "studio",
        "tonemap": "none", "photo": {"file": "shot.png", "region": [[0.3, 0.3], [0.7, 0.7]]}}]})");
    EXPECT_DRIVEN(drive(home, "wait idle\ndrop \"" + (home / "sheet.json").string() + R"("
wait until sheet_views=1
click sheet.view.1
wait until photo_hint~roughness
expect photo_hint~"0.19 higher"     # 0.15 in the light of the mirror alone
)"));
}

TEST(EditorSheet, a_photo_is_balanced_by_a_card_fitted_by_points_and_saved) {
    const Folder home;
    start_small(home, 780, 360);
    write_picture(home / "shot.png", 118, 118, 100);
    EXPECT_DRIVEN(drive(home, R"(
wait idle
key c
wait idle
click sheet.view.1
click compare.photo.choose
wait until item browser.entry.shot.png
click browser.entry.shot.png
click browser.confirm
wait idle
expect photo_opacity=1
expect photo_exposure=0
expect photo_delta_e>0
click compare.photo.grey
wait idle
click sheet.view.1          # the photo lies in the middle of the view
wait idle
expect photo_exposure!=0
expect status~card
click compare.photo.fit
wait idle
drag sheet.point.1 -12 -8
wait idle
click compare.photo.fit
wait idle
expect no item sheet.point.1
expect undo~Photo
click compare.photo.region
wait idle
drag sheet.view.1 40 40
wait idle
click compare.save
wait until item browser.file_name
click browser.confirm
wait until sheet_file~comparison.json
wait idle
)"));
    const Comparison saved = load_comparison(home / "comparison.json").comparison;
    ASSERT_TRUE(saved.columns[0].photo);
    const Photo& photo = *saved.columns[0].photo;
    EXPECT_EQ(photo.file, (home / "shot.png").lexically_normal().string());
    EXPECT_NEAR(luminance(photo.white_balance), 1.0f, 0.02f) << "exposure alone carries the brightness";
    EXPECT_GT(photo.white_balance.z, photo.white_balance.x) << "the card was yellowish";
    ASSERT_TRUE(photo.fit);
    EXPECT_LT(photo.fit->photo[0].x, 1.0f - photo.fit->photo[2].x) << "drawn outwards from a square";
    ASSERT_TRUE(photo.region);
    EXPECT_LT(photo.region->x0, photo.region->x1);
    EXPECT_FALSE(saved.columns[1].photo);
}

// ---- the panels alone ----

using ui::Stage;

void show_sheet_of(Stage& stage, std::size_t rows, std::size_t columns) {
    stage.sheet = Comparison{};
    stage.sheet->rows.resize(rows);
    stage.sheet->columns.resize(columns);
    stage.sheet_cells.assign(rows * columns, {.preset = "Émail très foncé, a long name", .light = "Studio"});
    stage.ui.right_tab = "sheet";
    stage.frames(3);
}

TEST(SheetPanel, a_single_row_or_column_wraps_before_its_views_become_slits) {
    for (const auto& [rows, columns] : {std::pair{1, 16}, std::pair{16, 1}, std::pair{1, 9}}) {
        Stage stage;
        show_sheet_of(stage, std::size_t(rows), std::size_t(columns));
        for (int view = 1; view <= rows * columns; ++view) {
            const ui::Rect rect = stage.item("sheet.view." + std::to_string(view)).rect;
            EXPECT_GT(rect.width(), 0.4f * rect.height()) << rows << " rows, view " << view;
            EXPECT_GT(rect.height(), 0.4f * rect.width()) << rows << " rows, view " << view;
        }
    }
    Stage grid;  // presets below each other, lights beside each other
    show_sheet_of(grid, 2, 8);
    EXPECT_EQ(grid.item("sheet.view.1").rect.y0, grid.item("sheet.view.8").rect.y0);
    EXPECT_EQ(grid.item("sheet.view.1").rect.x0, grid.item("sheet.view.9").rect.x0);
}

TEST(SheetPanel, its_texts_keep_their_labels) {
    Stage stage;
    show_sheet_of(stage, 1, 2);
    stage.sheet->title = "Metals";
    stage.frames(2);
    for (const char* field : {"compare.title", "compare.author", "compare.remarks", "compare.light_title"})
        EXPECT_TRUE(stage.has(std::string(field) + ".label")) << field;
}

TEST(SheetPanel, a_light_gets_a_shading_mode_of_its_own_and_gives_it_up) {
    Stage stage;
    show_sheet_of(stage, 1, 2);
    stage.click("compare.own_shading");
    EXPECT_EQ(stage.sheet->columns[0].shading, stage.view.shading);
    EXPECT_FALSE(stage.sheet->columns[1].shading);
    stage.click("compare.own_shading");
    EXPECT_FALSE(stage.sheet->columns[0].shading);
}

TEST(SheetPanel, offers_to_start_where_no_sheet_is_shown) {
    Stage stage;
    stage.ui.right_tab = "sheet";
    stage.frames(2);
    stage.click("compare.start");
    const auto* asked = stage.asked<ui::request::ShowSheet>();
    ASSERT_TRUE(asked);
    EXPECT_TRUE(asked->shown);
}

}  // namespace
}  // namespace patina

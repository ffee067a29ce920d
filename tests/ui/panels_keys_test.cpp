#include "tests/ui/panels_stage.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace patina::ui {
namespace {

void press(Stage& stage, const Shortcut& shortcut) {
    stage.key(shortcut.key, (shortcut.modifiers & ModCommand) != 0, (shortcut.modifiers & ModShift) != 0);
}

const Shortcut& shortcut_of(Action action) {
    for (const Shortcut& shortcut : kShortcuts)
        if (shortcut.action == action) return shortcut;
    ADD_FAILURE() << "an action without a row";
    return kShortcuts[0];
}

template <class T>
void expect_key_asks(Action action) {
    Stage stage;
    stage.status = {
        .title = "Gold", .file = "/p/gold.json", .dirty = true, .can_undo = true, .can_redo = true};
    press(stage, shortcut_of(action));
    EXPECT_TRUE(stage.asked<T>()) << shortcut_of(action).title;
}

}  // namespace

TEST(Shortcuts, no_key_has_two_meanings) {
    std::set<std::pair<int, int>> seen;
    for (const Shortcut& shortcut : kShortcuts) {
        if (shortcut.key == KeyNone) continue;
        EXPECT_TRUE(seen.insert({shortcut.key, shortcut.modifiers}).second) << shortcut.title;
    }
}

TEST(Shortcuts, every_row_says_what_it_does_in_one_sentence) {
    for (const Shortcut& shortcut : kShortcuts) {
        EXPECT_FALSE(shortcut.title.empty());
        ASSERT_FALSE(shortcut.description.empty()) << shortcut.title;
        EXPECT_EQ(shortcut.description.back(), '.') << shortcut.title;
        EXPECT_TRUE(shortcut.key != KeyNone || shortcut.menu != Menu::None)
            << shortcut.title << " cannot be reached";
    }
}

TEST(Shortcuts, are_written_as_the_keyboard_says) {
    EXPECT_EQ(key_text(shortcut_of(Action::SaveAs), false), "Ctrl+Shift+S");
    EXPECT_EQ(key_text(shortcut_of(Action::SaveAs), true), "⌘⇧S");
    EXPECT_EQ(key_text(shortcut_of(Action::OrbitLeft), false), "←");
    EXPECT_EQ(key_text(shortcut_of(Action::Revert), false), "");
}

TEST(Shortcuts, ask_for_what_they_name) {
    expect_key_asks<request::New>(Action::New);
    expect_key_asks<request::Save>(Action::Save);
    expect_key_asks<request::Quit>(Action::Quit);
    expect_key_asks<request::Undo>(Action::Undo);
    expect_key_asks<request::Redo>(Action::Redo);
    expect_key_asks<request::ListFolder>(Action::Open);
    expect_key_asks<request::ListFolder>(Action::SaveAs);
    expect_key_asks<request::ListFolder>(Action::ImportMaps);
    expect_key_asks<request::ListFolder>(Action::ExportRender);
}

TEST(Shortcuts, ctrl_y_is_redo_as_well) {
    Stage stage;
    stage.status.can_redo = true;
    stage.key('Y', true);
    EXPECT_TRUE(stage.asked<request::Redo>());
}

TEST(Shortcuts, undo_is_asked_for_once_a_press_and_only_if_there_is_something) {
    Stage stage;
    stage.key('Z', true);
    EXPECT_FALSE(stage.asked<request::Undo>());
    stage.status.can_undo = true;
    stage.modifiers(true, false);
    ImGui::GetIO().KeysDown['Z'] = true;
    stage.frames(60);
    ImGui::GetIO().KeysDown['Z'] = false;
    EXPECT_EQ(stage.requests.size(), 1u);
}

TEST(Shortcuts, arrows_orbit_plus_and_minus_zoom_f_frames_home_resets) {
    Stage stage;
    stage.key(KeyLeft);
    EXPECT_GT(stage.camera.yaw_deg, 0.0f);
    stage.key(KeyUp);
    EXPECT_GT(stage.camera.pitch_deg, 0.0f);
    stage.key(KeyEqual);
    EXPECT_LT(stage.camera.distance, stage.home_camera.distance);
    stage.camera.target = {1, 1, 1};
    const float yaw = stage.camera.yaw_deg;
    stage.key('F');
    EXPECT_EQ(stage.camera.target, stage.home_camera.target);
    EXPECT_EQ(stage.camera.distance, stage.home_camera.distance);
    EXPECT_EQ(stage.camera.yaw_deg, yaw);
    stage.key(KeyHome);
    EXPECT_EQ(stage.camera, stage.home_camera);
}

TEST(Shortcuts, a_held_arrow_goes_on_turning) {
    Stage stage;
    stage.key(KeyLeft);
    const float once = stage.camera.yaw_deg;
    ImGui::GetIO().KeysDown[KeyLeft] = true;
    stage.frames(60);
    ImGui::GetIO().KeysDown[KeyLeft] = false;
    EXPECT_GT(stage.camera.yaw_deg, 5.0f * once);
}

TEST(Shortcuts, digits_choose_the_debug_view) {
    Stage stage;
    stage.key('3');
    EXPECT_EQ(stage.view.debug, DebugView::Roughness);
    stage.key('0');
    EXPECT_EQ(stage.view.debug, DebugView::UvChecker);
    stage.key('1');
    EXPECT_EQ(stage.view.debug, DebugView::Final);
}

TEST(Shortcuts, step_through_environments_meshes_and_modes) {
    Stage stage;
    stage.key(KeyPageDown);
    EXPECT_EQ(stage.environment, "sky");
    stage.key(KeyPageUp);
    stage.key(KeyPageUp);
    EXPECT_EQ(stage.environment, stage.catalog.environments.back().id);
    stage.key('M');
    EXPECT_EQ(stage.mesh, "quad");
    stage.key('T');
    EXPECT_EQ(stage.view.tonemap, Tonemap::Aces);
    stage.key('B');
    EXPECT_EQ(stage.view.background, Background::Blurred);
    stage.key('S');
    EXPECT_NE(stage.view.shading, View{}.shading);
    stage.key(KeyPeriod);
    EXPECT_EQ(stage.view.exposure_ev, 0.25f);
    stage.key(KeyRight, false, true);
    EXPECT_GT(stage.view.env_rotation_deg, 0.0f);
}

TEST(Shortcuts, plain_keys_and_undo_belong_to_the_text_that_is_typed) {
    Stage stage;
    stage.status.can_undo = true;
    stage.click("material.name");
    stage.key('3');
    stage.key('F');
    stage.key(KeyLeft);
    stage.key('Z', true);
    EXPECT_EQ(stage.view, View{});
    EXPECT_EQ(stage.camera, Camera{});
    EXPECT_FALSE(stage.asked<request::Undo>());
    stage.key('S', true);
    EXPECT_TRUE(stage.asked<request::Save>()) << "saving is possible at any time";
}

TEST(Shortcuts, question_mark_opens_the_sheet_and_escape_closes_it) {
    Stage stage;
    stage.type("?");
    stage.frames(2);
    EXPECT_TRUE(stage.has("sheet.shortcuts"));
    stage.key(KeyEscape);
    stage.frames(2);
    EXPECT_FALSE(stage.has("sheet.shortcuts"));
}

TEST(Shortcuts, a_click_beside_the_sheet_closes_it) {
    Stage stage;
    stage.key(KeyF1);
    stage.frames(2);
    ASSERT_TRUE(stage.has("sheet.shortcuts"));
    stage.move_to({10.0f, 400.0f});
    stage.button(0, true);
    stage.button(0, false);
    stage.frames(3);
    EXPECT_FALSE(stage.has("sheet.shortcuts"));
}

TEST(Shortcuts, the_sheet_stays_inside_the_window) {
    for (const float scale : {1.0f, 1.5f, 2.0f}) {
        Stage stage(1280, 720, scale);
        stage.ui.show_shortcuts = true;
        stage.frames(4);
        const Rect rect = stage.item("sheet.shortcuts").rect;
        EXPECT_GE(rect.x0, 0.0f);
        EXPECT_GE(rect.y0, 0.0f);
        EXPECT_LE(rect.x1, 1280.0f);
        EXPECT_LE(rect.y1, 720.0f);
    }
}

TEST(Shortcuts, ctrl_f_puts_the_keyboard_into_the_search_field) {
    Stage stage;
    stage.ui.show_library = false;
    stage.frames(2);
    stage.key('F', true);
    stage.frames(2);
    stage.type("gold");
    EXPECT_EQ(stage.ui.search_presets, "gold");
}

TEST(Menus, every_line_of_the_table_is_there_and_acts) {
    Stage stage;
    stage.click("menu.file");
    for (const char* line : {"new", "open_preset", "import_maps", "open_environment", "open_mesh", "save",
                             "save_as", "revert_to_saved", "export_picture", "quit"})
        EXPECT_TRUE(stage.has("menu.file." + std::string(line))) << line;
    stage.click("menu.file.save");
    EXPECT_TRUE(stage.asked<request::Save>());
}

TEST(Menus, name_what_would_be_undone) {
    Stage stage;
    stage.status.can_undo = true;
    stage.status.undo_what = "Roughness";
    stage.click("menu.edit");
    EXPECT_TRUE(stage.item("menu.edit.undo").enabled);
    EXPECT_FALSE(stage.item("menu.edit.redo").enabled);
    stage.click("menu.edit.undo");
    EXPECT_TRUE(stage.asked<request::Undo>());
}

TEST(Menus, reopen_a_recent_file) {
    Stage stage;
    stage.click("menu.file");
    stage.move_to(stage.centre("menu.file.open_recent"));
    stage.frames(30);
    stage.click("menu.file.recent.gold.json");
    ASSERT_TRUE(stage.asked<request::Open>());
    EXPECT_EQ(stage.asked<request::Open>()->file, "/home/ada/materials/gold.json");
}

}  // namespace patina::ui

#include "tests/ui/panels_stage.h"

#include <gtest/gtest.h>

namespace patina::ui {
namespace {

ImportSheet some_import() {
    ImportSheet sheet;
    sheet.title = "rust_coarse_01";
    sheet.rows = {{.file = "/m/rust_diff.jpg",
                   .name = "rust_diff.jpg",
                   .slot = MapSlot::Albedo,
                   .reason = "“diff” is colour."},
                  {.file = "/m/rust_arm.jpg",
                   .name = "rust_arm.jpg",
                   .slot = MapSlot::Roughness,
                   .channel = Channel::G},
                  {.file = "/m/rust_nor_dx.png",
                   .name = "rust_nor_dx.png",
                   .slot = MapSlot::Normal,
                   .convention = NormalConvention::DirectX}};
    return sheet;
}

void open_folder(Stage& stage) {
    stage.browser.folder = "/home/ada";
    stage.browser.entries = {{"maps", "/home/ada/maps", true, 0, ""},
                             {"rust_10.png", "/home/ada/rust_10.png", false, 5, ""},
                             {"rust_2.png", "/home/ada/rust_2.png", false, 5, ""},
                             {"gold.json", "/home/ada/gold.json", false, 5, ""},
                             {"hall.HDR", "/home/ada/hall.HDR", false, 5, ""},
                             {"spot.obj", "/home/ada/spot.obj", false, 5, ""}};
    stage.browser.places = {{"Home", "/home/ada"}, {"Presets", "/p"}};
    stage.frames(3);
}

}  // namespace

TEST(UnsavedQuestion, is_answered_by_its_buttons) {
    using request::Choice;
    const std::array<std::pair<const char*, Choice>, 3> answers{{{"unsaved.save", Choice::Save},
                                                                 {"unsaved.discard", Choice::Discard},
                                                                 {"unsaved.cancel", Choice::Cancel}}};
    for (const auto& [name, choice] : answers) {
        Stage stage;
        stage.unsaved = UnsavedQuestion{"gold", "open Copper"};
        stage.frames(4);
        stage.click(name);
        ASSERT_TRUE(stage.asked<request::AnswerUnsaved>()) << name;
        EXPECT_EQ(stage.asked<request::AnswerUnsaved>()->choice, choice) << name;
    }
}

TEST(UnsavedQuestion, enter_saves_and_escape_cancels) {
    for (const auto& [key, choice] :
         {std::pair{KeyEnter, request::Choice::Save}, {KeyEscape, request::Choice::Cancel}}) {
        Stage stage;
        stage.unsaved = UnsavedQuestion{"gold", "open Copper"};
        stage.frames(4);
        stage.key(key);
        ASSERT_TRUE(stage.asked<request::AnswerUnsaved>());
        EXPECT_EQ(stage.asked<request::AnswerUnsaved>()->choice, choice);
    }
}

TEST(UnsavedQuestion, holds_everything_else_back) {
    Stage stage;
    stage.unsaved = UnsavedQuestion{"gold", "open Copper"};
    stage.frames(4);
    stage.key('O', true);
    stage.key('3');
    stage.click("material.roughness.thumbnail");
    EXPECT_TRUE(stage.requests.empty());
    EXPECT_FALSE(stage.browser.open);
    EXPECT_EQ(stage.view, View{});
}

TEST(UnsavedQuestion, disappears_once_the_app_takes_it_away) {
    Stage stage;
    stage.unsaved = UnsavedQuestion{"gold", "open Copper"};
    stage.frames(4);
    stage.key(KeyEscape);
    stage.unsaved.reset();
    stage.frames(3);
    EXPECT_FALSE(stage.has("panel.question"));
    stage.requests.clear();
    stage.key('S', true);
    EXPECT_TRUE(stage.asked<request::Save>()) << "the keyboard is free again";
}

TEST(UnsavedQuestion, stops_asking_for_frames_when_it_has_faded_in) {
    Stage stage;
    stage.unsaved = UnsavedQuestion{"gold", "open Copper"};
    stage.frames(2);
    EXPECT_TRUE(stage.result.wants_redraw);
    stage.frames(60);
    EXPECT_FALSE(stage.result.wants_redraw);
}

TEST(RecoveryQuestion, enter_recovers_escape_waits_and_only_a_click_throws_away) {
    using request::Recovery;
    for (const auto& [key, recovery] :
         {std::pair{KeyEnter, Recovery::Recover}, {KeyEscape, Recovery::Later}}) {
        Stage stage;
        stage.recovery = RecoveryQuestion{"gold", "today at 14:03"};
        stage.frames(4);
        stage.key(key);
        ASSERT_TRUE(stage.asked<request::AnswerRecovery>());
        EXPECT_EQ(stage.asked<request::AnswerRecovery>()->recovery, recovery);
    }
    Stage stage;
    stage.recovery = RecoveryQuestion{"gold", "today at 14:03"};
    stage.frames(4);
    stage.click("recovery.discard");
    ASSERT_TRUE(stage.asked<request::AnswerRecovery>());
    EXPECT_EQ(stage.asked<request::AnswerRecovery>()->recovery, Recovery::Discard);
}

TEST(ImportSheet, shows_each_decision_and_applies_on_enter) {
    Stage stage;
    stage.import_sheet = some_import();
    stage.frames(4);
    EXPECT_TRUE(stage.has("import.0.slot"));
    EXPECT_TRUE(stage.has("import.1.channel"));
    EXPECT_TRUE(stage.has("import.2.convention"));
    EXPECT_FALSE(stage.has("import.2.channel"));
    stage.key(KeyEnter);
    EXPECT_TRUE(stage.asked<request::ApplyImport>());
}

TEST(ImportSheet, offers_the_mesh_that_lay_with_the_maps) {
    Stage stage;
    stage.import_sheet = some_import();
    stage.frames(4);
    EXPECT_FALSE(stage.has("import.mesh"));
    stage.import_sheet->mesh = "/home/ada/helmet/helmet.obj";
    stage.frames(2);
    EXPECT_TRUE(stage.import_sheet->use_mesh);
    stage.click("import.mesh");
    EXPECT_FALSE(stage.import_sheet->use_mesh);
}

TEST(ImportSheet, lets_a_decision_be_changed) {
    Stage stage;
    stage.import_sheet = some_import();
    stage.frames(4);
    stage.click("import.1.slot");
    stage.frames(2);
    stage.click("import.1.slot.metallic");
    stage.frames(2);
    stage.click("import.1.channel");
    stage.frames(2);
    stage.click("import.1.channel.blue");
    stage.click("import.2.slot");
    stage.frames(2);
    stage.click("import.2.slot.leave_out");
    EXPECT_EQ(stage.import_sheet->rows[1].slot, MapSlot::Metallic);
    EXPECT_EQ(stage.import_sheet->rows[1].channel, Channel::B);
    EXPECT_FALSE(stage.import_sheet->rows[2].slot);
    EXPECT_TRUE(stage.requests.empty());
}

TEST(ImportSheet, escape_closes_an_open_list_first_and_then_cancels) {
    Stage stage;
    stage.import_sheet = some_import();
    stage.frames(4);
    stage.click("import.1.slot");
    stage.frames(2);
    stage.key(KeyEscape);
    EXPECT_FALSE(stage.asked<request::CancelImport>());
    stage.frames(2);
    stage.key(KeyEscape);
    EXPECT_TRUE(stage.asked<request::CancelImport>());
}

TEST(ImportSheet, cannot_apply_when_every_file_is_left_out) {
    Stage stage;
    stage.import_sheet = some_import();
    for (ImportRow& row : stage.import_sheet->rows) row.slot.reset();
    stage.frames(4);
    EXPECT_FALSE(stage.item("import.apply").enabled);
    stage.key(KeyEnter);
    EXPECT_TRUE(stage.requests.empty());
}

TEST(FileBrowser, shows_folders_and_files_of_its_purpose_sorted) {
    Stage stage;
    stage.click("material.albedo.browse");
    open_folder(stage);
    EXPECT_TRUE(stage.has("browser.entry.maps"));
    EXPECT_TRUE(stage.has("browser.entry.rust_2.png"));
    EXPECT_TRUE(stage.has("browser.entry.hall.HDR"));
    EXPECT_FALSE(stage.has("browser.entry.gold.json"));
    EXPECT_LT(stage.item("browser.entry.maps").rect.y0, stage.item("browser.entry.hall.HDR").rect.y0);
    EXPECT_LT(stage.item("browser.entry.rust_2.png").rect.y0,
              stage.item("browser.entry.rust_10.png").rect.y0);
    stage.click("browser.show_all");
    EXPECT_TRUE(stage.has("browser.entry.gold.json"));
}

TEST(FileBrowser, assigns_the_chosen_map) {
    Stage stage;
    stage.click("material.roughness.browse");
    open_folder(stage);
    EXPECT_FALSE(stage.item("browser.confirm").enabled);
    stage.click("browser.entry.rust_2.png");
    stage.click("browser.confirm");
    const auto* assign = stage.asked<request::AssignMap>();
    ASSERT_TRUE(assign);
    EXPECT_EQ(assign->slot, MapSlot::Roughness);
    EXPECT_EQ(assign->file, "/home/ada/rust_2.png");
    EXPECT_FALSE(stage.browser.open);
}

TEST(FileBrowser, a_double_click_enters_folders_and_takes_files) {
    Stage stage;
    stage.click("material.roughness.browse");
    open_folder(stage);
    stage.requests.clear();
    stage.double_click("browser.entry.maps");
    ASSERT_TRUE(stage.asked<request::ListFolder>());
    EXPECT_EQ(stage.asked<request::ListFolder>()->folder, "/home/ada/maps");
    stage.double_click("browser.entry.rust_10.png");
    EXPECT_TRUE(stage.asked<request::AssignMap>());
}

TEST(FileBrowser, is_driven_by_the_keyboard_too) {
    Stage stage;
    stage.key('O', true);
    open_folder(stage);
    stage.requests.clear();
    stage.key(KeyDown);
    stage.key(KeyDown);
    EXPECT_EQ(stage.browser.selected, "/home/ada/gold.json");
    stage.key(KeyEnter);
    ASSERT_TRUE(stage.asked<request::Open>());
    EXPECT_EQ(stage.asked<request::Open>()->file, "/home/ada/gold.json");
    stage.requests.clear();
    stage.key('O', true);
    stage.frames(2);
    stage.key(KeyBackspace);
    EXPECT_EQ(std::get<request::ListFolder>(stage.requests.back()).folder, "/home");
    stage.key(KeyEscape);
    EXPECT_FALSE(stage.browser.open);
    EXPECT_EQ(stage.camera, Camera{}) << "the arrows moved the selection, not the camera";
}

TEST(FileBrowser, saving_adds_the_extension_and_says_when_it_replaces) {
    Stage stage;
    stage.material.name = "copper/green";
    stage.key('S', true, true);
    open_folder(stage);
    EXPECT_EQ(stage.browser.file_name, "copper-green");
    stage.click("browser.confirm");
    ASSERT_TRUE(stage.asked<request::SaveAs>());
    EXPECT_EQ(stage.asked<request::SaveAs>()->file, "/home/ada/copper-green.json");

    Stage again;
    again.key('S', true, true);
    open_folder(again);
    const std::string before = again.item("browser.confirm").tooltip;
    again.click("browser.entry.gold.json");
    again.frames(2);
    EXPECT_NE(again.item("browser.confirm").tooltip, before);
    again.click("browser.confirm");
    EXPECT_EQ(again.asked<request::SaveAs>()->file, "/home/ada/gold.json");
}

TEST(FileBrowser, a_path_typed_as_the_name_shows_its_folder_before_anything_is_written) {
    for (const auto& [typed, folder] :
         {std::pair{"/tmp/new/copper.json", "/tmp/new"}, std::pair{"~/copper.json", "~"},
          std::pair{"sub/copper.json", "/home/ada/sub"}, std::pair{"/copper.json", "/"}}) {
        Stage stage;
        stage.key('S', true, true);
        open_folder(stage);
        stage.requests.clear();
        stage.click("browser.file_name");
        stage.key('A', true);
        stage.type(typed);
        stage.key(KeyEnter);
        ASSERT_TRUE(stage.asked<request::ListFolder>()) << typed;
        EXPECT_EQ(stage.asked<request::ListFolder>()->folder, folder);
        EXPECT_FALSE(stage.asked<request::SaveAs>()) << typed;
        EXPECT_EQ(stage.browser.file_name, "copper.json");
        stage.browser.folder = "/there";
        stage.click("browser.confirm");
        ASSERT_TRUE(stage.asked<request::SaveAs>()) << typed;
        EXPECT_EQ(stage.asked<request::SaveAs>()->file, "/there/copper.json");
    }
}

TEST(FileBrowser, makes_a_folder_where_something_is_saved_and_saves_nothing_by_it) {
    Stage stage;
    stage.key('S', true, true);
    open_folder(stage);
    stage.click("browser.new_folder");
    stage.frames(3);
    stage.type("rocks");
    stage.key(KeyEnter);
    ASSERT_TRUE(stage.asked<request::MakeFolder>());
    EXPECT_EQ(stage.asked<request::MakeFolder>()->folder, "/home/ada/rocks");
    EXPECT_FALSE(stage.asked<request::SaveAs>());
    EXPECT_TRUE(stage.browser.open);

    Stage opening;
    opening.key('O', true);
    open_folder(opening);
    EXPECT_FALSE(opening.has("browser.new_folder"));
}

TEST(FileBrowser, exports_a_picture_of_the_chosen_size) {
    Stage stage;
    stage.key('E', true);
    open_folder(stage);
    stage.click("browser.width");
    stage.key('A', true);
    stage.type("640");
    stage.key(KeyTab);
    stage.frames(2);
    stage.browser.file_name = "shot.exr";
    stage.frames(2);
    stage.click("browser.confirm");
    const auto* render = stage.asked<request::ExportRender>();
    ASSERT_TRUE(render);
    EXPECT_EQ(render->file, "/home/ada/shot.exr");
    EXPECT_EQ(render->width, 640);
    EXPECT_EQ(render->height, 1080);
}

TEST(FileBrowser, imports_the_folder_it_stands_in_or_the_chosen_one) {
    Stage stage;
    stage.key('I', true);
    open_folder(stage);
    stage.click("browser.confirm");
    ASSERT_TRUE(stage.asked<request::ImportMaps>());
    EXPECT_EQ(stage.asked<request::ImportMaps>()->files, std::vector<std::string>{"/home/ada"});
    Stage other;
    other.key('I', true);
    open_folder(other);
    other.click("browser.entry.maps");
    other.click("browser.confirm");
    EXPECT_EQ(other.asked<request::ImportMaps>()->files, std::vector<std::string>{"/home/ada/maps"});
}

TEST(FileBrowser, says_why_a_folder_cannot_be_read_and_lets_another_be_typed) {
    Stage stage;
    stage.key('O', true);
    open_folder(stage);
    stage.browser.error = "/home/ada may not be read.";
    stage.frames(2);
    stage.requests.clear();
    stage.click("browser.folder");
    stage.key('A', true);
    stage.type("/tmp");
    stage.key(KeyEnter);
    ASSERT_TRUE(stage.asked<request::ListFolder>());
    EXPECT_EQ(stage.asked<request::ListFolder>()->folder, "/tmp");
    EXPECT_TRUE(stage.browser.open);
}

TEST(FileBrowser, goes_to_a_place) {
    Stage stage;
    stage.key('O', true);
    open_folder(stage);
    stage.requests.clear();
    stage.click("browser.place.Presets");
    ASSERT_TRUE(stage.asked<request::ListFolder>());
    EXPECT_EQ(stage.asked<request::ListFolder>()->folder, "/p");
}

}  // namespace patina::ui

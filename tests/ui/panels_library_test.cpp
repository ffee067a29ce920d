#include "tests/ui/panels_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace patina::ui {

TEST(Library, a_click_on_a_preset_opens_it) {
    Stage stage;
    stage.click("library.presets.Copper");
    ASSERT_TRUE(stage.asked<request::Open>());
    EXPECT_EQ(stage.asked<request::Open>()->file, "/p/copper.json");
}

TEST(Library, a_click_on_an_environment_or_a_mesh_takes_it) {
    Stage stage;
    stage.click("library.environments");
    stage.frames(2);
    stage.click("library.environments.Night");
    EXPECT_EQ(stage.environment, "night");
    stage.click("library.meshes");
    stage.frames(2);
    stage.click("library.meshes.Shader ball");
    EXPECT_EQ(stage.mesh, "shaderball");
    EXPECT_TRUE(stage.requests.empty());
}

TEST(Library, the_search_leaves_what_matches_title_group_or_description) {
    Stage stage;
    stage.click("library.presets.search");
    stage.type("metal pol");
    EXPECT_TRUE(stage.has("library.presets.Gold"));
    EXPECT_TRUE(stage.has("library.presets.Copper"));
    EXPECT_FALSE(stage.has("library.presets.Iron"));
    EXPECT_FALSE(stage.has("library.presets.Rubber"));
    stage.click("library.presets.search.clear");
    stage.frames(2);
    EXPECT_EQ(stage.ui.search_presets, "");
    EXPECT_TRUE(stage.has("library.presets.Rubber"));
}

TEST(Library, each_tab_remembers_its_own_search) {
    Stage stage;
    stage.click("library.presets.search");
    stage.type("gold");
    stage.click("library.meshes");
    stage.frames(2);
    EXPECT_TRUE(stage.has("library.meshes.Quad"));
    EXPECT_EQ(stage.ui.search_meshes, "");
}

TEST(Library, tells_which_cards_are_seen) {
    Stage stage(1280.0f, 420.0f);
    for (int i = 0; i < 60; ++i)
        stage.catalog.presets.push_back({.id = "p" + std::to_string(i), .title = "P"});
    stage.frames(2);
    const auto sees = [&](const std::string& id) {
        return std::ranges::find(stage.result.cards_seen, id) != stage.result.cards_seen.end();
    };
    EXPECT_EQ(stage.result.shelf, "library.presets");
    EXPECT_TRUE(sees(stage.catalog.presets.front().id));
    EXPECT_FALSE(sees("p59"));
    stage.ui.left_tab = "meshes";
    stage.frames(2);
    EXPECT_EQ(stage.result.shelf, "library.meshes");
    EXPECT_TRUE(sees("shaderball"));
    stage.ui.show_library = false;
    stage.frames(2);
    EXPECT_TRUE(stage.result.cards_seen.empty());
}

TEST(Library, says_that_there_is_no_preset_only_once_that_is_known) {
    Stage stage;
    stage.catalog.presets.clear();
    const auto drawn = [&](bool are_read) {
        stage.catalog.presets_are_read = are_read;
        stage.frames(2);
        return ImGui::GetDrawData()->TotalVtxCount;
    };
    EXPECT_LT(drawn(false), drawn(true));
}

TEST(Library, its_buttons_browse_for_files) {
    Stage stage;
    stage.ui.left_tab = "environments";
    stage.frames(2);
    stage.click("library.environments.open");
    EXPECT_TRUE(stage.browser.open);
    EXPECT_EQ(stage.browser.purpose, BrowserPurpose::OpenEnvironment);
}

TEST(Library, copes_with_nothing_and_with_very_much) {
    Stage stage;
    stage.catalog = {};
    for (const char* tab : {"presets", "environments", "meshes"}) {
        stage.ui.left_tab = tab;
        stage.frames(2);
    }
    for (int i = 0; i < 500; ++i)
        stage.catalog.presets.push_back(
            {"/p/" + std::to_string(i), "Preset " + std::to_string(i), "", "Group"});
    stage.ui.left_tab = "presets";
    stage.frames(3);
    EXPECT_TRUE(stage.has("library.presets.Preset 499"));
}

TEST(Library, shows_pages_that_a_part_adds) {
    Stage stage;
    int drawn = 0;
    stage.panels.push_back(
        {"notes", "Notes", "A page of a plug-in.", Side::Right, [&](PanelContext&) { ++drawn; }});
    stage.frames(2);
    EXPECT_EQ(drawn, 0);
    stage.click("inspector.notes");
    stage.frames(2);
    EXPECT_GT(drawn, 0);
}

TEST(StatusLine, cancels_the_job_it_shows) {
    Stage stage;
    EXPECT_FALSE(stage.has("status.cancel"));
    stage.status.jobs = {{7, "Baking studio", 0.4f}};
    stage.frames(2);
    stage.click("status.cancel");
    ASSERT_TRUE(stage.asked<request::CancelJob>());
    EXPECT_EQ(stage.asked<request::CancelJob>()->id, 7u);
    EXPECT_TRUE(stage.ui.drawer.empty()) << "the cross is not the line";
}

TEST(StatusLine, opens_and_closes_the_log) {
    Stage stage;
    stage.click("status");
    stage.frames(2);
    EXPECT_EQ(stage.ui.drawer, "log");
    EXPECT_TRUE(stage.has("panel.drawer"));
    stage.click("drawer.close");
    stage.frames(2);
    EXPECT_FALSE(stage.has("panel.drawer"));
}

TEST(StatusLine, counts_problems_until_they_were_seen) {
    Stage stage;
    stage.status.log = {{Severity::Info, "Ready.", "14:00:00"},
                        {Severity::Warning, "a.png is missing.", "14:00:01"}};
    stage.frames(2);
    EXPECT_TRUE(stage.has("status.notes"));
    stage.click("status.notes");
    stage.frames(2);
    EXPECT_EQ(stage.ui.drawer, "log");
    EXPECT_FALSE(stage.has("status.notes"));
    stage.key(KeyEscape);
    stage.status.log.push_back({Severity::Error, "b.png is broken.", "14:00:02"});
    stage.frames(2);
    EXPECT_TRUE(stage.has("status.notes"));
}

TEST(Log, is_copied_and_cleared) {
    Stage stage;
    stage.status.log = {{Severity::Info, "Saved gold.json.", "14:00:00"}};
    stage.ui.drawer = "log";
    stage.frames(2);
    stage.click("log.copy");
    ASSERT_TRUE(stage.asked<request::CopyText>());
    EXPECT_NE(stage.asked<request::CopyText>()->text.find("Saved gold.json."), std::string::npos);
    stage.click("log.clear");
    EXPECT_TRUE(stage.asked<request::ClearLog>());
}

}  // namespace patina::ui

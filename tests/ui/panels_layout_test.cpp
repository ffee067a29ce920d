#include "tests/ui/panels_stage.h"
#include "ui/layout.h"
#include "ui/widgets.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <set>

namespace patina::ui {
namespace {

struct Window {
    float width, height, scale;
};
constexpr std::array kWindows{Window{1280, 720, 1.0f},  Window{1920, 1080, 1.0f}, Window{1920, 1080, 1.5f},
                              Window{2560, 1440, 2.0f}, Window{1280, 720, 1.5f},  Window{1280, 720, 2.0f},
                              Window{3840, 2160, 2.0f}, Window{1000, 600, 1.0f}};

std::string text_of(const Window& window) {
    return std::to_string(static_cast<int>(window.width)) + "×" +
           std::to_string(static_cast<int>(window.height)) + " at " + std::to_string(window.scale);
}

void fill_slots(Stage& stage) {
    stage.material.albedo.map = "a_picture_with_a_rather_long_file_name_from_a_scanner.png";
    stage.material.roughness.map = "r.png";
    stage.material.normal.map = "n.png";
    stage.maps[0] = {.state = MapState::Ok, .width = 8192, .height = 8192, .channels = 4, .bits = 16};
    stage.maps[1] = {.state = MapState::Missing,
                     .message = "r.png was not found beside the preset.",
                     .full_path = "/m/r.png"};
    stage.maps[4] = {.state = MapState::Loading};
    stage.status.text = "Saved gold.json";
    stage.status.log = {{Severity::Warning, "r.png was not found beside the preset.", "14:03:07", 3}};
    stage.status.frames_rendered = 123456;
}

void expect_panels_apart(const Stage& stage, const std::string& where) {
    std::vector<std::pair<std::string, Rect>> panels;
    for (const auto& [name, item] : stage.recorder.items)
        if (name.rfind("panel.", 0) == 0) panels.emplace_back(name, item.rect);
    EXPECT_GE(panels.size(), 5u);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const Rect& r = panels[i].second;
        EXPECT_TRUE(r.x0 >= 0 && r.y0 >= 0 && r.x1 <= size.x && r.y1 <= size.y)
            << panels[i].first << " leaves " << where;
        for (std::size_t j = i + 1; j < panels.size(); ++j)
            EXPECT_FALSE(r.overlaps(panels[j].second))
                << panels[i].first << " over " << panels[j].first << ", " << where;
    }
}

/// Nothing sticks out of its panel sideways, and no text of our own is cut.
void expect_nothing_clipped(const Stage& stage, const std::string& where) {
    for (const auto& [name, item] : stage.recorder.items) {
        EXPECT_GE(item.rect.x0, item.panel.x0 - 0.5f) << name << ", " << where;
        EXPECT_LE(item.rect.x1, item.panel.x1 + 0.5f) << name << ", " << where;
        EXPECT_EQ(item.missing_width, 0.0f) << name << ", " << where;
    }
}

}  // namespace

TEST(Layout, covers_the_window_without_gaps_or_overlaps) {
    for (const Window& window : kWindows) {
        UiState ui;
        ui.drawer = "log";
        const auto bar = [](float) { return 32.0f; };
        const Layout l = compute_layout(ui, {window.width, window.height, window.scale, 26.0f, 28.0f, bar});
        float area = 0.0f;
        for (const Rect& r : {l.menu, l.library, l.toolbar, l.viewport, l.inspector, l.drawer, l.status,
                              l.library_splitter, l.inspector_splitter, l.drawer_splitter}) {
            EXPECT_GE(r.width(), 0.0f);
            EXPECT_GE(r.height(), 0.0f);
            area += r.width() * r.height();
        }
        EXPECT_NEAR(area, window.width * window.height, 1.0f) << text_of(window);
    }
}

TEST(Layout, panels_do_not_overlap_and_nothing_is_cut_off) {
    for (const Window& window : kWindows) {
        Stage stage(window.width, window.height, window.scale);
        fill_slots(stage);
        for (const char* tab : {"material", "light", "view"}) {
            stage.ui.right_tab = tab;
            stage.frames(2);
            expect_panels_apart(stage, text_of(window) + " " + tab);
            expect_nothing_clipped(stage, text_of(window) + " " + tab);
        }
        for (const char* tab : {"presets", "environments", "meshes"}) {
            stage.ui.left_tab = tab;
            stage.ui.drawer = "log";
            stage.frames(2);
            expect_panels_apart(stage, text_of(window) + " " + tab);
            expect_nothing_clipped(stage, text_of(window) + " " + tab);
        }
        stage.browser.open = true;
        stage.frames(2);
        expect_panels_apart(stage, text_of(window) + " browser");
        expect_nothing_clipped(stage, text_of(window) + " browser");
    }
}

TEST(Layout, status_line_says_everything_that_runs_without_leaving_the_window) {
    for (const Window& window : kWindows) {
        Stage stage(window.width, window.height, window.scale);
        fill_slots(stage);
        stage.status.jobs = {{1, "Baking peppermint_powerplant_4k", 0.42f}, {2, "Loading spot.obj", -1.0f}};
        stage.frames(2);
        expect_nothing_clipped(stage, text_of(window));
        EXPECT_GT(stage.item("status.cancel").visible.width(), 0.0f) << text_of(window);
    }
}

TEST(Layout, hidden_side_panels_give_their_room_to_the_picture) {
    Stage stage;
    const int narrow = stage.result.viewport_size_px.x;
    stage.ui.show_library = stage.ui.show_inspector = false;
    stage.frames(2);
    EXPECT_GT(stage.result.viewport_size_px.x, narrow + 500);
    EXPECT_EQ(stage.result.viewport_size_px.x, 1280);
    EXPECT_FALSE(stage.has("panel.library"));
}

TEST(Layout, a_splitter_makes_its_panel_wider) {
    Stage stage;
    const float before = stage.item("panel.inspector").rect.width();
    stage.drag("splitter.inspector", {-60.0f, 0.0f});
    EXPECT_NEAR(stage.item("panel.inspector").rect.width(), before + 60.0f, 1.5f);
    stage.drag("splitter.inspector", {900.0f, 0.0f});
    EXPECT_GE(stage.item("panel.inspector").rect.width(), 300.0f) << "but never too narrow for its rows";
}

TEST(Layout, asks_for_a_picture_of_the_viewports_size_in_framebuffer_pixels) {
    Stage stage;
    const Rect viewport = stage.item("panel.viewport").rect;
    ImGui::GetIO().DisplayFramebufferScale = {2.0f, 2.0f};
    stage.frame();
    EXPECT_EQ(stage.result.viewport_size_px.x, static_cast<int>(2.0f * viewport.width()));
    EXPECT_EQ(stage.result.viewport_size_px.y, static_cast<int>(2.0f * viewport.height()));
}

TEST(Layout, survives_a_window_that_is_almost_nothing) {
    Stage stage;
    for (const ImVec2 size : {ImVec2{1, 1}, ImVec2{40, 3000}, ImVec2{3000, 20}, ImVec2{200, 100}}) {
        ImGui::GetIO().DisplaySize = size;
        stage.ui.drawer = stage.ui.drawer.empty() ? "log" : "";
        stage.frames(3);
    }
}

TEST(Theme, fonts_hold_the_characters_that_names_are_made_of) {
    const Stage stage;
    const std::u32string needed = U"AZaz09 éßŁőğñ ÆØÅ ΩμβαΔ ЖяЦ Ễ −×·°…→←↑↓“”‘’–—≤≥≈²³€";
    for (const Face face : {Face::Body, Face::Strong, Face::Small})
        for (const char32_t c : needed)
            EXPECT_TRUE(font_of(face)->FindGlyphNoFallback(static_cast<ImWchar>(c)))
                << "U+" << std::hex << std::uint32_t(c);
}

TEST(Theme, icons_are_in_every_face) {
    const Stage stage;
    for (const Face face : {Face::Body, Face::Strong, Face::Small, Face::Title})
        for (const int icon : {0xf115, 0xf00d, 0xf002, 0xf071, 0xf1b2, 0xf185})
            EXPECT_TRUE(font_of(face)->FindGlyphNoFallback(static_cast<ImWchar>(icon))) << std::hex << icon;
}

TEST(Theme, text_grows_with_the_scale) {
    float width = 0.0f;
    {
        const Stage stage(1280, 720, 1.0f);
        width = ImGui::CalcTextSize("Roughness").x;
    }
    const Stage stage(2560, 1440, 2.0f);
    EXPECT_NEAR(ImGui::CalcTextSize("Roughness").x, 2.0f * width, 6.0f);
    EXPECT_EQ(px(100), 200.0f);
}

TEST(Redraw, nothing_moves_by_itself_in_an_idle_window) {
    Stage stage;
    stage.move_to({5.0f, 300.0f});
    stage.frames(60);
    EXPECT_FALSE(stage.result.wants_redraw);
    stage.status.jobs = {{1, "Loading", -1.0f}};
    stage.frames(3);
    EXPECT_FALSE(stage.result.wants_redraw) << "progress comes with the job's own events";
}

TEST(Redraw, a_tooltip_on_its_way_asks_for_the_one_frame_that_shows_it) {
    Stage stage;
    stage.move_to(stage.centre("material.roughness.bar"));
    stage.frames(2);
    EXPECT_FALSE(stage.result.wants_redraw);
    EXPECT_GT(stage.result.redraw_in_s, 0.3);
    EXPECT_LT(stage.result.redraw_in_s, 0.5);
    stage.frames(60);
    EXPECT_FALSE(stage.result.wants_redraw);
    EXPECT_TRUE(std::isinf(stage.result.redraw_in_s));
}

TEST(Names, sort_as_people_count) {
    EXPECT_TRUE(natural_less("rust_2.png", "rust_10.png"));
    EXPECT_FALSE(natural_less("rust_10.png", "rust_2.png"));
    EXPECT_TRUE(natural_less("a.png", "B.png"));
    EXPECT_TRUE(natural_less("a", "a1"));
    EXPECT_FALSE(natural_less("a", "A"));
    EXPECT_FALSE(natural_less("007", "7"));
}

TEST(Names, are_found_by_any_of_their_words) {
    EXPECT_TRUE(matches_search("Brushed Aluminium", "alu"));
    EXPECT_TRUE(matches_search("Brushed Aluminium", "alu BRU"));
    EXPECT_TRUE(matches_search("Brushed Aluminium", ""));
    EXPECT_TRUE(matches_search("Brushed Aluminium", "  alu  "));
    EXPECT_FALSE(matches_search("Brushed Aluminium", "alu gold"));
}

TEST(Names, sizes_read_like_in_a_file_manager) {
    EXPECT_EQ(bytes_text(0), "0 B");
    EXPECT_EQ(bytes_text(999), "999 B");
    EXPECT_EQ(bytes_text(1234), "1.2 kB");
    EXPECT_EQ(bytes_text(5'400'000), "5.4 MB");
    EXPECT_EQ(bytes_text(999'999'999), "1.0 GB");
    EXPECT_EQ(file_name_of("/a/b/c.png"), "c.png");
    EXPECT_EQ(file_name_of("c.png"), "c.png");
}

}  // namespace patina::ui

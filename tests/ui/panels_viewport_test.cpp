#include "tests/ui/panels_stage.h"
#include "ui/navigation.h"

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace patina::ui {
namespace {

glm::vec2 on_screen(const Camera& camera, const glm::vec3& point, glm::vec2 size) {
    const glm::vec4 clip =
        projection_matrix(camera, size.x / size.y) * view_matrix(camera) * glm::vec4(point, 1.0f);
    return {(clip.x / clip.w * 0.5f + 0.5f) * size.x, (0.5f - clip.y / clip.w * 0.5f) * size.y};
}

}  // namespace

TEST(ViewportMouse, left_drag_orbits_and_the_near_side_follows_the_mouse) {
    Stage stage;
    stage.drag("viewport", {50.0f, 0.0f});
    EXPECT_LT(stage.camera.yaw_deg, 0.0f);
    EXPECT_EQ(stage.camera.target, glm::vec3(0.0f));
    EXPECT_EQ(stage.view, View{});
    const glm::vec2 size{680.0f, 640.0f};
    EXPECT_GT(on_screen(stage.camera, {0, 0, 1}, size).x, on_screen(Camera{}, {0, 0, 1}, size).x);
    Stage down;
    down.drag("viewport", {0.0f, 50.0f});
    EXPECT_GT(on_screen(down.camera, {0, 0, 1}, size).y, on_screen(Camera{}, {0, 0, 1}, size).y);
}

TEST(ViewportMouse, orbiting_stops_below_the_poles) {
    Stage stage;
    for (int i = 0; i < 4; ++i) stage.drag("viewport", {0.0f, 250.0f});
    EXPECT_LT(stage.camera.pitch_deg, 90.0f);
    EXPECT_GT(stage.camera.pitch_deg, 89.0f);
}

TEST(ViewportMouse, shift_or_middle_drag_pans_and_the_object_stays_under_the_mouse) {
    for (const int which : {0, 2}) {
        Stage stage;
        stage.camera.yaw_deg = stage.home_camera.yaw_deg = 40.0f;
        stage.camera.pitch_deg = 25.0f;
        const Camera before = stage.camera;
        const Rect rect = stage.item("viewport").rect;
        const glm::vec2 size{rect.width(), rect.height()};
        stage.modifiers(false, which == 0);
        stage.drag("viewport", {60.0f, -35.0f}, which);
        const glm::vec2 moved =
            on_screen(stage.camera, before.target, size) - on_screen(before, before.target, size);
        EXPECT_NEAR(moved.x, 60.0f, 0.5f);
        EXPECT_NEAR(moved.y, -35.0f, 0.5f);
        EXPECT_EQ(stage.camera.yaw_deg, before.yaw_deg);
    }
}

TEST(ViewportMouse, the_wheel_zooms) {
    Stage stage;
    const float before = stage.camera.distance;
    stage.wheel("viewport", 2.0f);
    EXPECT_LT(stage.camera.distance, before);
    stage.wheel("viewport", -2.0f);
    EXPECT_NEAR(stage.camera.distance, before, 1e-4f);
    stage.wheel("viewport", -1000.0f);
    EXPECT_TRUE(std::isfinite(stage.camera.distance));
}

TEST(ViewportMouse, right_drag_ctrl_drag_and_l_drag_turn_the_light_only) {
    for (const int way : {0, 1, 2}) {
        Stage stage;
        if (way == 1) stage.modifiers(true, false);
        if (way == 2) ImGui::GetIO().KeysDown['L'] = true;
        stage.drag("viewport", {40.0f, 0.0f}, way == 0 ? 1 : 0);
        EXPECT_GT(stage.view.env_rotation_deg, 0.0f) << way;
        EXPECT_EQ(stage.camera, Camera{}) << way;
    }
}

TEST(ViewportMouse, a_drag_that_began_on_the_picture_goes_on_outside) {
    Stage stage;
    stage.drag("viewport", {-600.0f, 0.0f});
    EXPECT_NEAR(stage.camera.yaw_deg, wrap_degrees(0.4f * 600.0f), 0.5f);
}

TEST(ViewportMouse, a_drag_that_began_on_a_panel_moves_nothing) {
    Stage stage;
    stage.drag("panel.library", {500.0f, 0.0f});
    EXPECT_EQ(stage.camera, Camera{});
}

TEST(ViewportMouse, a_double_click_goes_home) {
    Stage stage;
    stage.home_camera.yaw_deg = 30.0f;
    stage.camera = {.yaw_deg = 100.0f, .pitch_deg = -20.0f, .distance = 9.0f, .target = {1, 2, 3}};
    stage.double_click("viewport");
    EXPECT_EQ(stage.camera, stage.home_camera);
}

TEST(ViewportMouse, says_when_it_is_being_dragged) {
    Stage stage;
    stage.move_to(stage.centre("viewport"));
    stage.frame();
    EXPECT_FALSE(stage.result.viewport_active);
    stage.button(0, true);
    EXPECT_TRUE(stage.result.viewport_active);
    EXPECT_TRUE(stage.result.item_active);
    stage.button(0, false);
    stage.frame();
    EXPECT_FALSE(stage.result.viewport_active);
}

TEST(Navigation, degrees_wrap_into_a_half_open_turn) {
    EXPECT_FLOAT_EQ(wrap_degrees(190.0f), -170.0f);
    EXPECT_FLOAT_EQ(wrap_degrees(-190.0f), 170.0f);
    EXPECT_FLOAT_EQ(wrap_degrees(-180.0f), 180.0f);
    EXPECT_FLOAT_EQ(wrap_degrees(180.0f), 180.0f);
    EXPECT_FLOAT_EQ(wrap_degrees(725.0f), 5.0f);
}

TEST(Navigation, the_light_turns_with_the_mouse_across_the_near_side) {
    View view;
    turn_light(view, {10.0f, 0.0f});
    // A rotation by ψ takes what lay at +Z, the viewer's side, towards +X, his right.
    EXPECT_GT(view.env_rotation_deg, 0.0f);
}

TEST(Toolbar, chooses_mesh_shading_view_and_tone_mapping) {
    Stage stage;
    const auto choose = [&](const char* combo, const char* option) {
        stage.click(combo);
        stage.frame();
        stage.click(std::string(combo) + "." + option);
    };
    choose("toolbar.mesh", "shader_ball");
    choose("toolbar.shading", "course");
    choose("toolbar.debug", "roughness");
    choose("toolbar.tonemap", "aces");
    EXPECT_EQ(stage.mesh, "shaderball");
    EXPECT_EQ(stage.view.shading, Shading::Course);
    EXPECT_EQ(stage.view.debug, DebugView::Roughness);
    EXPECT_EQ(stage.view.tonemap, Tonemap::Aces);
}

TEST(Toolbar, shows_a_mesh_that_is_not_in_the_catalog_by_its_file_name) {
    Stage stage;
    stage.mesh = "/models/spot.obj";
    stage.frames(2);
    stage.click("toolbar.mesh");
    stage.click("toolbar.mesh.quad");
    EXPECT_EQ(stage.mesh, "quad");
}

TEST(LightPanel, turns_exposes_and_chooses_the_background) {
    Stage stage;
    stage.ui.right_tab = "light";
    stage.frames(2);
    stage.drag("light.rotation.bar", {30.0f, 0.0f});
    EXPECT_GT(stage.view.env_rotation_deg, 0.0f);
    stage.click("light.exposure.number");
    stage.type("-1.5");
    stage.key(KeyEnter);
    EXPECT_EQ(stage.view.exposure_ev, -1.5f);
    EXPECT_FALSE(stage.has("light.plain_color.swatch"));
    stage.click("light.background");
    stage.click("light.background.plain");
    EXPECT_EQ(stage.view.background, Background::Plain);
    stage.frames(2);
    EXPECT_TRUE(stage.has("light.plain_color.swatch"));
}

TEST(ViewPanel, sets_the_camera_by_numbers_and_back) {
    Stage stage;
    stage.ui.right_tab = "view";
    stage.frames(2);
    EXPECT_FALSE(stage.item("view.reset").enabled);
    stage.click("view.distance.number");
    stage.type("6");
    stage.key(KeyEnter);
    EXPECT_EQ(stage.camera.distance, 6.0f);
    EXPECT_TRUE(stage.item("view.reset").enabled);
    stage.click("view.reset");
    EXPECT_EQ(stage.camera, stage.home_camera);
}

}  // namespace patina::ui

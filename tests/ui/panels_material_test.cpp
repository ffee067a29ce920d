#include "materials/params.h"
#include "tests/ui/panels_stage.h"
#include "ui/material_hints.h"
#include "ui/values.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina::ui {
namespace {

void give_map(Stage& stage, MapSlot slot, const char* file, MapState state = MapState::Ok) {
    *map_of(stage.material, slot).map = file;
    MapStatus& map = stage.maps[static_cast<std::size_t>(slot)];
    map = {.state = state,
           .full_path = std::string("/m/") + file,
           .width = 2048,
           .height = 1024,
           .channels = 3,
           .bits = 8};
    if (state == MapState::Missing) map.message = std::string(file) + " was not found.";
    stage.frames(2);
}

}  // namespace

TEST(MaterialPanel, draws_without_asking_for_or_changing_anything) {
    Stage stage;
    for (const char* tab : {"presets", "environments", "meshes"}) {
        stage.ui.left_tab = tab;
        stage.frames(2);
    }
    for (const char* tab : {"material", "light", "view"}) {
        stage.ui.right_tab = tab;
        stage.frames(2);
    }
    stage.ui.drawer = "log";
    stage.frames(2);
    EXPECT_TRUE(stage.requests.empty());
    EXPECT_EQ(stage.material, Material{});
    EXPECT_EQ(stage.view, View{});
    EXPECT_EQ(stage.camera, Camera{});
}

TEST(MaterialPanel, shows_every_parameter_of_the_table_with_a_tooltip) {
    Stage stage(1280, 1600);
    for (const MaterialParam& param : kMaterialParams) {
        const std::string base = "material." + std::string(param.key);
        const bool color = param.kind == ParamKind::Color;
        const std::string name = base + (param.kind == ParamKind::Vector2 ? ".x.bar"
                                         : color                          ? ".swatch"
                                                                          : ".bar");
        ASSERT_TRUE(stage.has(name)) << name;
        EXPECT_NE(stage.item(name).tooltip.find(param.tooltip.substr(0, 20)), std::string::npos) << name;
    }
}

TEST(MaterialPanel, every_widget_that_can_be_used_has_a_tooltip) {
    Stage stage(1280, 1600);
    give_map(stage, MapSlot::Albedo, "a.png");
    give_map(stage, MapSlot::Roughness, "r.png", MapState::Missing);
    give_map(stage, MapSlot::Normal, "n.png", MapState::Broken);
    for (const char* tab : {"material", "light", "view"}) {
        stage.ui.right_tab = tab;
        stage.frames(2);
        for (const auto& [name, item] : stage.recorder.items)
            if (name.rfind(std::string(tab) + ".", 0) == 0 && name.find(".card") == std::string::npos) {
                EXPECT_FALSE(item.tooltip.empty()) << name;
            }
    }
}

TEST(MaterialPanel, dragging_the_roughness_bar_changes_roughness_and_nothing_else) {
    Stage stage;
    const Rect bar = stage.item("material.roughness.bar").rect;
    stage.drag("material.roughness.bar", {bar.width() * 0.25f, 0.0f});
    EXPECT_NEAR(stage.material.roughness.value, 0.75f, 0.011f);
    Material expected;
    expected.roughness.value = stage.material.roughness.value;
    EXPECT_EQ(stage.material, expected);
}

TEST(MaterialPanel, a_drag_keeps_an_item_active_until_it_ends) {
    Stage stage;
    stage.move_to(stage.centre("material.roughness.bar"));
    stage.frame();
    EXPECT_FALSE(stage.result.item_active);
    stage.button(0, true);
    EXPECT_TRUE(stage.result.item_active);
    stage.move_to(stage.centre("material.roughness.bar") + glm::vec2(20.0f, 0.0f));
    EXPECT_TRUE(stage.result.item_active);
    EXPECT_GT(stage.material.roughness.value, 0.5f);
    stage.button(0, false);
    stage.frame();
    EXPECT_FALSE(stage.result.item_active);
}

TEST(MaterialPanel, a_drag_past_the_end_stops_at_the_limit) {
    Stage stage;
    stage.drag("material.roughness.bar", {900.0f, 0.0f});
    EXPECT_EQ(stage.material.roughness.value, 1.0f);
    stage.drag("material.roughness.bar", {-900.0f, 0.0f});
    EXPECT_EQ(stage.material.roughness.value, 0.0f);
}

TEST(MaterialPanel, shift_makes_a_drag_ten_times_finer) {
    Stage stage;
    const float width = stage.item("material.roughness.bar").rect.width();
    stage.modifiers(false, true);
    stage.drag("material.roughness.bar", {width * 0.25f, 0.0f});
    stage.modifiers(false, false);
    EXPECT_NEAR(stage.material.roughness.value, 0.525f, 0.002f);
}

TEST(MaterialPanel, a_click_on_a_bar_changes_nothing) {
    Stage stage;
    stage.material.roughness.value = 0.123456f;
    stage.click("material.roughness.bar");
    EXPECT_EQ(stage.material.roughness.value, 0.123456f);
}

TEST(MaterialPanel, a_double_click_on_bar_or_label_resets_to_the_default) {
    for (const char* part : {"material.roughness.bar", "material.roughness.label"}) {
        Stage stage;
        stage.material.roughness.value = 0.9f;
        stage.double_click(part);
        EXPECT_EQ(stage.material.roughness.value, Material{}.roughness.value) << part;
    }
}

TEST(MaterialPanel, a_number_can_be_typed) {
    Stage stage;
    stage.click("material.roughness.number");
    stage.type("0.25");
    stage.key(KeyEnter);
    EXPECT_EQ(stage.material.roughness.value, 0.25f);
    EXPECT_FALSE(stage.result.item_active);
}

TEST(MaterialPanel, a_typed_number_is_kept_inside_its_range_and_nonsense_is_ignored) {
    Stage stage;
    stage.click("material.roughness.number");
    stage.type("7");
    stage.key(KeyEnter);
    EXPECT_EQ(stage.material.roughness.value, 1.0f);
    stage.click("material.roughness.number");
    stage.type("-");
    stage.key(KeyEnter);
    EXPECT_GE(stage.material.roughness.value, 0.0f);
    EXPECT_LE(stage.material.roughness.value, 1.0f);
}

TEST(MaterialPanel, escape_takes_a_typed_number_back) {
    Stage stage;
    stage.click("material.roughness.number");
    stage.type("0.25");
    EXPECT_EQ(stage.material.roughness.value, 0.25f);
    stage.key(KeyEscape);
    EXPECT_EQ(stage.material.roughness.value, 0.5f);
}

TEST(MaterialPanel, a_value_that_is_not_edited_keeps_every_bit) {
    Stage stage;
    stage.material.albedo.value = {0.1234567f, 0.7654321f, 1.0f / 3.0f};
    stage.material.emission.value = {3.3333333f, 0.1f, 0.0f};
    stage.material.uv.scale = {1.0f / 7.0f, -2.0f};
    const Material before = stage.material;
    stage.click("material.albedo.swatch");
    stage.frames(3);
    stage.key(KeyEscape);
    stage.click("material.albedo.code");
    stage.key(KeyEnter);
    stage.click("material.roughness.number");
    stage.key(KeyEnter);
    EXPECT_EQ(stage.material, before);
}

TEST(MaterialPanel, a_colour_code_is_taken_as_srgb) {
    Stage stage;
    stage.click("material.albedo.code");
    stage.type("#FF8000");
    stage.key(KeyEnter);
    EXPECT_FLOAT_EQ(stage.material.albedo.value.x, 1.0f);
    EXPECT_NEAR(stage.material.albedo.value.y, 0.2158605f, 1e-6f);
    EXPECT_FLOAT_EQ(stage.material.albedo.value.z, 0.0f);
}

TEST(MaterialPanel, colour_codes_round_trip_and_refuse_what_is_none) {
    for (const char* code : {"#000000", "#FFFFFF", "#C8A45C", "#010203"})
        EXPECT_STREQ(color_code(*color_of_code(code)).data(), code);
    EXPECT_TRUE(color_of_code("c8a45c"));
    for (const char* code : {"", "#", "#FFF", "#GG0000", "#FF00001", "######"})
        EXPECT_FALSE(color_of_code(code)) << code;
}

TEST(MaterialPanel, a_black_emission_gets_its_colour_back_when_it_is_made_brighter) {
    Stage stage(1280, 1000);
    stage.material.emission.value = {4.0f, 2.0f, 1.0f};
    stage.frames(2);
    stage.double_click("material.emission.strength.bar");
    EXPECT_EQ(stage.material.emission.value, glm::vec3(0.0f));
    stage.click("material.emission.strength.number");
    stage.type("8");
    stage.key(KeyEnter);
    EXPECT_EQ(stage.material.emission.value, glm::vec3(8.0f, 4.0f, 2.0f));
}

TEST(MaterialPanel, the_right_button_offers_the_saved_value) {
    Stage stage;
    stage.saved_material.roughness.value = 0.35f;
    stage.click("material.roughness.label", 1);
    ASSERT_TRUE(stage.has("material.roughness.revert"));
    stage.click("material.roughness.revert");
    EXPECT_EQ(stage.material.roughness.value, 0.35f);
}

TEST(MaterialPanel, an_empty_slot_browses_for_its_map) {
    Stage stage;
    stage.click("material.metallic.thumbnail");
    EXPECT_TRUE(stage.browser.open);
    EXPECT_EQ(stage.browser.purpose, BrowserPurpose::AssignMap);
    EXPECT_EQ(stage.browser.slot, MapSlot::Metallic);
    EXPECT_TRUE(stage.asked<request::ListFolder>());
}

TEST(MaterialPanel, channel_inversion_colour_space_and_convention_are_chosen_beside_the_map) {
    Stage stage(1280, 1600);
    EXPECT_FALSE(stage.has("material.roughness.channel.b"));
    give_map(stage, MapSlot::Albedo, "a.png");
    give_map(stage, MapSlot::Roughness, "r.png");
    give_map(stage, MapSlot::Normal, "n.png");
    stage.click("material.roughness.channel.b");
    stage.click("material.roughness.invert");
    stage.click("material.albedo.color_space.linear");
    stage.click("material.normal.convention.directx_(−y)");
    EXPECT_EQ(stage.material.roughness.channel, Channel::B);
    EXPECT_TRUE(stage.material.roughness.invert);
    EXPECT_EQ(stage.material.albedo.color_space, ColorSpace::Linear);
    EXPECT_EQ(stage.material.normal.convention, NormalConvention::DirectX);
}

TEST(MaterialPanel, a_map_can_be_cleared) {
    Stage stage;
    EXPECT_FALSE(stage.has("material.roughness.clear"));
    give_map(stage, MapSlot::Roughness, "r.png");
    stage.click("material.roughness.clear");
    ASSERT_TRUE(stage.asked<request::ClearMap>());
    EXPECT_EQ(stage.asked<request::ClearMap>()->slot, MapSlot::Roughness);
}

TEST(MaterialPanel, a_missing_map_can_be_located_or_read_again) {
    Stage stage;
    EXPECT_FALSE(stage.has("material.albedo.locate"));
    give_map(stage, MapSlot::Albedo, "lost.png", MapState::Missing);
    stage.click("material.albedo.reload");
    EXPECT_TRUE(stage.asked<request::ReloadMap>());
    stage.click("material.albedo.locate");
    EXPECT_EQ(stage.browser.purpose, BrowserPurpose::LocateMap);
    EXPECT_EQ(stage.browser.slot, MapSlot::Albedo);
}

TEST(MaterialPanel, a_file_dropped_on_a_card_names_its_slot) {
    Stage stage;
    stage.drop = Drop{{"/m/rust.png"}, stage.centre("material.metallic.card")};
    stage.frame();
    const auto* dropped = stage.asked<request::Dropped>();
    ASSERT_TRUE(dropped);
    EXPECT_EQ(dropped->files, std::vector<std::string>{"/m/rust.png"});
    EXPECT_EQ(dropped->slot, MapSlot::Metallic);
    EXPECT_TRUE(stage.result.wants_redraw) << "what the drop does is shown";
    stage.frame();
    EXPECT_FALSE(stage.result.wants_redraw) << "the card is lit and does not move";
    EXPECT_NEAR(stage.result.redraw_in_s, 0.8, 0.05);
    stage.frames(60);
    EXPECT_TRUE(std::isinf(stage.result.redraw_in_s)) << "and is not lit any more";
}

TEST(MaterialPanel, a_file_dropped_elsewhere_names_no_slot) {
    Stage stage;
    stage.drop = Drop{{"/m/rust.png"}, stage.centre("material.metallic.card")};
    stage.frame();
    stage.requests.clear();
    stage.drop = Drop{{"/m/rust"}, stage.centre("viewport")};
    stage.frame();
    ASSERT_TRUE(stage.asked<request::Dropped>());
    EXPECT_FALSE(stage.asked<request::Dropped>()->slot);
}

TEST(MaterialPanel, a_card_that_is_scrolled_out_of_sight_is_not_hit) {
    Stage stage(1280, 500);
    const Rect hidden = stage.item("material.emission.card").rect;
    ASSERT_GT(hidden.y1, 500.0f);
    const Rect status = stage.item("panel.status").rect;
    stage.drop = Drop{{"/m/rust.png"}, {(hidden.x0 + hidden.x1) / 2, (status.y0 + status.y1) / 2}};
    stage.frame();
    ASSERT_TRUE(stage.asked<request::Dropped>());
    EXPECT_FALSE(stage.asked<request::Dropped>()->slot);
}

TEST(MaterialPanel, the_name_is_edited_in_place) {
    Stage stage;
    stage.click("material.name");
    stage.key('A', true);
    stage.type("Grün 5");
    stage.key(KeyEnter);
    EXPECT_EQ(stage.material.name.substr(0, 2), "Gr");
}

TEST(MaterialHints, judge_values_against_measured_surfaces) {
    Material material;
    EXPECT_EQ(albedo_hint(material), "");
    material.albedo.value = glm::vec3(0.002f);
    EXPECT_NE(albedo_hint(material), "");
    material.albedo.value = glm::vec3(0.99f);
    EXPECT_NE(albedo_hint(material), "");
    material.metallic.value = 1.0f;
    EXPECT_EQ(albedo_hint(material), "") << "silver is as bright";
    material.albedo.value = {0.56f, 0.57f, 0.58f};
    EXPECT_EQ(albedo_hint(material), "") << "iron is a metal";
    material.albedo.value = glm::vec3(0.2f);
    EXPECT_NE(albedo_hint(material), "");
    material.albedo.map = "a.png";
    EXPECT_EQ(albedo_hint(material), "") << "a factor of a map is not judged";
}

TEST(MaterialHints, remark_on_half_metals_without_a_map) {
    Material material;
    for (const float value : {0.0f, 0.05f, 1.0f}) {
        material.metallic.value = value;
        EXPECT_EQ(metallic_hint(material), "") << value;
    }
    material.metallic.value = 0.5f;
    EXPECT_NE(metallic_hint(material), "");
    material.metallic.map = "m.png";
    EXPECT_EQ(metallic_hint(material), "");
}

}  // namespace patina::ui

// The comparison as data: where views stand, and what editing makes of them.
#include "renderer/core/comparison.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

Comparison two_by_three() {
    Comparison comparison;
    for (const char* preset : {"gold", "copper"}) comparison.rows.push_back({.preset = preset});
    for (const char* light : {"studio", "sky", "sunset"})
        comparison.columns.push_back({.environment = light});
    return comparison;
}

TEST(Comparison, lists_the_grid_row_by_row_and_then_the_further_views) {
    Comparison comparison = two_by_three();
    comparison.views.push_back({{.preset = "-"}, {.environment = "night"}});
    const std::vector<ViewPlace> places = places_of(comparison);
    ASSERT_EQ(places.size(), 7u);
    EXPECT_EQ(preset_at(comparison, places[4]).preset, "copper");
    EXPECT_EQ(lighting_at(comparison, places[4]).environment, "sky");
    EXPECT_EQ(lighting_at(comparison, places[6]).environment, "night");
}

TEST(Comparison, a_columns_light_is_that_of_every_row) {
    Comparison comparison = two_by_three();
    const std::vector<ViewPlace> places = places_of(comparison);
    comparison = with_turned_light(comparison, places[1], 30.0f);
    EXPECT_FLOAT_EQ(lighting_at(comparison, places[4]).rotation_deg, 30.0f);
    EXPECT_FLOAT_EQ(lighting_at(comparison, places[0]).rotation_deg, 0.0f);
    comparison = with_turned_light(comparison, std::nullopt, 170.0f);
    EXPECT_FLOAT_EQ(lighting_at(comparison, places[1]).rotation_deg, -160.0f);
    EXPECT_FLOAT_EQ(lighting_at(comparison, places[0]).rotation_deg, 170.0f);
}

TEST(Comparison, a_duplicate_is_a_view_of_its_own) {
    Comparison comparison = with_duplicate(two_by_three(), {.row = 1, .column = 2});
    ASSERT_EQ(comparison.views.size(), 1u);
    lighting_at(comparison, {.free = 0}).exposure_ev = 2.0f;
    EXPECT_EQ(comparison.columns[2].exposure_ev, 0.0f);
    EXPECT_EQ(comparison.views[0].preset.preset, "copper");
    EXPECT_EQ(without(comparison, {.free = 0}), two_by_three());
}

TEST(Comparison, removing_takes_the_column_then_the_row_and_leaves_the_last_view) {
    Comparison comparison = without(two_by_three(), {.row = 0, .column = 1});
    ASSERT_EQ(comparison.columns.size(), 2u);
    EXPECT_EQ(comparison.columns[1].environment, "sunset");
    comparison = without(comparison, {.row = 0, .column = 0});
    comparison = without(comparison, {.row = 0, .column = 0});
    ASSERT_EQ(places_of(comparison).size(), 1u);
    EXPECT_EQ(comparison.rows[0].preset, "copper");
    EXPECT_EQ(without(comparison, {.row = 0, .column = 0}), comparison);
}

TEST(Comparison, new_rows_and_columns_stand_behind_the_one_named) {
    Comparison comparison = with_column_after(two_by_three(), 0, {.environment = "night"});
    EXPECT_EQ(comparison.columns[1].environment, "night");
    comparison = with_row_after(comparison, 1, {.preset = "-"});
    EXPECT_EQ(comparison.rows[2].preset, "-");
    EXPECT_EQ(places_of(comparison).size(), 12u);
}

TEST(Comparison, the_grid_fills_the_region_with_the_largest_cells) {
    EXPECT_EQ(grid_columns(1, 1.5f, 1.0f), 1);
    EXPECT_EQ(grid_columns(4, 1.0f, 1.0f), 2);
    EXPECT_EQ(grid_columns(6, 1.5f, 1.0f), 3);
    EXPECT_EQ(grid_columns(3, 3.0f, 1.0f), 3);
    EXPECT_EQ(grid_columns(3, 0.4f, 1.0f), 1);
    EXPECT_EQ(grid_columns(0, 1.0f, 1.0f), 1);
}

TEST(Comparison, changes_are_named_for_the_undo_menu) {
    const Comparison before = two_by_three();
    EXPECT_EQ(describe_comparison_change(before, before), "");
    EXPECT_EQ(describe_comparison_change(before, with_turned_light(before, std::nullopt, 5.0f)),
              "Light rotation");
    EXPECT_EQ(describe_comparison_change(before, with_column_after(before, 0, {})), "Lightings");
    Comparison after = before;
    after.columns[1].photo = Photo{.file = "a.jpg"};
    EXPECT_EQ(describe_comparison_change(before, after), "Photo");
    Comparison fitted = after;
    fitted.columns[1].photo->fit = PhotoFit{};
    EXPECT_EQ(describe_comparison_change(after, fitted), "Photo fit");
}

}  // namespace
}  // namespace patina

#include "renderer/needed_light.h"

#include "renderer/ibl/bake.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

View split_sum() {
    View view;
    view.shading = Shading::SplitSum;
    return view;
}
View course() {
    View view;
    view.shading = Shading::Course;
    return view;
}

Material plastic(float roughness) {
    Material material;
    material.roughness.value = roughness;
    return material;
}
Material metal(float roughness) {
    Material material = plastic(roughness);
    material.metallic.value = 1.0f;
    return material;
}

/// A map whose channels hold these numbers and all between.
ChannelRanges channels(ValueRange r, ValueRange g, ValueRange b) { return {r, g, b, ValueRange{1.0f, 1.0f}}; }

MapRanges with(MapSlot slot, const ChannelRanges& ranges) {
    MapRanges maps;
    maps[std::size_t(slot)] = ranges;
    return maps;
}

TEST(NeededLight, is_one_level_and_the_irradiance_for_uniform_plastic) {
    const NeededLight needed = needed_light(plastic(0.37f), {}, split_sum());
    ASSERT_EQ(needed.roughness.size(), 1u);
    EXPECT_EQ(needed.roughness[0], (ValueRange{0.37f, 0.37f}));
    EXPECT_TRUE(needed.irradiance);
    EXPECT_EQ(missing_levels(needed, {}), std::vector<float>{0.37f});
}

TEST(NeededLight, is_no_irradiance_for_a_metal_where_nothing_bounces_twice) {
    EXPECT_FALSE(needed_light(metal(0.37f), {}, course()).irradiance);
    EXPECT_FALSE(needed_light(metal(0.08f), {}, split_sum()).irradiance);
    EXPECT_TRUE(needed_light(metal(0.6f), {}, split_sum()).irradiance);
    EXPECT_TRUE(needed_light(plastic(0.08f), {}, split_sum()).irradiance);
    Material half_metal = metal(0.08f);
    half_metal.metallic.value = 0.99f;
    EXPECT_TRUE(needed_light(half_metal, {}, split_sum()).irradiance);
    Material black = plastic(0.08f);
    black.albedo.value = glm::vec3(0.0f);
    EXPECT_FALSE(needed_light(black, {}, split_sum()).irradiance);
}

TEST(NeededLight, is_nothing_for_a_mirror) {
    const NeededLight needed = needed_light(metal(0.0f), {}, split_sum());
    EXPECT_EQ(needed, NeededLight{});
    EXPECT_TRUE(missing_levels(needed, {}).empty());
    EXPECT_EQ(missing_levels(needed_light(metal(0.05f), {}, split_sum()), {}),
              std::vector<float>{kSharpestLevel});
}

TEST(NeededLight, does_not_change_with_rotation_exposure_tone_mapping_or_a_sharp_background) {
    const NeededLight still = needed_light(plastic(0.4f), {}, split_sum());
    View view = split_sum();
    view.env_rotation_deg = 77.0f;
    view.exposure_ev = -3.0f;
    view.tonemap = Tonemap::Aces;
    for (const Background background : {Background::Environment, Background::Plain}) {
        view.background = background;
        EXPECT_EQ(needed_light(plastic(0.4f), {}, view), still);
    }
    view.background = Background::Blurred;  // which is a level
    EXPECT_EQ(missing_levels(needed_light(plastic(0.4f), {}, view), {}).size(), 2u);
}

TEST(NeededLight, follows_the_numbers_in_the_roughness_map) {
    Material material = plastic(1.0f);
    material.roughness.channel = Channel::G;
    const MapRanges maps = with(MapSlot::Roughness, channels({0.0f, 1.0f}, {0.3f, 0.5f}, {0.9f, 0.9f}));
    EXPECT_EQ(needed_light(material, maps, split_sum()).roughness.at(0), (ValueRange{0.3f, 0.5f}));
    material.roughness.channel = Channel::B;
    EXPECT_EQ(needed_light(material, maps, split_sum()).roughness.at(0), (ValueRange{0.9f, 0.9f}));
    material.roughness.channel = Channel::G;
    material.roughness.value = 0.5f;
    const ValueRange halved = needed_light(material, maps, split_sum()).roughness.at(0);
    EXPECT_FLOAT_EQ(halved.low, 0.15f);
    EXPECT_FLOAT_EQ(halved.high, 0.25f);
    material.roughness.value = 1.0f;
    material.roughness.invert = true;
    const ValueRange inverted = needed_light(material, maps, split_sum()).roughness.at(0);
    EXPECT_FLOAT_EQ(inverted.low, 0.5f);
    EXPECT_FLOAT_EQ(inverted.high, 0.7f);
}

TEST(NeededLight, follows_the_numbers_in_the_metallic_map) {
    Material material = metal(0.05f);
    material.metallic.channel = Channel::R;
    EXPECT_TRUE(needed_light(material, with(MapSlot::Metallic, channels({0.0f, 1.0f}, {}, {})), split_sum())
                    .irradiance);
    EXPECT_FALSE(needed_light(material, with(MapSlot::Metallic, channels({1.0f, 1.0f}, {}, {})), split_sum())
                     .irradiance);
    material.metallic.value = 0.9f;
    EXPECT_TRUE(needed_light(material, with(MapSlot::Metallic, channels({1.0f, 1.0f}, {}, {})), split_sum())
                    .irradiance);
}

TEST(NeededLight, reaches_further_where_averaged_normals_widen_the_lobe) {
    Material material = plastic(0.3f);
    ChannelRanges bumpy = channels({0.4f, 0.6f}, {0.4f, 0.6f}, {0.9f, 1.0f});
    EXPECT_EQ(needed_light(material, with(MapSlot::Normal, bumpy), split_sum()).roughness.at(0),
              (ValueRange{0.3f, 0.3f}));
    bumpy[3].low = 0.7f;
    const ValueRange reached =
        needed_light(material, with(MapSlot::Normal, bumpy), split_sum()).roughness.at(0);
    EXPECT_EQ(reached.low, 0.3f);
    EXPECT_NEAR(reached.high, std::pow(0.0081f + 0.09f, 0.25f), 1e-5f);
    material.normal.value = 0.0f;
    EXPECT_EQ(needed_light(material, with(MapSlot::Normal, bumpy), split_sum()).roughness.at(0),
              (ValueRange{0.3f, 0.3f}));
}

TEST(NeededLight, is_nothing_where_the_view_shows_stored_numbers) {
    View view = split_sum();
    for (const DebugView debug : {DebugView::Albedo, DebugView::Normal, DebugView::Uv, DebugView::Emission}) {
        view.debug = debug;
        EXPECT_EQ(needed_light(plastic(0.5f), {}, view), NeededLight{});
    }
    view.debug = DebugView::Diffuse;
    EXPECT_TRUE(needed_light(plastic(0.5f), {}, view).irradiance);
    EXPECT_TRUE(needed_light(plastic(0.5f), {}, view).roughness.empty());
    view.debug = DebugView::Specular;
    EXPECT_FALSE(needed_light(plastic(0.05f), {}, view).irradiance);
    EXPECT_EQ(needed_light(plastic(0.5f), {}, view).roughness.size(), 1u);
}

TEST(MissingLevels, are_all_standard_ones_for_everything) {
    EXPECT_EQ(missing_levels(all_light(), {}), standard_roughness_levels());
    EXPECT_TRUE(missing_levels(all_light(), standard_roughness_levels()).empty());
}

TEST(MissingLevels, are_the_standard_ones_that_enclose_a_range) {
    const std::vector<float> standard = standard_roughness_levels();
    const std::vector<float> missing = missing_levels({{{0.3f, 0.5f}}, false}, {});
    ASSERT_FALSE(missing.empty());
    EXPECT_LE(missing.front(), 0.3f);
    EXPECT_GE(missing.back(), 0.5f);
    EXPECT_GT(missing[1], 0.3f);
    EXPECT_LT(missing[missing.size() - 2], 0.5f);
    for (const float roughness : missing)
        EXPECT_NE(std::find(standard.begin(), standard.end(), roughness), standard.end());
    EXPECT_EQ(missing_levels({{{standard[3], standard[5]}}, false}, {}),
              std::vector<float>(standard.begin() + 3, standard.begin() + 6));
}

TEST(MissingLevels, are_at_most_the_standard_ones_however_a_slider_is_dragged) {
    std::vector<float> held = missing_levels(needed_light(plastic(0.37f), {}, split_sum()), {});
    ASSERT_EQ(held.size(), 1u);
    for (int i = 0; i <= 400; ++i) {
        const float roughness = 0.5f + 0.5f * std::sin(0.05f * float(i));
        const NeededLight needed = needed_light(plastic(roughness), {}, split_sum());
        const std::vector<float> added = missing_levels(needed, held);
        EXPECT_LE(added.size(), 2u);
        held.insert(held.end(), added.begin(), added.end());
        std::sort(held.begin(), held.end());
        EXPECT_TRUE(missing_levels(needed, held).empty()) << roughness;
    }
    EXPECT_LE(held.size(), 17u);
}

TEST(MissingLevels, are_none_where_held_ones_are_close_enough) {
    const std::vector<float> standard = standard_roughness_levels();
    EXPECT_TRUE(missing_levels({{{0.42f, 0.42f}}, false}, standard).empty());
    std::vector<float> gap = standard;
    gap.erase(gap.begin() + 7);
    EXPECT_EQ(missing_levels({{{0.2f, 0.9f}}, false}, gap), std::vector<float>{standard[7]});
    EXPECT_EQ(missing_levels({{{0.3f, 0.3f}}, false}, gap), std::vector<float>{standard[7]});
    EXPECT_TRUE(missing_levels({{{0.5f, 0.9f}}, false}, gap).empty());
}

TEST(MissingLevels, of_two_pictures_are_those_of_either) {
    const NeededLight both =
        combined(needed_light(plastic(0.2f), {}, split_sum()), needed_light(metal(0.7f), {}, course()));
    EXPECT_EQ(missing_levels(both, {}), (std::vector<float>{0.2f, 0.7f}));
    EXPECT_TRUE(both.irradiance);
    EXPECT_EQ(combined(both, both), both);
}

}  // namespace
}  // namespace patina

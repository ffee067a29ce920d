#include "materials/params.h"

#include "tests/unit/materials/temporary_folder.h"

#include <set>

namespace patina {

TEST(MaterialParams, every_row_is_complete_and_its_default_lies_in_its_range) {
    std::set<std::string_view> keys;
    const Material defaults;
    for (const MaterialParam& param : kMaterialParams) {
        EXPECT_TRUE(keys.insert(param.key).second) << param.key;
        EXPECT_FALSE(param.label.empty()) << param.key;
        EXPECT_TRUE(param.tooltip.ends_with('.')) << param.key;
        EXPECT_LT(param.range.min, param.range.max) << param.key;
        EXPECT_LE(param.range.min, param.range.slider_min) << param.key;
        EXPECT_GE(param.range.max, param.range.slider_max) << param.key;
        for (const float value : values_of(param, defaults)) {
            EXPECT_GE(value, param.range.min) << param.key;
            EXPECT_LE(value, param.range.max) << param.key;
        }
        EXPECT_EQ(find_param(param.key), &param);
    }
    EXPECT_EQ(find_param("shininess"), nullptr);
}

TEST(MaterialParams, every_row_reaches_floats_of_its_own) {
    std::set<const float*> addresses;
    std::size_t count = 0;
    Material material;
    for (const MaterialParam& param : kMaterialParams)
        for (const float& value : values_of(param, material)) {
            addresses.insert(&value);
            ++count;
        }
    EXPECT_EQ(addresses.size(), count);
}

TEST(MaterialParams, every_slot_has_a_row_and_a_value_that_multiplies_its_map) {
    ASSERT_EQ(material_slots().size(), static_cast<std::size_t>(kMapSlots));
    for (int i = 0; i < kMapSlots; ++i) {
        const auto slot = static_cast<MapSlot>(i);
        EXPECT_EQ(slot_row(slot).slot, slot);
        const MaterialParam* param = find_param(slot_row(slot).key);
        ASSERT_NE(param, nullptr) << slot_row(slot).key;
        EXPECT_EQ(param->slot, slot);
    }
}

TEST(MaterialParams, a_slot_offers_exactly_the_settings_it_has) {
    Material material;
    EXPECT_TRUE(map_of(material, MapSlot::Albedo).color_space && !map_of(material, MapSlot::Albedo).channel);
    EXPECT_TRUE(map_of(material, MapSlot::Emission).color_space);
    EXPECT_TRUE(map_of(material, MapSlot::Roughness).channel && map_of(material, MapSlot::Roughness).invert);
    EXPECT_FALSE(map_of(material, MapSlot::Roughness).color_space);
    EXPECT_TRUE(map_of(material, MapSlot::Normal).convention && !map_of(material, MapSlot::Normal).channel);
    *map_of(material, MapSlot::Ao).map = "ao.png";
    const Material& unchanging = material;
    EXPECT_EQ(*map_of(unchanging, MapSlot::Ao).map, "ao.png");
    EXPECT_EQ(material.ao.map, "ao.png");
}

TEST(MaterialParams, reset_gives_back_the_default_and_only_of_that_parameter) {
    Material material;
    material.roughness.value = 0.9f;
    material.albedo.value = {0.1f, 0.2f, 0.3f};
    const MaterialParam& albedo = *find_param("albedo");
    EXPECT_FALSE(is_default(albedo, material));
    reset(albedo, material);
    EXPECT_TRUE(is_default(albedo, material));
    EXPECT_EQ(material.albedo, Material{}.albedo);
    EXPECT_EQ(material.roughness.value, 0.9f);
}

TEST(SetParameter, takes_colours_numbers_and_vectors) {
    Material material;
    set_parameter(material, "albedo", "0.8,0.1, 0.2");
    set_parameter(material, "roughness", "0.3");
    set_parameter(material, "uv.scale", "2,-3");
    set_parameter(material, "uv.rotation_deg", "45");
    set_parameter(material, "emission", "2.5");
    EXPECT_EQ(material.albedo.value, glm::vec3(0.8f, 0.1f, 0.2f));
    EXPECT_EQ(material.roughness.value, 0.3f);
    EXPECT_EQ(material.uv.scale, glm::vec2(2.0f, -3.0f));
    EXPECT_EQ(material.uv.rotation_deg, 45.0f);
    EXPECT_EQ(material.emission.value, glm::vec3(2.5f));
}

TEST(SetParameter, takes_the_settings_of_a_slot) {
    Material material;
    set_parameter(material, "roughness.map", "gloss.png");
    set_parameter(material, "roughness.invert", "true");
    set_parameter(material, "roughness.channel", "a");
    set_parameter(material, "normal.convention", "directx");
    set_parameter(material, "albedo.color_space", "linear");
    EXPECT_EQ(material.roughness, (ScalarSlot{0.5f, "gloss.png", Channel::A, true}));
    EXPECT_EQ(material.normal.convention, NormalConvention::DirectX);
    EXPECT_EQ(material.albedo.color_space, ColorSpace::Linear);
}

TEST(SetParameter, refuses_a_wrong_value_with_the_range_and_changes_nothing) {
    const struct {
        const char *key, *text, *says;
    } cases[] = {
        {"roughness", "1.5", "a number from 0 to 1"},
        {"roughness", "-0.1", "a number from 0 to 1"},
        {"roughness", "nan", "a number from 0 to 1"},
        {"roughness", "1e999", "a number from 0 to 1"},
        {"roughness", "", "a number from 0 to 1"},
        {"roughness", "0.5x", "a number from 0 to 1"},
        {"roughness", "0.1,0.2", "a number from 0 to 1"},
        {"albedo", "0.1,0.2", "a colour (r,g,b) from 0 to 1"},
        {"albedo", "0.1,0.2,", "a colour (r,g,b) from 0 to 1"},
        {"albedo", "1,2,3", "a colour (r,g,b) from 0 to 1"},
        {"uv.scale", "1,2,3", "two numbers (x,y) from -1000 to 1000"},
        {"uv.rotation_deg", "400", "a number from -360 to 360°"},
        {"roughness.channel", "x", "one of r, g, b, a"},
        {"roughness.invert", "yes", "one of true, false"},
        {"normal.convention", "vulkan", "one of opengl, directx"},
    };
    for (const auto& [key, text, says] : cases) {
        Material material;
        const std::string sentence = failure_of([&, k = key, t = text] { set_parameter(material, k, t); });
        EXPECT_NE(sentence.find(says), std::string::npos) << key << "=" << text << ": " << sentence;
        EXPECT_EQ(material, Material{}) << key << "=" << text;
    }
}

TEST(SetParameter, names_the_keys_there_are_when_asked_for_another) {
    Material material;
    for (const char* key :
         {"rougness", "", ".", "albedo.channel", "normal.invert", "uv", "uv.map", "albedo.value"}) {
        const std::string sentence = failure_of([&] { set_parameter(material, key, "1"); });
        EXPECT_NE(sentence.find("roughness"), std::string::npos) << key << ": " << sentence;
        EXPECT_NE(sentence.find("uv.rotation_deg"), std::string::npos) << sentence;
        EXPECT_NE(sentence.find("normal.convention"), std::string::npos) << sentence;
        EXPECT_EQ(sentence.find("albedo.channel,"), std::string::npos) << sentence;
    }
}

}  // namespace patina

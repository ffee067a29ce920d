#include "app/document.h"

#include "materials/text_io.h"

#include <gtest/gtest.h>

namespace {

using namespace patina;
namespace fs = std::filesystem;

Material with_map(const std::string& map) {
    Material material;
    material.albedo.map = map;
    return material;
}

TEST(Document, is_dirty_when_the_material_differs_from_the_file_and_not_for_light_or_view) {
    Document document;
    const DocumentFile file;
    EXPECT_FALSE(is_dirty(document, file));
    document.environment = "sky";
    document.mesh = "quad";
    document.view.exposure_ev = 1.0f;
    EXPECT_FALSE(is_dirty(document, file));
    document.material.roughness.value = 0.3f;
    EXPECT_TRUE(is_dirty(document, file));
}

TEST(Document, names_maps_by_full_path_and_back_to_the_very_text_of_the_file) {
    const fs::path preset = "/presets/metal/gold.json";
    for (const char* text :
         {"maps/a.png", "./maps/a.png", "../shared/a.png", "/elsewhere/a.png", "maps//a.png"}) {
        const Material written = with_map(text);
        const Material full = with_full_map_paths(written, preset);
        EXPECT_TRUE(utf8_to_path(full.albedo.map).is_absolute()) << text;
        EXPECT_EQ(with_preset_map_paths(full, preset, written).albedo.map, text);
    }
    EXPECT_EQ(with_full_map_paths(with_map("../shared/a.png"), preset).albedo.map, "/presets/shared/a.png");
}

TEST(Document, leaves_empty_slots_and_web_addresses_as_they_are) {
    const fs::path preset = "/presets/gold.json";
    for (const char* text : {"", "https://example.org/a.png"}) {
        const Material full = with_full_map_paths(with_map(text), preset);
        EXPECT_EQ(full.albedo.map, text);
        EXPECT_EQ(with_preset_map_paths(full, preset, Material{}).albedo.map, text);
    }
}

TEST(Document, names_maps_relative_to_the_folder_it_is_saved_in) {
    const Material written = with_map("maps/a.png");
    const Material full = with_full_map_paths(written, "/a/gold.json");
    EXPECT_EQ(with_preset_map_paths(full, "/a/b/gold.json", written).albedo.map, "../maps/a.png");
    // The same text would mean another file there.
    const Material again =
        with_full_map_paths(with_preset_map_paths(full, "/a/b/gold.json", written), "/a/b/gold.json");
    EXPECT_EQ(again.albedo.map, full.albedo.map);
}

TEST(Document, is_called_after_its_material_or_else_after_its_file) {
    Document document;
    const DocumentFile file{.path = utf8_to_path("/presets/größe.json")};
    EXPECT_EQ(document_title(document, {}), "Untitled");
    EXPECT_EQ(document_title(document, file), "größe");
    document.material.name = "Rust";
    EXPECT_EQ(document_title(document, {}), "Rust");
    EXPECT_EQ(document_title(document, file), "Rust");
    document.material.name.clear();
    EXPECT_EQ(document_title(document, {}), "Untitled");
}

TEST(Document, describes_a_change_in_a_few_words) {
    const Document before;
    Document after;
    EXPECT_EQ(describe_change(before, after), "");
    after.material.roughness.value = 0.1f;
    EXPECT_EQ(describe_change(before, after), "Roughness");
    after.environment = "sky";
    EXPECT_EQ(describe_change(before, after), "Roughness, Environment");
    after.mesh = "quad";
    EXPECT_EQ(describe_change(before, after), "3 values");
    after = {};
    after.material.albedo.map = "/a.png";
    EXPECT_EQ(describe_change(before, after), "Albedo map");
    after = {};
    after.view.env_rotation_deg = 10.0f;
    EXPECT_EQ(describe_change(before, after), "Light rotation");
}

}  // namespace

// What the build puts into the share folder, as the program finds it there.
#include "materials/map_naming.h"
#include "materials/maps/recipes.h"
#include "materials/material_io.h"
#include "materials/params.h"
#include "renderer/core/image_io.h"
#include "tests/unit/materials/temporary_folder.h"

#include <set>

namespace patina {

namespace fs = std::filesystem;

namespace {

const fs::path kSource = fs::path(PATINA_SOURCE_DIR) / "materials" / "presets";
const fs::path kBuilt = fs::path(PATINA_SHARE_DIR) / "presets";

}  // namespace

TEST(BuiltPresets, are_the_sources_and_their_schema_unchanged) {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(kSource)) {
        EXPECT_EQ(read_file(kBuilt / entry.path().filename()), read_file(entry.path())) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 37u);
}

TEST(BuiltPresets, find_every_map_they_name_with_the_channel_they_read) {
    std::set<fs::path> maps;
    for (const auto& entry : fs::directory_iterator(kSource)) {
        if (entry.path().filename().string().ends_with(".schema.json")) continue;
        const fs::path preset = kBuilt / entry.path().filename();
        const Material material = load_material(preset).material;
        for (const MaterialSlot& slot : material_slots()) {
            const ConstMapRef ref = map_of(material, slot.slot);
            if (ref.map->empty()) continue;
            const fs::path file = resolve_map(preset, *ref.map);
            const ImageInfo info = load_image_info(file);
            EXPECT_EQ(info.width, maps::kMapSize) << file;
            EXPECT_EQ(info.height, maps::kMapSize) << file;
            const int wanted = ref.channel != nullptr ? static_cast<int>(*ref.channel) + 1 : 3;
            EXPECT_GE(info.channels, wanted) << file;
            maps.insert(file);
        }
    }
    EXPECT_GE(maps.size(), 25u);
}

TEST(BuiltPresets, have_maps_that_the_import_would_put_into_the_same_slots) {
    for (const auto& entry : fs::directory_iterator(kSource)) {
        if (entry.path().filename().string().ends_with(".schema.json")) continue;
        const Material material = load_material(entry.path()).material;
        std::set<std::string> files;
        for (const MaterialSlot& slot : material_slots())
            if (const std::string& map = *map_of(material, slot.slot).map; !map.empty()) files.insert(map);
        if (files.empty()) continue;
        const std::vector<std::string> list(files.begin(), files.end());
        Material bare = material;
        for (const MaterialSlot& slot : material_slots()) *slot.edit(bare).map = "";
        const Material imported = apply_import(bare, propose_import(list));
        for (const MaterialSlot& slot : material_slots()) {
            const ConstMapRef has = map_of(imported, slot.slot);
            const ConstMapRef wants = map_of(material, slot.slot);
            if (wants.map->empty()) continue;  // lava's packed map has nothing to say about metal
            EXPECT_EQ(*has.map, *wants.map) << entry.path() << " " << slot.key;
            if (wants.channel != nullptr) {
                EXPECT_EQ(*has.channel, *wants.channel) << entry.path() << " " << slot.key;
                EXPECT_EQ(*has.invert, *wants.invert) << entry.path() << " " << slot.key;
            }
            if (wants.convention != nullptr) {
                EXPECT_EQ(*has.convention, *wants.convention) << entry.path();
            }
        }
    }
}

TEST(BuiltPresets, normal_maps_read_back_as_the_recipe_made_them) {
    for (const maps::MapRecipe& recipe : maps::map_recipes()) {
        if (recipe.name != "hammered-copper") continue;
        for (const maps::MapPicture& picture : recipe.make(maps::kMapSize)) {
            const Image image = load_image(kBuilt / "maps" / picture.file).image;
            ASSERT_EQ(image.channels, picture.channels) << picture.file;
            ASSERT_EQ(image.type, picture.bits == 16 ? PixelType::U16 : PixelType::U8) << picture.file;
            const float most = picture.bits == 16 ? 65535.0f : 255.0f;
            for (const int at : {0, 1, 511, 1023})
                for (int c = 0; c < picture.channels; ++c) {
                    const auto index =
                        static_cast<std::size_t>((at * picture.size + (1023 - at)) * picture.channels + c);
                    EXPECT_EQ(texel(image, 1023 - at, at, c),
                              static_cast<float>(picture.values[index]) / most)
                        << picture.file;
                }
        }
    }
}

}  // namespace patina

// The maps that the shipped presets use, each set a pure function of its size. The same bytes on every
// machine.
#pragma once

#include "materials/maps/surface.h"

#include <span>
#include <string_view>
#include <vector>

namespace patina::maps {

std::vector<MapPicture> brushed_steel(int size);
std::vector<MapPicture> worn_paint(int size);
std::vector<MapPicture> rusted_iron(int size);
std::vector<MapPicture> hammered_copper(int size);
std::vector<MapPicture> glazed_tiles(int size);
std::vector<MapPicture> terrazzo(int size);
std::vector<MapPicture> woven_cloth(int size);
std::vector<MapPicture> oak_planks(int size);
std::vector<MapPicture> cooling_lava(int size);

struct MapRecipe {
    std::string_view name;                      ///< of the preset that uses the maps: "brushed-steel"
    std::vector<MapPicture> (*make)(int size);  ///< power of two ≥ 64
};
std::span<const MapRecipe> map_recipes();

inline constexpr int kMapSize = 1024;  ///< of the shipped pictures

}  // namespace patina::maps

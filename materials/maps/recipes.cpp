#include "materials/maps/recipes.h"

#include <array>

namespace patina::maps {

std::span<const MapRecipe> map_recipes() {
    static constexpr std::array recipes{
        MapRecipe{"brushed-steel", brushed_steel}, MapRecipe{"worn-paint", worn_paint},
        MapRecipe{"rusted-iron", rusted_iron},     MapRecipe{"hammered-copper", hammered_copper},
        MapRecipe{"glazed-tiles", glazed_tiles},   MapRecipe{"terrazzo", terrazzo},
        MapRecipe{"woven-cloth", woven_cloth},     MapRecipe{"oak-planks", oak_planks},
        MapRecipe{"cooling-lava", cooling_lava},
    };
    return recipes;
}

}  // namespace patina::maps

// Which shader permutation a picture needs: only what the material, the light and the view really use. Pure.
#pragma once

#include "materials/material.h"
#include "renderer/core/view.h"
#include "renderer/map_range.h"

#include <cstdint>
#include <string>
#include <vector>

namespace patina {

/// A set of Feature bits.
using Features = std::uint32_t;

enum class Feature : Features {
    AlbedoMap = 1u << 0,
    RoughnessMap = 1u << 1,
    MetallicMap = 1u << 2,
    AoMap = 1u << 3,
    NormalMap = 1u << 4,
    EmissionMap = 1u << 5,  ///< implies Emission
    Emission = 1u << 6,
    Sharp = 1u << 7,        ///< roughness may be too low for the levels alone
    Course = 1u << 8,       ///< the lecture's formulas
    Debug = 1u << 9,        ///< one ingredient instead of the picture; implies Sharp and Emission
    Fitted = 1u << 10,      ///< fitted lobes; excludes Course
    FourLevels = 1u << 11,  ///< of four levels instead of two; implies Fitted
};

inline bool has(Features features, Feature feature) { return (features & Features(feature)) != 0; }

/// maps: of the slots that have one on the GPU; a map whose value is 0 is not read. sharpest_roughness: of
/// the light's prefiltered levels.
Features features_of(const Material& material, const MapRanges& maps, const View& view,
                     float sharpest_roughness);

/// Of those, what the reference's shader reads: maps and emission.
Features reference_features(Features features);

/// Every value features_of can return.
std::vector<Features> all_features();

/// "HAS_ALBEDO_MAP", …
std::vector<std::string> defines_of(Features features);

/// Views that show stored numbers rather than light: no exposure, no tone mapping.
bool is_data_view(DebugView view);

}  // namespace patina

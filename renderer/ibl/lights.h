// Compact bright sources: found, taken out of a panorama, and put back into prefiltered levels exactly.
#pragma once

#include "renderer/ibl/kernel.h"
#include "renderer/ibl/panorama.h"

#include <optional>
#include <vector>

namespace patina {

/// What was taken from one texel.
struct LightTexel {
    int x = 0;
    int y = 0;
    glm::vec3 excess{0.0f};  ///< radiance
};

struct LightExtraction {
    std::vector<ExtractedLight> lights;           ///< brightest first
    std::vector<std::vector<LightTexel>> texels;  ///< of each light
    std::vector<std::vector<glm::vec3>> changed_rows;
    RadianceView residual;  ///< into the environment and changed_rows
};

struct LightSearch {
    double threshold = 20.0;                 ///< of the mean luminance
    double largest_rms_radius_rad = 0.0122;  ///< flux-weighted, of the texels' centres; 0.7°
    double least_irradiance = 0.005;         ///< of π · the mean luminance; less is not worth a light
    int most = 16;
};

/// Connected texels above the threshold are a light if their flux lies within the radius; wider ones are
/// searched again at four times the threshold, so a sun in a bright sky is found and a softbox stays. What is
/// taken is the excess over the mean of the texels around. Extracted and residual sum to the original.
LightExtraction extract_lights(const Environment& environment, const RadianceStatistics& statistics,
                               const LightSearch& search);

/// Adds to a level what it would hold of the lights, had they stayed: the kernel integrated over every texel
/// taken; with a split, only its far part.
void fold_back(const LightExtraction& extraction, float roughness, const std::optional<KernelSplit>& split,
               CubeMap& cube, const BakeControl& control);

}  // namespace patina

// An environment's panorama as the GPU samples it: half floats and a mip chain whose texels average over
// isotropic patches of the sphere. Pure; no GL is called, so it can be made on a worker.
#pragma once

#include "renderer/core/unset_vector.h"
#include "renderer/ibl/bake.h"

#include <cstdint>
#include <vector>

namespace patina {

struct PanoramaLevels {
    struct Level {
        int width = 0;
        int height = 0;
        /// Half floats · 2^−exponent. Red, green and blue are the radiance without the extracted lights,
        /// alpha the mean channel of what these add: × a light's colour it completes the picture.
        UnsetVector<std::uint16_t> rgba;
    };
    std::vector<Level> levels;
    std::vector<ExtractedLight> lights;  ///< those kept apart in alpha
    int exponent = 0;  ///< chosen so that the largest value fits a half float with its full precision
};

/// Larger panoramas are halved until they are no wider than that.
inline constexpr int kMaxPanoramaWidth = 8192;

/// Raised whenever make_panorama_levels' output changes.
inline constexpr int kPanoramaVersion = 1;

PanoramaLevels make_panorama_levels(const Environment& environment, int max_width = kMaxPanoramaWidth);

/// The exponent e for which largest · 2^−e lies in (2^14, 2^15]: no overflow in a half float and the most
/// room below.
int half_exponent(float largest);

}  // namespace patina

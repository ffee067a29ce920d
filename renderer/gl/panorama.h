// An environment's panorama as the GPU samples it: half floats and a mip chain whose texels average over
// isotropic patches of the sphere. Pure; no GL is called, so it can be made on a worker.
#pragma once

#include "renderer/core/environment.h"

#include <cstdint>
#include <vector>

namespace patina {

struct PanoramaLevels {
    struct Level {
        int width = 0;
        int height = 0;
        std::vector<std::uint16_t> rgba;  ///< half floats, radiance · 2^−exponent
    };
    std::vector<Level> levels;
    int exponent = 0;  ///< chosen so that the largest value fits a half float with its full precision
};

/// Larger panoramas are halved until they are no wider than that.
inline constexpr int kMaxPanoramaWidth = 8192;

PanoramaLevels make_panorama_levels(const Environment& environment, int max_width = kMaxPanoramaWidth);

/// The exponent e for which largest · 2^−e lies in (2^14, 2^15]: no overflow in a half float and the most
/// room below.
int half_exponent(float largest);

}  // namespace patina

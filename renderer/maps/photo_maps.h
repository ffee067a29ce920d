// From a photo of a flat sample to a material's maps: rectified, its light made even, its borders grown
// together, then what can be told of the surface. Pure.
//
// What one photo tells is an estimate: colour times light is all that it holds. Each step says what it
// assumes.
#pragma once

#include "renderer/core/fourier.h"
#include "renderer/core/image.h"
#include "renderer/core/map_settings.h"

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace patina {

struct PhotoMaps {
    Image rectified, even;           ///< 3 channels of F32, linear
    Image albedo;                    ///< 3 channels of U8, sRGB
    Image height;                    ///< 1 channel of U16, 0 the deepest place
    Image normal;                    ///< 3 channels of U16, tangent space, +Y up (OpenGL)
    Image roughness, ao;             ///< 1 channel of U8
    float depth = 0.0f;              ///< between height 0 and 1, in widths of the map
    std::vector<std::string> notes;  ///< what the artist should know, one sentence each
};

struct MapControl {
    std::function<void(float)> progress = [](float) {};
    std::stop_token stop;
};

/// linear: the photo, 3 channels of F32. nullopt when stopped. Throws std::runtime_error "what is wrong; the
/// way out", without the photo's name: corners in a line or crossed, a sample of too few pixels or none that
/// say anything.
std::optional<PhotoMaps> make_photo_maps(const Image& linear, const MapSettings& settings,
                                         const FourierTransform& fourier, const MapControl& control = {});

}  // namespace patina

// FLIP: how different two pictures look to a person who flips between them. Pure.
//
// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A Difference Evaluator for
// Alternating Images"; Andersson, Nilsson, Shirley, Akenine-Möller 2021, "Visualizing Errors in Rendered High
// Dynamic Range Images".
#pragma once

#include "renderer/core/image.h"

namespace patina {

/// Pixels a degree of the viewer's eye: 0.7 m from a monitor 0.7 m and 3840 pixels wide.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

/// 1 channel, F32, 0…1 at each pixel. Both: 3 channels of linear light of the same size, 0…1 (clamped).
Image flip(const Image& reference, const Image& test, double pixels_per_degree = kFlipPixelsPerDegree);

/// The exposures at which a high dynamic range picture is looked at: from its brightest pixel to its median
/// just below white, in steps of about a stop.
struct FlipExposures {
    double first_ev = 0.0, last_ev = 0.0;
    int count = 2;
};
FlipExposures flip_exposures(const Image& reference);

/// The same for scene-linear radiance: the largest over all exposures, each tone-mapped (Narkowicz's ACES).
Image hdr_flip(const Image& reference, const Image& test, double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace patina

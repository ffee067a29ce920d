// Takes the gradient of the light out of a picture of a flat sample. Pure.
#pragma once

#include "renderer/maps/grid.h"

namespace patina {

inline constexpr int kMaxEvenDegree = 4;

/// Light falls off smoothly over a flat sample, so its logarithm is told by a polynomial of low degree in x
/// and y, a channel each (lamps have colours); the picture is divided by it, and each channel's mean level
/// stays. What of the surface itself changes that smoothly goes with it. degree: 0 (nothing is done) …
/// kMaxEvenDegree.
///
/// The fit is to the means of at most 96×96 cells, weighted anew five times by 1/(1 + (r/s)²), s the
/// residuals' median times 1.4826 (Cauchy's weights), so that stains and glints hardly pull it.
Colors evened(const Colors& picture, int degree);

}  // namespace patina

// Environments drawn by formulas for the fit: softboxes, windows, a sky, small lamps. The same pixels on
// every run.
#pragma once

#include "renderer/core/environment.h"

namespace patina::lobes {

inline constexpr int kFitEnvironments = 13;

/// number 0 … kFitEnvironments − 1.
Environment make_fit_environment(int number, int width);

}  // namespace patina::lobes

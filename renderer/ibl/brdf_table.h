// The split-sum table as shaders look it up: its outermost texels on the ends of both axes, so that nothing
// is extrapolated.
#pragma once

#include "renderer/ibl/bake.h"

namespace patina {

/// As bake_brdf_table, but texel (x, y) lies at NoV = (x/(size − 1))², roughness = y/(size − 1).
BrdfTable bake_end_to_end_brdf_table(int size, const ParallelFor& parallel_for = serial_for);

}  // namespace patina

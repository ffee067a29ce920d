// How exactly a level must be computed: what a panorama's values and spectrum allow to leave out.
#pragma once

#include "renderer/ibl/bake.h"

#include <vector>

namespace patina {

struct RadianceStatistics {
    glm::vec3 lowest{0.0f}, highest{0.0f};  ///< channel by channel
    double mean = 0.0;                      ///< over the sphere and the channels
    double mean_square = 0.0;               ///< likewise
    /// What an error, the same everywhere, is divided by to give a relative error: 1/√(mean of 1/L²), L
    /// averaged over patches and taken no darker than a thousandth of the mean. A dark studio needs its
    /// lamps' tails more exactly.
    double error_scale = 0.0;
};
RadianceStatistics radiance_statistics(const Environment& environment, const ParallelFor& parallel_for);

/// The largest degree worth computing of a GGX kernel.
int kernel_band(double alpha, int largest);

/// Cuts the kernel to the smallest band that leaves out no more than that rms: by Parseval the mean square of
/// what is left out is Σ g_l² E_l/4π over the degrees left out. power: Σ_m |a_lm|² by degree.
void truncate(std::vector<double>& zonal, const std::vector<double>& power, double allowed_rms);

}  // namespace patina

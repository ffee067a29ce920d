// How exactly a level must be computed: what a panorama's values and spectrum allow to leave out.
#pragma once

#include <vector>

namespace patina {

/// The largest degree worth computing of a GGX kernel.
int kernel_band(double alpha, int largest);

/// Cuts the kernel to the smallest band that leaves out no more than that rms: by Parseval the mean square of
/// what is left out is Σ g_l² E_l/4π over the degrees left out. power: Σ_m |a_lm|² by degree.
void truncate(std::vector<double>& zonal, const std::vector<double>& power, double allowed_rms);

}  // namespace patina

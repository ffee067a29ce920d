// The prefilter's kernel as Legendre coefficients. Pure mathematics in double precision.
#pragma once

#include <vector>

namespace patina {

/// D·NoL at N = V = R, unnormalised, as a function of the angle to the light: h is halfway, so
/// sin²θ_h = sin²(θ/2) = s and K = cos θ · α²/(s + α²(1 − s))². Written with s, nothing cancels however sharp
/// the lobe is.
double ggx_kernel(double theta, double alpha);

/// g_l = ∫ K P_l / ∫ K for l = 0 … band: by Funk and Hecke's theorem what convolution with K multiplies a
/// spherical harmonic of degree l by. alpha > 0.
std::vector<double> ggx_zonal(double alpha, int band);

/// ∫ K dω, the kernel's normalisation.
double ggx_kernel_integral(double alpha);

/// A kernel in two parts: K·w near its middle and K·(1 − w), which is smooth however sharp the lobe is. w
/// falls from 1 to 0 between two distances, three times continuously differentiable. Distances are chords,
/// |N − L|², which grow with the angle as 4 sin²(θ/2).
struct KernelSplit {
    double inner_square = 0.0;
    double outer_square = 0.0;
    double window(double chord_square) const;
};

/// ∫ K (1 − w) P_l / ∫ K, from l = 0 up to the degree where less than 1e-7 is left, or to the band.
std::vector<double> ggx_far_zonal(double alpha, const KernelSplit& split, int band);

}  // namespace patina

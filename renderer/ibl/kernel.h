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

}  // namespace patina

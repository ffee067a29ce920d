// Normalised associated Legendre functions as a cheap recurrence, and Gauss-Legendre nodes. Pure tables.
#pragma once

#include "renderer/ibl/bake.h"

#include <cstddef>
#include <vector>

namespace patina {

/// P̄_lm with ∫|P̄_lm(cos θ) e^(imφ)|² dω = 1 obeys (A_l = √((4l² − 1)/(l² − m²)), B_l = 1/A_l)
///     P̄_(l+1) = A_(l+1) · (x P̄_l − B_(l) P̄_(l−1)).
/// Put P̄_l = c_l p_l and choose c_(l+1) = c_(l−1) A_(l+1)/A_l: then
///     p_(l+1) = f_l · x · p_l − p_(l−1),   f_l = A_(l+1) c_l / c_(l+1),
/// one product and one fused operation a step, starting from p_m = sin^m θ, p_(m+1) = x p_m. The c are put
/// into the coefficients, never into the loops.
struct LegendreTables {
    LegendreTables(int largest_degree, const ParallelFor& parallel_for);

    std::size_t at(int l, int m) const { return first[m] + std::size_t(l - m); }

    int band = 0;                    ///< largest l
    std::vector<std::size_t> first;  ///< where (m, m) is; each m is followed by kPadding unused entries
    std::vector<double> factor;      ///< f_(l−1) at (l, m)
    std::vector<float> factor_single;
    std::vector<double> norm_square;    ///< c_l²
    static constexpr int kPadding = 4;  ///< loops take two degrees at a time

private:
    void fill_order(int m, double diagonal_square);
};

/// Nodes and weights on (0, 1), exact for polynomials of degree 2·count − 1.
struct GaussNodes {
    explicit GaussNodes(int count);
    std::vector<double> x, weight;
};

}  // namespace patina

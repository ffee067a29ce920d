// Small linear systems of least squares.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace patina {

/// Solves A x = b for the first n of N unknowns; A symmetric positive definite, of which the lower triangle
/// is read (Cholesky). A pivot that rounding made smaller counts as 1e-30.
template <std::size_t N>
std::array<double, N> solve_symmetric(std::array<std::array<double, N>, N> a, std::array<double, N> b,
                                      int n) {
    for (int j = 0; j < n; ++j) {
        for (int k = 0; k < j; ++k)
            for (int i = j; i < n; ++i) a[i][j] -= a[i][k] * a[j][k];
        const double root = std::sqrt(std::max(a[j][j], 1e-30));
        for (int i = j; i < n; ++i) a[i][j] /= root;
    }
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (int i = n - 1; i >= 0; --i) {
        for (int k = i + 1; k < n; ++k) b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return b;
}

}  // namespace patina

// Sums of Legendre polynomials, compiled for several instruction sets. Plain
// pointers and numbers only.
#pragma once

namespace patina::simd {

/// Nodes side by side. The order of the sums does not depend on the machine.
inline constexpr int kNodesAtOnce = 8;

/// sums[8 l + i] += Σ weight[n] P_l(x[n]) over the nodes n = i, i + 8, …, for l
/// = 0 … band. count: a multiple of kNodesAtOnce.
void add_legendre(const double* x, const double* weight, int count, int band, double* sums);

}  // namespace patina::simd

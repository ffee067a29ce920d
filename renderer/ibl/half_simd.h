// Halves of RGB texels, compiled for several instruction sets. Plain pointers and numbers only.
#pragma once

#include <cstdint>

namespace patina::simd {

/// The largest of count floats, none of them NaN, and least.
float largest_of(const float* values, int count, float least);

/// count RGB texels × scale as RGBA half floats, rounded to nearest even; alpha is 1.
/// Precondition: |value · scale| ≤ 65504 (no infinity or NaN).
void to_rgba_halves(const float* rgb, int count, float scale, std::uint16_t* rgba);

}  // namespace patina::simd

// Sums and ranges of RGB texels, compiled for several instruction sets. Plain
// pointers and numbers only.
#pragma once

namespace patina::simd {

/// Floats taken together: four texels, so that each channel keeps its places.
inline constexpr int kTogether = 12;

struct TexelRange {
    float lowest[kTogether], highest[kTogether];
};

/// sum[0 … 2]: of count RGB texels, in single precision. Widens the range, place i holding channel i mod 3.
void measure_texels(const float* texels, int count, TexelRange& range, float* sum);

}  // namespace patina::simd

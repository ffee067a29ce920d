// Points of light seen through a GGX lobe, compiled for several instruction
// sets. Derivations are in fold_back.cpp. Plain pointers and numbers only.
#pragma once

namespace patina::simd {

struct FoldPoints {
    int count = 0;
    const float* x = nullptr;  ///< unit directions …
    const float* y = nullptr;
    const float* z = nullptr;
    const float* flux[3] = {};  ///< … and what comes from there, by channel
};
struct FoldLobe {
    float alpha2 = 0.0f;
    float inner_square = 0.0f;  ///< with a window scale above 0 only the far part
                                ///< counts, see KernelSplit
    float window_scale = 0.0f;
};

/// Neighbouring directions that are seen to together.
inline constexpr int kFoldDirections = 8;
struct FoldDirections {
    float x[kFoldDirections], y[kFoldDirections], z[kFoldDirections];
    float sums[3][kFoldDirections];
};
/// Adds Σ flux · K to the sums.
void add_points(const FoldPoints& points, const FoldLobe& lobe, FoldDirections& directions);

}  // namespace patina::simd

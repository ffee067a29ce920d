// The inner loops of the near field, compiled for several instruction sets. Derivations are in
// near_field.cpp. Plain pointers and numbers only.
#pragma once

namespace patina::simd {

/// Floats that must exist behind the last column of a row, and what the square of those columns is: far
/// enough away for every window to be 0.
inline constexpr int kNearPadding = 16;
inline constexpr float kNearHuge = 1e9f;

struct NearLobe {
    float spread = 0.0f;        ///< c² = 4α²/(1 − α²)
    float inner_square = 0.0f;  ///< where the window begins to fall
    float window_scale = 0.0f;  ///< 1 over the difference of the squares
};

/// One row of texels around N; distances in the coordinates x, y of near_field.cpp.
struct NearRow {
    const float* red = nullptr;
    const float* green = nullptr;
    const float* blue = nullptr;
    const float* square = nullptr;  ///< 4 sin²(Δφ/2) of each column
    float metric = 0.0f;            ///< x² = metric · square
    float y_square = 0.0f;
    float column_side_square = 0.0f;  ///< h_x²
    float row_side_square = 0.0f;     ///< h_y²
};

/// Adds to sums[0 … 2] Σ w K L over the columns begin … end − 1 and to sums[3] Σ w K, K without its constant
/// factor. Columns from end on, up to kNearPadding of them, are read too: their window must be 0.
void add_near_row(const NearLobe& lobe, const NearRow& row, int begin, int end, double* sums);

/// Columns' edges x between two heights y.
struct NearStrip {
    const double* x = nullptr;
    int count = 0;
    double top = 0.0, bottom = 0.0;
};

/// out[k] = ∫ from 0 to x[k] ∫ from top to bottom (x² + y² + spread)⁻² dy dx for k = 0 … count − 1; both
/// arrays hold kNearPadding more.
void near_corners(const NearStrip& strip, double spread, double* out);

}  // namespace patina::simd

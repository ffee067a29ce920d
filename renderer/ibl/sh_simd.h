// The inner loops of the spherical-harmonic transform, compiled for several instruction sets; the best one
// the machine has is chosen when the program runs. Plain pointers and numbers only; knows no threads and no
// environment.
#pragma once

#include "renderer/ibl/fft.h"

#include <cstddef>

namespace patina::simd {

/// Floats in a vector: so many rings (circles of latitude) are treated side by side.
int lane_count();
/// The instruction set in use, for reports: "AVX2", "NEON", …
const char* instruction_set();
/// Rings the analysis takes at once; ring sets are padded to a multiple of it.
int analysis_group();

/// North rings in order from the pole to the equator, each standing for itself and its mirror image in the
/// south.
struct Rings {
    int padded = 0;                  ///< count, a multiple of the group
    const double* cosine = nullptr;  ///< of the colatitude
    const double* sine = nullptr;
};

/// One order m of the Legendre tables.
struct Column {
    int m = 0;
    int band = 0;
    const double* factor = nullptr;  ///< of the recurrence, at l = m
    const float* factor_single = nullptr;
};

/// Values that belong to one ring pair and order: 12 vectors, [even, odd][red, green, blue][real, imaginary].
inline constexpr int kParts = 12;
/// Coefficients that belong to one degree and order: [red, green, blue][real, imaginary].
inline constexpr int kCoefficients = 6;

/// One block of lane_count() ring pairs of an RGB picture, Fourier transformed, weighted and split by parity.
struct AnalysisBlock {
    const float* const* north = nullptr;  ///< a row of RGB texels for each lane
    const float* const* south = nullptr;
    const FftView* fft = nullptr;
    int orders = 0;                   ///< m = 0 … orders − 1 are written
    int useful_orders = 0;            ///< those from here on are written as 0
    const float* phase = nullptr;     ///< (cos, sin) for each m: the texel's centre and width
    const float* weight = nullptr;    ///< of each lane: its solid angle
    const float* widening = nullptr;  ///< of each lane: δ²/(24 sin²θ)
    float largest_widening = 0.0f;    ///< of widening · m²
    float* work = nullptr;            ///< 2 buffers of 2 · lane_count() · FFT elements floats (aligned)
    float* spectrum = nullptr;        ///< of this block, at m = 0
    std::size_t order_stride = 0;     ///< floats from m to m + 1
};
void analyse_rings(const AnalysisBlock& block);

/// sums[(l − m) · 6 + part] = Σ over rings p_lm · spectrum, for one m. spectrum: blocks of kParts vectors,
/// aligned. accumulators: (band − m + 1 + 4) · 6 vectors of work memory.
void analyse_order(const Column& column, const Rings& rings, const float* spectrum, float* accumulators,
                   float* sums);

/// The way back for one m: coefficients (6 for each l from m on, padded with two degrees of zeros) to kParts
/// vectors a block, block_stride floats apart.
struct SynthesisOrder {
    Column column;
    Rings rings;
    const float* coefficients = nullptr;
    float* spectrum = nullptr;  ///< at this m, of the first block
    std::size_t block_stride = 0;
};
void synthesise_order(const SynthesisOrder& order);

/// One block of ring pairs back to rows of RGB0 texels.
struct SynthesisBlock {
    const float* spectrum = nullptr;  ///< of this block, at m = 0; kParts vectors for each m
    int orders = 0;
    const FftView* fft = nullptr;
    float* work = nullptr;          ///< 6 buffers of 2 · lane_count() · columns floats (aligned)
    float* const* north = nullptr;  ///< where each lane's row of four floats a texel goes; null: nowhere
    float* const* south = nullptr;
};
void synthesise_rings(const SynthesisBlock& block);

/// Reads a picture of four floats a texel between its texels, by Lagrange polynomials through 6 × 6 of them.
struct LagrangeSource {
    const float* texels =
        nullptr;                 ///< first texel of row 0 of the picture proper; rows and columns before and
    std::size_t row_floats = 0;  ///< after it must exist for three texels
    int columns = 0;
    const float* lowest = nullptr;  ///< RGB0: results are clamped to lowest … highest
    const float* highest = nullptr;
};
/// out[i] (RGB) at texel coordinates (x[i], y[i]) (0 = the centre of texel 0), once for each of turns shifts
/// of the columns.
struct LagrangeRow {
    int count = 0;
    const double* x = nullptr;  ///< in columns, any period
    const double* y = nullptr;
    int turns = 0;                ///< 1 or 4
    float* const* out = nullptr;  ///< of each turn
};
void interpolate_row(const LagrangeSource& source, const LagrangeRow& row);

}  // namespace patina::simd

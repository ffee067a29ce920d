// Spherical-harmonic coefficients back to pixels: the loops. Derivations are in sh_transform.cpp.
#include "renderer/ibl/sh_simd.h"

// See sh_analysis_simd.cpp.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/ibl/sh_synthesis_simd.cpp"
#include <hwy/foreach_target.h>
// Must follow foreach_target.h.
#include "renderer/ibl/fft-inl.h"
#include "renderer/ibl/recurrence-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace patina::simd::HWY_NAMESPACE {

/// The sums over even and odd l − m, for the three channels' real and imaginary parts.
struct RingSums {
    Single even[kCoefficients], odd[kCoefficients];
};

HWY_INLINE void add_degree(Single p, const float* coefficients, Single* sums) {
    const Singles d;
    for (int part = 0; part < kCoefficients; ++part)
        sums[part] = hn::MulAdd(p, hn::Set(d, coefficients[part]), sums[part]);
}

HWY_INLINE void sum_degrees(const SynthesisOrder& order, Start<kLanes>& start, float* to) {
    const Singles d;
    const Column& column = order.column;
    Single first[kCoefficients], second[kCoefficients];  // of l − m even and odd
    for (int part = 0; part < kCoefficients; ++part) first[part] = second[part] = hn::Zero(d);
    for (; start.l <= column.band && !is_safe(start); advance(column, start)) {
        to_single(start);
        const int k = start.l - column.m;
        add_degree(hn::Load(d, start.low_single), order.coefficients + std::size_t(kCoefficients) * k,
                   k & 1 ? second : first);
    }
    to_single(start);
    HWY_ALIGN float cosine[kLanes];
    for (int i = 0; i < kLanes; ++i) cosine[i] = float(start.cosine[i]);
    const Single x = hn::Load(d, cosine);
    Single low = hn::Load(d, start.low_single), high = hn::Load(d, start.high_single);
    int k = start.l - column.m;
    const int last = column.band - column.m;
    if ((k & 1) && k <= last) {  // one more step, so that the pairs below begin with an even degree
        add_degree(low, order.coefficients + std::size_t(kCoefficients) * k, second);
        const Single next = hn::MulSub(hn::Mul(x, hn::Set(d, column.factor_single[k + 2])), high, low);
        low = high;
        high = next;
        ++k;
    }
    const float* coefficients = order.coefficients + std::size_t(kCoefficients) * k;
    const float* factor = column.factor_single + k;
    for (; k <= last; k += 2, factor += 2, coefficients += std::ptrdiff_t(2) * kCoefficients) {
        add_degree(low, coefficients, first);
        add_degree(high, coefficients + kCoefficients, second);
        low = hn::MulSub(hn::Mul(x, hn::Set(d, factor[2])), high, low);
        high = hn::MulSub(hn::Mul(x, hn::Set(d, factor[3])), low, high);
    }
    for (int part = 0; part < kCoefficients; ++part) {
        hn::Store(first[part], d, to + std::ptrdiff_t(part) * kLanes);
        hn::Store(second[part], d, to + std::ptrdiff_t(kCoefficients + part) * kLanes);
    }
}

void synthesise_order_here(const SynthesisOrder& order) {
    const Singles d;
    Start<kLanes> start;
    for (int ring = 0; ring < order.rings.padded; ring += kLanes) {
        float* to = order.spectrum + std::size_t(ring / kLanes) * order.block_stride;
        if (climb(order.column, order.rings.cosine + ring, order.rings.sine + ring, start))
            sum_degrees(order, start, to);
        else
            for (int part = 0; part < kParts; ++part)
                hn::Store(hn::Zero(d), d, to + std::ptrdiff_t(part) * kLanes);
    }
}

/// North and south of a ring pair as the real and imaginary part of one inverse transform. Written with real
/// and imaginary parts swapped, which makes the forward passes an inverse.
HWY_INLINE void join_channel(const SynthesisBlock& block, int channel, float* z) {
    const int columns = block.fft->size;
    const std::size_t step = std::size_t(2) * kLanes;
    const float* from = block.spectrum + std::size_t(2 * channel) * kLanes;
    for (int m = 0; m < block.orders; ++m, from += std::size_t(kParts) * kLanes) {
        const Complex even = load(from), odd = load(from + std::ptrdiff_t(6) * kLanes);
        const Complex north = even + odd, south = even - odd;
        if (m == 0) {
            store({south.re, north.re}, z);
            continue;
        }
        // Z_m = N + iS; Z_(W−m) = conj N + i conj S
        store({hn::Add(north.im, south.re), hn::Sub(north.re, south.im)}, z + step * m);
        store({hn::Sub(south.re, north.im), hn::Add(north.re, south.im)}, z + step * (columns - m));
    }
    for (int m = block.orders; m <= columns - block.orders; ++m)
        store({hn::Zero(Singles()), hn::Zero(Singles())}, z + step * m);
}

#if HWY_TARGET == HWY_SCALAR
constexpr int kRowsAtOnce = 1;
HWY_INLINE void scatter_rows(const float* const* planes, int offset, int columns, float* const* rows) {
    if (!rows[0]) return;
    for (int i = 0; i < 4 * columns; ++i)
        rows[0][i] = i % 4 < 3 ? planes[i % 4][std::size_t(2) * (i / 4) + offset] : 0.0f;
}
#else
constexpr int kRowsAtOnce = 4;
/// Four rings of three planes to rows of RGB0 texels.
HWY_INLINE void scatter_rows(const float* const* planes, int offset, int columns, float* const* rows) {
    const hn::FixedTag<float, 4> d;
    for (int x = 0; x < columns; ++x) {
        const std::size_t at = std::size_t(2 * kLanes) * x + offset;
        const auto r = hn::Load(d, planes[0] + at), g = hn::Load(d, planes[1] + at),
                   b = hn::Load(d, planes[2] + at);
        const auto zero = hn::Zero(d);
        const auto rg = hn::InterleaveLower(d, r, g), b0 = hn::InterleaveLower(d, b, zero);
        const auto rg_upper = hn::InterleaveUpper(d, r, g), b0_upper = hn::InterleaveUpper(d, b, zero);
        const auto put = [&](int row, auto v) HWY_ATTR {
            if (rows[row]) hn::StoreU(v, d, rows[row] + std::size_t(4) * x);
        };
        put(0, hn::ConcatLowerLower(d, b0, rg));
        put(1, hn::ConcatUpperUpper(d, b0, rg));
        put(2, hn::ConcatLowerLower(d, b0_upper, rg_upper));
        put(3, hn::ConcatUpperUpper(d, b0_upper, rg_upper));
    }
}
#endif

void synthesise_rings_here(const SynthesisBlock& block) {
    const std::size_t plane = std::size_t(2 * kLanes) * block.fft->size;
    const float* results[3];
    for (int channel = 0; channel < 3; ++channel) {
        float* z = block.work + std::size_t(2) * channel * plane;
        join_channel(block, channel, z);
        results[channel] = run_fft(*block.fft, z, z + plane);
    }
    for (int k = 0; k < kLanes; k += 4) {  // real and imaginary parts come out swapped, too
        scatter_rows(results, kLanes + k, block.fft->size, block.north + k);
        scatter_rows(results, k, block.fft->size, block.south + k);
    }
}

constexpr int kPoints = 6;
/// Lagrange weights of the nodes −2 … 3 at t in [0, 1): Π_(j≠i) (t − j)/(i − j).
HWY_INLINE void lagrange_weights(float t, float* w) {
    const float a = t + 2.0f, b = t + 1.0f, c = t - 1.0f, e = t - 2.0f, f = t - 3.0f;
    const float bt = b * t, abt = a * bt, ef = e * f, cef = c * ef;
    w[0] = bt * cef * (-1.0f / 120.0f);
    w[1] = a * t * cef * (1.0f / 24.0f);
    w[2] = a * b * cef * (-1.0f / 12.0f);
    w[3] = abt * ef * (1.0f / 12.0f);
    w[4] = abt * c * f * (-1.0f / 24.0f);
    w[5] = abt * c * e * (1.0f / 120.0f);
}

#if HWY_TARGET == HWY_SCALAR
struct Weights {
    float x[kPoints], y[kPoints];
};
HWY_INLINE void set_weights(float tx, float ty, Weights& w) {
    lagrange_weights(tx, w.x);
    lagrange_weights(ty, w.y);
}
HWY_INLINE void interpolate_one(const LagrangeSource& source, const float* corner, const Weights& w,
                                float* out) {
    for (int c = 0; c < 3; ++c) {
        float sum = 0.0f;
        for (int j = 0; j < kPoints; ++j) {
            float row = 0.0f;
            for (int i = 0; i < kPoints; ++i) row += w.x[i] * corner[j * source.row_floats + 4 * i + c];
            sum += w.y[j] * row;
        }
        out[c] = sum < source.lowest[c]    ? source.lowest[c]
                 : sum > source.highest[c] ? source.highest[c]
                                           : sum;
    }
}
#else
/// Texels of four floats a vector holds here: one, or two side by side.
using Texels = hn::CappedTag<float, 8>;
constexpr int kTexels = int(hn::MaxLanes(Texels())) / 4;

struct Weights {
    hn::Vec<Texels> x[kPoints];
    float y[kPoints];
};
HWY_INLINE void set_weights(float tx, float ty, Weights& w) {
    float x[kPoints];
    lagrange_weights(tx, x);
    lagrange_weights(ty, w.y);
    const Texels d;
    for (int k = 0; k < kPoints / kTexels; ++k) {
        w.x[k] = hn::Set(d, x[std::ptrdiff_t(k) * kTexels]);
        if (kTexels == 2) w.x[k] = hn::ConcatUpperLower(d, hn::Set(d, x[k * kTexels + 1]), w.x[k]);
    }
}
HWY_INLINE void interpolate_one(const LagrangeSource& source, const float* corner, const Weights& w,
                                float* out) {
    const Texels d;
    const hn::FixedTag<float, 4> d4;
    auto sum = hn::Zero(d);
    for (int j = 0; j < kPoints; ++j, corner += source.row_floats) {
        auto row = hn::Mul(hn::LoadU(d, corner), w.x[0]);
        for (int i = 1; i < kPoints / kTexels; ++i)
            row = hn::MulAdd(hn::LoadU(d, corner + std::ptrdiff_t(4) * kTexels * i), w.x[i], row);
        sum = hn::MulAdd(row, hn::Set(d, w.y[j]), sum);
    }
    HWY_ALIGN float both[8] = {};
    hn::Store(sum, d, both);
    auto value = hn::Load(d4, both);
    if (kTexels == 2) value = hn::Add(value, hn::Load(d4, both + 4));
    value = hn::Max(hn::Min(value, hn::LoadU(d4, source.highest)), hn::LoadU(d4, source.lowest));
    hn::Store(value, d4, both);
    out[0] = both[0];
    out[1] = both[1];
    out[2] = both[2];
}
#endif

void interpolate_row_here(const LagrangeSource& source, const LagrangeRow& row) {
    Weights weights;
    for (int i = 0; i < row.count; ++i) {
        const double x0 = std::floor(row.x[i]), y0 = std::floor(row.y[i]);
        set_weights(float(row.x[i] - x0), float(row.y[i] - y0), weights);
        const float* line = source.texels + (std::ptrdiff_t(y0) - 2) * std::ptrdiff_t(source.row_floats);
        int column = int(x0) % source.columns;
        if (column < 0) column += source.columns;
        for (int turn = 0; turn < row.turns; ++turn) {
            interpolate_one(source, line + std::ptrdiff_t(4) * (column - 2), weights,
                            row.out[turn] + std::ptrdiff_t(3) * i);
            column += source.columns / 4;
            if (column >= source.columns) column -= source.columns;
        }
    }
}

}  // namespace patina::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace patina::simd {

HWY_EXPORT(synthesise_order_here);
HWY_EXPORT(synthesise_rings_here);
HWY_EXPORT(interpolate_row_here);

void synthesise_order(const SynthesisOrder& order) { HWY_DYNAMIC_DISPATCH(synthesise_order_here)(order); }
void synthesise_rings(const SynthesisBlock& block) { HWY_DYNAMIC_DISPATCH(synthesise_rings_here)(block); }
void interpolate_row(const LagrangeSource& source, const LagrangeRow& row) {
    HWY_DYNAMIC_DISPATCH(interpolate_row_here)(source, row);
}

}  // namespace patina::simd
#endif

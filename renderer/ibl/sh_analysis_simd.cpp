// Pixels to spherical-harmonic coefficients: the loops. Derivations are in sh_transform.cpp.
#include "renderer/ibl/sh_simd.h"

// Vectors are kept in arrays and structures here, which the instruction sets of unknown vector length do not
// allow; machines that have them also have one of the others.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/ibl/sh_analysis_simd.cpp"
#include <hwy/foreach_target.h>
// Must follow foreach_target.h.
#include "renderer/ibl/fft-inl.h"
#include "renderer/ibl/recurrence-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace patina::simd::HWY_NAMESPACE {

constexpr int kGroupVectors = kLanes >= 16 ? 2 : 4;
constexpr int kGroupRings = kGroupVectors * kLanes;

int lane_count_here() { return kLanes; }
int analysis_group_here() { return kGroupRings; }
const char* name_here() { return hwy::TargetName(HWY_TARGET); }

#if HWY_TARGET == HWY_SCALAR
constexpr int kRowsAtOnce = 1;
HWY_INLINE void gather_rows(const float* const* rows, int columns, float* to) {
    for (int i = 0; i < 3 * columns; ++i)
        to[std::size_t(i % 3) * 2 * columns + std::size_t(i / 3) * 2] = rows[0][i];
}
#else
constexpr int kRowsAtOnce = 4;
/// Four rows of interleaved RGB to planes where the lanes of a texel lie side by side: 4 × 4 floats at a
/// time.
HWY_INLINE void gather_rows(const float* const* rows, int columns, float* to) {
    const hn::FixedTag<float, 4> d;
    const int floats = 3 * columns;
    const std::size_t plane = std::size_t(2 * kLanes) * columns;
    int i = 0;
    for (; i + 4 <= floats; i += 4) {
        const auto r0 = hn::LoadU(d, rows[0] + i), r1 = hn::LoadU(d, rows[1] + i);
        const auto r2 = hn::LoadU(d, rows[2] + i), r3 = hn::LoadU(d, rows[3] + i);
        const auto a = hn::InterleaveLower(d, r0, r1), b = hn::InterleaveLower(d, r2, r3);
        const auto c = hn::InterleaveUpper(d, r0, r1), e = hn::InterleaveUpper(d, r2, r3);
        const auto put = [&](int at, auto v) HWY_ATTR {
            hn::Store(v, d, to + (at % 3) * plane + std::size_t(at / 3) * 2 * kLanes);
        };
        put(i, hn::ConcatLowerLower(d, b, a));
        put(i + 1, hn::ConcatUpperUpper(d, b, a));
        put(i + 2, hn::ConcatLowerLower(d, e, c));
        put(i + 3, hn::ConcatUpperUpper(d, e, c));
    }
    for (; i < floats; ++i)
        for (int k = 0; k < 4; ++k) to[(i % 3) * plane + std::size_t(i / 3) * 2 * kLanes + k] = rows[k][i];
}
#endif

/// The transform of north + i·south separates by symmetry: Z_m + conj Z_(W−m) is twice the north's, the
/// difference 2i times the south's. Their sum goes with the even P (l − m even), their difference with the
/// odd.
HWY_INLINE void split_channel(const AnalysisBlock& block, const float* z, int channel) {
    const Singles d;
    const int columns = block.fft->size;
    const auto weight = hn::LoadU(d, block.weight), widening = hn::LoadU(d, block.widening);
    const auto largest = hn::Set(d, block.largest_widening), one = hn::Set(d, 1.0f);
    for (int m = 0; m < block.orders; ++m) {
        float* even = block.spectrum + m * block.order_stride + std::size_t(2 * channel) * kLanes;
        float* odd = even + std::ptrdiff_t(6) * kLanes;
        if (m >= block.useful_orders) {
            for (int i = 0; i < 2; ++i)
                hn::Store(hn::Zero(d), d, even + std::ptrdiff_t(i) * kLanes),
                    hn::Store(hn::Zero(d), d, odd + std::ptrdiff_t(i) * kLanes);
            continue;
        }
        const Complex p = load(z + std::size_t(2 * kLanes) * m);
        const Complex q = load(z + std::size_t(2 * kLanes) * (m ? columns - m : 0));
        const Complex north = {hn::Add(p.re, q.re), hn::Sub(p.im, q.im)};
        const Complex south = {hn::Add(p.im, q.im), hn::Sub(q.re, p.re)};
        // e^y to fourth order, y = m² δ²/(24 sin²θ)
        const auto y = hn::Min(hn::Mul(widening, hn::Set(d, float(m) * float(m))), largest);
        auto e = hn::MulAdd(y, hn::Set(d, 1.0f / 24.0f), hn::Set(d, 1.0f / 6.0f));
        e = hn::MulAdd(hn::MulAdd(hn::MulAdd(e, y, hn::Set(d, 0.5f)), y, one), y, one);
        const auto w = hn::Mul(weight, e);
        const Complex a = times(north + south, block.phase + std::ptrdiff_t(2) * m),
                      b = times(north - south, block.phase + std::ptrdiff_t(2) * m);
        store({hn::Mul(a.re, w), hn::Mul(a.im, w)}, even);
        store({hn::Mul(b.re, w), hn::Mul(b.im, w)}, odd);
    }
}

void analyse_rings_here(const AnalysisBlock& block) {
    const int columns = block.fft->size;
    const int elements = block.fft->convolution ? block.fft->convolution->size : columns;
    const std::size_t plane = std::size_t(2 * kLanes) * columns, buffer = std::size_t(2 * kLanes) * elements;
    for (int k = 0; k < kLanes; k += kRowsAtOnce) {
        gather_rows(block.north + k, columns, block.work + k);
        gather_rows(block.south + k, columns, block.work + kLanes + k);
    }
    // Planes lie one after the other; a transform may need more room than a plane, so it works beside them.
    float* x = block.work + 3 * plane;
    float* y = x + buffer;
    for (int channel = 0; channel < 3; ++channel) {
        float* from = block.work + channel * plane;
        if (block.fft->convolution) {
            for (std::size_t i = 0; i < plane; i += kLanes)
                hn::Store(hn::Load(Singles(), from + i), Singles(), x + i);
            split_channel(block, run_fft(*block.fft, x, y), channel);
        } else {
            split_channel(block, run_fft(*block.fft, from, x), channel);
        }
    }
}

/// sums += p · spectrum for one degree: six parts, kGroupVectors vectors of rings.
HWY_INLINE void accumulate(const Single* p, const float* spectrum, float* sums) {
    const Singles d;
    for (int part = 0; part < kCoefficients; ++part) {
        auto sum = hn::MulAdd(p[0], hn::Load(d, spectrum + std::ptrdiff_t(part) * kLanes),
                              hn::Load(d, sums + std::ptrdiff_t(part) * kLanes));
        for (int v = 1; v < kGroupVectors; ++v)
            sum = hn::MulAdd(p[v], hn::Load(d, spectrum + (std::size_t(kParts) * v + part) * kLanes), sum);
        hn::Store(sum, d, sums + std::ptrdiff_t(part) * kLanes);
    }
}

/// All degrees of one group of rings.
HWY_INLINE void accumulate_group(const Column& column, Start<kGroupRings>& start, const float* spectrum,
                                 float* sums) {
    const Singles d;
    constexpr std::ptrdiff_t to_odd = std::ptrdiff_t(6) * kLanes,
                             degree = std::ptrdiff_t(kCoefficients) * kLanes;
    Single low[kGroupVectors], high[kGroupVectors], x[kGroupVectors];
    const auto fetch = [&]() HWY_ATTR {
        to_single(start);
        for (int v = 0; v < kGroupVectors; ++v) {
            low[v] = hn::Load(d, start.low_single + std::ptrdiff_t(v) * kLanes);
            high[v] = hn::Load(d, start.high_single + std::ptrdiff_t(v) * kLanes);
        }
    };
    for (; start.l <= column.band && !is_safe(start); advance(column, start)) {
        fetch();
        const int k = start.l - column.m;
        accumulate(low, spectrum + (k & 1 ? to_odd : 0), sums + std::size_t(k) * degree);
    }
    fetch();
    for (int v = 0; v < kGroupVectors; ++v) {
        HWY_ALIGN float cosine[kLanes];
        for (int i = 0; i < kLanes; ++i) cosine[i] = float(start.cosine[v * kLanes + i]);
        x[v] = hn::Load(d, cosine);
    }
    const int k = start.l - column.m;
    const float* first = spectrum + (k & 1 ? to_odd : 0);
    const float* second = spectrum + (k & 1 ? 0 : to_odd);
    const float* factor = column.factor_single + k;
    float* to = sums + std::size_t(k) * degree;
    for (int l = start.l; l <= column.band; l += 2, factor += 2, to += 2 * degree) {
        accumulate(low, first, to);
        accumulate(high, second, to + degree);
        const auto f2 = hn::Set(d, factor[2]), f3 = hn::Set(d, factor[3]);
        for (int v = 0; v < kGroupVectors; ++v) {
            low[v] = hn::MulSub(hn::Mul(x[v], f2), high[v], low[v]);
            high[v] = hn::MulSub(hn::Mul(x[v], f3), low[v], high[v]);
        }
    }
}

void analyse_order_here(const Column& column, const Rings& rings, const float* spectrum, float* accumulators,
                        float* sums) {
    const Singles d;
    const int degrees = column.band - column.m + 1;
    for (int i = 0; i < (degrees + 4) * kCoefficients; ++i)
        hn::Store(hn::Zero(d), d, accumulators + std::size_t(i) * kLanes);
    Start<kGroupRings> start;
    for (int ring = 0; ring < rings.padded; ring += kGroupRings)
        if (climb(column, rings.cosine + ring, rings.sine + ring, start))
            accumulate_group(column, start, spectrum + std::size_t(kParts) * ring, accumulators);
    for (int i = 0; i < degrees * kCoefficients; ++i)
        sums[i] = hn::GetLane(hn::SumOfLanes(d, hn::Load(d, accumulators + std::size_t(i) * kLanes)));
}

}  // namespace patina::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace patina::simd {

HWY_EXPORT(lane_count_here);
HWY_EXPORT(analysis_group_here);
HWY_EXPORT(name_here);
HWY_EXPORT(analyse_rings_here);
HWY_EXPORT(analyse_order_here);

int lane_count() { return HWY_DYNAMIC_DISPATCH(lane_count_here)(); }
int analysis_group() { return HWY_DYNAMIC_DISPATCH(analysis_group_here)(); }
const char* instruction_set() { return HWY_DYNAMIC_DISPATCH(name_here)(); }
void analyse_rings(const AnalysisBlock& block) { HWY_DYNAMIC_DISPATCH(analyse_rings_here)(block); }
void analyse_order(const Column& column, const Rings& rings, const float* spectrum, float* accumulators,
                   float* sums) {
    HWY_DYNAMIC_DISPATCH(analyse_order_here)(column, rings, spectrum, accumulators, sums);
}

}  // namespace patina::simd
#endif

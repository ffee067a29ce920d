// Starting the Legendre recurrence so that single precision can carry it on. Included once for every
// instruction set.
#if defined(PATINA_RECURRENCE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PATINA_RECURRENCE_INL_H
#undef PATINA_RECURRENCE_INL_H
#else
#define PATINA_RECURRENCE_INL_H
#endif

#include "renderer/ibl/sh_simd.h"

#include <cmath>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace patina::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
constexpr int kDoubleLanes = int(hn::MaxLanes(Doubles()));

// p_m = sin^m θ spans hundreds of orders of magnitude: it starts in double, and what is below kNegligible of
// the largest value a function reaches (about 1) is skipped. A ring may be far smaller than its neighbours in
// a group, yet grow later: the recurrence stays in double until every ring that matters is above kSafe, well
// inside single precision. Values that single precision could only hold as denormals (slow) become zero.
constexpr double kNegligible = 1e-11;
constexpr double kSafe = 1e-30;

/// Degrees and orders up to the band reach a ring only as far as its circumference holds waves: P̄_lm decays
/// exponentially where m > l sin θ.
HWY_INLINE bool reaches(const Column& column, double sine) {
    return column.m <= (column.band + 0.5) * sine + 10.0 + 0.02 * column.band;
}

/// p_l and p_(l+1) of kRings rings.
template <int kRings>
struct Start {
    int l = 0;
    HWY_ALIGN double cosine[kRings];
    HWY_ALIGN double low[kRings];
    HWY_ALIGN double high[kRings];
    HWY_ALIGN float low_single[kRings];
    HWY_ALIGN float high_single[kRings];
    int smallest = 0;  ///< the ring nearest the pole that matters
};

/// One degree further, in double.
template <int kRings>
HWY_INLINE void advance(const Column& column, Start<kRings>& start) {
    const Doubles d;
    const auto factor = hn::Set(d, column.factor[start.l + 2 - column.m]);
    for (int i = 0; i < kRings; i += kDoubleLanes) {
        const auto high = hn::Load(d, start.high + i);
        const auto x = hn::Mul(hn::Load(d, start.cosine + i), factor);
        const auto next = hn::MulSub(x, high, hn::Load(d, start.low + i));
        hn::Store(high, d, start.low + i);
        hn::Store(next, d, start.high + i);
    }
    ++start.l;
}

template <int kRings>
HWY_INLINE void to_single(Start<kRings>& start) {
    const auto flush = [](double value) { return value < kSafe && value > -kSafe ? 0.0f : float(value); };
    for (int i = 0; i < kRings; ++i) {
        start.low_single[i] = flush(start.low[i]);
        start.high_single[i] = flush(start.high[i]);
    }
}

/// Climbs to the first degree where the ring nearest the equator (the last, and the largest here) is not
/// negligible. False if there is none up to the band.
template <int kRings>
HWY_INLINE bool climb(const Column& column, const double* cosine, const double* sine, Start<kRings>& start) {
    if (!reaches(column, sine[kRings - 1])) return false;
    const Doubles d;
    start.smallest = 0;
    while (start.smallest < kRings - 1 && !reaches(column, sine[start.smallest])) ++start.smallest;
    for (int i = 0; i < kRings; i += kDoubleLanes) {
        auto power = hn::Set(d, 1.0), square = hn::LoadU(d, sine + i);
        const auto x = hn::LoadU(d, cosine + i);
        for (int exponent = column.m; exponent > 0; exponent >>= 1) {
            if (exponent & 1) power = hn::Mul(power, square);
            square = hn::Mul(square, square);
        }
        hn::Store(x, d, start.cosine + i);
        hn::Store(power, d, start.low + i);
        hn::Store(hn::Mul(x, power), d, start.high + i);
    }
    for (int i = 0; i < start.smallest; ++i) start.low[i] = start.high[i] = 0.0;
    start.l = column.m;
    while (std::fabs(start.low[kRings - 1]) <= kNegligible &&
           std::fabs(start.high[kRings - 1]) <= kNegligible)
        for (int i = 0; i < 4; ++i) {
            if (start.l >= column.band) return false;
            advance(column, start);
        }
    return true;
}

/// True once single precision can carry on.
template <int kRings>
HWY_INLINE bool is_safe(const Start<kRings>& start) {
    return std::fabs(start.low[start.smallest]) > kSafe || std::fabs(start.high[start.smallest]) > kSafe;
}

}  // namespace patina::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// Points of light seen through a GGX lobe: the loops.
#include "renderer/ibl/fold_simd.h"

// See sh_analysis_simd.cpp.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/ibl/fold_simd.cpp"
#include <hwy/foreach_target.h>
// Must follow foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace patina::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <bool kFar>
HWY_INLINE void add_to_lanes(const FoldPoints& points, const FoldLobe& lobe, FoldDirections& to, int first) {
    const hn::CappedTag<float, kFoldDirections> d;
    const auto x = hn::LoadU(d, to.x + first), y = hn::LoadU(d, to.y + first), z = hn::LoadU(d, to.z + first);
    const auto one = hn::Set(d, 1.0f), zero = hn::Zero(d), quarter = hn::Set(d, 0.25f);
    const auto alpha2 = hn::Set(d, lobe.alpha2), rest = hn::Set(d, 1.0f - lobe.alpha2);
    auto red = hn::LoadU(d, to.sums[0] + first), green = hn::LoadU(d, to.sums[1] + first),
         blue = hn::LoadU(d, to.sums[2] + first);
    for (int i = 0; i < points.count; ++i) {
        const auto dx = hn::Sub(hn::Set(d, points.x[i]), x), dy = hn::Sub(hn::Set(d, points.y[i]), y),
                   dz = hn::Sub(hn::Set(d, points.z[i]), z);
        const auto square = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
        const auto s = hn::Mul(square, quarter);
        const auto inverse = hn::Div(one, hn::MulAdd(s, rest, alpha2));  // 1 / (s + α² (1 − s))
        auto kernel = hn::Max(zero, hn::NegMulAdd(hn::Set(d, 2.0f), s, one));
        kernel = hn::Mul(hn::Mul(kernel, alpha2), hn::Mul(inverse, inverse));
        if (kFar) {
            const auto t = hn::Min(one, hn::Max(zero, hn::Mul(hn::Sub(square, hn::Set(d, lobe.inner_square)),
                                                              hn::Set(d, lobe.window_scale))));
            const auto t2 = hn::Mul(t, t);
            const auto bend = hn::NegMulAdd(hn::Set(d, 20.0f), t, hn::Set(d, 70.0f));
            const auto rise = hn::MulAdd(hn::MulAdd(bend, t, hn::Set(d, -84.0f)), t, hn::Set(d, 35.0f));
            kernel = hn::Mul(kernel, hn::Mul(hn::Mul(t2, t2), rise));
        }
        red = hn::MulAdd(kernel, hn::Set(d, points.flux[0][i]), red);
        green = hn::MulAdd(kernel, hn::Set(d, points.flux[1][i]), green);
        blue = hn::MulAdd(kernel, hn::Set(d, points.flux[2][i]), blue);
    }
    hn::StoreU(red, d, to.sums[0] + first);
    hn::StoreU(green, d, to.sums[1] + first);
    hn::StoreU(blue, d, to.sums[2] + first);
}

void add_points_here(const FoldPoints& points, const FoldLobe& lobe, FoldDirections& directions) {
    const hn::CappedTag<float, kFoldDirections> d;
    for (int first = 0; first < kFoldDirections; first += int(hn::Lanes(d)))
        if (lobe.window_scale > 0.0f)
            add_to_lanes<true>(points, lobe, directions, first);
        else
            add_to_lanes<false>(points, lobe, directions, first);
}

}  // namespace patina::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace patina::simd {

HWY_EXPORT(add_points_here);

void add_points(const FoldPoints& points, const FoldLobe& lobe, FoldDirections& directions) {
    HWY_DYNAMIC_DISPATCH(add_points_here)(points, lobe, directions);
}

}  // namespace patina::simd
#endif

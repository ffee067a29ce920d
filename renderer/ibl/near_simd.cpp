// The near field's loops. Derivations are in near_field.cpp.
#include "renderer/ibl/near_simd.h"

#include <cmath>
#include <cstddef>

// See sh_analysis_simd.cpp.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/ibl/near_simd.cpp"
#include <hwy/foreach_target.h>
// Must follow foreach_target.h.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace patina::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void add_near_row_here(const NearLobe& lobe, const NearRow& row, int begin, int end, double* sums) {
    const hn::ScalableTag<float> d;
    const int lanes = int(hn::Lanes(d));
    const auto one = hn::Set(d, 1.0f), zero = hn::Zero(d), minus_half = hn::Set(d, -0.5f);
    const auto metric = hn::Set(d, row.metric), y_square = hn::Set(d, row.y_square);
    const auto spread = hn::Set(d, lobe.spread);
    const auto inner = hn::Set(d, lobe.inner_square), scale = hn::Set(d, lobe.window_scale);
    const auto across = hn::Set(d, row.column_side_square);
    const auto along = hn::Set(d, row.row_side_square * row.y_square);
    const auto sides = hn::Set(d, -(row.column_side_square + row.row_side_square) / 6.0f);
    const auto w0 = hn::Set(d, 35.0f), w1 = hn::Set(d, -84.0f), w2 = hn::Set(d, 70.0f),
               w3 = hn::Set(d, -20.0f);
    auto red = zero, green = zero, blue = zero, kernel = zero;
    for (int x = begin; x < end; x += lanes) {
        const auto x_square = hn::Mul(hn::LoadU(d, row.square + x), metric);
        const auto square = hn::Add(x_square, y_square);
        const auto inverse = hn::Div(one, hn::Add(square, spread));
        const auto second = hn::MulAdd(hn::MulAdd(x_square, across, along), inverse, sides);
        const auto t = hn::Min(one, hn::Max(zero, hn::Mul(hn::Sub(square, inner), scale)));
        const auto t2 = hn::Mul(t, t);
        const auto fall = hn::MulAdd(hn::MulAdd(hn::MulAdd(w3, t, w2), t, w1), t, w0);
        auto weight = hn::NegMulAdd(hn::Mul(t2, t2), fall, one);
        weight = hn::Mul(weight, hn::MulAdd(square, minus_half, one));
        weight = hn::Mul(weight, hn::Mul(hn::Mul(inverse, inverse), hn::MulAdd(second, inverse, one)));
        weight = hn::IfThenZeroElse(hn::Ge(t, one), weight);  // exactly, wherever rounding leaves it
        kernel = hn::Add(kernel, weight);
        red = hn::MulAdd(weight, hn::LoadU(d, row.red + x), red);
        green = hn::MulAdd(weight, hn::LoadU(d, row.green + x), green);
        blue = hn::MulAdd(weight, hn::LoadU(d, row.blue + x), blue);
    }
    sums[0] += double(hn::GetLane(hn::SumOfLanes(d, red)));
    sums[1] += double(hn::GetLane(hn::SumOfLanes(d, green)));
    sums[2] += double(hn::GetLane(hn::SumOfLanes(d, blue)));
    sums[3] += double(hn::GetLane(hn::SumOfLanes(d, kernel)));
}

void near_corners_here(const NearStrip& strip, double spread, double* out) {
    const double top = strip.top, bottom = strip.bottom;
    const hn::ScalableTag<double> d;
    const auto c2 = hn::Set(d, spread), scale = hn::Set(d, 0.5 / spread), one = hn::Set(d, 1.0);
    const double top_root = std::sqrt(top * top + spread), bottom_root = std::sqrt(bottom * bottom + spread);
    const auto y0 = hn::Set(d, top), y1 = hn::Set(d, bottom);
    const auto top_inverse = hn::Set(d, 1.0 / top_root), bottom_inverse = hn::Set(d, 1.0 / bottom_root);
    const auto top_slope = hn::Set(d, top / top_root), bottom_slope = hn::Set(d, bottom / bottom_root);
    for (int k = 0; k < strip.count; k += int(hn::Lanes(d))) {
        const auto v = hn::LoadU(d, strip.x + k);
        const auto inverse = hn::Div(one, hn::Sqrt(hn::MulAdd(v, v, c2)));
        const auto straight = hn::Mul(hn::Mul(v, inverse), hn::Sub(hn::Atan(d, hn::Mul(y1, inverse)),
                                                                   hn::Atan(d, hn::Mul(y0, inverse))));
        const auto low = hn::Mul(top_slope, hn::Atan(d, hn::Mul(v, top_inverse)));
        const auto high = hn::Mul(bottom_slope, hn::Atan(d, hn::Mul(v, bottom_inverse)));
        hn::StoreU(hn::Mul(scale, hn::Add(straight, hn::Sub(high, low))), d, out + k);
    }
}

}  // namespace patina::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace patina::simd {

HWY_EXPORT(add_near_row_here);
HWY_EXPORT(near_corners_here);

void add_near_row(const NearLobe& lobe, const NearRow& row, int begin, int end, double* sums) {
    HWY_DYNAMIC_DISPATCH(add_near_row_here)(lobe, row, begin, end, sums);
}
void near_corners(const NearStrip& strip, double spread, double* out) {
    HWY_DYNAMIC_DISPATCH(near_corners_here)(strip, spread, out);
}

}  // namespace patina::simd
#endif

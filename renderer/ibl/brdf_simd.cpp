#include "renderer/ibl/brdf_simd.h"

#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/ibl/brdf_simd.cpp"
#include <hwy/foreach_target.h>
// Must follow foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace patina::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kAlbedoNodes>;
using Float = hn::Vec<Floats>;

/// 1 + Smith's Λ at a cosine whose square is c2: ½ + ½ √(1 + α² (1 − c²)/c²).
HWY_INLINE Float one_plus_lambda(Float c2, Float alpha2) {
    const Floats d;
    const Float one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
    const Float tan2 = hn::Div(hn::Sub(one, c2), c2);
    return hn::MulAdd(half, hn::Sqrt(hn::MulAdd(alpha2, tan2, one)), half);
}

void directional_albedo_here(const AlbedoNodes& nodes, const AlbedoView& view, float* scale, float* bias) {
    const Floats d;
    const Float one = hn::Set(d, 1.0f), two = hn::Set(d, 2.0f), zero = hn::Zero(d);
    const Float alpha = hn::Set(d, view.alpha), alpha2 = hn::Mul(alpha, alpha);
    const Float NoV = hn::Set(d, view.NoV), sin_v = hn::Set(d, view.sin_v);
    const Float vx = hn::Set(d, view.vx), vz = hn::Set(d, view.vz), cap = hn::Set(d, view.cap);
    const Float lambda_v = hn::Set(d, view.lambda_v), g_v = hn::Set(d, 1.0f + view.lambda_v);
    Float sum_a = zero, sum_b = zero;
    for (int i = 0; i < nodes.count; i += int(hn::Lanes(d))) {
        const Float depth = hn::Mul(cap, hn::LoadU(d, nodes.height + i));  // 1 − z
        const Float z = hn::Sub(one, depth);
        const Float ring = hn::Sqrt(hn::Max(zero, hn::Mul(depth, hn::Sub(two, depth))));  // √(1 − z²)
        const Float hx = hn::Mul(alpha, hn::MulAdd(ring, hn::LoadU(d, nodes.cos_phi + i), vx));
        const Float hy = hn::Mul(alpha, hn::Mul(ring, hn::LoadU(d, nodes.sin_phi + i)));
        const Float hz = hn::Add(z, vz);
        const Float flat2 = hn::MulAdd(hx, hx, hn::Mul(hy, hy)), hz2 = hn::Mul(hz, hz);
        const Float length2 = hn::Add(flat2, hz2);
        const Float VoH = hn::Div(hn::MulAdd(hx, sin_v, hn::Mul(hz, NoV)), hn::Sqrt(length2));
        // l = 2 (v·h) h − v, its z gathered so that nothing cancels at grazing angles
        const Float doubled = hn::Mul(two, hn::Mul(hx, hn::Mul(hz, sin_v)));
        const Float NoL = hn::Div(hn::MulAdd(NoV, hn::Sub(hz2, flat2), doubled), length2);
        const Float lit = hn::IfThenElse(hn::Gt(NoL, zero), hn::LoadU(d, nodes.weight + i), zero);
        const Float c2 = hn::Max(hn::Mul(NoL, NoL), hn::Set(d, 1e-20f));
        const Float g = hn::Div(hn::Mul(lit, g_v), hn::Add(lambda_v, one_plus_lambda(c2, alpha2)));
        const Float c = hn::Sub(one, VoH), cc = hn::Mul(c, c);
        const Float fresnel = hn::Mul(g, hn::Mul(hn::Mul(cc, cc), c));
        sum_a = hn::Add(sum_a, hn::Sub(g, fresnel));
        sum_b = hn::Add(sum_b, fresnel);
    }
    *scale = hn::GetLane(hn::SumOfLanes(d, sum_a));
    *bias = hn::GetLane(hn::SumOfLanes(d, sum_b));
}

}  // namespace patina::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace patina::simd {

HWY_EXPORT(directional_albedo_here);

void directional_albedo(const AlbedoNodes& nodes, const AlbedoView& view, float* scale, float* bias) {
    HWY_DYNAMIC_DISPATCH(directional_albedo_here)(nodes, view, scale, bias);
}

}  // namespace patina::simd
#endif

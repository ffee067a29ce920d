// Sums of Legendre polynomials: the loops.
#include "renderer/ibl/kernel_simd.h"

// See sh_analysis_simd.cpp.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/ibl/kernel_simd.cpp"
#include <hwy/foreach_target.h>
// Must follow foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace patina::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void add_legendre_here(const double* x, const double* weight, int count, int band, double* sums) {
    const hn::CappedTag<double, kNodesAtOnce> d;
    constexpr int lanes = int(hn::MaxLanes(d)), vectors = kNodesAtOnce / lanes;
    using Vector = hn::Vec<decltype(d)>;
    for (int first = 0; first < count; first += kNodesAtOnce) {
        Vector at[vectors], w[vectors], p[vectors], before[vectors];
        for (int v = 0; v < vectors; ++v) {
            at[v] = hn::LoadU(d, x + first + std::ptrdiff_t(v) * lanes);
            w[v] = hn::LoadU(d, weight + first + std::ptrdiff_t(v) * lanes);
            p[v] = hn::Set(d, 1.0);
            before[v] = hn::Zero(d);
        }
        double* sum = sums;
        for (int l = 0; l <= band;
             ++l, sum += kNodesAtOnce) {  // (l + 1) P_(l+1) = (2l + 1) x P_l − l P_(l−1)
            const double b = double(l) / (l + 1.0);
            const auto forth = hn::Set(d, 1.0 + b), back = hn::Set(d, b);
            for (int v = 0; v < vectors; ++v) {
                hn::StoreU(hn::MulAdd(w[v], p[v], hn::LoadU(d, sum + std::ptrdiff_t(v) * lanes)), d,
                           sum + std::ptrdiff_t(v) * lanes);
                const auto next = hn::MulSub(hn::Mul(forth, at[v]), p[v], hn::Mul(back, before[v]));
                before[v] = p[v];
                p[v] = next;
            }
        }
    }
}

}  // namespace patina::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace patina::simd {

HWY_EXPORT(add_legendre_here);

void add_legendre(const double* x, const double* weight, int count, int band, double* sums) {
    HWY_DYNAMIC_DISPATCH(add_legendre_here)(x, weight, count, band, sums);
}

}  // namespace patina::simd
#endif

// Sums and ranges of RGB texels: the loops.
#include "renderer/ibl/panorama_simd.h"

#include <algorithm>

// See sh_analysis_simd.cpp.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/ibl/panorama_simd.cpp"
#include <hwy/foreach_target.h>
// Must follow foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace patina::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Part = hn::CappedTag<float, 4>;
constexpr int kPartLanes = int(hn::MaxLanes(Part())), kVectors = kTogether / kPartLanes;

void measure_texels_here(const float* texels, int count, TexelRange& range, float* sum) {
    const Part d;
    hn::Vec<Part> sums[kVectors], lowest[kVectors], highest[kVectors];
    for (int v = 0; v < kVectors; ++v) {
        sums[v] = hn::Zero(d);
        lowest[v] = hn::LoadU(d, range.lowest + std::ptrdiff_t(v) * kPartLanes);
        highest[v] = hn::LoadU(d, range.highest + std::ptrdiff_t(v) * kPartLanes);
    }
    int i = 0;
    for (; i + kTogether <= 3 * count; i += kTogether)
        for (int v = 0; v < kVectors; ++v) {
            const auto value = hn::LoadU(d, texels + i + std::ptrdiff_t(v) * kPartLanes);
            sums[v] = hn::Add(sums[v], value);
            lowest[v] = hn::Min(lowest[v], value);
            highest[v] = hn::Max(highest[v], value);
        }
    float places[kTogether];
    for (int v = 0; v < kVectors; ++v) {
        hn::StoreU(sums[v], d, places + std::ptrdiff_t(v) * kPartLanes);
        hn::StoreU(lowest[v], d, range.lowest + std::ptrdiff_t(v) * kPartLanes);
        hn::StoreU(highest[v], d, range.highest + std::ptrdiff_t(v) * kPartLanes);
    }
    for (int k = 0; i < 3 * count; ++i, ++k) {
        places[k] += texels[i];
        range.lowest[k] = std::min(range.lowest[k], texels[i]);
        range.highest[k] = std::max(range.highest[k], texels[i]);
    }
    for (int c = 0; c < 3; ++c) sum[c] = (places[c] + places[c + 3]) + (places[c + 6] + places[c + 9]);
}

}  // namespace patina::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace patina::simd {

HWY_EXPORT(measure_texels_here);

void measure_texels(const float* texels, int count, TexelRange& range, float* sum) {
    HWY_DYNAMIC_DISPATCH(measure_texels_here)(texels, count, range, sum);
}

}  // namespace patina::simd
#endif

// Halves of RGB texels: the loops.
#include "renderer/ibl/half_simd.h"

#include <algorithm>

// See sh_analysis_simd.cpp.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/ibl/half_simd.cpp"
#include <hwy/foreach_target.h>
// Must follow foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace patina::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Words = hn::RebindToUnsigned<Floats>;
using SignedWords = hn::RebindToSigned<Floats>;
using Halves = hn::Rebind<std::uint16_t, Floats>;

float largest_of_here(const float* values, int count, float least) {
    const Floats d;
    const int lanes = int(hn::Lanes(d));
    auto largest = hn::Set(d, least), other = largest;
    int i = 0;
    for (; i + 2 * lanes <= count; i += 2 * lanes) {
        largest = hn::Max(largest, hn::LoadU(d, values + i));
        other = hn::Max(other, hn::LoadU(d, values + i + lanes));
    }
    float result = hn::GetLane(hn::MaxOfLanes(d, hn::Max(largest, other)));
    for (; i < count; ++i) result = std::max(result, values[i]);
    return result;
}

/// gl::to_half, lane by lane; its comments say why this rounds.
template <class V>
hn::Vec<Halves> halves_of(V value) {
    const Floats d;
    const Words words;
    const auto bits = hn::BitCast(words, value);
    const auto magnitude = hn::And(bits, hn::Set(words, 0x7fffffffu));
    const auto sign = hn::And(hn::ShiftRight<16>(bits), hn::Set(words, 0x8000u));
    const auto middle = hn::Set(d, 0.5f);
    const auto subnormal =
        hn::Sub(hn::BitCast(words, hn::Add(hn::BitCast(d, magnitude), middle)), hn::BitCast(words, middle));
    const auto odd = hn::And(hn::ShiftRight<13>(magnitude), hn::Set(words, 1u));
    const auto normal = hn::ShiftRight<13>(hn::Add(hn::Add(magnitude, hn::Set(words, 0xc8000fffu)), odd));
    const auto is_small = hn::Lt(magnitude, hn::Set(words, 0x38800000u));
    const auto half = hn::Or(sign, hn::IfThenElse(is_small, subnormal, normal));
    return hn::DemoteTo(Halves(), hn::BitCast(SignedWords(), half));
}

void to_rgba_halves_here(const float* rgb, int count, float scale, std::uint16_t* rgba) {
    const Floats d;
    const Halves halves;
    const int lanes = int(hn::Lanes(d));
    const auto factor = hn::Set(d, scale);
    const auto one = hn::Set(halves, std::uint16_t{0x3c00});
    const auto convert = [&](const float* from, std::uint16_t* to) {
        hn::Vec<Floats> r, g, b;
        hn::LoadInterleaved3(d, from, r, g, b);
        hn::StoreInterleaved4(halves_of(hn::Mul(r, factor)), halves_of(hn::Mul(g, factor)),
                              halves_of(hn::Mul(b, factor)), one, halves, to);
    };
    int i = 0;
    for (; i + lanes <= count; i += lanes) convert(rgb + 3 * std::ptrdiff_t(i), rgba + 4 * std::ptrdiff_t(i));
    if (i == count) return;
    constexpr int most = int(hn::MaxLanes(Floats()));
    float last[3 * most] = {};
    std::uint16_t made[4 * most];
    std::copy(rgb + 3 * std::ptrdiff_t(i), rgb + 3 * std::ptrdiff_t(count), last);
    convert(last, made);
    std::copy(made, made + 4 * (count - i), rgba + 4 * std::ptrdiff_t(i));
}

}  // namespace patina::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace patina::simd {

HWY_EXPORT(largest_of_here);
HWY_EXPORT(to_rgba_halves_here);

float largest_of(const float* values, int count, float least) {
    return HWY_DYNAMIC_DISPATCH(largest_of_here)(values, count, least);
}

void to_rgba_halves(const float* rgb, int count, float scale, std::uint16_t* rgba) {
    HWY_DYNAMIC_DISPATCH(to_rgba_halves_here)(rgb, count, scale, rgba);
}

}  // namespace patina::simd
#endif

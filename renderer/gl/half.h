// 32-bit to 16-bit floats, rounded to nearest even, written so that compilers vectorise it.
#pragma once

#include <bit>
#include <cstdint>

namespace patina::gl {

/// Precondition: |value| ≤ 65504 (no infinity or NaN).
inline std::uint16_t to_half(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = (bits >> 16) & 0x8000u;
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    // Subnormal halves: adding 0.5 lines their last bit up with the float's, and the addition rounds.
    const float small = std::bit_cast<float>(magnitude) + 0.5f;
    const std::uint32_t subnormal = std::bit_cast<std::uint32_t>(small) - std::bit_cast<std::uint32_t>(0.5f);
    // Normal halves: rebias the exponent by 15 − 127 and round away the last 13 bits.
    const std::uint32_t odd = (magnitude >> 13) & 1u;
    const std::uint32_t normal = (magnitude + 0xc8000fffu + odd) >> 13;
    return std::uint16_t(sign | (magnitude < 0x38800000u ? subnormal : normal));
}

/// Precondition: finite.
inline float from_half(std::uint16_t half) {
    const std::uint32_t sign = std::uint32_t(half & 0x8000u) << 16;
    const std::uint32_t magnitude = std::uint32_t(half & 0x7fffu) << 13;
    // As if its exponent were a float's, and then scaled by 2^(127 − 15): exact for subnormal halves, too.
    const float scaled = std::bit_cast<float>(magnitude) * 0x1p112f;
    return std::bit_cast<float>(sign | std::bit_cast<std::uint32_t>(scaled));
}

}  // namespace patina::gl

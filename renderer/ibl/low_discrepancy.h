// Owen-scrambled Sobol points in three dimensions: every aligned run of 2^k of them is spread as evenly as
// can be, each scramble is an independent, unbiased set, and a fourth dimension deals them out to eight.
// Pure.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace patina {

/// Mixes 64 bits so that each depends on all (Vigna's splitmix64).
inline std::uint64_t mix_bits(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

/// Sobol's sequence in four dimensions with the direction numbers of Joe & Kuo 2008: x^1 (m = 1), x² + x + 1
/// (m = 1, 3) and x³ + x + 1 (m = 1, 3, 1) after van der Corput's.
inline std::uint32_t sobol_bits(std::uint32_t index, int dimension) {
    std::uint32_t direction[32];
    for (int i = 0; i < 32; ++i) {
        if (dimension == 0)
            direction[i] = 1u << (31 - i);
        else if (dimension == 1)
            direction[i] = i == 0 ? 1u << 31 : direction[i - 1] ^ (direction[i - 1] >> 1);
        else if (dimension == 2)
            direction[i] = i == 0   ? 1u << 31
                           : i == 1 ? 3u << 30
                                    : direction[i - 1] ^ direction[i - 2] ^ (direction[i - 2] >> 2);
        else
            direction[i] = i == 0   ? 1u << 31
                           : i == 1 ? 3u << 30
                           : i == 2 ? 1u << 29
                                    : direction[i - 2] ^ direction[i - 3] ^ (direction[i - 3] >> 3);
    }
    std::uint32_t bits = 0;
    for (int i = 0; index != 0; ++i, index >>= 1)
        if (index & 1u) bits ^= direction[i];
    return bits;
}

/// Owen's scrambling: each bit is flipped or not by a coin that belongs to the bits above it.
inline std::uint32_t owen_scrambled(std::uint32_t bits, std::uint64_t seed) {
    std::uint32_t result = 0;
    for (int i = 31; i >= 0; --i) {
        const std::uint64_t prefix = i == 31 ? 0 : std::uint64_t(bits >> (i + 1)) + 1;
        const std::uint64_t coin = mix_bits(seed ^ mix_bits(prefix * 64 + std::uint64_t(i)));
        result |= ((bits >> i) & 1u) ^ std::uint32_t(coin & 1u) ? 1u << i : 0u;
    }
    return result;
}

/// The point of a sequence in [0, 1)³; equal seeds give the same sequence.
inline glm::dvec3 scrambled_sobol(std::uint32_t index, std::uint64_t seed) {
    glm::dvec3 point;
    for (int i = 0; i < 3; ++i)
        point[i] = owen_scrambled(sobol_bits(index, i), mix_bits(seed * 4 + std::uint64_t(i))) * 0x1p-32;
    return point;
}

/// A place of the sequence in another order, aligned runs of 2^k to aligned runs. In Sobol's own order the
/// digits of a point say which of the sequence it is: two sequences side by side would meet in few of their
/// combinations.
inline std::uint32_t shuffled_index(std::uint32_t index, std::uint64_t seed) {
    return owen_scrambled(index, mix_bits(seed));
}

/// Deals a sequence out to eight hands: of its points 8 block … 8 block + 7 that one which lies in the hand's
/// eighth of a fourth dimension. Each hand is spread evenly by itself, and all eight are together the
/// sequence's first points, however many each holds; their mean errs less than that of eight sequences.
inline std::uint32_t index_in_hand(std::uint32_t block, int hand) {
    std::uint32_t index = 8 * block;
    while (sobol_bits(index, 3) >> 29 != std::uint32_t(hand)) ++index;
    return index;
}

}  // namespace patina

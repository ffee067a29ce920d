// Which records are one and the same: equal ones get one number, in linear time.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace patina {

/// The numbers 0, 1, … of count records by first appearance: hash(i) → std::uint64_t and same(i, j) → bool
/// look them up. Open addressing with linear probing, at most half full. Precondition: count < 2³² − 1.
template <class Hash, class Same>
std::vector<std::uint32_t> weld_by(std::size_t count, const Hash& hash, const Same& same) {
    constexpr std::uint32_t free_slot = 0xffffffffu;
    const std::size_t mask = std::bit_ceil(count * 2 + 2) - 1;
    std::vector<std::uint32_t> first_with(mask + 1, free_slot);
    std::vector<std::uint32_t> number(count);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t slot = hash(i) & mask;
        while (first_with[slot] != free_slot && !same(first_with[slot], i)) slot = (slot + 1) & mask;
        if (first_with[slot] == free_slot) {
            first_with[slot] = std::uint32_t(i);
            number[i] = next++;
        } else {
            number[i] = number[first_with[slot]];
        }
    }
    return number;
}

/// Folds one more word into a hash.
inline constexpr std::uint64_t kHashSeed = 0x9e3779b97f4a7c15u;
inline std::uint64_t hash_word(std::uint64_t hash, std::uint32_t word) {
    hash = (hash ^ word) * 0xd6e8feb86659fd93u;
    return hash ^ hash >> 32;
}

/// A float's bits, with one zero.
inline std::uint32_t float_word(float value) {
    return std::bit_cast<std::uint32_t>(value == 0.0f ? 0.0f : value);
}

/// weld_by for count records of width floats each (record i starts at data[i·stride]).
struct FloatRecords {
    const float* data = nullptr;
    std::size_t count = 0;
    std::size_t stride = 0;
    std::size_t width = 0;
};
std::vector<std::uint32_t> weld(const FloatRecords& records);

}  // namespace patina

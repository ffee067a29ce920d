#include "renderer/core/mesh_weld.h"

#include <bit>
#include <cstddef>

namespace patina {
namespace {

std::uint32_t bits_of(float value) { return std::bit_cast<std::uint32_t>(value == 0.0f ? 0.0f : value); }

/// Multiply and fold (wyhash's mixing step on 32-bit words, twice the width).
std::uint64_t hash_record(const float* record, std::size_t width) {
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (std::size_t k = 0; k < width; ++k) {
        hash = (hash ^ bits_of(record[k])) * 0xd6e8feb86659fd93u;
        hash ^= hash >> 32;
    }
    return hash;
}

bool same_record(const float* a, const float* b, std::size_t width) {
    for (std::size_t k = 0; k < width; ++k)
        if (bits_of(a[k]) != bits_of(b[k])) return false;
    return true;
}

}  // namespace

/// Open addressing with linear probing, at most half full.
std::vector<std::uint32_t> weld(const FloatRecords& records) {
    constexpr std::uint32_t kFree = 0xffffffffu;
    const std::size_t slots = std::bit_ceil(records.count * 2 + 2);
    std::vector<std::uint32_t> table(slots, kFree);  // record that first had the value
    std::vector<std::uint32_t> id(records.count);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < records.count; ++i) {
        const float* record = records.data + i * records.stride;
        std::size_t slot = hash_record(record, records.width) & (slots - 1);
        while (table[slot] != kFree &&
               !same_record(records.data + table[slot] * records.stride, record, records.width))
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == kFree) {
            table[slot] = std::uint32_t(i);
            id[i] = next++;
        } else {
            id[i] = id[table[slot]];
        }
    }
    return id;
}

}  // namespace patina

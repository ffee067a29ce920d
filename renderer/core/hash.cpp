#include "renderer/core/hash.h"

#include <array>
#include <bit>
#include <cstring>

namespace patina {
namespace {

constexpr std::uint64_t kPrime1 = 0x9E3779B185EBCA87ull;
constexpr std::uint64_t kPrime2 = 0xC2B2AE3D27D4EB4Full;
constexpr std::uint64_t kPrime3 = 0x165667B19E3779F9ull;
constexpr std::uint64_t kPrime4 = 0x85EBCA77C2B2AE63ull;
constexpr std::uint64_t kPrime5 = 0x27D4EB2F165667C5ull;

template <class Word>
Word read_word(const std::byte* at) {
    Word word;
    std::memcpy(&word, at, sizeof word);
    return word;
}

std::uint64_t mix_lane(std::uint64_t lane, std::uint64_t word) {
    return std::rotl(lane + word * kPrime2, 31) * kPrime1;
}

std::uint64_t merge_lane(std::uint64_t hash, std::uint64_t lane) {
    return (hash ^ mix_lane(0, lane)) * kPrime1 + kPrime4;
}

/// The bulk: four independent lanes of 8 bytes. Leaves fewer than 32 bytes in `bytes`.
std::uint64_t hash_stripes(std::span<const std::byte>& bytes, std::uint64_t seed) {
    std::array<std::uint64_t, 4> lanes{seed + kPrime1 + kPrime2, seed + kPrime2, seed, seed - kPrime1};
    while (bytes.size() >= 32) {
        for (std::size_t i = 0; i < 4; ++i)
            lanes[i] = mix_lane(lanes[i], read_word<std::uint64_t>(bytes.data() + 8 * i));
        bytes = bytes.subspan(32);
    }
    std::uint64_t hash =
        std::rotl(lanes[0], 1) + std::rotl(lanes[1], 7) + std::rotl(lanes[2], 12) + std::rotl(lanes[3], 18);
    for (const std::uint64_t lane : lanes) hash = merge_lane(hash, lane);
    return hash;
}

}  // namespace

std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed) {
    const std::uint64_t size = bytes.size();
    std::uint64_t hash = (bytes.size() >= 32 ? hash_stripes(bytes, seed) : seed + kPrime5) + size;
    for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
        hash ^= mix_lane(0, read_word<std::uint64_t>(bytes.data()));
        hash = std::rotl(hash, 27) * kPrime1 + kPrime4;
    }
    if (bytes.size() >= 4) {
        hash ^= read_word<std::uint32_t>(bytes.data()) * kPrime1;
        hash = std::rotl(hash, 23) * kPrime2 + kPrime3;
        bytes = bytes.subspan(4);
    }
    for (const std::byte byte : bytes)
        hash = std::rotl(hash ^ (std::to_integer<std::uint64_t>(byte) * kPrime5), 11) * kPrime1;
    hash = (hash ^ (hash >> 33)) * kPrime2;
    hash = (hash ^ (hash >> 29)) * kPrime3;
    return hash ^ (hash >> 32);
}

}  // namespace patina

// A fast 64-bit content hash for cache keys and checksums (detects damage, not malice).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace patina {

/// Four lanes of multiply and rotate over 32-byte stripes (the shape of xxHash64), then the tail byte by
/// byte. Chain sections through seed. The value depends on the machine's byte order, as the data it covers
/// does.
inline std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t seed = 0) {
    constexpr std::uint64_t kA = 0x9E3779B185EBCA87u, kB = 0xC2B2AE3D27D4EB4Fu, kC = 0x165667B19E3779F9u;
    const auto mix = [](std::uint64_t lane, std::uint64_t word) {
        lane += word * kB;
        return ((lane << 31) | (lane >> 33)) * kA;
    };
    const auto* bytes = static_cast<const unsigned char*>(data);
    std::uint64_t lanes[4] = {seed + kA + kB, seed + kB, seed, seed - kA};
    std::size_t done = 0;
    for (; done + 32 <= size; done += 32)
        for (int lane = 0; lane < 4; ++lane) {
            std::uint64_t word;
            std::memcpy(&word, bytes + done + 8 * lane, 8);
            lanes[lane] = mix(lanes[lane], word);
        }
    std::uint64_t hash = kC + size;
    for (const std::uint64_t lane : lanes) hash = mix(hash, lane);
    for (; done < size; ++done) hash = mix(hash, bytes[done] + kC);
    hash = (hash ^ (hash >> 33)) * kB;
    hash = (hash ^ (hash >> 29)) * kC;
    return hash ^ (hash >> 32);
}

}  // namespace patina

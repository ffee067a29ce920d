// A fast 64-bit hash of bytes for telling contents apart (not for security): XXH64 by Yann Collet, as
// specified in https://github.com/Cyan4973/xxHash/blob/dev/doc/xxhash_spec.md. Reads words in the machine's
// (little-endian) order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace patina {

std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed = 0);

}  // namespace patina

#include "renderer/core/mesh_weld.h"

namespace patina {

std::vector<std::uint32_t> weld(const FloatRecords& records) {
    const auto record = [&](std::size_t i) { return records.data + i * records.stride; };
    const auto hash = [&](std::size_t i) {
        std::uint64_t h = kHashSeed;
        for (std::size_t k = 0; k < records.width; ++k) h = hash_word(h, float_word(record(i)[k]));
        return h;
    };
    const auto same = [&](std::size_t i, std::size_t j) {
        for (std::size_t k = 0; k < records.width; ++k)
            if (float_word(record(i)[k]) != float_word(record(j)[k])) return false;
        return true;
    };
    return weld_by(records.count, hash, same);
}

}  // namespace patina

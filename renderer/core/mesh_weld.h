// Which vertices are one and the same: identical floats get one number, in linear time.
#pragma once

#include <cstdint>
#include <vector>

namespace patina {

/// For count records of width floats each (record i starts at data[i·stride]), the number 0, 1, … of its
/// distinct value, numbered by first appearance; +0 and −0 are equal, NaN equals the same NaN. Precondition:
/// count < 2³²− 1.
struct FloatRecords {
    const float* data = nullptr;
    std::size_t count = 0;
    std::size_t stride = 0;
    std::size_t width = 0;
};
std::vector<std::uint32_t> weld(const FloatRecords& records);

}  // namespace patina

// Which numbers something holds.
#pragma once

#include <array>

namespace patina {

struct ValueRange {
    float low = 0.0f, high = 1.0f;
    bool is_single() const { return low == high; }
    bool operator==(const ValueRange&) const = default;
};

/// Of what the shader samples of a map in red, green, blue and alpha: any filter stays within.
using ChannelRanges = std::array<ValueRange, 4>;

}  // namespace patina

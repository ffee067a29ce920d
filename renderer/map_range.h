// Which numbers a map holds: what a material with that map can become, without looking at every texel again.
// Pure.
#pragma once

#include "renderer/map_levels.h"

#include <array>
#include <bitset>
#include <optional>

namespace patina {

struct ValueRange {
    float low = 0.0f, high = 1.0f;
    bool is_single() const { return low == high; }
    bool operator==(const ValueRange&) const = default;
};

/// Of what the shader samples in red, green, blue and alpha: any filter stays within.
using ChannelRanges = std::array<ValueRange, 4>;

/// Over all levels, because those of normal maps hold in alpha what their averages lost. Grey is the same in
/// red, green and blue.
ChannelRanges channel_ranges(const MapLevels& map);

/// A map that is one colour all over needs no more than its last level. Whether levels were given back.
bool keep_one_texel_of_constant(MapLevels& map, const ChannelRanges& ranges);

/// Of each slot; none where no map is bound.
using MapRanges = std::array<std::optional<ChannelRanges>, kMapSlots>;

/// value · (invert ? 1 − map : map), clamped to 0…1 as the shader does; the value alone without a map.
ValueRange scalar_range(const ScalarSlot& slot, const std::optional<ChannelRanges>& map);

/// Maps that hold one colour, or one number where the slot reads it, are no maps: the material becomes what
/// it is with them as values, and their slots are named.
struct Collapsed {
    Material material;
    std::bitset<kMapSlots> slots;
};
Collapsed collapsed(const Material& material, const MapRanges& maps);

}  // namespace patina

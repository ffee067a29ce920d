// Which numbers a map holds: what a material with that map can become, without looking at every texel again.
// Pure.
#pragma once

#include "renderer/core/value_range.h"
#include "renderer/map_levels.h"

#include <array>
#include <bitset>
#include <optional>

namespace patina {

/// Over all levels, because those of normal maps hold in alpha what their averages lost. Grey is the same in
/// red, green and blue.
ChannelRanges channel_ranges(const MapLevels& map);

/// A map that is one colour all over needs no more than its last level. Whether levels were given back.
/// Precondition: its ranges are known.
bool keep_one_texel_of_constant(MapLevels& map);

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

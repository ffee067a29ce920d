#include "renderer/map_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patina {

namespace {

constexpr std::size_t kBlockPixels = 16;

/// Over one level, as stored. NaN is neither smaller nor larger than anything. Many pixels at a time, each of
/// their numbers for itself: compilers make vectors of that.
template <int kChannels, class T>
void widen(const Image& image, std::array<T, 4>& low, std::array<T, 4>& high) {
    constexpr std::size_t block = kBlockPixels * kChannels;
    const auto* value = reinterpret_cast<const T*>(image.bytes.data());
    const std::size_t count = std::size_t(image.width) * std::size_t(image.height) * kChannels;
    std::array<T, block> lowest, highest;
    for (std::size_t i = 0; i < block; ++i) {
        lowest[i] = low[i % kChannels];
        highest[i] = high[i % kChannels];
    }
    const auto take = [&](const T* from, std::size_t numbers) {
        for (std::size_t i = 0; i < numbers; ++i) {
            const T x = from[i];
            lowest[i] = x < lowest[i] ? x : lowest[i];
            highest[i] = highest[i] < x ? x : highest[i];
        }
    };
    std::size_t at = 0;
    for (; at + block <= count; at += block) take(value + at, block);
    take(value + at, count - at);
    for (std::size_t i = 0; i < block; ++i) {
        low[i % kChannels] = std::min(low[i % kChannels], lowest[i]);
        high[i % kChannels] = std::max(high[i % kChannels], highest[i]);
    }
}

template <class T>
void widen(const Image& image, std::array<T, 4>& low, std::array<T, 4>& high) {
    switch (image.channels) {
        case 1:
            return widen<1>(image, low, high);
        case 2:
            return widen<2>(image, low, high);
        case 3:
            return widen<3>(image, low, high);
        default:
            return widen<4>(image, low, high);
    }
}

template <class T>
ChannelRanges ranges_of(const MapLevels& map, float scale) {
    std::array<T, 4> low, high;
    low.fill(std::numeric_limits<T>::max());
    high.fill(std::numeric_limits<T>::lowest());
    for (const Image& level : map.levels) widen<T>(level, low, high);
    const int channels = map.levels[0].channels;
    ChannelRanges ranges;
    for (int c = 0; c < 4; ++c) {
        const int source = channels <= 2 ? (c < 3 ? 0 : 1) : c;
        ranges[c] = source < channels ? ValueRange{float(low[source]) * scale, float(high[source]) * scale}
                                      : ValueRange{1.0f, 1.0f};
    }
    return ranges;
}

constexpr float kFlat = 1.01f / 255.0f;  ///< of a normal's x and y: no code is nearer to 0 than half of one

bool is_single(const ChannelRanges& map, int channels) {
    return std::all_of(map.begin(), map.begin() + channels,
                       [](const ValueRange& each) { return each.is_single(); });
}

bool is_flat(const ChannelRanges& normals) {
    const auto is_zero = [](const ValueRange& each) { return std::abs(2.0f * each.low - 1.0f) <= kFlat; };
    return is_single(normals, 4) && is_zero(normals[0]) && is_zero(normals[1]) && normals[3].low == 1.0f;
}

bool collapse(ScalarSlot& slot, const ChannelRanges& map) {
    const ValueRange range = scalar_range(slot, map);
    if (range.is_single()) slot.value = range.low;
    return range.is_single();
}

bool collapse(ColorSlot& slot, const ChannelRanges& map) {
    if (!is_single(map, 3)) return false;
    slot.value *= glm::vec3(map[0].low, map[1].low, map[2].low);
    return true;
}

bool collapse(Material& material, MapSlot slot, const ChannelRanges& map) {
    switch (slot) {
        case MapSlot::Albedo:
            return collapse(material.albedo, map);
        case MapSlot::Roughness:
            return collapse(material.roughness, map);
        case MapSlot::Metallic:
            return collapse(material.metallic, map);
        case MapSlot::Ao:
            return collapse(material.ao, map);
        case MapSlot::Normal:
            return is_flat(map);
        case MapSlot::Emission:
            return collapse(material.emission, map);
    }
    return false;
}

}  // namespace

ChannelRanges channel_ranges(const MapLevels& map) {
    switch (map.levels.at(0).type) {
        case PixelType::U8: {
            ChannelRanges ranges = ranges_of<std::uint8_t>(map, 1.0f / 255.0f);
            for (int c = 0; c < 3 && map.srgb; ++c)
                ranges[c] = {srgb_to_linear(ranges[c].low), srgb_to_linear(ranges[c].high)};
            return ranges;
        }
        case PixelType::U16:
            return ranges_of<std::uint16_t>(map, 1.0f / 65535.0f);
        default:
            return ranges_of<float>(map, 1.0f);
    }
}

bool keep_one_texel_of_constant(MapLevels& map) {
    if (map.levels.size() == 1 || !is_single(map.ranges, 4)) return false;
    map.levels.erase(map.levels.begin(), map.levels.end() - 1);
    return true;
}

ValueRange scalar_range(const ScalarSlot& slot, const std::optional<ChannelRanges>& map) {
    ValueRange range = {slot.value, slot.value};
    if (map && slot.value != 0.0f) {
        const ValueRange held = (*map)[std::size_t(slot.channel)];
        range = slot.invert ? ValueRange{slot.value * (1.0f - held.high), slot.value * (1.0f - held.low)}
                            : ValueRange{slot.value * held.low, slot.value * held.high};
    }
    return {std::clamp(range.low, 0.0f, 1.0f), std::clamp(range.high, 0.0f, 1.0f)};
}

Collapsed collapsed(const Material& material, const MapRanges& maps) {
    Collapsed result{.material = material, .slots = {}};
    for (std::size_t slot = 0; slot < maps.size(); ++slot)
        if (maps[slot]) result.slots[slot] = collapse(result.material, MapSlot(slot), *maps[slot]);
    return result;
}

}  // namespace patina

#include "renderer/map_range.h"

#include <algorithm>
#include <limits>

namespace patina {

namespace {

/// Over one level, as stored. NaN is neither smaller nor larger than anything.
template <class T>
void widen(const Image& image, std::array<T, 4>& low, std::array<T, 4>& high) {
    const auto* value = reinterpret_cast<const T*>(image.bytes.data());
    const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
    const int channels = image.channels;
    for (int c = 0; c < channels; ++c) {
        T lowest = low[c], highest = high[c];
        for (std::size_t i = 0; i < pixels; ++i) {
            const T x = value[i * channels + c];
            lowest = std::min(lowest, x);
            highest = std::max(highest, x);
        }
        low[c] = lowest;
        high[c] = highest;
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

}  // namespace

ChannelRanges channel_ranges(const MapLevels& map) {
    switch (map.levels.at(0).type) {
        case PixelType::U8:
            return ranges_of<std::uint8_t>(map, 1.0f / 255.0f);
        case PixelType::U16:
            return ranges_of<std::uint16_t>(map, 1.0f / 65535.0f);
        default:
            return ranges_of<float>(map, 1.0f);
    }
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

}  // namespace patina

// A material map as the GPU samples it: the picture in a compact format with its mip chain. Pure; knows no GL
// and no file.
#pragma once

#include "materials/material.h"
#include "renderer/core/image.h"
#include "renderer/core/value_range.h"
#include "renderer/map_filter.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace patina {

/// A map with its mip chain, ready to upload: made on a worker by make_map_levels, values as the shader
/// samples them.
struct MapLevels {
    std::vector<Image>
        levels;            ///< [0] full size, each next one half as large, down to 1×1; 1, 2 or 4 channels
    bool srgb = false;     ///< U8 that is sampled through an sRGB texture format
    ChannelRanges ranges;  ///< as channel_ranges finds them, where somebody looked
};

enum class MapKind { Color, Data, Normal };

/// Mip maps averaged in linear light (Color), as numbers (Data), or as directions and renormalised (Normal):
/// their alpha is 1 − √spread, spread what the normals that were averaged add to a surface's alpha² (0 at
/// full size). Any size. color_space matters for Color in U8 and U16 only: floating-point pictures hold
/// linear light, whatever they are called. Grey stays one channel. Numbers that are not finite become 0,
/// those beyond a half float's range its limit.
///
/// finest_side: of the levels whose width and height are at least that only the smallest is made; 0: all are.
/// What is made is the same to the byte, but that numbers that are grey have one channel then.
MapLevels make_map_levels(const Image& image, MapKind kind, ColorSpace color_space, int finest_side = 0);

/// The same from rows, of which none is kept: what is in memory is what is made, and a few rows.
class MapMaker {
public:
    MapMaker(MapKind kind, ColorSpace color_space, int finest_side = 0);
    ~MapMaker() = default;
    MapMaker(const MapMaker&) = delete;
    MapMaker& operator=(const MapMaker&) = delete;
    void begin(const Image& shape);                ///< once, first; its bytes do not matter
    void row(const std::byte* row);                ///< each of the picture's, from the top
    const Image& shape() const { return whole_; }  ///< of the picture, without bytes
    std::size_t bytes() const;                     ///< in memory
    bool is_whole() const;                         ///< no level is left out as too fine
    MapLevels take();                              ///< once, after the last row

private:
    void make_shapes(int channels);

    MapKind kind_;
    bool encoded_;
    int finest_side_;
    Image whole_, row_;
    MapLevels map_;
    std::optional<MipChain> chain_;
    int rows_ = 0;
    bool taken_as_stored_ = false;  ///< rows need no change before they are averaged
    bool maybe_grey_ = false;       ///< its channels were equal so far, and grey is to be kept as one
};

/// The kind of map a slot takes.
MapKind map_kind(MapSlot slot);

/// A checkerboard that cannot be mistaken for a picture: stands in for a missing or broken map.
Image make_placeholder_map();

}  // namespace patina

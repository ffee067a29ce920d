// A material map as the GPU samples it: the picture in a compact format with its mip chain. Pure; knows no GL
// and no file.
#pragma once

#include "materials/material.h"
#include "renderer/core/image.h"

#include <vector>

namespace patina {

/// A map with its mip chain, ready to upload: made on a worker by make_map_levels, values as the shader
/// samples them.
struct MapLevels {
    std::vector<Image>
        levels;         ///< [0] full size, each next one half as large, down to 1×1; 1, 2 or 4 channels
    bool srgb = false;  ///< U8 that is sampled through an sRGB texture format
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

/// The kind of map a slot takes.
MapKind map_kind(MapSlot slot);

/// A checkerboard that cannot be mistaken for a picture: stands in for a missing or broken map.
Image make_placeholder_map();

}  // namespace patina

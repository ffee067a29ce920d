// Makes a picture tileable: its opposite borders are laid over each other and grown together. Pure.
#pragma once

#include "renderer/maps/grid.h"

namespace patina {

/// How many pixels of the picture go into the borders of a tile of that size: a quarter of it, at least 1.
int tile_overlap(int tile_size);

/// A tile smaller than the picture by its overlap each way. Precondition: each side of the picture is
/// size + tile_overlap(size) for some size ≥ 4.
///
/// The borders' seam goes where both pictures agree best (Efros, Freeman: Image Quilting for Texture
/// Synthesis and Transfer, SIGGRAPH 2001: the cheapest path by dynamic programming), the second one closed in
/// itself. What they differ by at large along it is shared out over the overlap, the rest is blended so
/// widely that it adds no steeper slope than the picture has.
Colors tiled(const Colors& picture);

}  // namespace patina

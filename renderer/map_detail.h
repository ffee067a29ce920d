// How fine a map can be seen: how large it is drawn on the screen, so that finer levels need not be made.
// Pure.
#pragma once

#include "renderer/core/camera.h"
#include "renderer/core/mesh.h"

#include <glm/vec2.hpp>

namespace patina {

/// Length on the mesh of one unit of uv, along the direction in which it is stretched most: of the triangle
/// than which nine tenths of the textured surface are stretched no more. 0: the mesh has no uv.
float uv_stretch(const Mesh& mesh);
/// The built-in sphere's, for meshes that are not there yet.
inline constexpr float kUsualUvStretch = 3.15f;

/// How something is looked at.
struct Sight {
    Camera camera;
    int height_px = 0;  ///< of the picture; 0: not known, all detail is wanted
};
/// How wide a pixel is on the surface that is nearest, in radii of the mesh. Precondition: height_px > 0.
float nearest_pixel(const Sight& sight);
/// Texels per side, a power of two, of the finest level of a map that the picture samples where stretch is
/// that of its surface (uv_stretch: of nine tenths of it, the rest would like finer ones); 0: all there are.
/// The surface that is nearest is taken to face the camera. map_scale: how often the map repeats in a unit of
/// uv.
int visible_map_side(float stretch, glm::vec2 map_scale, const Sight& sight);

}  // namespace patina

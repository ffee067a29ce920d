// A panorama divided into rectangles of texels, each with its light close together, so that a surface can
// tell from a few numbers how much it reflects of each. Pure; knows no GPU.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

namespace patina {

/// Rows of texels as in Environment: areas of constant radiance, row 0 at the top.
struct PanoramaTexels {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance;
};

/// Texels left ≤ x < right, top ≤ y < bottom.
struct LightCell {
    int left = 0, right = 0, top = 0, bottom = 0;
    double light = 0.0;                   ///< ∫ mean channel dω
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< of the light's middle; unit
    double spread = 0.0;                  ///< mean-square angle of the light from there, rad²
};

/// 1 … count cells that cover the panorama without overlap, neighbours in the list close to each other. The
/// cell with the largest light × angular radius is split, until there are count or nothing is left to split.
std::vector<LightCell> divide_light(const PanoramaTexels& texels, int count);

double mean_channel(glm::vec3 radiance);
/// ∫ dω of any texel of that row.
double texel_solid_angle(const PanoramaTexels& texels, int row);
/// Unit. x, y: in texels from the upper left corner; cosθ falls evenly through a row, so that an even
/// density over x and y within a texel is one over its solid angle.
glm::dvec3 texel_direction(const PanoramaTexels& texels, double x, double y);

}  // namespace patina

// The computed environments and the brush they are painted with. Knows no file; the same pixels on every run.
#pragma once

#include "renderer/core/environment.h"

#include <functional>

namespace patina {

Environment make_studio(int width);
Environment make_sky(int width);
Environment make_sunset(int width);
Environment make_overcast(int width);
Environment make_night(int width);
Environment make_furnace(int width);
Environment make_test(int width);

/// What is seen in one direction. Radiance may be rough only where the region changes.
struct PaintedPoint {
    glm::vec3 radiance{0.0f};
    int region = 0;
};
using Painting = std::function<PaintedPoint(const glm::vec3& direction)>;

/// width × width/2 texels (at least 2 × 1), each the mean of the scene over the texel: supersampled where the
/// region differs from a neighbour's, painted finer and averaged by solid angle where texels are coarse.
Environment paint_environment(int width, const Painting& scene);

/// A round light.
struct Disc {
    glm::vec3 direction{0.0f, 1.0f, 0.0f};  ///< unit
    float angular_radius = 0.0f;            ///< radians, below π/2
    glm::vec3 radiance{0.0f};               ///< mean over the disc
    float limb_darkening = 0.0f;  ///< 0 flat … 1 black rim: radiance ∝ 1 − k(1 − √(1 − r²))
};

/// Adds the disc, spread over the texels it covers so that its energy (radiance × solid angle) is exact at
/// every width.
void add_disc(Environment& environment, const Disc& disc);

/// Solid angle of any texel of that row.
double texel_solid_angle(const Environment& environment, int row);
/// ∫ radiance dω.
glm::dvec3 total_energy(const Environment& environment);

}  // namespace patina

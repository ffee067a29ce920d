// What the properties draw and bake: random light of many kinds, and pixels with a normal, a view and a
// material of their own.
#pragma once

#include "app/stability.h"
#include "renderer/renderer.h"

#include <vector>

namespace patina {

/// A soft sky of broad lobes with a sun of two degrees, so many times as bright as the mean.
Environment sunny_panorama(int width, double sun_over_mean, Random& random);
/// Sum of a few broad lobes, turned by the matrix; nothing smaller than some ten degrees.
struct SoftLight {
    explicit SoftLight(Random& random);
    glm::dvec3 operator()(glm::dvec3 direction) const;
    struct Lobe {
        glm::dvec3 axis, color;
        double sharpness;
    };
    std::vector<Lobe> lobes;
};
Environment panorama_of(const std::function<glm::dvec3(glm::dvec3)>& radiance, int width, int height);
/// Any size from 1 × 1 to 96 × 48 or so, 2:1 or not; noise, suns of one texel, constants, black, radiance
/// from 1e-30 to 1e18.
Environment any_panorama(Random& random);
/// Baked as the renderer wants it but small: a few milliseconds.
EnvironmentHandle upload_light(Stage& stage, const Environment& environment);

/// Modes that claim to send white light back white; the lecture's does not, and the reference is not drawn at
/// once.
bool keeps_energy(Shading mode);

struct FurnacePixel {
    double NoV = 0.0;  // NOLINT(readability-identifier-naming): the literature's letter
    double error = 0.0;
};
/// |out − 1| over a white sphere under light 1 from everywhere, channel by channel the worst.
std::vector<FurnacePixel> furnace_pixels(Stage& stage, Shading mode, float roughness, float metallic);

/// Drawn without multisampling into full floats.
Image drawn_radiance(Stage& stage, const Scene& scene, glm::ivec2 size);

/// side × side cells that fill a square picture drawn by probe_camera(), facing +Z; each cell has the normal
/// that is asked for, and uv that covers one texel of a side × side map.
Mesh probe_mesh(int side, const std::function<glm::vec3(int x, int y)>& normal);
/// Far away, so that the view is +Z for every pixel within 1e-3.
Camera probe_camera();

}  // namespace patina

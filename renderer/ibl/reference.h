// What a prefiltered level is judged by: double-precision quadrature over every texel, no noise, slow.
#pragma once

#include "renderer/ibl/bake.h"

#include <vector>

namespace patina {

/// ∫ L K dω / ∫ K dω with the kernel of bake.h, texels taken as areas of constant radiance. A texel is split
/// until its parts are small against the lobe, which widens with the distance as the kernel's power law does,
/// and integrated by Gauss's rule. Errs by about 1e-5. The environment must outlive it.
class PrefilterReference {
public:
    explicit PrefilterReference(const Environment& environment);
    glm::dvec3 radiance(glm::dvec3 N, double roughness) const;

private:
    struct Cell {
        double theta, phi, height, width;  ///< its middle and its sides in both angles
    };
    double kernel_over(const Cell& cell, glm::dvec3 N, double alpha) const;

    const Environment& environment_;
    std::vector<double> sin_theta_, cos_theta_, sin_phi_, cos_phi_;  ///< of rows and columns
};

/// ∫ K dω in closed form: with y = 1 − cos θ and q = (1 − α²)/2 it is 2πα² ∫ (1 − y)/(qy + α²)² dy over 0
/// … 1.
double reference_kernel_integral(double alpha);

/// Relative errors |x − r|/max(r, 10⁻³ · mean), over texels and channels.
struct PrefilterError {
    double rms = 0.0, p95 = 0.0, max = 0.0;
};
struct PrefilterProbe {
    int texels = 200;  ///< spread over the cube, and as many again around the brightest texel as fit in 9 × 9
    ParallelFor parallel_for = serial_for;
};
PrefilterError prefilter_error(const CubeMap& cube, double roughness, const Environment& environment,
                               const PrefilterProbe& probe);

/// What some texels of a level should hold, to judge several methods by.
struct PrefilterTruth {
    std::vector<int> texels;  ///< of a cube of that face size
    int face_size = 0;
    std::vector<glm::dvec3> radiance;
    double floor = 0.0;  ///< errors of what is darker are taken relative to it
};
/// like: a cube of the size wanted, whose brightest texel shows where to look.
PrefilterTruth prefilter_truth(const CubeMap& like, double roughness, const Environment& environment,
                               const PrefilterProbe& probe);
/// values: one for each texel of the truth.
PrefilterError prefilter_error(const std::vector<glm::vec3>& values, const PrefilterTruth& truth);
PrefilterError prefilter_error(const CubeMap& cube, const PrefilterTruth& truth);

}  // namespace patina

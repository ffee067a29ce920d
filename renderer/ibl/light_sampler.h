// Directions drawn from a panorama in proportion to the light that comes from them. Pure; slow to make for
// large panoramas (a pass over all texels), so it is made on a worker. Knows no GPU.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace patina {

/// Rows of texels as in Environment: areas of constant radiance, row 0 at the top.
struct PanoramaTexels {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance;
};

struct LightSample {
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit
    glm::vec3 radiance{0.0f};
    double density = 0.0;  ///< per solid angle
};

/// Density: mean of the three channels over its integral, constant over a texel.
class LightSampler {
public:
    explicit LightSampler(PanoramaTexels texels);

    /// u in [0, 1)² to a direction, by inverting the distribution of rows and then of texels within one,
    /// which keeps points that are spread evenly spread evenly. Without any light: uniform, density 1/4π,
    /// radiance 0.
    LightSample sample(glm::dvec2 u) const;
    /// ∫ mean channel dω.
    double total() const { return total_; }
    const PanoramaTexels& texels() const { return texels_; }

private:
    PanoramaTexels texels_;
    std::vector<double> rows_;   ///< light in the rows above and in this one
    std::vector<float> within_;  ///< share of a row's light in texels up to and with this one
    double total_ = 0.0;
};

}  // namespace patina

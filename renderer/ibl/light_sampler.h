// Directions drawn from a panorama's cells, in each in proportion to the light that comes from them. Pure;
// slow to make for large panoramas (passes over all texels), so it is made on a worker. Knows no GPU.
#pragma once

#include "renderer/ibl/light_cells.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace patina {

struct LightSample {
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit
    glm::vec3 radiance{0.0f};
    double density = 0.0;  ///< per solid angle, of directions drawn from that cell
};

/// Density: mean of the three channels over its integral, constant over a texel.
class LightSampler {
public:
    static constexpr int kMostCells = 32;

    explicit LightSampler(PanoramaTexels texels);

    /// u in [0, 1)² to a direction in a cell, by inverting the distribution of rows and then of texels within
    /// one, which keeps points that are spread evenly spread evenly. In a cell without light evenly over its
    /// solid angle, radiance 0.
    LightSample sample(int cell, glm::dvec2 u) const;
    /// ∫ mean channel dω.
    double total() const { return total_; }
    const PanoramaTexels& texels() const { return texels_; }
    /// Of every texel, the number of its cell last.
    const std::vector<glm::vec4>& radiance_and_cell() const { return radiance_and_cell_; }
    /// 1 … kMostCells that cover the panorama.
    const std::vector<LightCell>& cells() const { return cells_; }

private:
    PanoramaTexels texels_;
    std::vector<LightCell> cells_;
    std::vector<glm::vec4> radiance_and_cell_;
    std::vector<std::vector<double>> rows_;  ///< of each cell: light in its rows above and in this one; where
                                             ///< it has none, solid angle
    std::vector<float> within_;  ///< sum of mean channels in a texel's row of its cell, up to and with it
    double total_ = 0.0;
};

}  // namespace patina

// A panorama as the bake reads it: rows that may lie anywhere, and what its values look like as a whole.
#pragma once

#include "renderer/ibl/bake.h"

#include <vector>

namespace patina {

/// Rows of width texels, so that a few changed rows need no copy of the rest.
struct RadianceView {
    int width = 0;
    int height = 0;
    std::vector<const glm::vec3*> rows;
};
/// Where texels lie on the sphere.
struct TexelGrid {
    int width = 0;
    int height = 0;

    double row_height() const;
    double column_width() const;
    double area(int y) const;                        ///< of a texel of row y
    glm::dvec3 direction(double x, double y) const;  ///< of a point, in texels from the top-left corner
};

RadianceView view_of(const Environment& environment);

/// Averages to at most width × height texels, each texel of the source counted with its solid angle.
Environment reduce(const RadianceView& view, int width, int height, const ParallelFor& parallel_for);

struct RadianceStatistics {
    glm::vec3 lowest{0.0f}, highest{0.0f};  ///< channel by channel
    glm::dvec3 mean_color{0.0};             ///< over the sphere
    double mean = 0.0;                      ///< likewise, over the channels too
    /// What an error, the same everywhere, is divided by to give a relative error: 1/√(mean of 1/L²), L
    /// averaged over patches and taken no darker than a thousandth of the mean. A dark studio needs its
    /// lamps' tails more exactly.
    double error_scale = 0.0;
};
RadianceStatistics radiance_statistics(const RadianceView& view, const ParallelFor& parallel_for);

}  // namespace patina

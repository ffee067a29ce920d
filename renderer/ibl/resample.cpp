// A panorama on cube faces.
#include "renderer/ibl/panorama.h"
#include "renderer/ibl/sampling.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

/// The panorama, bilinearly, around the seam and across the poles.
glm::vec3 panorama(const Environment& e, glm::vec3 d) {
    const float u = 0.5f + std::atan2(d.x, -d.z) / (2.0f * std::numbers::pi_v<float>);
    const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / std::numbers::pi_v<float>;
    const float x = u * float(e.width) - 0.5f;
    const float y = v * float(e.height) - 0.5f;
    const int x0 = int(std::floor(x));
    const int y0 = int(std::floor(y));
    const auto fetch = [&](int column, int row) {
        if (row < 0 || row >= e.height) column += e.width / 2;
        row = row < 0 ? -1 - row : row >= e.height ? 2 * e.height - 1 - row : row;
        column = ((column % e.width) + e.width) % e.width;
        return e.radiance[std::size_t(row) * e.width + column];
    };
    const float fx = x - float(x0);
    const float fy = y - float(y0);
    return glm::mix(glm::mix(fetch(x0, y0), fetch(x0 + 1, y0), fx),
                    glm::mix(fetch(x0, y0 + 1), fetch(x0 + 1, y0 + 1), fx), fy);
}

/// The mean over a texel's solid angle, from points × points samples.
glm::vec3 mean_over_texel(const Environment& environment, int size, int row, int x, int points) {
    const int fine = size * points;
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (int j = row % size * points; j < (row % size + 1) * points; ++j)
        for (int i = x * points; i < (x + 1) * points; ++i) {
            const double s = (2.0 * i + 1.0) / fine - 1.0;
            const double t = (2.0 * j + 1.0) / fine - 1.0;
            const double weight = 1.0 / ((1.0 + s * s + t * t) * std::sqrt(1.0 + s * s + t * t));
            sum += weight * glm::dvec3(panorama(environment, cube_texel_direction(fine, row / size, i, j)));
            weights += weight;
        }
    return glm::vec3(sum / weights);
}

}  // namespace

CubeMap resample_environment(const Environment& environment, int size, const ParallelFor& parallel_for) {
    // Half a cube texel or less is averaged beforehand, so that the cost does not grow with the panorama.
    const int factor = std::max(1, int(std::lround(environment.width / (8.0 * size))));
    const Environment reduced = factor > 1 ? reduce(view_of(environment), environment.width / factor,
                                                    environment.height / factor, parallel_for)
                                           : Environment{};
    const Environment& source = factor > 1 ? reduced : environment;
    // Four samples a panorama texel: the hat functions of the bilinear look-up then sum to one within 1 %, so
    // that not even a single bright texel gains or loses more energy.
    const int points = std::max(2, int(std::ceil(source.width / double(size))));
    CubeMap cube{size, std::vector<glm::vec3>(std::size_t(6) * size * size)};
    parallel_for(6 * size, [&](int row) {
        for (int x = 0; x < size; ++x)
            cube.texels[std::size_t(row) * size + x] = mean_over_texel(source, size, row, x, points);
    });
    return cube;
}

}  // namespace patina

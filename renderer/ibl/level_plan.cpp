#include "renderer/ibl/level_plan.h"

#include <glm/common.hpp>
#include <glm/ext/vector_double3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

/// One strip of rows, reduced to patches.
struct Strip {
    glm::vec3 lowest, highest;
    double sum = 0.0, square = 0.0, area = 0.0;
    std::vector<glm::dvec3> patch_sum;  ///< of this strip's rows, by column of patches
};

Strip reduce(const Environment& e, int first_row, int last_row, int patches) {
    Strip strip{e.radiance[std::size_t(first_row) * e.width], e.radiance[std::size_t(first_row) * e.width]};
    strip.patch_sum.assign(std::size_t(patches), glm::dvec3(0.0));
    for (int y = first_row; y < last_row; ++y) {
        const double area = std::sin((y + 0.5) * std::numbers::pi / e.height);
        const glm::vec3* texel = &e.radiance[std::size_t(y) * e.width];
        for (int patch = 0; patch < patches; ++patch) {
            const int end = int(std::int64_t(e.width) * (patch + 1) / patches);
            glm::vec3 sum(0.0f);
            double square = 0.0;
            for (int x = int(std::int64_t(e.width) * patch / patches); x < end; ++x, ++texel) {
                strip.lowest = glm::min(strip.lowest, *texel);
                strip.highest = glm::max(strip.highest, *texel);
                sum += *texel;
                square +=
                    double(texel->x) * texel->x + double(texel->y) * texel->y + double(texel->z) * texel->z;
            }
            strip.patch_sum[patch] += area * glm::dvec3(sum);
            strip.square += area * square / 3.0;
        }
        strip.area += area * e.width;
    }
    for (const glm::dvec3& sum : strip.patch_sum) strip.sum += (sum.x + sum.y + sum.z) / 3.0;
    return strip;
}

}  // namespace

RadianceStatistics radiance_statistics(const Environment& e, const ParallelFor& parallel_for) {
    constexpr int kStrips = 32;
    const int strips = std::min(kStrips, e.height), patches = std::min(2 * kStrips, e.width);
    std::vector<Strip> all(static_cast<std::size_t>(strips));
    parallel_for(strips, [&](int i) {
        const int first = int(std::int64_t(e.height) * i / strips),
                  last = int(std::int64_t(e.height) * (i + 1) / strips);
        all[i] = reduce(e, first, last, patches);
    });
    RadianceStatistics s{all[0].lowest, all[0].highest};
    double area = 0.0;
    for (const Strip& strip : all) {
        s.lowest = glm::min(s.lowest, strip.lowest);
        s.highest = glm::max(s.highest, strip.highest);
        s.mean += strip.sum;
        s.mean_square += strip.square;
        area += strip.area;
    }
    s.mean /= area;
    s.mean_square /= area;
    if (s.mean <= 0.0) return s;
    double inverse_squares = 0.0;
    for (const Strip& strip : all)
        for (const glm::dvec3& sum : strip.patch_sum) {
            const double patch_area = strip.area / patches;
            const glm::dvec3 L = glm::max(sum / patch_area, 1e-3 * s.mean);
            inverse_squares += patch_area / 3.0 * (1.0 / (L.x * L.x) + 1.0 / (L.y * L.y) + 1.0 / (L.z * L.z));
        }
    s.error_scale = std::sqrt(area / inverse_squares);
    return s;
}

int kernel_band(double alpha, int largest) {
    // GGX's coefficients fall like 2αl K₁(2αl), the Hankel transform of α²/(α² + θ²/4)²: at 8.5/α less than
    // 1e-6 is left. However wide the lobe, the kink at its horizon keeps a tail that a small sun in a dark
    // room makes visible.
    constexpr int kHorizon = 400;
    return std::min(largest, std::max(kHorizon, int(std::ceil(8.5 / alpha))));
}

void truncate(std::vector<double>& zonal, const std::vector<double>& power, double allowed_rms) {
    constexpr int kLeast = 12;
    double square = 0.0;
    int band = int(zonal.size()) - 1;
    for (; band > kLeast; --band) {
        square += zonal[band] * zonal[band] * power[band] / (4.0 * std::numbers::pi);
        if (square > allowed_rms * allowed_rms) break;
    }
    zonal.resize(std::size_t(band) + 1);
}

}  // namespace patina

// Lights put back into levels they were taken out of.
#include "renderer/ibl/fold_simd.h"
#include "renderer/ibl/kernel.h"
#include "renderer/ibl/lights.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

/// Points that stand for a light's texels.
struct LightPoints {
    std::vector<float> x, y, z, red, green, blue;

    void add(glm::dvec3 direction, glm::dvec3 flux) {
        x.push_back(float(direction.x));
        y.push_back(float(direction.y));
        z.push_back(float(direction.z));
        red.push_back(float(flux.x));
        green.push_back(float(flux.y));
        blue.push_back(float(flux.z));
    }
};

/// Every texel in parts × parts cells of 2 × 2 Gauss points.
LightPoints split_texels(const TexelGrid& grid, const std::vector<LightTexel>& texels, int parts) {
    const double offset = 0.5 / std::numbers::sqrt3;
    LightPoints points;
    for (const LightTexel& texel : texels)
        for (int k = 0; k < 4 * parts * parts; ++k) {
            const int cell = k / 4, row = cell / parts, column = cell % parts;
            const double x = texel.x + (column + 0.5 + (k & 1 ? offset : -offset)) / parts;
            const double y = texel.y + (row + 0.5 + (k & 2 ? offset : -offset)) / parts;
            const double area = grid.row_height() * grid.column_width() * std::sin(y * grid.row_height());
            points.add(grid.direction(x, y), area / (4 * parts * parts) * glm::dvec3(texel.excess));
        }
    return points;
}

/// Blocks of side × side texels as one point each, where their flux is centred.
LightPoints join_texels(const TexelGrid& grid, const std::vector<LightTexel>& texels, int side) {
    struct Block {
        glm::dvec3 flux{0.0}, moment{0.0};
    };
    std::map<std::pair<int, int>, Block> blocks;
    for (const LightTexel& texel : texels) {
        Block& block = blocks[{texel.y / side, texel.x / side}];
        const glm::dvec3 flux = grid.area(texel.y) * glm::dvec3(texel.excess);
        block.flux += flux;
        block.moment += (flux.x + flux.y + flux.z) * grid.direction(texel.x + 0.5, texel.y + 0.5);
    }
    LightPoints points;
    for (const auto& [place, block] : blocks)
        if (glm::length(block.moment) > 0.0) points.add(glm::normalize(block.moment), block.flux);
    return points;
}

// K = (1 − 2s) α²/(s + α²(1 − s))² with s = |N − L|²/4, which is exact for small angles in single precision.

/// The same light in points, ever fewer. The kernel is a power law, K ~ θ⁻⁴: a cluster of mean-square radius
/// σ² taken as a point at its centre errs by ¼σ²(K'' + K'/θ) = 4 (σ/θ)² K. A block of side b has σ² = b²/6.
class FoldedLight {
public:
    FoldedLight(const TexelGrid& grid, const std::vector<LightTexel>& texels, const ExtractedLight& light,
                double alpha)
        : direction_(light.direction) {
        const double size = std::max(grid.row_height(), grid.column_width());
        const double extent = 3.0 * light.angular_radius_rad + size;
        constexpr double far = 40.0;  // block sides: an error of 4e-4
        const int parts = std::clamp(int(std::ceil(2.0 * size / alpha)), 4, 32);
        // A wide lobe's kink at its horizon shows; a narrow one is dark there.
        horizon_ = alpha > 0.1 ? float(2.0 * extent) : 0.0f;
        add_detail(0.0, split_texels(grid, texels, parts));
        add_detail(extent + 8.0 * size, split_texels(grid, texels, 1));
        for (int side = 1; side <= 8; side *= 2)
            add_detail(extent + far * side * size, join_texels(grid, texels, side));
        LightPoints whole;
        whole.add(light.direction, light.irradiance);
        add_detail(100.0 * light.angular_radius_rad / std::numbers::sqrt2,
                   std::move(whole));  // σ² = R²/2
    }

    /// For all directions what the nearest of them needs.
    void add(const simd::FoldLobe& lobe, simd::FoldDirections& to) const {
        float largest = -1.0f, flattest = 1.0f;
        for (int i = 0; i < simd::kFoldDirections; ++i) {
            const float cosine = to.x[i] * direction_.x + to.y[i] * direction_.y + to.z[i] * direction_.z;
            largest = std::max(largest, cosine);
            flattest = std::min(flattest, std::abs(cosine));
        }
        const Detail* detail = &details_.front();
        if (flattest > horizon_)
            for (const Detail& coarser : details_)
                if (largest < coarser.largest_cosine) detail = &coarser;
        const LightPoints& p = detail->points;
        simd::add_points({int(p.x.size()),
                          p.x.data(),
                          p.y.data(),
                          p.z.data(),
                          {p.red.data(), p.green.data(), p.blue.data()}},
                         lobe, to);
    }

private:
    struct Detail {
        float largest_cosine;  ///< good enough below it
        LightPoints points;
    };
    void add_detail(double least_angle, LightPoints points) {
        details_.push_back({least_angle < kPi ? float(std::cos(least_angle)) : -2.0f, std::move(points)});
    }

    glm::vec3 direction_;
    float horizon_ = 0.0f;
    std::vector<Detail> details_;
};

}  // namespace

void fold_back(const LightExtraction& extraction, float roughness, const std::optional<KernelSplit>& split,
               CubeMap& cube, const BakeControl& control) {
    if (extraction.lights.empty() || roughness <= 0.0f) return;
    const double alpha = double(roughness) * roughness;
    const TexelGrid grid = {extraction.residual.width, extraction.residual.height};
    std::vector<FoldedLight> lights;
    for (std::size_t i = 0; i < extraction.lights.size(); ++i)
        lights.emplace_back(grid, extraction.texels[i], extraction.lights[i], alpha);
    const float scale = float(1.0 / ggx_kernel_integral(alpha));
    simd::FoldLobe lobe{.alpha2 = float(alpha * alpha)};
    if (split) {
        lobe.inner_square = float(split->inner_square);
        lobe.window_scale = float(1.0 / (split->outer_square - split->inner_square));
    }
    control.parallel_for(6 * cube.size, [&](int row) {
        if (control.stop.stop_requested()) return;
        for (int first = 0; first < cube.size; first += simd::kFoldDirections) {
            simd::FoldDirections to{};
            for (int i = 0; i < simd::kFoldDirections; ++i) {
                const int x = std::min(first + i, cube.size - 1);
                const glm::vec3 N = cube_texel_direction(cube.size, row / cube.size, x, row % cube.size);
                to.x[i] = N.x;
                to.y[i] = N.y;
                to.z[i] = N.z;
            }
            for (const FoldedLight& light : lights) light.add(lobe, to);
            const int count = std::min(simd::kFoldDirections, cube.size - first);
            for (int i = 0; i < count; ++i)
                cube.texels[std::size_t(row) * cube.size + first + i] +=
                    scale * glm::vec3(to.sums[0][i], to.sums[1][i], to.sums[2][i]);
        }
    });
}

}  // namespace patina

#include "renderer/ibl/lights.h"

#include "renderer/ibl/kernel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

double luminance(glm::dvec3 c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

struct Geometry {
    const Environment& e;
    double row_height = kPi / e.height;
    double column_width = 2.0 * kPi / e.width;

    double area(int y) const {
        return (std::cos(y * row_height) - std::cos((y + 1) * row_height)) * column_width;
    }
    glm::dvec3 direction(double x, double y) const {  // in texels
        const double theta = y * row_height, phi = x * column_width;
        return {-std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
    }
    glm::dvec3 radiance(int texel) const { return e.radiance[texel]; }
    int neighbour(int texel, int dx, int dy) const {  // −1 beyond a pole
        const int y = texel / e.width + dy;
        if (y < 0 || y >= e.height) return -1;
        return y * e.width + (texel % e.width + dx + e.width) % e.width;
    }
};

/// Texels as row · width + column.
using Region = std::vector<int>;

/// Splits texels into connected regions (eight neighbours, around the seam).
std::vector<Region> connected(const Geometry& geometry, const Region& texels,
                              std::vector<unsigned char>& inside) {
    for (const int texel : texels) inside[texel] = 1;
    std::vector<Region> regions;
    for (const int first : texels) {
        if (!inside[first]) continue;
        Region region = {first};
        inside[first] = 0;
        for (std::size_t i = 0; i < region.size(); ++i)
            for (int k = 0; k < 9; ++k) {
                const int next = geometry.neighbour(region[i], k % 3 - 1, k / 3 - 1);
                if (next < 0 || !inside[next]) continue;
                inside[next] = 0;
                region.push_back(next);
            }
        regions.push_back(std::move(region));
    }
    return regions;
}

struct Candidate {
    std::vector<LightTexel> texels;
    glm::dvec3 irradiance{0.0};
    glm::dvec3 direction{0.0};
    double mean_square_radius = 0.0;
    double spread = 0.0;  ///< the same between the texels' centres: 0 for a single texel
};

/// The mean radiance of the texels that touch the region.
glm::dvec3 surroundings(const Geometry& geometry, const Region& region, std::vector<unsigned char>& inside) {
    for (const int texel : region) inside[texel] = 1;
    glm::dvec3 sum(0.0);
    double area = 0.0;
    Region border;
    for (const int texel : region)
        for (int k = 0; k < 9; ++k) {
            const int next = geometry.neighbour(texel, k % 3 - 1, k / 3 - 1);
            if (next < 0 || inside[next]) continue;
            inside[next] = 2;
            border.push_back(next);
            sum += geometry.area(next / geometry.e.width) * geometry.radiance(next);
            area += geometry.area(next / geometry.e.width);
        }
    for (const int texel : region) inside[texel] = 0;
    for (const int texel : border) inside[texel] = 0;
    return area > 0.0 ? sum / area : glm::dvec3(0.0);
}

Candidate measure(const Geometry& geometry, const Region& region, std::vector<unsigned char>& inside) {
    Candidate light;
    const glm::dvec3 background = surroundings(geometry, region, inside);
    glm::dvec3 centroid(0.0);
    for (const int texel : region) {
        const int x = texel % geometry.e.width, y = texel / geometry.e.width;
        const glm::vec3 excess = glm::max(geometry.radiance(texel) - background, 0.0);
        light.texels.push_back({x, y, excess});
        const glm::dvec3 flux = geometry.area(y) * glm::dvec3(excess);
        light.irradiance += flux;
        centroid += luminance(flux) * geometry.direction(x + 0.5, y + 0.5);
    }
    light.direction = glm::length(centroid) > 0.0 ? glm::normalize(centroid) : glm::dvec3(0, 1, 0);
    double square = 0.0, own_square = 0.0, total = 0.0;
    for (const LightTexel& texel : light.texels) {
        const glm::dvec3 apart = geometry.direction(texel.x + 0.5, texel.y + 0.5) - light.direction;
        const double width = geometry.column_width * std::sin((texel.y + 0.5) * geometry.row_height);
        const double own =
            (geometry.row_height * geometry.row_height + width * width) / 12.0;  // of the texel's area
        const double flux = luminance(geometry.area(texel.y) * glm::dvec3(texel.excess));
        square += flux * glm::dot(apart, apart);
        own_square += flux * own;
        total += flux;
    }
    light.spread = total > 0.0 ? square / total : kPi;
    light.mean_square_radius = light.spread + (total > 0.0 ? own_square / total : 0.0);
    return light;
}

/// Compact regions of texels above the threshold; wide ones again at four times the threshold.
std::vector<Candidate> search_lights(const Geometry& geometry, Region texels, double threshold,
                                     double largest_rms_radius) {
    std::vector<unsigned char> inside(geometry.e.radiance.size(), 0);
    std::vector<Candidate> found;
    const double largest = largest_rms_radius * largest_rms_radius;
    while (!texels.empty()) {
        Region wide;
        for (const Region& region : connected(geometry, texels, inside)) {
            Candidate light = measure(geometry, region, inside);
            if (light.spread <= largest)
                found.push_back(std::move(light));
            else
                wide.insert(wide.end(), region.begin(), region.end());
        }
        threshold *= 4.0;
        texels.clear();
        std::copy_if(wide.begin(), wide.end(), std::back_inserter(texels),
                     [&](int texel) { return luminance(geometry.radiance(texel)) > threshold; });
    }
    return found;
}

/// Points that stand for a light at a distance: their solid angles sum to the texels'.
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
LightPoints make_points(const Geometry& geometry, const std::vector<LightTexel>& texels, int parts) {
    const double offset = 0.5 / std::numbers::sqrt3;
    LightPoints points;
    for (const LightTexel& texel : texels)
        for (int k = 0; k < 4 * parts * parts; ++k) {
            const int cell = k / 4;
            const double x = texel.x + (cell % parts + 0.5 + (k & 1 ? offset : -offset)) / parts;
            const double y = texel.y + (double(cell / parts) + 0.5 + (k & 2 ? offset : -offset)) / parts;
            const double area = geometry.row_height * geometry.column_width *
                                std::sin(y * geometry.row_height) / (4 * parts * parts);
            points.add(geometry.direction(x, y), area * glm::dvec3(texel.excess));
        }
    return points;
}

/// Σ flux · K over the points in front of N. K = (1 − 2s) α²/(s + α²(1 − s))² with s = |N − L|²/4, which is
/// exact for small angles in single precision.
glm::vec3 sum_points(const LightPoints& points, glm::vec3 N, float alpha2) {
    float red = 0.0f, green = 0.0f, blue = 0.0f;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        const float dx = points.x[i] - N.x, dy = points.y[i] - N.y, dz = points.z[i] - N.z;
        const float s = 0.25f * (dx * dx + dy * dy + dz * dz);
        const float d = s + alpha2 * (1.0f - s);
        const float kernel = std::max(0.0f, 1.0f - 2.0f * s) * alpha2 / (d * d);
        red += points.red[i] * kernel;
        green += points.green[i] * kernel;
        blue += points.blue[i] * kernel;
    }
    return {red, green, blue};
}

/// One light at three distances: as it is, each texel as a whole, and as a point.
struct FoldedLight {
    glm::vec3 direction;
    float near_cosine, far_cosine, horizon;
    LightPoints fine, texels, point;
};

FoldedLight prepare(const Geometry& geometry, const std::vector<LightTexel>& texels,
                    const ExtractedLight& light, double alpha) {
    const double size = std::max(geometry.row_height, geometry.column_width);
    const double extent = 3.0 * light.angular_radius_rad + size;
    FoldedLight folded;
    folded.direction = light.direction;
    folded.near_cosine = float(std::cos(std::min(kPi, extent + 8.0 * size)));
    folded.far_cosine = float(std::cos(std::min(kPi, 100.0 * extent)));
    folded.horizon = float(2.0 * extent);  // the kernel has a kink there
    folded.fine = make_points(geometry, texels, std::clamp(int(std::ceil(2.0 * size / alpha)), 4, 32));
    folded.texels = make_points(geometry, texels, 1);
    folded.point.add(light.direction, light.irradiance);
    return folded;
}

}  // namespace

LightExtraction extract_lights(const Environment& environment, const RadianceStatistics& statistics,
                               const LightSearch& search) {
    const Geometry geometry{environment};
    const double mean = luminance(statistics.mean_color);
    Region bright;
    const float threshold = float(search.threshold * mean);
    for (std::size_t i = 0; i < environment.radiance.size(); ++i) {
        const glm::vec3& L = environment.radiance[i];
        if (std::max({L.x, L.y, L.z}) > threshold && luminance(L) > threshold) bright.push_back(int(i));
    }
    LightExtraction result;
    result.residual = view_of(environment);
    if (bright.empty() || bright.size() * 4 > environment.radiance.size()) return result;

    std::vector<Candidate> found =
        search_lights(geometry, std::move(bright), search.threshold * mean, search.largest_rms_radius_rad);
    std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
        return luminance(a.irradiance) > luminance(b.irradiance);
    });
    std::map<int, std::size_t> changed;
    for (Candidate& light : found) {
        if (int(result.lights.size()) >= search.most) break;
        if (luminance(light.irradiance) < search.least_irradiance * kPi * mean) break;
        result.lights.push_back({glm::vec3(light.direction), glm::vec3(light.irradiance),
                                 float(std::sqrt(2.0 * light.mean_square_radius))});
        for (const LightTexel& texel : light.texels) {
            const auto [place, added] = changed.try_emplace(texel.y, result.changed_rows.size());
            const glm::vec3* row = &environment.radiance[std::size_t(texel.y) * environment.width];
            if (added) result.changed_rows.emplace_back(row, row + environment.width);
            result.changed_rows[place->second][texel.x] -= texel.excess;
        }
        result.texels.push_back(std::move(light.texels));
    }
    for (const auto& [y, index] : changed) result.residual.rows[y] = result.changed_rows[index].data();
    return result;
}

void fold_back(const LightExtraction& extraction, float roughness, CubeMap& cube,
               const BakeControl& control) {
    if (extraction.lights.empty() || roughness <= 0.0f) return;
    const double alpha = double(roughness) * roughness;
    Environment shape;  // only its size is looked at
    shape.width = extraction.residual.width;
    shape.height = extraction.residual.height;
    const Geometry geometry{shape};
    std::vector<FoldedLight> lights;
    for (std::size_t i = 0; i < extraction.lights.size(); ++i)
        lights.push_back(prepare(geometry, extraction.texels[i], extraction.lights[i], alpha));
    const float scale = float(1.0 / ggx_kernel_integral(alpha));
    const float alpha2 = float(alpha * alpha);
    control.parallel_for(6 * cube.size, [&](int row) {
        if (control.stop.stop_requested()) return;
        for (int x = 0; x < cube.size; ++x) {
            const glm::vec3 N = cube_texel_direction(cube.size, row / cube.size, x, row % cube.size);
            glm::vec3 sum(0.0f);
            for (const FoldedLight& light : lights) {
                const float cosine = glm::dot(N, light.direction);
                const bool is_near = cosine > light.near_cosine || std::abs(cosine) < light.horizon;
                const LightPoints& points = is_near                     ? light.fine
                                            : cosine > light.far_cosine ? light.texels
                                                                        : light.point;
                sum += sum_points(points, N, alpha2);
            }
            cube.texels[std::size_t(row) * cube.size + x] += scale * sum;
        }
    });
}

}  // namespace patina

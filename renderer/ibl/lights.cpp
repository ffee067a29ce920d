#include "renderer/ibl/lights.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

double luminance(glm::dvec3 c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

struct Geometry : TexelGrid {
    const Environment& e;

    explicit Geometry(const Environment& environment)
        : TexelGrid{environment.width, environment.height}, e(environment) {}
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
        const double width = geometry.column_width() * std::sin((texel.y + 0.5) * geometry.row_height());
        const double own =
            (geometry.row_height() * geometry.row_height() + width * width) / 12.0;  // of the texel's area
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

}  // namespace

LightExtraction extract_lights(const Environment& environment, const RadianceStatistics& statistics,
                               const LightSearch& search) {
    const Geometry geometry(environment);
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

}  // namespace patina

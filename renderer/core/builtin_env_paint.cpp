#include "renderer/core/builtin_env.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

/// Pictures narrower than this are painted at a multiple of their width and averaged, so that no light slips
/// between samples.
constexpr int kFineWidth = 700;
/// Samples along each side of a texel that a region's edge may cross.
constexpr int kEdgeSamples = 4;

/// The directions of a picture's sample grid: sines and cosines of each column's azimuth and each row's polar
/// angle.
struct Grid {
    Grid(int columns, int rows) : azimuth(columns), polar(rows) {
        for (int x = 0; x < columns; ++x) {
            const double angle = ((x + 0.5) / columns - 0.5) * 2.0 * kPi;
            azimuth[x] = {std::sin(angle), -std::cos(angle)};
        }
        for (int y = 0; y < rows; ++y) {
            const double angle = (y + 0.5) / rows * kPi;
            polar[y] = {std::sin(angle), std::cos(angle)};
        }
    }
    glm::vec3 direction(int x, int y) const {
        return {azimuth[x].x * polar[y].x, polar[y].y, azimuth[x].y * polar[y].x};
    }
    std::vector<glm::vec2> azimuth;
    std::vector<glm::vec2> polar;
};

/// A picture with the region each texel's centre saw.
struct Canvas {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance;
    std::vector<int> region;

    std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

Canvas paint_centres(int width, int height, const Painting& scene) {
    Canvas canvas{.width = width, .height = height};
    canvas.radiance.resize(static_cast<std::size_t>(width) * height);
    canvas.region.resize(canvas.radiance.size());
    const Grid grid(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const PaintedPoint sight = scene(grid.direction(x, y));
            canvas.radiance[canvas.at(x, y)] = sight.radiance;
            canvas.region[canvas.at(x, y)] = sight.region;
        }
    return canvas;
}

bool at_edge(const Canvas& canvas, int x, int y) {
    const int here = canvas.region[canvas.at(x, y)];
    const std::array<int, 3> columns{x, (x + 1) % canvas.width, (x + canvas.width - 1) % canvas.width};
    const std::array<int, 3> rows{y, std::min(y + 1, canvas.height - 1), std::max(y - 1, 0)};
    return std::any_of(rows.begin(), rows.end(), [&](int row) {
        return std::any_of(columns.begin(), columns.end(),
                           [&](int column) { return canvas.region[canvas.at(column, row)] != here; });
    });
}

void refine_edges(Canvas& canvas, const Painting& scene) {
    const Grid fine(canvas.width * kEdgeSamples, canvas.height * kEdgeSamples);
    for (int y = 0; y < canvas.height; ++y)
        for (int x = 0; x < canvas.width; ++x) {
            if (!at_edge(canvas, x, y)) continue;
            glm::vec3 sum(0.0f);
            float weights = 0.0f;
            for (int i = 0; i < kEdgeSamples * kEdgeSamples; ++i) {
                const int row = y * kEdgeSamples + i / kEdgeSamples;
                const float weight = fine.polar[row].x;
                sum += weight * scene(fine.direction(x * kEdgeSamples + i % kEdgeSamples, row)).radiance;
                weights += weight;
            }
            canvas.radiance[canvas.at(x, y)] = sum / weights;
        }
}

double row_solid_angle(int width, int height, int row) {
    return 2.0 * kPi / width * (std::cos(kPi * row / height) - std::cos(kPi * (row + 1) / height));
}

/// Each texel becomes the solid-angle mean of the factor × factor fine ones it covers.
std::vector<glm::vec3> averaged(const Canvas& fine, int factor) {
    const int width = fine.width / factor;
    const int height = fine.height / factor;
    std::vector<glm::vec3> coarse(static_cast<std::size_t>(width) * height);
    for (int y = 0; y < height; ++y) {
        const double whole = row_solid_angle(width, height, y);
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0.0);
            for (int row = y * factor; row < (y + 1) * factor; ++row) {
                glm::dvec3 line(0.0);
                for (int column = x * factor; column < (x + 1) * factor; ++column)
                    line += glm::dvec3(fine.radiance[fine.at(column, row)]);
                sum += line * (row_solid_angle(fine.width, fine.height, row) / whole);
            }
            coarse[static_cast<std::size_t>(y) * width + x] = glm::vec3(sum);
        }
    }
    return coarse;
}

/// Relative radiance of a disc at that angle from its centre; 0 outside.
double disc_profile(const Disc& disc, const glm::dvec3& direction) {
    const double sine = glm::length(glm::cross(glm::dvec3(disc.direction), direction));
    const double r = sine / std::sin(static_cast<double>(disc.angular_radius));
    if (r > 1.0 || glm::dot(glm::dvec3(disc.direction), direction) < 0.0) return 0.0;
    return 1.0 - disc.limb_darkening * (1.0 - std::sqrt(1.0 - r * r));
}

glm::dvec3 direction_at(double u, double v) {
    const double azimuth = (u - 0.5) * 2.0 * kPi;
    return {std::sin(azimuth) * std::sin(v * kPi), std::cos(v * kPi), -std::cos(azimuth) * std::sin(v * kPi)};
}

/// The disc's energy in one texel, before normalisation.
double disc_energy(const Environment& environment, const Disc& disc, int x, int y) {
    const double across = kPi / environment.height / disc.angular_radius;
    const int samples = std::clamp(static_cast<int>(std::ceil(8.0 * across)), 4, 48);
    double sum = 0.0;
    double weights = 0.0;
    for (int i = 0; i < samples; ++i) {
        const double v = (y + (i + 0.5) / samples) / environment.height;
        const double weight = std::sin(v * kPi);
        for (int j = 0; j < samples; ++j)
            sum +=
                weight * disc_profile(disc, direction_at((x + (j + 0.5) / samples) / environment.width, v));
        weights += weight * samples;
    }
    return sum / weights * texel_solid_angle(environment, y);
}

struct Share {
    std::size_t texel;
    double energy;
};

/// The texels a disc covers: the rows within its radius and, away from the poles, the columns within its
/// azimuth range.
std::vector<Share> disc_shares(const Environment& environment, const Disc& disc) {
    const glm::vec2 uv = direction_to_equirect(disc.direction);
    const double radius = disc.angular_radius;
    const double polar = uv.y * kPi;
    const int first = std::max(0, static_cast<int>((polar - radius) / kPi * environment.height) - 1);
    const int last =
        std::min(environment.height - 1, static_cast<int>((polar + radius) / kPi * environment.height) + 1);
    const bool around_pole = polar - radius < 0.0 || polar + radius > kPi;
    const double reach = around_pole ? kPi : std::asin(std::min(1.0, std::sin(radius) / std::sin(polar)));
    const int span =
        std::min(environment.width / 2, static_cast<int>(reach / (2.0 * kPi) * environment.width) + 2);
    const int centre =
        std::min(static_cast<int>(uv.x * static_cast<float>(environment.width)), environment.width - 1);
    std::vector<Share> shares;
    for (int y = first; y <= last; ++y)
        for (int x = centre - span; x <= centre + span; ++x) {
            if (x == centre - span && 2 * span >= environment.width)
                continue;  // all the way round: the same column
            const int column = (x + environment.width) % environment.width;
            const double energy = disc_energy(environment, disc, column, y);
            if (energy > 0.0)
                shares.push_back({static_cast<std::size_t>(y) * environment.width + column, energy});
        }
    // So small beside a texel that every sample missed it.
    const int row =
        std::min(static_cast<int>(uv.y * static_cast<float>(environment.height)), environment.height - 1);
    if (shares.empty()) shares.push_back({static_cast<std::size_t>(row) * environment.width + centre, 1.0});
    return shares;
}

}  // namespace

Environment paint_environment(int width, const Painting& scene) {
    Environment environment{.width = std::max(width, 2)};
    environment.height = environment.width / 2;
    const int factor = (kFineWidth + environment.width - 1) / environment.width;
    Canvas canvas = paint_centres(environment.width * factor, environment.height * factor, scene);
    refine_edges(canvas, scene);
    environment.radiance = factor == 1 ? std::move(canvas.radiance) : averaged(canvas, factor);
    return environment;
}

void add_disc(Environment& environment, const Disc& disc) {
    std::vector<Share> shares = disc_shares(environment, disc);
    double sum = 0.0;
    for (const Share& share : shares) sum += share.energy;
    const double solid_angle = 2.0 * kPi * (1.0 - std::cos(static_cast<double>(disc.angular_radius)));
    for (const Share& share : shares) {
        const int row = static_cast<int>(share.texel / environment.width);
        const double mean = share.energy / sum * solid_angle / texel_solid_angle(environment, row);
        environment.radiance[share.texel] += glm::vec3(glm::dvec3(disc.radiance) * mean);
    }
}

double texel_solid_angle(const Environment& environment, int row) {
    return row_solid_angle(environment.width, environment.height, row);
}

glm::dvec3 total_energy(const Environment& environment) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < environment.height; ++y) {
        glm::dvec3 row(0.0);
        for (int x = 0; x < environment.width; ++x)
            row += glm::dvec3(environment.radiance[static_cast<std::size_t>(y) * environment.width + x]);
        sum += row * texel_solid_angle(environment, y);
    }
    return sum;
}

}  // namespace patina

#include "renderer/core/homography.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace patina {

namespace {

constexpr int kUnknowns = 8;
constexpr int kMostSamples = 8;  ///< a side

/// Takes the points' centroid to 0 and their mean distance to √2.
glm::dmat3 normalising(const FourPoints& points) {
    glm::dvec2 centre(0.0);
    for (const glm::dvec2 point : points) centre += 0.25 * point;
    double distance = 0.0;
    for (const glm::dvec2 point : points) distance += 0.25 * glm::distance(point, centre);
    const double scale = distance > 0.0 ? std::sqrt(2.0) / distance : 1.0;
    return {scale, 0.0, 0.0, 0.0, scale, 0.0, -scale * centre.x, -scale * centre.y, 1.0};
}

/// No three of them on a line, measured against their extent.
bool in_general_position(const FourPoints& normalised) {
    constexpr double least_area = 1e-4;
    for (std::size_t skipped = 0; skipped < 4; ++skipped) {
        std::array<glm::dvec2, 3> p;
        for (std::size_t i = 0, k = 0; i < 4; ++i)
            if (i != skipped) p[k++] = normalised[i];
        const glm::dvec2 a = p[1] - p[0], b = p[2] - p[0];
        if (!(std::abs(a.x * b.y - a.y * b.x) > least_area)) return false;
    }
    return true;
}

using Row = std::array<double, kUnknowns + 1>;

/// Gauss with row pivots; nullopt for a singular system.
std::optional<std::array<double, kUnknowns>> solved(std::array<Row, kUnknowns> rows) {
    for (std::size_t column = 0; column < kUnknowns; ++column) {
        std::size_t pivot = column;
        for (std::size_t r = column + 1; r < kUnknowns; ++r)
            if (std::abs(rows[r][column]) > std::abs(rows[pivot][column])) pivot = r;
        if (!(std::abs(rows[pivot][column]) > 1e-12)) return std::nullopt;
        std::swap(rows[pivot], rows[column]);
        for (std::size_t r = 0; r < kUnknowns; ++r) {
            if (r == column) continue;
            const double factor = rows[r][column] / rows[column][column];
            for (std::size_t c = column; c <= kUnknowns; ++c) rows[r][c] -= factor * rows[column][c];
        }
    }
    std::array<double, kUnknowns> solution{};
    for (std::size_t i = 0; i < kUnknowns; ++i) solution[i] = rows[i][kUnknowns] / rows[i][i];
    return solution;
}

/// Adds the pixel's colour, bilinear between texel centres; false outside the photo.
bool add_sample(const Image& photo, glm::dvec2 at, glm::dvec3& sum) {
    if (!(at.x >= 0.0 && at.y >= 0.0 && at.x <= photo.width && at.y <= photo.height)) return false;
    const glm::dvec2 texel_at =
        glm::clamp(at - 0.5, glm::dvec2(0.0), {photo.width - 1.0, photo.height - 1.0});
    const int x0 = int(texel_at.x), y0 = int(texel_at.y);
    const int x1 = std::min(x0 + 1, photo.width - 1), y1 = std::min(y0 + 1, photo.height - 1);
    const double fx = texel_at.x - x0, fy = texel_at.y - y0;
    for (int c = 0; c < 3; ++c) {
        const double top =
            (1.0 - fx) * double(texel(photo, x0, y0, c)) + fx * double(texel(photo, x1, y0, c));
        const double low =
            (1.0 - fx) * double(texel(photo, x0, y1, c)) + fx * double(texel(photo, x1, y1, c));
        sum[c] += (1.0 - fy) * top + fy * low;
    }
    return true;
}

/// Samples a side, so that neighbouring ones are about a photo's pixel apart.
int samples_at(const glm::dmat3& to_photo, glm::dvec2 pixel) {
    const glm::dvec2 here = mapped(to_photo, pixel);
    const double step = std::max(glm::distance(here, mapped(to_photo, pixel + glm::dvec2(1.0, 0.0))),
                                 glm::distance(here, mapped(to_photo, pixel + glm::dvec2(0.0, 1.0))));
    return std::isfinite(step) ? int(std::clamp(std::ceil(step), 1.0, double(kMostSamples))) : 1;
}

void warp_pixel(const Image& photo, const glm::dmat3& to_photo, glm::ivec2 at, Image& result) {
    const int n = samples_at(to_photo, glm::dvec2(at));
    glm::dvec3 sum(0.0);
    int inside = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const glm::dvec2 sub(at.x + (i + 0.5) / n, at.y + (j + 0.5) / n);
            if ((to_photo * glm::dvec3(sub, 1.0)).z > 0.0)
                inside += add_sample(photo, mapped(to_photo, sub), sum) ? 1 : 0;
        }
    if (2 * inside < n * n || inside == 0) return;
    for (int c = 0; c < 3; ++c) set_texel(result, at.x, at.y, c, float(sum[c] / inside));
    set_texel(result, at.x, at.y, 3, 1.0f);
}

}  // namespace

glm::dvec2 mapped(const glm::dmat3& h, glm::dvec2 point) {
    const glm::dvec3 p = h * glm::dvec3(point, 1.0);
    return glm::dvec2(p) / p.z;
}

std::optional<glm::dmat3> homography(const FourPoints& from, const FourPoints& to) {
    const glm::dmat3 from_normal = normalising(from), to_normal = normalising(to);
    FourPoints a, b;
    for (std::size_t i = 0; i < 4; ++i) {
        a[i] = mapped(from_normal, from[i]);
        b[i] = mapped(to_normal, to[i]);
    }
    if (!in_general_position(a) || !in_general_position(b)) return std::nullopt;
    std::array<Row, kUnknowns> rows;
    for (std::size_t i = 0; i < 4; ++i) {
        const double x = a[i].x, y = a[i].y, u = b[i].x, v = b[i].y;
        rows[2 * i] = {x, y, 1.0, 0.0, 0.0, 0.0, -u * x, -u * y, u};
        rows[2 * i + 1] = {0.0, 0.0, 0.0, x, y, 1.0, -v * x, -v * y, v};
    }
    const auto h = solved(rows);
    if (!h) return std::nullopt;
    const glm::dmat3 normalised((*h)[0], (*h)[3], (*h)[6], (*h)[1], (*h)[4], (*h)[7], (*h)[2], (*h)[5], 1.0);
    const glm::dmat3 result = glm::inverse(to_normal) * normalised * from_normal;
    // The sign by which the points lie before the horizon, not behind it.
    return (result * glm::dvec3(from[0], 1.0)).z < 0.0 ? -1.0 * result : result;
}

Image warped(const Image& photo, const glm::dmat3& to_photo, glm::ivec2 size) {
    assert(photo.channels == 3 && photo.type == PixelType::F32);
    Image result = make_image(size.x, size.y, 4, PixelType::F32);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) warp_pixel(photo, to_photo, {x, y}, result);
    return result;
}

}  // namespace patina

#include "renderer/ibl/panorama.h"

#include <glm/common.hpp>
#include <glm/ext/vector_double3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

/// A strip of rows, reduced to patches.
struct Strip {
    glm::vec3 lowest, highest;
    glm::dvec3 sum{0.0};
    double square = 0.0, area = 0.0;
    std::vector<glm::dvec3> patch_sum;  ///< of this strip's rows, by column of patches
};

Strip measure_strip(const RadianceView& e, int first_row, int last_row, int patches) {
    Strip strip{e.rows[first_row][0], e.rows[first_row][0]};
    strip.patch_sum.assign(std::size_t(patches), glm::dvec3(0.0));
    for (int y = first_row; y < last_row; ++y) {
        const double area = std::sin((y + 0.5) * std::numbers::pi / e.height);
        const glm::vec3* texel = e.rows[y];
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
    for (const glm::dvec3& sum : strip.patch_sum) strip.sum += sum;
    return strip;
}

}  // namespace

double TexelGrid::row_height() const { return std::numbers::pi / height; }

double TexelGrid::column_width() const { return 2.0 * std::numbers::pi / width; }

double TexelGrid::area(int y) const {
    return (std::cos(y * row_height()) - std::cos((y + 1) * row_height())) * column_width();
}

glm::dvec3 TexelGrid::direction(double x, double y) const {
    const double theta = y * row_height(), phi = x * column_width();
    return {-std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
}

RadianceView view_of(const Environment& e) {
    RadianceView view{e.width, e.height, {}};
    for (int y = 0; y < e.height; ++y) view.rows.push_back(&e.radiance[std::size_t(y) * e.width]);
    return view;
}

Environment reduce(const Environment& e, int width, int height, const ParallelFor& parallel_for) {
    Environment small;
    small.width = std::min(width, e.width);
    small.height = std::min(height, e.height);
    small.radiance.resize(std::size_t(small.width) * small.height);
    const auto begin = [](int i, int parts, int size) { return int(std::int64_t(size) * i / parts); };
    parallel_for(small.height, [&](int row) {
        std::vector<glm::vec3> sums(std::size_t(small.width), glm::vec3(0.0f));
        float area = 0.0f;
        for (int y = begin(row, small.height, e.height); y < begin(row + 1, small.height, e.height); ++y) {
            const float sine = float(std::sin((y + 0.5) * std::numbers::pi / e.height));
            const glm::vec3* texel = &e.radiance[std::size_t(y) * e.width];
            for (int column = 0; column < small.width; ++column) {
                const glm::vec3* end =
                    &e.radiance[std::size_t(y) * e.width] + begin(column + 1, small.width, e.width);
                glm::vec3 sum(0.0f);
                for (; texel != end; ++texel) sum += *texel;
                sums[column] += sine * sum;
            }
            area += sine;
        }
        for (int column = 0; column < small.width; ++column) {
            const int texels = begin(column + 1, small.width, e.width) - begin(column, small.width, e.width);
            small.radiance[std::size_t(row) * small.width + column] = sums[column] / (area * float(texels));
        }
    });
    return small;
}

RadianceStatistics radiance_statistics(const RadianceView& e, const ParallelFor& parallel_for) {
    constexpr int most_strips = 32;
    const int strips = std::min(most_strips, e.height), patches = std::min(2 * most_strips, e.width);
    std::vector<Strip> all(static_cast<std::size_t>(strips));
    parallel_for(strips, [&](int i) {
        const int first = int(std::int64_t(e.height) * i / strips),
                  last = int(std::int64_t(e.height) * (i + 1) / strips);
        all[i] = measure_strip(e, first, last, patches);
    });
    RadianceStatistics s{all[0].lowest, all[0].highest};
    double area = 0.0;
    for (const Strip& strip : all) {
        s.lowest = glm::min(s.lowest, strip.lowest);
        s.highest = glm::max(s.highest, strip.highest);
        s.mean_color += strip.sum;
        s.mean_square += strip.square;
        area += strip.area;
    }
    s.mean_color /= area;
    s.mean = (s.mean_color.x + s.mean_color.y + s.mean_color.z) / 3.0;
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

}  // namespace patina

#include "renderer/ibl/panorama.h"

#include "renderer/ibl/panorama_simd.h"

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
    double area = 0.0;
    std::vector<glm::dvec3> patch_sum;  ///< of this strip's rows, by column of patches
};

/// Four texels at a time, each float in a place of its own: the compiler can then use vectors.
glm::vec3 sum_of(const glm::vec3* texels, int count) {
    const float* from = &texels->x;
    float places[simd::kTogether] = {};
    int i = 0;
    for (; i + simd::kTogether <= 3 * count; i += simd::kTogether)
        for (int k = 0; k < simd::kTogether; ++k) places[k] += from[i + k];
    for (int k = 0; i < 3 * count; ++i, ++k) places[k] += from[i];
    glm::vec3 sum(0.0f);
    for (int k = 0; k < simd::kTogether; ++k) sum[k % 3] += places[k];
    return sum;
}

Strip measure_strip(const RadianceView& e, int first_row, int last_row, int patches) {
    Strip strip{e.rows[first_row][0], e.rows[first_row][0]};
    strip.patch_sum.assign(std::size_t(patches), glm::dvec3(0.0));
    simd::TexelRange range;
    for (int k = 0; k < simd::kTogether; ++k) range.lowest[k] = range.highest[k] = strip.lowest[k % 3];
    for (int y = first_row; y < last_row; ++y) {
        const double area = std::sin((y + 0.5) * std::numbers::pi / e.height);
        for (int patch = 0; patch < patches; ++patch) {
            const int begin = int(std::int64_t(e.width) * patch / patches);
            const int end = int(std::int64_t(e.width) * (patch + 1) / patches);
            glm::vec3 measured;
            simd::measure_texels(&e.rows[y][begin].x, end - begin, range, &measured.x);
            strip.patch_sum[patch] += area * glm::dvec3(measured);
        }
        strip.area += area * e.width;
    }
    for (int k = 0; k < simd::kTogether; ++k) {
        strip.lowest[k % 3] = std::min(strip.lowest[k % 3], range.lowest[k]);
        strip.highest[k % 3] = std::max(strip.highest[k % 3], range.highest[k]);
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

Environment reduce(const RadianceView& e, int width, int height, const ParallelFor& parallel_for) {
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
            const glm::vec3* texel = e.rows[y];
            for (int column = 0; column < small.width; ++column) {
                const glm::vec3* end = e.rows[y] + begin(column + 1, small.width, e.width);
                sums[column] += sine * sum_of(texel, int(end - texel));
                texel = end;
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
        area += strip.area;
    }
    s.mean_color /= area;
    s.mean = (s.mean_color.x + s.mean_color.y + s.mean_color.z) / 3.0;
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

#include "renderer/maps/tile.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace patina {

namespace {

/// Squared differences of what is seen (roughly the square root of light).
float difference(glm::vec3 a, glm::vec3 b) {
    const glm::vec3 d = glm::sqrt(glm::max(a, 0.0f)) - glm::sqrt(glm::max(b, 0.0f));
    return glm::dot(d, d);
}

/// The cheapest way from the first row to the last, a column a row, at most one column aside each step.
/// begin, end: where it must start and stop; < 0: anywhere.
std::vector<int> cheapest_path(const Plane& costs, int begin, int end) {
    Plane total = costs;
    Grid<signed char> from(costs.width, costs.height);
    for (int x = 0; x < costs.width; ++x)
        if (begin >= 0 && x != begin) total.at(x, 0) = std::numeric_limits<float>::max();
    for (int y = 1; y < costs.height; ++y)
        for (int x = 0; x < costs.width; ++x) {
            int best = 0;
            for (const int aside : {-1, 1})
                if (x + aside >= 0 && x + aside < costs.width &&
                    total.at(x + aside, y - 1) < total.at(x + best, y - 1))
                    best = aside;
            from.at(x, y) = static_cast<signed char>(best);
            const float before = total.at(x + best, y - 1);
            total.at(x, y) = before == std::numeric_limits<float>::max() ? before : before + costs.at(x, y);
        }
    const int last = costs.height - 1;
    int x = end;
    if (end < 0) {
        const auto* row = &total.at(0, last);
        x = int(std::min_element(row, row + costs.width) - row);
    }
    std::vector<int> path(std::size_t(costs.height));
    for (int y = last; y >= 0; --y) {
        path[std::size_t(y)] = x;
        x += from.at(x, y);
    }
    return path;
}

float cost_of(const Plane& costs, std::span<const int> path) {
    float sum = 0.0f;
    for (int y = 0; y < costs.height; ++y) sum += costs.at(path[std::size_t(y)], y);
    return sum;
}

/// A path that ends where it began: through the end points of the free one, the cheaper of the two.
std::vector<int> closed_path(const Plane& costs) {
    const std::vector<int> open = cheapest_path(costs, -1, -1);
    std::vector<int> best;
    for (const int through : {open.front(), open.back()}) {
        std::vector<int> path = cheapest_path(costs, through, through);
        if (best.empty() || cost_of(costs, path) < cost_of(costs, best)) best = std::move(path);
    }
    return best;
}

/// Means over 2 · radius + 1 neighbours, twice; beyond the ends it goes on at the other end, or stands still.
std::vector<glm::vec3> smoothed(std::vector<glm::vec3> values, int radius, bool closed) {
    const int size = int(values.size());
    radius = std::min(radius, size - 1);
    for (int round = 0; round < 2; ++round) {
        std::vector<glm::vec3> means(values.size());
        for (int i = 0; i < size; ++i) {
            for (int k = -radius; k <= radius; ++k)
                means[std::size_t(i)] += values[std::size_t(neighbour(i + k, size, closed))];
            means[std::size_t(i)] /= float(2 * radius + 1);
        }
        values = std::move(means);
    }
    return values;
}

/// What the two sides differ by along the path, without its detail.
std::vector<glm::vec3> step_along(const Colors& picture, int overlap, std::span<const int> path,
                                  bool closed) {
    std::vector<glm::vec3> step(path.size());
    for (int y = 0; y < picture.height; ++y) {
        const int x = path[std::size_t(y)];
        step[std::size_t(y)] = picture.at(x, y) - picture.at(picture.width - overlap + x, y);
    }
    return smoothed(std::move(step), std::max(1, overlap / 8), closed);
}

/// Half the width of the blend, so that what still differs along the path adds no steeper slope than the
/// picture has itself: a smooth step of width w is at most 1.5 / w steep.
float feather_for(const Colors& picture, int overlap, std::span<const int> path,
                  std::span<const glm::vec3> step) {
    float most = 0.0f;  // that is left along the path
    std::vector<float> slopes;
    for (int y = 0; y < picture.height; ++y) {
        const auto row = std::size_t(y);
        const int x = path[row];
        most = std::max(
            most, glm::length(picture.at(x, y) - picture.at(picture.width - overlap + x, y) - step[row]));
        for (int i = 1; i < picture.width; i += 3)
            slopes.push_back(glm::length(picture.at(i, y) - picture.at(i - 1, y)));
    }
    const auto steep = slopes.begin() + std::ptrdiff_t(slopes.size() * 95 / 100);
    std::nth_element(slopes.begin(), steep, slopes.end());
    const float wanted = 0.75f * most / std::max(*steep, 1e-6f);
    return std::clamp(wanted, 1.0f, std::max(1.0f, 0.375f * float(overlap)));
}

/// The cheapest path through the middle quarter of the overlap: the rest is for blending.
std::vector<int> seam_of(const Colors& picture, int overlap, bool closed) {
    const int margin = 3 * overlap / 8, width = picture.width - overlap;
    Plane costs(overlap - 2 * margin, picture.height);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < costs.width; ++x)
            costs.at(x, y) = difference(picture.at(margin + x, y), picture.at(width + margin + x, y));
    std::vector<int> path = closed ? closed_path(costs) : cheapest_path(costs, -1, -1);
    for (int& x : path) x += margin;
    return path;
}

/// The picture narrower by overlap: its first columns are the last ones of the picture, which go over into
/// the first ones along a path. What both differ by at large is shared out over the whole overlap, detail
/// goes over within a few pixels.
Colors joined(const Colors& picture, int overlap, bool closed) {
    const int width = picture.width - overlap;
    const std::vector<int> path = seam_of(picture, overlap, closed);
    const std::vector<glm::vec3> step = step_along(picture, overlap, path, closed);
    const float feather = feather_for(picture, overlap, path, step);
    Colors result(width, picture.height);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = overlap; x < width; ++x) result.at(x, y) = picture.at(x, y);
        const float seam = float(path[std::size_t(y)]) + 0.5f;
        const glm::vec3 half = 0.5f * step[std::size_t(y)];
        for (int x = 0; x < std::min(overlap, width); ++x) {
            const float at = float(x) + 0.5f;
            const glm::vec3 left = picture.at(width + x, y) + half * std::min(at / seam, 1.0f);
            const glm::vec3 right =
                picture.at(x, y) - half * std::min((float(overlap) - at) / (float(overlap) - seam), 1.0f);
            const float t = glm::smoothstep(seam - feather, seam + feather, at);
            result.at(x, y) = glm::max(glm::mix(left, right, t), 0.0f);
        }
    }
    return result;
}

Colors transposed(const Colors& picture) {
    Colors result(picture.height, picture.width);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) result.at(y, x) = picture.at(x, y);
    return result;
}

/// The overlap of a picture whose side is tile + tile_overlap(tile).
int overlap_in(int side) {
    int tile = side * 4 / 5;
    while (tile + tile_overlap(tile) < side) ++tile;
    return side - tile;
}

}  // namespace

int tile_overlap(int tile_size) { return std::max(1, tile_size / 4); }

Colors tiled(const Colors& picture) {
    const Colors across = joined(picture, overlap_in(picture.width), false);
    return transposed(joined(transposed(across), overlap_in(picture.height), true));
}

}  // namespace patina

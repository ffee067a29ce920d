#include "renderer/core/mesh_adjacency.h"

#include <algorithm>

namespace patina {
namespace {

/// Half edges listed by their lower vertex, as offsets into one array.
struct Buckets {
    std::vector<std::uint32_t> begin;  ///< one more than vertices
    std::vector<std::uint32_t> half_edges;
};

Buckets by_lower_vertex(std::span<const std::uint32_t> vertex) {
    std::uint32_t vertices = 0;
    for (const std::uint32_t v : vertex) vertices = std::max(vertices, v + 1);
    const auto lower = [&](std::uint32_t h) { return std::min(vertex[h], vertex[next_corner(h)]); };
    Buckets buckets;
    buckets.begin.assign(std::size_t(vertices) + 1, 0);
    buckets.half_edges.resize(vertex.size());
    for (std::uint32_t h = 0; h < vertex.size(); ++h) ++buckets.begin[lower(h) + 1];
    for (std::size_t v = 0; v < vertices; ++v) buckets.begin[v + 1] += buckets.begin[v];
    std::vector<std::uint32_t> cursor(buckets.begin.begin(), buckets.begin.end() - 1);
    for (std::uint32_t h = 0; h < vertex.size(); ++h) buckets.half_edges[cursor[lower(h)]++] = h;
    return buckets;
}

/// All half edges of one edge: up and down runs are paired first with first.
void pair_up(std::span<const std::uint32_t> edge, std::span<const std::uint32_t> vertex,
             std::vector<std::uint32_t>& opposite) {
    const auto rising = [&](std::uint32_t h) { return vertex[h] < vertex[next_corner(h)]; };
    std::size_t down = 0;
    for (const std::uint32_t up : edge) {
        if (!rising(up)) continue;
        while (down < edge.size() && (rising(edge[down]) || edge[down] / 3 == up / 3)) ++down;
        if (down == edge.size()) return;
        opposite[up] = edge[down];
        opposite[edge[down]] = up;
        ++down;
    }
}

}  // namespace

std::vector<std::uint32_t> opposite_half_edges(std::span<const std::uint32_t> corner_vertex) {
    std::vector<std::uint32_t> opposite(corner_vertex.size(), kNoCorner);
    Buckets buckets = by_lower_vertex(corner_vertex);
    const auto upper = [&](std::uint32_t h) {
        return std::max(corner_vertex[h], corner_vertex[next_corner(h)]);
    };
    for (std::size_t v = 0; v + 1 < buckets.begin.size(); ++v) {
        const std::span bucket(buckets.half_edges.data() + buckets.begin[v],
                               buckets.begin[v + 1] - buckets.begin[v]);
        std::sort(bucket.begin(), bucket.end(), [&](std::uint32_t a, std::uint32_t b) {
            return upper(a) != upper(b) ? upper(a) < upper(b) : a < b;
        });
        for (std::size_t i = 0; i < bucket.size();) {
            std::size_t end = i + 1;
            while (end < bucket.size() && upper(bucket[end]) == upper(bucket[i])) ++end;
            if (upper(bucket[i]) != v) pair_up(bucket.subspan(i, end - i), corner_vertex, opposite);
            i = end;
        }
    }
    return opposite;
}

}  // namespace patina

// Tangents after Morten S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited" (2008), chapter 3 and
// appendix A, in the form that bakers and renderers have agreed on: what matters is that every program forms
// the same groups of corners and weighs them alike.
#include "renderer/core/mesh.h"
#include "renderer/core/mesh_adjacency.h"
#include "renderer/core/mesh_weld.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cfloat>
#include <cmath>
#include <optional>

namespace patina {
namespace {

constexpr std::uint32_t kNone = kNoCorner;

struct TriangleFrame {
    glm::vec3 tangent{0.0f};         ///< direction in which u grows, unit
    bool keeps_orientation = false;  ///< the uv triangle is counter-clockwise: not mirrored
    bool joins_any = true;           ///< uvs say nothing: takes part in any group
    bool degenerate = false;         ///< two corners coincide: takes part in none
};

/// The map from uv to the triangle's plane is linear; its column for u is
/// ∂P/∂u = (Δv₂ ΔP₁ − Δv₁ ΔP₂) / det, and only the sign of det = Δu₁Δv₂ − Δu₂Δv₁ survives normalising.
TriangleFrame frame_of(const std::array<Vertex, 3>& corner, bool degenerate) {
    TriangleFrame frame;
    frame.degenerate = degenerate;
    const glm::dvec3 p1(glm::dvec3(corner[1].position) - glm::dvec3(corner[0].position));
    const glm::dvec3 p2(glm::dvec3(corner[2].position) - glm::dvec3(corner[0].position));
    const glm::dvec2 t1(glm::dvec2(corner[1].uv) - glm::dvec2(corner[0].uv));
    const glm::dvec2 t2(glm::dvec2(corner[2].uv) - glm::dvec2(corner[0].uv));
    const double det = t1.x * t2.y - t1.y * t2.x;
    frame.keeps_orientation = det > 0.0;
    if (degenerate || !(std::abs(det) > double(FLT_MIN))) return frame;
    const double sign = frame.keeps_orientation ? 1.0 : -1.0;
    const glm::dvec3 along_u = sign * (t2.y * p1 - t1.y * p2);
    const glm::dvec3 along_v = sign * (t1.x * p2 - t2.x * p1);
    const double length_u = glm::length(along_u);
    if (!(length_u > 0.0) || !(glm::length(along_v) > 0.0)) return frame;
    frame.tangent = glm::vec3(along_u / length_u);
    frame.joins_any = false;
    return frame;
}

/// Everything the passes below share; corners are numbered 3·triangle + 0…2.
struct Work {
    const Mesh& mesh;
    std::vector<std::uint32_t> corner_vertex;  ///< numbers of distinct (position, normal, uv)
    std::vector<std::uint32_t> opposite;
    std::vector<TriangleFrame> frames;
    std::vector<std::uint32_t> group_of;     ///< per corner
    std::vector<std::uint32_t> grouped;      ///< corners, group after group
    std::vector<std::uint32_t> group_begin;  ///< into grouped
    std::vector<glm::vec4> group_tangent;

    explicit Work(const Mesh& m) : mesh(m) {}
    const Vertex& vertex(std::uint32_t corner) const { return mesh.vertices[mesh.indices[corner]]; }
};

void weld_corners(Work& work) {
    static_assert(sizeof(Vertex) == 12 * sizeof(float), "position, normal and uv are the first eight floats");
    const auto& vertices = work.mesh.vertices;
    const std::vector<std::uint32_t> id = weld({.data = vertices.empty() ? nullptr : &vertices[0].position.x,
                                                .count = vertices.size(),
                                                .stride = sizeof(Vertex) / sizeof(float),
                                                .width = 8});
    work.corner_vertex.resize(work.mesh.indices.size());
    for (std::size_t c = 0; c < work.mesh.indices.size(); ++c)
        work.corner_vertex[c] = id[work.mesh.indices[c]];
}

void make_frames(Work& work) {
    const std::size_t triangles = work.mesh.indices.size() / 3;
    work.frames.reserve(triangles);
    for (std::uint32_t t = 0; t < triangles; ++t) {
        const std::uint32_t c = 3 * t;
        const glm::vec3 a = work.vertex(c).position;
        const glm::vec3 b = work.vertex(c + 1).position;
        const glm::vec3 d = work.vertex(c + 2).position;
        work.frames.push_back(
            frame_of({work.vertex(c), work.vertex(c + 1), work.vertex(c + 2)}, a == b || b == d || d == a));
    }
    work.opposite = opposite_half_edges(work.corner_vertex);
    for (std::uint32_t h = 0; h < work.opposite.size(); ++h) {
        const std::uint32_t other = work.opposite[h];
        if (other == kNone || (!work.frames[h / 3].degenerate && !work.frames[other / 3].degenerate))
            continue;
        work.opposite[h] = kNone;
        work.opposite[other] = kNone;
    }
}

/// Decides whether the triangle of a corner may join a group of that orientation; a triangle without a
/// direction of its own takes over the orientation of the first group it meets.
bool may_join(Work& work, std::uint32_t corner, bool keeps_orientation) {
    TriangleFrame& frame = work.frames[corner / 3];
    const std::uint32_t first = corner - corner % 3;
    const bool untouched = work.group_of[first] == kNone && work.group_of[first + 1] == kNone &&
                           work.group_of[first + 2] == kNone;
    if (frame.joins_any && untouched) frame.keeps_orientation = keeps_orientation;
    return frame.keeps_orientation == keeps_orientation;
}

/// From every corner that is in no group yet, walk around its vertex both ways over shared edges while the uv
/// orientation stays the same. The walk keeps its own stack: a fan may have any number of triangles.
void make_groups(Work& work) {
    const auto corners = std::uint32_t(work.corner_vertex.size());
    work.group_of.assign(corners, kNone);
    work.grouped.reserve(corners);
    std::vector<std::uint32_t> stack;
    for (std::uint32_t seed = 0; seed < corners; ++seed) {
        const TriangleFrame& start = work.frames[seed / 3];
        if (start.joins_any || start.degenerate || work.group_of[seed] != kNone) continue;
        const auto group = std::uint32_t(work.group_begin.size());
        const bool keeps_orientation = start.keeps_orientation;
        work.group_begin.push_back(std::uint32_t(work.grouped.size()));
        stack.assign(1, seed);
        while (!stack.empty()) {
            const std::uint32_t corner = stack.back();
            stack.pop_back();
            if (work.group_of[corner] != kNone || !may_join(work, corner, keeps_orientation)) continue;
            work.group_of[corner] = group;
            work.grouped.push_back(corner);
            const std::uint32_t before = work.opposite[previous_corner(corner)];  // its start is this vertex
            const std::uint32_t after = work.opposite[corner];                    // its end is this vertex
            if (before != kNone) stack.push_back(before);
            if (after != kNone) stack.push_back(next_corner(after));
        }
    }
    work.group_begin.push_back(std::uint32_t(work.grouped.size()));
}

/// v without its part along the unit vector n, as a unit vector where anything is left.
glm::dvec3 projected(const glm::dvec3& v, const glm::dvec3& n) {
    const glm::dvec3 flat = v - n * glm::dot(n, v);
    const double length = glm::length(flat);
    return length > double(FLT_MIN) ? flat / length : flat;
}

/// The angle at the corner, measured in the plane of its normal.
double corner_angle(const Work& work, std::uint32_t corner, const glm::dvec3& n) {
    const glm::dvec3 here(work.vertex(corner).position);
    const glm::dvec3 to_next = projected(glm::dvec3(work.vertex(next_corner(corner)).position) - here, n);
    const glm::dvec3 to_previous =
        projected(glm::dvec3(work.vertex(previous_corner(corner)).position) - here, n);
    return std::acos(glm::clamp(glm::dot(to_next, to_previous), -1.0, 1.0));
}

/// Some frame around n: the axis least along n, projected (Mikkelsen leaves this case open).
glm::vec4 any_tangent(const glm::dvec3& n) {
    const glm::dvec3 a = glm::abs(n);
    const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                            : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                     : glm::dvec3(0, 0, 1);
    return {glm::vec3(projected(axis, n)), 1.0f};
}

/// The sum over a group of the triangles' directions, each laid into the plane of the normal and weighed by
/// its angle.
glm::vec4 tangent_of_group(const Work& work, std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t first = work.grouped[begin];
    const glm::dvec3 n(work.vertex(first).normal);
    glm::dvec3 sum(0.0);
    for (std::uint32_t k = begin; k < end; ++k) {
        const std::uint32_t corner = work.grouped[k];
        const TriangleFrame& frame = work.frames[corner / 3];
        if (frame.joins_any) continue;
        sum += projected(glm::dvec3(frame.tangent), n) * corner_angle(work, corner, n);
    }
    const float w = work.frames[first / 3].keeps_orientation ? 1.0f : -1.0f;
    sum = projected(sum, n);
    if (!(glm::length(sum) > 0.5)) return glm::vec4(glm::vec3(any_tangent(n)), w);
    return {glm::vec3(sum), w};
}

/// A vertex that only degenerate triangles use takes the tangent of a group at the same place, if there is
/// one.
void adopt_tangents(const Work& work, const std::vector<std::uint32_t>& served, Mesh& mesh) {
    std::vector<std::uint32_t> group_at(mesh.vertices.size(), kNone);
    for (std::size_t c = 0; c < work.group_of.size(); ++c)
        if (work.group_of[c] != kNone) group_at[work.corner_vertex[c]] = work.group_of[c];
    for (std::size_t c = 0; c < work.group_of.size(); ++c) {
        const std::uint32_t vertex = mesh.indices[c];
        const std::uint32_t group = group_at[work.corner_vertex[c]];
        if (vertex < served.size() && served[vertex] == kNone && group != kNone)
            mesh.vertices[vertex].tangent = work.group_tangent[group];
    }
}

/// Gives every corner of a group one vertex; a vertex that serves several groups is copied.
void write_groups(const Work& work, Mesh& mesh) {
    const std::size_t vertices_before = mesh.vertices.size();
    std::vector<std::uint32_t> slot(vertices_before, kNone);    // where the vertex lives for the group below
    std::vector<std::uint32_t> served(vertices_before, kNone);  // the last group that used it
    for (std::uint32_t g = 0; g + 1 < work.group_begin.size(); ++g) {
        const glm::vec4 tangent = work.group_tangent[g];
        for (std::uint32_t k = work.group_begin[g]; k < work.group_begin[g + 1]; ++k) {
            std::uint32_t& index = mesh.indices[work.grouped[k]];
            const std::uint32_t vertex = index;
            if (served[vertex] == kNone) {
                slot[vertex] = vertex;
                mesh.vertices[vertex].tangent = tangent;
            } else if (served[vertex] != g && mesh.vertices[slot[vertex]].tangent != tangent) {
                slot[vertex] = std::uint32_t(mesh.vertices.size());
                mesh.vertices.push_back(mesh.vertices[vertex]);
                mesh.vertices.back().tangent = tangent;
            }
            served[vertex] = g;
            index = slot[vertex];
        }
    }
    adopt_tangents(work, served, mesh);
}

}  // namespace

void make_tangents(Mesh& mesh) {
    for (Vertex& vertex : mesh.vertices) vertex.tangent = any_tangent(glm::dvec3(vertex.normal));
    const Mesh& input = mesh;
    Work work(input);
    weld_corners(work);
    make_frames(work);
    make_groups(work);
    for (std::size_t g = 0; g + 1 < work.group_begin.size(); ++g)
        work.group_tangent.push_back(tangent_of_group(work, work.group_begin[g], work.group_begin[g + 1]));
    write_groups(work, mesh);
    mesh.has_tangents = true;
}

}  // namespace patina

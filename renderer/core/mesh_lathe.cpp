#include "renderer/core/mesh_lathe.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace patina {
namespace {

Vertex revolve(const ProfilePoint& point, double u_direction, double u_texture) {
    const glm::dvec2 d = lathe_direction(u_direction);
    Vertex vertex;
    vertex.position = glm::vec3(glm::dvec3(d.x * point.position.x, point.position.y, d.y * point.position.x));
    vertex.normal = glm::vec3(glm::dvec3(d.x * point.normal.x, point.normal.y, d.y * point.normal.x));
    vertex.uv = glm::vec2(glm::dvec2(u_texture, point.v));
    return vertex;
}

double u_at(const LatheRange& range, double column) {
    return range.u_begin + (range.u_end - range.u_begin) * column / range.segments;
}

double texture_u(const LatheRange& range, double column) {
    return 0.5 + (u_at(range, column) - 0.5) * range.repeats;
}

}  // namespace

glm::dvec2 lathe_direction(double u) {
    const double turn = u - std::floor(u);  // both ends of the seam get the very same position
    const double quarter = std::floor(turn * 4.0);
    const double angle = (turn - quarter / 4.0) * 2.0 * std::numbers::pi;
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    switch (int(quarter)) {
        case 0:
            return {-s, -c};
        case 1:
            return {-c, s};
        case 2:
            return {s, c};
        default:
            return {c, -s};
    }
}

void append_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
}

void append_lathe(Mesh& mesh, std::span<const ProfilePoint> profile, const LatheRange& range) {
    const auto columns = std::uint32_t(range.segments);
    std::vector<std::uint32_t> ring_begin;
    for (const ProfilePoint& point : profile) {
        ring_begin.push_back(std::uint32_t(mesh.vertices.size()));
        const bool pole = point.position.x == 0.0;
        for (std::uint32_t i = 0; i < columns + (pole ? 0 : 1); ++i)
            mesh.vertices.push_back(
                revolve(point, u_at(range, i), texture_u(range, pole ? i + 0.5 : double(i))));
    }
    for (std::size_t j = 0; j + 1 < profile.size(); ++j) {
        if (profile[j].position == profile[j + 1].position) continue;
        const std::uint32_t low = ring_begin[j];
        const std::uint32_t high = ring_begin[j + 1];
        for (std::uint32_t i = 0; i < columns; ++i) {
            if (profile[j].position.x == 0.0)
                mesh.indices.insert(mesh.indices.end(), {low + i, high + i + 1, high + i});
            else if (profile[j + 1].position.x == 0.0)
                mesh.indices.insert(mesh.indices.end(), {low + i, low + i + 1, high + i});
            else
                append_quad(mesh, low + i, low + i + 1, high + i + 1, high + i);
        }
    }
}

}  // namespace patina

#include "renderer/core/mesh.h"
#include "renderer/core/mesh_box.h"
#include "renderer/core/mesh_lathe.h"
#include "renderer/core/mesh_shaderball.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

Mesh named_mesh(const char* name) {
    Mesh mesh;
    mesh.name = name;
    return mesh;
}

/// 192 × 96: the silhouette stays within a tenth of a pixel of the circle up to 1500 pixels.
Mesh make_sphere() {
    constexpr int stacks = 96;
    std::vector<ProfilePoint> profile;
    for (int j = 0; j <= stacks; ++j) {
        const double v = double(j) / stacks;
        const double latitude = (v - 0.5) * kPi;
        const bool pole = j == 0 || j == stacks;
        const glm::dvec2 p(pole ? 0.0 : std::cos(latitude), std::sin(latitude));
        profile.push_back({p, p, v});
    }
    Mesh mesh = named_mesh("sphere");
    append_lathe(mesh, profile);
    return mesh;
}

Mesh make_quad() {
    Mesh mesh = named_mesh("quad");
    for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
        mesh.vertices.push_back({.position = glm::vec3(uv * 2.0f - 1.0f, 0.0f), .uv = uv});
    append_quad(mesh, 0, 1, 2, 3);
    return mesh;
}

/// A place along one axis of a cube face, from edge middle to edge middle.
struct BevelStation {
    double core;     ///< on the inner cube
    double tangent;  ///< of the angle by which the normal leans over, −1…1
    double uv;       ///< proportional to arc length
};

/// A cube of half side h whose edges are rounded with radius r: an inner cube of half side h − r, grown by r.
/// Each face owns its bevels up to their middle (45°), with uvs proportional to length, so a picture covers
/// all of it.
Mesh make_cube() {
    constexpr double roundness = 0.16;  // r / h
    constexpr int arc_steps = 8;
    constexpr int flat_steps = 8;
    const double h =
        1.0 / (std::numbers::sqrt3 * (1.0 - roundness) + roundness);  // corners touch the unit sphere
    const double r = roundness * h;
    const double core = h - r;
    const double half_length = core + r * kPi / 4.0;

    std::vector<BevelStation> stations;
    const auto add = [&](double s, double tangent, double length) {
        stations.push_back({s, tangent, 0.5 + 0.5 * length / half_length});
    };
    const auto lean = [](int k) { return k == arc_steps ? 1.0 : std::tan(kPi / 4.0 * k / arc_steps); };
    for (int k = arc_steps; k > 0; --k) add(-core, -lean(k), -core - r * kPi / 4.0 * k / arc_steps);
    for (int k = 0; k <= flat_steps; ++k)
        add(core * (2.0 * k / flat_steps - 1.0), 0.0, core * (2.0 * k / flat_steps - 1.0));
    for (int k = 1; k <= arc_steps; ++k) add(core, lean(k), core + r * kPi / 4.0 * k / arc_steps);

    Mesh mesh = named_mesh("cube");
    const auto side = std::uint32_t(stations.size());
    for (const BoxSide& face : kBoxSides) {
        const auto first = std::uint32_t(mesh.vertices.size());
        for (const BevelStation& y : stations)
            for (const BevelStation& x : stations) {
                const glm::dvec3 normal =
                    glm::normalize(x.tangent * face.right + y.tangent * face.up + face.out);
                const glm::dvec3 position =
                    x.core * face.right + y.core * face.up + core * face.out + r * normal;
                mesh.vertices.push_back({.position = glm::vec3(position),
                                         .normal = glm::vec3(normal),
                                         .uv = glm::vec2(glm::dvec2(x.uv, y.uv))});
            }
        for (std::uint32_t j = 0; j + 1 < side; ++j)
            for (std::uint32_t i = 0; i + 1 < side; ++i) {
                const std::uint32_t a = first + j * side + i;
                append_quad(mesh, a, a + 1, a + side + 1, a + side);
            }
    }
    return mesh;
}

/// Leans towards the viewer so that the default camera sees the hole; v = ½ runs along the outer equator.
Mesh make_torus() {
    constexpr double tube = 0.3;
    constexpr int around = 96;
    constexpr double lean_angle = 50.0 / 180.0 * kPi;
    std::vector<ProfilePoint> profile;
    for (int j = 0; j <= around; ++j) {
        const glm::dvec2 d = lathe_direction(double(j % around) / around);
        const glm::dvec2 normal(d.y, d.x);  // angle 2πv − π around the tube
        profile.push_back({glm::dvec2(1.0 - tube, 0.0) + tube * normal, normal, double(j) / around});
    }
    Mesh mesh = named_mesh("torus");
    append_lathe(mesh, profile);
    const glm::dmat3 lean(1, 0, 0, 0, std::cos(lean_angle), std::sin(lean_angle), 0, -std::sin(lean_angle),
                          std::cos(lean_angle));
    for (Vertex& vertex : mesh.vertices) {
        vertex.position = glm::vec3(lean * glm::dvec3(vertex.position));
        vertex.normal = glm::vec3(lean * glm::dvec3(vertex.normal));
    }
    return mesh;
}

constexpr std::array kBuiltinMeshes{
    BuiltinMesh{"sphere", "Sphere", "Every direction once: reflections and roughness read best here.",
                make_sphere},
    BuiltinMesh{"quad", "Quad", "A flat square: shows a texture as it is, and tiling.", make_quad},
    BuiltinMesh{"cube", "Cube", "A bevelled cube: flat faces with highlights along the rounded edges.",
                make_cube},
    BuiltinMesh{"torus", "Torus", "Curved both ways: shows stretching and anisotropy of textures.",
                make_torus},
    BuiltinMesh{"shaderball", "Shader ball",
                "Hollows, edges, a groove and a pearl in a bowl: a material at all scales at once.",
                make_shaderball},
};

}  // namespace

std::span<const BuiltinMesh> builtin_meshes() { return kBuiltinMeshes; }

}  // namespace patina

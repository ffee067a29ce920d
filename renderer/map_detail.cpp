#include "renderer/map_detail.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace patina {

namespace {

constexpr double kSurfaceShare = 0.9;
constexpr float kLargestStretch = 16.0f;  ///< beyond, a patch is painted with about one texel
constexpr float kNearest = 0.05f;         ///< of the surface to the camera, in radii of the mesh
constexpr int kSmallestSide = 16, kLargestSide = 1 << 14;

struct Patch {
    float stretch = 0.0f;
    float area = 0.0f;
};

/// With J = (∂P/∂u, ∂P/∂v): the larger singular value, from the eigenvalues of JᵀJ = (E, F; F, G).
Patch patch_of(const Vertex& a, const Vertex& b, const Vertex& c) {
    const glm::vec3 p = b.position - a.position, q = c.position - a.position;
    const glm::vec2 s = b.uv - a.uv, t = c.uv - a.uv;
    const float area = 0.5f * glm::length(glm::cross(p, q));
    const float determinant = s.x * t.y - s.y * t.x;
    if (std::abs(determinant) < 1e-12f) return {};
    const glm::vec3 along_u = (t.y * p - s.y * q) / determinant;
    const glm::vec3 along_v = (s.x * q - t.x * p) / determinant;
    const float E = glm::dot(along_u, along_u), F = glm::dot(along_u, along_v),
                G = glm::dot(along_v, along_v);
    const float half = 0.5f * (E - G);
    const float stretch = std::sqrt(0.5f * (E + G) + std::sqrt(half * half + F * F));
    if (!(stretch <= kLargestStretch)) return {};
    return {stretch, area};
}

}  // namespace

float uv_stretch(const Mesh& mesh) {
    if (!mesh.has_uvs) return 0.0f;
    std::vector<Patch> patches;
    patches.reserve(mesh.indices.size() / 3);
    double whole = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const Patch patch = patch_of(mesh.vertices[mesh.indices[i]], mesh.vertices[mesh.indices[i + 1]],
                                     mesh.vertices[mesh.indices[i + 2]]);
        if (!(patch.area > 0.0f)) continue;
        patches.push_back(patch);
        whole += patch.area;
    }
    std::sort(patches.begin(), patches.end(),
              [](const Patch& a, const Patch& b) { return a.stretch < b.stretch; });
    double below = 0.0;
    for (const Patch& patch : patches)
        if ((below += patch.area) >= kSurfaceShare * whole) return patch.stretch;
    return 0.0f;
}

float nearest_pixel(const Sight& sight) {
    const float distance = std::max(glm::length(camera_position(sight.camera)) - 1.0f, kNearest);
    return 2.0f * std::tan(glm::radians(0.5f * sight.camera.fov_deg)) * distance / float(sight.height_px);
}

int visible_map_side(float stretch, glm::vec2 map_scale, const Sight& sight) {
    if (sight.height_px <= 0) return 0;
    const float repeats = std::max(std::min(std::abs(map_scale.x), std::abs(map_scale.y)), 1e-3f);
    const float texels = stretch / (nearest_pixel(sight) * repeats);
    if (texels >= float(kLargestSide)) return 0;
    return int(std::bit_ceil(unsigned(std::max(std::ceil(texels), float(kSmallestSide)))));
}

}  // namespace patina

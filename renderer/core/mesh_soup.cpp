#include "renderer/core/mesh_soup.h"

#include "renderer/core/finite.h"
#include "renderer/core/mesh_normals.h"
#include "renderer/core/mesh_triangulate.h"
#include "renderer/core/mesh_weld.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace patina {
namespace {

constexpr std::size_t kMaxTriangles = 300'000'000;  // corners are numbered with 32 bits

/// "3 faces", "1 face".
std::string counted(std::size_t n, const char* one, const char* many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// The soup cut into triangles; a corner is its number in the soup.
struct Triangles {
    std::vector<std::uint32_t> place_of_position;  ///< equal positions have equal places
    std::vector<glm::vec3> places;
    std::vector<std::uint32_t> corner;        ///< three a triangle, into the soup
    std::vector<std::uint32_t> corner_place;  ///< three a triangle
    std::size_t unlocatable = 0, degenerate = 0, duplicate = 0;
};

void find_places(const PolygonSoup& soup, Triangles& triangles) {
    triangles.place_of_position = weld({.data = soup.positions.empty() ? nullptr : &soup.positions[0].x,
                                        .count = soup.positions.size(),
                                        .stride = 3,
                                        .width = 3});
    for (std::size_t i = 0; i < soup.positions.size(); ++i)
        if (triangles.place_of_position[i] == triangles.places.size())
            triangles.places.push_back(soup.positions[i]);
}

/// The face's corners without those that repeat the place before; false if one cannot be located.
bool collect_corners(const PolygonSoup& soup, const Triangles& triangles, std::size_t face,
                     std::vector<std::uint32_t>& corners) {
    const auto place = [&](std::uint32_t c) { return triangles.place_of_position[soup.corner_position[c]]; };
    corners.clear();
    for (std::uint32_t c = soup.face_begin[face]; c < soup.face_begin[face + 1]; ++c) {
        const std::uint32_t position = soup.corner_position[c];
        if (position >= soup.positions.size() || !is_finite(soup.positions[position])) return false;
        if (corners.empty() || place(c) != place(corners.back())) corners.push_back(c);
    }
    while (corners.size() > 1 && place(corners.front()) == place(corners.back())) corners.pop_back();
    if (corners.size() > 3) {  // where a polygon begins must not decide how it is cut
        const auto by_place = [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); };
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), by_place),
                    corners.end());
    }
    return true;
}

/// Less than a trillionth of the square over its longest side: no pixel will ever see it, and it has no
/// normal.
bool has_area(const std::array<glm::dvec3, 3>& p) {
    const glm::dvec3 a = p[1] - p[0];
    const glm::dvec3 b = p[2] - p[0];
    const glm::dvec3 c = p[2] - p[1];
    const double longest2 = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
    return glm::length(glm::cross(a, b)) > 1e-12 * longest2;
}

void cut_faces(const PolygonSoup& soup, Triangles& triangles) {
    std::vector<std::uint32_t> corners;
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 3>> cut;
    for (std::size_t face = 0; face + 1 < soup.face_begin.size(); ++face) {
        if (!collect_corners(soup, triangles, face, corners)) {
            ++triangles.unlocatable;
            continue;
        }
        points.clear();
        for (const std::uint32_t c : corners) points.emplace_back(soup.positions[soup.corner_position[c]]);
        cut.clear();
        triangulate(points, cut);
        const std::size_t before = triangles.corner.size();
        for (const auto& t : cut) {
            if (!has_area({points[t[0]], points[t[1]], points[t[2]]})) continue;
            for (const std::uint32_t k : t) triangles.corner.push_back(corners[k]);
        }
        if (triangles.corner.size() == before) ++triangles.degenerate;
        if (triangles.corner.size() > 3 * kMaxTriangles)
            throw std::runtime_error("more than 300 million triangles are not supported.");
    }
    triangles.corner_place.reserve(triangles.corner.size());
    for (const std::uint32_t c : triangles.corner)
        triangles.corner_place.push_back(triangles.place_of_position[soup.corner_position[c]]);
}

/// Two triangles with the same places in the same turning sense are one; back to back they are two sides of a
/// sheet.
void drop_duplicates(Triangles& triangles) {
    const auto turned = [&](std::size_t t) {
        std::array<std::uint32_t, 3> p{};
        std::copy_n(triangles.corner_place.begin() + std::ptrdiff_t(3 * t), 3, p.begin());
        std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
        return p;
    };
    const auto hash = [&](std::size_t t) {
        std::uint64_t h = kHashSeed;
        for (const std::uint32_t place : turned(t)) h = hash_word(h, place);
        return h;
    };
    const std::size_t count = triangles.corner.size() / 3;
    const std::vector<std::uint32_t> number =
        weld_by(count, hash, [&](std::size_t a, std::size_t b) { return turned(a) == turned(b); });
    std::size_t kept = 0;
    for (std::size_t t = 0; t < count; ++t) {
        if (number[t] != kept) continue;  // numbers are given in order of first appearance
        for (std::size_t k = 0; k < 3; ++k) {
            triangles.corner[3 * kept + k] = triangles.corner[3 * t + k];
            triangles.corner_place[3 * kept + k] = triangles.corner_place[3 * t + k];
        }
        ++kept;
    }
    triangles.duplicate = count - kept;
    triangles.corner.resize(3 * kept);
    triangles.corner_place.resize(3 * kept);
}

std::vector<glm::vec3> find_normals(const PolygonSoup& soup, const Triangles& triangles, Mesh& mesh) {
    std::vector<glm::vec3> normals(triangles.corner.size(), glm::vec3(0.0f));
    std::size_t missing = 0;
    for (std::size_t k = 0; k < normals.size(); ++k) {
        const glm::dvec3 n = soup.corner_normal.empty() ? glm::dvec3(0.0)
                                                        : glm::dvec3(soup.corner_normal[triangles.corner[k]]);
        const double length = glm::length(n);
        if (length > 0.0 && std::isfinite(length))
            normals[k] = glm::vec3(n / length);
        else
            ++missing;
    }
    if (missing == 0) return normals;
    const std::vector<glm::vec3> smooth =
        smooth_normals({triangles.corner_place, triangles.places}, kCreaseDegrees);
    for (std::size_t k = 0; k < normals.size(); ++k)
        if (normals[k] == glm::vec3(0.0f)) normals[k] = smooth[k];
    const std::string how = "from the faces, with creases above 60°.";
    mesh.notes.push_back(missing == normals.size() ? "Normals were computed " + how
                                                   : counted(missing, "missing or zero normal was computed ",
                                                             "missing or zero normals were computed ") +
                                                         how);
    return normals;
}

std::vector<glm::vec2> find_uvs(const PolygonSoup& soup, const Triangles& triangles, Mesh& mesh) {
    std::vector<glm::vec2> uvs(triangles.corner.size(), glm::vec2(0.0f));
    std::size_t missing = uvs.size();
    bool all_equal = true;
    if (!soup.corner_uv.empty()) {
        missing = 0;
        for (std::size_t k = 0; k < uvs.size(); ++k) {
            const glm::vec2 uv = soup.corner_uv[triangles.corner[k]];
            if (is_finite(uv))
                uvs[k] = uv;
            else
                ++missing;
            all_equal = all_equal && uvs[k] == uvs[0];
        }
    }
    if (missing < uvs.size() && !all_equal) {
        if (missing > 0)
            mesh.notes.push_back(counted(missing, "missing texture coordinate was set to 0.",
                                         "missing texture coordinates were set to 0."));
        return uvs;
    }
    mesh.has_uvs = false;
    mesh.notes.emplace_back(
        missing == uvs.size()
            ? "The file has no texture coordinates; they were projected from six sides."
            : "All texture coordinates of the file are the same; they were projected from six sides.");
    return box_uvs({triangles.corner_place, triangles.places});
}

/// Corners that agree in everything share a vertex.
void index_corners(const Triangles& triangles, const std::vector<glm::vec3>& normals,
                   const std::vector<glm::vec2>& uvs, Mesh& mesh) {
    const auto& place = triangles.corner_place;
    const auto hash = [&](std::size_t k) {
        std::uint64_t h = hash_word(kHashSeed, place[k]);
        for (int i = 0; i < 3; ++i) h = hash_word(h, float_word(normals[k][i]));
        return hash_word(hash_word(h, float_word(uvs[k].x)), float_word(uvs[k].y));
    };
    const auto same = [&](std::size_t a, std::size_t b) {
        return place[a] == place[b] && normals[a] == normals[b] && uvs[a] == uvs[b];
    };
    mesh.indices = weld_by(place.size(), hash, same);
    for (std::size_t k = 0; k < place.size(); ++k)
        if (mesh.indices[k] == mesh.vertices.size())
            mesh.vertices.push_back(
                {.position = triangles.places[place[k]], .normal = normals[k], .uv = uvs[k]});
}

void note_losses(const Triangles& triangles, Mesh& mesh) {
    const auto note = [&](std::size_t n, const char* one, const char* many) {
        if (n > 0) mesh.notes.push_back(counted(n, one, many));
    };
    note(triangles.unlocatable, "face was dropped: a corner points nowhere or is not finite.",
         "faces were dropped: a corner points nowhere or is not finite.");
    note(triangles.degenerate, "face without an area was dropped.", "faces without an area were dropped.");
    note(triangles.duplicate, "duplicate triangle was dropped.", "duplicate triangles were dropped.");
}

}  // namespace

Mesh make_mesh(const PolygonSoup& soup) {
    Triangles triangles;
    triangles.degenerate = soup.faces_without_area;
    find_places(soup, triangles);
    cut_faces(soup, triangles);
    drop_duplicates(triangles);
    Mesh mesh;
    note_losses(triangles, mesh);
    if (triangles.corner.empty()) {
        std::string why = soup.face_begin.size() == 1 && soup.faces_without_area == 0
                              ? "it has no faces."
                              : "it has no face with an area.";
        if (triangles.unlocatable > 0) why += " " + mesh.notes.front();
        throw std::runtime_error(why);
    }
    const std::vector<glm::vec3> normals = find_normals(soup, triangles, mesh);
    const std::vector<glm::vec2> uvs = find_uvs(soup, triangles, mesh);
    index_corners(triangles, normals, uvs, mesh);
    normalize_to_unit_sphere(mesh);
    return mesh;
}

}  // namespace patina

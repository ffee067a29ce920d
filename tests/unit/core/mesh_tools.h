// What the mesh tests share: files in a folder of their own, and measuring meshes.
#pragma once

#include "renderer/core/mesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace patina::test {

/// A fresh folder, removed with everything in it.
class MeshFolder {
public:
    MeshFolder() {
        static std::atomic<int> count{0};
        path_ = std::filesystem::temp_directory_path() /
                ("patina-mesh-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~MeshFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    MeshFolder(const MeshFolder&) = delete;
    MeshFolder& operator=(const MeshFolder&) = delete;

    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        const std::filesystem::path file = path_ / name;
        std::ofstream(file, std::ios::binary) << bytes;
        return file;
    }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

template <class T>
void append(std::string& bytes, T value, bool big_endian = false) {
    char raw[sizeof(T)];
    std::copy_n(reinterpret_cast<const char*>(&value), sizeof(T), raw);
    if (big_endian) std::reverse(std::begin(raw), std::end(raw));
    bytes.append(raw, sizeof(T));
}

struct Corners {
    Vertex a, b, c;
};
inline std::vector<Corners> triangles(const Mesh& mesh) {
    std::vector<Corners> list;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        list.push_back({mesh.vertices[mesh.indices[i]], mesh.vertices[mesh.indices[i + 1]],
                        mesh.vertices[mesh.indices[i + 2]]});
    return list;
}
inline glm::dvec3 area_vector(const Corners& t) {
    const glm::dvec3 a(t.a.position);
    return 0.5 * glm::cross(glm::dvec3(t.b.position) - a, glm::dvec3(t.c.position) - a);
}
inline double area(const Mesh& mesh) {
    double sum = 0.0;
    for (const Corners& t : triangles(mesh)) sum += glm::length(area_vector(t));
    return sum;
}
inline double volume(const Mesh& mesh) {
    double sum = 0.0;
    for (const Corners& t : triangles(mesh)) sum += glm::dot(area_vector(t), glm::dvec3(t.a.position)) / 3.0;
    return sum;
}
/// Twice the signed area in the picture; positive is not mirrored.
inline double uv_area(const Corners& t) {
    const glm::dvec2 p(glm::dvec2(t.b.uv) - glm::dvec2(t.a.uv));
    const glm::dvec2 q(glm::dvec2(t.c.uv) - glm::dvec2(t.a.uv));
    return p.x * q.y - p.y * q.x;
}

/// Whether any note says so.
inline bool says(const std::vector<std::string>& notes, std::string_view what) {
    for (const std::string& note : notes)
        if (note.find(what) != std::string::npos) return true;
    return false;
}

}  // namespace patina::test

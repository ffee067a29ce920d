// What loaded things take on the GPU, for bounding the memory behind reconcile. Pure.
#pragma once

#include "app/reconcile_load.h"
#include "renderer/core/image.h"
#include "renderer/core/mesh.h"
#include "renderer/map_levels.h"

#include <cstdint>

namespace patina {

inline std::uint64_t bytes_of(const Image& image) { return image.bytes.size(); }
inline std::uint64_t bytes_of(const MapLevels& map) {
    std::uint64_t bytes = 0;
    for (const Image& level : map.levels) bytes += bytes_of(level);
    return bytes;
}
inline std::uint64_t bytes_of(const Mesh& mesh) {
    return mesh.vertices.size() * sizeof(Vertex) + mesh.indices.size() * sizeof(std::uint32_t);
}
inline std::uint64_t bytes_of(const PreparedLight& light) {
    std::uint64_t halves = light.levels.irradiance.rgba.size();
    for (const PanoramaLevels::Level& level : light.panorama.levels) halves += level.rgba.size();
    for (const LightLevels::Cube& cube : light.levels.levels) halves += cube.rgba.size();
    return halves * sizeof(std::uint16_t);
}

}  // namespace patina

// A square, repeating piece of surface as plain numbers, and the map pictures made of it: colour, packed
// scalars, and normals and ambient occlusion of one height field, so that all maps of a material line up.
// Knows no file.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace patina::maps {

/// One place of the surface; colours are scene-linear.
struct SurfacePoint {
    glm::vec3 albedo{1.0f};
    glm::vec3 emission{0.0f};
    float height = 0.0f;  ///< in widths of the tile
    float roughness = 0.5f;
    float metallic = 0.0f;
};

struct Surface {
    int size = 0;  ///< size × size points, row 0 at the top; a power of two
    std::vector<SurfacePoint> points;
    const SurfacePoint& at(int x, int y) const;  ///< repeats beyond its edges
};

/// place(uv) for every texel centre; uv runs 0…1 to the right and down.
template <class Place>
Surface make_surface(int size, Place&& place) {
    Surface surface{
        size, std::vector<SurfacePoint>(static_cast<std::size_t>(size) * static_cast<std::size_t>(size))};
    const float step = 1.0f / static_cast<float>(size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            surface.points[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                           static_cast<std::size_t>(x)] =
                place(
                    glm::vec2((static_cast<float>(x) + 0.5f) * step, (static_cast<float>(y) + 0.5f) * step));
    return surface;
}

/// A picture for save_image: values 0…255 (8 bits) or 0…65535 (16 bits), interleaved, row 0 at the top.
struct MapPicture {
    std::string file;  ///< its name, without folder
    int size = 0;
    int channels = 0;
    int bits = 8;
    std::vector<std::uint16_t> values;
};

MapPicture albedo_map(std::string file, const Surface& surface);    ///< sRGB-encoded
MapPicture emission_map(std::string file, const Surface& surface);  ///< sRGB-encoded
MapPicture roughness_map(std::string file, const Surface& surface);
MapPicture glossiness_map(std::string file, const Surface& surface);  ///< 1 − roughness
MapPicture ao_map(std::string file, const Surface& surface);
/// Red: ambient occlusion, green: roughness, blue: metallic.
MapPicture orm_map(std::string file, const Surface& surface);

enum class GreenPoints { Up, Down };
MapPicture normal_map(std::string file, const Surface& surface, GreenPoints green, int bits);

/// Per point 0…1: the share of the sky, weighted by its cosine, that the height field leaves open.
std::vector<float> ambient_occlusion(const Surface& surface);

}  // namespace patina::maps

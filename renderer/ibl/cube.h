// Geometry of cube maps: directions, points of faces, texels. Faces are +X −X +Y −Y +Z −Z in OpenGL's
// orientation (OpenGL 4.1 core specification, table 3.19).
#pragma once

#include <glm/vec3.hpp>

#include <cmath>

namespace patina {

/// A point of a face's plane. Beyond ±1 it lies over a neighbouring face.
struct FacePoint {
    int face = 0;    ///< 0…5
    float s = 0.0f;  ///< −1…1 along the row
    float t = 0.0f;  ///< −1…1 down the column
};

/// Where a direction (any length but 0) meets the cube.
inline FacePoint face_point(glm::vec3 d) {
    const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    if (x >= y && x >= z)
        return d.x > 0.0f ? FacePoint{0, -d.z / x, -d.y / x} : FacePoint{1, d.z / x, -d.y / x};
    if (y >= z) return d.y > 0.0f ? FacePoint{2, d.x / y, d.z / y} : FacePoint{3, d.x / y, -d.z / y};
    return d.z > 0.0f ? FacePoint{4, d.x / z, -d.y / z} : FacePoint{5, -d.x / z, -d.y / z};
}

/// Direction, not of unit length, through the point (s, t) of a face's plane, −1…1 inside the face.
template <class Float>
glm::vec<3, Float> face_direction(int face, Float s, Float t) {
    switch (face) {
        case 0:
            return {Float(1), -t, -s};
        case 1:
            return {Float(-1), -t, s};
        case 2:
            return {s, Float(1), t};
        case 3:
            return {s, Float(-1), -t};
        case 4:
            return {s, -t, Float(1)};
        default:
            return {-s, -t, Float(-1)};
    }
}
inline glm::vec3 face_direction(FacePoint p) { return face_direction(p.face, p.s, p.t); }

}  // namespace patina

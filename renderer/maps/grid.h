// Values on a grid of pixels, row 0 at the top: what the steps from a photo to maps pass on. Knows no file.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace patina {

template <class T>
struct Grid {
    int width = 0, height = 0;
    std::vector<T> values;

    Grid() = default;
    Grid(int w, int h) : width(w), height(h), values(std::size_t(w) * std::size_t(h)) {}
    T& at(int x, int y) { return values[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    const T& at(int x, int y) const { return values[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};
using Plane = Grid<float>;
using Colors = Grid<glm::vec3>;  ///< linear, Rec. 709 primaries

/// What lies beyond a border: the other side of a tileable picture, the last pixel of another one. i may lie
/// up to one size outside.
inline int neighbour(int i, int size, bool tileable) {
    if (tileable) return i < 0 ? i + size : i >= size ? i - size : i;
    return i < 0 ? 0 : i >= size ? size - 1 : i;
}

}  // namespace patina

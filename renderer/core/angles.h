// Angles brought into one turn. Pure.
#pragma once

#include <cmath>

namespace patina {

/// Into (−180, 180].
inline float wrap_degrees(float degrees) {
    const float wrapped = degrees - 360.0f * std::floor((degrees + 180.0f) / 360.0f);
    return wrapped <= -180.0f ? wrapped + 360.0f : wrapped;
}

}  // namespace patina

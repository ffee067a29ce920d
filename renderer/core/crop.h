// A part of a picture.
#pragma once

#include <glm/vec2.hpp>

namespace patina {

/// Which part of a larger picture a picture shows, in pixels.
struct Crop {
    glm::ivec2 whole_px{0};  ///< size of the larger picture; 0: the picture is no part but all of it
    glm::ivec2 at_px{0};     ///< where the part's lower left corner lies in it, from its own
    bool operator==(const Crop&) const = default;
};

/// Of the parts of a picture one is counted as it.
inline bool is_counted(const Crop& crop) { return crop.at_px == glm::ivec2(0); }

inline glm::ivec2 whole_px(const Crop& crop, glm::ivec2 size_px) {
    return crop.whole_px.x > 0 ? crop.whole_px : size_px;
}

}  // namespace patina

// How maps are made from a photo of a flat sample, as plain values compared with ==. Knows no file and does
// nothing.
//
// The photo is addressed in fractions of itself: (0,0) its upper left corner, (1,1) the lower right one.
#pragma once

#include "renderer/core/view.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace patina {

/// What the height is told from. Brightness: dark is deep. Light: one lamp from a known side; a slope that
/// faces it is brighter than one that turns away.
enum class ReliefFrom { Brightness, Light };
inline constexpr std::array kReliefs{
    Named<ReliefFrom>{ReliefFrom::Brightness, "brightness", "Brightness", "Dark places are taken for deep."},
    Named<ReliefFrom>{ReliefFrom::Light, "light", "Side light",
                      "Slopes that face the lamp are brighter: give the side it stood on."},
};

struct MapSettings {
    /// Of the sample in the photo: upper left, upper right, lower right, lower left.
    std::array<glm::vec2, 4> corners{glm::vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    glm::vec3 gain{1.0f};            ///< takes the photo's linear values to reflectance, > 0
    glm::ivec2 size_px{1024, 1024};  ///< of the maps, each side 16…8192
    int even_degree = 3;           ///< of the polynomial that the light's gradient is told by, 0 (none) … 4
    bool tileable = true;          ///< the borders are grown together; a fifth of the sample goes into that
    float shading_removed = 0.0f;  ///< of the light and shade that the height explains, 0…1, in the albedo
    ReliefFrom relief_from = ReliefFrom::Brightness;
    float light_azimuth_deg = 90.0f;    ///< where the lamp stood: 0 right, 90 above, counter-clockwise
    float light_elevation_deg = 45.0f;  ///< above the sample, 5…85
    float relief_scale = 0.1f;          ///< largest form, in widths of the map, 0.002…1
    float relief_strength = 1.0f;       ///< 0…10
    float roughness = 0.6f;             ///< in the middle, 0…1
    float roughness_contrast = 0.4f;    ///< 0…1
    float ao_strength = 1.0f;           ///< 0…4, the height is that much deeper
    float ao_radius = 0.05f;            ///< how far occluders count, in widths of the map, 0.002…0.5
    bool operator==(const MapSettings&) const = default;
};

/// Which of the maps are wanted.
struct MapChoice {
    bool albedo = true, normal = true, roughness = true, ao = true;
    bool operator==(const MapChoice&) const = default;
};

}  // namespace patina

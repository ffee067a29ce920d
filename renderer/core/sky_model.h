// Published models of daylight as functions of direction. Luminances in kcd/m², colours linear Rec. 709.
#pragma once

#include <glm/vec3.hpp>

#include <array>

namespace patina {

/// Radius of the sun's disc: 0.53° across.
inline constexpr float kSunAngularRadius = 0.265f * 3.14159265f / 180.0f;

/// Clear to hazy sky with the sun above the horizon: A. J. Preetham, P. Shirley, B. Smits, "A Practical
/// Analytic Model for Daylight", SIGGRAPH 1999, appendices A.1 and A.2.
///
/// Luminance Y and chromaticities x, y each follow Perez' distribution
///     F(θ, γ) = (1 + A e^(B / cos θ)) (1 + C e^(D γ) + E cos² γ),    value = zenith · F(θ, γ) / F(0, θ_sun)
/// with θ from the zenith, γ from the sun and A…E linear in the turbidity T (2 very clear … 6 hazy).
class PreethamSky {
public:
    PreethamSky(glm::vec3 sun_direction, float turbidity);

    /// CIE xyY in a direction at or above the horizon (cos θ ≥ 0), Y in kcd/m².
    glm::vec3 xyy(glm::vec3 direction) const;
    /// The same as linear Rec. 709, negative components cut off.
    glm::vec3 radiance(glm::vec3 direction) const;
    /// Mean over the sun's disc, after what the air takes away.
    glm::vec3 sun_radiance() const;
    glm::vec3 sun_direction() const { return sun_; }

private:
    struct Perez {
        float a, b, c, d, e;
        float scale;  ///< zenith value / F(0, θ_sun)
    };
    Perez perez(int channel, float zenith, float theta_sun, float turbidity) const;
    glm::vec3 towards_sun(float cos_gamma) const;
    /// x and y taken at their own height above the horizon.
    glm::vec3 evaluate(glm::vec3 direction, float color_height) const;

    static constexpr int kTableSize = 1024;
    glm::vec3 sun_;
    float turbidity_;
    std::array<Perez, 3> perez_;                   ///< Y, x, y
    std::array<glm::vec3, kTableSize + 2> table_;  ///< the factors that depend on γ, over sin γ/2
};

/// CIE 1931 xyY to linear Rec. 709 (IEC 61966-2-1 matrix).
glm::vec3 xyy_to_rgb(glm::vec3 xyy);

/// CIE standard overcast sky relative to the zenith: (1 + 2 sin elevation) / 3 (Moon & Spencer 1942).
float overcast_luminance(float sine_of_elevation);

}  // namespace patina

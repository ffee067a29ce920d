// What shading is judged by: the reflectance integral of the full model in double precision, summed over
// texels, without noise. Slow; for tests and benchmarks.
#pragma once

#include "renderer/core/environment.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace patina {

/// The material at one point, linear.
struct ReflectingSurface {
    glm::dvec3 albedo{1.0};
    double metallic = 0.0;
    double roughness = 0.5;  ///< alpha = roughness²; at least kSharpestReference
};

/// Below it alpha is taken as 10⁻⁴: the lobe is then far narrower than any panorama's texel.
inline constexpr double kSharpestReference = 0.01;

/// Light that leaves the surface towards V:
///     Lo = ∫ L(l) [F(V·H) D V NoL + (FmsEms(NoV) + kD(NoV)) NoL/π] dω_l
/// with GGX D, height-correlated Smith V, Schlick's F and the weights of shaders/brdf.glsl, whose A and B are
/// integrated here as well instead of read from a table. Texels are areas of constant radiance. A texel is
/// split until its parts are at most a quarter of the lobe's local width, and integrated by Gauss's rule; the
/// horizon's kink is followed to 0.004 rad. Errs by about 10⁻⁵.
///
/// The environment must outlive it.
class ReflectionReference {
public:
    explicit ReflectionReference(const Environment& environment);

    /// N and V: unit, in the environment's frame; N·V is taken as at least 10⁻⁴.
    glm::dvec3 radiance(glm::dvec3 N, glm::dvec3 V, const ReflectingSurface& surface) const;

    /// The same split by what the material multiplies: Lo = F0·plain + fresnel + (…) · irradiance.
    struct Parts {
        glm::dvec3 plain{0.0};       ///< ∫ L (1 − Fc) D V NoL dω, Fc = (1 − V·H)⁵
        glm::dvec3 fresnel{0.0};     ///< ∫ L Fc D V NoL dω
        glm::dvec3 irradiance{0.0};  ///< E/π
        glm::dvec2 ab{0.0};          ///< the first two under L = 1
    };
    Parts parts(glm::dvec3 N, glm::dvec3 V, double roughness) const;
    /// What a material makes of them.
    static glm::dvec3 reflected(const Parts& parts, const ReflectingSurface& surface);

private:
    const Environment& environment_;
};

/// A and B of F0·A + B by the same quadrature. NoV in (0, 1].
glm::dvec2 reference_split_sum(double NoV, double roughness);

}  // namespace patina

// The true specular lobe, summed: what fitted lobes stand for. Pure; double precision but for the light
// itself.
#pragma once

#include "renderer/lobes/fit_light.h"

#include <vector>

namespace patina::lobes {

/// A point's axes in the environment: V lies in the plane of T and N.
struct Frame {
    glm::vec3 T{1.0f, 0.0f, 0.0f};
    glm::vec3 B{0.0f, 1.0f, 0.0f};
    glm::vec3 N{0.0f, 0.0f, 1.0f};
    glm::vec3 to_world(glm::vec3 v) const { return v.x * T + v.y * B + v.z * N; }
};
/// N and V unit; where they are parallel T is any.
Frame frame_of(glm::vec3 N, glm::vec3 V);
/// Spread over all N and azimuths of V: a Fibonacci lattice with golden turns. Deterministic.
std::vector<Frame> spread_frames(int count);

/// One direction of the lobe in the point's frame, with the weights of D·Vis·NoL and of Fc·D·Vis·NoL.
struct LobeSample {
    glm::vec3 L{0.0f};
    float weight = 0.0f;
    float fresnel_weight = 0.0f;
    double solid_angle = 0.0;
};
/// Visible normals by spherical caps (Dupuy & Benyoub 2023) on a golden lattice, half of them of the lobe and
/// half of a wider one (balance heuristic: Veach & Guibas 1995); weights sum to Ess and B.
struct Lobe {
    std::vector<LobeSample> samples;
    double Ess = 0.0;
    double B = 0.0;
};
Lobe sample_lobe(double NoV, double alpha, int count);

/// ∫ D Vis NoL L and ∫ Fc D Vis NoL L of every environment without its lights.
struct LobeSums {
    Lanes plain{};
    Lanes fresnel{};
};
LobeSums sum_lobe(const Lobe& lobe, const FitLight& light, const Frame& frame);

/// D·Vis·NoL and Fc·D·Vis·NoL towards L (in the point's frame); spread as brdf.glsl's
/// distribution_spread has it, 0: none.
struct Reflection {
    double plain = 0.0;
    double fresnel = 0.0;
};
Reflection reflection(double NoV, glm::dvec3 L, double alpha2, double spread = 0.0);

}  // namespace patina::lobes

#include "renderer/lobes/fit_truth.h"

#include "renderer/brdf.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace patina::lobes {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGolden = 0.6180339887498949;

/// Half of a lobe's samples are drawn from one so much wider: its own leave the tails, where a lamp far from
/// the lobe's middle is all the light there is, to a few huge solid angles.
constexpr double kTailWidth = 5.0;

double pow5(double x) { return x * x * x * x * x; }

/// Smith's Λ: G₁ = 1/(1 + Λ).
double smith_lambda(double cosine, double alpha) {
    const double c2 = cosine * cosine;
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 - c2) / c2) - 1.0);
}

/// Visible normals of one roughness, seen from V = (sine, 0, NoV), by spherical caps.
struct Strategy {
    double NoV, alpha, sine, lambda;
    glm::dvec2 stretched;  ///< V's x and z in the space where the microsurface is a sphere

    Strategy(double cosine, double width)
        : NoV(cosine),
          alpha(width),
          sine(std::sqrt(1.0 - cosine * cosine)),
          lambda(smith_lambda(cosine, width)),
          stretched(glm::normalize(glm::dvec2(width * sine, cosine))) {}
    glm::dvec3 half_vector(double u, double azimuth) const {
        const double z = (1.0 - u) * (1.0 + stretched.y) - stretched.y;
        const double s = std::sqrt(std::max(0.0, 1.0 - z * z));
        return glm::normalize(glm::dvec3(alpha * (s * std::cos(azimuth) + stretched.x),
                                         alpha * s * std::sin(azimuth), std::max(1e-9, z + stretched.y)));
    }
    /// Per solid angle of the reflected direction.
    double density(const glm::dvec3& H) const {
        const double spread = H.x * H.x + H.y * H.y + alpha * alpha * H.z * H.z;
        return alpha * alpha / (kPi * spread * spread) / ((1.0 + lambda) * 4.0 * NoV);
    }
};

glm::vec3 any_tangent(glm::vec3 N) {
    const glm::vec3 axis = std::abs(N.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return glm::normalize(glm::cross(axis, N));
}

}  // namespace

Frame frame_of(glm::vec3 N, glm::vec3 V) {
    const glm::vec3 across = V - glm::dot(V, N) * N;
    const float size2 = glm::dot(across, across);
    const glm::vec3 T = size2 > 1e-10f ? across / std::sqrt(size2) : any_tangent(N);
    return {T, glm::cross(N, T), N};
}

std::vector<Frame> spread_frames(int count) {
    std::vector<Frame> frames;
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - 2.0 * (i + 0.5) / count, s = std::sqrt(1.0 - z * z);
        const double azimuth = 2.0 * kPi * std::fmod(i * kGolden, 1.0);
        const glm::vec3 N(s * std::cos(azimuth), z, s * std::sin(azimuth));
        const double turn = 2.0 * kPi * std::fmod(i * 0.7548776662466927, 1.0);
        const glm::vec3 T = any_tangent(N), B = glm::cross(N, T);
        const glm::vec3 turned = T * float(std::cos(turn)) + B * float(std::sin(turn));
        frames.push_back({turned, glm::cross(N, turned), N});
    }
    return frames;
}

Lobe sample_lobe(double NoV, double alpha, int count) {
    Lobe lobe;
    const Strategy narrow(NoV, alpha), wide(NoV, std::min(1.0, kTailWidth * alpha));
    for (int i = 0; i < count; ++i) {
        const double u = (i + 0.5) / count, azimuth = 2.0 * kPi * std::fmod(i * kGolden + 0.5, 1.0);
        const glm::dvec3 H = (i % 2 ? wide : narrow).half_vector(u, azimuth);
        const double VoH = H.x * narrow.sine + H.z * NoV;
        const glm::dvec3 L(2.0 * VoH * H.x - narrow.sine, 2.0 * VoH * H.y, 2.0 * VoH * H.z - NoV);
        if (L.z <= 0.0 || VoH <= 0.0) continue;
        const double solid_angle = 1.0 / (count * 0.5 * (narrow.density(H) + wide.density(H)));
        const Reflection r = reflection(NoV, L, alpha * alpha);
        const double weight = r.plain * solid_angle, fresnel = r.fresnel * solid_angle;
        lobe.samples.push_back({glm::vec3(L), float(weight), float(fresnel), solid_angle});
        lobe.Ess += weight;
        lobe.B += fresnel;
    }
    return lobe;
}

LobeSums sum_lobe(const Lobe& lobe, const FitLight& light, const Frame& frame) {
    LobeSums sums;
    for (const LobeSample& sample : lobe.samples) {
        Lanes seen{};
        light.add_filtered(seen, frame.to_world(sample.L), sample.solid_angle, 1.0f);
        add_scaled(sums.plain, seen, sample.weight);
        add_scaled(sums.fresnel, seen, sample.fresnel_weight);
    }
    return sums;
}

Reflection reflection(double NoV, glm::dvec3 L, double alpha2, double spread) {
    if (L.z <= 0.0) return {};
    const glm::dvec3 V(std::sqrt(1.0 - NoV * NoV), 0.0, NoV);
    const glm::dvec3 H = glm::normalize(V + L);
    const double sin2 = H.x * H.x + H.y * H.y;
    const double width = sin2 + alpha2 * H.z * H.z;
    const double D = spread > 0.0
                         ? double(brdf::distribution_spread(float(sin2), float(alpha2), float(spread)))
                         : alpha2 / (kPi * width * width);
    const double v = L.z * std::sqrt(NoV * NoV * (1.0 - alpha2) + alpha2);
    const double l = NoV * std::sqrt(L.z * L.z * (1.0 - alpha2) + alpha2);
    const double plain = D * 0.5 / (v + l) * L.z;
    return {plain, plain * pow5(1.0 - glm::dot(V, H))};
}

}  // namespace patina::lobes

#include "renderer/lobes/fit_truth.h"

#include "renderer/brdf.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace patina::lobes {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGolden = 0.6180339887498949;

double pow5(double x) { return x * x * x * x * x; }

/// Smith's Λ: G₁ = 1/(1 + Λ).
double smith_lambda(double cosine, double alpha) {
    const double c2 = cosine * cosine;
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 - c2) / c2) - 1.0);
}

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
    const double sine = std::sqrt(1.0 - NoV * NoV);
    const double stretch = std::sqrt(alpha * alpha * sine * sine + NoV * NoV);
    const double vx = alpha * sine / stretch, vz = NoV / stretch;
    const double lambda_v = smith_lambda(NoV, alpha);
    for (int i = 0; i < count; ++i) {
        const double u = (i + 0.5) / count, azimuth = 2.0 * kPi * std::fmod(i * kGolden + 0.5, 1.0);
        const double z = (1.0 - u) * (1.0 + vz) - vz, s = std::sqrt(std::max(0.0, 1.0 - z * z));
        glm::dvec3 H(alpha * (s * std::cos(azimuth) + vx), alpha * s * std::sin(azimuth),
                     std::max(1e-9, z + vz));
        H = glm::normalize(H);
        const double VoH = H.x * sine + H.z * NoV;
        const glm::dvec3 L(2.0 * VoH * H.x - sine, 2.0 * VoH * H.y, 2.0 * VoH * H.z - NoV);
        if (L.z <= 0.0 || VoH <= 0.0) continue;
        const double spread = H.x * H.x + H.y * H.y + alpha * alpha * H.z * H.z;
        const double D = alpha * alpha / (kPi * spread * spread);
        const double density = D / ((1.0 + lambda_v) * 4.0 * NoV);
        const double weight = (1.0 + lambda_v) / (1.0 + lambda_v + smith_lambda(L.z, alpha)) / count;
        const double fresnel = weight * pow5(1.0 - VoH);
        lobe.samples.push_back({glm::vec3(L), float(weight), float(fresnel), 1.0 / (count * density)});
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

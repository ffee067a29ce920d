#include "renderer/core/sky_model.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Appendix A.2: A…E of Y, x, y as slope · T + offset.
struct Line {
    float slope, offset;
};
constexpr std::array<std::array<Line, 5>, 3> kPerezLines{{
    {{{0.1787f, -1.4630f},
      {-0.3554f, 0.4275f},
      {-0.0227f, 5.3251f},
      {0.1206f, -2.5771f},
      {-0.0670f, 0.3703f}}},
    {{{-0.0193f, -0.2592f},
      {-0.0665f, 0.0008f},
      {-0.0004f, 0.2125f},
      {-0.0641f, -0.8989f},
      {-0.0033f, 0.0452f}}},
    {{{-0.0167f, -0.2608f},
      {-0.0950f, 0.0092f},
      {-0.0079f, 0.2102f},
      {-0.0441f, -1.6537f},
      {-0.0109f, 0.0529f}}},
}};

/// Zenith chromaticity: (T², T, 1) · M · (θ³, θ², θ, 1).
using ZenithMatrix = std::array<std::array<float, 4>, 3>;
constexpr ZenithMatrix kZenithX{{{0.00166f, -0.00375f, 0.00209f, 0.0f},
                                 {-0.02903f, 0.06377f, -0.03202f, 0.00394f},
                                 {0.11693f, -0.21196f, 0.06052f, 0.25886f}}};
constexpr ZenithMatrix kZenithY{{{0.00275f, -0.00610f, 0.00317f, 0.0f},
                                 {-0.04214f, 0.08970f, -0.04153f, 0.00516f},
                                 {0.15346f, -0.26756f, 0.06670f, 0.26688f}}};

float zenith_chromaticity(const ZenithMatrix& matrix, float theta, float turbidity) {
    const std::array<float, 3> powers{turbidity * turbidity, turbidity, 1.0f};
    float sum = 0.0f;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& row = matrix[i];
        sum += powers[i] * (((row[0] * theta + row[1]) * theta + row[2]) * theta + row[3]);
    }
    return sum;
}

/// kcd/m²: (4.0453 T − 4.9710) tan χ − 0.2155 T + 2.4192, χ = (4/9 − T/120)(π − 2 θ_sun).
float zenith_luminance(float theta, float turbidity) {
    const float chi = (4.0f / 9.0f - turbidity / 120.0f) * (kPi - 2.0f * theta);
    return (4.0453f * turbidity - 4.9710f) * std::tan(chi) - 0.2155f * turbidity + 2.4192f;
}

}  // namespace

PreethamSky::PreethamSky(glm::vec3 sun_direction, float turbidity)
    : sun_(glm::normalize(sun_direction)), turbidity_(turbidity) {
    const float theta = std::acos(std::clamp(sun_.y, 0.0f, 1.0f));
    const std::array<float, 3> zenith{zenith_luminance(theta, turbidity),
                                      zenith_chromaticity(kZenithX, theta, turbidity),
                                      zenith_chromaticity(kZenithY, theta, turbidity)};
    for (int i = 0; i < 3; ++i) perez_[i] = perez(i, zenith[i], theta, turbidity);
    for (int i = 0; i <= kTableSize + 1; ++i) {
        const float s = static_cast<float>(i) / kTableSize;
        const float cos_gamma = std::max(1.0f - 2.0f * s * s, -1.0f);
        const float gamma = std::acos(cos_gamma);
        for (int c = 0; c < 3; ++c) {
            const Perez& p = perez_[c];
            table_[i][c] = p.scale * (1.0f + p.c * std::exp(p.d * gamma) + p.e * cos_gamma * cos_gamma);
        }
    }
}

PreethamSky::Perez PreethamSky::perez(int channel, float zenith, float theta_sun, float turbidity) const {
    const auto& lines = kPerezLines[channel];
    const auto at = [&](int i) { return lines[i].slope * turbidity + lines[i].offset; };
    Perez p{.a = at(0), .b = at(1), .c = at(2), .d = at(3), .e = at(4), .scale = 1.0f};
    const float at_zenith = (1.0f + p.a * std::exp(p.b)) * (1.0f + p.c * std::exp(p.d * theta_sun) +
                                                            p.e * std::cos(theta_sun) * std::cos(theta_sun));
    p.scale = zenith / at_zenith;
    return p;
}

glm::vec3 PreethamSky::towards_sun(float cos_gamma) const {
    // Over sin γ/2 the exponential is smooth at the sun, so that linear steps do.
    const float at = std::sqrt(std::max(0.0f, 0.5f - 0.5f * cos_gamma)) * kTableSize;
    const int i = std::min(static_cast<int>(at), kTableSize);
    return glm::mix(table_[i], table_[i + 1], at - static_cast<float>(i));
}

glm::vec3 PreethamSky::xyy(glm::vec3 direction) const { return evaluate(direction, direction.y); }

glm::vec3 PreethamSky::evaluate(glm::vec3 direction, float color_height) const {
    // At the horizon the exponents go to −∞ and their terms to 0.
    const glm::vec3 heights = glm::max(glm::vec3(direction.y, color_height, color_height), 1e-3f);
    const glm::vec3 a(perez_[0].a, perez_[1].a, perez_[2].a);
    const glm::vec3 b(perez_[0].b, perez_[1].b, perez_[2].b);
    const glm::vec3 value = (1.0f + a * glm::exp(b / heights)) * towards_sun(glm::dot(direction, sun_));
    return {value.y, value.z, value.x};
}

glm::vec3 PreethamSky::radiance(glm::vec3 direction) const {
    // Under a high sun the fits of x and y turn violet close to the horizon (G. Zotti, A. Wilkie, W.
    // Purgathofer, "A Critical Review of the Preetham Skylight Model", WSCG 2007): there the colour is that
    // of some degrees further up.
    const float lift = 0.16f * glm::smoothstep(0.15f, 0.5f, sun_.y);
    const float color_height = std::sqrt(direction.y * direction.y + lift * lift);
    return glm::max(xyy_to_rgb(evaluate(direction, color_height)), 0.0f);
}

glm::vec3 PreethamSky::sun_radiance() const {
    // Appendix A.1: transmittances e^(−0.008735 λ^−4.08 m) of the air, e^(−β λ^−1.3 m) of aerosols, e^(−0.35
    // k_o m) of ozone, at the primaries' dominant wavelengths; m is the relative optical mass.
    constexpr glm::vec3 wavelengths{0.6115f, 0.5491f, 0.4644f};  // µm
    constexpr glm::vec3 ozone{0.120f, 0.085f, 0.010f};           // absorption per cm
    // Above the air: 133 klx over the disc's 6.72e-5 sr, the colour of a black body at 5778 K.
    constexpr glm::vec3 above_air = 1.98e6f * glm::vec3{1.112f, 0.976f, 0.913f};
    const float theta = std::acos(std::clamp(sun_.y, 0.0f, 1.0f));
    const float mass = 1.0f / (std::cos(theta) + 0.15f * std::pow(93.885f - theta * 180.0f / kPi, -1.253f));
    const float beta = 0.04608f * turbidity_ - 0.04586f;
    const glm::vec3 depth = 0.008735f * glm::pow(wavelengths, glm::vec3(-4.08f)) +
                            beta * glm::pow(wavelengths, glm::vec3(-1.3f)) + 0.35f * ozone;
    return above_air * glm::exp(-mass * depth);
}

glm::vec3 xyy_to_rgb(glm::vec3 xyy) {
    const float x = xyy.z * xyy.x / xyy.y;
    const float y = xyy.z;
    const float z = xyy.z * (1.0f - xyy.x - xyy.y) / xyy.y;
    return {3.2406f * x - 1.5372f * y - 0.4986f * z, -0.9689f * x + 1.8758f * y + 0.0415f * z,
            0.0557f * x - 0.2040f * y + 1.0570f * z};
}

float overcast_luminance(float sine_of_elevation) { return (1.0f + 2.0f * sine_of_elevation) / 3.0f; }

}  // namespace patina

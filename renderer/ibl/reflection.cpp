#include "renderer/ibl/reflection.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHorizonCell = 0.004;  ///< rad

glm::dvec3 direction(double theta, double phi) {  // φ = 2πu
    return {-std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
}

/// The lobe towards V on a surface facing N.
struct Lobe {
    glm::dvec3 N, V;
    double NoV, alpha2, alpha;

    Lobe(glm::dvec3 normal, glm::dvec3 view, double roughness) : N(normal), V(view) {
        NoV = std::max(glm::dot(N, V), 1e-4);
        alpha = std::pow(std::max(roughness, kSharpestReference), 2);
        alpha2 = alpha * alpha;
    }

    /// (1 − Fc) D V NoL, Fc D V NoL, NoL/π.
    glm::dvec3 at(glm::dvec3 L) const {
        const double NoL = glm::dot(N, L);
        if (NoL <= 0.0) return glm::dvec3(0.0);
        const glm::dvec3 H = glm::normalize(V + L);
        const glm::dvec3 side = glm::cross(N, H);
        const double sin2 = glm::dot(side, side);
        const double width = sin2 + alpha2 * (1.0 - sin2);
        const double D = alpha2 / (kPi * width * width);
        const double v = NoL * std::sqrt(NoV * NoV * (1.0 - alpha2) + alpha2);
        const double l = NoV * std::sqrt(NoL * NoL * (1.0 - alpha2) + alpha2);
        const double Fc = std::pow(std::clamp(1.0 - glm::dot(V, H), 0.0, 1.0), 5);
        const double specular = D * 0.5 / (v + l) * NoL;
        return {(1.0 - Fc) * specular, Fc * specular, NoL / kPi};
    }

    /// Over what angle it changes by its own size within size/2 of L: the half vector turns by at most
    /// 1/(2 V·H) of what L turns; D falls as a power of its angle once past alpha; V saturates at NoL <
    /// alpha.
    double local_width(glm::dvec3 L, double size) const {
        const glm::dvec3 sum = V + L;
        const double length = glm::length(sum);  // 2 V·H
        const double turn = std::max(length - 0.5 * size, 0.02);
        const double sine = length > 1e-9 ? glm::length(glm::cross(N, sum)) / length : 1.0;
        const double nearest = std::max(0.0, sine - 0.5 * size / turn);
        const double above = std::max(0.0, glm::dot(N, L) - 0.5 * size);
        return std::min(turn * std::max(alpha, nearest), 2.0 * std::max(alpha, above));
    }
};

struct Cell {
    double theta, phi, height, width;  ///< its middle and its sides in both angles
};

double sphere_width(const Cell& cell) {
    const double top = cell.theta - cell.height / 2, bottom = cell.theta + cell.height / 2;
    const double sine = top < kPi / 2 && bottom > kPi / 2 ? 1.0 : std::max(std::sin(top), std::sin(bottom));
    return cell.width * sine;
}

glm::dvec3 by_gauss(const Lobe& lobe, const Cell& cell, int points) {
    constexpr double three[3] = {-0.774596669241483377, 0.0, 0.774596669241483377};
    constexpr double three_weights[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    constexpr double two[2] = {-0.577350269189625765, 0.577350269189625765};
    glm::dvec3 total(0.0);
    for (int i = 0; i < points * points; ++i) {
        const int row = i / points, column = i % points;
        const double theta = cell.theta + 0.5 * cell.height * (points == 3 ? three[row] : two[row]);
        const double phi = cell.phi + 0.5 * cell.width * (points == 3 ? three[column] : two[column]);
        const double weight = points == 3 ? three_weights[row] * three_weights[column] : 0.25;
        total += weight * std::sin(theta) * lobe.at(direction(theta, phi));
    }
    return total * cell.height * cell.width;
}

glm::dvec3 over(const Lobe& lobe, const Cell& cell) {
    const double width = sphere_width(cell);
    const double size = std::max(cell.height, width);
    const glm::dvec3 middle = direction(cell.theta, cell.phi);
    const double NoL = glm::dot(lobe.N, middle);
    const double radius = 0.5 * std::hypot(cell.height, width);
    if (NoL < -1.05 * radius) return glm::dvec3(0.0);
    const double local = lobe.local_width(middle, 2.0 * radius);
    const bool at_horizon = NoL < 1.05 * radius;
    if (size > 0.25 * local || (at_horizon && size > kHorizonCell)) {
        Cell one = cell, two = cell;
        double Cell::*const side = cell.height > width ? &Cell::height : &Cell::width;
        double Cell::*const centre = cell.height > width ? &Cell::theta : &Cell::phi;
        one.*side = two.*side = cell.*side / 2;
        one.*centre -= cell.*side / 4;
        two.*centre += cell.*side / 4;
        return over(lobe, one) + over(lobe, two);
    }
    return by_gauss(lobe, cell, size > 0.08 * local ? 3 : 2);
}

/// A, B and ∫ NoL/π dω, over cells as coarse as the splitting allows.
glm::dvec3 under_white_light(const Lobe& lobe) {
    constexpr int rows = 12;
    const double side = kPi / rows;
    glm::dvec3 sum(0.0);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < 2 * rows; ++x)
            sum += over(lobe, {(y + 0.5) * side, (x + 0.5) * side, side, side});
    return sum;
}

}  // namespace

glm::dvec2 reference_split_sum(double NoV, double roughness) {
    const double sine = std::sqrt(std::max(0.0, 1.0 - NoV * NoV));
    return glm::dvec2(under_white_light({{0.0, 1.0, 0.0}, {sine, NoV, 0.0}, roughness}));
}

ReflectionReference::ReflectionReference(const Environment& environment) : environment_(environment) {}

ReflectionReference::Parts ReflectionReference::parts(glm::dvec3 N, glm::dvec3 V, double roughness) const {
    const Lobe lobe(N, V, roughness);
    const double height = kPi / environment_.height, width = 2.0 * kPi / environment_.width;
    Parts sum;
    for (int y = 0; y < environment_.height; ++y)
        for (int x = 0; x < environment_.width; ++x) {
            const glm::dvec3 L = environment_.radiance[std::size_t(y) * environment_.width + x];
            if (L == glm::dvec3(0.0)) continue;
            const glm::dvec3 share = over(lobe, {(y + 0.5) * height, (x + 0.5) * width, height, width});
            sum.plain += share.x * L;
            sum.fresnel += share.y * L;
            sum.irradiance += share.z * L;
        }
    sum.ab = glm::dvec2(under_white_light(lobe));
    return sum;
}

glm::dvec3 ReflectionReference::reflected(const Parts& parts, const ReflectingSurface& surface) {
    const glm::dvec3 F0 = glm::mix(glm::dvec3(0.04), surface.albedo, surface.metallic);
    const glm::dvec3 E_F = F0 * parts.ab.x + parts.ab.y;
    const double Ems = std::max(0.0, 1.0 - parts.ab.x - parts.ab.y);
    const glm::dvec3 Favg = F0 + (1.0 - F0) / 21.0;
    const glm::dvec3 multiple = E_F * Favg * Ems / (1.0 - Favg * Ems);
    const glm::dvec3 body =
        surface.albedo * (1.0 - surface.metallic) * glm::max(1.0 - E_F - multiple, glm::dvec3(0.0));
    return F0 * parts.plain + parts.fresnel + (multiple + body) * parts.irradiance;
}

glm::dvec3 ReflectionReference::radiance(glm::dvec3 N, glm::dvec3 V, const ReflectingSurface& surface) const {
    return reflected(parts(N, V, surface.roughness), surface);
}

}  // namespace patina

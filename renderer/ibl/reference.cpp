#include "renderer/ibl/reference.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 direction(double theta, double phi) {  // φ = 2πu
    return {-std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
}

double kernel(glm::dvec3 N, glm::dvec3 L, double alpha2) {
    const double NoL = glm::dot(N, L);
    if (NoL <= 0.0) return 0.0;
    const glm::dvec3 apart = N - L;
    const double s = glm::dot(apart, apart) / 4.0;  // sin² of the half angle, without cancellation
    const double d = s + alpha2 * (1.0 - s);
    return NoL * alpha2 / (d * d);
}

/// Texels that are looked at: a low-discrepancy spread, then the neighbourhood of the brightest.
std::vector<int> probe_texels(const CubeMap& cube, int count) {
    std::vector<int> texels;
    const int total = int(cube.texels.size());
    for (int i = 0; i < count; ++i) {
        const double golden = (i + 0.5) * (std::numbers::phi - 1.0);
        texels.push_back(std::min(total - 1, int((golden - std::floor(golden)) * total)));
    }
    const auto brightest = std::max_element(cube.texels.begin(), cube.texels.end(),
                                            [](glm::vec3 a, glm::vec3 b) { return a.y < b.y; });
    const int n = cube.size, centre = int(brightest - cube.texels.begin());
    const int face = centre / (n * n), x = centre % n, y = centre / n % n;
    constexpr int offsets[] = {-8, -4, -2, -1, 0, 1, 2, 4, 8};
    for (const int dy : offsets)
        for (const int dx : offsets)
            if (x + dx >= 0 && x + dx < n && y + dy >= 0 && y + dy < n)
                texels.push_back((face * n + y + dy) * n + x + dx);
    return texels;
}

double mean_of(const Environment& e) {
    double sum = 0.0, area = 0.0;
    for (int y = 0; y < e.height; ++y) {
        const double ring = std::cos(y * kPi / e.height) - std::cos((y + 1) * kPi / e.height);
        glm::dvec3 row(0.0);
        for (int x = 0; x < e.width; ++x) row += e.radiance[std::size_t(y) * e.width + x];
        sum += ring * (row.x + row.y + row.z) / 3.0;
        area += ring * e.width;
    }
    return sum / area;
}

}  // namespace

double reference_kernel_integral(double alpha) {
    const double a = alpha * alpha, q = (1.0 - a) / 2.0;
    if (q < 1e-6) return kPi;
    return 2.0 * kPi * a / q * ((1.0 + a / q) * (1.0 / a - 1.0 / (q + a)) - std::log((q + a) / a) / q);
}

PrefilterReference::PrefilterReference(const Environment& environment) : environment_(environment) {
    for (int y = 0; y < environment.height; ++y) {
        sin_theta_.push_back(std::sin((y + 0.5) * kPi / environment.height));
        cos_theta_.push_back(std::cos((y + 0.5) * kPi / environment.height));
    }
    for (int x = 0; x < environment.width; ++x) {
        sin_phi_.push_back(std::sin((x + 0.5) * 2.0 * kPi / environment.width));
        cos_phi_.push_back(std::cos((x + 0.5) * 2.0 * kPi / environment.width));
    }
}

double PrefilterReference::kernel_over(const Cell& cell, glm::dvec3 N, double alpha) const {
    const double top = cell.theta - cell.height / 2, bottom = cell.theta + cell.height / 2;
    const double sine = top < kPi / 2 && bottom > kPi / 2 ? 1.0 : std::max(std::sin(top), std::sin(bottom));
    const double width = cell.width * sine;
    const double angle = std::acos(std::clamp(glm::dot(direction(cell.theta, cell.phi), N), -1.0, 1.0));
    const double nearest = std::max(0.0, angle - 0.5 * std::hypot(cell.height, width));
    const double lobe = std::max(alpha, 0.5 * nearest), size = std::max(cell.height, width);
    const bool at_horizon = std::abs(angle - kPi / 2) < size;  // where the kernel has a kink
    if (size > 0.5 * lobe || (at_horizon && size > 0.0015)) {
        Cell one = cell, two = cell;
        double Cell::*const side = cell.height > width ? &Cell::height : &Cell::width;
        double Cell::*const middle = cell.height > width ? &Cell::theta : &Cell::phi;
        one.*side = two.*side = cell.*side / 2;
        one.*middle -= cell.*side / 4;
        two.*middle += cell.*side / 4;
        return kernel_over(one, N, alpha) + kernel_over(two, N, alpha);
    }
    constexpr double three[3] = {-0.774596669241483377, 0.0, 0.774596669241483377};
    constexpr double three_weights[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    constexpr double two[2] = {-0.577350269189625765, 0.577350269189625765};
    const int points = size > 0.15 * lobe ? 3 : 2;
    double total = 0.0;
    for (int i = 0; i < points * points; ++i) {
        const int row = i / points, column = i % points;
        const double theta = cell.theta + 0.5 * cell.height * (points == 3 ? three[row] : two[row]);
        const double phi = cell.phi + 0.5 * cell.width * (points == 3 ? three[column] : two[column]);
        const double weight = points == 3 ? three_weights[row] * three_weights[column] : 0.25;
        total += weight * std::sin(theta) * kernel(N, direction(theta, phi), alpha * alpha);
    }
    return total * cell.height * cell.width;
}

glm::dvec3 PrefilterReference::radiance(glm::dvec3 N, double roughness) const {
    const double alpha = roughness * roughness;
    const double height = kPi / environment_.height, width = 2.0 * kPi / environment_.width;
    const double size = std::max(height, width);
    glm::dvec3 sum(0.0);
    for (int y = 0; y < environment_.height; ++y)
        for (int x = 0; x < environment_.width; ++x) {
            const glm::dvec3 L = environment_.radiance[std::size_t(y) * environment_.width + x];
            if (L == glm::dvec3(0.0)) continue;
            const double flat = sin_theta_[y];
            const glm::dvec3 middle(-flat * sin_phi_[x], cos_theta_[y], flat * cos_phi_[x]);
            const double NoL = glm::dot(N, middle);
            if (NoL < -2.0 * size) continue;  // wholly behind
            // Far away, and clear of the horizon's kink, the middle with the texel's area is exact to
            // (size/lobe)² · 0.2.
            const double lobe = std::max(alpha, 0.5 * std::sqrt(std::max(0.0, 2.0 - 2.0 * NoL)));
            if (size < 0.015 * lobe && NoL > 2.0 * size)
                sum += flat * height * width * kernel(N, middle, alpha * alpha) * L;
            else
                sum += kernel_over({(y + 0.5) * height, (x + 0.5) * width, height, width}, N, alpha) * L;
        }
    return sum / reference_kernel_integral(alpha);
}

PrefilterTruth prefilter_truth(const CubeMap& like, double roughness, const Environment& environment,
                               const PrefilterProbe& probe) {
    const PrefilterReference reference(environment);
    PrefilterTruth truth{probe_texels(like, probe.texels), like.size, {}, 1e-3 * mean_of(environment)};
    truth.radiance.resize(truth.texels.size());
    probe.parallel_for(int(truth.texels.size()), [&](int i) {
        const int n = like.size, texel = truth.texels[i];
        const glm::dvec3 N =
            glm::normalize(glm::dvec3(cube_texel_direction(n, texel / (n * n), texel % n, texel / n % n)));
        truth.radiance[i] = reference.radiance(N, roughness);
    });
    return truth;
}

PrefilterError prefilter_error(const std::vector<glm::vec3>& values, const PrefilterTruth& truth) {
    std::vector<double> errors;
    double square = 0.0;
    for (std::size_t i = 0; i < truth.radiance.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double right = truth.radiance[i][c];
            errors.push_back(std::abs(values[i][c] - right) / std::max(right, truth.floor));
            square += errors.back() * errors.back();
        }
    std::sort(errors.begin(), errors.end());
    return {std::sqrt(square / double(errors.size())), errors[errors.size() * 95 / 100], errors.back()};
}

PrefilterError prefilter_error(const CubeMap& cube, const PrefilterTruth& truth) {
    std::vector<glm::vec3> values;
    values.reserve(truth.texels.size());
    for (const int texel : truth.texels) values.push_back(cube.texels[texel]);
    return prefilter_error(values, truth);
}

PrefilterError prefilter_error(const CubeMap& cube, double roughness, const Environment& environment,
                               const PrefilterProbe& probe) {
    return prefilter_error(cube, prefilter_truth(cube, roughness, environment, probe));
}

}  // namespace patina

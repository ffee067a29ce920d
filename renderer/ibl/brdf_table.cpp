// The split-sum table: directional albedo of GGX with height-correlated Smith, split by the Fresnel weight.
#include "renderer/ibl/brdf_table.h"

#include "renderer/ibl/brdf_simd.h"

#include <glm/common.hpp>
#include <glm/ext/vector_double2.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

namespace patina {
namespace {

/// Nodes on the unit square: a Fibonacci lattice (i/n, {i·f/n}), the best-spread rank-1 rule of its size, n
/// and f consecutive Fibonacci numbers: A and B err by at most 1.1e-4 with 1597 nodes, 3.9e-5 with 4181. The
/// second coordinate is periodic (an azimuth); the first is not, so it is pulled towards both ends by u =
/// s²(3 − 2s), whose Jacobian 6s(1 − s) vanishes there: the integrand becomes periodic in s too.
struct Lattice {
    std::vector<float> height, cos_phi, sin_phi, weight;

    Lattice(int nodes, int previous) {
        for (int i = 0; i < nodes || i % simd::kAlbedoNodes != 0; ++i) {
            const double s = (i + 0.5) / nodes;
            const double phi = 2.0 * std::numbers::pi * std::fmod(double(i) * previous, nodes) / nodes;
            height.push_back(i < nodes ? float(s * s * (3.0 - 2.0 * s)) : 0.0f);
            cos_phi.push_back(float(std::cos(phi)));
            sin_phi.push_back(float(std::sin(phi)));
            weight.push_back(i < nodes ? float(6.0 * s * (1.0 - s) / nodes) : 0.0f);
        }
    }
    simd::AlbedoNodes view() const {
        return {int(height.size()), height.data(), cos_phi.data(), sin_phi.data(), weight.data()};
    }
};

/// A and B at one NoV and alpha.
///
/// Sampling the visible normals cancels everything but G2/G1 (Heitz 2018), so E = mean of G2(V, L)/G1(V) · F.
/// Smith's Λ = ½(√(1 + α² tan²) − 1), G1 = 1/(1 + Λ), height-correlated G2 = 1/(1 + Λ(V) + Λ(L)) (Heitz
/// 2014). Visible normals are V' + a uniform direction on the cap z ≥ −V'.z of the unit sphere, V' being the
/// view stretched by alpha (Dupuy & Benyoub 2023). Half vectors that reflect below the horizon need not be
/// visited: the cap may start at −k·V'.z with the k of Tokuyoshi & Eto 2023, the part left out contributing
/// nothing, so the mean is scaled by the caps' ratio.
glm::dvec2 albedo(double NoV, double alpha, const Lattice& lattice) {
    const double alpha2 = alpha * alpha;
    const double sin_v = std::sqrt(std::max(0.0, 1.0 - NoV * NoV));
    const double stretched = std::sqrt(alpha2 * sin_v * sin_v + NoV * NoV);
    const double vz = NoV / stretched;
    const double s2 = (1.0 + sin_v) * (1.0 + sin_v);
    const double cap = 1.0 + (1.0 - alpha2) * s2 / (s2 + alpha2 * NoV * NoV) * vz;
    simd::AlbedoView view{};
    view.NoV = float(NoV);
    view.sin_v = float(sin_v);
    view.alpha = float(alpha);
    view.vx = float(alpha * sin_v / stretched);
    view.vz = float(vz);
    view.cap = float(cap);
    view.lambda_v = float(0.5 * (stretched / NoV - 1.0));  // √(1 + α² sin²/cos²) = stretched/cos
    float scale = 0.0f, bias = 0.0f;
    simd::directional_albedo(lattice.view(), view, &scale, &bias);
    return glm::dvec2(scale, bias) * (cap / (1.0 + vz));
}

/// Between two texels a straight line errs by up to h²f''/8, always to the same side. Texels lowered by
/// h²f''/16 halve the largest error and the root mean square. f'' from the neighbours; at the borders from
/// the last three.
std::vector<glm::dvec2> balanced(const std::vector<glm::dvec2>& exact, int size) {
    std::vector<glm::dvec2> result = exact;
    const auto at = [&](int x, int y) { return exact[std::size_t(y) * size + x]; };
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const int cx = std::clamp(x, 1, size - 2), cy = std::clamp(y, 1, size - 2);
            const glm::dvec2 second = at(cx - 1, y) - 2.0 * at(cx, y) + at(cx + 1, y) + at(x, cy - 1) -
                                      2.0 * at(x, cy) + at(x, cy + 1);
            result[std::size_t(y) * size + x] -= second / 16.0;
        }
    return result;
}

/// Texel i lies at place(i) on either axis.
BrdfTable bake_table(int size, const Lattice& lattice, const ParallelFor& parallel_for,
                     const std::function<double(int)>& place) {
    assert(size >= 3);
    constexpr double least_root = 1e-3, least_roughness = 1e-3;  // the limits at 0, short of dividing by it
    std::vector<glm::dvec2> exact(std::size_t(size) * size);
    parallel_for(size, [&](int y) {
        const double roughness = std::max(place(y), least_roughness);
        for (int x = 0; x < size; ++x) {
            const double root = std::max(place(x), least_root);
            exact[std::size_t(y) * size + x] = albedo(root * root, roughness * roughness, lattice);
        }
    });
    BrdfTable table{size, {}};
    for (const glm::dvec2& value : balanced(exact, size)) {
        const glm::dvec2 ab = glm::max(value, 0.0) / std::max(1.0, value.x + value.y);
        const float bias = float(ab.y);
        table.ab.emplace_back(std::min(float(ab.x), 1.0f - bias), bias);
    }
    return table;
}

}  // namespace

BrdfTable bake_brdf_table(int size, const ParallelFor& parallel_for) {
    return bake_table(size, Lattice(1597, 987), parallel_for, [size](int i) { return (i + 0.5) / size; });
}

BrdfTable bake_end_to_end_brdf_table(int size, const ParallelFor& parallel_for) {
    return bake_table(size, Lattice(4181, 2584), parallel_for,
                      [size](int i) { return double(i) / (size - 1); });
}

}  // namespace patina

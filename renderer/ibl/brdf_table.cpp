// The split-sum table: directional albedo of GGX with height-correlated Smith, split by the Fresnel weight.
#include "renderer/ibl/bake.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

/// Nodes on the unit square: a Fibonacci lattice (i/n, {i·f/n}), the best-spread rank-1 rule of its size, n
/// and f consecutive Fibonacci numbers. The second coordinate is periodic (an azimuth); the first is not, so
/// it is pulled towards both ends by u = s²(3 − 2s), whose Jacobian 6s(1 − s) vanishes there: the integrand
/// becomes periodic in s too.
struct LatticeNode {
    double u, cos_phi, sin_phi, weight;
};

std::vector<LatticeNode> make_lattice() {
    constexpr int kNodes = 1597;
    constexpr int kPrevious = 987;
    std::vector<LatticeNode> nodes;
    for (int i = 0; i < kNodes; ++i) {
        const double s = (i + 0.5) / kNodes;
        const double phi = 2.0 * std::numbers::pi * std::fmod(double(i) * kPrevious, kNodes) / kNodes;
        nodes.push_back(
            {s * s * (3.0 - 2.0 * s), std::cos(phi), std::sin(phi), 6.0 * s * (1.0 - s) / kNodes});
    }
    return nodes;
}

/// Smith's Λ for GGX: G1 = 1/(1 + Λ), height-correlated G2 = 1/(1 + Λ(V) + Λ(L)) (Heitz 2014).
double smith_lambda(double cosine, double alpha2) {
    const double tan2 = (1.0 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (std::sqrt(1.0 + alpha2 * tan2) - 1.0);
}

/// A and B at one NoV and alpha.
///
/// Sampling the visible normals cancels everything but G2/G1 (Heitz 2018), so E = mean of G2(V, L)/G1(V) · F.
/// Visible normals are V' + a uniform direction on the cap z ≥ −V'.z of the unit sphere, V' being the view
/// stretched by alpha (Dupuy & Benyoub 2023). Half vectors that reflect below the horizon need not be
/// visited: the cap may start at −k·V'.z with the k of Tokuyoshi & Eto 2023, the part left out contributing
/// nothing, so the mean is scaled by the caps' ratio.
glm::dvec2 directional_albedo(double NoV, double alpha, const std::vector<LatticeNode>& lattice) {
    const double alpha2 = alpha * alpha;
    const double sin_v = std::sqrt(std::max(0.0, 1.0 - NoV * NoV));
    const double stretched = std::sqrt(alpha2 * sin_v * sin_v + NoV * NoV);
    const double vx = alpha * sin_v / stretched;
    const double vz = NoV / stretched;
    const double s2 = (1.0 + sin_v) * (1.0 + sin_v);
    const double bound = (1.0 - alpha2) * s2 / (s2 + alpha2 * NoV * NoV) * vz;
    const double lambda_v = smith_lambda(NoV, alpha2);

    glm::dvec2 sum(0.0);
    for (const LatticeNode& node : lattice) {
        const double z = 1.0 - (1.0 + bound) * node.u;
        const double ring = std::sqrt(std::max(0.0, 1.0 - z * z));
        const double hx = alpha * (ring * node.cos_phi + vx);
        const double hy = alpha * ring * node.sin_phi;
        const double hz = z + vz;
        const double inverse_length = 1.0 / std::sqrt(hx * hx + hy * hy + hz * hz);
        const double VoH = (hx * sin_v + hz * NoV) * inverse_length;
        const double NoL = 2.0 * VoH * hz * inverse_length - NoV;
        if (NoL <= 0.0) continue;
        const double g = (1.0 + lambda_v) / (1.0 + lambda_v + smith_lambda(NoL, alpha2));
        const double c = 1.0 - VoH;
        const double fresnel = c * c * c * c * c;
        sum += node.weight * g * glm::dvec2(1.0 - fresnel, fresnel);
    }
    return sum * ((1.0 + bound) / (1.0 + vz));
}

}  // namespace

BrdfTable bake_brdf_table(int size, const ParallelFor& parallel_for) {
    assert(size > 0);
    const std::vector<LatticeNode> lattice = make_lattice();
    BrdfTable table{size, std::vector<glm::vec2>(std::size_t(size) * size)};
    parallel_for(size, [&](int y) {
        const double roughness = (y + 0.5) / size;
        for (int x = 0; x < size; ++x) {
            const double root = (x + 0.5) / size;
            glm::dvec2 ab = directional_albedo(root * root, roughness * roughness, lattice);
            ab /= std::max(1.0, ab.x + ab.y);
            glm::vec2 stored(ab);
            stored.x = std::min(stored.x, 1.0f - stored.y);
            table.ab[std::size_t(y) * size + x] = stored;
        }
    });
    return table;
}

}  // namespace patina

#include "renderer/ibl/kernel.h"

#include "renderer/ibl/kernel_simd.h"
#include "renderer/ibl/legendre.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

struct ThetaNode {
    double theta, weight;
};

/// 16-point Gauss panels over 0 … π/2, growing with θ as the lobe's power law flattens (a quarter of the
/// distance already gone) and no longer than 26 radians of P_band's oscillation.
std::vector<ThetaNode> theta_nodes(double alpha, int band) {
    static const GaussNodes gauss(16);
    std::vector<ThetaNode> nodes;
    const double longest = 26.0 / std::max(26, band);
    for (double begin = 0.0; begin < std::numbers::pi / 2;) {
        const double step = std::min(std::max(begin * 0.25, alpha * 0.5), longest);
        const double end = std::min(std::numbers::pi / 2, begin + step);
        for (std::size_t i = 0; i < gauss.x.size(); ++i) {
            const double theta = begin + (end - begin) * gauss.x[i];
            nodes.push_back(
                {theta, (end - begin) * gauss.weight[i] * std::sin(theta) * ggx_kernel(theta, alpha)});
        }
        begin = end;
    }
    return nodes;
}

/// Σ weight · P_l(cos θ) for l = 0 … band.
std::vector<double> legendre_sums(const std::vector<ThetaNode>& nodes, int band) {
    const std::size_t padded =
        (nodes.size() + simd::kNodesAtOnce - 1) / simd::kNodesAtOnce * simd::kNodesAtOnce;
    std::vector<double> x(padded, 0.0), weight(padded, 0.0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        x[i] = std::cos(nodes[i].theta);
        weight[i] = nodes[i].weight;
    }
    const std::size_t degrees = std::size_t(band) + 1;
    std::vector<double> sums(degrees * simd::kNodesAtOnce, 0.0), g(degrees, 0.0);
    simd::add_legendre(x.data(), weight.data(), int(padded), band, sums.data());
    for (std::size_t i = 0; i < sums.size(); ++i) g[i / simd::kNodesAtOnce] += sums[i];
    return g;
}

}  // namespace

double ggx_kernel(double theta, double alpha) {
    const double half = std::sin(0.5 * theta);
    const double s = half * half;
    const double d = s + alpha * alpha * (1.0 - s);
    return std::cos(theta) * alpha * alpha / (d * d);
}

std::vector<double> ggx_zonal(double alpha, int band) {
    assert(alpha > 0.0 && band >= 0);
    std::vector<double> g = legendre_sums(theta_nodes(alpha, band), band);
    const double total = g[0];
    for (double& value : g) value /= total;
    return g;
}

double ggx_kernel_integral(double alpha) {
    double sum = 0.0;
    for (const ThetaNode& node : theta_nodes(alpha, 1)) sum += node.weight;
    return 2.0 * std::numbers::pi * sum;
}

double KernelSplit::window(double chord_square) const {
    const double t = std::clamp((chord_square - inner_square) / (outer_square - inner_square), 0.0, 1.0);
    const double t2 = t * t;
    return 1.0 - t2 * t2 * (35.0 - 84.0 * t + 70.0 * t2 - 20.0 * t2 * t);
}

std::vector<double> ggx_far_zonal(double alpha, const KernelSplit& split, int band) {
    assert(alpha > 0.0 && band >= 0);
    constexpr double negligible = 1e-7;
    std::vector<ThetaNode> nodes = theta_nodes(alpha, band);
    double total = 0.0;
    for (ThetaNode& node : nodes) {
        total += node.weight;
        const double half = std::sin(0.5 * node.theta);
        node.weight *= 1.0 - split.window(4.0 * half * half);
    }
    std::erase_if(nodes, [](const ThetaNode& node) { return node.weight == 0.0; });
    std::vector<double> g = legendre_sums(nodes, band);
    for (double& value : g) value /= total;
    while (g.size() > 1 && std::abs(g.back()) < negligible) g.pop_back();
    return g;
}

}  // namespace patina

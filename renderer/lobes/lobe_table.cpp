#include "renderer/lobes/lobe_table.h"

#include "renderer/brdf.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace patina {

namespace {

constexpr LobePair kNodes[] = {
#include "renderer/lobes/fitted_lobes.inc"
};
static_assert(std::size(kNodes) == std::size_t(kLobeTableSize) * kLobeTableSize);
static_assert(sizeof(LobeNode) == 12 * sizeof(float));

LobeNode mixed(const LobeNode& a, const LobeNode& b, float share) {
    const auto mix = [share](float x, float y) { return x + (y - x) * share; };
    const auto tap = [&](const LobeTap& x, const LobeTap& y) {
        return LobeTap{mix(x.kappa, y.kappa), mix(x.log2_ratio, y.log2_ratio)};
    };
    return {tap(a.one, b.one),
            mix(a.one_irradiance, b.one_irradiance),
            {tap(a.three[0], b.three[0]), tap(a.three[1], b.three[1]), tap(a.three[2], b.three[2])},
            mix(a.second_weight, b.second_weight),
            mix(a.third_weight, b.third_weight),
            mix(a.three_irradiance, b.three_irradiance)};
}

}  // namespace

std::span<const LobePair> lobe_nodes() { return kNodes; }

LobeNode lobe_at(std::span<const LobePair> nodes, float NoV, float roughness, float phi) {
    const glm::vec2 at = brdf::lobe_coordinates(NoV, roughness) * float(kLobeTableSize - 1);
    const int i = std::min(int(at.x), kLobeTableSize - 2);
    const int j = std::min(int(at.y), kLobeTableSize - 2);
    const auto node = [&](int x, int y) {
        const auto& pair = nodes[std::size_t(y) * kLobeTableSize + x].by_reflectance;
        return mixed(pair[0], pair[1], phi);
    };
    const float fx = at.x - float(i);
    return mixed(mixed(node(i, j), node(i + 1, j), fx), mixed(node(i, j + 1), node(i + 1, j + 1), fx),
                 at.y - float(j));
}

LobeReach lobe_reach(float lowest_roughness, float highest_roughness, bool three_taps) {
    const auto row = [](float roughness) {
        return brdf::lobe_coordinates(1.0f, roughness).y * float(kLobeTableSize - 1);
    };
    const int first = int(std::floor(row(lowest_roughness)));
    const int last = int(std::ceil(row(highest_roughness)));
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (int k = first * kLobeTableSize; k < (last + 1) * kLobeTableSize; ++k) {
        for (const LobeNode& node : kNodes[k].by_reflectance) {
            const auto include = [&](const LobeTap& tap) {
                low = std::min(low, tap.log2_ratio);
                high = std::max(high, tap.log2_ratio);
            };
            if (!three_taps) include(node.one);
            for (int t = 0; three_taps && t < 3; ++t) include(node.three[t]);
        }
    }
    return {std::exp2(low), std::exp2(high)};
}

}  // namespace patina

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

LobeSweep mixed(const LobeSweep& a, const LobeSweep& b, float share) {
    return {glm::mix(a.log2_ratio, b.log2_ratio, share), glm::mix(a.kappa, b.kappa, share),
            glm::mix(a.slope, b.slope, share), glm::mix(a.irradiance, b.irradiance, share),
            glm::mix(a.lean, b.lean, share)};
}

LobeNode mixed(const LobeNode& a, const LobeNode& b, float share) {
    return {mixed(a.two, b.two, share), mixed(a.four, b.four, share)};
}

/// Where in the table, in nodes.
glm::vec2 node_coordinates(float NoV, float roughness) {
    const float log2_roughness = std::log2(std::max(roughness, brdf::kSharpestFitted));
    return brdf::lobe_coordinates(NoV, log2_roughness) * float(kLobeTableSize - 1);
}

}  // namespace

std::span<const LobePair> lobe_nodes() { return kNodes; }

LobeNode lobe_at(std::span<const LobePair> nodes, float NoV, float roughness, float phi) {
    const glm::vec2 at = node_coordinates(NoV, roughness);
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

std::array<SweptLevel, 4> swept_levels(const LobeSweep& sweep, float level, bool four) {
    const float second = std::floor(level), within = level - second;
    const glm::vec4 weights =
        four ? brdf::sweep_weights(within, sweep.lean) : glm::vec4(0.0f, 1.0f - within, within, 0.0f);
    std::array<SweptLevel, 4> levels;
    for (int i = 0; i < 4; ++i)
        levels[i] = {int(second) + i - 1, (1.0f - sweep.irradiance) * weights[i],
                     sweep.kappa + sweep.slope * (float(i - 1) - within)};
    return levels;
}

LobeReach lobe_reach(float lowest_roughness, float highest_roughness, bool four_levels) {
    const int first = int(std::floor(node_coordinates(1.0f, lowest_roughness).y));
    const int last = int(std::ceil(node_coordinates(1.0f, highest_roughness).y));
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (int k = first * kLobeTableSize; k < (last + 1) * kLobeTableSize; ++k) {
        for (const LobeNode& node : kNodes[k].by_reflectance) {
            const float ratio = four_levels ? node.four.log2_ratio : node.two.log2_ratio;
            low = std::min(low, ratio);
            high = std::max(high, ratio);
        }
    }
    // Four levels are the two around the middle and one more on either side.
    const float beside = four_levels ? 1.0f / brdf::kLevelsPerOctave : 0.0f;
    return {std::exp2(low - beside), std::exp2(high + beside)};
}

}  // namespace patina

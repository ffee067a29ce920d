// Finds the table of fitted lobes that comes nearest to the truth. Deterministic; knows no file.
#pragma once

#include "renderer/lobes/fit_light.h"
#include "renderer/lobes/lobe_table.h"

#include <functional>
#include <vector>

namespace patina::lobes {

struct FitSettings {
    int frames = 128;          ///< points and views each node is fitted on
    int truth_samples = 4096;  ///< of a lobe
    int passes = 26;           ///< over the table
    double smoothness = 1e-3;  ///< weight of the second differences between nodes
    std::function<void(const char* what, int step, int of, double error)> progress = [](auto...) {};
};

/// kLobeTableSize² nodes. Minimises the mean square relative error of P (brdf.glsl, 3) at F0 = 1, 0.2 and
/// 0.04 node by node (Levenberg and Marquardt), with a pull towards the mean of the neighbours, in
/// alternating passes. Each node is fitted at roughnesses spread over the distance between two levels, so
/// that it does not settle on one place between them.
std::vector<LobePair> fit_lobes(const FitLight& light, const FitSettings& settings);

/// What lobes are bent from: the mirrored viewer and the normal, both units, and the surface's roughness.
struct LobeView {
    glm::vec3 R, N;
    float roughness;
};

/// P of one point by a sweep; four: over four levels instead of two.
Lanes lobe_radiance(const FitLight& light, const LobeSweep& sweep, bool four, const LobeView& view);

}  // namespace patina::lobes

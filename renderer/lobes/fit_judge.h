// How far shading lies from the full integral: the unit sphere as the default camera sees it, lights
// included.
#pragma once

#include "renderer/lobes/fit_light.h"
#include "renderer/lobes/lobe_table.h"

#include <array>
#include <span>
#include <vector>

namespace patina::lobes {

enum class Method { SplitSum, TwoLevels, FourLevels };
inline constexpr int kMethods = 3;

/// Root mean squares of the relative error (x − t)/max(t, 10⁻³ · mean) over the sphere's pixels.
struct Judgement {
    float roughness = 0.0f;
    float reflectance = 0.0f;            ///< F0; the body's albedo is 0 (F0 = 1) or 0.8
    std::array<double, kMethods> rms{};  ///< over pixels and environments
    std::array<std::array<double, kLanes>, kMethods> rms_of{};  ///< of each environment
};

struct JudgeSettings {
    std::vector<float> roughness = {0.14f, 0.17f, 0.2f, 0.23f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.85f, 1.0f};
    int pixels = 500;
    int truth_samples = 32768;
};

std::vector<Judgement> judge(const FitLight& light, std::span<const LobePair> nodes,
                             const JudgeSettings& settings);

}  // namespace patina::lobes

// What would bring a render closer to its photo: roughness and base colour are moved, the view is drawn anew
// each time, and a parabola through the best trials says how far. A drawing a step, so that a window can go
// on in between.
#pragma once

#include "renderer/core/comparison.h"
#include "renderer/core/image.h"
#include "renderer/core/photo.h"
#include "renderer/renderer.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace patina {

/// Scene-linear radiance of a scene, exposure applied, of the photo's size in the view.
using ShootRadiance = std::function<Image(const Scene&)>;

/// What is added to the roughness, a trial each: the scene's light must serve all of them.
inline constexpr std::array kRoughnessTrials{-0.3f, -0.2f, -0.1f, -0.05f, 0.0f, 0.05f, 0.1f, 0.2f, 0.3f};

class HintSearch {
public:
    /// photo_in_view: 4 channels, as photo_in_view() makes it.
    HintSearch(Image photo_in_view, std::optional<Region> region, Scene scene);

    /// Draws one trial; false when none is left.
    bool step(const ShootRadiance& radiance);
    float done() const;  ///< share of the trials, 0…1
    /// One sentence each, best first; empty where nothing clearly helps.
    std::vector<std::string> sentences() const;

private:
    struct Planned {
        Material material;
        float offset = 0.0f;  ///< of roughness, or stops of the base colour
        bool color = false;
    };
    Image photo_;
    std::optional<Region> region_;
    Scene scene_;
    std::vector<Planned> planned_;
    std::size_t drawn_ = 0;
    std::array<std::vector<Trial>, 2> trials_;  ///< of roughness, of colour
};

/// All trials at once.
std::vector<std::string> hints_for(const Image& photo_in_view, const std::optional<Region>& region,
                                   const Scene& scene, const ShootRadiance& radiance);

}  // namespace patina

// Everything a picture without a window needs, in the order it must live.
#pragma once

#include "app/console.h"
#include "app/headless.h"
#include "app/jobs.h"
#include "app/scene_loader.h"

namespace patina {

struct Studio {
    HeadlessContext context;
    Renderer renderer;
    Jobs jobs{worker_count()};
    ProgressLine progress;
    SceneLoader loader;

    /// Says notes on standard error and shows progress where a person watches. mesh: one that will be asked
    /// for, begun before, since the driver takes as long to open as a mesh to be read.
    Studio(const Registry& registry, const SceneOptions& options, MeshAhead mesh = {});
    /// Drawn in parts where that takes less room. The reference says how well it is known.
    Image picture(Scene scene, glm::ivec2 size_px, bool radiance, Reuse reuse = Reuse::Within);

private:
    Image read(const RenderTarget& target, bool radiance);
    RenderTarget& target_of(glm::ivec2 size_px);
    TargetHandle draw_reference(const Scene& scene, glm::ivec2 size_px);
    TargetHandle target_;
    int samples_;   ///< points a pixel of the reference
    double error_;  ///< to what it is to be known; 0: whatever so many points give
};

/// What a picture's file says of itself.
ImageMetadata described(const std::string& what);

}  // namespace patina

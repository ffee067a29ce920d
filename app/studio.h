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

    /// Says notes on standard error and shows progress where a person watches.
    Studio(const Registry& registry, const SceneOptions& options);
    Image picture(const Scene& scene, RenderTarget& target, bool radiance);
};

/// What a picture's file says of itself.
ImageMetadata described(const std::string& what);

}  // namespace patina

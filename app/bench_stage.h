// What benchmarks draw with: in one process, without a window.
#pragma once

#include "app/headless.h"
#include "app/jobs.h"
#include "app/paths.h"
#include "app/scene_loader.h"
#include "renderer/renderer.h"

namespace patina {

struct BenchStage {
    HeadlessContext context;
    Renderer renderer;
    Jobs jobs{worker_count()};

    /// One that keeps light where the program keeps it. The stage must outlive it.
    SceneLoader loader(const Registry& registry) {
        return SceneLoader(
            renderer, registry,
            {.parallel_for = jobs.parallel_for(), .cache = {.folder = cache_folder() / "ibl"}});
    }
};

}  // namespace patina

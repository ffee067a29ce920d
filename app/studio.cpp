#include "app/studio.h"

#include "app/paths.h"
#include "app/program_store_io.h"
#include "renderer/core/format.h"
#include "renderer/reference.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

std::string percent(double share) { return formatted("%.2g %%", 100.0 * share); }

std::string confidence_text(const ReferenceProgress& progress, double wanted) {
    std::string text = "reference: " + std::to_string(progress.samples) + " samples a pixel";
    if (wanted > 0.0)
        text += " at most, " + std::to_string(std::lround(progress.mean_samples)) + " on average";
    text += "; 95 % half-width: median " + percent(progress.confidence->median) +
            ", 95 of 100 pixels below " + percent(progress.confidence->p95);
    if (wanted > 0.0 && !progress.converged)
        text += ": not the " + percent(wanted) + " asked for; allow more with --samples";
    return text;
}

}  // namespace

Studio::Studio(const Registry& registry, const SceneOptions& options)
    : loader(
          renderer, registry,
          {.parallel_for = jobs.parallel_for(),
           .cache = {.folder = cache_folder() / "ibl"},
           .allow_missing_maps = options.allow_missing_maps,
           .skip = options.skip,
           .note =
               [this](const std::string& sentence) {
                   progress.clear();
                   say(sentence);
               },
           .progress = [this](const std::string& what, float fraction) { progress.show(what, fraction); }}),
      samples_(options.samples),
      error_(options.error) {
    renderer.set_reuse(options.skip);
    if (options.skip) renderer.set_program_store(program_store_in(cache_folder() / "programs"));
}

TargetHandle Studio::draw_reference(const Scene& scene, glm::ivec2 size_px) {
    TargetHandle target = renderer.make_target(size_px, 1, TargetPrecision::Full);
    Reference reference(renderer, size_px, {.max_samples = samples_, .tolerance = error_});
    reference.restart(scene);
    while (!reference.progress().done) {
        reference.draw();
        progress.show("sampling the reference", reference.share_done());
    }
    progress.clear();
    if (reference.progress().confidence) say(confidence_text(reference.progress(), error_));
    reference.write(*target);
    return target;
}

Image Studio::picture(const Scene& scene, RenderTarget& target, bool radiance, Reuse reuse) {
    if (is_reference(scene.view)) {
        const TargetHandle reference = draw_reference(scene, Renderer::size_px(target));
        return radiance ? renderer.read_radiance(*reference) : renderer.read_display(*reference);
    }
    renderer.draw(scene, target, reuse);
    return radiance ? renderer.read_radiance(target) : renderer.read_display(target);
}

ImageMetadata described(const std::string& what) {
    return {{"Software", "Patina " PATINA_VERSION}, {"ImageDescription", what}};
}

}  // namespace patina

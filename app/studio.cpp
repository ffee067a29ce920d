#include "app/studio.h"

#include "app/paths.h"
#include "app/program_store_io.h"
#include "renderer/core/format.h"
#include "renderer/reference.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

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

Studio::Studio(const Registry& registry, const SceneOptions& options, MeshAhead mesh)
    : loader(
          renderer, registry,
          {.parallel_for = jobs.parallel_for(),
           .cache = {.folder = cache_folder() / "ibl"},
           .allow_missing_maps = options.allow_missing_maps,
           .mesh_ahead = std::move(mesh),
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

Image Studio::read(const RenderTarget& target, bool radiance) {
    return radiance ? renderer.read_radiance(target) : renderer.read_display(target);
}

/// The last one, where it fits.
RenderTarget& Studio::target_of(glm::ivec2 size_px) {
    if (!target_ || Renderer::size_px(*target_) != size_px) {
        target_ = nullptr;
        target_ = renderer.make_target(size_px);
    }
    return *target_;
}

Image Studio::picture(Scene scene, glm::ivec2 size_px, bool radiance, Reuse reuse) {
    if (is_reference(scene.view)) return read(*draw_reference(scene, size_px), radiance);
    Image whole = make_image(size_px.x, size_px.y, 3, radiance ? PixelType::F32 : PixelType::U8);
    const int rows = Renderer::rows_at_once(scene, size_px);
    // The last part is as high as the others, and drawn over one of them: one target serves all.
    const glm::ivec2 part_px{size_px.x, std::min(rows, size_px.y)};
    for (int top = size_px.y; top > 0; top -= rows) {
        const int bottom = std::max(top - part_px.y, 0);
        scene.crop = {size_px, {0, bottom}};
        RenderTarget& target = target_of(part_px);
        if (Renderer::size_px(target) != part_px)
            throw std::runtime_error("The graphics driver draws at most " +
                                     std::to_string(Renderer::size_px(target).x) +
                                     " pixels in a row: choose a smaller --size.");
        renderer.draw(scene, target, reuse);
        const Image part = read(target, radiance);
        const std::size_t row_bytes = part.bytes.size() / std::size_t(part.height);
        std::ranges::copy(
            part.bytes,
            whole.bytes.begin() + std::ptrdiff_t(row_bytes * std::size_t(size_px.y - bottom - part_px.y)));
    }
    return whole;
}

ImageMetadata described(const std::string& what) {
    return {{"Software", "Patina " PATINA_VERSION}, {"ImageDescription", what}};
}

}  // namespace patina

#include "app/studio.h"

#include "app/paths.h"

namespace patina {

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
           .progress = [this](const std::string& what, float fraction) { progress.show(what, fraction); }}) {}

Image Studio::picture(const Scene& scene, RenderTarget& target, bool radiance) {
    renderer.draw(scene, target);
    return radiance ? renderer.read_radiance(target) : renderer.read_display(target);
}

ImageMetadata described(const std::string& what) {
    return {{"Software", "Patina " PATINA_VERSION}, {"ImageDescription", what}};
}

}  // namespace patina

// A comparison drawn without a window: scenes of its views, and the labelled sheet.
#pragma once

#include "app/args.h"
#include "app/shoot.h"
#include "app/studio.h"
#include "renderer/core/comparison.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace patina {

/// Throws std::runtime_error when options say what a comparison file says itself (environments, camera, mesh,
/// …): only the size and --set go with one.
void require_own_settings(const SceneOptions& options, const std::string& file);

/// What a comparison's views need, loaded once, unless it was given.
class ComparisonScenes {
public:
    ComparisonScenes(Renderer& renderer, SceneLoader& loader, const Registry& registry,
                     const Comparison& comparison, SceneOptions options);

    /// That is what the view shows, camera and light included.
    void give(ViewPlace place, Scene scene) { given_.emplace_back(place, std::move(scene)); }
    void give_photo(const std::string& file, std::shared_ptr<const LoadedPhoto> photo) {
        photos_[file] = std::move(photo);
    }
    /// All pictures will be as large and show the views as they are: maps in that detail, and of the light
    /// what they look up. Else there are all maps and light, for pictures of any size and value.
    void expect(glm::ivec2 size_px);
    Scene scene(ViewPlace place);
    std::shared_ptr<const LoadedPhoto> photo(const std::string& file);
    /// Drawn there until the next picture of that size.
    const RenderTarget& draw(const Scene& scene, glm::ivec2 size_px);
    Image radiance(const Scene& scene, glm::ivec2 size_px);
    Image display(const Scene& scene, glm::ivec2 size_px);
    Renderer& renderer() { return renderer_; }

private:
    Reuse reuse() const;
    Scene unlit_scene(ViewPlace place);

    Renderer& renderer_;
    SceneLoader& loader_;
    const Registry& registry_;
    const Comparison& comparison_;
    SceneOptions options_;
    std::map<std::string, NeededLight> needed_;  ///< by environment, where it is known
    std::map<std::string, Scene> presets_;
    std::vector<std::pair<ViewPlace, Scene>> given_;
    std::map<std::string, std::shared_ptr<const LoadedPhoto>> photos_;
    std::map<std::pair<int, int>, TargetHandle> targets_;
};

struct ComparisonSheetOptions {
    glm::ivec2 cell_px{512};
    bool radiance = false;
    SceneOptions scene;
};
/// Rows of presets, columns of lightings; after a lighting with a photo that photo in the view's frame and
/// the difference. Further views follow, each with its own title.
Image draw_comparison_sheet(Studio& studio, const Registry& registry, const Comparison& comparison,
                            const ComparisonSheetOptions& options);

}  // namespace patina

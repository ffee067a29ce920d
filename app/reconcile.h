// Brings what the GPU holds to what the document wants: compares the two, starts what is missing on workers,
// stops what nobody wants any more, and keeps the last good picture until the new one is ready.
//
// Main thread only, with the renderer's context current. Knows no window and no interface.
#pragma once

#include "app/document.h"
#include "app/jobs.h"
#include "app/registry.h"
#include "app/watch.h"
#include "renderer/ibl/cache.h"
#include "renderer/map_detail.h"
#include "renderer/renderer.h"
#include "ui/panel_context.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina {

struct ReconcileOptions {
    BakeCache bakes;
    BakeSettings bake_settings = drawing_bake_settings();  ///< but for the levels, which the pictures choose
    bool skip = true;  ///< false: prepares what any picture could need, for comparison
    std::uint64_t map_bytes = std::uint64_t{1} << 30;  ///< kept on the GPU for switching back
    std::uint64_t mesh_bytes = std::uint64_t{512} << 20;
    std::uint64_t environment_bytes = std::uint64_t{256} << 20;
    double upload_budget_s = 0.004;  ///< per update(); one upload is always made
    std::function<void(ui::Severity, const std::string&)> log = [](ui::Severity, const std::string&) {};
};

/// How often what was wanted had to be made or was still there: a test's view of the memory.
struct ReconcileCounts {
    int environments_baked = 0, environments_from_disk = 0, environments_from_memory = 0;
    int first_lights = 0, levels_baked = 0, irradiances_baked = 0;
    int maps_loaded = 0, maps_from_memory = 0;
    int meshes_loaded = 0, meshes_from_memory = 0;
};

/// What one picture is made of. The document's is the first; a sheet of views has more.
struct WantedPicture {
    Material material;  ///< maps by full path
    std::string mesh, environment;
    View view;    ///< decides what of the light is looked up,
    Sight sight;  ///< and this the detail of maps
    std::span<const float> roughness_trials =
        {};  ///< what else may be added to the roughness: light for that
};
inline constexpr std::size_t kMaxFurtherPictures = 16;

class Reconciler {
public:
    Reconciler(Renderer& renderer, const Registry& registry, Jobs& jobs, ReconcileOptions options);
    ~Reconciler();
    Reconciler(const Reconciler&) = delete;
    Reconciler& operator=(const Reconciler&) = delete;

    /// Compares and starts; also does a share of the waiting uploads. opened counts documents opened: while
    /// another one's maps load, the whole old picture stays. True if there is more to upload: call again
    /// soon.
    /// sight: how large the picture is seen, which the detail of maps follows. further: beside the document's
    /// picture, at most kMaxFurtherPictures; they share what they have in common.
    bool update(const Document& document, std::uint64_t opened, const Sight& sight = {},
                std::span<const WantedPicture> further = {});

    /// The last complete picture. Without light and mesh yet (the very first moments) nothing can be drawn.
    Scene scene(const Camera& camera, const View& view) const;
    /// The same to be drawn larger: maps that are not fine enough for that are read again at once.
    Scene detailed_scene(const Camera& camera, const View& view, int height_px) const;
    bool drawable() const;
    /// Likewise of a further picture; what is broken there says why.
    Scene scene_of(std::size_t further, const Camera& camera, const View& view) const;
    bool drawable(std::size_t further) const;
    std::string error_of(std::size_t further) const;
    bool pending() const;  ///< something wanted is not shown yet and has not failed

    const std::array<ui::MapStatus, kMapSlots>& maps() const;
    const ui::MeshInfo& mesh_info() const;
    const ui::EnvironmentInfo& environment_info() const;
    const ReconcileCounts& counts() const;

    /// The id whose picture is shown if the wanted one could not be had ("" if none is shown yet); empty
    /// while all is well.
    std::optional<std::string> fallback_environment() const;
    std::optional<std::string> fallback_mesh() const;

    /// Files that were read since this was last asked for, and how they looked just before.
    std::vector<std::pair<std::string, FileStamp>> take_files_read();
    /// Reads it again: it changed on disk, or the artist asked.
    void reload(const std::string& file);
    /// Ends a load; what was wanted counts as failed. False if the job is none of these.
    bool cancel(Jobs::Id job);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace patina

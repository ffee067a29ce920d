// What a Reconciler holds and is about to hold: shared by the file that compares and presents (reconcile.cpp)
// and the one that starts and takes jobs (reconcile_start.cpp). Nobody else includes it.
#pragma once

#include "app/reconcile.h"
#include "app/reconcile_light.h"
#include "app/reconcile_load.h"
#include "app/reconcile_supply.h"

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace patina {

struct HeldMap {
    MapHandle handle;
    MapHandle thumbnail;
    ui::MapStatus status;  ///< of a loaded map; without a texture id
    int side = 0;          ///< texels of the finest level that was asked for; 0: all are there
};
struct HeldMesh {
    MeshHandle handle;
    std::shared_ptr<const Mesh> mesh;  ///< for adding tangents later
    float uv_stretch = 0.0f;
    ui::MeshInfo info;
};
struct HeldEnvironment {
    EnvironmentHandle handle;
    std::shared_ptr<const HeldLight> light;
    ui::EnvironmentInfo info;
};

/// Of a mesh's key: the mesh is wanted with tangents.
inline constexpr char kTangentMark = 't';
inline bool wants_tangents(const std::string& mesh_key) {
    return !mesh_key.empty() && mesh_key.back() == kTangentMark;
}

struct Reconciler::State {
    Renderer& renderer;
    const Registry& registry;
    Jobs& jobs;
    ReconcileOptions options;

    Supply<HeldMap> maps;
    Supply<HeldMesh> meshes;
    Supply<HeldEnvironment> environments;
    MapHandle placeholder;
    MapHandle placeholder_thumbnail;
    std::deque<std::function<bool()>> uploads;  ///< each does a portion; true when it is done
    std::map<std::string, int> versions;        ///< of files: how often they were read again
    std::vector<std::pair<std::string, FileStamp>> files_read;
    ReconcileCounts counts;
    std::map<std::string, LightOrder> light_orders;  ///< of what is wanted, by key
    std::map<std::string, MapRequest> map_requests;  ///< likewise

    /// What was complete last, and which documents' it was.
    struct Picture {
        Material material;
        std::array<MapHandle, kMapSlots> handles;
        std::uint64_t opened = 0;
        bool presented = false;
    };
    std::vector<Picture> pictures{1 + kMaxFurtherPictures};  ///< the document's first
    std::array<ui::MapStatus, kMapSlots> status;
    ui::MeshInfo no_mesh;
    ui::EnvironmentInfo no_environment;

    static std::size_t map_slot(std::size_t picture, int slot) {
        return picture * std::size_t(kMapSlots) + std::size_t(slot);
    }
    std::string versioned(const std::string& id) const {
        const auto found = versions.find(id);
        return id + kVersionMark + std::to_string(found == versions.end() ? 0 : found->second);
    }
    void want(std::size_t picture, const WantedPicture& wanted);
    void want_light(std::span<const WantedPicture* const> wanted);
    void want_nothing(std::size_t picture);
    std::string want_map(MapRequest request, int finest_side);
    int visible_side(std::size_t picture, const Material& wanted, const Sight& seen) const;
    bool has_map(std::size_t slot) const;
    std::optional<NeededLight> needed_by(std::size_t picture, const WantedPicture& wanted) const;
    std::string light_key(const std::string& environment, const std::optional<NeededLight>& needed);
    void start_missing();
    Jobs::Id start_map(const std::string& key, const MapRequest& request);
    void finish_map(const std::string& key, HeldMap held, std::uint64_t bytes);
    Jobs::Id start_mesh(const std::string& key);
    Jobs::Id start_environment(const std::string& key);
    void keep(const LightOrder& order, const ReadyLight& ready) const;
    void count_light(const LightOrder& order, const ReadyLight& ready);
    void take_light(const std::string& key, const ReadyLight& light, EnvironmentHandle handle,
                    std::uint64_t bytes);
    template <class T, class Ready, class Input, class Finished>
    void expect(Supply<T>& supply, const std::string& key, std::shared_ptr<Ready> ready,
                std::shared_ptr<const Input> input, Finished finished);
    void let_go(std::shared_ptr<const void> large) const;
    template <class T>
    std::function<void(const std::string&)> when_failed(Supply<T>& supply, const std::string& key,
                                                        const std::shared_ptr<FileStamp>& stamp);
    void note(const std::string& id, const std::vector<std::string>& notes) const;
    bool slot_ready(std::size_t picture, const Material& material, int slot) const;
    bool light_ready(std::size_t picture) const;
    MapHandle handle_for(std::size_t picture, const Material& material, int slot) const;
    void present(std::size_t picture, const Material& material, std::uint64_t opened_now);
    Scene scene(std::size_t picture, const Camera& camera, const View& view) const;
    bool drawable(std::size_t picture) const;
    void report(const Document& document);
    bool run_uploads();
};

}  // namespace patina

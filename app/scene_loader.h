// From names to a scene the renderer can draw, on the calling thread but for what options share out: what the
// commands use. Whatever was loaded once is kept and shared by everything that names it again.
#pragma once

#include "app/args.h"
#include "app/reconcile_light.h"
#include "app/registry.h"
#include "renderer/map_detail.h"
#include "renderer/needed_light.h"
#include "renderer/renderer.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <tuple>
#include <vector>

namespace patina {

/// A map that a material names: which file, and how its numbers are meant.
struct MapSource {
    MapSlot slot = MapSlot::Albedo;
    std::string text;            ///< as the preset writes it
    std::filesystem::path file;  ///< empty where the text names no file (a web address)
    MapKind kind = MapKind::Data;
    ColorSpace color_space = ColorSpace::Linear;
};
/// One row a slot that names a map. preset_file is what relative paths are relative to.
std::vector<MapSource> map_sources(const Material& material, const std::filesystem::path& preset_file);
/// Decodes it; throws std::runtime_error with one sentence that names the map.
LoadedImage load_map(const Registry& registry, const MapSource& source);

/// A mesh that is read while something else goes on. One that nobody takes is not read to its end.
class MeshAhead {
public:
    MeshAhead() = default;
    /// The registry must outlive it.
    MeshAhead(const Registry& registry, std::string id);
    ~MeshAhead() { stop_.request_stop(); }
    MeshAhead(MeshAhead&&) = default;
    MeshAhead(const MeshAhead&) = delete;
    MeshAhead& operator=(const MeshAhead&) = delete;
    MeshAhead& operator=(MeshAhead&&) = delete;
    bool is_of(const std::string& id) const { return wait_ && id == id_; }
    /// Once; throws what reading it threw.
    Mesh take();

private:
    std::string id_;
    std::shared_ptr<Mesh> mesh_;
    std::stop_source stop_;
    std::function<void()> wait_;
};

class SceneLoader {
public:
    struct Options {
        ParallelFor parallel_for = serial_for;
        BakeCache cache;
        bool allow_missing_maps = false;
        MeshAhead mesh_ahead = {};  ///< if that one is asked for
        bool skip = true;           ///< false: prepares what any picture could need, for comparison
        std::function<void(const std::string&)> note = [](const std::string&) {};  ///< one sentence each
        std::function<void(const std::string& what, float fraction)> progress = [](const std::string&,
                                                                                   float) {};
    };
    SceneLoader(Renderer& renderer, const Registry& registry, Options options);

    /// Throw std::runtime_error with one sentence.
    EnvironmentHandle environment(const std::string& id, const NeededLight& needed = all_light());
    MeshHandle mesh(const std::string& id, bool with_tangents);
    /// Material, its maps and the mesh it is put on; the rest of the scene is left to the caller.
    Scene scene(const std::string& preset, const SceneOptions& options);
    /// What a loaded scene's picture looks up; nothing stands in for a reference.
    NeededLight needed_light(const Scene& scene) const;

private:
    struct Light {
        NeededLight needed;  ///< by all that asked for it
        std::shared_ptr<const HeldLight> held;
        EnvironmentHandle handle;
    };
    struct Map {
        MapHandle handle;
        int side = 0;  ///< texels of the finest level that was asked for; 0: all
    };
    struct LoadedMesh {
        MeshHandle handle;
        float uv_stretch = 0.0f;
    };
    /// On its way from the file to the GPU.
    struct ReadMap {
        MapLevels levels;
        std::vector<std::string> notes;
        WorkLedger work;
        std::string error;  ///< if it cannot be had
    };
    using MapKey = std::tuple<std::string, MapKind, ColorSpace, int>;  ///< last: the slot, if not shared
    LoadedMesh& loaded_mesh(const std::string& id, bool with_tangents);
    void finish(ReadMap& read) const;
    ReadMap read_map(const MapSource& source, int side) const;
    ReadMap read_or_replaced(const MapSource& source, const std::string& preset, int side) const;
    MapKey key_of(const MapSource& source) const;
    void load_maps(const std::vector<MapSource>& sources, const std::string& preset, int side);
    void keep_map(const MapSource& source, const ReadMap& read, int side);

    Renderer& renderer_;
    const Registry& registry_;
    Options options_;
    std::map<std::string, Light> lights_;
    std::map<std::pair<std::string, bool>, LoadedMesh> meshes_;
    std::map<MapKey, Map> maps_;
};

}  // namespace patina

#include "app/scene_loader.h"

#include "app/jobs.h"
#include "app/stats.h"
#include "materials/material_io.h"
#include "materials/params.h"
#include "materials/text_io.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace patina {

namespace fs = std::filesystem;

std::vector<MapSource> map_sources(const Material& material, const fs::path& preset_file) {
    std::vector<MapSource> sources;
    const auto add = [&](MapSlot slot, const std::string& map, ColorSpace space = ColorSpace::Linear) {
        if (!map.empty())
            sources.push_back({slot, map, resolve_map(preset_file, map), map_kind(slot), space});
    };
    add(MapSlot::Albedo, material.albedo.map, material.albedo.color_space);
    add(MapSlot::Roughness, material.roughness.map);
    add(MapSlot::Metallic, material.metallic.map);
    add(MapSlot::Ao, material.ao.map);
    add(MapSlot::Normal, material.normal.map);
    add(MapSlot::Emission, material.emission.map, material.emission.color_space);
    return sources;
}

namespace {

void require_file(const MapSource& source) {
    if (source.file.empty())
        throw std::runtime_error(
            "the map '" + source.text +
            "' is a web address, which is never fetched; save the picture beside the preset");
}

}  // namespace

LoadedImage load_map(const Registry& registry, const MapSource& source) {
    require_file(source);
    return import_image(registry, source.file);
}

namespace {

struct FoundMaterial {
    Material material;
    fs::path file;  ///< empty for the default material
};
FoundMaterial material_of(const std::string& preset, const SceneOptions& options,
                          const std::function<void(const std::string&)>& note) {
    FoundMaterial found;
    if (preset != "-") {
        found.file = find_preset(preset);
        LoadedMaterial loaded = load_material(found.file);
        const std::string about = preset + ": ";
        for (const std::string& each : loaded.notes) note(about + each);
        found.material = std::move(loaded.material);
    }
    for (const auto& [key, value] : options.overrides) set_parameter(found.material, key, value);
    return found;
}

}  // namespace

MeshAhead::MeshAhead(const Registry& registry, std::string id)
    : id_(std::move(id)), mesh_(std::make_shared<Mesh>()) {
    wait_ = begin_beside([&registry, id = id_, mesh = mesh_, stop = stop_.get_token()] {
        *mesh = load_mesh_part(registry, id, stop);
    });
}

Mesh MeshAhead::take() {
    std::exchange(wait_, {})();
    return std::move(*mesh_);
}

SceneLoader::SceneLoader(Renderer& renderer, const Registry& registry, Options options)
    : renderer_(renderer), registry_(registry), options_(std::move(options)) {}

namespace {

/// What it serves, without its texels: they are on the GPU, and in the cache folder.
std::shared_ptr<const HeldLight> without_texels(const HeldLight& held) {
    auto light = std::make_shared<HeldLight>();
    light->is_whole = held.is_whole;
    light->exact.irradiance.size = held.exact.irradiance.size;
    for (const PrefilteredLevel& level : held.exact.levels)
        light->exact.levels.push_back({.roughness = level.roughness, .cube = {.size = level.cube.size}});
    return light;
}

}  // namespace

EnvironmentHandle SceneLoader::environment(const std::string& id, const NeededLight& needed) {
    Light& light = lights_[id];
    const NeededLight wanted = options_.skip ? combined(light.needed, needed) : all_light();
    if (light.held && serves(*light.held, wanted)) return light.handle;
    light.needed = wanted;
    options_.progress("loading " + id, 0.0f);
    const BakeControl control{
        .parallel_for = options_.parallel_for,
        .progress = [&](float fraction) { options_.progress("baking " + id, fraction); },
        .stop = {}};
    const LightOrder order{.id = id, .needed = wanted, .skip = options_.skip};
    const std::optional<ReadyLight> ready =
        get_light(registry_, order, drawing_bake_settings(), options_.cache, control);
    if (!ready) throw std::runtime_error(id + ": the bake was stopped");
    const std::string about = id + ": ";
    for (const std::string& note : ready->notes) options_.note(about + note);
    count_light(renderer_.work(), order, *ready);
    light.held = options_.skip ? without_texels(*ready->held) : ready->held;
    light.handle = Renderer::begin_upload(ready->light).finish();
    const std::string why_not = keep_light(registry_, order, *ready, *ready->light, options_.cache);
    if (!why_not.empty()) options_.note(why_not);
    return light.handle;
}

MeshHandle SceneLoader::mesh(const std::string& id, bool with_tangents) {
    return loaded_mesh(id, with_tangents).handle;
}

SceneLoader::LoadedMesh& SceneLoader::loaded_mesh(const std::string& id, bool with_tangents) {
    if (const auto more = meshes_.find({id, true});
        !with_tangents && more != meshes_.end() && more->second.handle) {
        ++renderer_.work().meshes_from_memory;
        return more->second;  // tangents that nothing reads change no picture
    }
    LoadedMesh& loaded = meshes_[{id, with_tangents}];
    if (loaded.handle) return loaded;
    MeshAhead& ahead = options_.mesh_ahead;
    Mesh mesh = ahead.is_of(id) ? ahead.take() : load_mesh_part(registry_, id);
    const std::string about = id + ": ";
    for (const std::string& note : mesh.notes) options_.note(about + note);
    const bool make = with_tangents && !mesh.has_tangents;
    if (make) make_tangents(mesh);
    count_mesh(renderer_.work(), mesh, make);
    loaded.uv_stretch = uv_stretch(mesh);
    loaded.handle = renderer_.upload_mesh(mesh);
    return loaded;
}

/// What is known of the map once all of it is there.
void SceneLoader::finish(ReadMap& read) const {
    if (options_.skip) read.levels.ranges = channel_ranges(read.levels);
    const bool single = options_.skip && keep_one_texel_of_constant(read.levels);
    count_upload(read.work, read.levels, single);
}

/// Row by row; whole where nothing is to be skipped. From any thread.
SceneLoader::ReadMap SceneLoader::read_map(const MapSource& source, int side) const {
    require_file(source);
    MapMaker maker(source.kind, source.color_space, side);
    const ImageRows rows{.begin = [&](const Image& shape) { maker.begin(shape); },
                         .row = [&](const std::byte* row) { maker.row(row); }};
    LoadedImage whole;
    if (options_.skip) {
        whole.notes = import_image_rows(registry_, source.file, rows);
    } else {
        whole = import_image(registry_, source.file);
        give_rows(whole.image, rows);
    }
    ReadMap read;
    for (const std::string& note : whole.notes)
        read.notes.push_back(path_to_utf8(source.file.filename()) + ": " + note);
    count_reading(read.work, maker, whole.image.bytes.size());
    read.levels = maker.take();
    finish(read);
    return read;
}

/// A checkerboard where it cannot be read and that is allowed.
SceneLoader::ReadMap SceneLoader::read_or_replaced(const MapSource& source, const std::string& preset,
                                                   int side) const {
    try {
        return read_map(source, side);
    } catch (const std::runtime_error& error) {
        ReadMap read;
        if (!options_.allow_missing_maps) {
            read.error =
                preset + ": " + error.what() + " (--allow-missing-maps draws a checkerboard in its place)";
            return read;
        }
        read.notes.push_back(preset + ": " + error.what());
        read.levels = make_map_levels(make_placeholder_map(), source.kind, source.color_space, side);
        finish(read);
        return read;
    }
}

namespace {

constexpr int kLargestSideBeside = 2048;  ///< of maps that are read beside each other

/// By their files: no thread is left with a large one alone.
std::vector<std::size_t> largest_first(const std::vector<const MapSource*>& maps) {
    std::vector<std::uintmax_t> bytes;
    for (const MapSource* map : maps) {
        std::error_code ignored;
        const std::uintmax_t size = fs::file_size(map->file, ignored);
        bytes.push_back(ignored ? 0 : size);
    }
    std::vector<std::size_t> order(maps.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater<>{}, [&](std::size_t i) { return bytes[i]; });
    return order;
}

}  // namespace

SceneLoader::MapKey SceneLoader::key_of(const MapSource& source) const {
    return {path_to_utf8(source.file), source.kind, source.color_space,
            options_.skip ? -1 : int(source.slot)};
}

/// Those that are not there yet.
void SceneLoader::load_maps(const std::vector<MapSource>& sources, const std::string& preset, int side) {
    std::vector<const MapSource*> missing;
    const auto is_missing = [&](const MapKey& key) {
        return std::ranges::any_of(missing, [&](const MapSource* each) { return key_of(*each) == key; });
    };
    for (const MapSource& source : sources) {
        const Map& map = maps_[key_of(source)];
        const bool is_there = map.handle && (map.side == 0 || (side > 0 && map.side >= side));
        if (is_there || is_missing(key_of(source)))
            ++renderer_.work().maps_from_memory;
        else
            missing.push_back(&source);
    }
    if (missing.empty()) return;
    options_.progress("loading maps of " + preset, 0.0f);
    // Of large ones, several at once take too much room.
    if (side == 0 || side > kLargestSideBeside) {
        for (const MapSource* source : missing)
            keep_map(*source, read_or_replaced(*source, preset, side), side);
        return;
    }
    std::vector<ReadMap> read(missing.size());
    const std::vector<std::size_t> order = largest_first(missing);
    options_.parallel_for(int(order.size()), [&](int i) {
        const std::size_t at = order[std::size_t(i)];
        read[at] = read_or_replaced(*missing[at], preset, side);
    });
    for (std::size_t i = 0; i < read.size(); ++i) {
        keep_map(*missing[i], read[i], side);
        read[i] = {};
    }
}

void SceneLoader::keep_map(const MapSource& source, const ReadMap& read, int side) {
    if (!read.error.empty()) throw std::runtime_error(read.error);
    for (const std::string& note : read.notes) options_.note(note);
    add(renderer_.work(), read.work);
    Map& map = maps_[key_of(source)];
    map.side = side;
    map.handle = renderer_.upload_map(read.levels);
    if (const std::string& note = Renderer::note_of(*map.handle); !note.empty())
        options_.note(path_to_utf8(source.file.filename()) + ": " + note);
}

Scene SceneLoader::scene(const std::string& preset, const SceneOptions& options) {
    Scene scene{.camera = options.camera, .view = options.view};
    const auto [material, file] = material_of(preset, options, options_.note);
    const LoadedMesh& mesh = loaded_mesh(options.mesh, !material.normal.map.empty() || !options_.skip);
    scene.mesh = mesh.handle;
    const Sight sight{options.camera, options_.skip ? options.size_px.y : 0};
    const int side = visible_map_side(mesh.uv_stretch, material.uv.scale, sight);
    const std::vector<MapSource> sources = map_sources(material, file);
    load_maps(sources, preset, side);
    for (const MapSource& source : sources)
        scene.maps[std::size_t(source.slot)] = maps_[key_of(source)].handle;
    scene.material = material;
    if (!options_.skip) return scene;
    Collapsed simpler = collapsed(material, Renderer::ranges_of(scene));
    scene.material = std::move(simpler.material);
    for (std::size_t slot = 0; slot < scene.maps.size(); ++slot)
        if (simpler.slots[slot]) scene.maps[slot] = nullptr;
    return scene;
}

NeededLight SceneLoader::needed_light(const Scene& scene) const {
    View view = scene.view;
    if (is_reference(view)) view.debug = DebugView::Emission;  // it samples the panorama itself
    return patina::needed_light(scene.material, Renderer::ranges_of(scene), view);
}

}  // namespace patina

#include "app/reconcile.h"

#include "app/reconcile_state.h"
#include "materials/params.h"
#include "materials/text_io.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace patina {

namespace {
using Clock = std::chrono::steady_clock;

/// Which pixels a slot's file becomes: the same file may be wanted as colour and as data.
std::string map_key(const std::string& versioned_file, const MapRequest& request) {
    const char* kind = request.kind == MapKind::Normal           ? " normal"
                       : request.kind == MapKind::Data           ? " data"
                       : request.color_space == ColorSpace::Srgb ? " srgb"
                                                                 : " linear";
    return versioned_file + kind;
}
}  // namespace

void Reconciler::State::want(std::size_t picture, const WantedPicture& wanted) {
    const int finest_side = visible_side(picture, wanted.material, wanted.sight);
    for (int i = 0; i < kMapSlots; ++i) {
        const MapRequest request = map_request(wanted.material, MapSlot(i));
        maps.want(map_slot(picture, i),
                  request.file.empty() ? std::string{} : want_map(request, finest_side));
    }
    const bool tangents = !wanted.material.normal.map.empty();
    meshes.want(picture, versioned(wanted.mesh) + (tangents || !options.skip ? " t" : ""));
}

void Reconciler::State::want_nothing(std::size_t picture) {
    for (int i = 0; i < kMapSlots; ++i) maps.want(map_slot(picture, i), {});
    meshes.want(picture, {});
    environments.want(picture, {});
    pictures[picture] = {};
}

/// Of a material's maps on the mesh that is shown.
int Reconciler::State::visible_side(std::size_t picture, const Material& wanted, const Sight& seen) const {
    const auto& mesh = meshes.slot(picture).value;
    return visible_map_side(mesh ? mesh->uv_stretch : kUsualUvStretch, wanted.uv.scale,
                            options.skip ? seen : Sight{});
}

/// The key of what is there if it is fine enough.
std::string Reconciler::State::want_map(MapRequest request, int finest_side) {
    request.finest_side = finest_side;
    const std::string map = map_key(versioned(request.file), request);
    std::string at_hand;
    maps.visit([&](const std::string& key, const HeldMap& held) {
        const bool fine = held.side == 0 || (request.finest_side > 0 && held.side >= request.finest_side);
        if (fine && map_of_key(key) == map) at_hand = key;
    });
    if (!at_hand.empty()) return at_hand;
    std::string key = map + kDetailMark + std::to_string(request.finest_side);
    map_requests[key] = request;
    return key;
}

/// The wanted map is shown, if perhaps not yet in the detail wanted.
bool Reconciler::State::has_map(std::size_t slot) const {
    const auto& [keys, value, error] = maps.slot(slot);
    return value && !keys.wanted.empty() && map_of_key(keys.shown) == map_of_key(keys.wanted);
}

/// Not known before the maps are there that tell it.
std::optional<NeededLight> Reconciler::State::needed_by(std::size_t picture,
                                                        const WantedPicture& wanted) const {
    if (!options.skip) return all_light();
    MapRanges known;
    for (const MapSlot slot : {MapSlot::Roughness, MapSlot::Metallic, MapSlot::Normal}) {
        const std::size_t at = map_slot(picture, int(slot));
        const auto& [keys, value, error] = maps.slot(at);
        if (keys.wanted.empty()) continue;
        if (!keys.ready() && !has_map(at)) return std::nullopt;
        known[std::size_t(slot)] = has_map(at) ? Renderer::ranges_of(*value->handle) : ChannelRanges{};
    }
    NeededLight needed = needed_light(wanted.material, known, wanted.view);
    Material moved = wanted.material;
    for (const float offset : wanted.roughness_trials) {
        moved.roughness.value = std::clamp(wanted.material.roughness.value + offset, 0.0f, 1.0f);
        needed = combined(needed, needed_light(moved, known, wanted.view));
    }
    return needed;
}

/// Pictures under one environment want one light, which has what any of them looks up.
void Reconciler::State::want_light(std::span<const WantedPicture* const> wanted) {
    std::map<std::string, std::optional<NeededLight>> needed;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        std::optional<NeededLight>& all = needed[wanted[i]->environment];
        const std::optional<NeededLight> own = needed_by(i, *wanted[i]);
        if (own) all = all ? combined(*all, *own) : own;
    }
    light_orders.clear();
    std::map<std::string, std::string> keys;
    for (const auto& [environment, all] : needed) keys[environment] = light_key(environment, all);
    for (std::size_t i = 0; i < wanted.size(); ++i) environments.want(i, keys[wanted[i]->environment]);
}

std::string Reconciler::State::light_key(const std::string& environment,
                                         const std::optional<NeededLight>& needed) {
    const std::string base = versioned(environment);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const std::string& loading = environments.slot(i).keys.loading;
        if (base_of(loading) == base) return loading;  // what a slider passed is found when it is there
    }
    std::vector<LightAtHand> at_hand;
    environments.visit([&](const std::string& key, const HeldEnvironment& held) {
        if (base_of(key) == base) at_hand.push_back({key, held.light, held.handle});
    });
    LightWish wish = wish_for_light(
        {.id = environment, .needed = needed, .first_light = options.skip, .skip = options.skip}, base,
        at_hand, options.bake_settings);
    if (wish.order) light_orders[wish.key] = std::move(*wish.order);
    return wish.key;
}

void Reconciler::State::start_missing() {
    const auto stop = [this](Jobs::Id id) { jobs.stop(id); };
    const ReconcileCounts before = counts;
    counts.environments_from_memory +=
        environments.update([this](const std::string& key) { return start_environment(key); }, stop);
    counts.meshes_from_memory +=
        meshes.update([this](const std::string& key) { return start_mesh(key); }, stop);
    counts.maps_from_memory +=
        maps.update([this](const std::string& key) { return start_map(key, map_requests.at(key)); }, stop);
    WorkLedger& work = renderer.work();
    work.bakes_from_memory +=
        std::uint64_t(counts.environments_from_memory - before.environments_from_memory);
    work.meshes_from_memory += std::uint64_t(counts.meshes_from_memory - before.meshes_from_memory);
    work.maps_from_memory += std::uint64_t(counts.maps_from_memory - before.maps_from_memory);
}

bool Reconciler::State::slot_ready(std::size_t picture, const Material& material, int slot) const {
    const std::size_t at = map_slot(picture, slot);
    if (!maps.slot(at).keys.ready() && !has_map(at)) return false;
    // A normal map is shaded along tangents: it waits for a mesh that has them.
    const bool needs_tangents = MapSlot(slot) == MapSlot::Normal && !material.normal.map.empty();
    const SlotKeys& mesh = meshes.slot(picture).keys;
    return !needs_tangents || mesh.ready() || wants_tangents(mesh.shown);
}

/// Unless levels are being added to what is shown; other light takes longer, and the picture does not wait.
bool Reconciler::State::light_ready(std::size_t picture) const {
    const SlotKeys& keys = environments.slot(picture).keys;
    return keys.ready() || base_of(keys.wanted) != base_of(keys.shown);
}

/// The wanted map; the last good one of the same file while that is broken; else the placeholder.
MapHandle Reconciler::State::handle_for(std::size_t picture, const Material& material, int slot) const {
    const auto& [keys, value, error] = maps.slot(map_slot(picture, slot));
    if (keys.wanted.empty()) return {};
    if (has_map(map_slot(picture, slot))) return value->handle;
    const bool same_file = value && id_of(keys.shown) == *map_of(material, MapSlot(slot)).map;
    return same_file ? value->handle : placeholder;
}

void Reconciler::State::present(std::size_t index, const Material& wanted, std::uint64_t opened_now) {
    Picture& picture = pictures[index];
    std::array<bool, kMapSlots> ready;
    for (int i = 0; i < kMapSlots; ++i) ready[i] = slot_ready(index, wanted, i);
    const bool all =
        light_ready(index) && std::all_of(ready.begin(), ready.end(), [](bool each) { return each; });
    if (!all && picture.presented && opened_now != picture.opened)
        return;  // another document: all or nothing
    Material next = wanted;
    for (int i = 0; i < kMapSlots; ++i) {
        if (ready[i])
            picture.handles[i] = handle_for(index, wanted, i);
        else
            copy_slot(picture.material, next, MapSlot(i));
    }
    picture.material = std::move(next);
    picture.presented = true;
    picture.opened = opened_now;
}

Scene Reconciler::State::scene(std::size_t index, const Camera& camera, const View& view) const {
    const Picture& picture = pictures[index];
    Scene scene{.maps = picture.handles, .material = picture.material, .camera = camera, .view = view};
    if (options.skip) {
        const Collapsed simpler = collapsed(picture.material, Renderer::ranges_of(scene));
        scene.material = simpler.material;
        for (int i = 0; i < kMapSlots; ++i)
            if (simpler.slots[i]) scene.maps[i] = nullptr;
    }
    if (const auto& light = environments.slot(index).value) scene.environment = light->handle;
    if (const auto& mesh = meshes.slot(index).value) scene.mesh = mesh->handle;
    return scene;
}

bool Reconciler::State::drawable(std::size_t picture) const {
    return environments.slot(picture).value && meshes.slot(picture).value && pictures[picture].presented;
}

void Reconciler::State::report(const Document& document) {
    for (int i = 0; i < kMapSlots; ++i) {
        const auto& [keys, value, error] = maps.slot(i);
        ui::MapStatus next;
        if (keys.wanted.empty()) {
            status[i] = {};
            continue;
        }
        const bool loaded = has_map(std::size_t(i));
        if (loaded) next = value->status;
        next.full_path = *map_of(document.material, MapSlot(i)).map;
        if (loaded) {
            next.thumbnail = Renderer::texture_of(*value->thumbnail);
        } else if (keys.wanted == keys.failed) {
            std::error_code ignored;
            const bool there = std::filesystem::exists(utf8_to_path(next.full_path), ignored);
            next.state = there ? ui::MapState::Broken : ui::MapState::Missing;
            next.message = error;
            next.thumbnail = Renderer::texture_of(*placeholder_thumbnail);
        } else {
            next.state = ui::MapState::Loading;
        }
        status[i] = std::move(next);
    }
}

bool Reconciler::State::run_uploads() {
    const auto begin = Clock::now();
    const std::chrono::duration<double> budget(options.upload_budget_s);
    while (!uploads.empty() && Clock::now() - begin < budget)
        if (uploads.front()()) uploads.pop_front();
    return !uploads.empty();
}

Reconciler::Reconciler(Renderer& renderer, const Registry& registry, Jobs& jobs, ReconcileOptions options)
    : state_(new State{.renderer = renderer,
                       .registry = registry,
                       .jobs = jobs,
                       .options = options,
                       .maps = {kMapSlots * (1 + kMaxFurtherPictures), options.map_bytes},
                       .meshes = {1 + kMaxFurtherPictures, options.mesh_bytes},
                       .environments = {1 + kMaxFurtherPictures, options.environment_bytes}}) {
    const Image picture = make_placeholder_map();
    state_->placeholder = renderer.upload_map(make_map_levels(picture, MapKind::Color, ColorSpace::Srgb));
    state_->placeholder_thumbnail = renderer.upload_thumbnail(picture);
}

Reconciler::~Reconciler() = default;

bool Reconciler::update(const Document& document, std::uint64_t opened, const Sight& sight,
                        std::span<const WantedPicture> further) {
    const bool more = state_->run_uploads();
    const std::size_t count = std::min(further.size(), kMaxFurtherPictures);
    const WantedPicture own{document.material, document.mesh, document.environment, document.view, sight};
    std::vector<const WantedPicture*> wanted{&own};
    for (std::size_t i = 0; i < count; ++i) wanted.push_back(&further[i]);
    state_->map_requests.clear();
    for (std::size_t i = 0; i < 1 + kMaxFurtherPictures; ++i)
        i < wanted.size() ? state_->want(i, *wanted[i]) : state_->want_nothing(i);
    state_->want_light(wanted);
    state_->start_missing();
    for (std::size_t i = 0; i < wanted.size(); ++i)
        state_->present(i, wanted[i]->material, i == 0 ? opened : 0);
    state_->report(document);
    return more;
}

Scene Reconciler::scene(const Camera& camera, const View& view) const {
    return state_->scene(0, camera, view);
}
Scene Reconciler::scene_of(std::size_t further, const Camera& camera, const View& view) const {
    return state_->scene(1 + further, camera, view);
}

Scene Reconciler::detailed_scene(const Camera& camera, const View& view, int height_px) const {
    Scene detailed = scene(camera, view);
    const Material& material = state_->pictures[0].material;
    const int side = state_->visible_side(0, material, {camera, height_px});
    for (int i = 0; i < kMapSlots; ++i) {
        const auto& held = state_->maps.slot(i).value;
        const bool coarse = held && held->side > 0 && (side == 0 || held->side < side);
        if (!coarse || detailed.maps[i] != held->handle) continue;
        MapRequest request = map_request(material, MapSlot(i));
        request.finest_side = side;
        detailed.maps[i] = Renderer::begin_upload(load_map(state_->registry, request).levels).finish();
    }
    return detailed;
}

bool Reconciler::drawable() const { return state_->drawable(0); }
bool Reconciler::drawable(std::size_t further) const { return state_->drawable(1 + further); }

std::string Reconciler::error_of(std::size_t further) const {
    const auto failure = [](const auto& slot) {
        return !slot.keys.wanted.empty() && slot.keys.wanted == slot.keys.failed ? slot.error : std::string{};
    };
    std::string error = failure(state_->environments.slot(1 + further));
    if (error.empty()) error = failure(state_->meshes.slot(1 + further));
    for (int i = 0; i < kMapSlots && error.empty(); ++i)
        error = failure(state_->maps.slot(State::map_slot(1 + further, i)));
    return error;
}

bool Reconciler::pending() const {
    return state_->maps.pending() || state_->meshes.pending() || state_->environments.pending() ||
           !state_->uploads.empty();
}

const std::array<ui::MapStatus, kMapSlots>& Reconciler::maps() const { return state_->status; }

const ui::MeshInfo& Reconciler::mesh_info() const {
    const auto& slot = state_->meshes.slot(0);
    return slot.value && id_of(slot.keys.shown) == id_of(slot.keys.wanted) ? slot.value->info
                                                                           : state_->no_mesh;
}

const ui::EnvironmentInfo& Reconciler::environment_info() const {
    const auto& slot = state_->environments.slot(0);
    return slot.value && id_of(slot.keys.shown) == id_of(slot.keys.wanted) ? slot.value->info
                                                                           : state_->no_environment;
}

const ReconcileCounts& Reconciler::counts() const { return state_->counts; }

std::vector<std::pair<std::string, FileStamp>> Reconciler::take_files_read() {
    return std::exchange(state_->files_read, {});
}

namespace {
template <class T>
std::optional<std::string> fallback(const Supply<T>& supply) {
    const SlotKeys& keys = supply.slot(0).keys;
    if (keys.wanted != keys.failed || id_of(keys.shown) == id_of(keys.wanted)) return std::nullopt;
    return id_of(keys.shown);
}

template <class T>
bool cancel_in(Supply<T>& supply, Jobs& jobs, Jobs::Id job) {
    const std::optional<std::string> key = supply.key_of(job);
    if (!key) return false;
    jobs.stop(job);
    supply.failed(*key, "Loading " + short_name(id_of(*key)) + " was cancelled.");
    return true;
}
}  // namespace

std::optional<std::string> Reconciler::fallback_environment() const { return fallback(state_->environments); }
std::optional<std::string> Reconciler::fallback_mesh() const { return fallback(state_->meshes); }

bool Reconciler::cancel(Jobs::Id job) {
    return cancel_in(state_->environments, state_->jobs, job) ||
           cancel_in(state_->meshes, state_->jobs, job) || cancel_in(state_->maps, state_->jobs, job);
}

void Reconciler::reload(const std::string& file) { ++state_->versions[file]; }

}  // namespace patina

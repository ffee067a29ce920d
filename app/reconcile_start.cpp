#include "app/reconcile_state.h"
#include "app/stats.h"
#include "materials/text_io.h"

#include <memory>
#include <utility>

namespace patina {

namespace {

constexpr std::size_t kUploadPortion = std::size_t{4} << 20;  ///< bytes of a map at a time

std::string mesh_title(const Registry& registry, const std::string& id) {
    for (const MeshPart& part : registry.meshes)
        if (part.id == id) return part.title;
    return short_name(id);
}

}  // namespace

void Reconciler::State::note(const std::string& id, const std::vector<std::string>& notes) const {
    for (const std::string& each : notes) options.log(ui::Severity::Info, short_name(id) + ": " + each);
}

/// Gives memory back on a worker: of hundreds of megabytes that takes longer than a frame.
void Reconciler::State::let_go(std::shared_ptr<const void> large) const {
    const auto box = std::make_shared<std::shared_ptr<const void>>(std::move(large));
    jobs.start("", [box](JobContext&) -> Jobs::Done {
        box->reset();
        return {};
    });
}

/// Queues the main thread's part of a finished job: the upload of input, and then finished(ready, handle).
template <class T, class Ready, class Input, class Finished>
void Reconciler::State::expect(Supply<T>& supply, const std::string& key, std::shared_ptr<Ready> ready,
                               std::shared_ptr<const Input> input, Finished finished) {
    note(id_of(key), ready->notes);
    using Begun = decltype(Renderer::begin_upload(input));
    uploads.push_back([this, &supply, key, ready = std::move(ready), input = std::move(input), finished,
                       upload = std::optional<Begun>{}]() mutable {
        bool done = true;
        try {
            if (!supply.is_loading(key)) {
            } else if (!upload) {
                upload = Renderer::begin_upload(input);
                done = false;
            } else if (done = upload->step(kUploadPortion); done) {
                finished(*ready, upload->finish());
            }
        } catch (const std::exception& error) {  // the driver has no memory left, or does not know the format
            options.log(ui::Severity::Error, error.what());
            supply.failed(key, error.what());
        }
        if (!done) return false;
        upload.reset();
        let_go(std::move(input));
        return true;
    });
}

template <class T>
std::function<void(const std::string&)> Reconciler::State::when_failed(
    Supply<T>& supply, const std::string& key, const std::shared_ptr<FileStamp>& stamp) {
    return [this, &supply, key, stamp](const std::string& error) {
        files_read.emplace_back(id_of(key), *stamp);
        if (supply.is_loading(key)) options.log(ui::Severity::Error, error);
        supply.failed(key, error);
    };
}

Jobs::Id Reconciler::State::start_map(const std::string& key, const MapRequest& request) {
    ++counts.maps_loaded;
    const auto stamp = std::make_shared<FileStamp>();
    const auto work = [this, key, request, stamp](JobContext&) -> Jobs::Done {
        *stamp = stamp_of(utf8_to_path(request.file));
        const auto ready = std::make_shared<ReadyMap>(load_map(registry, request));
        return [this, key, request, ready, stamp] {
            files_read.emplace_back(id_of(key), *stamp);
            add(renderer.work(), ready->work);
            const std::uint64_t bytes = bytes_of(*ready->levels);
            const int side = request.finest_side;
            expect(maps, key, ready, std::exchange(ready->levels, nullptr),
                   [this, key, bytes, side](const ReadyMap& map, MapHandle handle) {
                       if (const std::string& less = Renderer::note_of(*handle); !less.empty())
                           options.log(ui::Severity::Warning, short_name(id_of(key)) + ": " + less);
                       HeldMap held{.handle = std::move(handle),
                                    .thumbnail = renderer.upload_thumbnail(map.thumbnail)};
                       held.status = {.state = ui::MapState::Ok,
                                      .width = map.width,
                                      .height = map.height,
                                      .channels = map.channels,
                                      .bits = map.bits,
                                      .file_bytes = map.file_bytes};
                       held.side = map.is_whole ? 0 : side;
                       finish_map(key, std::move(held), bytes);
                   });
        };
    };
    return jobs.start("Loading " + short_name(request.file), work, when_failed(maps, key, stamp));
}

/// What shows less of the same map is not needed any more.
void Reconciler::State::finish_map(const std::string& key, HeldMap held, std::uint64_t bytes) {
    std::vector<std::string> coarser;
    maps.visit([&](const std::string& each, const HeldMap& other) {
        const bool less = held.side == 0 || (other.side > 0 && other.side < held.side);
        if (less && each != key && map_of_key(each) == map_of_key(key)) coarser.push_back(each);
    });
    maps.finished(key, std::move(held), bytes);
    for (const std::string& each : coarser) maps.forget(each);
}

Jobs::Id Reconciler::State::start_mesh(const std::string& key) {
    ++counts.meshes_loaded;
    const std::string id = id_of(key);
    std::shared_ptr<const Mesh> bare;  // the same without tangents, if it is there
    if (wants_tangents(key))
        if (const auto held = meshes.in_memory(versioned(id))) bare = held->mesh;
    struct Ready {
        std::shared_ptr<const Mesh> mesh;
        std::vector<std::string> notes;
        WorkLedger work;
        float uv_stretch = 0.0f;
    };
    const auto stamp = std::make_shared<FileStamp>();
    const auto work = [this, key, id, bare, stamp](JobContext& job) -> Jobs::Done {
        *stamp = stamp_of(utf8_to_path(id));
        auto mesh = std::make_shared<Mesh>(bare ? *bare : load_mesh_part(registry, id, job.stop));
        const auto ready = std::make_shared<Ready>();
        if (!bare) ready->notes = mesh->notes;
        const bool make = wants_tangents(key) && !mesh->has_tangents;
        if (make) make_tangents(*mesh);
        count_mesh(ready->work, *mesh, make);
        auto prepared = std::make_shared<const PreparedMesh>(prepare_mesh(*mesh));
        ready->uv_stretch = uv_stretch(*mesh);
        ready->mesh = std::move(mesh);
        return [this, key, ready, stamp, prepared] {
            files_read.emplace_back(id_of(key), *stamp);
            add(renderer.work(), ready->work);
            expect(meshes, key, ready, prepared, [this, key](const Ready& loaded, MeshHandle handle) {
                HeldMesh held{
                    .handle = std::move(handle), .mesh = loaded.mesh, .uv_stretch = loaded.uv_stretch};
                held.info = {.title = mesh_title(registry, id_of(key)),
                             .triangles = loaded.mesh->indices.size() / 3,
                             .vertices = loaded.mesh->vertices.size(),
                             .has_uvs = loaded.mesh->has_uvs,
                             .notes = loaded.mesh->notes};
                meshes.finished(key, std::move(held), 2 * bytes_of(*loaded.mesh));
            });
        };
    };
    return jobs.start((bare ? "Computing tangents of " : "Loading ") + short_name(id), work,
                      when_failed(meshes, key, stamp));
}

Jobs::Id Reconciler::State::start_environment(const std::string& key) {
    const LightOrder order = light_orders.at(key);
    const auto stamp = std::make_shared<FileStamp>();
    const auto work = [this, key, order, stamp](JobContext& job) -> Jobs::Done {
        *stamp = stamp_of(utf8_to_path(order.id));
        const BakeControl control{jobs.parallel_for(), job.progress, job.stop};
        auto lit = get_light(registry, order, options.bake_settings, options.bakes, control);
        if (!lit) return {};
        const auto ready = std::make_shared<ReadyLight>(std::move(*lit));
        return [this, key, order, ready, stamp] {
            files_read.emplace_back(id_of(key), *stamp);
            count_light(order, *ready);
            patina::count_light(renderer.work(), order, *ready);
            keep(order, *ready);
            const std::uint64_t bytes = bytes_of(*ready->light) + bytes_of(*ready->held);
            expect(environments, key, ready, std::exchange(ready->light, nullptr),
                   [this, key, bytes](const ReadyLight& light, EnvironmentHandle handle) {
                       take_light(key, light, std::move(handle), bytes);
                   });
        };
    };
    return jobs.start((order.held ? "Adding light of " : "Baking ") + short_name(order.id), work,
                      when_failed(environments, key, stamp));
}

/// What was decoded, for the next time: beside the picture, which does not wait for it.
void Reconciler::State::keep(const LightOrder& order, const ReadyLight& ready) const {
    if (ready.keep_as.empty()) return;
    const auto box = std::make_shared<ReadyLight>(ready);
    jobs.start("", [this, order, box](JobContext&) -> Jobs::Done {
        const std::string why_not = keep_light(registry, order, *box, *box->light, options.bakes);
        box->light.reset();  // here, for the same reason as in let_go
        if (why_not.empty()) return {};
        return [this, why_not] { options.log(ui::Severity::Info, why_not); };
    });
}

void Reconciler::State::count_light(const LightOrder& order, const ReadyLight& ready) {
    const bool is_new = !order.held || order.held->exact.levels.empty();
    const bool is_baked = ready.levels_baked > 0 || ready.irradiance_baked;
    if (is_new) counts.environments_from_disk += int(ready.from_disk);
    if (is_new) counts.environments_baked += int(is_baked);
    counts.first_lights += int(ready.is_first_light);
    counts.levels_baked += ready.levels_baked;
    counts.irradiances_baked += int(ready.irradiance_baked);
}

void Reconciler::State::take_light(const std::string& key, const ReadyLight& light, EnvironmentHandle handle,
                                   std::uint64_t bytes) {
    HeldEnvironment held{.handle = std::move(handle), .light = light.held};
    held.info = {.title = light.held->source.title,
                 .width = light.held->source.width,
                 .height = light.held->source.height,
                 .max_radiance = light.held->source.max_radiance,
                 .notes = light.notes};
    std::vector<std::string> less;  // of the same light
    const std::string base = base_of(key);
    environments.visit([&](const std::string& each, const HeldEnvironment& other) {
        if (each == key || base_of(each) != base) return;
        less.push_back(each);
        if (held.info.notes.empty()) held.info.notes = other.info.notes;
    });
    environments.finished(key, std::move(held), bytes);
    for (const std::string& each : less) environments.forget(each);
}

}  // namespace patina

#include "app/thumbnails.h"

#include "app/document.h"
#include "app/reconcile_light.h"
#include "app/reconcile_load.h"
#include "app/stats.h"
#include "app/watch.h"
#include "materials/material_io.h"
#include "materials/params.h"
#include "materials/text_io.h"

#include <array>
#include <cstdio>
#include <deque>
#include <exception>
#include <map>
#include <utility>

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr int kVersion = 2;  ///< of how thumbnails look
constexpr int kSidePx = 192;
constexpr int kMapPx = 256;
constexpr const char* kLight = "studio";
constexpr const char* kShape = "sphere";
constexpr std::size_t kMaxFiles = 2000;  ///< kept on disk

/// FNV-1a, enough to tell files of one folder apart.
std::uint64_t hash_text(const std::string& text) {
    std::uint64_t hash = 14695981039346656037ull;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
    return hash;
}

std::string describe(const FileStamp& stamp) {
    return std::to_string(stamp.exists) + ":" + std::to_string(stamp.modified) + ":" +
           std::to_string(stamp.bytes);
}

/// What a worker found for a picture: itself, from the cache or computed, or what is needed to draw it.
struct Found {
    std::optional<Image> picture;
    fs::path cache_file;
    Material material;
    std::array<std::optional<ReadyMap>, kMapSlots> maps;
    std::shared_ptr<const PreparedMesh> mesh;
    WorkLedger work;
};

using Key = std::pair<Thumbnails::Kind, std::string>;

fs::path cache_file(const fs::path& folder, const std::string& content) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "%016llx.png",
                  static_cast<unsigned long long>(hash_text(content + "#" + std::to_string(kVersion))));
    return folder / name.data();
}

bool take_from_cache(Found& found) {
    std::error_code ignored;
    if (!fs::exists(found.cache_file, ignored)) return false;
    try {
        found.picture = load_image(found.cache_file).image;
        skip(found.work, "drawing a thumbnail", "it lay in the disk cache");
        return true;
    } catch (const std::exception&) {
        return false;  // made again, and written over
    }
}

void find_preset_picture(const Registry& registry, const fs::path& folder, const fs::path& file,
                         Found& found) {
    found.material = with_full_map_paths(load_material(file).material, file);
    std::string content = "preset\n" + to_json(found.material);
    for (const MaterialSlot& row : material_slots()) {
        const std::string& map = *row.edit(found.material).map;
        if (!map.empty()) content += "\n" + describe(stamp_of(utf8_to_path(map)));
    }
    found.cache_file = cache_file(folder, content);
    if (take_from_cache(found)) return;
    for (int i = 0; i < kMapSlots; ++i) {
        MapRequest request = map_request(found.material, MapSlot(i));
        if (request.file.empty()) continue;
        try {
            request.finest_side = kMapPx;
            found.maps[i] = load_map(registry, request);
            add(found.work, found.maps[i]->work);
        } catch (const std::exception&) {
            found.maps[i]
                .reset();  // shown by its value alone; the editor says what is missing once it is opened
        }
    }
}

/// Of what was seen before the panorama lies ready.
void find_environment_picture(const Registry& registry, const Thumbnails::Options& options,
                              const std::string& id, Found& found) {
    found.cache_file =
        cache_file(options.folder, "environment\n" + id + "\n" + describe(stamp_of(utf8_to_path(id))));
    if (take_from_cache(found)) return;
    const auto fingerprint = environment_fingerprint(registry, id);
    if (const auto kept = fingerprint ? load_kept(options.bakes, kept_key(id, *fingerprint)) : std::nullopt) {
        found.picture = small_panorama(kept->panorama, kSidePx);
        skip(found.work, "decoding an environment for its small picture",
             "its panorama lay in the disk cache");
        return;
    }
    found.picture = small_panorama(load_environment(registry, id), kSidePx);
    ++found.work.environments_decoded;
}

void find_mesh_picture(const Registry& registry, const fs::path& folder, const std::string& id,
                       Found& found) {
    found.cache_file = cache_file(folder, "mesh\n" + id + "\n" + describe(stamp_of(utf8_to_path(id))));
    if (take_from_cache(found)) return;
    const Mesh mesh = load_mesh_part(registry, id);
    count_mesh(found.work, mesh, false);
    found.mesh = std::make_shared<PreparedMesh>(prepare_mesh(mesh));
}

void find_picture(const Registry& registry, const fs::path& file, Found& found) {
    std::optional<SmallPicture> small;
    import_image_rows(registry, file,
                      {.begin =
                           [&](const Image& shape) {
                               small.emplace(kThumbnailPx, shape.type == PixelType::F32);
                               small->begin(shape);
                           },
                       .row = [&](const std::byte* row) { small->row(row); }});
    ++found.work.maps_decoded;
    found.work.map_bytes_decoded += small->bytes_read();
    found.picture = small->take();
}

void write_to_cache(const fs::path& file, const Image& picture) {
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    std::size_t files = 0;
    fs::path oldest;
    fs::file_time_type oldest_time = fs::file_time_type::max();
    for (const auto& entry : fs::directory_iterator(file.parent_path(), ignored)) {
        ++files;
        const auto time = entry.last_write_time(ignored);
        if (!ignored && time < oldest_time) {
            oldest_time = time;
            oldest = entry.path();
        }
    }
    if (files >= kMaxFiles) fs::remove(oldest, ignored);
    try {
        save_image(file, picture);
    } catch (const std::exception&) {
        return;  // a cache that cannot be written only costs the time to make it again
    }
}

}  // namespace

struct Thumbnails::State {
    Renderer& renderer;
    const Registry& registry;
    Jobs& jobs;
    Options options;

    struct Entry {
        MapHandle picture;
        bool asked = false;  ///< queued, under way or failed: not asked for again
    };
    std::map<Key, Entry> entries;
    std::deque<Key> queue;
    Jobs::Id job = 0;
    std::optional<std::pair<Key, Found>> to_draw;
    EnvironmentHandle light;
    MeshHandle sphere;
    bool light_failed = false;
    std::uint64_t version = 0;

    void start(const Key& key);
    void start_light();
    void arrived(const Key& key, const Image& picture);
    void draw();
};

void Thumbnails::State::arrived(const Key& key, const Image& picture) {
    entries[key].picture = renderer.upload_thumbnail(picture);
    ++version;
}

void Thumbnails::State::start(const Key& key) {
    job = jobs.start("", [this, key](JobContext&) -> Jobs::Done {
        const auto found = std::make_shared<Found>();
        const auto& [kind, id] = key;
        switch (kind) {
            case Kind::Preset:
                find_preset_picture(registry, options.folder, utf8_to_path(id), *found);
                break;
            case Kind::Environment:
                find_environment_picture(registry, options, id, *found);
                break;
            case Kind::Mesh:
                find_mesh_picture(registry, options.folder, id, *found);
                break;
            case Kind::Picture:
                find_picture(registry, utf8_to_path(id), *found);
                break;
        }
        std::error_code ignored;
        if (found->picture && !found->cache_file.empty() && !fs::exists(found->cache_file, ignored))
            write_to_cache(found->cache_file, *found->picture);
        return [this, key, found] {
            add(renderer.work(), found->work);
            if (found->picture)
                arrived(key, *found->picture);
            else
                to_draw.emplace(key, std::move(*found));
        };
    });
}

void Thumbnails::State::start_light() {
    job = jobs.start(
        "",
        [this](JobContext& context) -> Jobs::Done {
            const LightOrder order{.id = kLight, .needed = all_light()};
            auto lit = get_light(registry, order, options.bake_settings, options.bakes,
                                 {jobs.parallel_for(), context.progress, context.stop});
            if (!lit) return {};
            WorkLedger work;
            count_light(work, order, *lit);
            Mesh shape = load_mesh_part(registry, kShape);
            make_tangents(shape);
            count_mesh(work, shape, true);
            return [this, shape = std::make_shared<PreparedMesh>(prepare_mesh(shape)), ready = lit->light,
                    work = std::move(work)] {
                add(renderer.work(), work);
                light = Renderer::begin_upload(ready).finish();
                sphere = Renderer::begin_upload(shape).finish();
            };
        },
        [this](const std::string&) { light_failed = true; });
}

void Thumbnails::State::draw() {
    const auto [key, found] = std::move(*std::exchange(to_draw, std::nullopt));
    Scene scene{.environment = light, .mesh = sphere, .material = found.material};
    scene.camera.distance = 4.1f;
    scene.view.background = Background::Plain;
    scene.view.plain_color = glm::vec3(0.05f);
    if (found.mesh) {
        scene.mesh = Renderer::begin_upload(found.mesh).finish();
        scene.camera.yaw_deg = -30.0f;
        scene.camera.pitch_deg = 20.0f;
    }
    for (int i = 0; i < kMapSlots; ++i)
        if (found.maps[i]) scene.maps[i] = Renderer::begin_upload(found.maps[i]->levels).finish();
    const TargetHandle target = renderer.make_target({kSidePx, kSidePx});
    renderer.draw(scene, *target, Reuse::IfRepeated);  // most show one sphere
    const auto picture = std::make_shared<Image>(renderer.read_display(*target));
    arrived(key, *picture);
    jobs.start("", [picture, file = found.cache_file](JobContext&) -> Jobs::Done {
        write_to_cache(file, *picture);
        return {};
    });
}

Thumbnails::Thumbnails(Renderer& renderer, const Registry& registry, Jobs& jobs, Options options)
    : state_(new State{
          .renderer = renderer, .registry = registry, .jobs = jobs, .options = std::move(options)}) {}

Thumbnails::~Thumbnails() = default;

std::uintptr_t Thumbnails::texture(Kind kind, const std::string& id) const {
    const auto found = state_->entries.find({kind, id});
    const bool is_there = found != state_->entries.end() && found->second.picture;
    return is_there ? Renderer::texture_of(*found->second.picture) : 0;
}

void Thumbnails::want(Kind kind, const std::string& id) {
    bool& asked = state_->entries[{kind, id}].asked;
    if (!asked) state_->queue.emplace_back(kind, id);
    asked = true;
}

void Thumbnails::forget(Kind kind, const std::string& id) {
    const auto found = state_->entries.find({kind, id});
    if (found != state_->entries.end()) found->second.asked = false;
}

bool Thumbnails::step(bool nothing_else_to_do) {
    State& state = *state_;
    // Not beside a job without a name either: it may be keeping what the next picture is made of.
    if (!nothing_else_to_do || !state.jobs.idle()) return false;
    if (state.to_draw) {
        if (!state.light && !state.light_failed) {
            state.start_light();
            return false;
        }
        try {
            state.draw();
        } catch (const std::exception&) {
            // The graphics card has no memory for it: the tile stays without a picture.
        }
        return true;
    }
    if (state.queue.empty()) return false;
    const Key key = state.queue.front();
    state.queue.pop_front();
    state.start(key);
    return false;
}

std::uint64_t Thumbnails::version() const { return state_->version; }

bool Thumbnails::busy() const {
    return state_->to_draw || !state_->queue.empty() || state_->jobs.is_running(state_->job);
}

}  // namespace patina

#include "app/editor_maps.h"

#include "app/editor_photo.h"
#include "app/editor_state.h"
#include "app/map_files.h"
#include "app/paths.h"
#include "app/reconcile_load.h"
#include "materials/text_io.h"
#include "renderer/core/photo.h"
#include "renderer/maps/photo_maps.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr int kSmallPx = 512;    ///< of the photo that previews are made from
constexpr int kPreviewPx = 192;  ///< of a preview

struct Read {
    LoadedPhoto photo;
    Image small, raw;
};

void read_photo(Editor& editor, const std::string& file) {
    EditorMaps& maps = editor.maps;
    maps = {.file = file};
    if (file.empty()) return;
    maps.read_job = editor.jobs.start(
        "Loading " + short_name(file),
        [&editor, file](JobContext&) -> Jobs::Done {
            auto read = std::make_shared<Read>();
            read->photo = load_photo(editor.registry, file, kMapPhotoPx);
            read->small = reduced_photo(read->photo.linear, kSmallPx);
            read->raw = small_picture(read->photo.linear, kSmallPx, true);
            return [&editor, file, read] {
                if (editor.maps.file != file) return;
                editor.maps.raw = editor.renderer.upload_thumbnail(read->raw);
                editor.maps.small = std::make_shared<const Image>(std::move(read->small));
                editor.maps.photo = std::make_shared<const LoadedPhoto>(std::move(read->photo));
                ++editor.changes;
            };
        },
        [&editor](const std::string& error) {
            editor.maps.error = error;
            log_line(editor, ui::Severity::Error, error);
        });
}

/// The same at the size of a preview.
MapSettings small_settings(MapSettings settings) {
    const float scale = float(kPreviewPx) / float(std::max(settings.size_px.x, settings.size_px.y));
    settings.size_px = glm::max(glm::ivec2(glm::vec2(settings.size_px) * scale), glm::ivec2(16));
    return settings;
}

Image in_eight_bits(const Image& image) {
    Image result = make_image(image.width, image.height, 3, PixelType::U8);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                set_texel(result, x, y, c, texel(image, x, y, std::min(c, image.channels - 1)));
    return result;
}

void show_previews(Editor& editor, const PhotoMaps& made) {
    Renderer& renderer = editor.renderer;
    EditorMaps& maps = editor.maps;
    maps.previews = {renderer.upload_thumbnail(display_of_linear(made.rectified)),
                     renderer.upload_thumbnail(display_of_linear(made.even)),
                     renderer.upload_thumbnail(made.albedo),
                     renderer.upload_thumbnail(in_eight_bits(made.height)),
                     renderer.upload_thumbnail(in_eight_bits(made.normal)),
                     renderer.upload_thumbnail(in_eight_bits(made.roughness)),
                     renderer.upload_thumbnail(in_eight_bits(made.ao))};
    maps.error.clear();
    ++editor.changes;
}

void preview(Editor& editor) {
    EditorMaps& maps = editor.maps;
    const MapSettings settings = editor.ui.maps.settings;
    maps.previewed = settings;
    maps.preview_job = editor.jobs.start(
        "Looking at the maps",
        [&editor, settings, file = maps.file, small = maps.small](JobContext& job) -> Jobs::Done {
            const std::optional<PhotoMaps> result = make_photo_maps(
                *small, small_settings(settings), fourier_transform(), {job.progress, job.stop});
            auto made = std::make_shared<const PhotoMaps>(result.value_or(PhotoMaps{}));
            return [&editor, file, made] {
                if (editor.maps.file == file && !made->albedo.empty()) show_previews(editor, *made);
            };
        },
        [&editor](const std::string& error) {
            editor.maps.previews = {};
            editor.maps.error = "Here " + error + ".";
            ++editor.changes;
        });
}

const Photo* photo_of_view(const Editor& editor) {
    if (!editor.document.sheet) return nullptr;
    const std::vector<ViewPlace> places = places_of(*editor.document.sheet);
    const auto view = std::size_t(std::max(editor.ui.sheet_selected, 0));
    if (view >= places.size()) return nullptr;
    const std::optional<Photo>& photo = lighting_at(*editor.document.sheet, places[view]).photo;
    return photo ? &*photo : nullptr;
}

struct Made {
    MapFiles files;
    std::vector<std::string> notes;
};

/// On a worker: the whole thing at full size, saved.
Made save_made(const LoadedPhoto& photo, const std::string& source, const MapSettings& settings,
               const MapFiles& files, JobContext& job) {
    const auto maps = make_photo_maps(photo.linear, settings, fourier_transform(), {job.progress, job.stop});
    if (!maps) return {};
    require_absent(files);
    save_maps(*maps, files, source);
    return {files, maps->notes};
}

}  // namespace

bool maps_page_shown(const Editor& editor) {
    return editor.ui.show_inspector && editor.ui.right_tab == "maps";
}

void update_maps(Editor& editor) {
    EditorMaps& maps = editor.maps;
    if (!maps_page_shown(editor)) return;
    if (maps.file != editor.ui.maps.photo) read_photo(editor, editor.ui.maps.photo);
    if (!maps.small || editor.ui.maps.held || editor.jobs.is_running(maps.preview_job)) return;
    if (maps.previewed != editor.ui.maps.settings) preview(editor);
}

ui::MapsStatus maps_status(const Editor& editor) {
    const EditorMaps& maps = editor.maps;
    const auto texture = [](const MapHandle& handle) -> ui::TextureId {
        return handle ? Renderer::texture_of(*handle) : 0;
    };
    ui::MapsStatus status{.photo = texture(maps.raw),
                          .rectified = texture(maps.previews.rectified),
                          .even = texture(maps.previews.even),
                          .albedo = texture(maps.previews.albedo),
                          .height = texture(maps.previews.height),
                          .normal = texture(maps.previews.normal),
                          .roughness = texture(maps.previews.roughness),
                          .ao = texture(maps.previews.ao),
                          .error = maps.error,
                          .notes = maps.notes,
                          .making = editor.jobs.is_running(maps.make_job),
                          .view_photo = photo_of_view(editor) != nullptr};
    if (maps.photo) status.photo_px = {maps.photo->linear.width, maps.photo->linear.height};
    return status;
}

void set_map_photo(Editor& editor, const std::string& file) {
    editor.ui.maps.photo = file;
    editor.ui.maps.settings.corners = MapSettings{}.corners;
    editor.ui.maps.settings.gain = glm::vec3(1.0f);
    editor.ui.maps.name = plain_stem(utf8_to_path(file), "photo");
    editor.ui.maps.picking_card = false;
}

void take_map_photo_of_view(Editor& editor) {
    const Photo* photo = photo_of_view(editor);
    if (!photo) return;
    set_map_photo(editor, photo->file);
    MapSettings& settings = editor.ui.maps.settings;
    if (photo->fit) settings.corners = photo->fit->photo;
    if (photo->exposure_ev == 0.0f && photo->white_balance == glm::vec3(1.0f)) return;
    // A card is balanced to the light that falls on it; a surface's colour is what it reflects of that.
    const auto view = std::size_t(std::max(editor.ui.sheet_selected, 0));
    if (!editor.reconciler.drawable(view)) return;
    const glm::vec3 white = card_color(editor, view, 1.0f);
    for (int c = 0; c < 3; ++c)
        settings.gain[c] =
            photo->white_balance[c] * std::exp2(photo->exposure_ev) / std::max(white[c], 1e-6f);
}

void pick_map_card(Editor& editor, const ui::request::PickMapCard& picked) {
    if (!editor.maps.photo) return;
    const auto patch = card_patch(editor.maps.photo->linear, picked.point);
    const auto balance = patch ? balance_to(*patch, glm::vec3(kGreyCard)) : std::nullopt;
    if (!balance)
        return log_line(editor, ui::Severity::Warning,
                        "There the photo is clipped or black; click where the card keeps its colour.");
    editor.ui.maps.settings.gain = balance->white_balance * std::exp2(balance->exposure_ev);
    say_status(editor, "The card sets how much light fell on the sample.");
}

void make_maps(Editor& editor) {
    EditorMaps& maps = editor.maps;
    if (!maps.photo || editor.jobs.is_running(maps.make_job)) return;
    if (editor.file.path.empty()) {
        say_status(editor, "Save the preset first: its maps lie beside it.");
        return open_browser(editor, ui::BrowserPurpose::SavePreset);
    }
    const ui::PhotoToMaps& wanted = editor.ui.maps;
    const fs::path folder = editor.file.path.parent_path();
    const std::string name = free_map_name(
        folder, wanted.name.empty() ? "photo" : plain_stem(utf8_to_path(wanted.name + "."), "photo"),
        wanted.choice);
    maps.make_job = editor.jobs.start(
        "Making maps from " + short_name(maps.file),
        [&editor, photo = maps.photo, source = short_name(maps.file), settings = wanted.settings,
         files = map_files(folder, name, wanted.choice)](JobContext& job) -> Jobs::Done {
            auto made = std::make_shared<const Made>(save_made(*photo, source, settings, files, job));
            return [&editor, made] {
                if (made->files.all().empty()) return;
                editor.document.material = with_map_files(editor.document.material, made->files);
                editor.maps.notes = made->notes;
                log_line(editor, ui::Severity::Info,
                         "Made " + std::to_string(made->files.all().size()) + " maps beside the preset: " +
                             path_to_utf8(made->files.all().front().filename()) + " and so on.");
            };
        },
        [&editor](const std::string& error) { log_line(editor, ui::Severity::Error, error); });
}

}  // namespace patina

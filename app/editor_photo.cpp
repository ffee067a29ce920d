#include "app/editor_photo.h"

#include "app/editor_state.h"
#include "app/paths.h"
#include "app/reconcile_load.h"
#include "renderer/core/angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>

namespace patina {

namespace {

constexpr int kRawPx = 1024;
constexpr glm::ivec2 kTrialPx{160};

struct ReadPhoto {
    LoadedPhoto photo;
    Image raw;  ///< 3 channels of U8
};

/// sRGB with the photo's coverage as alpha.
Image overlay_of(const Image& in_view) {
    const Image display = display_of_linear(in_view);
    Image overlay = make_image(display.width, display.height, 4, PixelType::U8);
    for (int y = 0; y < overlay.height; ++y)
        for (int x = 0; x < overlay.width; ++x) {
            for (int c = 0; c < 3; ++c) set_texel(overlay, x, y, c, texel(display, x, y, c));
            set_texel(overlay, x, y, 3, texel(in_view, x, y, 3));
        }
    return overlay;
}

const Photo* photo_of(const Editor& editor, std::size_t view) {
    if (!editor.document.sheet) return nullptr;
    const std::vector<ViewPlace> places = places_of(*editor.document.sheet);
    if (view >= places.size()) return nullptr;
    const std::optional<Photo>& photo = lighting_at(*editor.document.sheet, places[view]).photo;
    return photo ? &*photo : nullptr;
}

void read_photo(Editor& editor, const std::string& file) {
    PhotoFile& entry = editor.photos.files[file];
    entry.job = editor.jobs.start(
        "Loading " + short_name(file),
        [&editor, file](JobContext&) -> Jobs::Done {
            auto read = std::make_shared<ReadPhoto>();
            read->photo = load_photo(editor.registry, file);
            read->raw = small_picture(read->photo.linear, kRawPx, true);
            return [&editor, file, read] {
                PhotoFile& loaded = editor.photos.files[file];
                loaded.raw = editor.renderer.upload_thumbnail(read->raw);
                for (const std::string& note : read->photo.notes)
                    log_line(editor, ui::Severity::Info, short_name(file) + ": " + note);
                loaded.loaded = std::make_shared<const LoadedPhoto>(std::move(read->photo));
                ++editor.changes;
            };
        },
        [&editor, file](const std::string& error) {
            editor.photos.files[file].error = error;
            log_line(editor, ui::Severity::Error, error);
        });
}

struct Compared {
    Image in_view, overlay, heat, luminance;
    Residual residual;
};

void compare_photo(Editor& editor, const DrawnPhotoView& drawn, const Photo& photo,
                   const std::shared_ptr<const LoadedPhoto>& loaded) {
    const auto render = std::make_shared<const Image>(editor.renderer.read_radiance(*drawn.target));
    PhotoShown& shown = editor.photos.views[drawn.view];
    shown.photo = photo;
    shown.size_px = {render->width, render->height};
    shown.drawn = drawn.drawn;
    shown.search.reset();
    shown.hints.reset();
    shown.job = editor.jobs.start(
        "Comparing with " + short_name(photo.file),
        [&editor, view = drawn.view, photo, loaded, render](JobContext&) -> Jobs::Done {
            auto made = std::make_shared<Compared>();
            made->in_view = photo_in_view(photo, loaded->linear, {render->width, render->height});
            const Image& in_view = made->in_view;
            made->overlay = overlay_of(in_view);
            Image delta_e;
            made->residual = residual_of(in_view, *render, photo.region, &delta_e);
            made->heat = heat_picture(delta_e, kHeatWhite);
            made->luminance = luminance_picture(in_view, *render, photo.region, kLuminanceWhite);
            return [&editor, view, made] {
                PhotoShown& result = editor.photos.views[view];
                result.fitted = editor.renderer.upload_thumbnail(made->overlay);
                result.heat = editor.renderer.upload_thumbnail(made->heat);
                result.luminance = editor.renderer.upload_thumbnail(made->luminance);
                result.linear = std::make_shared<const Image>(std::move(made->in_view));
                result.residual = made->residual;
                ++editor.changes;
            };
        },
        [&editor](const std::string& error) { log_line(editor, ui::Severity::Error, error); });
}

EnvironmentHandle make_white(Renderer& renderer) {
    Environment environment;
    environment.width = 16;
    environment.height = 8;
    environment.radiance.assign(128, glm::vec3(1.0f));
    environment.content_hash = environment_hash(environment);
    const CubeMap ones{4, std::vector<glm::vec3>(96, glm::vec3(1.0f))};
    BakedEnvironment baked;
    for (const float roughness : standard_roughness_levels()) baked.levels.push_back({roughness, ones});
    baked.irradiance = ones;
    return renderer.upload_environment(environment, baked);
}

}  // namespace

std::shared_ptr<const LoadedPhoto> loaded_photo(Editor& editor, const std::string& file) {
    const auto found = editor.photos.files.find(file);
    if (found == editor.photos.files.end()) {
        read_photo(editor, file);
        return nullptr;
    }
    if (!found->second.error.empty()) throw std::runtime_error(found->second.error);
    return found->second.loaded;
}

void update_photo(Editor& editor, const DrawnPhotoView& drawn) {
    if (drawn.view >= editor.photos.views.size()) return;
    PhotoShown& shown = editor.photos.views[drawn.view];
    const Photo* photo = photo_of(editor, drawn.view);
    if (!photo) {
        if (shown.photo) shown = {};
        return;
    }
    const auto found = editor.photos.files.find(photo->file);
    if (found == editor.photos.files.end()) return read_photo(editor, photo->file);
    if (!found->second.loaded || !drawn.target || editor.jobs.is_running(shown.job)) return;
    const bool held = editor.ui.viewport_drag || editor.ui.photo_held;
    const bool stale = shown.photo != *photo || shown.size_px != Renderer::size_px(*drawn.target) ||
                       shown.drawn != drawn.drawn;
    if (stale && !held) compare_photo(editor, drawn, *photo, found->second.loaded);
}

bool hints_wanted(const Editor& editor) {
    const auto view = std::size_t(std::max(editor.ui.sheet_selected, 0));
    const Photo* photo = photo_of(editor, view);
    if (!photo || view >= editor.photos.views.size()) return false;
    const PhotoShown& shown = editor.photos.views[view];
    const auto file = editor.photos.files.find(photo->file);
    return file != editor.photos.files.end() && file->second.loaded && !shown.hints &&
           shown.photo == *photo && shown.residual.pixels > 0 && !editor.jobs.is_running(shown.job) &&
           editor.document.view.debug == DebugView::Final && editor.reconciler.drawable(view) &&
           !editor.ui.viewport_drag && !editor.ui.photo_held;
}

void step_hints(Editor& editor) {
    if (!hints_wanted(editor)) return;
    const auto view = std::size_t(std::max(editor.ui.sheet_selected, 0));
    PhotoShown& shown = editor.photos.views[view];
    EditorPhotos& photos = editor.photos;
    if (!shown.search) {
        const PhotoFile& file = photos.files.at(shown.photo->file);
        shown.search.emplace(
            photo_in_view(*shown.photo, file.loaded->linear, kTrialPx), shown.photo->region,
            editor.reconciler.scene_of(view, camera_of_sheet(editor, view), view_of_sheet(editor, view)));
    }
    if (!photos.trial) photos.trial = editor.renderer.make_target(kTrialPx);
    const bool more = shown.search->step([&](const Scene& scene) {
        editor.renderer.draw(scene, *photos.trial, Reuse::IfRepeated);
        return editor.renderer.read_radiance(*photos.trial);
    });
    if (more) return;
    shown.hints = shown.search->sentences();
    shown.search.reset();
    ++editor.changes;
}

void set_photo(Editor& editor, int view, const std::string& file) {
    if (!editor.document.sheet) return;
    const std::vector<ViewPlace> places = places_of(*editor.document.sheet);
    if (view < 0 || std::size_t(view) >= places.size()) return;
    lighting_at(*editor.document.sheet, places[std::size_t(view)]).photo = Photo{.file = file};
    editor.photos.files.erase(file);  // read it anew: it may have changed
}

void fill_photo(const Editor& editor, std::size_t view, ui::SheetCell& cell) {
    const Photo* photo = photo_of(editor, view);
    if (!photo || view >= editor.photos.views.size()) return;
    const auto file = editor.photos.files.find(photo->file);
    if (file != editor.photos.files.end()) {
        if (file->second.raw) cell.photo_raw = Renderer::texture_of(*file->second.raw);
        if (file->second.loaded) {
            const Image& linear = file->second.loaded->linear;
            cell.photo_px = {linear.width, linear.height};
            cell.photo_about = describe(file->second.loaded->exif);
        }
        if (cell.error.empty()) cell.error = file->second.error;
    }
    const PhotoShown& shown = editor.photos.views[view];
    if (shown.fitted) cell.photo = Renderer::texture_of(*shown.fitted);
    if (shown.heat) cell.heat = Renderer::texture_of(*shown.heat);
    if (shown.luminance) cell.luminance = Renderer::texture_of(*shown.luminance);
    if (shown.fitted && shown.residual.pixels > 0) cell.residual = short_text(shown.residual);
    cell.hints = shown.hints;
}

glm::vec3 card_color(Editor& editor, std::size_t view, float reflectance) {
    EditorPhotos& photos = editor.photos;
    if (!photos.white) photos.white = make_white(editor.renderer);
    if (!photos.card)
        for (const BuiltinMesh& mesh : builtin_meshes())
            if (mesh.id == "quad") photos.card = editor.renderer.upload_mesh(mesh.make());
    const View looked = view_of_sheet(editor, view);
    Scene scene = editor.reconciler.scene_of(view, Camera{}, View{});
    scene.mesh = photos.card;
    scene.maps = {};
    scene.material = {};
    scene.view.env_rotation_deg =
        wrap_degrees(looked.env_rotation_deg - camera_of_sheet(editor, view).yaw_deg);
    scene.view.background = Background::Plain;
    scene.view.debug = DebugView::Diffuse;
    const TargetHandle target = editor.renderer.make_target({8, 8}, 1, TargetPrecision::Full);
    const auto middle = [&] {
        editor.renderer.draw(scene, *target);
        const Image image = editor.renderer.read_radiance(*target);
        return glm::vec3(texel(image, 4, 4, 0), texel(image, 4, 4, 1), texel(image, 4, 4, 2));
    };
    const glm::vec3 lit = middle();
    scene.environment = photos.white;
    const glm::vec3 in_white = middle();  // what part of the light such a surface scatters at all
    return reflectance * std::exp2(looked.exposure_ev) * lit / in_white;
}

void pick_card(Editor& editor, const ui::request::PickCard& picked) {
    try {
        const auto view = std::size_t(std::max(picked.view, 0));
        const Photo* photo = photo_of(editor, view);
        if (!photo) return;
        const auto file = editor.photos.files.find(photo->file);
        if (file == editor.photos.files.end() || !file->second.loaded || !editor.reconciler.drawable(view))
            throw std::runtime_error("The photo or the light is not there yet; click again in a moment.");
        const auto patch = card_patch(file->second.loaded->linear, picked.point);
        if (!patch) return;
        const float reflectance = picked.white ? kWhitePaper : kGreyCard;
        const auto balance = balance_to(*patch, card_color(editor, view, reflectance));
        if (!balance)
            throw std::runtime_error(
                "There the photo is clipped or black; click where the card keeps its colour.");
        const std::vector<ViewPlace> places = places_of(*editor.document.sheet);
        Photo& target = *lighting_at(*editor.document.sheet, places[view]).photo;
        target.exposure_ev = std::clamp(balance->exposure_ev, -30.0f, 30.0f);
        target.white_balance = balance->white_balance;
        std::array<char, 160> text{};
        std::snprintf(text.data(), text.size(),
                      "The card sets the photo's exposure to %+.2f EV, white balance %.3f, %.3f, %.3f.",
                      double(target.exposure_ev), double(target.white_balance.x),
                      double(target.white_balance.y), double(target.white_balance.z));
        say_status(editor, text.data());
    } catch (const std::exception& error) {
        log_line(editor, ui::Severity::Warning, error.what());
    }
}

}  // namespace patina

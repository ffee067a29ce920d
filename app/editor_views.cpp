#include "app/editor_loop.h"
#include "materials/text_io.h"

#include <algorithm>
#include <utility>

namespace patina {

Scene Loop::sheet_scene(std::size_t view, glm::ivec2 size_px) const {
    const Camera camera = fitted_to(camera_of_sheet(editor_, view), float(size_px.x) / float(size_px.y));
    return editor_.reconciler.scene_of(view, camera, view_of_sheet(editor_, view));
}

/// Views of one size and surface are rasterised once for all of them.
Reuse Loop::reuse_in_sheet(const Scene& scene, const ui::SheetSize& at,
                           const std::vector<ui::SheetSize>& seen) const {
    const auto shares = [&](const ui::SheetSize& other) {
        const auto view = std::size_t(other.view);
        return other.view != at.view && other.size_px == at.size_px && view < sheet_views_.size() &&
               editor_.reconciler.drawable(view) &&
               Renderer::same_surface(scene, sheet_scene(view, at.size_px));
    };
    return std::ranges::any_of(seen, shares) ? Reuse::Expected : Reuse::IfRepeated;
}

bool Loop::sheet_is_stale() const {
    const std::size_t views = places_of(*editor_.document.sheet).size();
    return std::ranges::any_of(sheet_seen_, [&](int seen) {
        const auto view = std::size_t(seen);
        if (view >= views || view >= sheet_views_.size() || !editor_.reconciler.drawable(view)) return false;
        if (!sheet_views_[view].has_drawn) return true;
        const Scene scene = sheet_scene(view, Renderer::size_px(*sheet_views_[view].target));
        return scene != sheet_views_[view].drawn;
    });
}

/// Only the views that are seen and changed.
void Loop::draw_sheet(const std::vector<ui::SheetSize>& seen) {
    sheet_seen_.clear();
    if (!editor_.document.sheet) return sheet_views_.clear();
    const std::size_t views = std::min(places_of(*editor_.document.sheet).size(), kMaxFurtherPictures);
    sheet_views_.resize(views);
    for (const ui::SheetSize& each : seen) {
        const auto view = std::size_t(each.view);
        if (view >= views) continue;
        sheet_seen_.push_back(each.view);
        if (!editor_.reconciler.drawable(view)) continue;
        DrawnView& shown = sheet_views_[view];
        const Scene scene = sheet_scene(view, each.size_px);
        const bool resized = !shown.target || Renderer::size_px(*shown.target) != each.size_px;
        if (!resized && shown.has_drawn && scene == shown.drawn) continue;
        if (resized) {
            shown.target = renderer_.make_target(each.size_px);
            frames_wanted_ = std::max(frames_wanted_, 1);  // this frame still shows the old one
        }
        renderer_.draw(scene, *shown.target, reuse_in_sheet(scene, each, seen));
        shown.drawn = scene;
        shown.has_drawn = true;
        ++shown.times;
        ++views_;
    }
}

void Loop::fill_sheet(ui::PanelContext& context) const {
    if (!editor_.document.sheet) return;
    const Comparison& sheet = *editor_.document.sheet;
    const std::vector<ViewPlace> places = places_of(sheet);
    for (std::size_t view = 0; view < std::min(places.size(), kMaxFurtherPictures); ++view) {
        const ComparedPreset& preset = preset_at(sheet, places[view]);
        const auto read = editor_.sheet.presets.find(preset.preset);
        ui::SheetCell cell{.light = lighting_title(editor_.registry, lighting_at(sheet, places[view]))};
        if (preset.preset == kEditedPreset)
            cell.preset = preset_title(preset, editor_.document.material) + " (edited)";
        else if (read != editor_.sheet.presets.end())
            cell.preset = preset_title(preset, read->second.material);
        cell.error = read != editor_.sheet.presets.end() ? read->second.error : "";
        if (cell.error.empty()) cell.error = editor_.reconciler.error_of(view);
        if (view < sheet_views_.size() && sheet_views_[view].has_drawn)
            cell.texture = Renderer::display_texture(*sheet_views_[view].target);
        fill_photo(editor_, view, cell);
        context.sheet_cells.push_back(std::move(cell));
    }
    context.sheet_file = path_to_utf8(sheet_file(editor_).path);
    context.sheet_unsaved = sheet_unsaved(editor_);
}

void Loop::draw_view(glm::ivec2 size_px) {
    if (size_px.x <= 0 || size_px.y <= 0 || !editor_.reconciler.drawable()) return;
    const Scene scene = editor_.reconciler.scene(editor_.camera, editor_.document.view);
    const bool resized = size_px != size_px_;
    const bool changed = resized || !has_drawn_ || scene != drawn_;
    const double now_s = window_.time_s();
    if (changed) changed_s_ = now_s;
    if (!changed && !(wants_refining() && now_s - changed_s_ >= kStillSeconds)) return;
    // The very first picture is looked at before another one's shaders are compiled.
    if (has_drawn_ && !first_lit_frame_) return;
    const Pace quality = changed ? pace_.while_moving() : Pace::Good;
    const glm::ivec2 pixels = drawn_px(quality, size_px);
    TargetHandle& target = targets_[int(quality)];
    if (!target || Renderer::size_px(*target) != pixels)
        target = renderer_.make_target(pixels, samples_a_pixel(quality));
    if (target != target_)
        frames_wanted_ = std::max(frames_wanted_, 1);  // this frame still shows the old one
    size_px_ = size_px;
    target_ = target;
    shown_ = quality;
    drew_s_ = now_s;
    renderer_.draw(scene, *target_, Reuse::IfRepeated);
    drawn_ = scene;
    has_drawn_ = true;
    ++views_;
}

void Loop::measure_view(glm::ivec2 size_px, bool held) {
    if (size_px.x <= 0 || size_px.y <= 0 || !editor_.reconciler.drawable()) return;
    const bool before = meter_.busy();
    meter_.update(editor_.reconciler.scene(editor_.camera, editor_.document.view), size_px,
                  editor_.ui.accuracy, held);
    if (!before && !meter_.busy()) return;
    ++views_;
    frames_wanted_ = std::max(frames_wanted_, 1);  // whose words say what this one shows
}

void Loop::fill_viewport(ui::Viewport& viewport) const {
    if (target_) viewport.texture = Renderer::display_texture(*target_);
    const auto picture = [&](ui::Layer layer) {
        if (layer.kind == ui::Layer::View && is_reference(editor_.document.view))
            layer = {ui::Layer::Mode, Shading::Reference};
        return meter_.picture(layer);
    };
    viewport.left = picture(editor_.ui.accuracy.left);
    viewport.right = picture(editor_.ui.accuracy.right);
    viewport.accuracy = meter_.status();
}

/// Both pictures of the view under the mouse, as the last frame showed them.
void Loop::fill_probe(ui::PanelContext& context) {
    if (!probed_) return;
    const glm::vec2 at = probed_->at;
    const auto of_target = [&](const RenderTarget* target) {
        return target ? value_at(renderer_, *target, at) : std::nullopt;
    };
    const ui::AccuracySettings& accuracy = editor_.ui.accuracy;
    if (!editor_.document.sheet) {
        const auto of_layer = [&](const ui::Layer& layer) {
            const RenderTarget* target = meter_.target(layer);
            return of_target(target ? target : has_drawn_ ? target_.get() : nullptr);
        };
        context.probe.first = of_layer(accuracy.left);
        if (accuracy.split) context.probe.second = of_layer(accuracy.right);
    } else if (probed_->view >= 0 && editor_.ui.sheet_enlarged == probed_->view) {
        const auto of_view = [&](int view) {
            const auto i = std::size_t(std::max(view, 0));
            const bool there = view >= 0 && i < sheet_views_.size() && sheet_views_[i].has_drawn;
            return of_target(there ? sheet_views_[i].target.get() : nullptr);
        };
        context.probe.first = of_view(probed_->view);
        const PhotoShown& photo = editor_.photos.views[std::size_t(probed_->view)];
        if (editor_.ui.ab.against == ui::kAgainstPhoto && photo.linear)
            context.probe.second = value_at(*photo.linear, at);
        else
            context.probe.second = of_view(editor_.ui.ab.against);
    }
}

void Loop::fill_thumbnails() {
    const auto fill = [&](auto& items, Thumbnails::Kind kind, auto id) {
        for (auto& item : items) item.thumbnail = editor_.thumbnails.texture(kind, item.*id);
    };
    fill(editor_.catalog.presets, Thumbnails::Kind::Preset, &ui::CatalogItem::id);
    fill(editor_.catalog.environments, Thumbnails::Kind::Environment, &ui::CatalogItem::id);
    fill(editor_.catalog.meshes, Thumbnails::Kind::Mesh, &ui::CatalogItem::id);
    if (editor_.import_sheet)
        fill(editor_.import_sheet->rows, Thumbnails::Kind::Picture, &ui::ImportRow::file);
}

/// Of what was seen in the frame; what is not scrolled into sight is never made.
void Loop::want_thumbnails(const ui::WorkspaceResult& seen) {
    Thumbnails& thumbnails = editor_.thumbnails;
    const Thumbnails::Kind kind = seen.shelf == "library.environments" ? Thumbnails::Kind::Environment
                                  : seen.shelf == "library.meshes"     ? Thumbnails::Kind::Mesh
                                                                       : Thumbnails::Kind::Preset;
    for (const std::string& id : seen.cards_seen) thumbnails.want(kind, id);
    // The Light page shows its own.
    thumbnails.want(Thumbnails::Kind::Environment, bind_view(editor_).environment);
    if (editor_.import_sheet)
        for (const ui::ImportRow& row : editor_.import_sheet->rows)
            thumbnails.want(Thumbnails::Kind::Picture, row.file);
}

/// As large as the picture is shown, however it is drawn, or was last; before, as the window.
Sight Loop::sight() const {
    for (const int height : {place_px_.y, size_px_.y, window_.framebuffer_px().y})
        if (height > 0) return {editor_.camera, height};
    return {editor_.camera, 1};
}

}  // namespace patina

#include "app/comparison_sheet.h"

#include "app/paths.h"
#include "app/sheet.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace patina {

namespace {

/// Where the cells of the sheet stand: the grid's columns with their photos, then the further views.
struct Plan {
    std::vector<int> column_at;  ///< the sheet's column of each lighting
    int columns = 0, rows = 0;
    bool photos = false;
};

int cells_of(const Lighting& light) { return light.photo ? 3 : 1; }

Plan planned(const Comparison& comparison) {
    Plan plan;
    int widest = 1;
    std::size_t cells = 0;
    for (const Lighting& light : comparison.columns) {
        plan.column_at.push_back(plan.columns);
        plan.columns += cells_of(light);
        plan.photos |= light.photo.has_value();
    }
    for (const FreeView& view : comparison.views) {
        widest = std::max(widest, cells_of(view.lighting));
        cells += std::size_t(cells_of(view.lighting));
        plan.photos |= view.lighting.photo.has_value();
    }
    if (plan.columns == 0) plan.columns = grid_columns(cells, 1.5f, 1.0f);
    plan.columns = std::max(plan.columns, widest);
    plan.rows = int(comparison.rows.size());
    int left = 0;
    for (const FreeView& view : comparison.views) {
        if (left > 0 && left + cells_of(view.lighting) > plan.columns) left = 0;
        if (left == 0) ++plan.rows;
        left = (left + cells_of(view.lighting)) % plan.columns;
    }
    return plan;
}

class Drawer {
public:
    Drawer(Studio& studio, const Registry& registry, const Comparison& comparison,
           const ComparisonSheetOptions& options)
        : studio_(studio),
          registry_(registry),
          comparison_(comparison),
          options_(options),
          scenes_(studio.renderer, studio.loader, registry, comparison, options.scene),
          plan_(planned(comparison)),
          sheet_(plan_.columns, plan_.rows, options.cell_px,
                 options.radiance ? PixelType::F32 : PixelType::U8, plan_.photos) {
        scenes_.expect(options.cell_px);
    }

    Image draw() {
        draw_grid();
        draw_views();
        if (plan_.photos) draw_legend();
        return sheet_.image();
    }

private:
    void progress(const std::string& what) {
        const std::size_t all = places_of(comparison_).size();
        studio_.progress.show(what, float(drawn_++) / float(std::max<std::size_t>(all, 1)));
    }

    /// In the sheet's type.
    Image cell(const Image& display) const {
        if (!options_.radiance) return display;
        Image linear = make_image(display.width, display.height, 3, PixelType::F32);
        for (int y = 0; y < display.height; ++y)
            for (int x = 0; x < display.width; ++x)
                for (int c = 0; c < 3; ++c)
                    set_texel(linear, x, y, c, srgb_to_linear(texel(display, x, y, c)));
        return linear;
    }
    static Image without_coverage(const Image& linear) {
        Image result = make_image(linear.width, linear.height, 3, PixelType::F32);
        for (int y = 0; y < linear.height; ++y)
            for (int x = 0; x < linear.width; ++x)
                for (int c = 0; c < 3; ++c) set_texel(result, x, y, c, texel(linear, x, y, c));
        return result;
    }

    void draw_view(ViewPlace place, int column, int row) {
        const Scene scene = scenes_.scene(place);
        progress("drawing " + scene.material.name);
        const Lighting& light = lighting_at(comparison_, place);
        if (!light.photo) {
            sheet_.set_cell(column, row,
                            options_.radiance ? scenes_.radiance(scene, options_.cell_px)
                                              : scenes_.display(scene, options_.cell_px));
            return;
        }
        const Image radiance = scenes_.radiance(scene, options_.cell_px);
        sheet_.set_cell(column, row, options_.radiance ? radiance : scenes_.display(scene, options_.cell_px));
        const PhotoShot shot = shoot_photo(*light.photo, *scenes_.photo(light.photo->file), radiance);
        sheet_.set_cell(column + 1, row, options_.radiance ? without_coverage(shot.linear) : shot.picture);
        sheet_.set_cell(column + 2, row, cell(shot.heat));
        sheet_.set_cell_title(column + 2, row, short_text(shot.residual));
    }

    void draw_grid() {
        for (std::size_t i = 0; i < comparison_.columns.size(); ++i) {
            const Lighting& light = comparison_.columns[i];
            sheet_.set_column_title(plan_.column_at[i], lighting_title(registry_, light));
            if (!light.photo) continue;
            sheet_.set_column_title(plan_.column_at[i] + 1, "Photo: " + photo_title(*light.photo));
            sheet_.set_column_title(plan_.column_at[i] + 2, "Difference");
        }
        const int title_columns = comparison_.columns.empty() || !comparison_.columns[0].photo ? 1 : 2;
        for (int row = 0; row < int(comparison_.rows.size()); ++row)
            for (int column = 0; column < int(comparison_.columns.size()); ++column) {
                const ViewPlace place{.row = row, .column = column};
                if (column == 0)
                    sheet_.set_row_title(
                        row, preset_title(comparison_.rows[std::size_t(row)], scenes_.scene(place).material),
                        plan_.photos ? title_columns : plan_.columns);
                draw_view(place, plan_.column_at[std::size_t(column)], row);
            }
    }

    void draw_views() {
        int row = int(comparison_.rows.size()) - 1;
        int left = 0;
        for (int free = 0; free < int(comparison_.views.size()); ++free) {
            const FreeView& view = comparison_.views[std::size_t(free)];
            if (left + cells_of(view.lighting) > plan_.columns) left = 0;
            if (left == 0) ++row;
            const ViewPlace place{.free = free};
            sheet_.set_cell_title(left, row,
                                  preset_title(view.preset, scenes_.scene(place).material) + ", " +
                                      lighting_title(registry_, view.lighting));
            if (view.lighting.photo)
                sheet_.set_cell_title(left + 1, row, "Photo: " + photo_title(*view.lighting.photo));
            draw_view(place, left, row);
            left = (left + cells_of(view.lighting)) % plan_.columns;
        }
    }

    void draw_legend() {
        Image ramp = make_image(256, 1, 1, PixelType::F32);
        for (int x = 0; x < ramp.width; ++x) set_texel(ramp, x, 0, 0, kHeatWhite * float(x) / 255.0f);
        sheet_.set_footer(
            "Difference, CIEDE2000:  0", heat_picture(ramp, kHeatWhite),
            std::to_string(int(kHeatWhite)) + " and more; about 1 is just noticeable, grey is not compared");
    }

    Studio& studio_;
    const Registry& registry_;
    const Comparison& comparison_;
    const ComparisonSheetOptions& options_;
    ComparisonScenes scenes_;
    Plan plan_;
    Sheet sheet_;
    std::size_t drawn_ = 0;
};

}  // namespace

void require_own_settings(const SceneOptions& options, const std::string& file) {
    const SceneOptions defaults;
    if (options.mesh == defaults.mesh && options.environments == defaults.environments &&
        options.view == defaults.view && options.camera == defaults.camera)
        return;
    throw std::runtime_error(
        file +
        ": a comparison file sets lights, mesh, camera and view itself; change it there, "
        "only --size, --set and --allow-missing-maps go with it");
}

ComparisonScenes::ComparisonScenes(Renderer& renderer, SceneLoader& loader, const Registry& registry,
                                   const Comparison& comparison, SceneOptions options)
    : renderer_(renderer),
      loader_(loader),
      registry_(registry),
      comparison_(comparison),
      options_(std::move(options)) {
    options_.mesh = comparison_.mesh;
    options_.camera = comparison_.camera;
    options_.size_px = {};
}

void ComparisonScenes::expect(glm::ivec2 size_px) {
    options_.size_px = size_px;
    for (const ViewPlace place : places_of(comparison_)) {
        const Camera& camera = camera_of(comparison_, lighting_at(comparison_, place));
        if (nearest_pixel({camera, size_px.y}) < nearest_pixel({options_.camera, size_px.y}))
            options_.camera = camera;  // that shows most of the maps
    }
    for (const ViewPlace place : places_of(comparison_)) {
        NeededLight& needed = needed_[lighting_at(comparison_, place).environment];
        needed = combined(needed, loader_.needed_light(unlit_scene(place)));
    }
}

Scene ComparisonScenes::scene(ViewPlace place) {
    const auto given = std::ranges::find(given_, place, [](const auto& each) { return each.first; });
    if (given != given_.end()) return given->second;
    Scene scene = unlit_scene(place);
    const std::string& environment = lighting_at(comparison_, place).environment;
    const auto needed = needed_.find(environment);
    scene.environment =
        loader_.environment(environment, needed != needed_.end() ? needed->second : all_light());
    return scene;
}

Scene ComparisonScenes::unlit_scene(ViewPlace place) {
    const std::string& preset = preset_at(comparison_, place).preset;
    if (preset == kEditedPreset)
        throw std::runtime_error(
            "a view of the comparison shows the preset that is being edited, which only the editor knows; "
            "save "
            "it and name its file in the comparison");
    const auto found = presets_.find(preset);
    Scene scene = found != presets_.end()
                      ? found->second
                      : presets_.emplace(preset, loader_.scene(preset, options_)).first->second;
    const Lighting& light = lighting_at(comparison_, place);
    scene.view = view_of(comparison_, light);
    scene.camera = camera_of(comparison_, light);
    return scene;
}

std::shared_ptr<const LoadedPhoto> ComparisonScenes::photo(const std::string& file) {
    std::shared_ptr<const LoadedPhoto>& photo = photos_[file];
    if (!photo) photo = std::make_shared<const LoadedPhoto>(load_photo(registry_, file));
    return photo;
}

const RenderTarget& ComparisonScenes::draw(const Scene& scene, glm::ivec2 size_px) {
    TargetHandle& target = targets_[{size_px.x, size_px.y}];
    if (!target) target = renderer_.make_target(size_px);
    renderer_.draw(scene, *target, reuse());
    return *target;
}

/// Where it pays to compile for it. One camera and mesh: presets without maps share a surface, and so do the
/// lightings of each preset.
Reuse ComparisonScenes::reuse() const {
    return places_of(comparison_).size() > 2 ? Reuse::Standing : Reuse::None;
}

Image ComparisonScenes::radiance(const Scene& scene, glm::ivec2 size_px) {
    return renderer_.read_radiance(draw(scene, size_px));
}

Image ComparisonScenes::display(const Scene& scene, glm::ivec2 size_px) {
    return renderer_.read_display(draw(scene, size_px));
}

Image draw_comparison_sheet(Studio& studio, const Registry& registry, const Comparison& comparison,
                            const ComparisonSheetOptions& options) {
    return Drawer(studio, registry, comparison, options).draw();
}

}  // namespace patina

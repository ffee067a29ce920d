#include "app/comparison_report.h"

#include "app/comparison_file.h"
#include "app/reconcile_load.h"
#include "app/report_pdf.h"
#include "materials/json_text.h"
#include "materials/material_io.h"
#include "materials/params.h"
#include "materials/text_io.h"
#include "renderer/core/file_io.h"
#include "renderer/core/format.h"
#include "renderer/core/image_format.h"
#include "renderer/core/image_io.h"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr int kMapPx = 256;

std::string number(double value) { return formatted("%.4g", value); }

/// As a shell takes it.
std::string quoted(const std::string& word) {
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789_-+=.,/:%@") == std::string::npos;
    if (plain) return word;
    std::string result = "'";
    for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

std::vector<std::string> residual_cells(const Residual& r) {
    if (r.pixels == 0) return {"–", "–", "–", "–", "0"};
    return {formatted("%.2f", double(r.delta_e)), formatted("%.2f", double(r.delta_e_95)),
            formatted("%+.1f %%", 100.0 * double(r.luminance_bias)),
            formatted("%.1f %%", 100.0 * double(r.luminance_rms)), std::to_string(r.pixels)};
}

std::string values_text(const MaterialParam& param, const Material& material) {
    std::string text;
    for (const float value : values_of(param, material))
        text += (text.empty() ? "" : ", ") + number(double(value));
    return text;
}

/// Of an environment that is a picture: its size, and whom it names.
std::string about_picture(const fs::path& file) {
    if (image_format_of_extension(path_text(file.extension())) == ImageFormat::Unknown) return {};
    const ImageInfo info = load_image_info(file);
    std::string text = std::to_string(info.width) + "×" + std::to_string(info.height) + " pixels";
    for (const auto& [key, value] : load_image_metadata(file))
        for (const char* credit : {"Copyright", "Artist", "owner", "comments"})
            if (key == credit && !value.empty()) text += "; " + printable(value, 200);
    return text;
}

/// What a map of one channel says, in grey; the file may hold other maps in the other channels.
Image only_channel(Image picture, Channel channel, bool invert) {
    if (channel == Channel::A) return picture;  // a small picture has no alpha
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const float value = texel(picture, x, y, int(channel));
            for (int c = 0; c < 3; ++c) set_texel(picture, x, y, c, invert ? 1.0f - value : value);
        }
    return picture;
}

std::string balance_text(const Photo& photo) {
    return formatted("%+.2f EV", double(photo.exposure_ev)) + ", white balance " +
           formatted("%.3f", double(photo.white_balance.x)) + " / " +
           formatted("%.3f", double(photo.white_balance.y)) + " / " +
           formatted("%.3f", double(photo.white_balance.z)) + (photo.fit ? ", fitted by four points" : "") +
           (photo.region ? ", a region compared" : "");
}

}  // namespace

ComparisonReport::ComparisonReport(ComparisonScenes& scenes, const Registry& registry, Comparison comparison,
                                   ComparisonReportOptions options)
    : scenes_(scenes),
      registry_(registry),
      comparison_(std::move(comparison)),
      options_(std::move(options)),
      places_(places_of(comparison_)) {}

void ComparisonReport::load_view() {
    const ViewPlace place = places_[shots_.size()];
    const std::optional<Photo>& photo = lighting_at(comparison_, place).photo;
    loaded_ = Loaded{scenes_.scene(place), photo ? scenes_.photo(photo->file) : nullptr};
}

void ComparisonReport::draw_view() {
    const ViewPlace place = places_[shots_.size()];
    const Loaded loaded = *std::exchange(loaded_, std::nullopt);
    const Scene& scene = loaded.scene;
    const Lighting& light = lighting_at(comparison_, place);
    const RenderTarget& drawn = scenes_.draw(scene, glm::ivec2(options_.picture_px));
    Shot shot{.place = place,
              .material = preset_title(preset_at(comparison_, place), scene.material),
              .light = lighting_title(registry_, light),
              .picture = scenes_.renderer().read_display(drawn),
              .photo = loaded.photo};
    if (shot.photo) to_hold_ = scene;
    drawn_ = &drawn;
    if (options_.reference_samples > 0) {
        if (!reference_) reference_.emplace(scenes_.renderer(), options_.reference_samples);
        reference_->begin(scene);
        gathers_ = true;
    }
    shots_.push_back(std::move(shot));
}

/// The picture's light in one step, what hints are tried against in the next.
void ComparisonReport::hold_against_photo() {
    Shot& shot = shots_.back();
    if (shot.radiance.empty()) {
        shot.radiance = scenes_.renderer().read_radiance(*drawn_);
        if (!options_.hints) to_hold_.reset();
        return;
    }
    const Scene scene = *std::exchange(to_hold_, std::nullopt);
    const Photo& photo = *lighting_at(comparison_, shot.place).photo;
    hints_.emplace(photo_in_view(photo, shot.photo->linear, trial_size()), photo.region, scene);
}

void ComparisonReport::step_hints() {
    if (hints_->step([&](const Scene& trial) { return scenes_.radiance(trial, trial_size()); })) return;
    shots_.back().hints = hints_->sentences();
    hints_.reset();
}

void ComparisonReport::step_reference() {
    if (reference_->step()) return;
    shots_.back().reference = reference_->result();
    gathers_ = false;
}

bool ComparisonReport::step() {
    if (to_hold_)
        hold_against_photo();
    else if (hints_)
        step_hints();
    else if (gathers_)
        step_reference();
    else if (loaded_)
        draw_view();
    else if (shots_.size() < places_.size())
        load_view();
    return unfinished() || shots_.size() < places_.size();
}

float ComparisonReport::progress() const {
    float of_view = 0.0f;
    if (gathers_ && !hints_ && !to_hold_)
        of_view = 0.5f + 0.5f * reference_->done();
    else if (hints_)
        of_view = (gathers_ ? 0.5f : 1.0f) * hints_->done();
    return (float(done()) + of_view) / float(std::max<std::size_t>(views(), 1));
}

ReportSection ComparisonReport::sheet() const {
    ReportSection section{.heading = "Side by side"};
    if (!comparison_.remarks.empty()) section.paragraphs.push_back(comparison_.remarks);
    section.picture_columns = std::max(1, int(comparison_.columns.size()));
    if (comparison_.columns.empty()) section.picture_columns = grid_columns(shots_.size(), 1.5f, 1.0f);
    section.picture_columns = std::min(section.picture_columns, 4);
    for (const Shot& shot : shots_) {
        if (shot.place.free < 0) {
            if (shot.place.column == 0) section.pictures.push_back({shot.material, {}});
            section.pictures.back().pictures.push_back({shot.light, shot.picture});
        } else {
            const bool first = shot.place.free == 0;
            if (first) section.pictures.push_back({comparison_.rows.empty() ? "" : "Further views", {}});
            section.pictures.back().pictures.push_back({shot.material + ", " + shot.light, shot.picture});
        }
    }
    return section;
}

void ComparisonReport::add_photos(Report& report) const {
    ReportSection section{.heading = "Against the photos"};
    ReportTable table;
    table.header = {"Material", "Light", "ΔE", "ΔE, 95 %", "Luminance", "Luminance rms", "Pixels"};
    for (const Shot& shot : shots_) {
        if (!shot.photo) continue;
        const Photo& photo = *lighting_at(comparison_, shot.place).photo;
        const PhotoShot held = shoot_photo(photo, *shot.photo, shot.radiance);
        const std::string camera = describe(held.exif);
        section.pictures.push_back(
            {shot.material + ", " + shot.light,
             {{held.title + (camera.empty() ? "" : " – " + camera), held.picture},
              {"Render", shot.picture},
              {"ΔE: black is none, white " + number(double(kHeatWhite)) + " and more, grey not compared",
               held.heat},
              {formatted(
                   "Luminance: the render is darker (blue) or brighter (red), up to %.0f %% of the photo",
                   100.0 * double(kLuminanceWhite)),
               held.luminance}}});
        std::vector<std::string> cells{shot.material, shot.light};
        std::ranges::copy(residual_cells(held.residual), std::back_inserter(cells));
        table.rows.push_back(std::move(cells));
        for (const std::string& hint : shot.hints)
            section.notes.push_back(shot.material + ", " + shot.light + ": " + hint);
        section.notes.push_back(held.title + ": " + balance_text(photo) + ".");
        for (const std::string& note : shot.photo->notes)
            section.notes.push_back(held.title + ": " + note + ".");
    }
    if (table.rows.empty()) return;
    std::vector<std::string> unique;
    for (const std::string& note : section.notes)
        if (std::ranges::find(unique, note) == unique.end()) unique.push_back(note);
    section.notes = std::move(unique);
    section.table = std::move(table);
    section.notes.emplace_back(
        "ΔE is CIEDE2000 between photo and render, values above white clipped; about 1 is just noticeable "
        "side by side. Luminance is how much brighter the render is than the photo on average.");
    report.sections.push_back(std::move(section));
}

void ComparisonReport::add_errors(Report& report) const {
    if (options_.reference_samples <= 0) return;
    ReportSection section{.heading = "Against the reference"};
    ReportTable table{
        .header = {"Material", "Light", "Error, rms", "95 % within", "Mean FLIP", "Known within"},
        .rows = {}};
    for (const Shot& shot : shots_) {
        const ReferenceError found = error_of(*shot.reference);
        const char* bound = found.known > found.error.rms ? "< " : "";
        table.rows.push_back(
            {shot.material, shot.light, bound + formatted("%.2f %%", 100.0 * found.error.rms),
             bound + formatted("%.2f %%", 100.0 * found.error.p95), bound + formatted("%.3f", found.flip),
             formatted("%.2f %%", 100.0 * found.known)});
    }
    section.table = std::move(table);
    section.notes.push_back(
        "The shading against the reflectance integral, as shares of the light on the object. The last column "
        "is how "
        "well 95 of 100 pixels of the integral are known, sampled " +
        formatted("to %.0f %% with at most %d points a pixel", 100.0 * kReferenceKnown,
                  reference_->samples()) +
        ". Where that is worse than the error, the error is mostly the samples' noise and stands as a bound "
        "(<).");
    report.sections.push_back(std::move(section));
}

/// As its file says it, whatever of it the pictures needed.
ReportSection ComparisonReport::material_section(const fs::path& file) const {
    const Material material = file.empty() ? Material{} : load_material(file).material;
    ReportSection section{.heading = "Material: " + material.name};
    if (!material.source.empty()) section.paragraphs.push_back("Values from: " + material.source);
    ReportTable table{.header = {"Parameter", "Value"}, .rows = {}};
    const bool has_maps = std::ranges::any_of(
        material_slots(), [&](const MaterialSlot& row) { return !map_of(material, row.slot).map->empty(); });
    if (has_maps) table.header.insert(table.header.end(), {"Map", "Size"});
    ReportPictureRow maps;
    for (const MaterialParam& param : kMaterialParams) {
        std::vector<std::string> cells{std::string(param.label), values_text(param, material)};
        if (has_maps) cells.resize(4);
        if (param.slot && has_maps) {
            const ConstMapRef map = map_of(material, *param.slot);
            cells[2] = *map.map;
            for (const MapSource& source : map_sources(material, file)) {
                if (source.slot != *param.slot) continue;
                const LoadedImage loaded = load_map(registry_, source);
                cells[3] = std::to_string(loaded.image.width) + " × " + std::to_string(loaded.image.height);
                Image picture = small_picture(loaded.image, kMapPx, loaded.image.type == PixelType::F32);
                if (map.channel) picture = only_channel(std::move(picture), *map.channel, *map.invert);
                maps.pictures.push_back(
                    {std::string(slot_row(*param.slot).label) + ": " + cells[2], std::move(picture)});
            }
        }
        table.rows.push_back(std::move(cells));
    }
    section.picture_columns = 5;
    if (!maps.pictures.empty()) section.pictures.push_back(std::move(maps));
    section.table = std::move(table);
    if (!file.empty()) section.notes.push_back("Preset: " + path_to_utf8(file.filename()));
    return section;
}

ReportSection ComparisonReport::lights() const {
    ReportSection section{.heading = "Lights"};
    ReportTable table{.header = {"Light", "Environment", "Turned", "Exposure", "Tone mapping", "About"},
                      .rows = {}};
    for (const Shot& shot : shots_) {
        const Lighting& light = lighting_at(comparison_, shot.place);
        std::string about;
        for (const EnvironmentSource& source : registry_.environments)
            for (const EnvironmentItem& item : source.list())
                if (item.id == light.environment) about = item.description;
        if (about.empty()) about = about_picture(utf8_to_path(light.environment));
        std::vector<std::string> cells{shot.light,
                                       path_to_utf8(utf8_to_path(light.environment).filename()),
                                       number(double(light.rotation_deg)) + "°",
                                       formatted("%+.2f\u00a0EV", double(light.exposure_ev)),
                                       std::string(named(kTonemaps, light.tonemap).title),
                                       about};
        if (std::ranges::find(table.rows, cells) == table.rows.end()) table.rows.push_back(std::move(cells));
    }
    section.table = std::move(table);
    return section;
}

/// To be run in the report's folder, like every command in it.
std::string ComparisonReport::render_command(const Shot& shot) const {
    const Comparison comparison = with_relative_paths(comparison_, options_.output);
    const Lighting& light = lighting_at(comparison, shot.place);
    const Camera& camera = camera_of(comparison, light);
    const ComparedPreset& preset = preset_at(comparison, shot.place);
    std::string command = "patina render " + quoted(preset.preset) + " --mesh " + quoted(comparison.mesh) +
                          " --env " + quoted(light.environment);
    if (light.rotation_deg != 0.0f) command += " --env-rotation " + number(double(light.rotation_deg));
    if (light.exposure_ev != 0.0f) command += " --exposure " + number(double(light.exposure_ev));
    command += " --tonemap " + std::string(named(kTonemaps, light.tonemap).id) + " --background " +
               std::string(named(kBackgrounds, light.background).id) + " --shading " +
               std::string(named(kShadings, view_of(comparison, light).shading).id) + " --camera " +
               number(double(camera.yaw_deg)) + "," + number(double(camera.pitch_deg)) + "," +
               number(double(camera.distance));
    const std::string side = std::to_string(options_.picture_px);
    return command + " --size " + side + "x" + side + " -o " +
           quoted(shot.place.free >= 0 ? "view-" + std::to_string(shot.place.free + 1) + ".png"
                                       : "row-" + std::to_string(shot.place.row + 1) + "-column-" +
                                             std::to_string(shot.place.column + 1) + ".png");
}

ReportSection ComparisonReport::making() const {
    ReportSection section{.heading = "How it was made"};
    const Shading shading = comparison_.shading;
    section.table = ReportTable{.header = {},
                                .rows = {{"Program", "Patina " PATINA_VERSION},
                                         {"Drawn by", options_.renderer},
                                         {"Shading", std::string(named(kShadings, shading).title) + ": " +
                                                         std::string(named(kShadings, shading).tooltip)},
                                         {"Mesh", path_to_utf8(utf8_to_path(comparison_.mesh).filename())}}};
    if (!options_.file.empty()) {
        const std::string file = quoted(relative_map(options_.output, options_.file));
        section.commands.push_back("patina report " + file + " -o " +
                                   quoted(path_to_utf8(options_.output.filename())));
        section.commands.push_back("patina compare " + file + " -o sheet.png");
    }
    for (const Shot& shot : shots_) section.commands.push_back(render_command(shot));
    return section;
}

Report ComparisonReport::finish() const {
    Report report{.title = comparison_.title.empty() ? "Materials side by side" : comparison_.title,
                  .author = comparison_.author,
                  .made_with = "Made with Patina " PATINA_VERSION};
    report.sections.push_back(sheet());
    add_photos(report);
    add_errors(report);
    std::vector<fs::path> files;  // of those written up; "-" is no file
    for (const ViewPlace place : places_) {
        const std::string& preset = preset_at(comparison_, place).preset;
        const fs::path file = preset == "-" ? fs::path{} : find_preset(preset);
        if (std::ranges::find(files, file) != files.end()) continue;
        files.push_back(file);
        report.sections.push_back(material_section(file));
    }
    report.sections.push_back(lights());
    report.sections.push_back(making());
    return report;
}

void require_report_file(const fs::path& file) {
    std::error_code ignored;
    const fs::path folder = file.parent_path();
    if (!folder.empty() && !fs::is_directory(folder, ignored))
        throw std::runtime_error(path_to_utf8(file) +
                                 ": there is no such folder; make it or choose another one");
    if (file.extension() != ".html" && file.extension() != ".pdf")
        throw std::runtime_error(path_to_utf8(file) + ": a report's name ends in .html or .pdf");
}

void save_report(const fs::path& file, const Report& report) {
    require_report_file(file);
    if (file.extension() == ".html") {
        const std::string html = to_html(report);
        return write_file(file, std::as_bytes(std::span(html)));
    }
    const std::vector<unsigned char> pdf = to_pdf(report);
    write_file(file, std::as_bytes(std::span(pdf)));
}

}  // namespace patina

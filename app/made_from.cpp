#include "app/made_from.h"

#include "app/comparison_file.h"
#include "app/scene_loader.h"
#include "materials/material_io.h"
#include "materials/text_io.h"
#include "renderer/core/file_io.h"
#include "renderer/core/hash.h"
#include "renderer/core/image_io.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <span>

namespace patina {

namespace fs = std::filesystem;

namespace {

class Inputs {
public:
    Inputs& add(std::string_view text) {
        const std::uint64_t size = text.size();  // so that "ab","c" and "a","bc" differ
        hash_ = hash_bytes(std::as_bytes(std::span(&size, 1)), hash_);
        hash_ = hash_bytes(std::as_bytes(std::span(text.data(), text.size())), hash_);
        return *this;
    }
    Inputs& add(double value) {
        std::array<char, 40> text{};
        std::snprintf(text.data(), text.size(), "%.9g", value);
        return add(std::string_view(text.data()));
    }
    void add_contents(const fs::path& file) { hash_ = hash_bytes(read_file(file), hash_); }
    /// An id of something built in, or a file's contents.
    void add_thing(const std::string& id) {
        const fs::path file = utf8_to_path(id);
        std::error_code ignored;
        if (fs::is_regular_file(file, ignored))
            add_contents(file);
        else
            add(id);
    }
    void add_preset(const std::string& name) {
        if (name == "-") {
            add(name);
            return;
        }
        const fs::path file = find_preset(name);
        add_contents(file);
        for (const MapSource& source : map_sources(load_material(file).material, file)) {
            std::error_code ignored;
            if (fs::is_regular_file(source.file, ignored)) add_contents(source.file);
        }
    }
    std::string text() const {
        std::array<char, 20> text{};
        std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash_));
        return text.data();
    }

private:
    std::uint64_t hash_ = 0;
};

void add_scene(Inputs& inputs, const SceneOptions& scene) {
    inputs.add_thing(scene.mesh);
    for (const std::string& environment : scene.environments) inputs.add_thing(environment);
    const View& view = scene.view;
    const Camera& camera = scene.camera;
    for (const float value :
         {view.env_rotation_deg, view.exposure_ev, view.plain_color.x, view.plain_color.y, view.plain_color.z,
          camera.yaw_deg, camera.pitch_deg, camera.distance, camera.fov_deg, camera.target.x, camera.target.y,
          camera.target.z, float(scene.size_px.x), float(scene.size_px.y), float(scene.samples),
          float(scene.error)})
        inputs.add(double(value));
    for (const std::string_view name :
         {named(kTonemaps, view.tonemap).id, named(kBackgrounds, view.background).id,
          named(kShadings, view.shading).id, named(kDebugViews, view.debug).id,
          named(kQualities, view.quality).id})
        inputs.add(name);
    for (const auto& [key, value] : scene.overrides) inputs.add(key).add(value);
}

void add_comparison(Inputs& inputs, const fs::path& file) {
    inputs.add_contents(file);
    const Comparison comparison = load_comparison(file).comparison;
    inputs.add_thing(comparison.mesh);
    const auto add_light = [&](const Lighting& light) {
        inputs.add_thing(light.environment);
        if (light.photo) inputs.add_thing(light.photo->file);
    };
    for (const ComparedPreset& row : comparison.rows) inputs.add_preset(row.preset);
    for (const Lighting& light : comparison.columns) add_light(light);
    for (const FreeView& view : comparison.views) {
        inputs.add_preset(view.preset.preset);
        add_light(view.lighting);
    }
}

}  // namespace

std::string made_from(const RenderArgs& args) {
    Inputs inputs;
    inputs.add("patina " PATINA_VERSION);
    add_scene(inputs, args.scene);
    for (const std::string& preset : args.presets) {
        if (is_comparison_file(utf8_to_path(preset)))
            add_comparison(inputs, utf8_to_path(preset));
        else
            inputs.add_preset(preset);
    }
    return inputs.text();
}

bool is_up_to_date(const fs::path& picture, const std::string& made_from) {
    std::error_code ignored;
    if (!fs::is_regular_file(picture, ignored)) return false;
    try {
        return std::ranges::any_of(load_image_metadata(picture), [&](const auto& row) {
            return row.first == kMadeFromKey && row.second == made_from;
        });
    } catch (const std::exception&) {  // what cannot be read is made again
        return false;
    }
}

fs::path frame_file(const fs::path& output, int frame, int frames) {
    std::string number = std::to_string(frame);
    const std::size_t digits = std::max<std::size_t>(3, std::to_string(frames).size());
    number.insert(0, digits - std::min(digits, number.size()), '0');
    fs::path file = output;
    file.replace_filename(output.stem());
    file += "-" + number;
    file += output.extension();
    return file;
}

}  // namespace patina

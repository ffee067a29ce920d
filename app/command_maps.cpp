// patina maps: a preset with maps from a photo of a flat sample.
#include "app/commands.h"
#include "app/console.h"
#include "app/map_files.h"
#include "app/paths.h"
#include "app/shoot.h"
#include "materials/material_io.h"
#include "materials/text_io.h"
#include "renderer/core/photo.h"

#include <cmath>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;

namespace {

MapSettings settings_for(const MapsArgs& args, const Image& linear, glm::vec2 photo_px) {
    MapSettings settings = args.settings;
    for (std::size_t i = 0; i < args.corners.size(); ++i) settings.corners[i] = args.corners[i] / photo_px;
    if (!args.card) return settings;
    const auto patch = card_patch(linear, *args.card / photo_px);
    const auto balance =
        patch ? balance_to(*patch, glm::vec3(args.white ? kWhitePaper : kGreyCard)) : std::nullopt;
    if (!balance)
        throw std::runtime_error(
            "at the card the photo is clipped, black or not there; name a place where the "
            "card keeps its colour");
    settings.gain = balance->white_balance * std::exp2(balance->exposure_ev);
    return settings;
}

Material material_of(const std::string& name, const std::string& photo) {
    Material material;
    material.name = name;
    material.source = "Estimated from the photo " + photo;
    return material;
}

}  // namespace

int run_maps(const MapsArgs& args, const Registry& registry) {
    const fs::path folder = utf8_to_path(args.output), photo = utf8_to_path(args.photo);
    const std::string name = args.name.empty() ? plain_stem(photo, "photo") : args.name;
    const MapFiles files = map_files(folder, name, args.choice);
    const fs::path preset = folder / utf8_to_path(name + ".json");
    if (!args.force) {
        require_absent(files);
        require_absent({.albedo = preset});
    }
    ProgressLine progress;
    progress.show("reading the photo", 0.0f);
    const LoadedPhoto loaded = load_photo(registry, args.photo, kMapPhotoPx);
    for (const std::string& note : loaded.notes) say(args.photo + ": " + note);
    const ImageInfo info = load_image_info(photo);
    std::optional<PhotoMaps> maps;
    try {
        maps = make_photo_maps(
            loaded.linear, settings_for(args, loaded.linear, glm::vec2(info.width, info.height)),
            fourier_transform(), {.progress = [&](float f) { progress.show("making maps", f); }, .stop = {}});
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(args.photo + ": " + error.what());
    }
    for (const std::string& note : maps->notes) say(args.photo + ": " + note);
    progress.show("writing", 0.9f);
    const std::string source = path_to_utf8(photo.filename());
    save_maps(*maps, files, source);
    save_material(preset, with_map_files(material_of(name, source), map_files({}, name, args.choice)));
    progress.clear();
    say("wrote " + path_to_utf8(preset) + " and its maps");
    return 0;
}

}  // namespace patina

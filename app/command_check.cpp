// patina check: what is wrong with a preset or a comparison, and where.
#include "app/commands.h"
#include "app/comparison_file.h"
#include "app/console.h"
#include "app/paths.h"
#include "app/scene_loader.h"
#include "materials/material_io.h"

#include <cstdio>
#include <stdexcept>

namespace patina {

namespace {

void print(const std::string& preset, const std::string& sentence) {
    std::printf("%s\n", harmless(preset + ": " + sentence).c_str());
}

/// Prints what is wrong; true if the preset can be used as it is.
bool check_preset(const std::string& preset, const Registry& registry) {
    bool sound = true;
    const auto problem = [&](const std::string& sentence) {
        print(preset, sentence);
        sound = false;
    };
    try {
        const std::filesystem::path file = find_preset(preset);
        if (is_comparison_file(file)) {
            for (const std::string& note : load_comparison(file).notes) print(preset, "note: " + note);
            print(preset, "ok");
            return true;
        }
        const LoadedMaterial loaded = load_material(file);
        for (const std::string& note : loaded.notes) print(preset, "note: " + note);
        for (const MapSource& source : map_sources(loaded.material, file)) {
            try {
                load_map(registry, source);
            } catch (const std::runtime_error& error) {
                problem(error.what());
            }
        }
    } catch (const std::runtime_error& error) {
        problem(error.what());
    }
    if (sound) print(preset, "ok");
    return sound;
}

}  // namespace

int run_check(const std::vector<std::string>& presets, const Registry& registry) {
    std::size_t unsound = 0;
    for (const std::string& preset : presets) unsound += check_preset(preset, registry) ? 0 : 1;
    if (unsound > 0)
        throw std::runtime_error(std::to_string(unsound) + " of " + std::to_string(presets.size()) +
                                 " presets cannot be used as they are");
    return 0;
}

}  // namespace patina

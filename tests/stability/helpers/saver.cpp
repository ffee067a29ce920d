// Saves one thing and ends, so that a test can let it go wrong: saver preset FILE NAME | settings FOLDER NAME
// | recovery FOLDER NAME | light FOLDER | environment FOLDER | picture FILE VALUE
#include "app/autosave.h"
#include "app/kept_environment.h"
#include "app/settings.h"
#include "materials/material_io.h"
#include "renderer/core/image_io.h"
#include "renderer/ibl/cache.h"

#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>

namespace {

using namespace patina;

Environment grey(float radiance) {
    Environment environment;
    environment.width = 16;
    environment.height = 8;
    environment.radiance.assign(128, glm::vec3(radiance));
    environment.content_hash = environment_hash(environment);
    return environment;
}

void save(const std::string& what, const std::string& where, const std::string& value) {
    if (what == "preset") {
        Material material;
        material.name = value;
        material.source = std::string(20000, 'x');
        save_material(where, material);
    } else if (what == "settings") {
        Settings settings;
        settings.last_folder = value;
        save_settings(where, settings);
    } else if (what == "recovery") {
        RecoveryFiles files(where);
        if (!files.problem().empty()) throw std::runtime_error(files.problem());
        Recovery recovery;
        recovery.document.material.name = value;
        files.write(to_json(recovery));
        std::_Exit(0);  // as a crash leaves it
    } else if (what == "light") {
        BakeSettings settings;
        settings.roughness = {0.5f, 1.0f};
        settings.max_face_size = 4;
        const auto result = cached_bake(grey(0.5f), settings, {}, BakeCache{.folder = where});
        if (!result->note.empty()) throw std::runtime_error(result->note);
        std::puts(result->from_disk ? "found" : "baked");
    } else if (what == "environment") {
        const BakeCache cache{.folder = where};
        const std::string key = kept_key("grey", 1);
        const bool found = load_kept(cache, key).has_value();
        const std::string note =
            found ? "" : save_kept(cache, key, facts_of(grey(0.5f)), make_panorama_levels(grey(0.5f)));
        if (!note.empty()) throw std::runtime_error(note);
        std::puts(found ? "found" : "baked");
    } else if (what == "picture") {
        Image image = make_image(64, 64, 3, PixelType::F32);
        for (int i = 0; i < 64; ++i) set_texel(image, i, i, 0, std::stof(value));
        save_image(where, image);
    } else {
        throw std::runtime_error("unknown: " + what);
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        save(argc > 1 ? argv[1] : "", argc > 2 ? argv[2] : "", argc > 3 ? argv[3] : "");
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "saver: %s\n", error.what());
        return 1;
    }
}

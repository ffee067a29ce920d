// A program of the build: computes the shipped presets' maps and writes them as PNG.
#include "materials/maps/recipes.h"
#include "renderer/core/image_io.h"

#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string_view>

namespace {

patina::Image image_of(const patina::maps::MapPicture& picture) {
    using namespace patina;
    const PixelType type = picture.bits == 16 ? PixelType::U16 : PixelType::U8;
    Image image = make_image(picture.size, picture.size, picture.channels, type);
    if (type == PixelType::U16) {
        std::memcpy(image.bytes.data(), picture.values.data(), image.bytes.size());
        return image;
    }
    for (std::size_t i = 0; i < picture.values.size(); ++i)
        image.bytes[i] = static_cast<std::byte>(picture.values[i]);
    return image;
}

int make_maps(const std::filesystem::path& folder, std::string_view recipe_name) {
    for (const patina::maps::MapRecipe& recipe : patina::maps::map_recipes()) {
        if (recipe.name != recipe_name) continue;
        for (const auto& picture : recipe.make(patina::maps::kMapSize))
            patina::save_image(folder / picture.file, image_of(picture));
        return 0;
    }
    std::fprintf(stderr, "patina_make_maps: there is no recipe '%.*s'\n",
                 static_cast<int>(recipe_name.size()), recipe_name.data());
    return 2;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 3) {
        std::fputs("usage: patina_make_maps FOLDER RECIPE\n", stderr);
        return 2;
    }
    try {
        return make_maps(arguments[1], arguments[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "patina_make_maps: %s\n", error.what());
        return 1;
    }
}

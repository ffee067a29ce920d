#include "app/shoot.h"

#include "materials/text_io.h"
#include "renderer/core/finite.h"
#include "renderer/core/format.h"
#include "renderer/core/image_io.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace patina {

namespace {

constexpr float kPaper = 0.5f;  ///< display value where a photo does not reach

int pixels_without_value(const Image& image) {
    int count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (!is_finite(glm::vec3(texel(image, x, y, 0), texel(image, x, y, 1), texel(image, x, y, 2))))
                ++count;
    return count;
}

}  // namespace

/// Means of 2×2 pixels.
Image reduced_photo(Image image, int max_side) {
    while (std::max(image.width, image.height) > max_side) {
        Image half =
            make_image(std::max(1, image.width / 2), std::max(1, image.height / 2), 3, PixelType::F32);
        for (int y = 0; y < half.height; ++y)
            for (int x = 0; x < half.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    float sum = 0.0f;
                    for (const int j : {2 * y, std::min(2 * y + 1, image.height - 1)})
                        for (const int i : {2 * x, std::min(2 * x + 1, image.width - 1)})
                            sum += texel(image, i, j, c);
                    set_texel(half, x, y, c, 0.25f * sum);
                }
        image = std::move(half);
    }
    return image;
}

LoadedPhoto load_photo(const Registry& registry, const std::string& file, int max_side) {
    const std::filesystem::path path = utf8_to_path(file);
    LoadedImage loaded = import_image(registry, path);
    Image linear = linear_photo(loaded.image);
    const int broken = pixels_without_value(linear);
    if (broken == linear.width * linear.height)
        throw std::runtime_error(file + ": holds no finite number; export it again");
    if (broken > 0)
        loaded.notes.push_back(std::to_string(broken) +
                               " pixels hold no finite number; they are neither shown nor compared");
    return {.linear = reduced_photo(std::move(linear), max_side),
            .exif = exif_of(load_image_metadata(path)),
            .notes = std::move(loaded.notes)};
}

Image display_of_linear(const Image& linear) {
    Image display = make_image(linear.width, linear.height, 3, PixelType::U8);
    for (int y = 0; y < linear.height; ++y)
        for (int x = 0; x < linear.width; ++x) {
            const bool there = linear.channels < 4 || texel(linear, x, y, 3) > 0.5f;
            for (int c = 0; c < 3; ++c)
                set_texel(display, x, y, c, there ? linear_to_srgb(texel(linear, x, y, c)) : kPaper);
        }
    return display;
}

PhotoShot shoot_photo(const Photo& photo, const LoadedPhoto& loaded, const Image& render) {
    PhotoShot shot{.title = photo_title(photo), .exif = loaded.exif};
    shot.linear = photo_in_view(photo, loaded.linear, {render.width, render.height});
    shot.picture = display_of_linear(shot.linear);
    Image delta_e;
    shot.residual = residual_of(shot.linear, render, photo.region, &delta_e);
    shot.heat = heat_picture(delta_e, kHeatWhite);
    shot.luminance = luminance_picture(shot.linear, render, photo.region, kLuminanceWhite);
    return shot;
}

std::string short_text(const Residual& residual) {
    if (residual.pixels == 0) return "nothing compared";
    return formatted("ΔE %.1f  ·  light %+.0f %%", double(residual.delta_e),
                     double(residual.luminance_bias) * 100.0);
}

std::string preset_title(const ComparedPreset& preset, const Material& material) {
    return preset.title.empty() ? material.name : preset.title;
}
std::string lighting_title(const Registry& registry, const Lighting& lighting) {
    if (!lighting.title.empty()) return lighting.title;
    std::string title = environment_title(registry, lighting.environment);
    if (lighting.rotation_deg != 0.0f) title += formatted("  %.0f°", double(lighting.rotation_deg));
    if (lighting.exposure_ev != 0.0f) title += formatted("  %+.1f EV", double(lighting.exposure_ev));
    if (lighting.shading) title += "  " + std::string(named(kShadings, *lighting.shading).title);
    return title;
}
std::string photo_title(const Photo& photo) {
    return photo.title.empty() ? path_to_utf8(utf8_to_path(photo.file).filename()) : photo.title;
}

}  // namespace patina

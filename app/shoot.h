// A view of a comparison drawn and held against its photo: pictures and numbers for sheets and reports.
#pragma once

#include "app/registry.h"
#include "renderer/core/comparison.h"
#include "renderer/core/photo.h"
#include "renderer/renderer.h"

#include <optional>
#include <string>
#include <vector>

namespace patina {

/// A photo read from disk.
struct LoadedPhoto {
    Image linear;  ///< 3 channels of F32, halved until no side is longer than asked
    CameraExif exif;
    std::vector<std::string> notes;
};
inline constexpr int kPhotoPx = 2048;  ///< more detail than a view shows
LoadedPhoto load_photo(const Registry& registry, const std::string& file, int max_side = kPhotoPx);

/// Halved until no side is longer than that: 3 channels of F32.
Image reduced_photo(Image image, int max_side);

struct PhotoShot {
    std::string title;
    CameraExif exif;
    Image
        picture;  ///< in the view's frame, balanced: 3 channels of U8, sRGB; mid-grey where it does not reach
    Image linear;     ///< the same as 4 channels of F32
    Image heat;       ///< ΔE2000 as a picture, white at kHeatWhite
    Image luminance;  ///< luminance_picture, up to kLuminanceWhite
    Residual residual;
};

/// The photo held against a view's linear radiance.
PhotoShot shoot_photo(const Photo& photo, const LoadedPhoto& loaded, const Image& render);

/// 8-bit sRGB of linear values clipped at 1; paper where a fourth channel is 0.
Image display_of_linear(const Image& linear);

/// "ΔE 3.2 · light +4 %".
std::string short_text(const Residual& residual);

std::string preset_title(const ComparedPreset& preset, const Material& material);
std::string lighting_title(const Registry& registry, const Lighting& lighting);
std::string photo_title(const Photo& photo);

}  // namespace patina

// A photo held against a render: made linear, balanced by a grey card, brought into the view's frame, and
// compared. Pure; knows no file, no material and no GPU.
//
// All pictures here are scene-linear F32 with Rec. 709 primaries. A photo in a view's frame has a fourth
// channel, 1 where the photo covers the pixel.
#pragma once

#include "renderer/core/comparison.h"
#include "renderer/core/image.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace patina {

/// 3 channels of F32. 8- and 16-bit pictures are taken as sRGB-encoded; grey is spread, alpha dropped.
Image linear_photo(const Image& image);

/// The mean colour of the photo around a point (pixels), the brightest and darkest tenth left out, so that a
/// scratch or a gloss does not count. nullopt outside the picture.
std::optional<glm::vec3> patch_color(const Image& photo, glm::vec2 center, float radius_px);

/// The same around a fraction of the photo, as far as a card there surely reaches.
std::optional<glm::vec3> card_patch(const Image& photo, glm::vec2 fraction);

struct PhotoBalance {
    float exposure_ev = 0.0f;
    glm::vec3 white_balance{1.0f};  ///< leaves the luminance of the patch as exposure alone makes it
};
/// What brings the patch to the colour that it has in the render. nullopt where the patch is black in a
/// channel or clipped (at or above 0.995 in any).
std::optional<PhotoBalance> balance_to(glm::vec3 patch, glm::vec3 target);
/// What grey card (0.18) and white paper (0.9) reflect.
inline constexpr float kGreyCard = 0.18f;
inline constexpr float kWhitePaper = 0.9f;

/// Where a view's fraction (of the square in its middle) lies, in pixels.
glm::dvec2 pixel_of(glm::dvec2 fraction, glm::ivec2 view_px);

/// A fit to begin with: the view's points are the corners of the flat quad as the camera sees it, or of the
/// square around the unit sphere; the photo's are what lies there without a fit, so that nothing moves before
/// a point does.
PhotoFit first_fit(bool flat, const Camera& camera, glm::ivec2 photo_px);

/// From the pixels of a view of that size to those of the photo. nullopt where the fit's points are
/// degenerate.
std::optional<glm::dmat3> view_to_photo(const Photo& photo, glm::ivec2 photo_px, glm::ivec2 view_px);
/// The photo in the view's frame, balanced: 4 channels. Throws std::runtime_error with one sentence that
/// names the photo where its fit is degenerate.
Image photo_in_view(const Photo& photo, const Image& linear, glm::ivec2 view_px);

struct Residual {
    int pixels = 0;           ///< compared; 0: nothing lies in the region, the rest means nothing
    float delta_e = 0.0f;     ///< CIEDE2000, mean
    float delta_e_95 = 0.0f;  ///< nineteen twentieths are below
    float luminance_bias =
        0.0f;  ///< (render − photo) / photo of the mean luminances; > 0: the render is brighter
    float luminance_rms = 0.0f;  ///< root mean square of render − photo, over the photo's mean luminance
};
/// Over what the photo covers of the region with finite numbers; values above 1 count as 1 for ΔE, as on
/// paper, not for luminance.
/// delta_e: where each pixel's ΔE2000 goes, negative where nothing is compared: 1 channel of F32.
Residual residual_of(const Image& photo_in_view, const Image& render, const std::optional<Region>& region,
                     Image* delta_e = nullptr);
/// Where the pictures of differences end.
inline constexpr float kHeatWhite = 20.0f;      ///< ΔE2000
inline constexpr float kLuminanceWhite = 1.0f;  ///< of the photo's mean luminance

/// Luminance of render − photo over the photo's mean luminance, as Residual has it of all pixels: 8-bit sRGB,
/// blue where the render is darker, red where it is brighter, at the ends from `white` on; mid-grey where
/// nothing is compared.
Image luminance_picture(const Image& photo_in_view, const Image& render, const std::optional<Region>& region,
                        float white);
/// Black through blue, red and yellow to white for 0…1; sRGB.
glm::vec3 heat_color(float t);
/// 8-bit sRGB picture of it: black at 0 through blue, red and yellow to white at `white` and above; mid-grey
/// where it is negative.
Image heat_picture(const Image& values, float white);

/// One trial: the parameter moved by so much leaves that mean ΔE.
struct Trial {
    float offset = 0.0f;
    float delta_e = 0.0f;
};
struct Estimate {
    float offset = 0.0f;   ///< where the parabola through the best trial and its neighbours is lowest
    float delta_e = 0.0f;  ///< expected there
    float now = 0.0f;      ///< the trial at offset 0
    /// Better by more than a tenth and by more than half a just noticeable difference; or by half of that
    /// where it leaves less than a quarter of the difference: noise does not do that.
    bool clear = false;
};
/// nullopt with fewer than three trials or none at 0. Trials in order of offset.
std::optional<Estimate> estimate_offset(std::span<const Trial> trials);

/// What a camera wrote: nullopt where it did not.
struct CameraExif {
    std::optional<float> exposure_s, f_number, iso, focal_mm;
    std::string camera;  ///< make and model
    std::string taken;   ///< as written
};
CameraExif exif_of(std::span<const std::pair<std::string, std::string>> metadata);
/// EV at ISO 100: log2(N²/t) − log2(ISO/100). nullopt where one is missing.
std::optional<float> exposure_value(const CameraExif& exif);
/// "Canon EOS 80D, 1/125 s, f/5.6, ISO 200"; what is missing is left out.
std::string describe(const CameraExif& exif);

}  // namespace patina

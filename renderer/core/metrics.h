// How far a picture is from its reference, in numbers and as a map. Pure.
#pragma once

#include "renderer/core/image.h"

namespace patina {

/// |x − r|/max(r, 10⁻³ · mean r) over pixels and channels; mask: where to look (empty: everywhere).
struct PictureError {
    double rms = 0.0, p95 = 0.0, max = 0.0;
    std::size_t pixels = 0;
};
/// Both 3 channels of linear light; mask: 1 channel, where it is ≥ ½ a pixel counts.
PictureError picture_error(const Image& picture, const Image& reference, const Image& mask = {});

/// The same at each pixel: the mean of its channels' errors. 1 channel, F32.
Image relative_error(const Image& picture, const Image& reference);

/// Luminance of picture − reference, linear. 1 channel, F32.
Image signed_difference(const Image& picture, const Image& reference);

/// Mean of a 1-channel picture where the mask (as above) says.
double mean_value(const Image& values, const Image& mask = {});

/// Values 0 … white of a 1-channel picture as colours that get lighter at an even pace, dark blue to yellow
/// (viridis, van der Walt & Smith 2015). 3 channels, U8, sRGB.
Image viridis_picture(const Image& values, double white);
/// One colour of it, t in 0…1; sRGB code values 0…1.
void viridis(double t, float rgb[3]);

/// −1 … 1 as colours: blue through grey to red, equally light on both sides. sRGB code values 0…1.
void diverging(double t, float rgb[3]);

/// How two pictures are held against each other: signed_difference, relative_error or hdr_flip.
enum class DifferenceKind { Signed, Relative, Flip };
inline constexpr double kSignedWhite = 0.25;  ///< linear light at the ends of the ramp
inline constexpr double kErrorWhite = 0.2;    ///< relative error at the ramp's end
inline constexpr double kFlipWhite = 0.5;
/// The map of that in colours, up to these ends. 3 channels, U8, sRGB. Both: 3 channels of linear light.
Image difference_picture(const Image& picture, const Image& reference, DifferenceKind kind);

}  // namespace patina

// The height of a flat sample's surface from how bright it is, and what follows from the height: normals and
// how much of the surroundings each place sees. Pure.
//
// Heights are in widths of the picture, up is towards the viewer.
#pragma once

#include "renderer/core/fourier.h"
#include "renderer/core/map_settings.h"
#include "renderer/maps/grid.h"

#include <complex>
#include <functional>

namespace patina {

/// A factor for each frequency (cycles a pixel, −½…½, y downwards); that of −f must be the conjugate.
using Filter = std::function<std::complex<float>(float fx, float fy)>;
/// Convolves; a picture that is not tileable is continued by its mirror image.
Plane filtered(const Plane& picture, bool tileable, const FourierTransform& fourier, const Filter& filter);
/// Lets waves longer than length_px through, half of the amplitude at it.
Filter low_pass(float length_px);

/// The height of each pixel, mean 0, from the logarithm of light. Forms longer than settings.relief_scale are
/// left out.
///
/// Brightness: the height follows the logarithm of light, its root mean square slope 0.25 · relief_strength.
/// Light: a lamp at angle t from the normal, from direction l, gives a slope ∂h/∂l the light 1 − tan t ·
/// ∂h/∂l to first order (Pentland: Linear shape from shading, Int. J. Computer Vision 1990); this is solved
/// for h frequency by frequency. Waves that run along the light are not seen and stay flat: divided by |D|² +
/// (0.15 |2πf|)² instead of |D|², D the derivative along the light.
Plane relief_of(const Plane& log_light, const MapSettings& settings, const FourierTransform& fourier);

/// Tangent-space normals of a height, +X right, +Y up in the picture, by central differences.
Colors normals_of(const Plane& height, bool tileable);

/// How much of a cloudy sky's light each place gets past its surroundings, 0…1: the horizon's elevation e in
/// 16 directions leaves cos² e of each. The height counts strength times.
Plane visibility_of(const Plane& height, const MapSettings& settings);

}  // namespace patina

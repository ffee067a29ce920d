// The discrete Fourier transform of a picture, by OpenImageIO in the module patina_images.
#pragma once

#include "renderer/core/image.h"

namespace patina {

struct FourierTransform {
    /// 1 channel of F32 → 2 (real, imaginary) of the same size, row and column 0 the mean's. Unitary: the sum
    /// of squares stays.
    Image (*forward)(const Image& picture) = nullptr;
    /// And back; what would be imaginary is dropped.
    Image (*inverse)(const Image& spectrum) = nullptr;
};

/// Loads the module with the first call. Throws std::runtime_error with one sentence where it is missing.
const FourierTransform& fourier_transform();

inline constexpr const char* kFourierEntry = "patina_fourier_transform";

}  // namespace patina

// The perspective map between two pictures of a plane, from four points, and pictures resampled through it.
// Knows no file.
#pragma once

#include "renderer/core/image.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <array>
#include <optional>

namespace patina {

using FourPoints = std::array<glm::dvec2, 4>;

/// H with to ~ H·from in homogeneous coordinates; nullopt where three of the points lie on a line (no
/// perspective map does that). Four-point direct linear transform in coordinates normalised to centroid 0 and
/// mean distance √2 (Hartley, In defense of the eight-point algorithm, PAMI 1997).
std::optional<glm::dmat3> homography(const FourPoints& from, const FourPoints& to);

glm::dvec2 mapped(const glm::dmat3& h, glm::dvec2 point);

/// The photo as seen through to_photo, which takes continuous pixel coordinates of the result ((0,0) its
/// upper left corner) to those of the photo: 4 channels of F32, the fourth 1 where the photo covers the
/// pixel, 0 elsewhere. Bilinear, with up to 8×8 samples a pixel where the photo is finer. photo: 3 channels
/// of F32; size ≥ 1×1.
Image warped(const Image& photo, const glm::dmat3& to_photo, glm::ivec2 size);

}  // namespace patina

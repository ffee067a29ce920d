// Radiance pictures (.hdr, .pic) from bytes, as in Greg Ward's "The RADIANCE Picture File Format": every
// legal header and scan order, flat and both run-length encodings. Knows no file.
#pragma once

#include "renderer/core/image.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace patina {

/// What the text before the pixels says.
struct RadianceHeader {
    std::int64_t width = 0;  ///< of the picture as it is to be seen
    std::int64_t height = 0;
    bool columns_first = false;  ///< scanlines are columns: the X axis is named first
    bool bottom_up = false;      ///< +Y: the first row is the lowest
    bool right_to_left = false;  ///< −X
    bool xyz = false;            ///< 32-bit_rle_xyze
    glm::dvec3 exposure{
        1.0};              ///< product of all EXPOSURE and COLORCORR lines: pixels are radiance times this
    std::size_t size = 0;  ///< bytes before the pixels
    std::vector<std::string> notes;
    std::string problem;  ///< why it cannot be read; empty where it can
};
RadianceHeader parse_radiance_header(std::span<const std::byte> bytes);

struct RadiancePicture {
    Image image;  ///< three floats a pixel: radiance, Rec. 709 primaries
    std::vector<std::string> notes;
    std::string problem;
};
/// bytes is the whole file that header was parsed from; header has no problem and a checked size.
RadiancePicture parse_radiance_pixels(std::span<const std::byte> bytes, const RadianceHeader& header);

}  // namespace patina

// The split-sum table as the build computed it (make_brdf_table.cpp), ready for a texture of two 16-bit
// channels.
#pragma once

#include "renderer/ibl/bake.h"

#include <cstdint>
#include <span>

namespace patina::embedded {

/// A and B as fractions of 65535, kBrdfTableSize² texels: x over √NoV, y over roughness.
std::span<const std::uint16_t> brdf_table();

}  // namespace patina::embedded

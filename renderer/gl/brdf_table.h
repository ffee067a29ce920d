// The split-sum table as the build computed it (make_brdf_table.cpp), ready for a texture of two 16-bit
// channels.
#pragma once

#include <cstdint>
#include <span>

namespace patina {

/// Texels a side. Between them a fetch errs by up to 4e-4 where NoV ≥ 0.001; half as many would err by 2e-3
/// where NoV and roughness are both near 0, for there A and B depend on NoV/α.
inline constexpr int kShadingTableSize = 384;

}  // namespace patina
namespace patina::embedded {

/// A and B as fractions of 65535, kShadingTableSize² texels from end to end: x over √NoV, y over roughness.
std::span<const std::uint16_t> brdf_table();

}  // namespace patina::embedded

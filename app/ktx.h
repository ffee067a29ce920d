// Baked light as KTX files, the containers that Filament and three.js read: one half-float RGBA cube map
// whose mips are prefiltered levels. Bytes out; knows no file.
//
// Mips. Mip k of n is the level of perceptual roughness r_k = 1 − √(1 − k/(n − 1)), which is what Filament's
// shaders look up (lod = (n − 1)·r·(2 − r)). Mip 0 is the environment itself. The last has 16² texels a face.
//
// Orientation. Rows run from the top (origin top-left). In the KTX 1 file the texel in texture direction d
// holds the light from world direction d (right-handed, +Y up), which is how Filament samples it. KTX 2
// prescribes a left-handed cube (+X to the right of +Z), which right-handed viewers, three.js among them,
// sample at (−d.x, d.y, d.z): the KTX 2 file holds the same light mirrored in x.
//
// Range. Half floats end at 65504: where the light is brighter, all of the file, the coefficients included,
// holds light / 2^k, and says so: key "PatinaScale" (KTX 1) and KTXmapRange (KTX 2) hold 2^k.
#pragma once

#include "renderer/ibl/bake.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace patina {

/// Mips of a cube map with base² texels a face. Precondition: base is a power of two ≥ 4.
int ktx_mip_count(int base);
float ktx_roughness(int mip, int mip_count);

/// The levels of such a file, lights left in. nullopt only when stopped. Preconditions: as ktx_mip_count;
/// environment not empty.
std::optional<BakedEnvironment> bake_for_ktx(const Environment& environment, int base,
                                             const BakeControl& control);

/// E/π as nine coefficients c of 1, y, z, x, xy, yz, 3z² − 1, zx, x² − y² (least squares over the sphere):
/// what Filament calls pre-scaled irradiance, IndirectLight::Builder::irradiance(3, c).
std::array<glm::vec3, 9> irradiance_coefficients(const CubeMap& irradiance);

/// k ≥ 0 such that everything / 2^k fits half floats. Throws std::runtime_error with one sentence that names
/// source when the light spans more than half floats can hold.
int ktx_exponent(const BakedEnvironment& baked, const std::string& source);

/// Precondition: baked is bake_for_ktx's, exponent ktx_exponent's.
std::vector<std::byte> to_ktx1(const BakedEnvironment& baked, int exponent);
std::vector<std::byte> to_ktx2(const BakedEnvironment& baked, int exponent);

}  // namespace patina

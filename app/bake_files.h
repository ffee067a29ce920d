// What patina bake writes and what it reads back: a folder with bake.json, which names everything else, and
// either face strips as 32-bit float OpenEXR or KTX cube maps.
#pragma once

#include "app/registry.h"
#include "renderer/core/environment.h"
#include "renderer/ibl/bake.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace patina {

/// Both write into an existing folder and give what bake.json says of it (all but its timings). Throw
/// std::runtime_error with one sentence.
nlohmann::ordered_json write_bake_exr(const std::filesystem::path& folder, const Environment& environment,
                                      const BakedEnvironment& baked,
                                      const ParallelFor& parallel_for = serial_for);
/// baked: bake_for_ktx's.
nlohmann::ordered_json write_bake_ktx(const std::filesystem::path& folder, const Environment& environment,
                                      const BakedEnvironment& baked);

/// Whether the path names a bake: a file called bake.json, or a folder that holds one.
bool is_bake(const std::filesystem::path& path);

/// Reads face strips back. The panorama is the sharpest level with the lights drawn in; levels below
/// kSharpestUsable are in it alone. Where no level has roughness 1, the irradiance is that level. Throws
/// std::runtime_error with one sentence that names the file and, in bake.json, line, column and key.
BakedLight load_bake(const std::filesystem::path& path);
inline constexpr float kSharpestUsable = 0.01f;

}  // namespace patina

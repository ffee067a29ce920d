// Light from all around as an equirectangular panorama, and the built-in computed ones. Knows no file and no
// GPU.
//
// Direction d ↔ picture: u = ½ + atan2(d.x, −d.z)/2π, v = acos(d.y)/π, (0,0) the top-left corner; +Y is up.
// The picture's centre is −Z, its right half +X.
#pragma once

#include "renderer/core/image.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

/// width × height texels of scene-linear radiance (Rec. 709 primaries), row 0 at the top; every value finite
/// and ≥ 0.
struct Environment {
    std::string id;  ///< built-in id, or the file's path
    std::string title;
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance;
    std::vector<std::string> notes;  ///< repairs made: "12 NaN texels set to 0", …
    std::uint64_t content_hash = 0;  ///< of size and pixels; equal environments have equal hashes
};

/// Direction (unit) at continuous picture coordinates u, v in 0…1, and back (u in [0,1), v in [0,1]).
glm::vec3 equirect_to_direction(glm::vec2 uv);
glm::vec2 direction_to_equirect(glm::vec3 direction);

/// From any picture of 1…4 channels (grey is spread, alpha dropped; 8- and 16-bit are taken as sRGB-encoded
/// with a note). NaN and negative become 0, Inf the largest finite value present; each counted in notes. Any
/// size, also not 2:1 (noted, taken as a full panorama). Throws std::runtime_error on an empty image.
Environment make_environment(const Image& image, std::string id, std::string title);
/// And back: its radiance, 3 channels of floats.
Image radiance_image(const Environment& environment);

/// What is kept of environments elsewhere ends with this number: raised whenever a file or a built-in
/// environment becomes other radiance, another title or other notes.
inline constexpr int kEnvironmentVersion = 1;

/// Of size and pixels. Whoever builds an Environment by hand sets content_hash to it.
std::uint64_t environment_hash(const Environment& environment);

/// A computed environment that needs no file.
struct BuiltinEnvironment {
    std::string_view id;
    std::string_view title;
    std::string_view description;    ///< one sentence for a student
    Environment (*make)(int width);  ///< width × width/2 texels; deterministic
};

/// studio, sky, sunset, overcast, night, furnace, test — in the order shown.
std::span<const BuiltinEnvironment> builtin_environments();
inline constexpr int kBuiltinEnvironmentWidth = 1024;

}  // namespace patina

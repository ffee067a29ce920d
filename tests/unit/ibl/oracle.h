// What the baker is judged by: environments made in place, a scratch folder.
#pragma once

#include "renderer/ibl/bake.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace patina::test {

/// width × height, radiance(direction) averaged over 3 × 3 points of each texel; content_hash set.
Environment make_panorama(int width, int height, const std::function<glm::dvec3(glm::dvec3)>& radiance);

Environment constant_panorama(int width, int height, glm::vec3 value);
/// A coloured sky over a dark ground with fine detail and a sun of that radiance and angular radius.
Environment sunny_panorama(int width, int height, double sun_radiance, double sun_radius_rad);
/// A dark room with bright rectangles of hard edges.
Environment studio_panorama(int width, int height);
/// Independent random texels (uniform), the least smooth panorama there is.
Environment noise_panorama(int width, int height, unsigned seed);

/// Mean radiance over the sphere, texels weighted by their exact solid angle.
glm::dvec3 mean_radiance(const Environment& environment);

/// A folder of its own, removed at the end.
class ScratchFolder {
public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace patina::test

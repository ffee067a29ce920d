// What the renderer's tests share: one context and renderer a process, light made from a formula, and pixels
// to look at.
#pragma once

#include "renderer/renderer.h"

#include <glm/glm.hpp>

#include <functional>

namespace patina::test {

/// The process's only context and renderer, made at first use.
Renderer& renderer();

using Radiance = std::function<glm::vec3(glm::vec3 direction)>;
/// Radiance after the lobe of that roughness; 1 stands for the irradiance (E/π) too.
using Filtered = std::function<glm::vec3(glm::vec3 direction, float roughness)>;

Environment make_panorama(const Radiance& radiance, int width = 128);
/// Standard roughness levels of decreasing size whose texels are given by a formula.
BakedEnvironment make_baked(const Filtered& filtered, int size = 16);

EnvironmentHandle constant_light(float radiance);
/// L = ½ + ⅖ d: each axis has its colour, and every direction its own. Filtered: the slope shrinks to
/// slope(r).
EnvironmentHandle linear_light();
glm::vec3 linear_radiance(glm::vec3 direction, float slope = 0.4f);
float linear_slope(float roughness);

MeshHandle sphere();
MeshHandle quad();

/// A scene without maps, tone mapper none, and its picture.
Scene make_scene(EnvironmentHandle environment, MeshHandle mesh);
Image radiance_of(const Scene& scene, glm::ivec2 size = glm::ivec2(128), int samples = 1);
Image display_of(const Scene& scene, glm::ivec2 size = glm::ivec2(128), int samples = 1);

glm::vec3 pixel(const Image& image, int x, int y);
glm::vec3 center(const Image& image);

/// World direction through a pixel's centre.
glm::vec3 ray_through(const Camera& camera, glm::ivec2 size, int x, int y);
/// Nearest distance at which the ray meets the unit sphere, negative if it does not.
float hit_unit_sphere(glm::vec3 origin, glm::vec3 ray);

/// An RGB picture from a formula over x and y.
Image make_picture(int width, int height, const std::function<glm::ivec3(int x, int y)>& color);

}  // namespace patina::test

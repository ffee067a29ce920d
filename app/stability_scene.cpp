#include "app/stability_scene.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {

using glm::dvec3;
using glm::vec3;

namespace {

constexpr double kPi = std::numbers::pi;

dvec3 texel_direction(int x, int y, int width, int height) {
    const double azimuth = ((x + 0.5) / width - 0.5) * 2.0 * kPi;
    const double polar = (y + 0.5) / height * kPi;
    return {std::sin(azimuth) * std::sin(polar), std::cos(polar), -std::cos(azimuth) * std::sin(polar)};
}

const BuiltinMesh& builtin_mesh(std::string_view id) {
    for (const BuiltinMesh& mesh : builtin_meshes())
        if (mesh.id == id) return mesh;
    return builtin_meshes().front();
}

}  // namespace

Environment panorama_of(const std::function<dvec3(dvec3)>& radiance, int width, int height) {
    Environment environment;
    environment.width = width;
    environment.height = height;
    environment.radiance.reserve(std::size_t(width) * height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            environment.radiance.emplace_back(radiance(texel_direction(x, y, width, height)));
    environment.content_hash = environment_hash(environment);
    return environment;
}

SoftLight::SoftLight(Random& random) {
    for (int i = 2 + random.below(4); i > 0; --i)
        lobes.push_back({random.direction(), dvec3(random.uniform(), random.uniform(), random.uniform()),
                         random.log_between(1.0, 20.0)});
}

dvec3 SoftLight::operator()(dvec3 direction) const {
    dvec3 sum(0.1);
    for (const Lobe& lobe : lobes)
        sum += lobe.color * std::exp(lobe.sharpness * (glm::dot(lobe.axis, direction) - 1.0));
    return sum;
}

Environment sunny_panorama(int width, double sun_over_mean, Random& random) {
    const SoftLight sky(random);
    const dvec3 sun = random.direction();
    return panorama_of(
        [&](dvec3 d) {
            const bool inside = glm::dot(d, sun) > std::cos(2.0 * kPi / 180.0);
            return sky(d) + dvec3(inside ? sun_over_mean : 0.0);
        },
        width, width / 2);
}

Environment any_panorama(Random& random) {
    const bool is_regular = random.chance(0.5);
    const int height = 1 + random.below(48);
    const int width = is_regular ? 2 * height : 1 + random.below(96);
    const double scale = std::pow(2.0, random.between(-60.0, 40.0));
    const int kind = random.below(5);
    const SoftLight sky(random);
    Environment environment = panorama_of(
        [&](dvec3 d) {
            if (kind == 0) return dvec3(0.0);
            if (kind == 1) return scale * dvec3(1.0, 0.5, 0.25);
            if (kind == 2) return scale * dvec3(random.uniform(), random.uniform(), random.uniform());
            return scale * sky(d);
        },
        width, height);
    if (kind == 4 || random.chance(0.2))  // one texel, up to the brightest a loader lets in
        environment.radiance[std::size_t(random.below(width * height))] =
            vec3(float(random.chance(0.2) ? 1e18 : scale * random.log_between(1e2, 1e6)));
    environment.content_hash = environment_hash(environment);
    return environment;
}

EnvironmentHandle upload_light(Stage& stage, const Environment& environment) {
    BakeSettings settings;
    settings.roughness = {0.1f, 0.17f, 0.3f, 0.55f, 1.0f};
    settings.max_face_size = 32;
    settings.extract_lights = true;
    return stage.renderer().upload_environment(environment, *bake_environment(environment, settings, {}));
}

bool keeps_energy(Shading mode) { return mode != Shading::Course && mode != Shading::Reference; }

Image drawn_radiance(Stage& stage, const Scene& scene, glm::ivec2 size) {
    const TargetHandle target = stage.renderer().make_target(size, 1, TargetPrecision::Full);
    stage.renderer().draw(scene, *target);
    return stage.renderer().read_radiance(*target);
}

Mesh probe_mesh(int side, const std::function<vec3(int x, int y)>& normal) {
    Mesh mesh;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto first = std::uint32_t(mesh.vertices.size());
            const vec3 N = normal(x, y);
            for (int corner = 0; corner < 4; ++corner) {
                const glm::vec2 at(float(x + (corner & 1)) / float(side),
                                   float(y + (corner >> 1)) / float(side));
                Vertex vertex;
                vertex.position = vec3(2.0f * at.x - 1.0f, 1.0f - 2.0f * at.y, 0.0f);
                vertex.normal = N;
                vertex.uv = {at.x, 1.0f - at.y};
                mesh.vertices.push_back(vertex);
            }
            for (const std::uint32_t i : {0u, 2u, 1u, 1u, 2u, 3u}) mesh.indices.push_back(first + i);
        }
    mesh.has_tangents = false;
    return mesh;
}

Camera probe_camera() {
    Camera camera;
    camera.distance = 1000.0f;
    camera.fov_deg = float(2.0 * std::atan(1.0 / 1000.0) * 180.0 / kPi);
    return camera;
}

std::vector<FurnacePixel> furnace_pixels(Stage& stage, Shading mode, float roughness, float metallic) {
    Scene scene;
    scene.environment = upload_light(stage, panorama_of([](dvec3) { return dvec3(1.0); }, 16, 8));
    scene.mesh = stage.renderer().upload_mesh(builtin_mesh("sphere").make());
    scene.material.albedo.value = vec3(1.0f);
    scene.material.roughness.value = roughness;
    scene.material.metallic.value = metallic;
    scene.view.shading = mode;
    constexpr int side = 64;
    const Image image = drawn_radiance(stage, scene, glm::ivec2(side));
    // Where the ray through a pixel meets the unit sphere, N is that point.
    const dvec3 eye(camera_position(scene.camera));
    const double half = std::tan(0.5 * glm::radians(double(scene.camera.fov_deg)));
    std::vector<FurnacePixel> pixels;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const dvec3 ray = glm::normalize(
                dvec3((2.0 * (x + 0.5) / side - 1.0) * half, (1.0 - 2.0 * (y + 0.5) / side) * half, -1.0));
            const double b = glm::dot(eye, ray), root2 = b * b - glm::dot(eye, eye) + 1.0;
            FurnacePixel pixel{.NoV = root2 > 0.0 ? std::sqrt(root2) : 0.0};
            for (int c = 0; c < 3; ++c)
                pixel.error = std::max(pixel.error, std::abs(double(texel(image, x, y, c)) - 1.0));
            pixels.push_back(pixel);
        }
    return pixels;
}

}  // namespace patina

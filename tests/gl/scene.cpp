#include "tests/gl/scene.h"

#include "app/headless.h"

#include <cmath>

namespace patina::test {

namespace {

struct Gl {
    HeadlessContext context;
    Renderer renderer;
};

const BuiltinMesh& builtin(std::string_view id) {
    for (const BuiltinMesh& mesh : builtin_meshes())
        if (mesh.id == id) return mesh;
    throw std::runtime_error("no such mesh");
}

}  // namespace

Renderer& renderer() {
    static auto* gl = new Gl;  // lives until the process ends: the driver outlives static destructors
    return gl->renderer;
}

Environment make_panorama(const Radiance& radiance, int width) {
    Environment environment;
    environment.width = width;
    environment.height = width / 2;
    for (int y = 0; y < environment.height; ++y)
        for (int x = 0; x < width; ++x)
            environment.radiance.push_back(radiance(equirect_to_direction(
                {(float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(environment.height)})));
    environment.content_hash = environment_hash(environment);
    return environment;
}

BakedEnvironment make_baked(const Filtered& filtered, int size) {
    const auto cube = [&](int side, float roughness) {
        CubeMap map{side, {}};
        for (int row = 0; row < 6 * side; ++row)
            for (int x = 0; x < side; ++x)
                map.texels.push_back(
                    filtered(cube_texel_direction(side, row / side, x, row % side), roughness));
        return map;
    };
    BakedEnvironment baked;
    const auto levels = standard_roughness_levels();
    for (std::size_t i = 0; i < levels.size(); ++i)
        baked.levels.push_back({levels[i], cube(size >> std::min<std::size_t>(i / 5, 2), levels[i])});
    baked.irradiance = cube(size, 1.0f);
    return baked;
}

EnvironmentHandle constant_light(float radiance) {
    return renderer().upload_environment(
        make_panorama([&](glm::vec3) { return glm::vec3(radiance); }, 16),
        make_baked([&](glm::vec3, float) { return glm::vec3(radiance); }, 8));
}

glm::vec3 linear_radiance(glm::vec3 direction, float slope) { return 0.5f + slope * direction; }
float linear_slope(float roughness) { return 0.4f - 0.13333f * roughness * roughness; }

EnvironmentHandle linear_light() {
    static const EnvironmentHandle handle = renderer().upload_environment(
        make_panorama([](glm::vec3 d) { return linear_radiance(d); }, 256),
        make_baked([](glm::vec3 d, float r) { return linear_radiance(d, linear_slope(r)); }, 32));
    return handle;
}

MeshHandle sphere() {
    static const MeshHandle handle = [] {
        Mesh mesh = builtin("sphere").make();
        make_tangents(mesh);
        return renderer().upload_mesh(mesh);
    }();
    return handle;
}

MeshHandle quad() {
    static const MeshHandle handle = [] {
        Mesh mesh = builtin("quad").make();
        make_tangents(mesh);
        return renderer().upload_mesh(mesh);
    }();
    return handle;
}

Scene make_scene(EnvironmentHandle environment, MeshHandle mesh) {
    Scene scene;
    scene.environment = std::move(environment);
    scene.mesh = std::move(mesh);
    scene.view.tonemap = Tonemap::None;
    return scene;
}

Image radiance_of(const Scene& scene, glm::ivec2 size, int samples) {
    const TargetHandle target = renderer().make_target(size, samples, TargetPrecision::Full);
    renderer().draw(scene, *target);
    return renderer().read_radiance(*target);
}

Image display_of(const Scene& scene, glm::ivec2 size, int samples) {
    const TargetHandle target = renderer().make_target(size, samples);
    renderer().draw(scene, *target);
    return renderer().read_display(*target);
}

glm::vec3 pixel(const Image& image, int x, int y) {
    return {texel(image, x, y, 0), texel(image, x, y, 1), texel(image, x, y, 2)};
}
glm::vec3 center(const Image& image) { return pixel(image, image.width / 2, image.height / 2); }

glm::vec3 ray_through(const Camera& camera, glm::ivec2 size, int x, int y) {
    const float ndc_x = (2.0f * (float(x) + 0.5f)) / float(size.x) - 1.0f;
    const float ndc_y = 1.0f - (2.0f * (float(y) + 0.5f)) / float(size.y);
    const float aspect = float(size.x) / float(size.y);
    const glm::mat4 inverse = glm::inverse(projection_matrix(camera, aspect) * view_matrix(camera));
    const glm::vec4 far = inverse * glm::vec4(ndc_x, ndc_y, 0.9f, 1.0f);
    return glm::normalize(glm::vec3(far) / far.w - camera_position(camera));
}

float hit_unit_sphere(glm::vec3 origin, glm::vec3 ray) {
    const float b = glm::dot(origin, ray);
    const float root2 = b * b - glm::dot(origin, origin) + 1.0f;
    return root2 < 0.0f ? -1.0f : -b - std::sqrt(root2);
}

Image make_picture(int width, int height, const std::function<glm::ivec3(int x, int y)>& color) {
    Image image = make_image(width, height, 3, PixelType::U8);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) set_texel(image, x, y, c, float(color(x, y)[c]) / 255.0f);
    return image;
}

}  // namespace patina::test

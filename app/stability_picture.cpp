// Properties of the shaders: drawn at full precision, read back, and judged pixel by pixel.
#include "app/stability.h"
#include "app/stability_scene.h"
#include "renderer/core/flip.h"
#include "renderer/core/image.h"
#include "renderer/tonemap.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace patina {

namespace {

using glm::dvec3;
using glm::vec3;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr int kSide = 48;  ///< of the probe's cells and of its picture

/// But the reference, which is not drawn at once.
Shading any_mode(Random& random) {
    Shading mode = Shading::Reference;
    while (mode == Shading::Reference)
        mode = kShadings[std::size_t(random.below(int(kShadings.size())))].value;
    return mode;
}
Shading any_energy_keeping_mode(Random& random) {
    Shading mode = any_mode(random);
    while (!keeps_energy(mode)) mode = any_mode(random);
    return mode;
}

vec3 pixel(const Image& image, int x, int y) {
    return {texel(image, x, y, 0), texel(image, x, y, 1), texel(image, x, y, 2)};
}

/// Calls visit(x, y, colour) for every pixel.
template <class Visit>
void each_pixel(const Image& image, const Visit& visit) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) visit(x, y, pixel(image, x, y));
}

/// A normal that the probe's viewer, at +Z, sees: NoV from 1e-6 to 1, grazing ones often.
vec3 seen_normal(Random& random) {
    const double NoV = random.chance(0.4) ? random.log_between(1e-6, 1.0) : random.uniform();
    const double phi = random.between(0.0, 2.0 * std::numbers::pi), ring = std::sqrt(1.0 - NoV * NoV);
    return {ring * std::cos(phi), ring * std::sin(phi), NoV};
}
MeshHandle seen_probe(Stage& stage, Random& random) {
    return stage.renderer().upload_mesh(probe_mesh(kSide, [&](int, int) { return seen_normal(random); }));
}

Scene probe_scene(EnvironmentHandle light, MeshHandle mesh, Shading mode) {
    Scene scene;
    scene.environment = std::move(light);
    scene.mesh = std::move(mesh);
    scene.camera = probe_camera();
    scene.view.shading = mode;
    return scene;
}

float edgy_unit(Random& random) {
    constexpr float edges[] = {0.0f, 1e-45f, 1e-20f, 1e-4f, 0.0999f, 0.1f, 1.0f};
    return random.chance(0.4) ? edges[random.below(int(std::size(edges)))] : float(random.uniform());
}

void make_material(Material& material, Random& random) {
    material.albedo.value = {edgy_unit(random), edgy_unit(random), edgy_unit(random)};
    material.roughness.value = edgy_unit(random);
    material.metallic.value = edgy_unit(random);
    material.ao.value = edgy_unit(random);
}

// The broken scene: everything a file could get wrong at once.

Mesh broken_mesh(Random& random) {
    constexpr float odd[] = {0.0f,  -0.0f, 1e-45f, 1e-30f, -1e-8f, 1.0f,
                             -1.0f, 1e20f, -3e38f, kNan,   kInf,   -kInf};
    const auto some = [&](float usual) {
        return random.chance(0.3) ? odd[random.below(int(std::size(odd)))] : usual;
    };
    Mesh mesh = probe_mesh(kSide, [&](int, int) { return vec3(random.direction()); });
    for (Vertex& vertex : mesh.vertices) {
        const vec3 N = vertex.normal;
        vertex.normal = {some(N.x), some(N.y), some(N.z)};
        if (random.chance(0.1)) vertex.normal = vec3(0.0f);
        vertex.uv = {some(vertex.uv.x), some(vertex.uv.y)};
        vertex.tangent = {some(1.0f), some(0.0f), some(0.0f), some(1.0f)};
        if (random.chance(0.01)) vertex.position.z = some(0.0f);
    }
    mesh.has_tangents = random.chance(0.5);
    return mesh;
}

Image broken_map(Random& random) {
    constexpr float odd[] = {0.0f, 1.0f, -1.0f, 0.5f, 1e30f, -1e30f, 1e-30f, kNan, kInf, -kInf};
    const int kind = random.below(4);
    Image image = make_image(1 + random.below(9), 1 + random.below(9), 4, PixelType::F32);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 4; ++c)
                set_texel(image, x, y, c,
                          kind == 0   ? 0.0f
                          : kind == 1 ? 1.0f
                                      : odd[random.below(int(std::size(odd)))]);
    // Never grey, which would be stored in another format: software GL compiles a shader for each.
    for (int c = 0; c < 4; ++c) set_texel(image, 0, 0, c, 0.25f * float(c));
    return image;
}

void count_broken(const Image& image, Trial& trial) {
    each_pixel(image, [&](int, int, vec3 color) {
        bool is_sane = true;
        for (int c = 0; c < 3; ++c) is_sane = is_sane && std::isfinite(color[c]) && color[c] >= 0.0f;
        trial.require(is_sane);
    });
}

/// All maps or none: few programs to compile.
void break_material(Scene& scene, Random& random, Stage& stage) {
    make_material(scene.material, random);
    if (random.chance(0.5)) {
        for (std::size_t slot = 0; slot < scene.maps.size(); ++slot)
            scene.maps[slot] = stage.renderer().upload_map(make_map_levels(
                broken_map(random), slot == std::size_t(MapSlot::Normal) ? MapKind::Normal : MapKind::Data,
                ColorSpace::Linear));
        scene.material.albedo.value += 0.1f;
        scene.material.roughness.value += 0.1f;
        scene.material.metallic.value += 0.1f;
        scene.material.ao.value += 0.1f;
        scene.material.emission.value = vec3(float(random.log_between(1e-30, 3e38)));
        scene.material.normal.value = float(random.log_between(0.01, 4.0));
    }
    if (random.chance(0.2)) {
        constexpr float scales[] = {0.0f, 1e-20f, -1.0f, 1e20f};
        scene.material.uv.scale = glm::vec2(scales[random.below(4)], scales[random.below(4)]);
        scene.material.uv.rotation_deg = float(random.log_between(1.0, 1e20));
    }
}

/// The final picture or an ingredient of it, from near and far, through and behind the mesh.
void break_view(Scene& scene, Random& random) {
    scene.view.shading = any_mode(random);
    scene.view.exposure_ev = float(random.between(-30.0, 30.0));
    scene.view.env_rotation_deg = float(random.between(-720.0, 720.0));
    if (random.chance(0.2))
        scene.view.debug = kDebugViews[std::size_t(random.below(int(kDebugViews.size())))].value;
    scene.view.background = random.chance(0.5) ? Background::Environment : Background::Blurred;
    if (random.chance(0.1)) scene.camera.distance = float(random.log_between(1e-6, 1e8));
    if (random.chance(0.1)) scene.camera.yaw_deg = 180.0f;
}

Trial pixels_are_sane(Random& random, Stage& stage) {
    const Scene broken = probe_scene(upload_light(stage, any_panorama(random)),
                                     stage.renderer().upload_mesh(broken_mesh(random)), Shading::SplitSum);
    Trial trial;
    for (int view = 0; view < 4; ++view) {
        Scene scene = broken;
        break_material(scene, random, stage);
        break_view(scene, random);
        count_broken(drawn_radiance(stage, scene, glm::ivec2(kSide)), trial);
    }
    return trial;
}

// The furnace.

EnvironmentHandle white_light(Stage& stage) {
    return upload_light(stage, panorama_of([](dvec3) { return dvec3(1.0); }, 16, 8));
}

Trial white_furnace(Random& random, Stage& stage) {
    Scene scene = probe_scene(white_light(stage), seen_probe(stage, random), any_energy_keeping_mode(random));
    scene.material.albedo.value = vec3(1.0f);
    scene.material.roughness.value = edgy_unit(random);
    scene.material.metallic.value = random.chance(0.5) ? 0.0f : 1.0f;
    Trial trial;
    each_pixel(drawn_radiance(stage, scene, glm::ivec2(kSide)), [&](int, int, vec3 color) {
        for (int c = 0; c < 3; ++c) trial.add(std::abs(double(color[c]) - 1.0));
    });
    return trial;
}

Trial darker_furnace(Random& random, Stage& stage) {
    Scene scene = probe_scene(white_light(stage), seen_probe(stage, random), any_energy_keeping_mode(random));
    make_material(scene.material, random);
    Trial trial;
    each_pixel(drawn_radiance(stage, scene, glm::ivec2(kSide)), [&](int, int, vec3 color) {
        for (int c = 0; c < 3; ++c) trial.add(std::max(double(color[c]) - 1.0, 0.0));
    });
    return trial;
}

// What must not change the picture.

Trial exposure_scales(Random& random, Stage& stage) {
    Scene scene = probe_scene(upload_light(stage, sunny_panorama(64, random.log_between(1.0, 1e6), random)),
                              seen_probe(stage, random), any_mode(random));
    make_material(scene.material, random);
    const Image plain = drawn_radiance(stage, scene, glm::ivec2(kSide));
    scene.view.exposure_ev = float(random.between(-20.0, 20.0));
    const double factor = std::exp2(double(scene.view.exposure_ev));
    Trial trial;
    each_pixel(drawn_radiance(stage, scene, glm::ivec2(kSide)), [&](int x, int y, vec3 color) {
        const vec3 before = pixel(plain, x, y);
        for (int c = 0; c < 3; ++c)
            trial.add(std::abs(color[c] - before[c] * factor) / std::max(before[c] * factor, 1e-30));
    });
    return trial;
}

const BuiltinMesh& any_builtin(Random& random) {
    constexpr std::string_view few_triangles[] = {"quad", "cube", "torus"};
    const std::string_view wanted = few_triangles[random.below(3)];
    for (const BuiltinMesh& mesh : builtin_meshes())
        if (mesh.id == wanted) return mesh;
    return builtin_meshes().front();
}

constexpr int kPictureSide = 96;
Image drawn_display(Stage& stage, const Scene& scene) {
    const TargetHandle target = stage.renderer().make_target(glm::ivec2(kPictureSide), 1);
    stage.renderer().draw(scene, *target);
    return stage.renderer().read_display(*target);
}

/// How different the pictures look to a person who flips between them, over all pixels; mirrored: the second
/// one is seen from right to left.
double mean_flip(const Image& a, Image b, bool mirrored) {
    for (int y = 0; mirrored && y < b.height; ++y)
        for (int x = 0; x < b.width / 2; ++x)
            for (int c = 0; c < 3; ++c) {
                const float left = texel(b, x, y, c);
                set_texel(b, x, y, c, texel(b, b.width - 1 - x, y, c));
                set_texel(b, b.width - 1 - x, y, c, left);
            }
    const Image difference = flip(a, b);
    double sum = 0.0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) sum += double(texel(difference, x, y, 0));
    return sum / double(a.width * a.height);
}

struct LitMesh {
    Environment environment;
    Mesh mesh;
    Scene scene;
};
LitMesh any_lit_mesh(Random& random, Stage& stage) {
    LitMesh lit{panorama_of(SoftLight(random), 128, 64), any_builtin(random).make(), {}};
    lit.scene.environment = upload_light(stage, lit.environment);
    lit.scene.mesh = stage.renderer().upload_mesh(lit.mesh);
    lit.scene.view.shading = any_mode(random);
    make_material(lit.scene.material, random);
    lit.scene.camera.yaw_deg = float(random.between(-60.0, 60.0));
    lit.scene.camera.pitch_deg = float(random.between(-60.0, 60.0));
    return lit;
}

Trial rotating_everything(Random& random, Stage& stage) {
    LitMesh lit = any_lit_mesh(random, stage);
    const Image before = drawn_radiance(stage, lit.scene, glm::ivec2(kPictureSide));
    const double turn_deg = random.between(0.0, 360.0), turn = glm::radians(turn_deg);
    for (Vertex& vertex : lit.mesh.vertices)
        for (vec3* v : {&vertex.position, &vertex.normal})
            *v = vec3(std::cos(turn) * v->x + std::sin(turn) * v->z, v->y,
                      std::cos(turn) * v->z - std::sin(turn) * v->x);
    lit.scene.mesh = stage.renderer().upload_mesh(lit.mesh);
    lit.scene.camera.yaw_deg += float(turn_deg);
    lit.scene.view.env_rotation_deg += float(turn_deg);
    Trial trial;
    trial.add(mean_flip(before, drawn_radiance(stage, lit.scene, glm::ivec2(kPictureSide)), false));
    return trial;
}

Trial mirroring_everything(Random& random, Stage& stage) {
    LitMesh lit = any_lit_mesh(random, stage);
    const Image before = drawn_radiance(stage, lit.scene, glm::ivec2(kPictureSide));
    for (Vertex& vertex : lit.mesh.vertices) {
        vertex.position.x = -vertex.position.x;
        vertex.normal.x = -vertex.normal.x;
    }
    for (std::size_t i = 0; i + 2 < lit.mesh.indices.size(); i += 3)
        std::swap(lit.mesh.indices[i + 1], lit.mesh.indices[i + 2]);
    Environment& light = lit.environment;
    for (int y = 0; y < light.height; ++y) {
        const auto row = light.radiance.begin() + std::ptrdiff_t(y) * light.width;
        std::reverse(row, row + light.width);
    }
    light.content_hash = environment_hash(light);
    lit.scene.environment = upload_light(stage, light);
    lit.scene.mesh = stage.renderer().upload_mesh(lit.mesh);
    lit.scene.camera.yaw_deg = -lit.scene.camera.yaw_deg;
    Trial trial;
    trial.add(mean_flip(before, drawn_radiance(stage, lit.scene, glm::ivec2(kPictureSide)), true));
    return trial;
}

/// Share of pixels that differ by more than one of 255 steps.
Trial mesh_scale(Random& random, Stage& stage) {
    LitMesh lit = any_lit_mesh(random, stage);
    normalize_to_unit_sphere(lit.mesh);
    lit.scene.mesh = stage.renderer().upload_mesh(lit.mesh);
    const Image before = drawn_display(stage, lit.scene);
    const double scale = std::pow(10.0, random.between(-6.0, 6.0));
    for (Vertex& vertex : lit.mesh.vertices) vertex.position = vec3(dvec3(vertex.position) * scale);
    normalize_to_unit_sphere(lit.mesh);
    lit.scene.mesh = stage.renderer().upload_mesh(lit.mesh);
    const Image after = drawn_display(stage, lit.scene);
    int different = 0;
    each_pixel(before, [&](int x, int y, vec3 color) {
        const vec3 d = glm::abs(color - pixel(after, x, y));
        if (std::max({d.x, d.y, d.z}) > 1.5f / 255.0f) ++different;
    });
    Trial trial;
    trial.add(double(different) / (kPictureSide * kPictureSide));
    return trial;
}

// Where light is stored in pieces, and where parameters end.

/// A direction on a cube's edge or corner, or where the panorama's two ends meet.
dvec3 on_a_seam(Random& random) {
    const double along = random.between(-1.0, 1.0);
    const auto sign = [&] { return random.chance(0.5) ? 1.0 : -1.0; };
    dvec3 d(sign(), sign(), along);
    const int kind = random.below(5);
    if (kind == 3) d = {sign(), sign(), sign()};
    if (kind == 4) return {0.0, std::sin(along * 1.5), std::cos(along * 1.5)};  // u = 0 and 1: +Z
    for (int turns = kind; turns > 0; --turns) d = {d.z, d.x, d.y};
    return glm::normalize(d);
}

/// Reflections just beside a seam, on both sides of it, against each other.
Trial seams_do_not_show(Random& random, Stage& stage) {
    const dvec3 V(0.0, 0.0, 1.0);
    const double turn = random.between(0.0, 2.0 * std::numbers::pi);
    const auto reflection = [&] {
        while (true) {
            const dvec3 d = on_a_seam(random);  // the environment turned by `turn` brings it to:
            const dvec3 R(std::cos(turn) * d.x + std::sin(turn) * d.z, d.y,
                          std::cos(turn) * d.z - std::sin(turn) * d.x);
            if (R.z > -0.7) return R;
        }
    };
    constexpr double step = 2e-5;
    dvec3 N(0.0), across(0.0);
    const Mesh mesh = probe_mesh(kSide, [&](int x, int) {
        if (x % 2 == 0) {
            N = glm::normalize(reflection() + V);
            across = glm::normalize(glm::cross(N, random.direction()));
        }
        return vec3(N + (x % 2 == 0 ? -step : step) * across);
    });
    Scene scene = probe_scene(upload_light(stage, panorama_of(SoftLight(random), 128, 64)),
                              stage.renderer().upload_mesh(mesh), any_mode(random));
    scene.camera.distance = 1e5f;  // neighbours see it from the same direction
    scene.camera.fov_deg = float(glm::degrees(2.0 * std::atan(1e-5)));
    scene.view.env_rotation_deg = float(glm::degrees(turn));
    scene.material.roughness.value = edgy_unit(random);
    scene.material.metallic.value = random.chance(0.7) ? 1.0f : 0.0f;
    const Image image = drawn_radiance(stage, scene, glm::ivec2(kSide));
    Trial trial;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; x += 2) {
            const vec3 a = pixel(image, x, y), b = pixel(image, x + 1, y);
            for (int c = 0; c < 3; ++c)
                trial.add(std::abs(double(a[c]) - b[c]) / std::max({double(a[c]), double(b[c]), 1e-3}));
        }
    return trial;
}

void relative_step(const Image& a, const Image& b, Trial& trial) {
    double mean = 0.0;
    each_pixel(a, [&](int, int, vec3 color) { mean += double(color.x + color.y + color.z) / 3.0; });
    mean /= double(a.width * a.height);
    each_pixel(a, [&](int x, int y, vec3 color) {
        const vec3 other = pixel(b, x, y);
        for (int c = 0; c < 3; ++c)
            trial.add(std::abs(double(color[c]) - other[c]) /
                      std::max({double(color[c]), 1e-3 * mean, 1e-30}));
    });
}

Trial roughness_steps(Random& random, Stage& stage) {
    Scene scene = probe_scene(upload_light(stage, panorama_of(SoftLight(random), 128, 64)),
                              seen_probe(stage, random), any_mode(random));
    make_material(scene.material, random);
    const float roughness = random.chance(0.5) ? 0.0f : float(random.between(0.0, 0.12));
    scene.material.roughness.value = roughness;
    scene.material.ao.value = 1.0f;  // occlusion of the lobe ends at nothing, where any step is large
    const Image before = drawn_radiance(stage, scene, glm::ivec2(kSide));
    scene.material.roughness.value = roughness + 1e-4f;
    Trial trial;
    relative_step(before, drawn_radiance(stage, scene, glm::ivec2(kSide)), trial);
    return trial;
}

Trial view_steps(Random& random, Stage& stage) {
    const std::uint64_t seed = random.next();
    const auto probe = [&](double step) {
        Random same(seed);
        return stage.renderer().upload_mesh(probe_mesh(kSide, [&](int, int) {
            const double NoV = (same.chance(0.3) ? 0.0 : same.log_between(1e-8, 0.5)) + step;
            const double phi = same.between(0.0, 2.0 * std::numbers::pi), ring = std::sqrt(1.0 - NoV * NoV);
            return vec3(ring * std::cos(phi), ring * std::sin(phi), NoV);
        }));
    };
    Scene scene = probe_scene(upload_light(stage, panorama_of(SoftLight(random), 128, 64)), probe(0.0),
                              any_mode(random));
    scene.camera.distance = 1e5f;  // a grazing normal's N·V is what it says
    scene.camera.fov_deg = float(glm::degrees(2.0 * std::atan(1e-5)));
    make_material(scene.material, random);
    // The microfacets mask each other where NoV is not large against α: there a step of 1e-4 is no small one.
    scene.material.roughness.value = float(random.between(0.2, 1.0));
    scene.material.ao.value = 1.0f;  // as above
    const Image before = drawn_radiance(stage, scene, glm::ivec2(kSide));
    scene.mesh = probe(1e-4);
    Trial trial;
    relative_step(before, drawn_radiance(stage, scene, glm::ivec2(kSide)), trial);
    return trial;
}

/// A flat normal map changes no normal, whatever the tangents and uvs it is laid on by.
Trial flat_normal_maps(Random& random, Stage& stage) {
    constexpr float odd[] = {0.0f, 1e-30f, 1e20f, -1.0f, kNan, kInf};
    std::vector<vec3> normals;
    Mesh mesh = probe_mesh(kSide, [&](int, int) {
        vec3 N = seen_normal(random);
        N = glm::normalize(vec3(N.x, N.y, std::max(N.z, 0.05f)));
        normals.push_back(N);
        return N;
    });
    const auto any = [&] { return odd[random.below(int(std::size(odd)))]; };
    for (Vertex& vertex : mesh.vertices) {
        vertex.tangent = {any(), any(), any(), any()};
        if (random.chance(0.5)) vertex.tangent = glm::vec4(vertex.normal, 1.0f);
        vertex.uv = glm::vec2(any(), any());
    }
    mesh.has_tangents = random.chance(0.7);
    Scene scene = probe_scene(nullptr, stage.renderer().upload_mesh(mesh), any_mode(random));
    Image flat = make_image(1, 1, 3, PixelType::F32);
    for (int c = 0; c < 3; ++c) set_texel(flat, 0, 0, c, c < 2 ? 0.5f : 1.0f);
    scene.maps[std::size_t(MapSlot::Normal)] =
        stage.renderer().upload_map(make_map_levels(flat, MapKind::Normal, ColorSpace::Linear));
    scene.view.debug = DebugView::Normal;
    Trial trial;
    each_pixel(drawn_radiance(stage, scene, glm::ivec2(kSide)), [&](int x, int y, vec3 color) {
        const vec3 N = normals[std::size_t(y) * kSide + x];
        for (int c = 0; c < 3; ++c)
            trial.add(std::abs(2.0 * tone::encode_srgb(color[c]) - 1.0 - double(N[c])));
    });
    return trial;
}

}  // namespace

std::vector<Property> picture_properties() {
    return {
        {"pixel-fuzz", "no NaN, Inf or negative pixel", 0.0, 75000, pixels_are_sane},
        {"white-furnace", "white under light 1 from everywhere is 1", 2e-3, 100000, white_furnace},
        {"darker-furnace", "nothing sends back more than it receives", 2e-3, 70000, darker_furnace},
        {"exposure", "±20 EV scale the picture, relative, ½ half-float ulp", 0x1p-11, 60000, exposure_scales},
        {"rotation", "light, mesh and camera turned: mean FLIP", 2e-3, 12, rotating_everything},
        {"mirror", "light, mesh and camera mirrored: mean FLIP", 2e-3, 12, mirroring_everything},
        {"mesh-scale", "a mesh scaled by 1e±6: share of other pixels", 1e-4, 12, mesh_scale},
        {"seams", "jump across cube edges, corners, ±180°", 1e-3, 35000, seams_do_not_show},
        {"roughness-step", "r + 1e-4, from 0 on, unoccluded: relative change", 1e-2, 70000, roughness_steps},
        {"view-step", "NoV + 1e-4, from 0 on, r ≥ 0.2: relative change", 1e-2, 70000, view_steps},
        {"flat-normal-map", "flat maps on degenerate tangents keep N", 1e-4, 35000, flat_normal_maps},
    };
}

}  // namespace patina

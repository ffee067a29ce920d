// Maps of metals: brushed, painted and worn, rusted, hammered.
#include "materials/maps/noise.h"
#include "materials/maps/recipes.h"

namespace patina::maps {

namespace {

constexpr glm::vec3 kIronF0{0.560f, 0.570f, 0.580f};

/// Depth (0…1) of thin straight scratches; `turn` 0 keeps them along u, 1 lets them point anywhere.
float scratches(glm::vec2 uv, int count, float width, float turn, std::uint32_t seed) {
    float deepest = 0.0f;
    for (int i = 0; i < count; ++i) {
        const glm::vec2 leaning{1.0f,
                                turn * random_signed(i, 0, seed) * (turn + 2.0f * random01(i, 5, seed))};
        const float length = std::sqrt(leaning.x * leaning.x + leaning.y * leaning.y);
        const glm::vec2 direction{leaning.x / length, leaning.y / length};
        glm::vec2 d{uv.x - random01(i, 2, seed), uv.y - random01(i, 3, seed)};
        d -= glm::vec2(std::floor(d.x + 0.5f), std::floor(d.y + 0.5f));
        const float along = d.x * direction.x + d.y * direction.y;
        const float across = d.y * direction.x - d.x * direction.y;
        const float half_length = mix(0.02f, 0.2f, random01(i, 1, seed));
        if (std::abs(along) > half_length || std::abs(across) > width) continue;
        const float profile = 1.0f - smoothstep(0.3f * width, width, std::abs(across));
        const float ends = 1.0f - smoothstep(0.3f, 1.0f, std::abs(along) / half_length);
        deepest = std::max(deepest, profile * ends * mix(0.3f, 1.0f, random01(i, 4, seed)));
    }
    return deepest;
}

/// Fine parallel lines along u, about −1…1.
float brushing(glm::vec2 uv, std::uint32_t seed) {
    return 0.5f * gradient_noise(uv, {5, 96}, seed) + 0.6f * gradient_noise(uv, {9, 210}, seed + 1u) +
           0.4f * gradient_noise(uv, {14, 330}, seed + 2u);
}

SurfacePoint worn_paint_at(glm::vec2 uv) {
    static constexpr glm::vec3 paint_color{0.012f, 0.130f, 0.150f};
    static constexpr glm::vec3 faded_paint{0.040f, 0.200f, 0.205f};
    static constexpr glm::vec3 primer_color{0.310f, 0.290f, 0.260f};
    static constexpr glm::vec3 rust_color{0.150f, 0.048f, 0.014f};
    static constexpr float coat_thickness = 0.0022f;  // thickness of paint and primer together, in tiles
    const float wear = fractal_noise(warped(uv, 4, 0.03f, 11), 4, 7, 12) +
                       0.35f * fractal_noise(uv, 24, 4, 13) + 0.75f * scratches(uv, 60, 0.0022f, 1.0f, 14);
    const float bare = smoothstep(0.43f, 0.46f, wear);
    const float primer = smoothstep(0.36f, 0.38f, wear);
    const float stain = smoothstep(0.12f, 0.42f, wear + 0.2f * fractal_noise(uv, 12, 4, 15)) * (1.0f - bare);
    const float rust = smoothstep(0.15f, 0.5f, fractal_noise(uv, 18, 5, 16)) * bare;
    const float fade = saturate(0.5f + 0.8f * fractal_noise(uv, 3, 4, 17));
    const float peel = gradient_noise(uv, glm::ivec2(90), 18);

    SurfacePoint point;
    const glm::vec3 coat = mix(mix(paint_color, faded_paint, fade), paint_color * 0.45f, 0.7f * stain);
    point.albedo = mix(mix(coat, primer_color, primer * (1.0f - 0.4f * stain)),
                       mix(kIronF0 * 0.9f, rust_color, rust), bare);
    point.metallic = bare * (1.0f - rust);
    const float coat_roughness = mix(0.32f + 0.10f * fade + 0.15f * stain, 0.75f, primer);
    const float metal_roughness = mix(0.34f + 0.06f * brushing(uv, 19), 0.85f, rust);
    point.roughness = saturate(mix(coat_roughness, metal_roughness, bare));
    point.height = coat_thickness * (1.0f - 0.5f * primer - 0.5f * bare) + 0.00008f * peel * (1.0f - bare) +
                   0.0006f * rust * (0.5f + fractal_noise(uv, 60, 3, 20)) +
                   0.00004f * bare * brushing(uv, 21);
    return point;
}

SurfacePoint rusted_iron_at(glm::vec2 uv) {
    static constexpr glm::vec3 dark{0.055f, 0.019f, 0.009f};
    static constexpr glm::vec3 rust_color{0.181f, 0.057f, 0.017f};
    static constexpr glm::vec3 orange{0.380f, 0.145f, 0.040f};
    const glm::vec2 bent = warped(uv, 4, 0.09f, 31);
    const float spread = fractal_noise(bent, 3, 8, 32) + 0.25f * fractal_noise(uv, 40, 4, 33);
    const float rust = smoothstep(-0.06f, 0.10f, spread);
    const float grain = fractal_noise(uv, 70, 4, 34);
    const float tone = saturate(0.5f + 0.9f * fractal_noise(bent, 9, 6, 35) + 0.25f * grain);
    const float pits = smoothstep(0.25f, 0.6f, fractal_noise(uv, 48, 4, 36)) * rust;

    SurfacePoint point;
    const glm::vec3 oxide =
        tone < 0.5f ? mix(dark, rust_color, 2.0f * tone) : mix(rust_color, orange, 2.0f * tone - 1.0f);
    const float tarnish = saturate(0.65f + 0.5f * fractal_noise(uv, 8, 5, 37));
    point.albedo = mix(kIronF0 * tarnish, oxide * (1.0f - 0.5f * pits), rust);
    point.metallic = 1.0f - rust;
    point.roughness =
        saturate(mix(0.30f + 0.12f * fractal_noise(uv, 16, 5, 38), 0.86f + 0.10f * grain, rust));
    point.height = 0.0035f * rust * (0.7f + 0.5f * tone) + 0.0016f * rust * grain - 0.0030f * pits +
                   0.00015f * (1.0f - rust) * fractal_noise(uv, 90, 2, 39);
    return point;
}

/// Dents of a round hammer: each point lies in the lowest of the bowls around it, with the ridges between
/// them rounded.
float hammer_marks(glm::vec2 uv, int cells, std::uint32_t seed) {
    static constexpr float rounding = 0.16f;
    const glm::vec2 p = uv * static_cast<float>(cells);
    const glm::ivec2 home{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))};
    float lowest = 4.0f;
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
            const int x = wrap(home.x + dx, cells);
            const int y = wrap(home.y + dy, cells);
            const glm::vec2 d{
                static_cast<float>(home.x + dx) + 0.5f + 0.42f * random_signed(x, y, seed) - p.x,
                static_cast<float>(home.y + dy) + 0.5f + 0.42f * random_signed(x, y, seed + 1u) - p.y};
            const float bowl = d.x * d.x + d.y * d.y + 0.22f * random01(x, y, seed + 2u);
            const float t = saturate(0.5f + 0.5f * (lowest - bowl) / rounding);
            lowest = mix(lowest, bowl, t) - rounding * t * (1.0f - t);
        }
    return lowest;
}

SurfacePoint hammered_copper_at(glm::vec2 uv) {
    static constexpr glm::vec3 copper_f0{0.955f, 0.638f, 0.538f};
    static constexpr glm::vec3 oxide_color{0.300f, 0.110f, 0.060f};
    const float marks = hammer_marks(uv, 12, 41);
    const float cloud = fractal_noise(warped(uv, 4, 0.06f, 45), 3, 7, 42);
    // The ridges are rubbed bright, the hollows keep their skin.
    const float hollow = 1.0f - smoothstep(0.05f, 0.45f, marks);
    const float oxide =
        saturate(0.06f + 0.25f * hollow * (0.7f + cloud) + 0.30f * smoothstep(-0.1f, 0.7f, cloud));

    SurfacePoint point;
    point.albedo = mix(copper_f0, oxide_color, oxide);
    point.metallic = 1.0f;
    point.roughness = saturate(0.14f + 0.45f * oxide + 0.03f * fractal_noise(uv, 50, 3, 43));
    point.height = 0.0115f * marks + 0.00012f * fractal_noise(uv, 40, 3, 44);
    return point;
}

}  // namespace

std::vector<MapPicture> brushed_steel(int size) {
    const Surface surface = make_surface(size, [](glm::vec2 uv) {
        const float lines = brushing(uv, 1);
        const float wide = fractal_noise(uv, {2, 12}, 3, 4);
        const float scratch = scratches(uv, 40, 0.0016f, 0.1f, 5);
        SurfacePoint point;
        point.albedo = kIronF0;
        point.metallic = 1.0f;
        point.roughness = saturate(0.30f + 0.07f * lines + 0.07f * wide + 0.10f * scratch);
        point.height = 0.00006f * lines + 0.0004f * wide - 0.0004f * scratch;
        return point;
    });
    return {roughness_map("brushed-steel-roughness.png", surface),
            normal_map("brushed-steel-normal.png", surface, GreenPoints::Up, 8)};
}

std::vector<MapPicture> worn_paint(int size) {
    const Surface surface = make_surface(size, worn_paint_at);
    return {albedo_map("worn-paint-albedo.png", surface), orm_map("worn-paint-orm.png", surface),
            normal_map("worn-paint-normal.png", surface, GreenPoints::Up, 8)};
}

std::vector<MapPicture> rusted_iron(int size) {
    const Surface surface = make_surface(size, rusted_iron_at);
    return {albedo_map("rusted-iron-albedo.png", surface), orm_map("rusted-iron-orm.png", surface),
            normal_map("rusted-iron-normal.png", surface, GreenPoints::Up, 8)};
}

std::vector<MapPicture> hammered_copper(int size) {
    const Surface surface = make_surface(size, hammered_copper_at);
    return {albedo_map("hammered-copper-albedo.png", surface),
            roughness_map("hammered-copper-roughness.png", surface),
            ao_map("hammered-copper-ao.png", surface),
            normal_map("hammered-copper-normal-dx.png", surface, GreenPoints::Down, 16)};
}

}  // namespace patina::maps

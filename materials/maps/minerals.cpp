// Maps of minerals: glazed tiles with grout, terrazzo, lava that cools.
#include "materials/maps/noise.h"
#include "materials/maps/recipes.h"

#include <array>

namespace patina::maps {

namespace {

SurfacePoint glazed_tile_at(glm::vec2 uv) {
    static constexpr int tile_count = 6;
    static constexpr float half_joint = 0.035f;  // half the joint's width, in tiles
    static constexpr std::array<glm::vec3, 5> glazes{{{0.010f, 0.110f, 0.120f},
                                                      {0.014f, 0.180f, 0.165f},
                                                      {0.008f, 0.065f, 0.110f},
                                                      {0.060f, 0.300f, 0.240f},
                                                      {0.620f, 0.600f, 0.520f}}};
    static constexpr glm::vec3 grout_color{0.400f, 0.370f, 0.320f};
    const glm::vec2 p = uv * static_cast<float>(tile_count);
    const glm::ivec2 tile{static_cast<int>(p.x), static_cast<int>(p.y)};
    const auto tile_random = [&](std::uint32_t seed) { return random01(tile.x, tile.y, seed); };
    const glm::vec2 local{p.x - static_cast<float>(tile.x) - 0.5f, p.y - static_cast<float>(tile.y) - 0.5f};
    const float ragged =
        0.010f * fractal_noise(uv, 40, 3, 51) + 0.008f * gradient_noise(uv, glm::ivec2(12), 52);
    const float edge =
        0.5f - std::max(std::abs(local.x), std::abs(local.y)) + ragged;  // from the tile's border inwards
    const float glaze = smoothstep(half_joint, half_joint + 0.018f, edge);
    const float pillow = smoothstep(half_joint, half_joint + 0.13f, edge);
    const float wave = fractal_noise({uv.x + tile_random(53), uv.y + tile_random(54)}, 18, 3, 55);
    const float sand = fractal_noise(uv, 128, 3, 56);

    const auto color = static_cast<std::size_t>(tile_random(57) * (tile_random(58) > 0.86f ? 5.0f : 4.0f));
    const float depth =
        0.75f + 0.5f * tile_random(59) + 0.25f * fractal_noise(uv, 14, 5, 60) - 0.25f * (1.0f - pillow);
    SurfacePoint point;
    point.albedo = mix(grout_color * (0.85f + 0.35f * sand), glazes[color] * depth, glaze);
    point.roughness =
        saturate(mix(0.88f + 0.08f * sand, 0.09f + 0.05f * tile_random(61) + 0.03f * wave, glaze));
    const float tilt = 0.005f * ((tile_random(62) - 0.5f) * local.x + (tile_random(63) - 0.5f) * local.y);
    point.height =
        glaze * (0.0040f + 0.0045f * pillow + 0.00045f * wave + tilt) + 0.0010f * (1.0f - glaze) * sand;
    return point;
}

/// Chips of stone in a binder: a cell becomes a chip if chance has it so, cut back from its borders.
struct Chip {
    float inside = 0.0f;
    glm::vec3 color{0.0f};
};
Chip chip_at(glm::vec2 uv, int cells, float share, float gap, std::uint32_t seed) {
    static constexpr std::array<glm::vec3, 7> stones{{{0.560f, 0.520f, 0.460f},
                                                      {0.300f, 0.115f, 0.070f},
                                                      {0.060f, 0.062f, 0.066f},
                                                      {0.420f, 0.270f, 0.130f},
                                                      {0.090f, 0.150f, 0.130f},
                                                      {0.700f, 0.690f, 0.660f},
                                                      {0.330f, 0.210f, 0.190f}}};
    const Cell cell =
        cell_noise(warped(uv, 2 * cells, 0.16f / static_cast<float>(cells), seed), cells, 0.9f, seed + 20u);
    if (random01(cell.id.x, cell.id.y, seed + 40u) > share) return {};
    const auto stone = static_cast<std::size_t>(random01(cell.id.x, cell.id.y, seed + 41u) *
                                                static_cast<float>(stones.size()));
    const float shade = 0.8f + 0.4f * random01(cell.id.x, cell.id.y, seed + 42u) +
                        0.35f * fractal_noise(uv, 30, 5, seed + 43u);
    const float cut = gap * (1.0f + random01(cell.id.x, cell.id.y, seed + 44u));
    return {smoothstep(cut, cut + 0.02f, cell.to_border), stones[stone] * shade};
}

SurfacePoint terrazzo_at(glm::vec2 uv) {
    static constexpr glm::vec3 binder_color{0.610f, 0.585f, 0.540f};
    SurfacePoint point;
    point.albedo =
        binder_color * (1.0f + 0.08f * fractal_noise(uv, 8, 6, 71) + 0.06f * fractal_noise(uv, 120, 2, 72));
    point.roughness = 0.24f + 0.05f * fractal_noise(uv, 60, 3, 73);
    const struct {
        int cells;
        float share, gap;
    } sizes[] = {{46, 0.45f, 0.10f}, {22, 0.55f, 0.09f}, {10, 0.42f, 0.07f}};
    std::uint32_t seed = 74;
    for (const auto& [cells, share, gap] : sizes) {
        const Chip chip = chip_at(uv, cells, share, gap, seed);
        point.albedo = mix(point.albedo, chip.color, chip.inside);
        point.roughness = mix(point.roughness, 0.12f, chip.inside);
        seed += 100u;
    }
    point.roughness = saturate(point.roughness);
    return point;
}

SurfacePoint lava_at(glm::vec2 uv) {
    static constexpr glm::vec3 crust{0.030f, 0.027f, 0.026f};
    static constexpr glm::vec3 ash{0.110f, 0.100f, 0.095f};
    // By eye after glowing rock; red is 1, the preset's value says how bright that is.
    static constexpr glm::vec3 red_heat{1.0f, 0.055f, 0.0f};
    static constexpr glm::vec3 yellow_heat{1.0f, 0.340f, 0.025f};
    const glm::vec2 bent = warped(uv, 6, 0.035f, 81);
    const Cell plate = cell_noise(bent, 7, 0.85f, 82);
    const Cell crack = cell_noise(warped(uv, 14, 0.016f, 83), 19, 0.9f, 84);
    const float rough = fractal_noise(bent, 10, 7, 85);
    const float heat = saturate(0.55f + 0.8f * fractal_noise(uv, 3, 3, 86));
    const float wide = 1.0f - smoothstep(0.0f, 0.075f + 0.05f * heat, plate.to_border + 0.035f * rough);
    const float fine =
        (1.0f - smoothstep(0.0f, 0.05f, crack.to_border + 0.03f * rough)) * smoothstep(0.45f, 0.85f, heat);
    const float glow = std::max(wide, 0.55f * fine);

    SurfacePoint point;
    point.albedo = mix(crust, ash, saturate(0.35f + 0.7f * rough)) * (1.0f - 0.7f * glow);
    const float bright = glow * glow * mix(0.35f, 1.0f, heat);
    point.emission = mix(red_heat, yellow_heat, smoothstep(0.25f, 0.9f, bright)) * bright;
    point.roughness = saturate(0.88f + 0.12f * rough - 0.35f * glow);
    const float dome = smoothstep(0.0f, 0.35f, plate.to_border);
    point.height = 0.030f * dome + 0.010f * rough * (0.4f + 0.6f * dome) - 0.004f * fine;
    return point;
}

}  // namespace

std::vector<MapPicture> glazed_tiles(int size) {
    const Surface surface = make_surface(size, glazed_tile_at);
    return {albedo_map("glazed-tiles-albedo.png", surface),
            roughness_map("glazed-tiles-roughness.png", surface), ao_map("glazed-tiles-ao.png", surface),
            normal_map("glazed-tiles-normal.png", surface, GreenPoints::Up, 16)};
}

std::vector<MapPicture> terrazzo(int size) {
    const Surface surface = make_surface(size, terrazzo_at);
    return {albedo_map("terrazzo-albedo.png", surface), roughness_map("terrazzo-roughness.png", surface)};
}

std::vector<MapPicture> cooling_lava(int size) {
    const Surface surface = make_surface(size, lava_at);
    return {albedo_map("cooling-lava-albedo.png", surface), orm_map("cooling-lava-orm.png", surface),
            normal_map("cooling-lava-normal.png", surface, GreenPoints::Up, 8),
            emission_map("cooling-lava-emission.png", surface)};
}

}  // namespace patina::maps

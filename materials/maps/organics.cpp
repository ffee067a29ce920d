// Maps of what once lived: a woven cloth, varnished planks of oak.
#include "materials/maps/noise.h"
#include "materials/maps/recipes.h"

namespace patina::maps {

namespace {

/// One of the two systems of threads of a twill: x counts threads, y runs along them and counts the ones that
/// cross.
struct Thread {
    float height = 0.0f;  ///< 0…1
    float across = 0.0f;  ///< −1…1 from edge to edge
    int index = 0;
};
/// A thread goes over two and under one; the next one is shifted, which makes the diagonal.
Thread thread_at(float x, float y, bool warp) {
    static constexpr int repeat = 3;
    Thread thread;
    thread.index = static_cast<int>(std::floor(x));
    thread.across = 2.0f * (x - std::floor(x)) - 1.0f;
    const auto over = [&](int crossing) {
        const int step = wrap(warp ? thread.index + crossing : crossing + thread.index, repeat);
        return (step != 0) == warp ? 1.0f : 0.0f;
    };
    const float along = y - 0.5f;
    const int crossing = static_cast<int>(std::floor(along));
    const float t = smoothstep(0.15f, 0.85f, along - std::floor(along));
    const float lift = mix(over(crossing), over(crossing + 1), t);
    const float round = std::sqrt(std::max(0.0f, 1.0f - 0.92f * thread.across * thread.across));
    thread.height = 0.55f * lift + 0.45f * round;
    return thread;
}

SurfacePoint cloth_at(glm::vec2 uv) {
    static constexpr int threads = 48;  // a multiple of the twill's repeat
    static constexpr glm::vec3 indigo{0.022f, 0.040f, 0.110f};
    static constexpr glm::vec3 ecru{0.520f, 0.480f, 0.400f};
    const glm::vec2 bent{uv.x + 0.0012f * fractal_noise(uv, 20, 3, 91),
                         uv.y + 0.0012f * fractal_noise(uv, 20, 3, 92)};
    const float x = bent.x * static_cast<float>(threads);
    const float y = bent.y * static_cast<float>(threads);
    const Thread warp = thread_at(x, y, true);
    const Thread weft = thread_at(y, x, false);
    const bool warp_on_top = warp.height >= weft.height;
    const Thread& top = warp_on_top ? warp : weft;
    const int index = wrap(top.index, threads);
    const float own = random01(index, warp_on_top ? 0 : 1, 93);
    // Spun fibres wind round the thread: fine lines at a slant.
    const float along = warp_on_top ? y : x;
    const float twist = triangle(1.6f * along + 0.9f * top.across + own);
    const float fuzz = gradient_noise(uv, warp_on_top ? glm::ivec2(320, 120) : glm::ivec2(120, 320), 94);
    const float slub =
        fractal_noise(uv, warp_on_top ? glm::ivec2(threads, 5) : glm::ivec2(5, threads), 3, 95);

    SurfacePoint point;
    const glm::vec3 dyed =
        warp_on_top ? mix(indigo, ecru, saturate(0.05f + 0.10f * slub + 0.05f * fuzz)) : ecru;
    const float deep = smoothstep(0.25f, 0.85f, top.height);
    point.albedo = dyed * ((0.75f + 0.35f * own + 0.15f * twist + 0.15f * fuzz) * mix(0.45f, 1.0f, deep));
    point.roughness = saturate(0.80f + 0.08f * fuzz - 0.08f * twist + 0.08f * (1.0f - deep));
    point.height = 0.0110f * top.height + 0.0006f * twist + 0.0006f * fuzz + 0.0015f * slub;
    return point;
}

SurfacePoint oak_at(glm::vec2 uv) {
    static constexpr int rows = 5;
    static constexpr glm::vec3 light{0.430f, 0.225f, 0.095f};
    static constexpr glm::vec3 dark{0.150f, 0.058f, 0.020f};
    const float v = uv.y * static_cast<float>(rows);
    const int row = static_cast<int>(v);
    // Each row is two planks long and starts elsewhere.
    const float u = 2.0f * uv.x + 2.0f * random01(row, 0, 101);
    const int plank = wrap(static_cast<int>(std::floor(u)), 2);
    const auto own = [&](std::uint32_t seed) { return random01(row, plank, seed); };
    const float from_side = 0.5f - std::abs(v - static_cast<float>(row) - 0.5f);
    const float from_end = 0.5f - std::abs(u - std::floor(u) - 0.5f);
    const float gap = std::min(from_side / static_cast<float>(rows), 0.5f * from_end);  // in tiles
    const float board = smoothstep(0.0006f, 0.0026f, gap);

    const glm::vec2 shifted{uv.x + own(102), uv.y + own(103)};
    const float bend = fractal_noise(shifted, {2, 5}, 4, 104);
    const float fine = fractal_noise(shifted, {9, 160}, 3, 105);
    const float rings =
        triangle(9.0f * (v - static_cast<float>(row)) * (0.5f + own(106)) + 2.6f * bend + own(107));
    const float late_wood = smoothstep(0.35f, 0.95f, rings + 0.25f * fine);
    const float pores =
        smoothstep(0.30f, 0.62f, gradient_noise(shifted, {26, 330}, 108)) * (0.35f + 0.65f * late_wood);

    SurfacePoint point;
    const float tone = saturate(0.12f + 0.42f * late_wood + 0.20f * fine + 0.55f * (own(109) - 0.35f));
    point.albedo = mix(light, dark, tone) * (1.0f - 0.45f * pores) * (0.82f + 0.32f * own(110)) *
                   mix(0.15f, 1.0f, board);
    point.roughness = saturate(mix(0.85f, 0.30f + 0.10f * pores + 0.05f * fine + 0.05f * own(111), board));
    const float bevel = smoothstep(0.0f, 0.005f, gap);
    point.height =
        0.0030f * board + 0.0010f * bevel + 0.00012f * fine - 0.00035f * pores - 0.00012f * late_wood;
    return point;
}

}  // namespace

std::vector<MapPicture> woven_cloth(int size) {
    const Surface surface = make_surface(size, cloth_at);
    return {albedo_map("woven-cloth-albedo.png", surface),
            glossiness_map("woven-cloth-glossiness.png", surface), ao_map("woven-cloth-ao.png", surface),
            normal_map("woven-cloth-normal.png", surface, GreenPoints::Up, 8)};
}

std::vector<MapPicture> oak_planks(int size) {
    const Surface surface = make_surface(size, oak_at);
    return {albedo_map("oak-planks-albedo.png", surface), roughness_map("oak-planks-roughness.png", surface),
            ao_map("oak-planks-ao.png", surface),
            normal_map("oak-planks-normal.png", surface, GreenPoints::Up, 8)};
}

}  // namespace patina::maps

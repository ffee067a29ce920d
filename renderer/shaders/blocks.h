// The uniform blocks, one text for C++ and GLSL (std140). Rows are vec4 only, so no padding rule can make the
// two differ. A material parameter is one row of MaterialBlock; angles, exponents and colour spaces are
// resolved before they get here.
#ifdef __cplusplus
#pragma once

#include <glm/vec4.hpp>

namespace patina::blocks {

using vec4 = glm::vec4;
#define PATINA_BLOCK(Name) struct Name
#else
#define PATINA_BLOCK(Name) layout(std140) uniform Name
#endif

// Sizes both sides agree on: roughness levels come four to a row, the last row padded with segments that
// never count.
#define PATINA_LEVEL_ROWS 8
#define PATINA_MAX_LIGHTS 16
#define PATINA_LIGHT_CELLS 32

// How the scene is seen and lit. "Scale" undoes the power of two by which a half-float texture was stored,
// and includes the exposure.
PATINA_BLOCK(FrameBlock) {
    vec4 view_projection[4];  // columns
    vec4 camera_position;     // xyz world; w: exposure as a factor
    vec4 ray_corner;         // xyz: world direction through the picture's lower left corner; w: pixel's solid
                             // angle
    vec4 ray_right;          // added once a pixel to the right; w: largest finite output
    vec4 ray_up;             // added once a pixel upwards; w: roughness of the blurred backdrop
    vec4 env_from_world[3];  // rows of the rotation from world to environment
    vec4 env_scale;          // panorama, levels, irradiance; w: texels per radian of the panorama
    vec4 level_layout;       // level count − 1, layers; roughness and alpha of lobes that need no panorama
    vec4 level_ends;         // log2 of the first and the last level's roughness
    vec4 level_slope[PATINA_LEVEL_ROWS];  // level index = Σ clamp(log2(roughness)·slope + offset, 0, 1)
    vec4 level_offset[PATINA_LEVEL_ROWS];
    vec4 light_direction[PATINA_MAX_LIGHTS];   // xyz world, unit; w: ¼ of its mean-square radius, added to
                                               // alpha²
    vec4 light_irradiance[PATINA_MAX_LIGHTS];  // on a surface facing it, exposed
    vec4 counts;  // x: lights; y: debug view; z: lights whose colour the panorama needs; w: blurred
                  // backdrop's 1/∫ D·NoL
};

// A scalar parameter is dot(map, row) + its bias: the row holds ±value at the map's channel; without a map it
// is the bias.
PATINA_BLOCK(MaterialBlock) {
    vec4 albedo;
    vec4 emission;  // exposed
    vec4 roughness;
    vec4 metallic;
    vec4 ao;
    vec4 scalar_bias;  // roughness, metallic, ao
    vec4 normal_x;     // tangent-space normal's x from the map's (x, y); w: its strength
    vec4 normal_y;     // and its y: scale, DirectX flip, uv rotation and mirroring in one
    vec4 uv_matrix;    // uv' = (uv.x·xy + uv.y·zw) + offset
    vec4 uv_offset;
};

// The light that the reference draws from (ibl/light_cells.h).
PATINA_BLOCK(CellBlock) {
    vec4 light_layout;                       // cells; 1/all light; the panorama's width and height in texels
    vec4 cell_rows[2 * PATINA_LIGHT_CELLS];  // of each: direction, spread; √spread
};

#ifdef __cplusplus
#undef PATINA_BLOCK
inline constexpr int kMaxLevels = 4 * PATINA_LEVEL_ROWS + 1;
inline constexpr int kMaxLights = PATINA_MAX_LIGHTS;
inline constexpr int kLightCells = PATINA_LIGHT_CELLS;
}  // namespace patina::blocks
#endif

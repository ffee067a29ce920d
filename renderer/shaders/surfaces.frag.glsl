// What the surface is, before any light and before the material's values: to be shaded later and more than once.
#include "blocks.h"
#include "brdf.glsl"
#include "camera.glsl"
#include "material.glsl"
#include "surface.glsl"

layout(location = 0) out float stored_fragment;   // of which triangle; 0: nothing
layout(location = 1) out vec4 stored_normal;
#ifdef HAS_SHARP
layout(location = 2) out vec4 stored_turn;
#endif
#if defined(HAS_SHARP) || defined(HAS_STORED_MAPS)
layout(location = 3) out vec4 stored_scalar;
#endif
#ifdef HAS_STORED_MAPS
layout(location = 4) out vec4 stored_color;
#ifdef HAS_EMISSION_MAP
layout(location = 5) out vec4 stored_emission;
#endif
#endif

void main() {
    vec2 st = vec2(map_uv.x, 1.0 - map_uv.y);   // maps are stored top row first
    Geometry g = read_geometry(st);
    stored_fragment = float(gl_PrimitiveID + 1);
    stored_normal = vec4(g.N, g.spread);
#ifdef HAS_SHARP
    stored_normal.w = g.around.across.x;
    stored_turn = vec4(g.around.across.yz, g.around.up.xy);
#endif
#if defined(HAS_SHARP) || defined(HAS_STORED_MAPS)
    stored_scalar = vec4(g.around.up.z, 0.0, 0.0, 0.0);
#endif
#ifdef HAS_STORED_MAPS
    MapTexels m = read_maps(st);
    stored_scalar.yzw = vec3(m.metallic, m.ao, m.spread);
    stored_color = vec4(m.albedo, m.roughness);
#ifdef HAS_EMISSION_MAP
    stored_emission = vec4(m.emission, 0.0);
#endif
#endif
}

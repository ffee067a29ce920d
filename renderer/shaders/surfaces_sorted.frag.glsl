// Fragments laid side by side, each once however many samples it covers. With FRAGMENTS: instead, which triangle lies under
// each of a pixel's samples.
#include "software.glsl"

#ifdef SAMPLES
#define Samples sampler2DMS
#else
#define Samples sampler2D
#endif

#ifdef FRAGMENTS
uniform Samples picture;
out vec4 fragments;
void main() {
    spare_whole_tiles();
    ivec2 at = ivec2(gl_FragCoord.xy);
    fragments = vec4(texelFetch(picture, at, 0).r);
#ifdef SAMPLES
    for (int i = 1; i < SAMPLES; ++i) fragments[i] = texelFetch(picture, at, i).r;
#endif
}
#else
#include "places.glsl"

uniform Samples stored_normals;
layout(location = 0) out vec4 sorted_normal;
#ifdef HAS_SHARP
uniform Samples stored_turns;
layout(location = 1) out vec4 sorted_turn;
#endif
#if defined(HAS_SHARP) || defined(HAS_STORED_MAPS)
uniform Samples stored_scalars;
layout(location = 2) out vec4 sorted_scalar;
#endif
#ifdef HAS_STORED_MAPS
uniform Samples stored_colors;
layout(location = 3) out vec4 sorted_color;
#endif
#ifdef HAS_EMISSION_MAP
uniform Samples stored_emissions;
layout(location = 4) out vec4 sorted_emission;
#endif

void main() {
    spare_whole_tiles();
    uvec3 place = texelFetch(fragment_places, ivec2(gl_FragCoord.xy), 0).rgb;
    ivec2 at = ivec2(place.xy);
    int i = int(place.z);
    sorted_normal = texelFetch(stored_normals, at, i);
#ifdef HAS_SHARP
    sorted_turn = texelFetch(stored_turns, at, i);
#endif
#if defined(HAS_SHARP) || defined(HAS_STORED_MAPS)
    sorted_scalar = texelFetch(stored_scalars, at, i);
#endif
#ifdef HAS_STORED_MAPS
    sorted_color = texelFetch(stored_colors, at, i);
#endif
#ifdef HAS_EMISSION_MAP
    sorted_emission = texelFetch(stored_emissions, at, i);
#endif
}
#endif

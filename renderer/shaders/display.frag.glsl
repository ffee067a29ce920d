// From linear radiance to the display picture. Each sample is tone-mapped before the average: an edge against a lamp
// then has steps that the eye sees as even, which an average of radiances, dominated by the lamp, has not.
#include "tonemap.glsl"

#include "picture.glsl"
#include "software.glsl"

uniform vec3 plain;     // display-linear colour where nothing was drawn

out vec4 display_color;

vec3 tonemapped(vec4 texel) {
    if (texel.a == 0.0) return plain;
#if TONEMAP == 1
    return clamp(tonemap_neutral(texel.rgb), 0.0, 1.0);
#elif TONEMAP == 2
    return tonemap_aces(texel.rgb);
#else
    return clamp(texel.rgb, 0.0, 1.0);
#endif
}

void main() {
    spare_whole_tiles();
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 first = picture_sample(at, 0);
    vec3 color = tonemapped(first);
#ifdef SAMPLES
    int samples = picture_is_one(at) ? 1 : SAMPLES;
    vec3 sum = color;
    bool same = true;
    for (int i = 1; i < samples; ++i) {
        vec4 next = picture_sample(at, i);
        if (next != first) same = false;
        sum += same ? color : tonemapped(next);
    }
    if (!same) color = sum / float(SAMPLES);
#endif
    display_color = vec4(encode_srgb(color), 1.0);
}

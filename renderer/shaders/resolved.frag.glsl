// Radiance and coverage of a pixel: the mean of its samples.
#include "picture.glsl"
#include "software.glsl"

out vec4 picture_color;

void main() {
    spare_whole_tiles();
    ivec2 at = ivec2(gl_FragCoord.xy);
    picture_color = picture_sample(at, 0);
#ifdef SAMPLES
    for (int i = 1; i < SAMPLES; ++i) picture_color += picture_sample(at, i);
    picture_color *= 1.0 / float(SAMPLES);
#endif
}

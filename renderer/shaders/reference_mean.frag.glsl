// The mean of all that was gathered, before what is behind it.
#include "software.glsl"

uniform sampler2D picture;
uniform sampler2D picture_behind;
uniform sampler2D reference_counts;   // points a pixel had before; whether it gathers
uniform vec3 reference_weight;        // points since; what one weighs; the largest number the target holds
uniform vec2 reference_rows;          // below which row there are how many more

out vec4 picture_color;

void main() {
    spare_whole_tiles();
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec2 counts = texelFetch(reference_counts, at, 0).rg;
    float since = reference_weight.x + (gl_FragCoord.y < reference_rows.x ? reference_rows.y : 0.0);
    float points = counts.x + counts.y * since;
    vec4 mean = texelFetch(picture, at, 0) / max(points * reference_weight.y, 1e-30);
    mean += (1.0 - mean.a) * texelFetch(picture_behind, at, 0);
    picture_color = vec4(min(mean.rgb, vec3(reference_weight.z)), mean.a);
}

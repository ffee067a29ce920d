// The environment behind the object, sharp or out of focus.
#include "blocks.h"
#include "brdf.glsl"
#include "light.glsl"

in vec3 world_ray;
out vec4 picture_color;

void main() {
    vec3 d = environment_direction(normalize(world_ray));
#ifdef HAS_BLUR
    vec3 color = prefiltered_light(d, ray_up.w);
#else
    vec3 color = panorama_light(d, ray_center.w);
#endif
    picture_color = vec4(min(color, vec3(ray_right.w)), 1.0);
}

// The environment behind the object, sharp or out of focus.
#include "blocks.h"
#include "brdf.glsl"
#include "light.glsl"

#ifdef HAS_STORED
uniform sampler2D stored_views;
#else
in vec3 world_ray;
#endif
out vec4 picture_color;

#ifdef HAS_BLUR
// The extracted lights under the levels' kernel D·NoL (N = V); counts.w normalises it.
vec3 blurred_lights(vec3 d, float alpha2) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < PATINA_MAX_LIGHTS; ++i) {
        if (float(i) >= counts.x) break;
        vec3 L = environment_direction(light_direction[i].xyz);
        vec3 apart = L - d;   // sin²(θ/2) = |L − d|²/4 is the half vector's
        float D = distribution_ggx(0.25 * dot(apart, apart), alpha2 + light_direction[i].w);
        sum += light_irradiance[i].rgb * (D * max(dot(L, d), 0.0) * counts.w);
    }
    return sum;
}
#endif

void main() {
#ifdef HAS_STORED
    vec3 world_ray = texelFetch(stored_views, ivec2(gl_FragCoord.xy), 0).xyz;
#endif
    vec3 d = environment_direction(normalize(world_ray));
#ifdef HAS_BLUR
    vec3 color = prefiltered_light(d, log2(ray_up.w)) + blurred_lights(d, square(square(ray_up.w)));
#else
    vec3 color = panorama_light(d, ray_center.w, light_color(d));
#endif
    picture_color = vec4(min(color, vec3(ray_right.w)), 1.0);
}

// The environment behind the object, sharp or out of focus.
#include "blocks.h"
#include "brdf.glsl"
#include "camera.glsl"
#include "light.glsl"
#ifdef HAS_STORED
#include "places.glsl"
#include "software.glsl"
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

#ifndef HAS_BLUR
// The panorama where a texel is wider than a pixel: a cubic B-spline as four bilinear look-ups (Sigg & Hadwiger, GPU
// Gems 2, ch. 20). It keeps every texel's light, and a lamp of a few texels that is clipped on the screen ends in a
// round edge; between bilinear texels it would be a block.
vec4 smooth_texel(vec2 at) {
    vec2 size = vec2(textureSize(panorama_map, 0));
    vec2 x = at * size - 0.5;
    vec2 f = fract(x), g = 1.0 - f;
    vec2 w0 = g * g * g / 6.0, w3 = f * f * f / 6.0;
    vec2 w1 = 2.0 / 3.0 - 0.5 * f * f * (2.0 - f);
    vec2 low = w0 + w1, high = 1.0 - low;
    vec2 first = (floor(x) - 0.5 + w1 / low) / size, second = (floor(x) + 1.5 + w3 / high) / size;
    return low.y * (low.x * textureLod(panorama_map, first, 0.0) +
                    high.x * textureLod(panorama_map, vec2(second.x, first.y), 0.0)) +
           high.y * (low.x * textureLod(panorama_map, vec2(first.x, second.y), 0.0) +
                     high.x * textureLod(panorama_map, second, 0.0));
}

// Fades in from as many texels as pixels to half as many.
vec3 background_light(vec3 d, float solid_angle) {
    vec2 at = panorama_coordinates(d);
    vec4 texel = panorama_texel(at, solid_angle);
    float magnified = clamp(-0.5 * log2(max(solid_angle, 1e-16)) - log2(env_scale.w), 0.0, 1.0);
    if (magnified > 0.0) texel = mix(texel, smooth_texel(at), magnified);
    vec3 light = texel.rgb;
    if (texel.a > 0.0) light += texel.a * light_color(d);
    return light * env_scale.x;
}
#endif

void main() {
#ifdef HAS_STORED
    spare_whole_tiles();
    vec2 pixel = stored_pixel();
#else
    vec2 pixel = gl_FragCoord.xy;
#endif
    vec3 d = environment_direction(normalize(camera_ray(pixel)));
#ifdef HAS_BLUR
    vec3 color = prefiltered_light(d, log2(ray_up.w)) + blurred_lights(d, square(square(ray_up.w)));
#else
    vec3 color = background_light(d, ray_corner.w);
#endif
    picture_color = vec4(min(color, vec3(ray_right.w)), 1.0);
}

// The shaded surface: scene-linear, exposed radiance.
#include "blocks.h"
#include "brdf.glsl"
#include "light.glsl"
#include "surface.glsl"
#ifdef HAS_DEBUG
#include "tonemap.glsl"
#endif

uniform sampler2D brdf_table;   // A and B over (√NoV, roughness)

out vec4 picture_color;

struct Reflected {
    vec3 diffuse;
    vec3 specular;
};

// Sources taken out of the environment's levels, as discs: alpha² widened by the square of half their angular radius. A
// lobe sharper than the sharpest level sees them in the panorama too, so only its tails (share a²) count here.
void add_lights(inout Reflected sum, Surface s, ReflectionWeights w, vec3 N, vec3 V, vec2 ab) {
    vec3 F0 = base_reflectance(s.albedo, s.metallic);
    float sharpest2 = square(level_layout.w);
    float alpha2 = square(square(s.roughness));
    float share = min(alpha2 / sharpest2, 1.0);
    alpha2 = max(alpha2, sharpest2);
    float NoV = max(dot(N, V), 1e-4);
    for (int i = 0; i < PATINA_MAX_LIGHTS; ++i) {
        if (float(i) >= counts.x) break;
        vec3 L = light_direction[i].xyz;
        float NoL = dot(N, L);
        if (NoL <= 0.0) continue;
        vec3 sum_vl = V + L;
        vec3 H = sum_vl * inversesqrt(max(dot(sum_vl, sum_vl), 1e-12));
        vec3 side = cross(N, H);
        vec3 cosines = vec3(NoV, NoL, max(dot(V, H), 0.0));
        vec3 E = light_irradiance[i].rgb;
        sum.specular += share * E * light_specular(F0, ab, dot(side, side), cosines, alpha2 + light_direction[i].w);
        sum.diffuse += w.diffuse * E * (NoL / kPi);
    }
}

Reflected reflected_light(Surface s, vec3 N, vec3 V) {
    float NoV = max(dot(N, V), 1e-4);
    vec3 R = reflect(-V, N);
    float pixel = 0.0;
#ifdef HAS_SHARP
    vec3 across = dFdx(R);
    vec3 up = dFdy(R);
    // At a silhouette, where R turns without end, the neighbours it is measured against lie beside the surface.
    pixel = min(0.5 * (dot(across, across) + dot(up, up)), 0.05);
#endif
    vec2 ab = texture(brdf_table, vec2(sqrt(NoV), s.roughness)).rg;
#ifdef HAS_COURSE
    ReflectionWeights w = course_weights(s.albedo, s.metallic, s.roughness, NoV, ab);
#else
    ReflectionWeights w = split_sum_weights(s.albedo, s.metallic, ab);
#endif
    vec3 prefiltered = specular_light(R, s.roughness, pixel);
    vec3 irradiance = irradiance_light(N);
    Reflected sum;
    sum.specular = (w.single * prefiltered + w.multiple * irradiance) * s.ao;
    sum.diffuse = w.diffuse * irradiance * s.ao;
    add_lights(sum, s, w, N, V, ab);
    return sum;
}

#ifdef HAS_DEBUG
#include "debug.glsl"
#endif

void main() {
    vec2 st = vec2(map_uv.x, 1.0 - map_uv.y);   // maps are stored top row first
    vec3 V = normalize(camera_position.xyz - world_position);
    Surface s = read_surface(st);
    vec3 N = shading_normal(V, st);
#ifdef HAS_DEBUG
    vec3 color = debug_color(s, N, V, st);
#else
    Reflected light = reflected_light(s, N, V);
    vec3 color = light.diffuse + light.specular + s.emission;
#endif
    picture_color = vec4(min(at_least(color, 0.0), vec3(ray_right.w)), 1.0);
}

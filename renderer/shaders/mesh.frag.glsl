// The shaded surface: scene-linear, exposed radiance.
#include "blocks.h"
#include "brdf.glsl"
#include "camera.glsl"
#include "light.glsl"
#include "lobes.glsl"
#include "material.glsl"
#ifdef HAS_STORED
#include "places.glsl"
#include "software.glsl"
#include "stored.glsl"
#else
#include "surface.glsl"
#endif
#ifdef HAS_DEBUG
#include "tonemap.glsl"
#endif

uniform sampler2D brdf_table;   // A and B over (√NoV, roughness)

out vec4 picture_color;

struct Reflected {
    vec3 diffuse;
    vec3 specular;
};

// The specular part of one light that widens the lobe by `spread`.
vec3 light_lobe(vec3 F0, float alpha, float spread, float sin2, vec3 cosines) {
    float alpha2 = square(alpha);
    vec3 whole = light_specular(F0, sin2, cosines, vec2(alpha2, spread));
#ifdef HAS_SHARP
    // What is not seen as a light is seen in the panorama (lobe_light), but for the tails.
    float tails2 = square(square(wider_roughness(sqrt(alpha))));
    vec3 tails = light_specular(F0, sin2, cosines, vec2(tails2, spread));
    float share = min(alpha2 / tails2, 1.0);
    whole = mix(share * tails, whole, analytic_share(alpha));
#endif
    return whole;
}

// Sources taken out of the environment's levels, as discs. Half vectors that a small light would hit or miss by chance are
// spread over the normals within the pixel (Tokuyoshi & Kaplanyan 2019).
void add_lights(inout Reflected sum, Surface s, ReflectionWeights w, Geometry g) {
    vec3 N = g.N;
    vec3 V = g.V;
    vec3 F0 = base_reflectance(s.albedo, s.metallic);
    float NoV = max(dot(N, V), 1e-4);
    float spread = g.spread;
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
        sum.specular += E * light_lobe(F0, square(s.roughness), light_direction[i].w + spread, dot(side, side), cosines);
        sum.specular += w.multiple * E * (NoL / kPi);
        sum.diffuse += w.diffuse * E * (NoL / kPi);
    }
}

// How much of the environment's light reaches the point: diffuse, specular and what bounces more than once.
struct Occlusion {
    vec3 diffuse;
    vec3 specular;
    vec3 multiple;
};

Occlusion occlusion_of(Surface s, float NoV) {
    Occlusion open;
#ifdef HAS_COURSE
    open.diffuse = open.specular = open.multiple = vec3(s.ao);
#else
    vec3 F0 = base_reflectance(s.albedo, s.metallic);
    open.diffuse = multi_bounce_occlusion(s.ao, s.albedo);
    open.multiple = multi_bounce_occlusion(s.ao, F0);
    open.specular = multi_bounce_occlusion(specular_occlusion(NoV, s.ao, square(s.roughness)), F0);
#endif
    return open;
}

Reflected reflected_light(Surface s, Geometry g) {
    vec3 N = g.N;
    vec3 V = g.V;
    s.roughness = widened_roughness(s.roughness, s.spread);
    float NoV = max(dot(N, V), 1e-4);
    vec3 R = reflect(-V, N);
    LobePoint p;
    p.N = environment_direction(N);
    p.V = environment_direction(V);
    p.R = environment_direction(R);
    p.NoV = NoV;
    p.roughness = s.roughness;
    p.ab = texture(brdf_table, albedo_coordinates(NoV, s.roughness)).rg;
    p.f0 = luminance(base_reflectance(s.albedo, s.metallic));
    p.irradiance = irradiance_light(p.N);
    p.across = p.up = vec3(0.0);
#ifdef HAS_SHARP
#if defined(HAS_FITTED) || defined(HAS_STORED)
    PixelNormals pixel = g.around;
#else
    PixelNormals pixel = pixel_normals(0.5 * R);
#endif
    p.across = environment_direction(pixel.across);
    p.up = environment_direction(pixel.up);
#endif
#ifdef HAS_COURSE
    ReflectionWeights w = course_weights(s.albedo, s.metallic, s.roughness, NoV, p.ab);
#else
    ReflectionWeights w = split_sum_weights(s.albedo, s.metallic, p.ab);
#endif
    Occlusion open = occlusion_of(s, NoV);
    Reflected sum;
    sum.specular = w.single * lobe_light(p) * open.specular + w.multiple * p.irradiance * open.multiple;
    sum.diffuse = w.diffuse * p.irradiance * open.diffuse;
    add_lights(sum, s, w, g);
    return sum;
}

#ifdef HAS_DEBUG
#include "debug.glsl"
#endif

void main() {
#ifdef HAS_STORED
    spare_whole_tiles();
    Surface s = surface_of(stored_maps());
    Geometry g = stored_geometry(stored_pixel());
#else
    vec2 st = vec2(map_uv.x, 1.0 - map_uv.y);   // maps are stored top row first
    Surface s = surface_of(read_maps(st));
    Geometry g = read_geometry(st);
#endif
#ifdef HAS_DEBUG
    vec3 color = debug_color(s, g, st);
#else
    Reflected light = reflected_light(s, g);
    vec3 color = light.diffuse + light.specular + s.emission;
#endif
    picture_color = vec4(min(at_least(color, 0.0), vec3(ray_right.w)), 1.0);
}

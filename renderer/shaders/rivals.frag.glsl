// Other ways to approximate the specular integral at run time, kept to be measured against (`patina bench shading`):
//   RIVAL_SAMPLES n > 0: filtered importance sampling of D with n samples of the panorama's mip chain (Křivánek & Colbert,
//                        GPU Gems 3), the BRDF evaluated at each;
//   RIVAL_SAMPLES 0:     split sum looked up along the dominant direction between N and R (Lagarde & de Rousiers 2014).
#include "blocks.h"
#include "brdf.glsl"
#include "camera.glsl"
#include "light.glsl"
#include "material.glsl"
#include "surface.glsl"

uniform sampler2D brdf_table;   // A and B over (√NoV, roughness)

out vec4 picture_color;

#if RIVAL_SAMPLES > 0
vec3 specular_part(Surface s, vec3 N, vec3 V, float NoV, vec2 ab) {
    float alpha2 = max(square(square(s.roughness)), 1e-8);
    vec3 F0 = base_reflectance(s.albedo, s.metallic);
    vec3 T = normalize(abs(N.y) < 0.9 ? cross(vec3(0.0, 1.0, 0.0), N) : cross(vec3(1.0, 0.0, 0.0), N));
    vec3 B = cross(N, T);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < RIVAL_SAMPLES; ++i) {
        float u = (float(i) + 0.5) / float(RIVAL_SAMPLES);
        float phi = 2.39996323 * float(i);
        float tan2 = alpha2 * u / (1.0 - u);
        float NoH = inversesqrt(1.0 + tan2);
        float sine = sqrt(max(1.0 - NoH * NoH, 0.0));
        vec3 H = sine * (cos(phi) * T + sin(phi) * B) + NoH * N;
        float VoH = max(dot(V, H), 1e-4);
        vec3 L = 2.0 * VoH * H - V;
        float NoL = dot(N, L);
        if (NoL <= 0.0) continue;
        float pdf = distribution_ggx(sine * sine, alpha2) * NoH / (4.0 * VoH);
        vec3 d = environment_direction(L);
        vec3 light = panorama_light(d, 1.0 / (float(RIVAL_SAMPLES) * pdf), light_color(d));
        sum += light * fresnel_schlick(F0, VoH) * (visibility_smith(NoV, NoL, alpha2) * NoL * 4.0 * VoH / NoH);
    }
    return sum / float(RIVAL_SAMPLES);
}
#else
vec3 specular_part(Surface s, vec3 N, vec3 V, float NoV, vec2 ab) {
    float alpha = square(s.roughness);
    vec3 R = mix(N, reflect(-V, N), (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha));
    vec3 F0 = base_reflectance(s.albedo, s.metallic);
    vec3 light = prefiltered_light(environment_direction(R), log2(max(s.roughness, 1e-4)));
    vec3 sum = light * split_sum_weights(s.albedo, s.metallic, ab).single;
    for (int i = 0; i < PATINA_MAX_LIGHTS; ++i) {
        if (float(i) >= counts.x) break;
        vec3 L = light_direction[i].xyz;
        float NoL = dot(N, L);
        if (NoL <= 0.0) continue;
        vec3 H = normalize(V + L);
        vec3 side = cross(N, H);
        vec2 widths = vec2(max(alpha * alpha, square(level_layout.w)), light_direction[i].w);
        sum += light_irradiance[i].rgb *
               light_specular(F0, dot(side, side), vec3(NoV, NoL, max(dot(V, H), 0.0)), widths);
    }
    return sum;
}
#endif

void main() {
    vec2 st = vec2(map_uv.x, 1.0 - map_uv.y);
    vec3 V = normalize(camera_position.xyz - world_position);
    Surface s = surface_of(read_maps(st));
    vec3 N = shading_normal(V, st);
    float NoV = max(dot(N, V), 1e-4);
    vec2 ab = texture(brdf_table, albedo_coordinates(NoV, s.roughness)).rg;
    ReflectionWeights w = split_sum_weights(s.albedo, s.metallic, ab);
    vec3 irradiance = textureLod(irradiance_map, environment_direction(N), 0.0).rgb * env_scale.z;
    for (int i = 0; i < PATINA_MAX_LIGHTS; ++i) {
        if (float(i) >= counts.x) break;
        irradiance += light_irradiance[i].rgb * (max(dot(N, light_direction[i].xyz), 0.0) / kPi);
    }
    vec3 color = (specular_part(s, N, V, NoV, ab) + (w.multiple + w.diffuse) * irradiance) * s.ao + s.emission;
    picture_color = vec4(min(at_least(color, 0.0), vec3(ray_right.w)), 1.0);
}

// A slice of the reflectance integral by sampling, unbiased: the mean of `count` estimates, each from one direction drawn
// from the light and one drawn from the reflection (the bounded distribution of visible normals of Eto & Tokuyoshi 2023, or
// the cosine), weighted by Veach's power heuristic: g p/(p_light² + p_reflection²), with
//     g = [F D V NoL + (FmsEms + kD) NoL/π] L.
// The square leaves to the other strategy what this one meets but now and then; with evenly spread points that pays.
// All pixels share the points of a slice; their errors are then smooth across the picture instead of grainy.
// PANORAMA_LIGHTS: 0, 1 or 2 for more of the lights whose colours the panorama needs. The search for the nearest of several
// takes software renderers longer than all the rest, even where no texel asks for it.
#include "blocks.h"
#include "brdf.glsl"
#include "light.glsl"
#include "material.glsl"
#include "stored.glsl"

uniform sampler2D brdf_table;         // A and B over (√NoV, roughness)
uniform sampler2D stored_fragments;   // of which triangle; 0: nothing
uniform vec2 reference_slice;         // how many points; 1/∫ mean radiance dω, exposed

layout(location = 0) out vec4 picture_color;
layout(location = 1) out float replicate_value;

struct Sampled {
    vec3 V;             // in the frame whose z is the shading normal
    vec3 F0;
    vec3 body;          // FmsEms + kD
    float alpha;
    float specular;     // share of directions drawn from the specular lobe
    float k;            // of the bounded distribution
    float t;
    float bound;
};

float mean_channel(vec3 c) { return (c.x + c.y + c.z) * (1.0 / 3.0); }

// What both strategies need of a pixel. k, t and the bound: Eto & Tokuyoshi 2023, listing 1, for one alpha.
Sampled make_sampled(Surface s, vec3 V) {
    Sampled p;
    p.V = V;
    p.alpha = max(square(s.roughness), 1e-4);
    p.F0 = base_reflectance(s.albedo, s.metallic);
    vec2 ab = textureLod(brdf_table, albedo_coordinates(V.z, s.roughness), 0.0).rg;
    ReflectionWeights w = split_sum_weights(s.albedo, s.metallic, ab);
    p.body = w.multiple + w.diffuse;
    float single = mean_channel(w.single);
    float rest = mean_channel(p.body);
    p.specular = rest > 1e-3 * single ? clamp(single / (single + rest), 0.3, 0.9) : 1.0;
    float sine = length(V.xy);
    float s2 = square(1.0 + sine);
    p.k = (1.0 - p.alpha * p.alpha) * s2 / (s2 + p.alpha * p.alpha * V.z * V.z);
    p.t = sqrt(square(p.alpha * sine) + V.z * V.z);
    p.bound = p.k * V.z / p.t;
    return p;
}

// Light from L with its weight. p_light: density of the strategy that draws from the light; drawn: whether it drew this.
vec3 weighed(Sampled p, vec3 L, float p_light, vec3 radiance, bool drawn) {
    if (L.z <= 0.0) return vec3(0.0);
    vec3 sum = p.V + L;
    vec3 H = sum * inversesqrt(max(dot(sum, sum), 1e-20));
    float D = distribution_ggx(dot(H.xy, H.xy), p.alpha * p.alpha);
    float visible = visibility_smith(p.V.z, L.z, p.alpha * p.alpha);
    vec3 g = (fresnel_schlick(p.F0, dot(p.V, H)) * (D * visible) + p.body / kPi) * L.z;
    float p_specular = D / (2.0 * (p.k * p.V.z + p.t));
    float p_reflection = mix(L.z / kPi, p_specular, p.specular);
    float here = drawn ? p_light : p_reflection;
    float ratio = (drawn ? p_reflection : p_light) / here;
    return g * radiance / (here * (1.0 + ratio * ratio));
}

vec3 specular_direction(Sampled p, vec2 azimuth, float u) {
    vec3 i = vec3(p.V.xy * p.alpha, p.V.z) / p.t;
    float z = (1.0 - u) * (1.0 + p.bound) - p.bound;
    vec3 m = i + vec3(sqrt(max(1.0 - z * z, 0.0)) * azimuth, z);
    vec3 H = normalize(vec3(m.xy * p.alpha, max(m.z, 1e-12)));
    return 2.0 * dot(p.V, H) * H - p.V;
}

// A frame around N (Duff et al. 2017).
mat3 frame_around(vec3 N) {
    float side = N.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (side + N.z);
    float b = N.x * N.y * a;
    return mat3(vec3(1.0 + side * N.x * N.x * a, side * b, -side * N.x), vec3(b, side + N.y * N.y * a, -N.y), N);
}

vec3 panorama_texel(vec3 d) {
    ivec2 size = textureSize(panorama_map, 0);
    ivec2 at = ivec2(panorama_coordinates(d) * vec2(size));
    vec4 texel = texelFetch(panorama_map, clamp(at, ivec2(0), size - 1), 0);
#if PANORAMA_LIGHTS == 1
    texel.rgb += texel.a * color_of(light_irradiance[0].rgb);
#elif PANORAMA_LIGHTS > 1
    if (texel.a > 0.0) texel.rgb += texel.a * light_color(d);
#endif
    return texel.rgb * env_scale.x;
}

vec3 estimate(Sampled p, mat3 frame, int i) {
    vec4 light = point_rows[3 * i];
    vec3 radiance = point_rows[3 * i + 1].rgb * camera_position.w;
    vec4 u = point_rows[3 * i + 2];
    vec3 sum = weighed(p, light.xyz * frame, light.w, radiance, true);
    float r = sqrt(u.z);
    vec3 L = u.w < p.specular ? specular_direction(p, u.xy, u.z) : vec3(r * u.xy, sqrt(1.0 - u.z));
    radiance = panorama_texel(frame * L);
    return sum + weighed(p, L, mean_channel(radiance) * reference_slice.y, radiance, false);
}

vec3 reflected() {
    Geometry g = stored_geometry();
    Surface s = surface_of(stored_maps());
    s.roughness = widened_roughness(s.roughness, s.spread);
    mat3 frame = frame_around(environment_direction(g.N));
    vec3 local = environment_direction(g.V) * frame;
    local.z = max(local.z, 1e-4);
    Sampled p = make_sampled(s, normalize(local));
    vec3 sum = vec3(0.0);
    int count = int(reference_slice.x);
    for (int i = 0; i < count; ++i) sum += estimate(p, frame, i);
    return min(at_least(sum * (s.ao / float(count)) + s.emission, 0.0), vec3(ray_right.w));
}

// Software renderers execute both sides of an `if`, and go through a loop as often as any of the pixels they shade together:
// one of no turns spares them the work beside the mesh and where pixels rest.
void main() {
    bool is_surface = texelFetch(stored_fragments, ivec2(gl_FragCoord.xy), 0).r > 0.0;
    vec3 color = vec3(0.0);
    for (int once = is_surface ? 1 : 0; once > 0; --once) color = reflected();
    if (!is_surface) discard;
    picture_color = vec4(color, 1.0);
    replicate_value = mean_channel(color);
}

// What the passes of the reference share: a point of the surface, how it reflects, and the light's cells.
#include "blocks.h"
#include "brdf.glsl"
#include "camera.glsl"
#include "light.glsl"
#include "material.glsl"
#include "stored.glsl"

uniform sampler2D brdf_table;         // A and B over (√NoV, roughness)
uniform sampler2D stored_fragments;   // of which triangle; 0: nothing

struct Sampled {
    vec3 V;             // in the frame whose z is the shading normal
    vec3 F0;
    vec3 body;          // (FmsEms + kD)/π
    float alpha2;
    float t;            // √(alpha² + (1 − alpha²) NoV²)
    float specular;     // share of directions drawn from the specular lobe
    float bound;        // of the bounded distribution: 1 + the least z
    float p_specular;   // its density over D, times that share
    float p_evenly;     // density of the others over NoL, times theirs
};

float mean_channel(vec3 c) { return (c.x + c.y + c.z) * (1.0 / 3.0); }

// k, t and the bound: Eto & Tokuyoshi 2023, listing 1, for one alpha.
Sampled make_sampled(Surface s, vec3 V) {
    Sampled p;
    p.V = V;
    float alpha = max(square(s.roughness), 1e-4);
    p.alpha2 = square(alpha);
    p.F0 = base_reflectance(s.albedo, s.metallic);
    vec2 ab = textureLod(brdf_table, albedo_coordinates(V.z, s.roughness), 0.0).rg;
    ReflectionWeights w = split_sum_weights(s.albedo, s.metallic, ab);
    p.body = (w.multiple + w.diffuse) / kPi;
    float single = mean_channel(w.single);
    float rest = mean_channel(w.multiple + w.diffuse);
    p.specular = rest > 1e-3 * single ? clamp(single / (single + rest), 0.3, 0.9) : 1.0;
    float sine = length(V.xy);
    float s2 = square(1.0 + sine);
    float k = (1.0 - p.alpha2) * s2 / (s2 + p.alpha2 * V.z * V.z);
    p.t = sqrt(square(alpha * sine) + V.z * V.z);
    p.bound = 1.0 + k * V.z / p.t;
    p.p_specular = p.specular / (2.0 * (k * V.z + p.t));
    p.p_evenly = (1.0 - p.specular) / kPi;
    return p;
}

// A frame around N (Duff et al. 2017).
mat3 frame_around(vec3 N) {
    float side = N.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (side + N.z);
    float b = N.x * N.y * a;
    return mat3(vec3(1.0 + side * N.x * N.x * a, side * b, -side * N.x), vec3(b, side + N.y * N.y * a, -N.y), N);
}

// What was rasterised here. frame: from the surface's frame to the environment's.
Surface stored_surface(out Sampled p, out mat3 frame) {
    Geometry g = stored_geometry(gl_FragCoord.xy);
    Surface s = surface_of(stored_maps());
    s.roughness = widened_roughness(s.roughness, s.spread);
    frame = frame_around(environment_direction(g.N));
    vec3 local = environment_direction(g.V) * frame;
    local.z = max(local.z, 1e-4);
    p = make_sampled(s, normalize(local));
    return s;
}

// How much a cell reflects of its light is kept in a byte, its fourth root over that of kMostReflected: from 1/kMostReflected to
// there. Nothing is left out, since no byte is 0.
const int kCellWords = PATINA_LIGHT_CELLS / 4;
const float kMostReflected = 1e5;

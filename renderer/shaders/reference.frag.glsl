// A slice of the reflectance integral by sampling, unbiased: the mean of `count` estimates, each from one direction drawn
// from the light and one drawn from the reflection (the bounded distribution of visible normals of Eto & Tokuyoshi 2023, or
// the cosine), weighted by Veach's power heuristic: g p/(p_light² + p_reflection²), with
//     g = [F D V NoL + (FmsEms + kD) NoL/π] L.
// The square leaves to the other strategy what this one meets but now and then; with evenly spread points that pays.
// The panorama is divided into cells (ibl/light_cells.h). A pixel draws from a cell about as often as it reflects of the
// cell's light, judged by the cell's middle and width: of several softboxes it looks at the one that it mirrors.
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
uniform sampler2D light_points;       // a column a cell, two rows a point: direction, density in the cell; radiance
uniform sampler2D light_cells;        // of a texel of the panorama: its cell, of 255
uniform int reference_points;         // of the slice

layout(location = 0) out vec4 picture_color;
layout(location = 1) out float replicate_value;

struct Sampled {
    vec3 V;             // in the frame whose z is the shading normal
    vec3 F0;
    vec3 body;          // FmsEms + kD
    float f0;           // means of the channels: of F0, of the body over π
    float evenly;
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
    p.f0 = mean_channel(p.F0);
    p.evenly = mean_channel(p.body) / kPi;
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

// What is reflected of each cell, about, and the sums up to and with it: four cells a row, all indices constants, since software
// renderers index arrays of their own by gathering and scattering.
const int kCellRows = PATINA_LIGHT_CELLS / 4;
vec4 cell_shares[kCellRows];
vec4 cell_ends[kCellRows];
const float kEvenShare = 0.003;       // a hundredth of what white reflects evenly: whatever the direction, no light is left out

// About what is reflected of a cell's light, times its light: a lobe as much wider as the cell is, from the cell's middle.
// With S = V + L: VoH = |S|/2, and D(H) = w |S|⁴/(π (S.x² + S.y² + w S.z²)²), w = alpha² + (width/|S|)². Its wide tails
// keep the weights from being far off where the cell's middle says little. Vis is taken as ½/mix(2 NoL NoV, NoL + NoV, alpha).
float cell_share(Sampled p, mat3 frame, int i) {
    vec4 cell = cell_rows[2 * i];
    vec4 more = cell_rows[2 * i + 1];
    vec3 middle = cell.xyz * frame;
    vec3 S = p.V + vec3(middle.xy, max(middle.z, 1e-3));
    float size2 = dot(S, S);
    float wide = p.alpha * p.alpha + cell.w / max(size2, 0.2);
    float spread = dot(S.xy, S.xy) + wide * S.z * S.z;
    float NoL = max(middle.z, 0.0) + 0.3 * more.z;
    float shadowed = mix(2.0 * NoL * p.V.z, NoL + p.V.z, p.alpha);
    float F = p.f0 + (1.0 - p.f0) * pow5(max(1.0 - 0.5 * sqrt(size2), 0.0));
    float single = 0.5 * F * wide * size2 * size2 / (spread * spread * shadowed);
    float reflected = middle.z < -1.5 * more.z ? 0.0 : (single + p.evenly) * NoL;
    return (reflected + kEvenShare) * more.x;
}

void set_cell_row(Sampled p, mat3 frame, int i, float before, out vec4 shares, out vec4 ends) {
    shares = vec4(cell_share(p, frame, 4 * i), cell_share(p, frame, 4 * i + 1), cell_share(p, frame, 4 * i + 2),
                  cell_share(p, frame, 4 * i + 3));
    ends.x = before + shares.x;
    ends.y = ends.x + shares.y;
    ends.z = ends.y + shares.z;
    ends.w = ends.z + shares.w;
}

void set_cells(Sampled p, mat3 frame) {
    set_cell_row(p, frame, 0, 0.0, cell_shares[0], cell_ends[0]);
    set_cell_row(p, frame, 1, cell_ends[0].w, cell_shares[1], cell_ends[1]);
    set_cell_row(p, frame, 2, cell_ends[1].w, cell_shares[2], cell_ends[2]);
    set_cell_row(p, frame, 3, cell_ends[2].w, cell_shares[3], cell_ends[3]);
    set_cell_row(p, frame, 4, cell_ends[3].w, cell_shares[4], cell_ends[4]);
    set_cell_row(p, frame, 5, cell_ends[4].w, cell_shares[5], cell_ends[5]);
    set_cell_row(p, frame, 6, cell_ends[5].w, cell_shares[6], cell_ends[6]);
    set_cell_row(p, frame, 7, cell_ends[6].w, cell_shares[7], cell_ends[7]);
}

int cell_at(float u) {
    vec4 wanted = vec4(u * cell_ends[kCellRows - 1].w);
    vec4 passed = vec4(0.0);
    for (int i = 0; i < kCellRows; ++i) passed += vec4(lessThanEqual(cell_ends[i], wanted));
    return min(int(dot(passed, vec4(1.0))), PATINA_LIGHT_CELLS - 1);
}

// Of the directions from the light, those that lie in a cell.
float share_of(int cell) {
    vec4 row = vec4(0.0);
    for (int i = 0; i < kCellRows; ++i) row = cell / 4 == i ? cell_shares[i] : row;
    return dot(row, vec4(equal(ivec4(cell % 4), ivec4(0, 1, 2, 3)))) / cell_ends[kCellRows - 1].w;
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
    float here = max(drawn ? p_light : p_reflection, 1e-20);   // 0 only where no light is
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

vec3 panorama_texel(vec3 d, ivec2 at) {
    vec4 texel = texelFetch(panorama_map, at, 0);
#if PANORAMA_LIGHTS == 1
    texel.rgb += texel.a * color_of(light_irradiance[0].rgb);
#elif PANORAMA_LIGHTS > 1
    if (texel.a > 0.0) texel.rgb += texel.a * light_color(d);
#endif
    return texel.rgb * env_scale.x;
}

vec3 from_light(Sampled p, mat3 frame, int i) {
    int cell = cell_at(point_rows[2 * i + 1].x);
    vec4 light = texelFetch(light_points, ivec2(cell, 2 * i), 0);
    vec3 radiance = texelFetch(light_points, ivec2(cell, 2 * i + 1), 0).rgb * camera_position.w;
    return weighed(p, light.xyz * frame, light.w * share_of(cell), radiance, true);
}

vec3 from_reflection(Sampled p, mat3 frame, int i) {
    vec4 u = point_rows[2 * i];
    float r = sqrt(u.z);
    vec3 L = u.w < p.specular ? specular_direction(p, u.xy, u.z) : vec3(r * u.xy, sqrt(1.0 - u.z));
    vec3 d = frame * L;
    ivec2 size = textureSize(panorama_map, 0);
    ivec2 at = clamp(ivec2(panorama_coordinates(d) * vec2(size)), ivec2(0), size - 1);
    vec3 radiance = panorama_texel(d, at);
    int cell = int(texelFetch(light_cells, at, 0).r * 255.0 + 0.5);
    float p_light = mean_channel(radiance) / camera_position.w * cell_rows[2 * cell + 1].y * share_of(cell);
    return weighed(p, L, p_light, radiance, false);
}

vec3 reflected() {
    Geometry g = stored_geometry();
    Surface s = surface_of(stored_maps());
    s.roughness = widened_roughness(s.roughness, s.spread);
    mat3 frame = frame_around(environment_direction(g.N));
    vec3 local = environment_direction(g.V) * frame;
    local.z = max(local.z, 1e-4);
    Sampled p = make_sampled(s, normalize(local));
    set_cells(p, frame);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < reference_points; ++i) sum += from_light(p, frame, i) + from_reflection(p, frame, i);
    return min(at_least(sum * (s.ao / float(reference_points)) + s.emission, 0.0), vec3(ray_right.w));
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

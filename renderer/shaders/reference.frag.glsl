// A slice of the reflectance integral by sampling, unbiased: the mean of `count` estimates, each from one direction drawn
// from the light and one drawn from the reflection (the bounded distribution of visible normals of Eto & Tokuyoshi 2023, or
// the cosine), weighted by Veach's power heuristic: g p/(p_light² + p_reflection²), with
//     g = [F D V NoL + (FmsEms + kD) NoL/π] L.
// The square leaves to the other strategy what this one meets but now and then; with evenly spread points that pays.
// The panorama is divided into cells (ibl/light_cells.h). A pixel draws from a cell about as often as it reflects of the
// cell's light (reference_cells.frag.glsl): of several softboxes it looks at the one that it mirrors.
// All pixels share the points of a slice; their errors are then smooth across the picture instead of grainy.
// What is the same for all pixels lies in buffer textures, and the panorama in a rectangle: a software renderer then spares
// itself the search for the mip level of every look-up, which takes it longer than the look-up.
#include "reference.glsl"

uniform usampler2DRect first_reflected_cells;   // as reference_cells.frag.glsl leaves them
uniform usampler2DRect last_reflected_cells;
uniform samplerBuffer slice_points;        // light of the cells, four a texel; then one a point: cos φ, sin φ and u of a reflected
                                           // direction, choice of lobe and of cell
uniform samplerBuffer light_points;        // a point's cells one after the other: direction; radiance
uniform sampler2DRect light_texels;        // the panorama: radiance, cell
uniform int reference_points;              // of the slice

layout(location = 0) out vec4 picture_color;
layout(location = 1) out float replicate_value;

// Software renderers index arrays of their own by gathering and scattering: all indices but a texture's are constants.
uvec4 cell_words[2];
vec4 cell_ends[kCellWords];   // what is reflected of the cells, up to and with each
float cell_density;

float reflected_of(uint word, int byte) {
    return square(square(float(int(word >> uint(8 * byte) & 255u))));
}

void set_word(uint word, int i, float before) {
    vec4 light = texelFetch(slice_points, i);
    cell_ends[i].x = before + reflected_of(word, 0) * light.x;
    cell_ends[i].y = cell_ends[i].x + reflected_of(word, 1) * light.y;
    cell_ends[i].z = cell_ends[i].y + reflected_of(word, 2) * light.z;
    cell_ends[i].w = cell_ends[i].z + reflected_of(word, 3) * light.w;
}

void set_cells() {
    cell_words[0] = texelFetch(first_reflected_cells, ivec2(gl_FragCoord.xy));
    cell_words[1] = texelFetch(last_reflected_cells, ivec2(gl_FragCoord.xy));
    set_word(cell_words[0].x, 0, 0.0);
    set_word(cell_words[0].y, 1, cell_ends[0].w);
    set_word(cell_words[0].z, 2, cell_ends[1].w);
    set_word(cell_words[0].w, 3, cell_ends[2].w);
    set_word(cell_words[1].x, 4, cell_ends[3].w);
    set_word(cell_words[1].y, 5, cell_ends[4].w);
    set_word(cell_words[1].z, 6, cell_ends[5].w);
    set_word(cell_words[1].w, 7, cell_ends[6].w);
    cell_density = light_layout.y / max(cell_ends[kCellWords - 1].w, 1e-30);
}

int cell_at(float u) {
    vec4 wanted = vec4(u * cell_ends[kCellWords - 1].w);
    vec4 passed = vec4(0.0);
    for (int i = 0; i < kCellWords; ++i) passed += vec4(lessThanEqual(cell_ends[i], wanted));
    return int(min(dot(passed, vec4(1.0)), light_layout.x - 1.0));
}

// Density of the strategy that draws from the light, over the mean channel there.
float density_in(int cell) {
    int word = cell >> 2;
    uvec4 words = word < 4 ? cell_words[0] : cell_words[1];
    uvec2 two = (word & 2) == 0 ? words.xy : words.zw;
    uint one = (word & 1) == 0 ? two.x : two.y;
    return square(square(float(int(one >> uint(8 * (cell & 3)) & 255u)))) * cell_density;
}

// Light from L with its weight. p_light: density of the strategy that draws from the light; drawn: whether it drew this.
// With S = V + L: H = S/|S| and VoH = |S|/2, and D as in reference_cells.frag.glsl.
vec3 weighed(Sampled p, vec3 L, float p_light, bool drawn) {
    vec3 S = p.V + L;
    float size2 = dot(S, S);
    float D = p.alpha2 * square(size2 / (dot(S.xy, S.xy) + p.alpha2 * S.z * S.z)) / kPi;
    float NoL = max(L.z, 0.0);
    float visible = 0.5 / max(NoL * p.t + p.V.z * sqrt(NoL * NoL * (1.0 - p.alpha2) + p.alpha2), 1e-8);
    vec3 F = p.F0 + (1.0 - p.F0) * pow5(max(1.0 - 0.5 * sqrt(size2), 0.0));
    float p_reflection = NoL * p.p_evenly + D * p.p_specular;
    float p_drawn = drawn ? p_light : p_reflection;
    float weight = NoL * p_drawn / max(p_light * p_light + p_reflection * p_reflection, 1e-30);
    return (F * (D * visible) + p.body) * weight;
}

vec3 specular_direction(Sampled p, vec2 azimuth, float u) {
    float z = (1.0 - u) * p.bound + (1.0 - p.bound);
    float r = sqrt(max(1.0 - z * z, 0.0));
    vec3 m = vec3(p.V.xy * (p.alpha2 / p.t) + (sqrt(p.alpha2) * r) * azimuth, max(p.V.z / p.t + z, 1e-12));
    return (2.0 * dot(p.V, m) / dot(m, m)) * m - p.V;
}

// As light.glsl's panorama_coordinates, of a finite direction, to 10⁻⁵ rad.
float angle_of(float y, float x) {
    float a = abs(x);
    float b = abs(y);
    float t = min(a, b) / max(max(a, b), 1e-30);
    float s = t * t;
    float angle = t * (0.99997931 + s * (-0.33267564 + s * (0.19389250 + s * (-0.11735032 + s * (0.05368138 - s * 0.01213232)))));
    angle = b > a ? 0.5 * kPi - angle : angle;
    angle = x < 0.0 ? kPi - angle : angle;
    return y < 0.0 ? -angle : angle;
}
vec2 place_of(vec3 d) { return vec2(0.5 + angle_of(d.x, -d.z) / (2.0 * kPi), angle_of(length(d.xz), d.y) / kPi); }

vec3 from_light(Sampled p, mat3 frame, int i, float u) {
    int cell = cell_at(u);
    int at = 2 * (i * int(light_layout.x) + cell);
    vec3 direction = texelFetch(light_points, at).xyz;
    vec3 radiance = texelFetch(light_points, at + 1).rgb;
    return weighed(p, direction * frame, mean_channel(radiance) * density_in(cell), true) * radiance;
}

vec3 from_reflection(Sampled p, mat3 frame, vec4 u) {
    float r = sqrt(u.z);
    vec3 L = u.w < p.specular ? specular_direction(p, u.xy, u.z) : vec3(r * u.xy, sqrt(1.0 - u.z));
    vec2 at = clamp(place_of(frame * L) * light_layout.zw, vec2(0.0), light_layout.zw - 1.0);
    vec4 texel = texelFetch(light_texels, ivec2(at));
    return weighed(p, L, mean_channel(texel.rgb) * density_in(int(texel.a)), false) * texel.rgb;
}

vec3 reflected() {
    Sampled p;
    mat3 frame;
    Surface s = stored_surface(p, frame);
    set_cells();
    vec3 sum = vec3(0.0);
    for (int i = 0; i < reference_points; ++i) {
        vec4 u = texelFetch(slice_points, kCellWords + i);
        sum += from_light(p, frame, i, u.w) + from_reflection(p, frame, u);
    }
    float scale = s.ao * camera_position.w / float(reference_points);
    return min(at_least(sum * scale + s.emission, 0.0), vec3(ray_right.w));
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

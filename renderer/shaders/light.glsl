// What the environment sends: the panorama itself, its prefiltered levels and its irradiance, all exposed.

uniform sampler2D panorama_map;         // equirectangular, row 0 at the top
uniform samplerCubeArray level_maps;    // level k in layer k mod layers, mip k div layers
uniform samplerCube irradiance_map;     // E/π

vec3 environment_direction(vec3 d) {
    return vec3(dot(env_from_world[0].xyz, d), dot(env_from_world[1].xyz, d), dot(env_from_world[2].xyz, d));
}

// u = ½ + atan2(x, −z)/2π, v = acos(y)/π; acos as atan, which keeps its precision at the poles, where the azimuth is
// free and atan(0, 0) must not be asked for.
vec2 panorama_coordinates(vec3 d) {
    float r = length(d.xz);
    float azimuth = r > 1e-12 ? atan(d.x, -d.z) : 0.0;
    return vec2(0.5 + azimuth / (2.0 * kPi), atan(r, d.y) / kPi);
}

// The panorama averaged over a solid angle. Its mip levels average over isotropic patches of the sphere, poles included
// (gl/panorama.cpp), so the level is the patch's width in texels and needs no derivative: no seam at u = 0. Alpha is what
// the extracted lights hold beyond the red, green and blue.
vec4 panorama_texel(vec2 at, float solid_angle) {
    float lod = 0.5 * log2(max(solid_angle, 1e-16)) + log2(env_scale.w);
    return textureLod(panorama_map, at, max(lod, 0.0));
}

// lights: how much of the extracted lights is wanted, in their colour.
vec3 panorama_light(vec3 d, float solid_angle, vec3 lights) {
    vec4 texel = panorama_texel(panorama_coordinates(d), solid_angle);
    return (texel.rgb + texel.a * lights) * env_scale.x;
}

vec3 color_of(vec3 irradiance) { return irradiance * (3.0 / max(dot(irradiance, vec3(1.0)), 1e-30)); }

// The colour of the extracted light that lies nearest to a direction, with a mean channel of 1.
vec3 light_color(vec3 d) {
    vec3 world = d.x * env_from_world[0].xyz + d.y * env_from_world[1].xyz + d.z * env_from_world[2].xyz;
    int nearest = -1;
    float most = -2.0;
    for (int i = 0; i < int(counts.z); ++i) {
        float near = dot(light_direction[i].xyz, world);
        if (near > most) nearest = i;
        most = max(most, near);
    }
    return nearest < 0 ? vec3(1.0) : color_of(light_irradiance[nearest].rgb);
}

// d in the environment's frame.
vec3 irradiance_light(vec3 d) {
    return textureLod(irradiance_map, d, 0.0).rgb * env_scale.z;
}

vec3 level_light(vec3 d, float level) {
    float mip = floor((level + 0.5) / level_layout.y);
    return textureLod(level_maps, vec4(d, level - mip * level_layout.y), mip).rgb;
}

// 0, 1, 2, … at the roughness of each level, linear in its logarithm between, the first's or the last's beyond them. Each
// segment of this piecewise linear map contributes its clamped share, so no search and no branch. As many turns as there are
// rows: a loop that a compiler can unroll becomes one block of code with what surrounds it, which takes a software renderer
// half as long again.
float bounded_level_index(float log2_roughness) {
    float level = 0.0;
    int rows = (int(level_layout.x) + 3) / 4;
    for (int i = 0; i < rows; ++i) {
        level += dot(clamp(level_slope[i] * log2_roughness + level_offset[i], 0.0, 1.0), vec4(1.0));
    }
    return level;
}

// Likewise, but beyond the ends as if standard levels went on there.
float level_index(float log2_roughness) {
    float beyond = log2_roughness - clamp(log2_roughness, level_ends.x, level_ends.y);
    return bounded_level_index(log2_roughness) + kLevelsPerOctave * beyond;
}

// Two neighbouring levels, mixed linearly in log roughness.
vec3 prefiltered_light(vec3 d, float log2_roughness) {
    float level = bounded_level_index(log2_roughness);
    float lower = min(floor(level), level_layout.x);
    float upper = min(lower + 1.0, level_layout.x);
    return mix(level_light(d, lower), level_light(d, upper), level - lower) * env_scale.y;
}

#ifdef HAS_SHARP
// Points that share the core out: a golden-angle spiral over its half vectors, a plastic-number lattice over the pixel.
const int kCoreSamples = 32;
const vec2 kGoldenTurn = vec2(-0.7373688, 0.6754903);   // cos and sin of the golden angle
const vec2 kPixelStep = vec2(0.7548777, 0.5698403);
const vec2 kPixelStart = vec2(0.57925, 0.106);           // so that the points' mean, by their mass, is the pixel's middle

struct Core {
    vec3 N;
    vec3 V;
    vec3 across;    // of N over the pixel
    vec3 up;
    float alpha;    // of the sharp lobe
    float alpha1;   // of the wider one whose tails it has
    float f0;
    vec3 lights;    // how much of the extracted lights is to be seen
};

// The compact core that a sharp lobe has beyond the tails of a wider one (core_tangent2): half vectors sampled by its
// distribution around the normals that the pixel holds, their reflections weighted by what the reflection model has beside D,
// so that the lobe is as narrow across the plane of incidence as the true one. Each sample is the panorama averaged over the
// solid angle it stands for (Krivánek & Colbert 2008), of the core and of the pixel. (1 − u)² of the core's mass lie beyond
// point u, so that the outer points stand for little each: what lies around a lamp is dark, and a patch that reached from
// there into the lamp would light it. N = V = R, half of R's change over the pixel and any Fresnel term give the lobe of the prefiltered levels.
// Without any lobe that sharp among the pixels shaded together the loop is not entered; software renderers execute both
// sides of an `if`, so a loop of no turns is what spares them the work.
vec3 core_light(Core c) {
    int count = c.alpha < c.alpha1 ? kCoreSamples : 0;
    float alpha2 = max(c.alpha * c.alpha, 1e-14);
    float alpha1_2 = square(c.alpha1);
    // Azimuths count from the panorama's own east, so that the pattern turns smoothly everywhere but at its poles.
    float r = length(c.N.xz);
    vec3 east = r > 1e-6 ? vec3(-c.N.z, 0.0, c.N.x) / r : vec3(1.0, 0.0, 0.0);
    vec3 north = cross(c.N, east);
    float pixel = length(cross(c.across, c.up));
    float NoV = max(dot(c.N, c.V), 1e-4);
    vec4 sum = vec4(0.0);
    vec2 azimuth = vec2(1.0, 0.0);
    vec2 place = kPixelStart;
    for (int i = 0; i < count; ++i) {
        float left = 1.0 - (float(i) + 0.5) / float(count);
        float mass = 2.0 * left / float(count);
        float t = core_tangent2(1.0 / square(left) - 1.0, alpha2, alpha1_2);   // tan² of the half vector's angle
        float NoH = inversesqrt(1.0 + t);
        vec2 within = place - 0.5;
        vec3 H = normalize(c.N + within.x * c.across + within.y * c.up + sqrt(t) * (azimuth.x * east + azimuth.y * north));
        float VoH = max(dot(c.V, H), 1e-4);
        vec3 L = 2.0 * VoH * H - c.V;
        float NoL = max(dot(c.N, L), 0.0);
        float F = c.f0 + (1.0 - c.f0) * pow5(1.0 - min(VoH, 1.0));
        float weight = mass * F * visibility_smith(NoV, NoL, alpha2) * NoL * VoH / NoH;
        float own = mass / (NoH * max(core_density(t, alpha2, alpha1_2), 1e-12)) + 4.0 * pixel / float(count);
        sum += weight * vec4(panorama_light(L, 0.5 * VoH * own, c.lights), 1.0);   // bilinear look-ups widen it to the whole
        azimuth = vec2(azimuth.x * kGoldenTurn.x - azimuth.y * kGoldenTurn.y,
                       azimuth.x * kGoldenTurn.y + azimuth.y * kGoldenTurn.x);
        place = fract(place + kPixelStep);
    }
    return sum.rgb / max(sum.a, 1e-12);
}
#endif

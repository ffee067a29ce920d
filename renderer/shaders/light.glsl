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
// (gl/panorama.cpp), so the level is the patch's width in texels and needs no derivative: no seam at u = 0.
vec3 panorama_light(vec3 d, float solid_angle) {
    float lod = 0.5 * log2(max(solid_angle, 1e-16)) + log2(env_scale.w);
    return textureLod(panorama_map, panorama_coordinates(d), max(lod, 0.0)).rgb * env_scale.x;
}

vec3 irradiance_light(vec3 N) {
    return textureLod(irradiance_map, environment_direction(N), 0.0).rgb * env_scale.z;
}

vec3 level_light(vec3 d, float level) {
    float mip = floor((level + 0.5) / level_layout.y);
    return textureLod(level_maps, vec4(d, level - mip * level_layout.y), mip).rgb;
}

// Two neighbouring levels, mixed linearly in log roughness. Each segment of the piecewise linear map from log roughness
// to level contributes its clamped share, so no search and no branch.
vec3 prefiltered_light(vec3 d, float roughness) {
    float x = log2(max(roughness, 1e-4));
    float level = 0.0;
    for (int i = 0; i < PATINA_LEVEL_ROWS; ++i) {
        if (float(4 * i) >= level_layout.x) break;
        level += dot(clamp(level_slope[i] * x + level_offset[i], 0.0, 1.0), vec4(1.0));
    }
    float lower = min(floor(level), level_layout.x);
    float upper = min(lower + 1.0, level_layout.x);
    return mix(level_light(d, lower), level_light(d, upper), level - lower) * env_scale.y;
}

#ifdef HAS_SHARP
// A golden-angle spiral of equal shares of the core: q = u/(1 − u) at u = (i + ½)/n, and the azimuth.
const int kCoreSamples = 16;
const vec2 kGoldenTurn = vec2(-0.7373688, 0.6754903);   // cos and sin of the golden angle

// The compact core that a lobe sharper than the sharpest level has beyond that level's tails (core_tangent2): importance
// samples of the panorama, each averaged over the solid angle it stands for (Krivánek & Colbert 2008) and the pixel's.
// Without any lobe that sharp among the pixels shaded together the loop is not entered; software renderers execute both
// sides of an `if`, so a loop of no turns is what spares them the work.
vec3 core_light(vec3 R, float alpha, float pixel_solid_angle) {
    // Below roughness 0.01 the lobe is narrower than any panorama's texel: its middle says it all.
    int count = alpha < 1e-4 ? 1 : alpha < level_layout.w ? kCoreSamples : 0;
    float middle = count == 1 ? 0.0 : 0.5;
    float alpha2 = max(alpha * alpha, 1e-14);
    float alpha1_2 = level_layout.w * level_layout.w;
    // Azimuths count from the panorama's own east, so that the pattern turns smoothly everywhere but at its poles.
    float r = length(R.xz);
    vec3 east = r > 1e-6 ? vec3(-R.z, 0.0, R.x) / r : vec3(1.0, 0.0, 0.0);
    vec3 north = cross(R, east);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    vec2 azimuth = vec2(1.0, 0.0);
    for (int i = 0; i < count; ++i) {
        float u = (float(i) + middle) / float(count);
        float t = core_tangent2(u / (1.0 - u), alpha2, alpha1_2);
        float share = 1.0 / (float(count) * max(core_density(t, alpha2, alpha1_2), 1e-12));
        // l = 2 (n·h) h − n with n = R: cos θ_l = (1 − t)/(1 + t), sin θ_l = 2 √t/(1 + t).
        float cosine = (1.0 - t) / (1.0 + t);
        float sine = 2.0 * sqrt(t) / (1.0 + t);
        vec3 l = cosine * R + sine * (azimuth.x * east + azimuth.y * north);
        float weight = max(cosine, 0.0);
        sum += weight * panorama_light(l, share + pixel_solid_angle);
        weights += weight;
        azimuth = vec2(azimuth.x * kGoldenTurn.x - azimuth.y * kGoldenTurn.y,
                       azimuth.x * kGoldenTurn.y + azimuth.y * kGoldenTurn.x);
    }
    return sum / max(weights, 1e-6);
}
#endif

// Light reflected along R by the lobe of N = V = R; pixel_solid_angle: how much of the sphere R covers in this pixel.
vec3 specular_light(vec3 R, float roughness, float pixel_solid_angle) {
    vec3 d = environment_direction(R);
    vec3 light = prefiltered_light(d, roughness);   // below the sharpest level it is that level
#ifdef HAS_SHARP
    float alpha = roughness * roughness;
    float tails = min(square(alpha / level_layout.w), 1.0);
    light = tails * light + (1.0 - tails) * core_light(d, alpha, pixel_solid_angle);
#endif
    return light;
}

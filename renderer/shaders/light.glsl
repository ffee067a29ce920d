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
// the extracted lights hold beyond the red, green and blue; `lights` is how much of it is wanted, in their colour.
vec3 panorama_light(vec3 d, float solid_angle, vec3 lights) {
    float lod = 0.5 * log2(max(solid_angle, 1e-16)) + log2(env_scale.w);
    vec4 texel = textureLod(panorama_map, panorama_coordinates(d), max(lod, 0.0));
    return (texel.rgb + texel.a * lights) * env_scale.x;
}

// The colour of the extracted light that lies nearest to a direction, with a mean channel of 1.
vec3 light_color(vec3 d) {
    vec3 color = vec3(1.0);
    float nearest = -2.0;
    for (int i = 0; i < PATINA_MAX_LIGHTS; ++i) {
        if (float(i) >= counts.z) break;
        float near = dot(environment_direction(light_direction[i].xyz), d);
        vec3 E = light_irradiance[i].rgb;
        if (near > nearest) color = E * (3.0 / max(dot(E, vec3(1.0)), 1e-30));
        nearest = max(nearest, near);
    }
    return color;
}

// d in the environment's frame.
vec3 irradiance_light(vec3 d) {
    return textureLod(irradiance_map, d, 0.0).rgb * env_scale.z;
}

vec3 level_light(vec3 d, float level) {
    float mip = floor((level + 0.5) / level_layout.y);
    return textureLod(level_maps, vec4(d, level - mip * level_layout.y), mip).rgb;
}

// Two neighbouring levels, mixed linearly in log roughness. Each segment of the piecewise linear map from log roughness
// to level contributes its clamped share, so no search and no branch.
vec3 prefiltered_light(vec3 d, float log2_roughness) {
    float level = 0.0;
    for (int i = 0; i < PATINA_LEVEL_ROWS; ++i) {
        if (float(4 * i) >= level_layout.x) break;
        level += dot(clamp(level_slope[i] * log2_roughness + level_offset[i], 0.0, 1.0), vec4(1.0));
    }
    float lower = min(floor(level), level_layout.x);
    float upper = min(lower + 1.0, level_layout.x);
    return mix(level_light(d, lower), level_light(d, upper), level - lower) * env_scale.y;
}

#ifdef HAS_SHARP
// A golden-angle spiral of equal shares of the core: q = u/(1 − u) at u = (i + ½)/n, and the azimuth.
const int kCoreSamples = 24;
const vec2 kGoldenTurn = vec2(-0.7373688, 0.6754903);   // cos and sin of the golden angle

// The compact core that a sharp lobe (alphas.x) has beyond the tails of a wider one (alphas.y, core_tangent2): half vectors
// sampled around N by its distribution, their reflections weighted by what the reflection model has beside D, so that the
// lobe is as narrow across the plane of incidence as the true one. Each sample is the panorama averaged over the solid
// angle it stands for (Krivánek & Colbert 2008) and the pixel's. N = V = R gives the lobe of the prefiltered levels.
// Without any lobe that sharp among the pixels shaded together the loop is not entered; software renderers execute both
// sides of an `if`, so a loop of no turns is what spares them the work.
vec3 core_light(vec3 N, vec3 V, vec2 alphas, float f0, vec4 lights_and_pixel) {
    float alpha = alphas.x;
    // Below roughness 0.01 the lobe is narrower than any panorama's texel: its middle says it all.
    int count = alpha < 1e-4 ? 1 : alpha < alphas.y ? kCoreSamples : 0;
    float middle = count == 1 ? 0.0 : 0.5;
    float alpha2 = max(alpha * alpha, 1e-14);
    float alpha1_2 = square(alphas.y);
    // Azimuths count from the panorama's own east, so that the pattern turns smoothly everywhere but at its poles.
    float r = length(N.xz);
    vec3 east = r > 1e-6 ? vec3(-N.z, 0.0, N.x) / r : vec3(1.0, 0.0, 0.0);
    vec3 north = cross(N, east);
    float NoV = max(dot(N, V), 1e-4);
    vec4 sum = vec4(0.0);
    vec2 azimuth = vec2(1.0, 0.0);
    for (int i = 0; i < count; ++i) {
        float u = (float(i) + middle) / float(count);
        float t = core_tangent2(u / (1.0 - u), alpha2, alpha1_2);   // tan² of the half vector's angle
        float NoH = inversesqrt(1.0 + t);
        vec3 H = NoH * (N + sqrt(t) * (azimuth.x * east + azimuth.y * north));
        float VoH = max(dot(V, H), 1e-4);
        vec3 L = 2.0 * VoH * H - V;
        float NoL = max(dot(N, L), 0.0);
        float F = f0 + (1.0 - f0) * pow5(1.0 - min(VoH, 1.0));
        float weight = F * visibility_smith(NoV, NoL, alpha2) * NoL * VoH / NoH;
        float share = VoH / (NoH * float(count) * max(core_density(t, alpha2, alpha1_2), 1e-12));
        sum += weight * vec4(panorama_light(L, share + lights_and_pixel.w, lights_and_pixel.rgb), 1.0);
        azimuth = vec2(azimuth.x * kGoldenTurn.x - azimuth.y * kGoldenTurn.y,
                       azimuth.x * kGoldenTurn.y + azimuth.y * kGoldenTurn.x);
    }
    return sum.rgb / max(sum.a, 1e-12);
}
#endif

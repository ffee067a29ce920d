// What the environment sends into the specular lobe of a point: P of brdf.glsl's equation (2), by the shading mode.

#ifdef HAS_FITTED
uniform sampler3D lobe_table;   // over (√NoV, log roughness); pairs of slices for F0 = 1 and 0.04 (renderer/lobes)
#endif

// A point as its lobe needs it, directions in the environment's frame.
struct LobePoint {
    vec3 N;
    vec3 V;
    vec3 R;
    float NoV;
    float roughness;
    vec2 ab;            // A and B
    float f0;           // luminance of F0
    vec3 irradiance;    // E/π
    vec3 across;        // how N changes over the pixel
    vec3 up;
};

#ifdef HAS_FITTED
vec4 lobe_slice(LobePoint p, float log2_roughness, float first) {
    vec3 size = vec3(textureSize(lobe_table, 0));
    vec2 at = lobe_coordinates(p.NoV, log2_roughness) * (size.xy - 1.0) + 0.5;
    return textureLod(lobe_table, vec3(at, first + 0.5 + fresnel_share(p.f0, p.ab)) / size, 0.0);
}

// Equation (3). The table's log2(ρ/r), κ, λ and w_E; of four levels a1 and a2.
vec3 swept_light(LobePoint p, float log2_roughness) {
    float alpha = max(square(p.roughness), level_layout.w);
#ifdef HAS_FOUR_LEVELS
    const int count = 4;
    vec4 sweep = lobe_slice(p, log2_roughness, 2.0);
    float level = level_index(log2_roughness + sweep.x);
    float first = floor(level) - 1.0;
    vec4 weights = sweep_weights(level - 1.0 - first, lobe_slice(p, log2_roughness, 4.0).xy);
#else
    const int count = 2;
    vec4 sweep = lobe_slice(p, log2_roughness, 0.0);
    float level = level_index(log2_roughness + sweep.x);
    float first = floor(level);
    vec2 weights = vec2(first + 1.0 - level, level - first);
#endif
    vec3 light = vec3(0.0);
    for (int i = 0; i < count; ++i) {
        float m = first + float(i);
        vec3 d = swept_direction(p.R, p.N, sweep.y + sweep.z * (m - level), alpha);
        light += weights[i] * level_light(d, clamp(m, 0.0, level_layout.x));
    }
    return mix(light * env_scale.y, p.irradiance, sweep.w);
}
#endif

// Of a lobe no sharper than the sharpest level; a sharper one is taken for that.
vec3 wide_lobe_light(LobePoint p) {
    float log2_roughness = log2(max(p.roughness, level_layout.z));
#ifdef HAS_FITTED
    return swept_light(p, log2_roughness);
#else
    return prefiltered_light(p.R, log2_roughness);
#endif
}

#ifdef HAS_SHARP
// The wider lobe whose tails are those of a sharp one.
float wider_roughness(float roughness) {
#ifdef HAS_FITTED
    return tail_roughness(roughness, level_layout.z);
#else
    return max(roughness, level_layout.z);
#endif
}

// A lobe that is wide as panorama texels sees extracted lights as lights: sampled there they would flicker. A mirror sees
// them in the panorama, as the picture they are.
float analytic_share(float alpha) { return counts.x > 0.0 ? smoothstep(0.0009, 0.0036, alpha) : 0.0; }
#endif

vec3 lobe_light(LobePoint p) {
#ifdef HAS_SHARP
    float alpha = square(p.roughness);
    p.roughness = wider_roughness(p.roughness);
    float alpha1 = square(p.roughness);
    float tails = min(square(alpha / alpha1), 1.0);
#endif
    vec3 light = wide_lobe_light(p);
#ifdef HAS_SHARP
    Core core = Core(p.N, p.V, p.across, p.up, alpha, alpha1, p.f0, (1.0 - analytic_share(alpha)) * light_color(p.R));
#ifndef HAS_FITTED
    core.N = core.V = p.R;
#endif
    light = tails * light + (1.0 - tails) * core_light(core);
#endif
    return light;
}

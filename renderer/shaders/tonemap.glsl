// From scene-linear Rec. 709 radiance to display-linear 0…1 and to sRGB code values; one text for GLSL and C++
// (renderer/tonemap.h).

// Khronos PBR Neutral (2024): base colours up to 0.8 less the 0.04 that Fresnel adds, highlights rolled off and desaturated.
PATINA_FN vec3 tonemap_neutral(vec3 color) {
    const float start_compression = 0.8f - 0.04f;
    const float desaturation = 0.15f;
    float x = min(color.x, min(color.y, color.z));
    float offset = x < 0.08f ? x - 6.25f * x * x : 0.04f;
    color -= vec3(offset);
    float peak = max(color.x, max(color.y, color.z));
    if (peak < start_compression) return color;
    float d = 1.0f - start_compression;
    float new_peak = 1.0f - d * d / (peak + d - start_compression);
    color *= new_peak / peak;
    float g = 1.0f - 1.0f / (desaturation * (peak - new_peak) + 1.0f);
    return mix(color, vec3(new_peak), g);
}

// ACES RRT + ODT, Stephen Hill's fit (BakingLab): to a wide working space, one rational curve, and back.
PATINA_FN vec3 tonemap_aces(vec3 color) {
    vec3 v = vec3(0.59719f * color.x + 0.35458f * color.y + 0.04823f * color.z,
                  0.07600f * color.x + 0.90834f * color.y + 0.01566f * color.z,
                  0.02840f * color.x + 0.13383f * color.y + 0.83777f * color.z);
    // (v² + a v − b) / (c v² + d v + e), divided through by v where v is large, so that nothing overflows.
    vec3 s = max(v, vec3(1.0f));
    vec3 r = v / s;
    vec3 one = vec3(1.0f) / s;
    v = (r * v + 0.0245786f * r - 0.000090537f * one) / (0.983729f * r * v + 0.4329510f * r + 0.238081f * one);
    vec3 c = vec3(1.60475f * v.x - 0.53108f * v.y - 0.07367f * v.z,
                  -0.10208f * v.x + 1.10813f * v.y - 0.00605f * v.z,
                  -0.00327f * v.x - 0.07276f * v.y + 1.07602f * v.z);
    return clamp(c, vec3(0.0f), vec3(1.0f));
}

// IEC 61966-2-1, exact piecewise form.
PATINA_FN float encode_srgb(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f; }
PATINA_FN vec3 encode_srgb(vec3 c) { return vec3(encode_srgb(c.x), encode_srgb(c.y), encode_srgb(c.z)); }
PATINA_FN float decode_srgb(float x) { return x <= 0.04045f ? x / 12.92f : pow((x + 0.055f) / 1.055f, 2.4f); }
PATINA_FN vec3 decode_srgb(vec3 c) { return vec3(decode_srgb(c.x), decode_srgb(c.y), decode_srgb(c.z)); }

// The reflection model, one text for GLSL and C++ (renderer/brdf.h): GGX, height-correlated Smith, Schlick, and the
// weights that turn prefiltered light into reflected light. alpha = roughness². No textures here.

const float kPi = 3.14159265358979f;

PATINA_FN float square(float x) { return x * x; }
PATINA_FN float pow5(float x) { return square(square(x)) * x; }

// F = F0 + (1 − F0)(1 − V·H)⁵ (Schlick 1994).
PATINA_FN vec3 fresnel_schlick(vec3 F0, float VoH) {
    return F0 + (vec3(1.0f) - F0) * pow5(clamp(1.0f - VoH, 0.0f, 1.0f));
}

// The lecture's: there is no half vector under an environment, so N·V stands in and rough surfaces rise less at grazing.
PATINA_FN vec3 fresnel_schlick_roughness(float cos_theta, vec3 F0, float roughness) {
    return F0 + (max(vec3(1.0f - roughness), F0) - F0) * pow5(clamp(1.0f - cos_theta, 0.0f, 1.0f));
}

PATINA_FN vec3 base_reflectance(vec3 albedo, float metallic) { return mix(vec3(0.04f), albedo, metallic); }

// D(h) = α² / (π (cos²θ (α² − 1) + 1)²) with sin²θ = |N × H|² given: 1 − cos² cancels catastrophically for small α, the
// cross product does not.
PATINA_FN float distribution_ggx(float sin2, float alpha2) {
    return alpha2 / (kPi * square(sin2 + alpha2 * (1.0f - sin2)));
}

// G₂ / (4 NoV NoL), height-correlated Smith (Heitz 2014).
PATINA_FN float visibility_smith(float NoV, float NoL, float alpha2) {
    float v = NoL * sqrt(NoV * NoV * (1.0f - alpha2) + alpha2);
    float l = NoV * sqrt(NoL * NoL * (1.0f - alpha2) + alpha2);
    return 0.5f / max(v + l, 1e-8f);
}

// What multiplies the light: Lo = single · P + (multiple + diffuse) · E/π, P prefiltered radiance along R, E irradiance.
struct ReflectionWeights {
    vec3 single;
    vec3 multiple;
    vec3 diffuse;
};

// Split sum with the energy of multiple scattering put back (Fdez-Agüera 2019). ab = (A, B) of the table, so that
// single scattering reflects E_F = F0·A + B of a constant environment and a perfect mirror's microfacets Ess = A + B.
// The 1 − Ess that leaves the first bounce is scattered on, each time losing 1 − Favg; Favg = F0 + (1 − F0)/21 is
// Schlick's cosine-weighted mean. The series Σ Favg^k Ems^k sums to Fms·Ems = E_F·Favg·Ems / (1 − Favg·Ems).
// What neither reflects enters the body: kD = albedo (1 − metallic)(1 − E_F − FmsEms). White stays exactly white.
PATINA_FN ReflectionWeights split_sum_weights(vec3 albedo, float metallic, vec2 ab) {
    vec3 F0 = base_reflectance(albedo, metallic);
    vec3 E_F = F0 * ab.x + vec3(ab.y);
    float Ems = max(1.0f - (ab.x + ab.y), 0.0f);
    vec3 Favg = F0 + (vec3(1.0f) - F0) * (1.0f / 21.0f);
    ReflectionWeights w;
    w.single = E_F;
    w.multiple = E_F * Favg * Ems / (vec3(1.0f) - Favg * Ems);
    w.diffuse = albedo * (1.0f - metallic) * max(vec3(1.0f) - w.single - w.multiple, vec3(0.0f));
    return w;
}

// The lecture's solution to the letter: kS = F of the roughness-aware Fresnel, kD = (1 − kS)(1 − metallic), specular
// F·A + B, where F stands in the place of F0 although B holds the Fresnel term already. The table is the program's own
// (height-correlated Smith), not one made with the lecture's k = alpha/2.
PATINA_FN ReflectionWeights course_weights(vec3 albedo, float metallic, float roughness, float NoV, vec2 ab) {
    vec3 F0 = base_reflectance(albedo, metallic);
    vec3 F = fresnel_schlick_roughness(max(NoV, 0.0f), F0, roughness);
    vec3 kS = F;
    vec3 kD = vec3(1.0f) - kS;
    kD *= 1.0f - metallic;
    ReflectionWeights w;
    w.single = F * ab.x + vec3(ab.y);
    w.multiple = vec3(0.0f);
    w.diffuse = kD * albedo;
    return w;
}

// A punctual light's specular f·NoL, made whole for multiple scattering by 1 + F0 (1/Ess − 1) (Turquin 2019).
// NoL, NoV, VoH > 0; sin2 = |N × H|².
PATINA_FN vec3 light_specular(vec3 F0, vec2 ab, float sin2, vec3 cosines, float alpha2) {
    float NoV = cosines.x;
    float NoL = cosines.y;
    float Ess = max(ab.x + ab.y, 1e-3f);
    vec3 compensation = vec3(1.0f) + F0 * (1.0f / Ess - 1.0f);
    return fresnel_schlick(F0, cosines.z) * compensation *
           (distribution_ggx(sin2, alpha2) * visibility_smith(NoV, NoL, alpha2) * NoL);
}

// Lobes sharper than the sharpest prefiltered level. With a = α/α₁ < 1 the projected lobe splits into
//     D_α = a² D_α₁ + core:   the tails of both fall as α²/θ⁴ and cancel, so the core is compact;
// its mass is 1 − a², it is a mirror's delta at α = 0 and nothing at α = α₁. In t = tan²θ of the half vector
// D_α has the distribution function t/(t + α²); setting that of the core to u and dividing by 1 − a² leaves
//     t² + (α² + α₁²) t − α² α₁² u/(1 − u) = 0,
// whose positive root, written without cancellation, is this. q = u/(1 − u).
PATINA_FN float core_tangent2(float q, float alpha2, float alpha1_2) {
    float s = alpha2 + alpha1_2;
    float p = q * alpha2 * alpha1_2;
    return 2.0f * p / (s + sqrt(s * s + 4.0f * p));
}

// Density per solid angle of the reflected direction (N = V, so dω_l = 4 VoH dω_h and D·NoH/(4 VoH) = D/4) of the core,
// normalised. D(t) = α² (1 + t)² / (π (α² + t)²).
PATINA_FN float core_density(float t, float alpha2, float alpha1_2) {
    float wide = 1.0f / square(alpha1_2 + t);
    float narrow = 1.0f / square(alpha2 + t);
    float mass = 1.0f - alpha2 / alpha1_2;
    return alpha2 * square(1.0f + t) * max(narrow - wide, 0.0f) / (4.0f * kPi * max(mass, 1e-6f));
}

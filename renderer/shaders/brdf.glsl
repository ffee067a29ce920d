// The reflection model, one text for GLSL and C++ (renderer/brdf.h). alpha = roughness². No textures here.
//
// What is computed. With unit vectors N, V, L, H = (V + L)/|V + L| and F0 = mix(0.04, albedo, metallic):
//
//     f · NoL = F(VoH) · D(H) · Vis(NoL, NoV) · NoL  +  [FmsEms(NoV) + kD(NoV)] · NoL / π            (1)
//
//     F   = F0 + (1 − F0)(1 − VoH)⁵                                   Schlick 1994
//     D   = α² / (π (sin²θ_h + α² cos²θ_h)²)                          GGX: Walter et al. 2007, written without cancellation
//     Vis = G₂ / (4 NoL NoV),  G₂ the height-correlated Smith term    Heitz 2014
//
// The first term is one bounce between microfacets. Its albedo is linear in F0: with Fc = (1 − VoH)⁵,
//     A = ∫ (1 − Fc) D Vis NoL dL,   B = ∫ Fc D Vis NoL dL,   E_F = F0·A + B,   Ess = A + B (F0 = 1)   (table of A, B)
// and the light it reflects is E_F · P, P = ∫ F D Vis NoL L(l) dl / E_F, a weighted mean of the environment.
//
// The second is what bounces more than once, spread like a diffuse surface (Fdez-Agüera 2019). Of the energy, Ems = 1 − Ess
// leaves the first bounce; each further one keeps Favg = F0 + (1 − F0)/21, Schlick's cosine-weighted mean, and lets
// Ems go on: Σ Favg^k Ems^k gives FmsEms = E_F · Favg · Ems / (1 − Favg · Ems). What neither part reflects enters the body,
//     kD = albedo (1 − metallic)(1 − E_F − FmsEms),
// so that white reflects exactly 1. Under an environment with irradiance E(N):
//
//     Lo = E_F · P + (FmsEms + kD) · E/π                                                           (2)
//
// P is what the modes differ in. split-sum (Karis 2013): the level of that roughness along R. fitted: below. course: the
// lecture's formulas, its own weights too. A light of direction L and irradiance E is (1) seen through the disc's spread
// (distribution_spread).
//
// Fitted lobes. A prefiltered level of roughness ρ holds the environment under the lobe of N = V. The true lobe of (NoV, r)
// lies elsewhere, towards N, and is longer in the plane of incidence than across it; far from its middle it has tails. So
// consecutive stored levels are read once each, along directions of their own that sweep through that plane. With
// l(ρ) the levels' continuous index, 0, 1, 2, … at the roughness of each (level_index in light.glsl), and o = m − l(ρ) how
// far level m lies from the middle of the sweep,
//     P ≈ (1 − w_E) Σ_m w(o) · level(m) along R + (κ + λ o) α (N − R)  +  w_E · E(N)/π,   Σ w = 1           (3)
//     standard:      w = 1 − |o|                                     two levels, |o| < 1
//     high quality:  w ∝ B₃(o) · 2^(a₁ o + a₂ o²)                    four levels, |o| < 2
// λ draws the lobe out, a₁ and a₂ say where along it the light is. w vanishes where levels enter and leave, so P is
// continuous in ρ; the cubic B-spline B₃ does so with two derivatives, and its mean square Σ w o² is 1/3 wherever l lies
// between two levels, so that the lobe is as long everywhere. Of two levels it is between 0 and 1/4, so their λ is kept
// small. Beyond either end of the list the last level is read along several directions. log₂(ρ/r), κ, λ, a and w_E are read
// from a table over (√NoV, log r), fitted once for F0 = 1 and once for 0.04 on standard levels (renderer/lobes/): at grazing
// angles Schlick's Fc cuts the lobe's steep side away. Between the two they are mixed by φ, the share of the reflected energy
// that Fc carries,
//     φ(f0) = s(f0)/s(0.04),   s(f0) = (1 − f0) B / (f0 · Ess + (1 − f0) B).                        (4)
// The weights sum to 1 and E_F is exact, so constant light is reflected exactly whatever the table holds.
//
// The normal's own spread. Where a pixel covers a range of normals (a normal map's mip level, whose unit vectors average to a
// vector of length R; or curvature) the distribution of half vectors is wider: alpha'² = alpha² + spread (Toksvig 2005).
// As a von Mises-Fisher lobe κ = (3R − R³)/(1 − R²), spread = 1/(2κ).

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

// sin²θ = |N × H|² is given: 1 − cos² cancels catastrophically for small α, the cross product does not.
PATINA_FN float distribution_ggx(float sin2, float alpha2) {
    return alpha2 / (kPi * square(sin2 + alpha2 * (1.0f - sin2)));
}

// G₂ / (4 NoV NoL), height-correlated Smith (Heitz 2014).
PATINA_FN float visibility_smith(float NoV, float NoL, float alpha2) {
    float v = NoL * sqrt(NoV * NoV * (1.0f - alpha2) + alpha2);
    float l = NoV * sqrt(NoL * NoL * (1.0f - alpha2) + alpha2);
    return 0.5f / max(v + l, 1e-8f);
}

// What multiplies the light in (2): Lo = single · P + (multiple + diffuse) · E/π.
struct ReflectionWeights {
    vec3 single;
    vec3 multiple;
    vec3 diffuse;
};

// ab = (A, B).
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

// What is left of GGX where the half vectors of a small light are spread: by its own width, by the normals within the pixel.
// In slopes, t = tan²θ_h, the distribution is α²/π(α² + t)² convolved with a blob of mean-square radius `spread`. A GGX with
// α² + spread in its place has tails α²+spread/πt² where convolving leaves those of α²: a dark surface around the highlight of a
// lamp would be many times too bright. So what has the right tails and the right height is taken,
//     c · GGX(w)  +  (1 − c) · exp(−t/w)/πw,    c = α²/w:   1/πw at t = 0, α²/πt² far out, and 1 in all.
// The height of GGX convolved with exp(−t/s)/πs is [1 − x eˣ E₁(x)]/πs, x = α²/s; w = α² + s + α²s/(α² + s) has that to 6 %
// for all x, and exactly towards both ends.
PATINA_FN float distribution_spread(float sin2, float alpha2, float spread) {
    float cos2 = max(1.0f - sin2, 1e-6f);
    float wide2 = alpha2 + spread + alpha2 * spread / max(alpha2 + spread, 1e-20f);
    float share = alpha2 / wide2;
    float compact = exp(-sin2 / (cos2 * wide2)) / (kPi * wide2 * square(cos2));
    return mix(compact, distribution_ggx(sin2, wide2), share);
}

// The first term of (1) for a small light that spreads the half vectors (distribution_spread) and leaves the shadowing as it is.
// cosines: NoV, NoL, VoH > 0; sin2 = |N × H|²; widths: alpha² and the spread.
PATINA_FN vec3 light_specular(vec3 F0, float sin2, vec3 cosines, vec2 widths) {
    return fresnel_schlick(F0, cosines.z) * (distribution_spread(sin2, widths.x, widths.y) *
                                             visibility_smith(cosines.x, cosines.y, widths.x) * cosines.y);
}

// φ of equation (4), 0…1 from F0 = 1 to 0.04 and darker. Both shares are fractions with the factor B, which is cancelled:
// it vanishes at normal incidence.
PATINA_FN float fresnel_share(float f0, vec2 ab) {
    float Ess = ab.x + ab.y;
    float of_dark = (0.04f * Ess + 0.96f * ab.y) / 0.96f;
    float own = f0 * Ess + (1.0f - f0) * ab.y;
    return clamp((1.0f - f0) * of_dark / max(own, 1e-6f), 0.0f, 1.0f);
}

// One direction stands for all channels of F0.
PATINA_FN float luminance(vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

// Where the table of A and B is read. Its outermost texels lie on the ends of both axes: nothing is extrapolated.
const float kAlbedoTableSize = 384.0f;
PATINA_FN vec2 albedo_coordinates(float NoV, float roughness) {
    return (vec2(sqrt(NoV), roughness) * (kAlbedoTableSize - 1.0f) + 0.5f) / kAlbedoTableSize;
}

// Where the table of fitted lobes is read: √NoV, and the logarithm of roughness from the sharpest fitted one to 1, as
// fractions of its sides.
const float kSharpestFitted = 0.1f;
PATINA_FN vec2 lobe_coordinates(float NoV, float log2_roughness) {
    return vec2(sqrt(clamp(NoV, 0.0f, 1.0f)), clamp(1.0f - log2_roughness / log2(kSharpestFitted), 0.0f, 1.0f));
}

// Direction along which (3) reads a level, not normalised. Precondition: N·R > −1.
PATINA_FN vec3 swept_direction(vec3 R, vec3 N, float kappa, float alpha) { return R + (N - R) * (kappa * alpha); }

// Of the standard levels, which are evenly spaced in the logarithm of roughness: fifteen to a factor of ten.
const float kLevelsPerOctave = 4.5154499f;

// w of (3) for the four levels around l, a fraction `within` beyond the second: o = (−1, 0, 1, 2) − within. lean: a₁, a₂.
PATINA_FN vec4 sweep_weights(float within, vec2 lean) {
    float left = 1.0f - within;
    vec4 spline = vec4(left * left * left, 4.0f - (6.0f - 3.0f * within) * within * within,
                       4.0f - (6.0f - 3.0f * left) * left * left, within * within * within);
    vec4 o = vec4(-1.0f, 0.0f, 1.0f, 2.0f) - within;
    vec4 weights = spline * exp2((o * lean.y + lean.x) * o);
    return weights / dot(weights, vec4(1.0f));
}

// Roughness with spread added to alpha². Untouched without spread.
PATINA_FN float widened_roughness(float roughness, float spread) {
    float alpha = roughness * roughness;
    return spread > 0.0f ? sqrt(sqrt(min(alpha * alpha + spread, 1.0f))) : roughness;
}

// Coloured ambient occlusion: a bright surface lights its own crevices (Jimenez et al. 2016, fit to path-traced scenes).
PATINA_FN vec3 multi_bounce_occlusion(float ao, vec3 albedo) {
    vec3 a = 2.0404f * albedo - vec3(0.3324f);
    vec3 b = vec3(0.6417f) - 4.7951f * albedo;
    vec3 c = 2.7552f * albedo + vec3(0.6903f);
    return max(vec3(ao), min(((a * ao + b) * ao + c) * ao, vec3(1.0f)));
}

// Occlusion of the specular lobe from that of the hemisphere (Lagarde & de Rousiers 2014).
PATINA_FN float specular_occlusion(float NoV, float ao, float alpha) {
    float exponent = exp2(-16.0f * alpha - 1.0f);
    return clamp(pow(NoV + ao, exponent) - 1.0f + ao, 0.0f, 1.0f);
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

// The wider lobe of a fitted one's split: below this multiple of the sharpest level's roughness, where no stored level is
// as narrow as the true lobe across the plane of incidence, the tails are those of a lobe about as far above it. The fit is
// good there, the core holds most of the light, and the two meet where sampling ends.
const float kCoreReach = 1.3f;
PATINA_FN float tail_roughness(float roughness, float sharpest) {
    float reach = kCoreReach * sharpest;
    return min(max(reach + 0.8f * (reach - roughness), roughness), 1.0f);
}

// Density per solid angle of the reflected direction (N = V, so dω_l = 4 VoH dω_h and D·NoH/(4 VoH) = D/4) of the core,
// normalised. D(t) = α² (1 + t)² / (π (α² + t)²).
PATINA_FN float core_density(float t, float alpha2, float alpha1_2) {
    float wide = 1.0f / square(alpha1_2 + t);
    float narrow = 1.0f / square(alpha2 + t);
    float mass = 1.0f - alpha2 / alpha1_2;
    return alpha2 * square(1.0f + t) * max(narrow - wide, 0.0f) / (4.0f * kPi * max(mass, 1e-6f));
}

// Properties of the shared reflection model: brdf.glsl and tonemap.glsl compiled as C++, and the table that
// the build embeds.
#include "app/stability.h"
#include "app/stability_sweeps.h"
#include "renderer/brdf.h"
#include "renderer/ibl/bake.h"
#include "renderer/tonemap.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace patina {

namespace {

using glm::dvec3;
using glm::vec2;
using glm::vec3;

/// Finite and not negative.
bool is_sane(float x) { return std::isfinite(x) && x >= 0.0f; }
bool is_sane(vec3 c) { return is_sane(c.x) && is_sane(c.y) && is_sane(c.z); }

/// 0 … 1 with both ends and what lies just beside them far more often than chance would have it.
float edgy_unit(Random& random) {
    constexpr float edges[] = {0.0f, 1e-45f, 1e-30f, 1e-8f, 1e-4f, 0.0999f, 0.1f, 0.5f, 0.99999994f, 1.0f};
    if (random.chance(0.4)) return edges[random.below(int(std::size(edges)))];
    return float(random.chance(0.5) ? random.uniform() : random.log_between(1e-12, 1.0));
}
vec3 edgy_color(Random& random) { return {edgy_unit(random), edgy_unit(random), edgy_unit(random)}; }

/// What the table may hold: A, B ≥ 0 and A + B, the albedo of white microfacets, from 0.3 (r = 1) to 1.
vec2 any_table_texel(Random& random) {
    const float sum = std::max(edgy_unit(random), 0.3f);
    const float share = edgy_unit(random);
    return {sum * (1.0f - share), sum * share};
}

/// With t = tan²θ = α² u/(1 − u) the integrand's measure is D cos θ dω = du exactly, so the mean of what the
/// code gives over what is exact must be 1: dω = 2π sin θ dθ, D cos θ dω/du = D · π (α² + t)²/(α² (1 + t)²).
Trial ggx_integral(Random& random, Stage&) {
    const double roughness = random.log_between(0.01, 1.0);
    const auto alpha2 = float(roughness * roughness * roughness * roughness);
    constexpr int count = 4096;
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
        const double u = (i + random.uniform()) / count;
        const double t = double(alpha2) * u / (1.0 - u);
        const double D = brdf::distribution_ggx(float(t / (1.0 + t)), alpha2);
        const double whole = (double(alpha2) + t) / (1.0 + t);
        sum += D * std::numbers::pi * whole * whole / double(alpha2);
    }
    Trial trial;
    trial.add(std::abs(sum / count - 1.0));
    return trial;
}

Trial ggx_precision(Random& random, Stage&) {
    Trial trial;
    for (int i = 0; i < 64; ++i)
        trial.add(distribution_error(random.log_between(0.03, 1.0), DistributionForm::Cross, random));
    return trial;
}

/// f = F D V of the two directions swapped.
Trial reciprocity(Random& random, Stage&) {
    Trial trial;
    for (int i = 0; i < 64; ++i) {
        const auto hemisphere = [&] {
            dvec3 d = random.direction();
            d.z = std::max(std::abs(d.z), 1e-4);
            return vec3(glm::normalize(d));
        };
        const vec3 V = hemisphere(), L = hemisphere(), N(0.0f, 0.0f, 1.0f);
        const float alpha2 = float(std::pow(random.log_between(0.01, 1.0), 4.0));
        const vec3 F0(float(random.between(0.02, 1.0)));
        const auto f = [&](vec3 from, vec3 to) {
            const vec3 H = glm::normalize(from + to);
            const vec3 side = glm::cross(N, H);
            return brdf::fresnel_schlick(F0, glm::dot(from, H)).x *
                   brdf::distribution_ggx(glm::dot(side, side), alpha2) *
                   brdf::visibility_smith(from.z, to.z, alpha2);
        };
        const double there = f(V, L), back = f(L, V);
        trial.add(std::abs(there - back) / std::max({there, back, 1e-30}));
    }
    return trial;
}

/// Light from everywhere is sent back whole by white, metal or not, and never more by anything else.
Trial furnace_weights(Random& random, Stage&) {
    Trial trial;
    for (int i = 0; i < 64; ++i) {
        const double NoV = random.chance(0.3) ? random.log_between(1e-4, 1.0) : random.uniform();
        const vec2 ab =
            random.chance(0.5) ? vec2(fetched_albedo(NoV, random.uniform())) : any_table_texel(random);
        const auto reflected = [&](vec3 albedo, float metallic) {
            const auto w = brdf::split_sum_weights(albedo, metallic, ab);
            return w.single + w.multiple + w.diffuse;
        };
        trial.add(std::abs(double(reflected(vec3(1.0f), random.chance(0.5) ? 0.0f : 1.0f).x) - 1.0));
        const vec3 out = reflected(edgy_color(random), edgy_unit(random));
        trial.add(std::max({double(out.x), double(out.y), double(out.z)}) - 1.0);
    }
    return trial;
}

Trial reflection_fuzz(Random& random, Stage&) {
    Trial trial;
    const auto check_weights = [&](const brdf::ReflectionWeights& w) {
        trial.require(is_sane(w.single) && is_sane(w.multiple) && is_sane(w.diffuse));
    };
    for (int i = 0; i < 64; ++i) {
        const vec2 ab = any_table_texel(random);
        const vec3 albedo = edgy_color(random);
        const float metallic = edgy_unit(random), roughness = edgy_unit(random);
        const float NoV = std::max(edgy_unit(random), 1e-4f), NoL = std::max(edgy_unit(random), 1e-30f);
        check_weights(brdf::split_sum_weights(albedo, metallic, ab));
        check_weights(brdf::course_weights(albedo, metallic, roughness, NoV, ab));
        // As the shader calls it: lobes of lights are no sharper than the sharpest level, α ≥ 1e-6².
        const float alpha2 = std::max(brdf::square(brdf::square(roughness)), 1e-12f);
        trial.require(
            is_sane(brdf::light_specular(albedo, edgy_unit(random), vec3(NoV, NoL, edgy_unit(random)),
                                         vec2(alpha2, 0.2f * edgy_unit(random)))));
        const float sharpest2 = 1e-4f;
        const float q = float(random.log_between(1e-3, 1e3));
        const float core_alpha2 = std::clamp(alpha2, 1e-14f, sharpest2);
        const float t = brdf::core_tangent2(q, core_alpha2, sharpest2);
        trial.require(is_sane(t) && is_sane(brdf::core_density(t, core_alpha2, sharpest2)));
    }
    return trial;
}

/// The root that core_tangent2 gives, put back into the distribution function it inverts (in double).
Trial core_inversion(Random& random, Stage&) {
    Trial trial;
    const double wide = 1e-4;
    for (int i = 0; i < 64; ++i) {
        const double narrow = wide * random.log_between(1e-6, 0.98);
        const double u = random.between(0.001, 0.999);
        const double t = brdf::core_tangent2(float(u / (1.0 - u)), float(narrow), float(wide));
        // (F_narrow − a² F_wide)/(1 − a²) with F(t) = t/(t + α²): t² (…) solved for u without cancellation
        // is t (t + narrow + wide) / ((t + narrow)(t + wide)).
        const double back = t * (t + narrow + wide) / ((t + narrow) * (t + wide));
        trial.add(std::abs(back - u));
    }
    return trial;
}

Trial albedo_table(Random& random, Stage&) {
    // Often near the ends, where A and B bend most.
    const auto any = [&](double least) {
        return random.chance(0.5) ? random.uniform() : random.log_between(least, 1.0);
    };
    const double NoV = std::max(random.chance(0.1) ? 1.0 : any(1e-3), 1e-3);
    const double roughness = random.chance(0.1) ? 1.0 : any(1e-3);
    const glm::dvec2 fetched = fetched_albedo(NoV, roughness);
    const glm::dvec2 exact = exact_albedo(NoV, roughness * roughness);
    Trial trial;
    trial.add(std::max(std::abs(fetched.x - exact.x), std::abs(fetched.y - exact.y)));
    return trial;
}

Trial tone_mapping(Random& random, Stage&) {
    Trial trial;
    constexpr float extremes[] = {0.0f, 1e-45f, 1e-30f, 0.08f, 0.76f, 65504.0f, 1e6f, 1e18f, 3e38f};
    const auto any = [&] {
        return random.chance(0.5) ? extremes[random.below(int(std::size(extremes)))]
                                  : float(random.log_between(1e-6, 1e6));
    };
    for (int i = 0; i < 64; ++i) {
        const vec3 color(any(), any(), any());
        for (const vec3 mapped : {glm::clamp(tone::tonemap_neutral(color), 0.0f, 1.0f),
                                  tone::tonemap_aces(color), glm::clamp(color, 0.0f, 1.0f)}) {
            const vec3 code = tone::encode_srgb(mapped);
            trial.require(is_sane(code) && std::max({code.x, code.y, code.z}) <= 1.0f + 1e-6f);
        }
        // Grey grows with its radiance.
        const float dark = any(), bright = std::max(any(), dark);
        for (const auto map : {tone::tonemap_neutral, tone::tonemap_aces})
            trial.require(map(vec3(dark)).y <= map(vec3(bright)).y + 1e-6f);
    }
    return trial;
}

}  // namespace

std::vector<Property> reflection_properties() {
    return {
        {"ggx-integral", "∫ D cos θ dω = 1", 1e-6, 2000, ggx_integral},
        {"ggx-precision", "D in single precision, relative, r ≥ 0.03", 2e-4, 100000, ggx_precision},
        {"reciprocity", "f(V, L) = f(L, V), relative", 1e-5, 50000, reciprocity},
        {"albedo-table", "the table as fetched = ∫ f cos θ dω, NoV ≥ 0.001", 5e-4, 400, albedo_table},
        {"furnace-weights", "white reflects all, nothing more than all", 1e-5, 50000, furnace_weights},
        {"reflection-fuzz", "no NaN, Inf or negative weight", 0.0, 100000, reflection_fuzz},
        {"core-inversion", "a sharp lobe's samples follow its distribution", 1e-4, 20000, core_inversion},
        {"tone-mapping", "0 … 1 and growing for radiance 0 … 3e38", 0.0, 20000, tone_mapping},
    };
}

}  // namespace patina

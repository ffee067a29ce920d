#include "app/stability_sweeps.h"

#include "app/stability_scene.h"
#include "renderer/brdf.h"
#include "renderer/gl/brdf_table.h"
#include "renderer/ibl/legendre.h"
#include "renderer/ibl/reference.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace patina {

using Json = nlohmann::ordered_json;
using glm::dvec2;
using glm::dvec3;
using glm::vec3;

double distribution_error(double roughness, DistributionForm form, Random& random) {
    const double alpha = roughness * roughness;
    const double u = random.between(0.0, 0.999);
    const double tangent = alpha * std::sqrt(u / (1.0 - u));
    const dvec3 n = random.direction();
    dvec3 side = glm::cross(n, random.direction());
    side = side / std::max(glm::length(side), 1e-12);
    const vec3 N = glm::normalize(vec3(n));
    const vec3 H = glm::normalize(vec3(glm::normalize(n + tangent * side)));
    const auto alpha2 = float(alpha * alpha);
    const vec3 cross = glm::cross(N, H);
    const float NoH = glm::dot(N, H);
    const float sin2 = form == DistributionForm::Cross ? glm::dot(cross, cross) : 1.0f - NoH * NoH;
    const double given = brdf::distribution_ggx(std::max(sin2, 0.0f), alpha2);
    const dvec3 exact_cross = glm::cross(dvec3(N), dvec3(H));
    const double exact_sin2 =
        glm::dot(exact_cross, exact_cross) / (glm::dot(dvec3(N), dvec3(N)) * glm::dot(dvec3(H), dvec3(H)));
    const double whole = exact_sin2 + double(alpha2) * (1.0 - exact_sin2);
    const double exact = double(alpha2) / (std::numbers::pi * whole * whole);
    return std::abs(given / exact - 1.0);
}

dvec2 fetched_albedo(double NoV, double roughness) {
    const auto texels = embedded::brdf_table();
    const auto texel = [&](int x, int y) {
        const std::size_t i = 2 * (std::size_t(y) * kShadingTableSize + std::size_t(x));
        return dvec2(texels[i], texels[i + 1]) / 65535.0;
    };
    const glm::vec2 place = brdf::albedo_coordinates(float(NoV), float(roughness));
    const auto texels_in = [](float unit) {
        return std::clamp(double(unit) * kShadingTableSize - 0.5, 0.0, double(kShadingTableSize - 1));
    };
    const double x = texels_in(place.x), y = texels_in(place.y);
    const int x0 = std::min(int(x), kShadingTableSize - 2), y0 = std::min(int(y), kShadingTableSize - 2);
    const double fx = x - x0, fy = y - y0;
    return (1.0 - fy) * ((1.0 - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0)) +
           fy * ((1.0 - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1));
}

/// With h distributed as the visible normals are (Heitz 2018), ∫ f cos θ dω = mean of F G₂/G₁: the disc of
/// projected normals of the stretched hemisphere, in equal areas.
dvec2 exact_albedo(double NoV, double alpha) {
    constexpr int heights = 256, azimuths = 128;
    static const GaussNodes gauss(heights);
    const double sin_v = std::sqrt(std::max(0.0, 1.0 - NoV * NoV)), alpha2 = alpha * alpha;
    const double length = std::sqrt(alpha2 * sin_v * sin_v + NoV * NoV);
    const double vx = alpha * sin_v / length, vz = NoV / length;
    const auto lambda = [&](double c) {
        return 0.5 * (std::sqrt(1.0 + alpha2 * (1.0 - c * c) / (c * c)) - 1.0);
    };
    const double lambda_v = lambda(NoV);
    dvec2 sum(0.0);
    for (int i = 0; i < heights; ++i) {
        const double x = gauss.x[std::size_t(i)];  // squared: more nodes where the lobe's rim is
        const double z = 1.0 - (1.0 + vz) * x * x;
        const double ring = std::sqrt(std::max(0.0, 1.0 - z * z));
        for (int j = 0; j < azimuths; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / azimuths;
            dvec3 H(alpha * (ring * std::cos(phi) + vx), alpha * ring * std::sin(phi), z + vz);
            H /= std::max(glm::length(H), 1e-300);
            const double VoH = H.x * sin_v + H.z * NoV, NoL = 2.0 * VoH * H.z - NoV;
            if (NoL <= 0.0) continue;
            const double g =
                2.0 * x * gauss.weight[std::size_t(i)] * (1.0 + lambda_v) / (1.0 + lambda_v + lambda(NoL));
            const double Fc = std::pow(std::clamp(1.0 - VoH, 0.0, 1.0), 5.0);
            sum += g * dvec2(1.0 - Fc, Fc);
        }
    }
    return sum / double(azimuths);
}

namespace {

Json sweep(const char* name, const char* x, const char* y) {
    return {{"name", name}, {"x", x}, {"y", y}, {"series", Json::array()}};
}
Json series(const std::string& name) { return {{"name", name}, {"points", Json::array()}}; }

Json distribution_sweep(bool quick) {
    Json result = sweep("distribution-roughness", "roughness", "largest relative error of D");
    for (const auto& [form, name] : {std::pair{DistributionForm::Cross, "|N × H|² (the program's)"},
                                     std::pair{DistributionForm::Naive, "1 − (N·H)²"}}) {
        Json line = series(name);
        for (const double r : {0.01, 0.02, 0.03, 0.045, 0.07, 0.1, 0.15, 0.25, 0.4, 0.6, 0.8, 1.0}) {
            Random random(1);
            double worst = 0.0;
            for (int i = 0; i < (quick ? 2000 : 50000); ++i)
                worst = std::max(worst, distribution_error(r, form, random));
            line["points"].push_back({r, worst});
        }
        result["series"].push_back(line);
    }
    return result;
}

/// Largest error of A and B over the other coordinate.
Json table_sweep(bool over_roughness, bool quick) {
    Json result = over_roughness
                      ? sweep("table-roughness", "roughness", "largest error of A and B as fetched")
                      : sweep("table-nov", "NoV", "largest error of A and B as fetched");
    const int across = quick ? 6 : 24, along = quick ? 8 : 40;
    Json line = series(over_roughness ? "over all NoV ≥ 0.001" : "over all roughness");
    for (int i = 0; i < along; ++i) {
        const double fixed = over_roughness ? (i + 0.5) / along : std::pow((i + 0.5) / along, 2.0);
        double worst = 0.0;
        for (int j = 0; j < across; ++j) {
            const double other = (j + 0.37) / across;
            const double NoV = std::max(over_roughness ? other * other : fixed, 1e-3);
            const double roughness = over_roughness ? fixed : other;
            const dvec2 error = fetched_albedo(NoV, roughness) - exact_albedo(NoV, roughness * roughness);
            worst = std::max({worst, std::abs(error.x), std::abs(error.y)});
        }
        line["points"].push_back({fixed, worst});
    }
    result["series"].push_back(line);
    return result;
}

/// A level against quadrature under a sun 1e4 times the mean.
Json prefilter_sweep(bool quick) {
    Json result = sweep("prefilter-roughness", "roughness", "relative error of prefiltered texels");
    Random random(1);
    const Environment environment = sunny_panorama(256, 1e4, random);
    Json rms = series("root mean square"), largest = series("largest");
    BakeSettings settings;
    settings.roughness = {0.1f, 0.15f, 0.2f, 0.3f, 0.45f, 0.6f, 0.8f, 1.0f};
    settings.max_face_size = 64;
    const auto baked = bake_environment(environment, settings, {});
    PrefilterProbe probe;
    probe.texels = quick ? 10 : 60;
    for (const PrefilteredLevel& level : baked->levels) {
        const PrefilterError error = prefilter_error(level.cube, level.roughness, environment, probe);
        rms["points"].push_back({level.roughness, error.rms});
        largest["points"].push_back({level.roughness, error.max});
    }
    result["series"] = {rms, largest};
    return result;
}

constexpr int kFurnaceBins = 20;

struct FurnaceCase {
    Shading shading;
    float metallic;
    int steps;  ///< of roughness
};
/// Errors by roughness become points of line; the largest of each NoV's bin into worst_at.
void add_furnace(Stage& stage, const FurnaceCase& c, Json& line, std::array<double, kFurnaceBins>& worst_at) {
    for (int i = 0; i <= c.steps; ++i) {
        const float roughness = float(i) / float(c.steps);
        double worst = 0.0;
        for (const FurnacePixel& pixel : furnace_pixels(stage, c.shading, roughness, c.metallic)) {
            worst = std::max(worst, pixel.error);
            const auto bin = std::min(std::size_t(pixel.NoV * kFurnaceBins), worst_at.size() - 1);
            worst_at[bin] = std::max(worst_at[bin], pixel.error);
        }
        line["points"].push_back({roughness, worst});
    }
}

/// |out − 1| of a white sphere under light 1 from everywhere, every shading mode that is to keep energy.
void furnace_sweeps(Stage& stage, bool quick, Json& all) {
    Json by_roughness = sweep("furnace-roughness", "roughness", "largest |out − 1| of a white sphere");
    Json by_nov = sweep("furnace-nov", "NoV", "largest |out − 1| of a white sphere");
    for (const auto& mode : kShadings) {
        if (!keeps_energy(mode.value)) continue;
        for (const float metallic : {0.0f, 1.0f}) {
            const std::string name = std::string(mode.id) + (metallic > 0.5f ? ", metal" : ", dielectric");
            Json line = series(name), angles = series(name);
            std::array<double, kFurnaceBins> worst_at{};
            add_furnace(stage, {mode.value, metallic, quick ? 10 : 40}, line, worst_at);
            for (int i = 0; i < kFurnaceBins; ++i)
                angles["points"].push_back({(i + 0.5) / kFurnaceBins, worst_at[i]});
            by_roughness["series"].push_back(line);
            by_nov["series"].push_back(angles);
        }
    }
    all.push_back(by_roughness);
    all.push_back(by_nov);
}

}  // namespace

Json stability_sweeps(Stage& stage, bool quick) {
    Json all = Json::array();
    all.push_back(distribution_sweep(quick));
    all.push_back(table_sweep(true, quick));
    all.push_back(table_sweep(false, quick));
    all.push_back(prefilter_sweep(quick));
    furnace_sweeps(stage, quick, all);
    return all;
}

}  // namespace patina

// `patina bench reference`: how long the reference takes to a clean picture, drawn in steps as the editor
// draws it, and how far its picture is from the truth after so many points.
#include "app/accuracy.h"
#include "app/bench.h"
#include "app/bench_stage.h"
#include "app/jobs.h"
#include "app/paths.h"
#include "renderer/core/format.h"
#include "renderer/core/metrics.h"
#include "renderer/reference.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace patina {

using Json = nlohmann::ordered_json;

namespace {

constexpr int kSidePx = 512;
constexpr int kErrorSidePx =
    96;  ///< errors by samples do not depend on the size; a long reference's time does
constexpr double kClean = 0.01;  ///< 95 of 100 pixels are known to 1 %: no grain is seen

/// How much of it is measured.
struct Extent {
    double patience_seconds = 60.0;
    int truth_samples = 32768;
    int seeds = 4;
    std::vector<int> samples{64, 256, 1024};
};
Extent extent_of(const BenchContext& context) {
    if (!context.quick) return {};
    return {.patience_seconds = 20.0, .truth_samples = 8192, .seeds = 2, .samples = {256}};
}

struct Look {
    const char* name;
    float albedo, metallic, roughness;
};
constexpr std::array kLooks{Look{"metal, 0.1", 1.0f, 1.0f, 0.1f}, Look{"metal, 0.3", 1.0f, 1.0f, 0.3f},
                            Look{"plastic, 0.3", 0.8f, 0.0f, 0.3f}};

Scene scene_of(SceneLoader& loader, const Look& look, const std::string& environment) {
    SceneOptions options;
    options.view.shading = Shading::Reference;
    Scene scene = loader.scene("-", options);
    scene.environment = loader.environment(environment);
    scene.material.albedo.value = glm::vec3(look.albedo);
    scene.material.metallic.value = look.metallic;
    scene.material.roughness.value = look.roughness;
    return scene;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Seconds from the start; negative: not reached.
struct Growth {
    double first = -1.0, at_256 = -1.0, clean = -1.0;
    double longest_turn = 0.0;
    int samples = 0;
    double mean_samples = 0.0;
    double half_width = -1.0;
};

/// Turns as the accuracy meter's. The light's weights are made before, as on its worker.
Growth grow(Renderer& renderer, const Scene& scene, std::shared_ptr<const LightSampler> light,
            double patience_seconds) {
    const TargetHandle target = renderer.make_target(glm::ivec2(kSidePx), 1, TargetPrecision::Full);
    Reference reference(renderer, glm::ivec2(kSidePx), {.tolerance = kClean});
    Growth growth;
    const auto begin = std::chrono::steady_clock::now();
    reference.restart(scene, std::move(light));
    while (!reference.progress().done && seconds_since(begin) < patience_seconds) {
        const double before = seconds_since(begin);
        reference.draw_for(AccuracyMeter::kStepSeconds);
        reference.write(*target);
        renderer.read_pixel(*target, {0, 0});  // waits until it is drawn
        const double now = seconds_since(begin);
        const ReferenceProgress& progress = reference.progress();
        if (growth.first < 0.0) growth.first = now;
        if (growth.at_256 < 0.0 && progress.samples >= 256) growth.at_256 = now;
        if (progress.converged) growth.clean = now;
        growth.longest_turn = std::max(growth.longest_turn, now - before);
    }
    growth.samples = reference.progress().samples;
    growth.mean_samples = reference.progress().mean_samples;
    if (reference.progress().confidence) growth.half_width = reference.progress().confidence->p95;
    return growth;
}

struct Gathered {
    Image radiance, mask;
};
Gathered gathered(Renderer& renderer, const Scene& scene, const ReferenceOptions& options) {
    const glm::ivec2 size(kErrorSidePx);
    const TargetHandle target = renderer.make_target(size, 1, TargetPrecision::Full);
    Reference reference(renderer, size, options);
    reference.restart(scene);
    reference.finish();
    reference.write(*target);
    return {renderer.read_radiance(*target), reference.inner_pixels()};
}

double light_of(const Gathered& picture) {
    double sum = 0.0;
    for (int y = 0; y < picture.mask.height; ++y)
        for (int x = 0; x < picture.mask.width; ++x)
            if (texel(picture.mask, x, y, 0) > 0.5f)
                for (int c = 0; c < 3; ++c) sum += double(texel(picture.radiance, x, y, c));
    return sum;
}

/// Root mean square of the errors of several seeds, and the mean of how much too bright all are together.
struct Miss {
    double rms = 0.0, too_bright = 0.0;
};
Miss miss_of(Renderer& renderer, const Scene& scene, ReferenceOptions options, const Gathered& truth,
             int seeds) {
    Miss miss;
    for (int seed = 1; seed <= seeds; ++seed) {
        options.seed = std::uint64_t(seed);
        const Gathered picture = gathered(renderer, scene, options);
        const double rms = picture_error(picture.radiance, truth.radiance, truth.mask).rms;
        miss.rms += rms * rms / seeds;
        miss.too_bright += (light_of({picture.radiance, truth.mask}) / light_of(truth) - 1.0) / seeds;
    }
    miss.rms = std::sqrt(miss.rms);
    return miss;
}

/// Of pictures of so many samples, and of those that stop where they are clean.
Json errors_of(Renderer& renderer, const Scene& scene, const Extent& extent) {
    // A seed of its own.
    const Gathered truth =
        gathered(renderer, scene, {.max_samples = extent.truth_samples, .tolerance = 0.0, .seed = 1000});
    Json errors = Json::array();
    for (const int samples : extent.samples) {
        const Miss miss =
            miss_of(renderer, scene, {.max_samples = samples, .tolerance = 0.0}, truth, extent.seeds);
        errors.push_back({{"samples", samples}, {"rms", miss.rms}, {"too_bright", miss.too_bright}});
    }
    const Miss miss = miss_of(renderer, scene, {.tolerance = kClean}, truth, extent.seeds);
    errors.push_back({{"samples", "clean"}, {"rms", miss.rms}, {"too_bright", miss.too_bright}});
    return errors;
}

std::string seconds_text(double seconds) { return seconds < 0.0 ? "-" : formatted("%.2f s", seconds); }

}  // namespace

Json bench_reference(const BenchContext& context) {
    BenchStage stage;
    Renderer& renderer = stage.renderer;
    SceneLoader loader = stage.loader(context.registry);
    std::vector<std::string> environments{"studio", "sunset"};
    for (const std::string& each : context.environments)
        if (each.find('.') != std::string::npos) environments.push_back(each);  // those given as files
    const Extent extent = extent_of(context);
    Json json{{"renderer", stage.context.description()},
              {"side_px", kSidePx},
              {"clean", kClean},
              {"cases", Json::array()}};
    std::string counts;
    for (const int samples : extent.samples) counts += std::to_string(samples) + ", ";
    std::printf("%-12s %-14s %9s %9s %9s %12s %10s  rms of %sclean\n", "environment", "material", "first",
                "256", "clean", "samples", "turn", counts.c_str());
    for (const std::string& environment : environments)
        for (const Look& look : kLooks) {
            const Scene scene = scene_of(loader, look, environment);
            const auto light =
                std::make_shared<const LightSampler>(Reference::panorama_of(scene.environment));
            gathered(renderer, scene, {.max_samples = 8});  // compiles
            const Growth growth = grow(renderer, scene, light, extent.patience_seconds);
            const Json errors = errors_of(renderer, scene, extent);
            std::printf("%-12s %-14s %9s %9s %9s %6.0f/%5d %7.0f ms", environment.c_str(), look.name,
                        seconds_text(growth.first).c_str(), seconds_text(growth.at_256).c_str(),
                        seconds_text(growth.clean).c_str(), growth.mean_samples, growth.samples,
                        1e3 * growth.longest_turn);
            for (const Json& each : errors) std::printf(" %7.3f %%", 100.0 * each.at("rms").get<double>());
            std::printf("  bias %+.4f %%\n", 100.0 * errors.back().at("too_bright").get<double>());
            std::fflush(stdout);
            json["cases"].push_back({{"environment", environment},
                                     {"material", look.name},
                                     {"first_s", growth.first},
                                     {"samples_256_s", growth.at_256},
                                     {"clean_s", growth.clean},
                                     {"samples", growth.samples},
                                     {"mean_samples", growth.mean_samples},
                                     {"half_width_p95", growth.half_width},
                                     {"longest_turn_ms", 1e3 * growth.longest_turn},
                                     {"errors", errors}});
        }
    return json;
}

}  // namespace patina

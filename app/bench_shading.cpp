// `patina bench shading`: every shading mode and its rivals against the reference, error over cost.
#include "app/bench.h"
#include "app/bench_stage.h"
#include "app/jobs.h"
#include "app/paths.h"
#include "renderer/core/camera.h"
#include "renderer/core/metrics.h"
#include "renderer/reference.h"

#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace patina {

using Json = nlohmann::ordered_json;

namespace {

struct Way {
    std::string name;
    std::function<void(Renderer&, Scene, RenderTarget&)> draw;
};

std::vector<Way> ways() {
    std::vector<Way> list;
    const auto add_mode = [&](Shading shading, const std::string& name) {
        list.push_back({name, [shading](Renderer& renderer, Scene scene, RenderTarget& target) {
                            scene.view.shading = shading;
                            renderer.draw(scene, target);
                        }});
    };
    const auto add_rival = [&](int samples, const std::string& name) {
        list.push_back({name, [samples](Renderer& renderer, const Scene& scene, RenderTarget& target) {
                            renderer.draw_rival(scene, target, samples);
                        }});
    };
    add_mode(Shading::SplitSum, "split-sum");
    add_mode(Shading::Course, "course");
    add_mode(Shading::Fitted, "fitted");
    list.push_back({"fitted, high quality", [](Renderer& renderer, Scene scene, RenderTarget& target) {
                        scene.view.quality = Quality::High;
                        renderer.draw(scene, target);
                    }});
    add_rival(0, "dominant direction");
    for (const int samples : {8, 16, 32, 64})
        add_rival(samples, "run-time sampling " + std::to_string(samples));
    return list;
}

struct Case {
    std::string environment, mesh, material;
    float roughness = 0.5f;
};

constexpr double kKnownTo = 5e-3;  ///< where the reference stops: 95 of 100 pixels are known to that

struct Extent {
    int side_px = 144;
    int samples = 2048;  ///< of the reference, where it does not stop before
    std::vector<float> roughness{0.05f, 0.08f, 0.12f, 0.2f, 0.3f, 0.45f, 0.65f, 1.0f};
    std::vector<float> concave_roughness{0.12f, 0.3f, 0.65f};
    std::vector<std::string> environments;

    /// On which meshes, at which roughness.
    std::vector<std::pair<std::string, std::vector<float>>> meshes() const {
        return {{"sphere", roughness}, {"shaderball", concave_roughness}};
    }
};

Extent extent_of(const BenchContext& context) {
    Extent extent;
    for (const std::string& id : context.environments)
        if (id != "furnace" && id != "test") extent.environments.push_back(id);
    if (!context.quick) return extent;
    extent.side_px = 96;
    extent.samples = 2048;
    extent.roughness = {0.08f, 0.3f, 0.65f};
    extent.concave_roughness = {};
    if (extent.environments.size() > 3)
        extent.environments.erase(extent.environments.begin() + 1, extent.environments.end() - 2);
    return extent;
}

void set_material(Scene& scene, const Case& each) {
    const bool metal = each.material == "metal";
    scene.material.albedo.value = glm::vec3(metal ? 1.0f : 0.8f);
    scene.material.metallic.value = metal ? 1.0f : 0.0f;
    scene.material.roughness.value = each.roughness;
}

/// The mean and the half-width that tells what of an error may be the reference's own.
struct Truth {
    Image radiance, mask;
    double half_width = 0.0;
    int samples = 0;
};
Truth truth_of(Renderer& renderer, const Scene& scene, const Extent& extent) {
    const TargetHandle target = renderer.make_target(glm::ivec2(extent.side_px), 1, TargetPrecision::Full);
    Reference reference(renderer, glm::ivec2(extent.side_px),
                        {.max_samples = extent.samples, .tolerance = kKnownTo});
    reference.restart(scene);
    reference.finish();
    reference.write(*target);
    return {renderer.read_radiance(*target), reference.inner_pixels(),
            reference.progress().confidence->median, reference.progress().samples};
}

/// Bounds of the bands of N·V that the sphere is judged in.
constexpr std::array kBands{0.0, 0.3, 0.6, 1.0};

/// N·V at the middle of a pixel of the unit sphere as the default camera sees it; negative beside it.
double sphere_nov(int side_px, int x, int y) {
    const Camera camera;
    const double half = std::tan(0.5 * glm::radians(double(camera.fov_deg)));
    const auto screen = [&](int i) { return half * (2.0 * (i + 0.5) / side_px - 1.0); };
    const double tan2 = screen(x) * screen(x) + screen(y) * screen(y);
    // The ray passes the middle at distance · sin of its angle, which is also the sine between N and V.
    const double sine2 = double(camera.distance) * camera.distance * tan2 / (1.0 + tan2);
    return sine2 < 1.0 ? std::sqrt(1.0 - sine2) : -1.0;
}

Image band_of(const Image& mask, double low, double high) {
    Image band = mask;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const double NoV = sphere_nov(mask.width, x, y);
            if (NoV < low || NoV > high) set_texel(band, x, y, 0, 0.0f);
        }
    return band;
}

/// The error of a picture of the sphere in each band.
Json errors_by_nov(const Image& picture, const Truth& truth) {
    Json list = Json::array();
    for (std::size_t i = 0; i + 1 < kBands.size(); ++i)
        list.push_back(
            picture_error(picture, truth.radiance, band_of(truth.mask, kBands[i], kBands[i + 1])).rms);
    return list;
}

/// What is measured with, and what has come of it.
struct Shop {
    Renderer& renderer;
    SceneLoader& loader;
    const std::vector<Way>& ways;
    const Extent& extent;
    std::vector<std::map<std::string, std::vector<double>>> rms;  ///< of each way, by material; the sphere's
    Json cases = Json::array();
};

void measure_case(Shop& shop, const Case& each) {
    SceneOptions options;
    options.mesh = each.mesh;
    options.view.background = Background::Plain;
    Scene scene = shop.loader.scene("-", options);
    scene.environment = shop.loader.environment(each.environment);
    set_material(scene, each);
    const Truth truth = truth_of(shop.renderer, scene, shop.extent);
    const TargetHandle target =
        shop.renderer.make_target(glm::ivec2(shop.extent.side_px), 1, TargetPrecision::Full);
    for (std::size_t i = 0; i < shop.ways.size(); ++i) {
        shop.ways[i].draw(shop.renderer, scene, *target);
        const Image picture = shop.renderer.read_radiance(*target);
        const PictureError error = picture_error(picture, truth.radiance, truth.mask);
        if (each.mesh == "sphere") shop.rms[i][each.material].push_back(error.rms);
        shop.cases.push_back({{"environment", each.environment},
                              {"mesh", each.mesh},
                              {"material", each.material},
                              {"roughness", each.roughness},
                              {"mode", shop.ways[i].name},
                              {"rms", error.rms},
                              {"p95", error.p95},
                              {"max", error.max},
                              {"reference_half_width", truth.half_width},
                              {"reference_samples", truth.samples}});
        if (each.mesh == "sphere") shop.cases.back()["rms_by_NoV"] = errors_by_nov(picture, truth);
    }
}

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double each : values) sum += each;
    return values.empty() ? 0.0 : sum / double(values.size());
}

std::vector<double> frame_ms(const std::vector<Way>& list, SceneLoader& loader, Renderer& renderer,
                             const BenchContext& context) {
    SceneOptions options;
    options.view.background = Background::Plain;
    Scene scene = loader.scene("-", options);
    scene.environment = loader.environment(context.environments.front());
    set_material(scene, {.material = "metal", .roughness = 0.4f});
    const TargetHandle target = renderer.make_target(glm::ivec2(512));
    std::vector<std::function<void()>> actions;
    actions.reserve(list.size());
    for (const Way& way : list)
        actions.push_back([&] {
            way.draw(renderer, scene, *target);
            renderer.read_display(*target);  // waits until it is drawn
        });
    return interleaved_medians_ms(actions, context.repetitions());
}

}  // namespace

Json bench_shading(const BenchContext& context) {
    BenchStage stage;
    Renderer& renderer = stage.renderer;
    SceneLoader loader = stage.loader(context.registry);
    const std::vector<Way> list = ways();
    const Extent extent = extent_of(context);
    Shop shop{.renderer = renderer, .loader = loader, .ways = list, .extent = extent, .rms = {}};
    shop.rms.resize(list.size());
    for (const std::string& environment : extent.environments)
        for (const auto& [mesh, roughnesses] : extent.meshes())
            for (const char* material : {"metal", "dielectric"})
                for (const float roughness : roughnesses)
                    measure_case(shop, {environment, mesh, material, roughness});
    const std::vector<double> ms = frame_ms(list, loader, renderer, context);
    Json json{{"renderer", stage.context.description()},
              {"environments", extent.environments},
              {"roughness_range", "0.05 to 1"},
              {"most_reference_samples", extent.samples},
              {"side_px", extent.side_px},
              {"modes", Json::array()}};
    if (context.quick) json["roughness_range"] = "0.08, 0.3, 0.65";
    std::printf("%-24s %12s %14s %10s\n", "mode", "F0 = 1", "F0 = 0.04", "cost");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const double metal = mean_of(shop.rms[i]["metal"]), dielectric = mean_of(shop.rms[i]["dielectric"]);
        std::printf("%-24s %10.2f %% %12.2f %% %10.2f\n", list[i].name.c_str(), 100.0 * metal,
                    100.0 * dielectric, ms[i] / ms[0]);
        json["modes"].push_back({{"name", list[i].name},
                                 {"ms", ms[i]},
                                 {"cost", ms[i] / ms[0]},
                                 {"rms", {{"metal", metal}, {"dielectric", dielectric}}}});
    }
    json["NoV_bands"] = kBands;
    json["cases"] = std::move(shop.cases);
    return json;
}

}  // namespace patina

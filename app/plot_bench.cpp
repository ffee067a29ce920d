#include "app/plot_bench.h"

#include "app/bench.h"
#include "app/plot_drawing.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace patina {

using Json = nlohmann::ordered_json;

namespace {

/// "sampling 1024" → {"sampling", "1024"}; a name without a number is a family of its own.
std::pair<std::string, std::string> family_and_setting(const std::string& method) {
    const std::size_t space = method.rfind(' ');
    const bool numbered = space != std::string::npos &&
                          method.find_first_not_of("0123456789", space + 1) == std::string::npos &&
                          space + 1 < method.size();
    return numbered ? std::pair{method.substr(0, space), method.substr(space + 1)}
                    : std::pair{method, std::string()};
}

PlotSeries& series_named(Plot& plot, const std::string& name) {
    const auto found = std::ranges::find(plot.series, name, &PlotSeries::name);
    if (found != plot.series.end()) return *found;
    plot.series.push_back({name, {}});
    return plot.series.back();
}

struct Measured {
    std::vector<double> ms;
    std::vector<double> error_percent;
};

/// Every method at one roughness: medians over the environments.
Plot ibl_plot(const Json& result, double roughness) {
    std::vector<std::string> order;
    std::map<std::string, Measured> methods;
    for (const Json& environment : result.at("environments"))
        for (const Json& level : environment.at("levels")) {
            if (level.at("roughness").get<double>() != roughness) continue;
            const std::string method = level.at("method").get<std::string>();
            if (!methods.contains(method)) order.push_back(method);
            methods[method].ms.push_back(level.at("ms").get<double>());
            methods[method].error_percent.push_back(100.0 * level.at("rms").get<double>());
        }
    Plot plot;
    plot.title = "Prefiltering one level, roughness " + plot_number(roughness);
    const std::size_t count = result.at("environments").size();
    plot.subtitle = "Run time against error: medians over " + std::to_string(count) +
                    (count == 1 ? " environment" : " environments");
    plot.x = {"time of the level (ms)", true};
    plot.y = {"relative rms error (%)", true};
    plot.pareto = true;
    for (const std::string& method : order) {
        const auto [family, setting] = family_and_setting(method);
        series_named(plot, family)
            .points.push_back({median(methods[method].ms), median(methods[method].error_percent), setting});
    }
    plot.guides = {{0.1, "0.1 %"}};
    plot.notes = {
        "Error against quadrature over all texels in double precision. A level is baked alone, with all it "
        "needs; first light counts all its levels."};
    if (result.contains("instruction_set"))
        plot.notes.push_back("Instruction set: " + result.at("instruction_set").get<std::string>() + ".");
    return plot;
}

Plot scaling_plot(const Json& rows) {
    Plot plot;
    plot.title = "Baking by size of the panorama";
    plot.subtitle = "All standard levels and the irradiance; first light";
    plot.x = {"megapixels", true};
    plot.y = {"time (ms)", true};
    for (const Json& row : rows) {
        const double megapixels = row.at("width").get<double>() * row.at("height").get<double>() / 1e6;
        const std::string threads = " on " + std::to_string(row.at("threads").get<int>()) +
                                    (row.at("threads").get<int>() == 1 ? " thread" : " threads");
        series_named(plot, "bake" + threads).points.push_back({megapixels, row.at("bake_ms"), ""});
        series_named(plot, "first light" + threads)
            .points.push_back({megapixels, row.at("first_light_ms"), ""});
    }
    return plot;
}

std::vector<NamedPlot> ibl_plots(const Json& result) {
    std::set<double> roughnesses;
    for (const Json& environment : result.at("environments"))
        for (const Json& level : environment.at("levels"))
            roughnesses.insert(level.at("roughness").get<double>());
    std::vector<NamedPlot> plots;
    for (const double roughness : roughnesses) {
        std::string digits = std::to_string(std::lround(100.0 * roughness));
        digits.insert(0, std::size_t(std::max(0, 3 - int(digits.size()))), '0');
        plots.push_back({"ibl-roughness-" + digits, ibl_plot(result, roughness)});
    }
    if (result.contains("scaling")) plots.push_back({"ibl-scaling", scaling_plot(result.at("scaling"))});
    return plots;
}

std::vector<NamedPlot> frame_plots(const Json& result) {
    Plot plot;
    plot.title = "Cost of a frame";
    plot.subtitle = result.value("renderer", "");
    plot.x = {"side of the square picture (pixels)", true};
    plot.y = {"time (ms)", true};
    for (const Json& each : result.at("cases"))
        series_named(plot, each.at("name").get<std::string>())
            .points.push_back({each.at("side_px").get<double>(), each.at("ms").get<double>(), ""});
    return {{"frame", plot}};
}

/// Cost against mean error of one material.
Plot shading_plot(const Json& result, const std::string& material, const std::string& title) {
    Plot plot;
    plot.title = title;
    plot.subtitle =
        "On the sphere: mean over environments and roughness " + result.value("roughness_range", "");
    plot.x = {"cost of a frame (split sum = 1)", true};
    plot.y = {"relative rms error (%)", true};
    plot.pareto = true;
    for (const Json& mode : result.at("modes")) {
        const auto [family, setting] = family_and_setting(mode.at("name").get<std::string>());
        series_named(plot, family)
            .points.push_back(
                {mode.at("cost").get<double>(), 100.0 * mode.at("rms").at(material).get<double>(), setting});
    }
    plot.notes = {
        "Error against the sampled reflectance integral, averaged over each pixel. Frames drawn by " +
        result.value("renderer", "") + "."};
    return plot;
}

std::vector<NamedPlot> shading_plots(const Json& result) {
    return {{"shading-metal", shading_plot(result, "metal", "Shading a metal, F0 = 1")},
            {"shading-dielectric",
             shading_plot(result, "dielectric", "Shading a dielectric, F0 = 0.04, albedo 0.8")}};
}

/// Only where there are sizes to compare.
std::vector<NamedPlot> light_plots(const Json& result) {
    Plot plot;
    plot.title = "Cost of light by size of the panorama";
    plot.subtitle = "One point an environment";
    plot.x = {"megapixels", true};
    plot.y = {"time (ms)", true};
    plot.series = {{"decode", {}}, {"bake and keep", {}}, {"read the kept bake", {}}};
    std::set<double> sizes;
    for (const Json& each : result.at("environments")) {
        const double megapixels = each.at("width").get<double>() * each.at("height").get<double>() / 1e6;
        sizes.insert(megapixels);
        const char* keys[] = {"load_ms", "bake_and_save_ms", "cached_ms"};
        for (std::size_t i = 0; i < plot.series.size(); ++i)
            plot.series[i].points.push_back(
                {megapixels, each.at(keys[i]).get<double>(), each.at("id").get<std::string>()});
    }
    if (sizes.size() < 2) return {};
    for (PlotSeries& series : plot.series) {
        series.line = false;
        std::ranges::stable_sort(series.points, {}, &PlotPoint::x);
    }
    return {{"light", plot}};
}

std::vector<NamedPlot> stability_plots(const Json& result) {
    std::vector<NamedPlot> plots;
    if (!result.contains("sweeps")) return plots;
    for (const Json& sweep : result.at("sweeps")) {
        Plot plot;
        plot.title = sweep.at("y").get<std::string>();
        plot.x = {sweep.at("x").get<std::string>()};
        plot.y = {"error", true};
        for (const Json& each : sweep.at("series")) {
            PlotSeries& series = series_named(plot, each.at("name").get<std::string>());
            for (const Json& point : each.at("points"))
                series.points.push_back({point.at(0).get<double>(), point.at(1).get<double>(), ""});
        }
        plots.push_back({"stability-" + sweep.at("name").get<std::string>(), plot});
    }
    return plots;
}

}  // namespace

std::vector<NamedPlot> bench_plots(std::string_view benchmark, const Json& result) {
    if (benchmark == "ibl") return ibl_plots(result);
    if (benchmark == "frame") return frame_plots(result);
    if (benchmark == "shading") return shading_plots(result);
    if (benchmark == "light") return light_plots(result);
    if (benchmark == "stability") return stability_plots(result);
    return {};
}

}  // namespace patina

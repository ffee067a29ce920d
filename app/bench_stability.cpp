// `patina bench stability`: every property on random cases, and errors against roughness and NoV.
#include "app/bench.h"
#include "app/stability.h"
#include "app/stability_sweeps.h"
#include "renderer/ibl/bench.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace patina {

using Json = nlohmann::ordered_json;

namespace {

std::vector<Property> chosen(const std::vector<std::string>& ids) {
    std::vector<Property> all = stability_properties();
    if (ids.empty()) return all;
    std::vector<Property> some;
    for (const std::string& id : ids) {
        const auto found = std::ranges::find(all, id, &Property::id);
        if (found == all.end()) refuse_name("property", id, all, &Property::id);
        some.push_back(*found);
    }
    return some;
}

Json to_json(const Property& property, const PropertyReport& report) {
    return {{"id", property.id},
            {"statement", property.statement},
            {"cases", report.cases},
            {"trials", report.trials},
            {"failed_trials", report.failed_trials},
            {"worst", std::isfinite(report.worst) ? Json(report.worst) : Json("infinite")},
            {"tolerance", property.tolerance},
            {"worst_seed", report.worst_seed},
            {"cpu_s", report.seconds}};
}

}  // namespace

Json bench_stability(const BenchContext& context) {
    const std::vector<Property> properties = chosen(context.properties);
    double everyday = 0.0;
    for (const Property& property : properties) everyday += double(property.cases);
    const double wanted = context.cases > 0 ? double(context.cases) : everyday * (context.quick ? 0.1 : 1.0);
    Json json{
        {"seed", context.seed}, {"instruction_set", ibl_instruction_set()}, {"properties", Json::array()}};
    std::printf("%-18s %10s %10s %10s %8s %6s  %s\n", "property", "cases", "worst", "tolerance", "seed", "",
                "what must hold");
    Stage stage;
    std::int64_t cases = 0;
    int broken = 0;
    for (const Property& property : properties) {
        const auto share = std::int64_t(std::ceil(double(property.cases) * wanted / everyday));
        const PropertyReport report = check_property(property, share, context.seed, stage);
        cases += report.cases;
        broken += report.failed_trials > 0 ? 1 : 0;
        std::printf("%-18s %10lld %10.2e %10.2e %8llu %6s  %s\n", std::string(property.id).c_str(),
                    static_cast<long long>(report.cases), report.worst, property.tolerance,
                    static_cast<unsigned long long>(report.worst_seed),
                    report.failed_trials > 0 ? "BROKEN" : "holds", std::string(property.statement).c_str());
        std::fflush(stdout);
        json["properties"].push_back(to_json(property, report));
    }
    std::printf("%lld cases, %zu properties, %d broken\n", static_cast<long long>(cases), properties.size(),
                broken);
    json["cases"] = cases;
    if (context.properties.empty()) json["sweeps"] = stability_sweeps(stage, context.quick);
    return json;
}

}  // namespace patina

// The plots that go with a benchmark's result. Knows the shape of each benchmark's JSON, and no file.
#pragma once

#include "app/plot.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace patina {

struct NamedPlot {
    std::string stem;  ///< of its files: "ibl-roughness-030", hundredths
    Plot plot;
};
/// Empty where the benchmark has none, or too little to show.
std::vector<NamedPlot> bench_plots(std::string_view benchmark, const nlohmann::ordered_json& result);

}  // namespace patina

// A benchmark's result as tables for a README. Knows the shape of each benchmark's JSON, and no file.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace patina {

/// Markdown; empty where the benchmark has no table.
std::string bench_markdown(std::string_view benchmark, const nlohmann::ordered_json& result);

}  // namespace patina

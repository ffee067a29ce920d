// The parts of `patina bench skip`. Each row is measured as it is ("skip") and with skipping off ("no_skip"),
// in turn: time, memory, ledger.
#pragma once

#include "app/bench.h"

#include <nlohmann/json_fwd.hpp>

namespace patina {

/// Whole commands, each a process. quick: smaller pictures, once.
nlohmann::ordered_json bench_skip_commands(const BenchContext& context);

/// What an artist does, in one process. Adds "renderer", "steps", "shared_views", "environment_switch" and,
/// where the context has a preset, "maps".
void bench_skip_steps(const BenchContext& context, nlohmann::ordered_json& json);

}  // namespace patina

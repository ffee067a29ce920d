// The program's commands, one function each, in command_*.cpp. Each returns the exit status and throws
// std::runtime_error with one sentence when it fails; what it writes is complete or not there.
#pragma once

#include "app/args.h"
#include "app/registry.h"

namespace patina {

int run_render(const RenderArgs& args, const Registry& registry);
int run_compare(const RenderArgs& args, const Registry& registry);
int run_report(const ReportArgs& args, const Registry& registry);
int run_maps(const MapsArgs& args, const Registry& registry);
int run_bake(const BakeArgs& args, const Registry& registry);
int run_bench(const BenchArgs& args, const Registry& registry);
int run_check(const std::vector<std::string>& presets, const Registry& registry);
int run_list(const std::string& what, const Registry& registry);

}  // namespace patina

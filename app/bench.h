// Benchmarks: named measurements that print a table and give JSON. Figures are medians of interleaved runs in
// one process, so that their ratios hold on a noisy machine.
#pragma once

#include "app/args.h"
#include "app/registry.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

struct BenchContext {
    const Registry& registry;
    std::vector<std::string> environments;  ///< ids or files to measure on
    std::string preset = {}, mesh = {};     ///< of skip: a further scene
    bool quick = false;
    std::int64_t cases = 0;  ///< of stability, over all its properties; 0: its everyday number
    std::uint64_t seed = 1;  ///< of stability's first trial
    std::vector<std::string> properties = {};  ///< of stability; empty: all
    int repetitions() const { return quick ? 3 : 9; }
};

struct Benchmark {
    std::string_view name;
    std::string_view description;
    nlohmann::ordered_json (*run)(const BenchContext& context);
};

double milliseconds(const std::function<void()>& action);
/// The upper one of two middle ones. Precondition: not empty.
double median(std::vector<double> values);
/// Median milliseconds of each action, run in turn (a b c … c b a, …) repetitions times after one warm-up.
std::vector<double> interleaved_medians_ms(const std::vector<std::function<void()>>& actions,
                                           int repetitions);

/// Cost of a frame by shading mode, features and size, on this machine's GL.
nlohmann::ordered_json bench_frame(const BenchContext& context);
/// Shading modes and their rivals: error against the reference, and cost of a frame relative to split sum.
nlohmann::ordered_json bench_shading(const BenchContext& context);
/// The reference: time to a clean picture in steps as the editor takes them, and error by samples.
nlohmann::ordered_json bench_reference(const BenchContext& context);
/// Cost of light: decoding, baking, reading it back from the disk cache.
nlohmann::ordered_json bench_light(const BenchContext& context);
/// The editor's start, cold and warm, against a bare window. Needs a display.
nlohmann::ordered_json bench_start(const BenchContext& context);
/// Pictures, steps of the artist and lights with skipping and without: time, memory, ledger, difference.
nlohmann::ordered_json bench_skip(const BenchContext& context);
/// Prefiltering: run time against error, method by method.
nlohmann::ordered_json bench_ibl(const BenchContext& context);
/// Properties on random cases: the worst of each against its tolerance.
nlohmann::ordered_json bench_stability(const BenchContext& context);

/// Throws std::runtime_error: there is no such row; and those that there are.
template <class Rows, class NameOf>
[[noreturn]] void refuse_name(const char* kind, const std::string& name, const Rows& rows, NameOf name_of) {
    std::string sentence = std::string("there is no ") + kind + " '" + name + "'; there are:";
    for (const auto& row : rows) sentence.append(" ").append(std::invoke(name_of, row));
    throw std::runtime_error(sentence);
}

}  // namespace patina

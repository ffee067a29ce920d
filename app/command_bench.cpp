// patina bench: runs benchmarks by name; tables on standard output, one JSON file each.
#include "app/bench.h"
#include "app/bench_markdown.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/plot_bench.h"
#include "app/plot_io.h"
#include "materials/text_io.h"
#include "renderer/core/file_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <span>
#include <stdexcept>

namespace patina {

namespace {

constexpr std::array kBenchmarks{
    Benchmark{"light", "decoding, baking and reading back environments", bench_light},
    Benchmark{"ibl", "prefiltering: run time against error, method by method", bench_ibl},
    Benchmark{"shading", "shading modes: error against the integral, and cost", bench_shading},
    Benchmark{"reference", "the reference: time to a clean picture, and error by samples", bench_reference},
    Benchmark{"frame", "one frame by shading mode, features and size", bench_frame},
    Benchmark{"stability", "properties on random cases, and errors against roughness and NoV",
              bench_stability},
    Benchmark{"skip", "what is saved by computing only what a picture needs", bench_skip},
    Benchmark{"start", "the editor's start against a bare window", bench_start},
};

std::vector<const Benchmark*> chosen(const std::vector<std::string>& names) {
    std::vector<const Benchmark*> benchmarks;
    for (const Benchmark& each : kBenchmarks)
        if (names.empty() || std::ranges::find(names, each.name) != names.end()) benchmarks.push_back(&each);
    for (const std::string& name : names) {
        if (std::ranges::find(kBenchmarks, name, &Benchmark::name) == kBenchmarks.end())
            refuse_name("benchmark", name, kBenchmarks, &Benchmark::name);
    }
    return benchmarks;
}

}  // namespace

int run_bench(const BenchArgs& args, const Registry& registry) {
    BenchContext context{.registry = registry,
                         .environments = {},
                         .preset = args.preset,
                         .mesh = args.mesh,
                         .quick = args.quick,
                         .cases = args.cases,
                         .seed = args.seed,
                         .properties = args.properties};
    for (const EnvironmentItem& item : registry.environments.front().list())
        context.environments.push_back(item.id);
    context.environments.insert(context.environments.end(), args.environments.begin(),
                                args.environments.end());
    const std::filesystem::path folder = utf8_to_path(args.output.empty() ? "bench-results" : args.output);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error(path_to_utf8(folder) + ": cannot be created (" + error.message() + ")");
    for (const Benchmark* benchmark : chosen(args.names)) {
        say(std::string(benchmark->name) + ": " + std::string(benchmark->description));
        const nlohmann::ordered_json result = benchmark->run(context);
        const std::string text = result.dump(2) + "\n";
        const std::filesystem::path file = folder / (std::string(benchmark->name) + ".json");
        write_file(file, std::as_bytes(std::span(text)));
        say("wrote " + path_to_utf8(file));
        const std::string table = bench_markdown(benchmark->name, result);
        if (!table.empty()) {
            const std::filesystem::path page = folder / (std::string(benchmark->name) + ".md");
            write_file(page, std::as_bytes(std::span(table)));
            say("wrote " + path_to_utf8(page));
        }
        for (const NamedPlot& each : bench_plots(benchmark->name, result))
            for (const std::filesystem::path& picture : save_plot(folder / each.stem, each.plot))
                say("wrote " + path_to_utf8(picture));
    }
    return 0;
}

}  // namespace patina

// `patina bench start`: the editor's start, cold and warm, against a bare window of the same size.
#include "app/bench.h"
#include "app/bench_process.h"
#include "app/temporary_folder.h"
#include "materials/text_io.h"
#include "renderer/core/file_io.h"
#include "renderer/core/module_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace patina {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int kWidth = 1440, kHeight = 900;

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// One start of a program: from before the process to its first frame with a picture.
struct Start {
    double wall_ms = 0.0, cpu_ms = 0.0, peak_memory_mib = 0.0;
};
struct StartCase {
    std::string name;
    std::string command;
    bool cold = false;  ///< caches, the driver's too, are emptied before
    std::vector<Start> starts;
};

Start start_once(const StartCase& each, const fs::path& folder) {
    const fs::path result = folder / "start.json";
    std::error_code ignored;
    fs::remove(result, ignored);
    if (each.cold) fs::remove_all(folder / "cache", ignored);
    const double before_s = now_s();
    if (std::system(each.command.c_str()) != 0)
        throw std::runtime_error("bench start: " + each.name + " could not be started; it needs a display");
    const std::vector<std::byte> bytes = read_file(result);
    const Json json = Json::parse(reinterpret_cast<const char*>(bytes.data()),
                                  reinterpret_cast<const char*>(bytes.data() + bytes.size()));
    const Json& mark = json.at("first_lit_frame");
    return {.wall_ms = 1e3 * (mark.at("at_s").get<double>() - before_s),
            .cpu_ms = 1e3 * mark.at("cpu_s").get<double>(),
            .peak_memory_mib = mark.at("peak_memory_bytes").get<double>() / 1048576.0};
}

double median_of(const std::vector<Start>& starts, double Start::*member) {
    std::vector<double> values;
    values.reserve(starts.size());
    for (const Start& each : starts) values.push_back(each.*member);
    std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
    return values[values.size() / 2];
}

std::vector<StartCase> start_cases(const fs::path& folder) {
    const fs::path script = folder / "start.drive";
    const std::string text = "wait until views>0\nwait 2 frames\nquit\n";
    write_file(script, std::as_bytes(std::span(text)));
    const std::string size = std::to_string(kWidth) + "x" + std::to_string(kHeight);
    const fs::path programs = program_folder();
    const std::string result = quoted(folder / "start.json");
    const std::string bare = quoted(programs / "patina_bare_window") + " " + std::to_string(kWidth) + " " +
                             std::to_string(kHeight) + " " + result;
    const auto editor = [&](const std::string& preset) {
        return quoted(programs / "patina") + " edit " + preset + " --window " + size + " --stats " + result +
               " --drive " + quoted(script);
    };
    return {{.name = "bare window, cold", .command = bare, .cold = true},
            {.name = "bare window, warm", .command = bare},
            {.name = "editor, cold", .command = editor(""), .cold = true},
            {.name = "editor, warm", .command = editor("")},
            {.name = "editor with worn-paint, warm", .command = editor("worn-paint")}};
}

}  // namespace

Json bench_start(const BenchContext& context) {
    const TemporaryFolder folder("patina-bench");
    set_variable("PATINA_CACHE_DIR", path_to_utf8(folder.path() / "cache" / "patina"));
    set_variable("PATINA_STATE_DIR", path_to_utf8(folder.path() / "state"));
    set_variable("MESA_SHADER_CACHE_DIR", path_to_utf8(folder.path() / "cache" / "mesa"));
    std::vector<StartCase> cases = start_cases(folder.path());
    for (int repetition = 0; repetition < context.repetitions(); ++repetition)
        for (StartCase& each : cases) each.starts.push_back(start_once(each, folder.path()));
    Json json{{"window_px", {kWidth, kHeight}}, {"cases", Json::array()}};
    std::printf("%-32s %10s %10s %10s\n", "first frame with a picture", "wall ms", "CPU ms", "peak MiB");
    for (const StartCase& each : cases) {
        const double wall = median_of(each.starts, &Start::wall_ms);
        const double cpu = median_of(each.starts, &Start::cpu_ms);
        const double memory = median_of(each.starts, &Start::peak_memory_mib);
        std::printf("%-32s %10.0f %10.0f %10.0f\n", each.name.c_str(), wall, cpu, memory);
        json["cases"].push_back(
            {{"name", each.name}, {"wall_ms", wall}, {"cpu_ms", cpu}, {"peak_memory_mib", memory}});
    }
    return json;
}

}  // namespace patina

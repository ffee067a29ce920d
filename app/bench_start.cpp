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
    double frames_before = 0.0;  ///< shown without the picture
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
    fs::create_directories(folder / "cache" / "mesa", ignored);
    const double before_s = now_s();
    if (std::system(each.command.c_str()) != 0)
        throw std::runtime_error("bench start: " + each.name + " could not be started; it needs a display");
    const std::vector<std::byte> bytes = read_file(result);
    const Json json = Json::parse(reinterpret_cast<const char*>(bytes.data()),
                                  reinterpret_cast<const char*>(bytes.data() + bytes.size()));
    const Json& mark = json.at("first_lit_frame");
    return {.wall_ms = 1e3 * (mark.at("at_s").get<double>() - before_s),
            .cpu_ms = 1e3 * mark.at("cpu_s").get<double>(),
            .peak_memory_mib = mark.at("peak_memory_bytes").get<double>() / 1048576.0,
            .frames_before = mark.value("frames_before", 0.0)};
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

/// Cold starts empty the caches of the warm ones: they come first, and each warm one has an untimed start.
void start_all(std::vector<StartCase>& cases, const fs::path& folder, int repetitions) {
    for (const bool cold : {true, false})
        for (int repetition = cold ? 0 : -1; repetition < repetitions; ++repetition)
            for (StartCase& each : cases) {
                if (each.cold != cold) continue;
                const Start start = start_once(each, folder);
                if (repetition >= 0) each.starts.push_back(start);
            }
}

// --- with nothing to do ---

struct IdleCase {
    std::string name;
    std::string arguments;
    std::string before;  ///< lines of a drive script
};
constexpr double kIdleSeconds = 30.0;

std::vector<IdleCase> idle_cases() {
    const std::string reference =
        "click toolbar.shading\nclick toolbar.shading.reference\nwait until views>3\n";
    return {{"a picture", " --window 1440x900", ""},
            {"a converged reference", " - --env furnace --window 420x300", reference}};
}

/// What the driven editor printed: "frames=0" and so on, a line each.
double printed(const std::string& text, const std::string& key) {
    const std::size_t at = text.find(key + "=");
    if (at == std::string::npos) throw std::runtime_error("bench start: the idle editor told no " + key);
    return std::strtod(text.c_str() + at + key.size() + 1, nullptr);
}

Json idle_once(const IdleCase& each, const fs::path& folder) {
    const fs::path script = folder / "idle.drive", said = folder / "said.txt";
    const std::string text = "wait idle\n" + each.before + "wait idle\nmark\nwait " +
                             std::to_string(int(kIdleSeconds)) +
                             " seconds\nprint frames\nprint views\nprint cpu_ms\n";
    write_file(script, std::as_bytes(std::span(text)));
    const std::string command = quoted(program_folder() / "patina") + " edit" + each.arguments + " --drive " +
                                quoted(script) + " > " + quoted(said);
    if (std::system(command.c_str()) != 0)
        throw std::runtime_error("bench start: the editor could not be left idle; it needs a display");
    const std::vector<std::byte> bytes = read_file(said);
    const std::string words(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const double percent = 0.1 * printed(words, "cpu_ms") / kIdleSeconds;
    std::printf("%-32s %10.0f %10.0f %9.2f%%\n", each.name.c_str(), printed(words, "frames"),
                printed(words, "views"), percent);
    return {{"name", each.name},
            {"frames", printed(words, "frames")},
            {"views", printed(words, "views")},
            {"core_percent", percent}};
}

}  // namespace

Json bench_start(const BenchContext& context) {
    const TemporaryFolder folder("patina-bench");
    set_variable("PATINA_CACHE_DIR", path_to_utf8(folder.path() / "cache" / "patina"));
    set_variable("PATINA_STATE_DIR", path_to_utf8(folder.path() / "state"));
    set_variable("MESA_SHADER_CACHE_DIR", path_to_utf8(folder.path() / "cache" / "mesa"));
    std::vector<StartCase> cases = start_cases(folder.path());
    start_all(cases, folder.path(), context.repetitions());
    Json json{{"window_px", {kWidth, kHeight}}, {"cases", Json::array()}};
    std::printf("%-32s %10s %10s %10s %14s\n", "first frame with a picture", "wall ms", "CPU ms", "peak MiB",
                "frames before");
    for (const StartCase& each : cases) {
        const double wall = median_of(each.starts, &Start::wall_ms);
        const double cpu = median_of(each.starts, &Start::cpu_ms);
        const double memory = median_of(each.starts, &Start::peak_memory_mib);
        const double before = median_of(each.starts, &Start::frames_before);
        std::printf("%-32s %10.0f %10.0f %10.0f %14.0f\n", each.name.c_str(), wall, cpu, memory, before);
        json["cases"].push_back({{"name", each.name},
                                 {"wall_ms", wall},
                                 {"cpu_ms", cpu},
                                 {"peak_memory_mib", memory},
                                 {"frames_before", before}});
    }
    json["idle_s"] = kIdleSeconds;
    json["idle"] = Json::array();
    std::printf("\n%-32s %10s %10s %10s\n", "idle for 30 s", "frames", "pictures", "of a core");
    for (const IdleCase& each : idle_cases()) json["idle"].push_back(idle_once(each, folder.path()));
    return json;
}

}  // namespace patina

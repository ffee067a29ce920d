// `patina bench skip`: what is saved by computing only what a picture needs. Every scenario is run as it is
// and with skipping off, in turn; here whole commands, whose pictures are compared.
#include "app/bench_skip.h"

#include "app/bench.h"
#include "app/bench_process.h"
#include "app/paths.h"
#include "app/temporary_folder.h"
#include "materials/text_io.h"
#include "renderer/core/file_io.h"
#include "renderer/core/image_io.h"
#include "renderer/core/module_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int kSidePx = 512;

struct CommandCase {
    std::string name;
    std::string arguments;
    int side_px = kSidePx;
};

std::vector<CommandCase> command_cases(const BenchContext& context) {
    const std::string render = "render ";
    const std::string compare = "compare ";
    const std::string views = " --env ";
    // Alone, a picture's programs take longer than its pixels anyway.
    const int alone_px = context.quick ? kSidePx / 2 : kSidePx;
    std::vector<CommandCase> cases{
        {"uniform plastic", render + "plastic-glossy-red --env sky", alone_px},
        {"full metal", render + "gold --env sky", alone_px},
        {"textured, no normal map", render + "terrazzo --env sky", alone_px},
        {"everything on", render + "cooling-lava --env sky --mesh shaderball", alone_px},
        {"1 view", compare + "worn-paint" + views + "studio", alone_px},
        {"2 views", compare + "worn-paint" + views + "studio sky", alone_px},
        {"4 views", compare + "worn-paint" + views + "studio sky sunset night"},
        {"9 views", compare + "worn-paint gold porcelain" + views + "studio sky sunset"},
        {"14 views", compare + "worn-paint gold" + views + "studio sky sunset overcast night furnace test"}};
    if (context.preset.empty()) return cases;
    const std::string mesh = context.mesh.empty() ? "" : " --mesh " + quoted(utf8_to_path(context.mesh));
    cases.push_back({path_to_utf8(utf8_to_path(context.preset).filename()),
                     render + quoted(utf8_to_path(context.preset)) + " --env studio" + mesh});
    cases.push_back({"the same without maps", render + "- --env studio" + mesh});
    return cases;
}

struct CommandRun {
    double wall_ms = 0.0, cpu_ms = 0.0, peak_mib = 0.0;
    std::string work;  ///< the ledger, as JSON
};

CommandRun run_once(const CommandCase& each, bool skip, const fs::path& folder) {
    std::error_code ignored;
    fs::remove_all(folder / "cache", ignored);
    const fs::path stats = folder / "stats.json";
    const fs::path picture = folder / (skip ? "skip.png" : "all.png");
    const std::string command = quoted(program_folder() / "patina") + " " + each.arguments + " --size " +
                                std::to_string(each.side_px) + "x" + std::to_string(each.side_px) + " -o " +
                                quoted(picture) + " --stats " + quoted(stats) + (skip ? "" : " --no-skip") +
                                " 2> " + quoted(folder / "said.txt");
    CommandRun run;
    int status = 0;
    run.wall_ms = milliseconds([&] { status = std::system(command.c_str()); });
    if (status != 0) throw std::runtime_error("bench skip: " + each.name + " failed: " + command);
    const std::vector<std::byte> bytes = read_file(stats);
    const Json json = Json::parse(reinterpret_cast<const char*>(bytes.data()),
                                  reinterpret_cast<const char*>(bytes.data() + bytes.size()));
    run.cpu_ms = 1e3 * json.at("cpu_s").get<double>();
    run.peak_mib = json.at("peak_memory_bytes").get<double>() / 1048576.0;
    run.work = json.at("work").dump();
    return run;
}

struct PictureDifference {
    int largest = 0;  ///< of 8-bit codes
    int pixels = 0;   ///< that are not the same
};

PictureDifference difference(const fs::path& one, const fs::path& other) {
    const Image a = load_image(one).image;
    const Image b = load_image(other).image;
    if (a.bytes.size() != b.bytes.size()) return {255, a.width * a.height};
    PictureDifference found;
    const std::size_t channels = std::size_t(a.channels);
    for (std::size_t at = 0; at < a.bytes.size(); at += channels) {
        int largest = 0;
        for (std::size_t i = at; i < at + channels; ++i)
            largest = std::max(largest, std::abs(int(a.bytes[i]) - int(b.bytes[i])));
        found.largest = std::max(found.largest, largest);
        found.pixels += largest > 0 ? 1 : 0;
    }
    return found;
}

Json summary(const std::vector<CommandRun>& runs) {
    std::vector<double> wall, cpu, peak;
    for (const CommandRun& run : runs) {
        wall.push_back(run.wall_ms);
        cpu.push_back(run.cpu_ms);
        peak.push_back(run.peak_mib);
    }
    return {{"wall_ms", median(wall)},
            {"cpu_ms", median(cpu)},
            {"peak_mib", median(peak)},
            {"work", Json::parse(runs.front().work)}};
}

}  // namespace

Json bench_skip_commands(const BenchContext& context) {
    const int repetitions = context.quick ? 1 : 3;
    const TemporaryFolder folder("patina-skip");
    const char* shared_cache = std::getenv("XDG_CACHE_HOME");  // where the driver keeps compiled shaders, too
    const std::string before = shared_cache ? shared_cache : "";
    set_variable("XDG_CACHE_HOME", path_to_utf8(folder.path() / "cache"));
    set_variable("PATINA_CACHE_DIR", path_to_utf8(folder.path() / "cache" / "patina"));
    Json rows = Json::array();
    std::printf("%-28s %9s %9s %6s  %9s %9s %6s  %s\n", "picture, whole command", "CPU ms", "no skip",
                "ratio", "peak MiB", "no skip", "ratio", "pixels that differ, most");
    for (const CommandCase& each : command_cases(context)) {
        std::array<std::vector<CommandRun>, 2> runs;
        for (int i = 0; i < repetitions; ++i)
            for (const int which : {i % 2, 1 - i % 2})
                runs[std::size_t(which)].push_back(run_once(each, which == 0, folder.path()));
        const PictureDifference other = difference(folder.path() / "skip.png", folder.path() / "all.png");
        Json row{{"name", each.name},
                 {"side_px", each.side_px},
                 {"skip", summary(runs[0])},
                 {"no_skip", summary(runs[1])},
                 {"largest_code_step", other.largest},
                 {"different_pixels", other.pixels}};
        const auto value = [&](const char* side, const char* key) { return row[side][key].get<double>(); };
        std::printf("%-28s %9.0f %9.0f %6.2f  %9.0f %9.0f %6.2f  %d, %d\n", each.name.c_str(),
                    value("skip", "cpu_ms"), value("no_skip", "cpu_ms"),
                    value("skip", "cpu_ms") / value("no_skip", "cpu_ms"), value("skip", "peak_mib"),
                    value("no_skip", "peak_mib"), value("skip", "peak_mib") / value("no_skip", "peak_mib"),
                    other.pixels, other.largest);
        rows.push_back(std::move(row));
    }
    if (shared_cache)
        set_variable("XDG_CACHE_HOME", before);
    else
        remove_variable("XDG_CACHE_HOME");
    return rows;
}

Json bench_skip(const BenchContext& context) {
    Json json{{"renderer", ""}, {"commands", bench_skip_commands(context)}};
    bench_skip_steps(context, json);
    return json;
}

}  // namespace patina

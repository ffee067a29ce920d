// patina_fit_lobes: writes the table of fitted lobes (fitted_lobes.inc) on standard output.
//     patina_fit_lobes > renderer/lobes/fitted_lobes.inc
//     patina_fit_lobes --judge FILE...      how far the built-in table is from the integral in these
//     panoramas
// Fitted on: fit_environments.h, and the built-in studio, night and overcast. Never fitted on: the built-in
// sky, sunset and test, and every file. Deterministic; the last digits depend on the machine's rounding, the
// error does not.
#include "renderer/core/environment_io.h"
#include "renderer/lobes/fit_environments.h"
#include "renderer/lobes/fit_judge.h"
#include "renderer/lobes/fit_solve.h"

#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace patina;
using namespace patina::lobes;

Environment built_in(std::string_view id) {
    for (const BuiltinEnvironment& environment : builtin_environments())
        if (environment.id == id) return environment.make(kBuiltinEnvironmentWidth);
    throw std::runtime_error("no built-in environment " + std::string(id));
}

std::vector<Environment> fit_set() {
    std::vector<Environment> set;
    set.reserve(kFitEnvironments + 3);
    for (int kind = 0; kind < kFitEnvironments; ++kind) set.push_back(make_fit_environment(kind, 1024));
    for (const char* id : {"studio", "night", "overcast"}) set.push_back(built_in(id));
    return set;
}

void report(const char* what, int step, int of, double error) {
    std::fprintf(stderr, "%s %d/%d  rms %.2f %%\n", what, step, of, 100.0 * error);
}

void write_table(const std::vector<LobePair>& nodes) {
    const auto put = [](const LobeSweep& s) {
        std::printf("{%.4ff, %.4ff, %.4ff, %.4ff, {%.4ff, %.4ff}}", s.log2_ratio, s.kappa, s.slope,
                    s.irradiance, s.lean.x, s.lean.y);
    };
    for (const LobePair& pair : nodes) {
        std::printf("{{{");
        for (int half = 0; half < 2; ++half) {
            std::printf(half ? ", {" : "{");
            put(pair.by_reflectance[half].two);
            std::printf(", ");
            put(pair.by_reflectance[half].four);
            std::printf("}");
        }
        std::printf("}}},\n");
    }
}

void judge_files(int count, char** files) {
    std::vector<Environment> set;
    set.reserve(kFitEnvironments + 3);
    for (const char* id : {"sky", "sunset", "test"}) set.push_back(built_in(id));
    for (int i = 0; i < count && int(set.size()) < kLanes; ++i)
        set.push_back(load_environment_file(files[i]));
    const FitLight light = make_fit_light(set, 512);
    const std::vector<Judgement> rows = judge(light, lobe_nodes(), {});
    for (const float f0 : {1.0f, 0.04f}) {
        std::printf(
            "F0 = %g: relative rms %%, roughness | split-sum, two levels, four levels | these of each\n", f0);
        double mean[kMethods] = {};
        int n = 0;
        for (const Judgement& row : rows) {
            if (row.reflectance != f0) continue;
            std::printf("%5.2f |", row.roughness);
            for (int m = 0; m < kMethods; ++m) {
                std::printf(" %6.2f", 100.0 * row.rms[m]);
                mean[m] += 100.0 * row.rms[m];
            }
            std::printf(" |");
            for (int e = 0; e < light.count; ++e)
                std::printf(" %.0f/%.1f/%.1f", 100.0 * row.rms_of[0][e], 100.0 * row.rms_of[1][e],
                            100.0 * row.rms_of[2][e]);
            std::printf("\n");
            ++n;
        }
        std::printf(" mean | %6.2f %6.2f %6.2f\n", mean[0] / n, mean[1] / n, mean[2] / n);
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc > 1 && std::strcmp(argv[1], "--judge") == 0) {
            judge_files(argc - 2, argv + 2);
            return 0;
        }
        if (argc > 1) {
            std::fprintf(stderr, "usage: patina_fit_lobes [--judge FILE...]\n");
            return 2;
        }
        FitSettings settings;
        settings.progress = report;
        write_table(fit_lobes(make_fit_light(fit_set(), 512), settings));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "patina_fit_lobes: %s\n", error.what());
        return 1;
    }
    return 0;
}

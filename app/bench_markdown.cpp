#include "app/bench_markdown.h"

#include "app/bench.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <set>
#include <vector>

namespace patina {

using Json = nlohmann::ordered_json;

namespace {

std::string number(double value, int digits) {
    char text[64];
    std::snprintf(text, sizeof(text), "%.*f", digits, value);
    return text;
}

/// In the order they come.
void add_once(std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

/// Median time and worst rms error of a method at a roughness over the environments: "1.2 ms, 0.02 %".
std::string cell(const Json& result, const std::string& method, double roughness) {
    std::vector<double> ms;
    double worst = 0.0;
    for (const Json& environment : result.at("environments"))
        for (const Json& level : environment.at("levels"))
            if (level.at("method") == method && level.at("roughness").get<double>() == roughness) {
                ms.push_back(level.at("ms").get<double>());
                worst = std::max(worst, level.at("rms").get<double>());
            }
    if (ms.empty()) return "";
    return number(median(ms), 1) + " ms, " + number(100.0 * worst, 3) + " %";
}

std::string methods_table(const Json& result) {
    std::vector<std::string> methods;
    std::vector<double> roughness;
    for (const Json& environment : result.at("environments"))
        for (const Json& level : environment.at("levels")) {
            add_once(methods, level.at("method").get<std::string>());
            const double r = level.at("roughness").get<double>();
            if (std::ranges::find(roughness, r) == roughness.end()) roughness.push_back(r);
        }
    std::ranges::sort(roughness);
    std::string text =
        "One level alone: median time, worst relative rms error over the environments.\n\n| method |";
    std::string rule = "|---|";
    for (const double r : roughness) {
        text += " r " + number(r, 2) + " |";
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (const std::string& method : methods) {
        text += "| " + method + " |";
        for (const double r : roughness) text += " " + cell(result, method, r) + " |";
        text += "\n";
    }
    return text;
}

std::string scaling_table(const Json& result) {
    std::string text =
        "\nAll standard levels and the irradiance.\n\n| panorama | threads | bake | first light | memory |\n"
        "|---|---|---|---|---|\n";
    for (const Json& row : result.at("scaling"))
        text += "| " + std::to_string(row.at("width").get<int>()) + "×" +
                std::to_string(row.at("height").get<int>()) + " | " +
                std::to_string(row.at("threads").get<int>()) + " | " +
                number(row.at("bake_ms").get<double>(), 1) + " ms | " +
                number(row.at("first_light_ms").get<double>(), 1) + " ms | " +
                number(row.at("peak_growth_mib").get<double>(), 0) + " MiB |\n";
    return text;
}

std::string fetch_table(const Json& result) {
    std::string text =
        "\nWhat a bilinear look-up errs, relative rms.\n\n| roughness | face | error |\n|---|---|---|\n";
    for (const Json& row : result.at("fetch"))
        text += "| " + number(row.at("roughness").get<double>(), 3) + " | " +
                std::to_string(row.at("face_size").get<int>()) + "² | " +
                number(100.0 * row.at("rms").get<double>(), 3) + " % |\n";
    return text;
}

/// Mean error of a mode over the cases that `value` finds a number in: "1.2 %".
template <class Value>
std::string mean_percent(const Json& result, const Json& mode, const Value& value) {
    double sum = 0.0;
    int count = 0;
    for (const Json& each : result.at("cases")) {
        if (each.at("mode") != mode.at("name")) continue;
        if (const std::optional<double> error = value(each)) {
            sum += *error;
            ++count;
        }
    }
    return count == 0 ? "" : number(100.0 * sum / count, 2) + " %";
}

std::string shading_summary(const Json& result) {
    std::string text = "Mean relative rms error on the sphere over environments and roughness " +
                       result.value("roughness_range", "") +
                       "; cost of a frame, split sum = 1.\n\n| mode | F0 = 1 | F0 = 0.04, albedo 0.8 | cost "
                       "|\n|---|---|---|---|\n";
    for (const Json& mode : result.at("modes"))
        text += "| " + mode.at("name").get<std::string>() + " | " +
                number(100.0 * mode.at("rms").at("metal").get<double>(), 2) + " % | " +
                number(100.0 * mode.at("rms").at("dielectric").get<double>(), 2) + " % | " +
                number(mode.at("cost").get<double>(), 2) + " |\n";
    return text;
}

/// One row a mode, one column a roughness.
std::string shading_by_roughness(const Json& result, const std::string& material, const std::string& mesh) {
    std::set<double> roughness;
    for (const Json& each : result.at("cases"))
        if (each.at("mesh") == mesh) roughness.insert(each.at("roughness").get<double>());
    if (roughness.empty()) return {};
    std::string text = "\n" + material + " " + mesh + ", by roughness.\n\n| mode |", rule = "|---|";
    for (const double r : roughness) {
        text += " " + number(r, 2) + " |";
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (const Json& mode : result.at("modes")) {
        text += "| " + mode.at("name").get<std::string>() + " |";
        for (const double r : roughness)
            text += " " +
                    mean_percent(
                        result, mode,
                        [&](const Json& each) -> std::optional<double> {
                            const bool counts = each.at("material") == material && each.at("mesh") == mesh &&
                                                each.at("roughness").get<double>() == r;
                            return counts ? std::optional(each.at("rms").get<double>()) : std::nullopt;
                        }) +
                    " |";
        text += "\n";
    }
    return text;
}

/// One row a mode, one column a band of N·V on the sphere.
std::string shading_by_nov(const Json& result, const std::string& material) {
    const Json& bands = result.at("NoV_bands");
    std::string text = "\n" + material + " sphere, by N·V.\n\n| mode |", rule = "|---|";
    for (std::size_t i = 0; i + 1 < bands.size(); ++i) {
        text += " " + number(bands[i].get<double>(), 1) + "–" + number(bands[i + 1].get<double>(), 1) + " |";
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (const Json& mode : result.at("modes")) {
        text += "| " + mode.at("name").get<std::string>() + " |";
        for (std::size_t i = 0; i + 1 < bands.size(); ++i)
            text += " " +
                    mean_percent(result, mode,
                                 [&](const Json& each) -> std::optional<double> {
                                     if (each.at("material") != material || !each.contains("rms_by_NoV"))
                                         return {};
                                     return each.at("rms_by_NoV").at(i).get<double>();
                                 }) +
                    " |";
        text += "\n";
    }
    return text;
}

std::string shading_tables(const Json& result) {
    std::string text = shading_summary(result);
    for (const char* material : {"metal", "dielectric"}) {
        for (const char* mesh : {"sphere", "shaderball"})
            text += shading_by_roughness(result, material, mesh);
        text += shading_by_nov(result, material);
    }
    return text;
}

/// "12 (20)" with skipping and without.
std::string both(const Json& row, const char* key, int digits) {
    return number(row.at("skip").at(key).get<double>(), digits) + " (" +
           number(row.at("no_skip").at(key).get<double>(), digits) + ")";
}

/// Every counter that skipping changed.
std::string changed_work(const Json& row) {
    std::string text;
    for (const auto& [key, value] : row.at("no_skip").at("work").items()) {
        const Json& own = row.at("skip").at("work").at(key);
        if (own == value) continue;
        text += (text.empty() ? "" : ", ") + key + " " + own.dump() + " (" + value.dump() + ")";
    }
    return text;
}

std::string step_row(const Json& row) {
    return "| " + row.at("name").get<std::string>() + " | " + both(row, "ms", 1) + " | " +
           number(row.at("ratio").get<double>(), 2) + " | " + both(row, "mib", 1) + " | " +
           changed_work(row) + " |\n";
}

std::string switch_table(const Json& light) {
    std::string text =
        "\nAnother environment (" + light.at("environment").get<std::string>() +
        "), until its picture is there; decoding it alone takes " +
        number(light.at("decode_ms").get<double>(), 1) +
        " ms.\n\n| from | light there, ms | first picture, ms | drawing alone, ms | seen, ms | seen less "
        "drawing, ms | allocated, MiB | work |\n|---|---|---|---|---|---|---|---|\n";
    for (const Json& row : light.at("cases")) {
        text += "| " + row.at("name").get<std::string>();
        for (const char* key :
             {"light_ready_ms", "first_picture_ms", "drawing_ms", "seen_ms", "seen_less_drawing_ms", "mib"})
            text += " | " + both(row, key, 1);
        text += " | " + changed_work(row) + " |\n";
    }
    return text;
}

std::string skip_tables(const Json& result) {
    std::string text =
        "Whole commands; in brackets with `--no-skip`.\n\n"
        "| picture | px | CPU ms | wall ms | peak MiB | largest 8-bit step | work "
        "|\n|---|---|---|---|---|---|---|\n";
    for (const Json& row : result.at("commands"))
        text += "| " + row.at("name").get<std::string>() + " | " + row.at("side_px").dump() + " | " +
                both(row, "cpu_ms", 0) + " | " + both(row, "wall_ms", 0) + " | " + both(row, "peak_mib", 0) +
                " | " + row.at("largest_code_step").dump() + " | " + changed_work(row) + " |\n";
    text +=
        "\nOne step, from the change to the picture; in brackets without skipping.\n\n| step | ms | ratio | "
        "allocated, MiB | work |\n|---|---|---|---|---|\n";
    for (const Json& row : result.at("steps")) text += step_row(row);
    if (result.contains("maps")) text += step_row(result.at("maps"));
    text += "\n| views side by side | ratio |\n|---|---|\n";
    for (const Json& row : result.at("shared_views"))
        text += "| " + row.at("name").get<std::string>() + " | " + number(row.at("ratio").get<double>(), 2) +
                " |\n";
    for (const Json& each : result.at("environment_switch")) text += switch_table(each);
    return text;
}

}  // namespace

std::string bench_markdown(std::string_view benchmark, const Json& result) {
    if (benchmark == "skip") return skip_tables(result);
    if (benchmark == "shading") return shading_tables(result);
    if (benchmark != "ibl") return {};
    std::string text = methods_table(result);
    if (result.contains("scaling")) text += scaling_table(result);
    if (result.contains("fetch")) text += fetch_table(result);
    return text;
}

}  // namespace patina

#include "app/stats.h"

#include "materials/text_io.h"
#include "renderer/core/file_io.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <ctime>
#include <span>

#ifndef _WIN32
#include <sys/resource.h>
#endif

namespace patina {

using Json = nlohmann::ordered_json;

std::uint64_t bytes_of(const MapLevels& map) {
    std::uint64_t bytes = 0;
    for (const Image& level : map.levels) bytes += level.bytes.size();
    return bytes;
}

std::uint64_t bytes_of(const Mesh& mesh) {
    return mesh.vertices.size() * sizeof(Vertex) + mesh.indices.size() * sizeof(std::uint32_t);
}

std::uint64_t bytes_of(const PreparedLight& light) {
    std::uint64_t halves = light.levels.irradiance.rgba.size();
    for (const PanoramaLevels::Level& level : light.panorama.levels) halves += level.rgba.size();
    for (const LightLevels::Cube& cube : light.levels.levels) halves += cube.rgba.size();
    return halves * sizeof(std::uint16_t);
}

void count_bake(WorkLedger& work, const BakedEnvironment& baked) {
    ++work.sphere_transforms;
    work.levels_baked += baked.levels.size();
    if (baked.irradiance.size > 0) ++work.irradiance_bakes;
}

void count_light(WorkLedger& work, const LightOrder& order, const ReadyLight& ready) {
    const bool is_baked = ready.levels_baked > 0 || ready.irradiance_baked;
    work.environments_decoded += ready.decoded ? 1 : 0;
    work.environments_from_disk += ready.was_kept ? 1 : 0;
    work.bakes_from_disk += ready.from_disk ? 1 : 0;
    work.first_lights += ready.is_first_light ? 1 : 0;
    work.sphere_transforms += is_baked ? 1 : 0;
    work.levels_baked += std::uint64_t(ready.levels_baked);
    work.irradiance_bakes += ready.irradiance_baked ? 1 : 0;
    ++work.environments_uploaded;
    if (ready.light) work.environment_bytes_uploaded += bytes_of(*ready.light);
    if (!order.needed || ready.is_first_light || ready.held->is_whole) return;
    if (!order.needed->irradiance)
        skip(work, "irradiance", "nothing in the picture scatters light diffusely");
    if (order.needed->roughness.empty())
        skip(work, "prefiltered levels", "nothing in the picture reflects light blurred");
    else if (ready.held->exact.levels.size() < standard_roughness_levels().size())
        skip(work, "further roughness levels", "the material does not reach them");
}

void count_reading(WorkLedger& work, const MapMaker& maker, std::uint64_t beside) {
    const Image& shape = maker.shape();
    ++work.maps_decoded;
    work.map_bytes_decoded += std::uint64_t(shape.width) * std::uint64_t(shape.height) *
                              std::uint64_t(shape.channels) * bytes_per_channel(shape.type);
    work.map_bytes_held += maker.bytes() + beside;
    if (!maker.is_whole()) skip(work, "finer levels of a map", "the picture shows the object no larger");
}

void count_upload(WorkLedger& work, const MapLevels& map, bool single) {
    ++work.maps_uploaded;
    work.map_bytes_uploaded += bytes_of(map);
    if (single) skip(work, "all texels of a map but one", "it is one colour all over");
}

void count_mesh(WorkLedger& work, const Mesh& mesh, bool tangents) {
    ++work.meshes_loaded;
    work.mesh_bytes_uploaded += bytes_of(mesh);
    if (tangents)
        work.tangent_frames += mesh.vertices.size();
    else if (!mesh.has_tangents)
        skip(work, "tangent frames", "no map bends the normals");
}

Json to_json(const WorkLedger& work) {
    Json json{{"work", Json::object()}, {"skipped", Json::array()}};
    for (const LedgerRow& row : kLedgerRows) json["work"][std::string(row.key)] = work.*row.member;
    for (const SkippedWork& each : work.skipped)
        json["skipped"].push_back({{"what", each.what}, {"why", each.why}, {"times", each.times}});
    return json;
}

ProcessMark mark_process() {
    const auto since_zero = std::chrono::steady_clock::now().time_since_epoch();
    return {.at_s = std::chrono::duration<double>(since_zero).count(),
            .cpu_s = process_cpu_s(),
            .peak_memory_bytes = process_peak_memory_bytes()};
}

void write_stats(const std::string& file, const WorkLedger& work,
                 const std::optional<FirstLitFrame>& first_lit_frame) {
    if (file.empty()) return;
    Json json = to_json(work);
    json["cpu_s"] = process_cpu_s();
    json["peak_memory_bytes"] = process_peak_memory_bytes();
    if (first_lit_frame)
        json["first_lit_frame"] = {{"at_s", first_lit_frame->mark.at_s},
                                   {"cpu_s", first_lit_frame->mark.cpu_s},
                                   {"peak_memory_bytes", first_lit_frame->mark.peak_memory_bytes},
                                   {"frames_before", first_lit_frame->frames_before}};
    const std::string text = json.dump(2) + "\n";
    write_file(utf8_to_path(file), std::as_bytes(std::span(text)));
}

double process_cpu_s() { return double(std::clock()) / double(CLOCKS_PER_SEC); }

std::uint64_t process_peak_memory_bytes() {
#ifdef _WIN32
    return 0;
#else
    rusage usage{};
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
    return std::uint64_t(usage.ru_maxrss);
#else
    return std::uint64_t(usage.ru_maxrss) * 1024;
#endif
#endif
}

}  // namespace patina

// What the work ledger is told and what it tells: counting of loads and bakes, and the JSON file of --stats.
#pragma once

#include "app/reconcile_light.h"
#include "renderer/core/ledger.h"
#include "renderer/core/mesh.h"
#include "renderer/gl/light_levels.h"
#include "renderer/map_levels.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace patina {

/// All of an environment's light, newly baked.
void count_bake(WorkLedger& work, const BakedEnvironment& baked);
/// Light that a picture asked for, with what it did not need.
void count_light(WorkLedger& work, const LightOrder& order, const ReadyLight& ready);
/// A picture that was read for a map, by maker, before it hands the map over. beside: bytes of it that were
/// in memory, too.
void count_reading(WorkLedger& work, const MapMaker& maker, std::uint64_t beside = 0);
/// A map on the GPU; single: no more than a texel, for it is one colour.
void count_upload(WorkLedger& work, const MapLevels& map, bool single = false);
/// A mesh on the GPU; tangents: they were made for it, which has none of its own.
void count_mesh(WorkLedger& work, const Mesh& mesh, bool tangents);
std::uint64_t bytes_of(const MapLevels& map);
std::uint64_t bytes_of(const Mesh& mesh);
/// Panorama included.
std::uint64_t bytes_of(const PreparedLight& light);

/// A moment of this process: on the steady clock (whose zero all processes share on most systems), with what
/// it had used by then.
struct ProcessMark {
    double at_s = 0.0;
    double cpu_s = 0.0;
    std::uint64_t peak_memory_bytes = 0;
};
ProcessMark mark_process();
/// When the window first showed the object in its light.
struct FirstLitFrame {
    ProcessMark mark;
    std::uint64_t frames_before = 0;  ///< shown without it
};

/// {"work": {every counter}, "skipped": [{"what", "why", "times"}]}
nlohmann::ordered_json to_json(const WorkLedger& work);
/// The same, with "cpu_s" and "peak_memory_bytes" of this process so far, and "first_lit_frame" where there
/// was one. No file where its name is empty.
void write_stats(const std::string& file, const WorkLedger& work,
                 const std::optional<FirstLitFrame>& first_lit_frame = {});

/// CPU time of all threads of this process in seconds; the most memory it has had in bytes (0 where the
/// system does not tell).
double process_cpu_s();
std::uint64_t process_peak_memory_bytes();

}  // namespace patina

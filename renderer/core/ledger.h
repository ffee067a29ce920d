// The work ledger: how much of everything costly was done, and what was not done because nobody would have
// seen it. Plain counters that whoever does the work adds to, on one thread; what workers do is counted when
// their results are collected. Knows nothing of what is counted.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

/// Work that was left out, and why, each as half a sentence.
struct SkippedWork {
    std::string what;  ///< "irradiance"
    std::string why;   ///< "a full metal reflects no diffuse light"
    std::uint64_t times = 0;
    bool operator==(const SkippedWork&) const = default;
};

struct WorkLedger {
    // Light.
    std::uint64_t environments_decoded = 0;
    std::uint64_t environments_from_disk = 0;  ///< ready for the GPU, neither decoded nor filtered
    std::uint64_t sphere_transforms = 0;       ///< spherical-harmonic analyses of a panorama
    std::uint64_t first_lights = 0;            ///< quick bakes from a reduced panorama
    std::uint64_t levels_baked = 0;
    std::uint64_t irradiance_bakes = 0;
    std::uint64_t bakes_from_disk = 0;
    std::uint64_t bakes_from_memory = 0;
    std::uint64_t environments_uploaded = 0;
    std::uint64_t environment_bytes_uploaded = 0;
    // Material.
    std::uint64_t programs_compiled = 0;
    std::uint64_t programs_from_disk = 0;
    std::uint64_t maps_decoded = 0;
    std::uint64_t map_bytes_decoded = 0;
    std::uint64_t map_bytes_held = 0;    ///< the most that each took in memory while it was read
    std::uint64_t maps_from_memory = 0;  ///< or read once for several slots; likewise lights and meshes
    std::uint64_t maps_uploaded = 0;
    std::uint64_t map_bytes_uploaded = 0;
    // Mesh.
    std::uint64_t meshes_loaded = 0;
    std::uint64_t meshes_from_memory = 0;
    std::uint64_t tangent_frames = 0;  ///< vertices that were given one
    std::uint64_t mesh_bytes_uploaded = 0;
    // Pictures.
    std::uint64_t frames_shown = 0;         ///< of the window
    std::uint64_t views_drawn = 0;          ///< pictures of a scene, thumbnails included
    std::uint64_t surfaces_rasterised = 0;  ///< to be shaded more than once
    std::uint64_t views_from_surfaces = 0;  ///< pictures shaded from one of those
    std::uint64_t reference_points = 0;     ///< directions a pixel, of the integral itself
    std::uint64_t draw_calls = 0;
    std::uint64_t triangles_drawn = 0;
    std::uint64_t pixels_drawn = 0;      ///< of the pictures, whatever lies in them
    std::uint64_t fragments_shaded = 0;  ///< runs of fragment shaders; 0 where the driver does not tell

    std::vector<SkippedWork> skipped;

    bool operator==(const WorkLedger&) const = default;
};

enum class LedgerUnit : std::uint8_t { Count, Bytes };
struct LedgerRow {
    std::string_view key;  ///< in JSON
    std::string_view group;
    std::string_view label;
    std::uint64_t WorkLedger::*member;
    LedgerUnit unit = LedgerUnit::Count;
};
/// Every counter, group by group. JSON and the panel follow from it.
inline constexpr std::array kLedgerRows{
    LedgerRow{"environments_decoded", "Light", "Environments decoded", &WorkLedger::environments_decoded},
    LedgerRow{"environments_from_disk", "Light", "Environments found on disk",
              &WorkLedger::environments_from_disk},
    LedgerRow{"sphere_transforms", "Light", "Transforms of a panorama", &WorkLedger::sphere_transforms},
    LedgerRow{"first_lights", "Light", "First lights", &WorkLedger::first_lights},
    LedgerRow{"levels_baked", "Light", "Roughness levels baked", &WorkLedger::levels_baked},
    LedgerRow{"irradiance_bakes", "Light", "Irradiance baked", &WorkLedger::irradiance_bakes},
    LedgerRow{"bakes_from_disk", "Light", "Bakes found on disk", &WorkLedger::bakes_from_disk},
    LedgerRow{"bakes_from_memory", "Light", "Lights shared or in memory", &WorkLedger::bakes_from_memory},
    LedgerRow{"environments_uploaded", "Light", "Lights uploaded", &WorkLedger::environments_uploaded},
    LedgerRow{"environment_bytes_uploaded", "Light", "Light uploaded",
              &WorkLedger::environment_bytes_uploaded, LedgerUnit::Bytes},
    LedgerRow{"programs_compiled", "Material", "Shader programs compiled", &WorkLedger::programs_compiled},
    LedgerRow{"programs_from_disk", "Material", "Programs found on disk", &WorkLedger::programs_from_disk},
    LedgerRow{"maps_decoded", "Material", "Maps decoded", &WorkLedger::maps_decoded},
    LedgerRow{"map_bytes_decoded", "Material", "Texels decoded", &WorkLedger::map_bytes_decoded,
              LedgerUnit::Bytes},
    LedgerRow{"map_bytes_held", "Material", "Texels held at once", &WorkLedger::map_bytes_held,
              LedgerUnit::Bytes},
    LedgerRow{"maps_from_memory", "Material", "Maps shared or in memory", &WorkLedger::maps_from_memory},
    LedgerRow{"maps_uploaded", "Material", "Maps uploaded", &WorkLedger::maps_uploaded},
    LedgerRow{"map_bytes_uploaded", "Material", "Texels uploaded", &WorkLedger::map_bytes_uploaded,
              LedgerUnit::Bytes},
    LedgerRow{"meshes_loaded", "Mesh", "Meshes loaded", &WorkLedger::meshes_loaded},
    LedgerRow{"meshes_from_memory", "Mesh", "Meshes shared or in memory", &WorkLedger::meshes_from_memory},
    LedgerRow{"tangent_frames", "Mesh", "Tangent frames built", &WorkLedger::tangent_frames},
    LedgerRow{"mesh_bytes_uploaded", "Mesh", "Vertices uploaded", &WorkLedger::mesh_bytes_uploaded,
              LedgerUnit::Bytes},
    LedgerRow{"frames_shown", "Pictures", "Frames of the window", &WorkLedger::frames_shown},
    LedgerRow{"views_drawn", "Pictures", "Pictures drawn", &WorkLedger::views_drawn},
    LedgerRow{"surfaces_rasterised", "Pictures", "Surfaces rasterised", &WorkLedger::surfaces_rasterised},
    LedgerRow{"views_from_surfaces", "Pictures", "Pictures shaded from those",
              &WorkLedger::views_from_surfaces},
    LedgerRow{"reference_points", "Pictures", "Reference points a pixel", &WorkLedger::reference_points},
    LedgerRow{"draw_calls", "Pictures", "Draw calls", &WorkLedger::draw_calls},
    LedgerRow{"triangles_drawn", "Pictures", "Triangles drawn", &WorkLedger::triangles_drawn},
    LedgerRow{"pixels_drawn", "Pictures", "Pixels of pictures", &WorkLedger::pixels_drawn},
    LedgerRow{"fragments_shaded", "Pictures", "Fragments shaded", &WorkLedger::fragments_shaded},
};

/// Notes that something was not done; the same again only raises times.
void skip(WorkLedger& ledger, std::string_view what, std::string_view why);

/// Adds what another part counted.
void add(WorkLedger& ledger, const WorkLedger& more);

/// What was counted since earlier, a former state of the same ledger.
WorkLedger since(const WorkLedger& ledger, const WorkLedger& earlier);

/// "1 234" or "3.4 MiB".
std::string ledger_text(const LedgerRow& row, const WorkLedger& ledger);

}  // namespace patina

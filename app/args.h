// The command line as plain values. Knows no file and runs nothing.
#pragma once

#include "renderer/core/camera.h"
#include "renderer/core/map_settings.h"
#include "renderer/core/view.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace patina {

/// What render, compare and edit share: how the scene is set up. Ids or file paths as typed.
struct SceneOptions {
    std::string mesh = "sphere";
    std::vector<std::string> environments{"studio"};  ///< render and edit take exactly one
    View view;
    Camera camera;
    glm::ivec2 size_px{512, 512};
    int samples = 1024;  ///< points a pixel of the reference
    double error = 0.0;  ///< > 0: it stops once 95 of 100 pixels are known to that; samples are the most then
    std::vector<std::pair<std::string, std::string>> overrides;  ///< --set key=value, in order
    bool allow_missing_maps = false;                             ///< draw the placeholder instead of failing
    bool skip = true;  ///< false: prepare what any picture could need, for comparison
};

struct EditArgs {
    std::string preset;  ///< empty: none was named
    std::string mesh;    ///< empty: as last time
    std::string environment;
    std::string drive_script;
    glm::ivec2 window_px{0};  ///< 0: as last time
    bool skip = true;         ///< as in SceneOptions
    std::string stats;        ///< file for the work ledger, written at the end; empty: none
};
struct RenderArgs {
    std::vector<std::string> presets;  ///< one for render; "-" is the default material
    std::string output;
    SceneOptions scene;
    int turntable = 0;        ///< > 0: so many pictures of a whole turn, numbered
    bool turn_light = false;  ///< the light goes round instead of the camera
    bool up_to_date = false;  ///< leave a picture alone that this very command would make again
    std::string stats;        ///< file for the work ledger; empty: none is written
};
struct ReportArgs {
    std::string comparison;  ///< file
    std::string output;      ///< .html or .pdf
    int picture_px = 640;
    bool no_hints = false;
    int reference_samples = 0;  ///< a pixel; 0: the renders are not held against the reference
    std::string stats;          ///< as in RenderArgs
};
struct BakeArgs {
    std::string environment;
    std::string output;
    int size = 256;
    std::vector<float> roughness;  ///< empty: the standard levels
    bool keep_lights = false;
    std::string format = "exr";
    std::string stats;  ///< as in RenderArgs
};
struct MapsArgs {
    std::string photo;
    std::string output;              ///< folder
    std::string name;                ///< of the preset and the files; empty: the photo's
    std::vector<glm::vec2> corners;  ///< four, in pixels of the photo; empty: the whole photo
    std::optional<glm::vec2> card;   ///< in pixels of the photo
    bool white = false;              ///< it is white paper instead of an 18 % grey card
    MapSettings settings;            ///< but for corners and gain
    MapChoice choice;
    bool force = false;
};
struct BenchArgs {
    std::vector<std::string> names;         ///< empty: all
    std::vector<std::string> environments;  ///< besides the built-in ones
    std::string preset, mesh;               ///< of skip, besides its own
    std::string output;                     ///< folder; empty: bench-results
    bool quick = false;
    std::int64_t cases = 0;               ///< of stability; 0: its everyday number
    std::uint64_t seed = 1;               ///< of stability's first trial
    std::vector<std::string> properties;  ///< of stability; empty: all
};

enum class Command { Edit, Render, Compare, Report, Maps, Bake, Bench, Check, List };
struct Args {
    Command command = Command::Edit;
    EditArgs edit;
    RenderArgs render;
    ReportArgs report;
    MapsArgs maps;
    BakeArgs bake;
    BenchArgs bench;
    std::vector<std::string> check;  ///< presets
    std::string list;                ///< environments | meshes | presets | plugins
};

/// Either what was asked for, or what to print and the exit status (0 for --help and --version, 2 for wrong
/// usage).
struct ParsedArgs {
    std::optional<Args> args;
    std::string message;
    int exit_status = 0;
};
ParsedArgs parse_args(const std::vector<std::string>& words);

}  // namespace patina

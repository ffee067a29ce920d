#include "app/args.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

namespace patina {

namespace {

constexpr int kMaxPictureSide = 16384;

/// "1,2,3" → numbers; an error names the text.
std::vector<float> parse_numbers(const std::string& text, char separator) {
    std::vector<float> numbers;
    const char* at = text.data();
    const char* end = at + text.size();
    while (true) {
        float number = 0.0f;
        const auto [next, error] = std::from_chars(at, end, number);
        if (error != std::errc{} || !std::isfinite(number))
            throw CLI::ValidationError("'" + text + "' is not a list of numbers");
        numbers.push_back(number);
        if (next == end) return numbers;
        if (*next != separator) throw CLI::ValidationError("'" + text + "' is not a list of numbers");
        at = next + 1;
    }
}

void add_size(CLI::App& app, const std::string& name, glm::ivec2& size, const std::string& help) {
    app.add_option_function<std::string>(
           name,
           [&size](const std::string& text) {
               const std::vector<float> sides = parse_numbers(text, 'x');
               const auto valid = [](float side) {
                   return side >= 1.0f && side <= float(kMaxPictureSide) && side == std::floor(side);
               };
               if (sides.size() != 2 || !valid(sides[0]) || !valid(sides[1]))
                   throw CLI::ValidationError("a size is WIDTHxHEIGHT, each 1 to 16384, not '" + text + "'");
               size = {int(sides[0]), int(sides[1])};
           },
           help)
        ->type_name("WxH");
}

/// An option that takes one id of a table of names, listed in its help.
template <class T, std::size_t n>
void add_named(CLI::App& app, const std::string& name, const std::array<Named<T>, n>& table, T& target,
               const std::string& help) {
    std::string ids;
    for (const auto& row : table) ids += (ids.empty() ? "" : "|") + std::string(row.id);
    app.add_option_function<std::string>(
           name,
           [&table, &target, name, ids](const std::string& text) {
               const std::optional<T> value = value_of(table, text);
               if (!value) throw CLI::ValidationError(name + " takes " + ids + ", not '" + text + "'");
               target = *value;
           },
           help)
        ->type_name(ids);
}

void add_camera(CLI::App& app, Camera& camera) {
    app.add_option_function<std::string>(
           "--camera",
           [&camera](const std::string& text) {
               const std::vector<float> values = parse_numbers(text, ',');
               if (values.size() != 3 || std::abs(values[1]) > 89.9f || values[2] <= 0.0f)
                   throw CLI::ValidationError(
                       "a camera is YAW,PITCH,DISTANCE with pitch within 89.9 degrees and distance above 0, "
                       "not '" +
                       text + "'");
               camera.yaw_deg = values[0];
               camera.pitch_deg = values[1];
               camera.distance = values[2];
           },
           "Where the camera stands, looking at the origin (default 0,0,4.5)")
        ->type_name("YAW,PITCH,DIST");
}

void add_overrides(CLI::App& app, SceneOptions& scene) {
    app.add_option_function<std::vector<std::string>>(
           "--set",
           [&scene](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   const std::size_t equals = text.find('=');
                   if (equals == std::string::npos || equals == 0)
                       throw CLI::ValidationError("--set takes KEY=VALUE, not '" + text + "'");
                   scene.overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
               }
           },
           "Override a value, such as albedo=0.8,0.1,0.1 or roughness=0.3 (repeatable)")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

void add_no_skip(CLI::App& app, bool& skip) {
    app.add_flag_callback(
        "--no-skip", [&skip] { skip = false; },
        "Prepare all that any picture could need, not only what this one does (for measuring)");
}

void add_scene(CLI::App& app, SceneOptions& scene) {
    app.add_option("--mesh", scene.mesh, "sphere, quad, cube, torus, shaderball, or a mesh file")
        ->type_name("ID|FILE");
    app.add_option("--env-rotation", scene.view.env_rotation_deg, "Turn the light about the vertical axis")
        ->type_name("DEG");
    app.add_option("--exposure", scene.view.exposure_ev, "Exposure in stops")
        ->type_name("EV")
        ->check(CLI::Range(-30.0, 30.0));
    add_size(app, "--size", scene.size_px, "Size of a picture in pixels (default 512x512)");
    add_camera(app, scene.camera);
    add_named(app, "--shading", kShadings, scene.view.shading, "How light is computed");
    add_named(app, "--quality", kQualities, scene.view.quality,
              "How closely fitted shading follows the integral");
    add_named(app, "--tonemap", kTonemaps, scene.view.tonemap, "How radiance becomes a picture (PNG only)");
    add_named(app, "--background", kBackgrounds, scene.view.background, "What is seen behind the object");
    add_named(app, "--debug-view", kDebugViews, scene.view.debug,
              "Show one ingredient instead of the picture");
    add_overrides(app, scene);
    app.add_flag("--allow-missing-maps", scene.allow_missing_maps,
                 "Draw a checkerboard where a map cannot be read");
    add_no_skip(app, scene.skip);
}

void add_stats(CLI::App& app, std::string& file) {
    app.add_option("--stats", file, "Write what was computed, and what was skipped and why, as JSON")
        ->type_name("FILE");
}

void add_edit(CLI::App& root, Args& args) {
    CLI::App* app = root.add_subcommand("edit", "Open the editor (the default)");
    app->add_option("preset", args.edit.preset, "A preset to open")->type_name("PRESET");
    app->add_option("--mesh", args.edit.mesh, "A built-in mesh or a mesh file")->type_name("ID|FILE");
    app->add_option("--env", args.edit.environment, "A built-in environment or a picture file")
        ->type_name("ID|FILE");
    add_size(*app, "--window", args.edit.window_px, "Size of the window in pixels");
    add_no_skip(*app, args.edit.skip);
    add_stats(*app, args.edit.stats);
    app->add_option("--drive", args.edit.drive_script, "Play a script of clicks and keys, then quit")
        ->type_name("FILE");
}

/// A share as "0.5%" or "0.005".
double parse_share(const std::string& text, const char* option) {
    const bool percent = !text.empty() && text.back() == '%';
    const std::vector<float> values = parse_numbers(percent ? text.substr(0, text.size() - 1) : text, ',');
    const double share = values.size() == 1 ? double(values.front()) * (percent ? 0.01 : 1.0) : 0.0;
    if (!(share >= 1e-5 && share <= 0.5))
        throw CLI::ValidationError(std::string(option) + " takes 0.001% to 50%, not '" + text + "'");
    return share;
}

void add_samples(CLI::App& app, SceneOptions& scene) {
    constexpr int most = 1 << 24, most_unless_told = 1 << 16;
    constexpr double error_unless_told = 0.01;
    CLI::Option* samples = app.add_option_function<std::string>(
        "--samples",
        [&scene](const std::string& text) {
            if (text == "auto") {
                if (scene.error == 0.0) scene.error = error_unless_told;
                scene.samples = most_unless_told;
                return;
            }
            const bool is_whole = !text.empty() && text.size() <= 8 &&
                                  text.find_first_not_of("0123456789") == std::string::npos;
            const int count = is_whole ? std::stoi(text) : 0;
            if (count < 1 || count > most)
                throw CLI::ValidationError("--samples takes 1 to 16777216 or auto, not '" + text + "'");
            scene.samples = count;
        },
        "Points a pixel of --shading reference (default 1024); auto: until 95 of 100 pixels are known to 1 "
        "%");
    samples->type_name("N|auto");
    app.add_option_function<std::string>(
           "--error",
           [&scene, samples](const std::string& text) {
               scene.error = parse_share(text, "--error");
               if (samples->count() == 0) scene.samples = most_unless_told;
           },
           "--shading reference stops once 95 of 100 pixels are known to that share of their light, or at "
           "--samples")
        ->type_name("E%");
}

void add_render_and_compare(CLI::App& root, Args& args) {
    CLI::App* render = root.add_subcommand("render", "Render one preset to a picture");
    render
        ->add_option("preset", args.render.presets,
                     "A preset file, the name of a shipped one, or - for the default material")
        ->required()
        ->expected(1)
        ->type_name("PRESET");
    CLI::App* compare =
        root.add_subcommand("compare", "Render a labelled sheet: a row a preset, a column a lighting");
    compare->add_option("presets", args.render.presets, "Presets, one row each")->type_name("PRESET...");
    render->add_option("--env", args.render.scene.environments, "A built-in environment or a picture file")
        ->type_name("ID|FILE")
        ->allow_extra_args(false);
    compare->add_option("--env", args.render.scene.environments, "Environments, one column each")
        ->type_name("ID|FILE...");
    render
        ->add_option(
            "--turntable", args.render.turntable,
            "Draw a whole turn in N pictures: -o turn.png gives turn-001.png and so on, -o turn.mp4 a video "
            "where ffmpeg is installed")
        ->check(CLI::Range(2, 9999))
        ->type_name("N");
    render
        ->add_option_function<std::string>(
            "--turn", [&args](const std::string& text) { args.render.turn_light = text == "light"; },
            "What goes round in a turntable (default camera)")
        ->check(CLI::IsMember({"camera", "light"}))
        ->type_name("camera|light");
    for (CLI::App* app : {render, compare}) {
        app->add_flag("--up-to-date", args.render.up_to_date,
                      "Leave a picture alone that was made from the same files and options by this version");
        app->add_option("-o,--output", args.render.output,
                        "The picture to write: .png (display) or .exr (linear radiance)")
            ->required()
            ->type_name("FILE");
        add_scene(*app, args.render.scene);
        add_samples(*app, args.render.scene);
        add_stats(*app, args.render.stats);
    }
}

void add_report(CLI::App& root, Args& args) {
    CLI::App* app = root.add_subcommand("report", "Write a comparison as a web page or a PDF document");
    app->add_option("comparison", args.report.comparison, "A comparison file, as the editor saves it")
        ->required()
        ->type_name("SHEET.json");
    app->add_option("-o,--output", args.report.output, "The report to write: .html (one file) or .pdf")
        ->required()
        ->type_name("FILE");
    app->add_option("--size", args.report.picture_px, "Side of a picture in pixels (default 640)")
        ->check(CLI::Range(32, 4096))
        ->type_name("N");
    app->add_option("--reference", args.report.reference_samples,
                    "Also say how far the shading is from the reference of N points a pixel")
        ->check(CLI::Range(8, 65536))
        ->type_name("N");
    app->add_flag("--no-hints", args.report.no_hints,
                  "Do not compute what would bring the renders closer to the photos");
    add_stats(*app, args.report.stats);
}

void add_bake(CLI::App& root, Args& args) {
    CLI::App* app =
        root.add_subcommand("bake", "Write the prefiltered light of an environment, for any program");
    app->add_option("environment", args.bake.environment, "A built-in environment or a picture file")
        ->required()
        ->type_name("ENV");
    app->add_option("-o,--output", args.bake.output, "The folder to write")->required()->type_name("DIR");
    app->add_option("--size", args.bake.size, "No cube face is larger (default 256)")
        ->check(CLI::Range(4, 4096))
        ->type_name("N");
    app->add_option_function<std::string>(
           "--levels",
           [&args](const std::string& text) {
               args.bake.roughness = parse_numbers(text, ',');
               std::ranges::sort(args.bake.roughness);
               for (float r : args.bake.roughness)
                   if (r < 0.0f || r > 1.0f)
                       throw CLI::ValidationError("a roughness is 0 to 1; --levels got '" + text + "'");
           },
           "Exactly these roughness values instead of the standard levels")
        ->type_name("R,R,...");
    add_stats(*app, args.bake.stats);
    app->add_flag("--keep-lights", args.bake.keep_lights,
                  "Fold lights that were taken out back into the levels");
    app->add_option(
           "--format", args.bake.format,
           "exr: face strips, for this program and any other; ktx: cube maps for Filament and three.js")
        ->check(CLI::IsMember({"exr", "ktx"}))
        ->type_name("exr|ktx");
}

void add_bench(CLI::App& root, Args& args) {
    CLI::App* app = root.add_subcommand("bench", "Measure run time and error; writes JSON");
    app->add_option("names", args.bench.names, "Which benchmarks (default: all)")->type_name("NAME...");
    app->add_option("--env", args.bench.environments, "Further environments to measure on")
        ->type_name("FILE");
    app->add_option("-o,--output", args.bench.output, "Folder for the results (default bench-results)")
        ->type_name("DIR");
    app->add_option("--preset", args.bench.preset, "skip: a further preset to measure on")->type_name("FILE");
    app->add_option("--mesh", args.bench.mesh, "skip: the mesh it is put on")->type_name("MESH");
    app->add_flag("--quick", args.bench.quick, "Fewer repetitions");
    app->add_option("--cases", args.bench.cases, "stability: how many random cases in all")
        ->check(CLI::PositiveNumber);
    app->add_option("--seed", args.bench.seed, "stability: the first trial's seed (default 1)");
    app->add_option("--property", args.bench.properties, "stability: only these properties")->type_name("ID");
}

glm::vec2 parse_pair(const std::string& text, const char* what) {
    const std::vector<float> values = parse_numbers(text, ',');
    if (values.size() != 2) throw CLI::ValidationError(std::string(what) + ", not '" + text + "'");
    return {values[0], values[1]};
}

void add_sample(CLI::App& app, MapsArgs& args) {
    app.add_option_function<std::vector<std::string>>(
           "--corners",
           [&args](const std::vector<std::string>& texts) {
               for (const std::string& text : texts)
                   args.corners.push_back(parse_pair(text, "a corner is X,Y in pixels of the photo"));
           },
           "The sample's corners: upper left, upper right, lower right, lower left (default: the whole "
           "photo)")
        ->expected(4)
        ->type_name("X,Y");
    const auto add_card = [&](const char* name, bool white, const char* help) {
        return app
            .add_option_function<std::string>(
                name,
                [&args, white](const std::string& text) {
                    args.card = parse_pair(text, "a card lies at X,Y in pixels of the photo");
                    args.white = white;
                },
                help)
            ->type_name("X,Y");
    };
    add_card("--grey", false, "Where an 18 % grey card lies: sets exposure and white balance")
        ->excludes(add_card("--white", true, "The same of white paper"));
    add_size(app, "--size", args.settings.size_px, "Size of the maps (default 1024x1024)");
    app.add_option("--even", args.settings.even_degree,
                   "How freely the light's gradient is followed: 0 (not at all) to 4 (default 3)")
        ->check(CLI::Range(0, 4))
        ->type_name("N");
    app.add_flag_callback(
        "--no-tile", [&args] { args.settings.tileable = false; },
        "Leave the borders as they are: the maps do not tile");
}

void add_surface(CLI::App& app, MapsArgs& args) {
    MapSettings& settings = args.settings;
    app.add_option("--remove-shading", settings.shading_removed,
                   "Share of the light and shade of small forms to take out of the albedo (default 0)")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option_function<std::string>(
           "--lit-from",
           [&settings](const std::string& text) {
               const glm::vec2 lamp = parse_pair(text, "a lamp stands at AZIMUTH,ELEVATION in degrees");
               if (lamp.y < 5.0f || lamp.y > 85.0f)
                   throw CLI::ValidationError("a lamp's elevation is 5 to 85 degrees, not '" + text + "'");
               settings.relief_from = ReliefFrom::Light;
               settings.light_azimuth_deg = lamp.x;
               settings.light_elevation_deg = lamp.y;
           },
           "Tell height from a lamp's shading: 0 right of the sample, 90 above it, and so many degrees over "
           "it "
           "(default: dark is deep)")
        ->type_name("AZIMUTH,ELEVATION");
    app.add_option("--scale", settings.relief_scale, "Largest form of the height, in widths (default 0.1)")
        ->check(CLI::Range(0.002, 1.0));
    app.add_option("--strength", settings.relief_strength, "Of height and normals (default 1)")
        ->check(CLI::Range(0.0, 10.0));
    app.add_option("--roughness", settings.roughness, "In the middle (default 0.6)")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--roughness-contrast", settings.roughness_contrast, "Around that (default 0.4)")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--ao-strength", settings.ao_strength, "How much deeper the height counts (default 1)")
        ->check(CLI::Range(0.0, 4.0));
    app.add_option("--ao-radius", settings.ao_radius, "How far it darkens, in widths (default 0.05)")
        ->check(CLI::Range(0.002, 0.5));
}

void add_maps(CLI::App& root, MapsArgs& args) {
    CLI::App* app = root.add_subcommand(
        "maps", "Make a preset with albedo, normal, roughness and AO maps from a photo of a flat sample");
    app->add_option("photo", args.photo, "PNG, JPEG, TIFF or EXR")->required()->type_name("PHOTO");
    app->add_option("-o,--output", args.output, "The folder to write to")->required()->type_name("DIR");
    app->add_option("--name", args.name, "Of the preset and its files (default: the photo's)");
    add_sample(*app, args);
    add_surface(*app, args);
    app->add_option_function<std::vector<std::string>>(
           "--only",
           [&args](const std::vector<std::string>& maps) {
               const auto has = [&](const char* map) { return std::ranges::find(maps, map) != maps.end(); };
               args.choice = {has("albedo"), has("normal"), has("roughness"), has("ao")};
           },
           "Write only these (the height goes with the normals)")
        ->check(CLI::IsMember({"albedo", "normal", "roughness", "ao"}))
        ->delimiter(',')
        ->type_name("albedo,normal,roughness,ao");
    app->add_flag("--force", args.force, "Replace files of these names");
}

/// A file named like a preset among --env values belongs to the presets: `compare --env sky sunset
/// gold.json`.
void sort_out_presets(RenderArgs& render) {
    std::vector<std::string>& environments = render.scene.environments;
    const auto is_preset = [](const std::string& text) {
        const std::string_view name = std::string_view(text).substr(text.find_last_of("/\\") + 1);
        return text == "-" || (name.ends_with(".json") && name != "bake.json");  // which is baked light
    };
    std::ranges::copy_if(environments, std::back_inserter(render.presets), is_preset);
    std::erase_if(environments, is_preset);
}

constexpr std::array kCommands{std::pair{"edit", Command::Edit},       std::pair{"render", Command::Render},
                               std::pair{"compare", Command::Compare}, std::pair{"report", Command::Report},
                               std::pair{"maps", Command::Maps},       std::pair{"bake", Command::Bake},
                               std::pair{"bench", Command::Bench},     std::pair{"check", Command::Check},
                               std::pair{"list", Command::List}};

/// `patina gold.json` means `patina edit gold.json`.
std::vector<std::string> with_default_command(std::vector<std::string> words) {
    constexpr std::array root_options{"--help", "-h", "--version"};
    const bool named =
        !words.empty() &&
        (std::ranges::any_of(kCommands, [&](const auto& row) { return words.front() == row.first; }) ||
         std::ranges::any_of(root_options, [&](const char* option) { return words.front() == option; }));
    if (!named) words.insert(words.begin(), "edit");
    return words;
}

Command chosen_command(const CLI::App& root) {
    for (const auto& [name, command] : kCommands)
        if (root.got_subcommand(name)) return command;
    return Command::Edit;
}

}  // namespace

ParsedArgs parse_args(const std::vector<std::string>& words) {
    Args args;
    CLI::App root("Patina, an editor for physically based materials", "patina");
    root.set_version_flag("--version", "patina " PATINA_VERSION);
    root.require_subcommand(1);
    add_edit(root, args);
    add_render_and_compare(root, args);
    add_report(root, args);
    add_maps(root, args.maps);
    add_bake(root, args);
    add_bench(root, args);
    root.add_subcommand("check", "Validate presets and say what is wrong and where")
        ->add_option("presets", args.check, "Preset files")
        ->required()
        ->type_name("PRESET...");
    root.add_subcommand("list", "List what there is")
        ->add_option("what", args.list, "What to list")
        ->required()
        ->check(CLI::IsMember({"environments", "meshes", "presets", "plugins"}))
        ->type_name("environments|meshes|presets|plugins");
    try {
        std::vector<std::string> reversed = with_default_command(words);
        std::ranges::reverse(reversed);
        root.parse(std::move(reversed));
    } catch (const CLI::ParseError& error) {
        std::ostringstream out;
        std::ostringstream ignored;
        const bool asked_for_help = error.get_exit_code() == 0;
        root.exit(error, out, ignored);
        if (asked_for_help) return {std::nullopt, out.str(), 0};
        std::string message = error.what();
        while (message.ends_with('\n')) message.pop_back();
        return {std::nullopt, "patina: " + message + " (patina --help lists what there is)\n", 2};
    }
    args.command = chosen_command(root);
    sort_out_presets(args.render);
    if (args.render.scene.environments.empty()) args.render.scene.environments = {"studio"};
    if (args.command == Command::Bake && args.bake.format == "ktx") {
        if (!args.bake.roughness.empty())
            return {std::nullopt,
                    "patina: --levels goes with --format exr; the mips of a KTX file set its levels\n", 2};
        if ((args.bake.size & (args.bake.size - 1)) != 0)
            return {std::nullopt, "patina: --format ktx takes a --size that is a power of two\n", 2};
    }
    if (args.command == Command::Compare && args.render.presets.empty())
        return {std::nullopt, "patina: compare needs at least one preset\n", 2};
    if (args.command == Command::Render &&
        (args.render.presets.size() != 1 || args.render.scene.environments.size() != 1))
        return {std::nullopt, "patina: render takes one preset and one --env; compare takes several\n", 2};
    return {args, "", 0};
}

}  // namespace patina

// What a picture was made from, as a short text that stands in its file: pictures that are up to date are
// left alone, so that many of them can be made in independent, repeatable steps.
#pragma once

#include "app/args.h"
#include "app/registry.h"
#include "renderer/core/comparison.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace patina {

/// Under this key the text stands in PNG and EXR files.
inline constexpr std::string_view kMadeFromKey = "patina:made-from";

/// Of everything that a picture depends on: the program's version, every option, and the contents of preset,
/// maps, environment, mesh and photos. Names of files do not count, so that a folder may move. Throws where a
/// file that is needed cannot be read.
std::string made_from(const RenderArgs& args);

/// The picture is there and says that it was made from this.
bool is_up_to_date(const std::filesystem::path& picture, const std::string& made_from);

/// "turn.png", frame 7 of 120 → "turn-007.png"; at least four digits from a thousand on, three below.
std::filesystem::path frame_file(const std::filesystem::path& output, int frame, int frames);

}  // namespace patina

#include "renderer/core/builtin_env.h"

#include <array>
#include <string>

namespace patina {
namespace {

template <Environment (*paint)(int)>
Environment finished(int width, std::string_view id, std::string_view title) {
    Environment environment = paint(width);
    environment.id = id;
    environment.title = title;
    environment.content_hash = environment_hash(environment);
    return environment;
}

constexpr std::array kEnvironments{
    BuiltinEnvironment{"studio", "Studio",
                       "A dark room with softboxes: shows shape, gloss and edges as in product photographs.",
                       [](int width) { return finished<make_studio>(width, "studio", "Studio"); }},
    BuiltinEnvironment{
        "sky", "Clear sky",
        "Blue sky with the sun high on the left (Preetham's daylight model): hard, very bright light.",
        [](int width) { return finished<make_sky>(width, "sky", "Clear sky"); }},
    BuiltinEnvironment{"sunset", "Sunset",
                       "The sun low behind the object: warm light from one side, cool sky from the other.",
                       [](int width) { return finished<make_sunset>(width, "sunset", "Sunset"); }},
    BuiltinEnvironment{
        "overcast", "Overcast",
        "A clouded sky (CIE standard), three times brighter above than at the horizon: soft, no highlights.",
        [](int width) { return finished<make_overcast>(width, "overcast", "Overcast"); }},
    BuiltinEnvironment{
        "night", "Night",
        "Small bright lamps of many colours in the dark: the hardest test for filtered reflections.",
        [](int width) { return finished<make_night>(width, "night", "Night"); }},
    BuiltinEnvironment{
        "furnace", "White furnace",
        "The same light from everywhere: an ideal white object disappears, lost energy shows as grey.",
        [](int width) { return finished<make_furnace>(width, "furnace", "White furnace"); }},
    BuiltinEnvironment{
        "test", "Directions",
        "Each axis labelled and coloured: shows which way reflections point and how the light is turned.",
        [](int width) { return finished<make_test>(width, "test", "Directions"); }},
};

}  // namespace

std::span<const BuiltinEnvironment> builtin_environments() { return kEnvironments; }

}  // namespace patina

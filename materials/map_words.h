// The words that vendors use in the names of map files, and a file name taken apart into words. Pure; opens
// nothing.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

enum class MapRole { Albedo, Roughness, Glossiness, Metallic, Ao, Normal, Emission, Packed, Unused, Preview };

struct MapWord {
    std::string_view word;  ///< lower case, several words joined: "basecolor"
    MapRole role;
    int rank =
        0;  ///< of two files for one slot the lower is the more exact word; kLetterRank: a single letter
    std::string_view
        detail;  ///< Packed: what red, green, blue, alpha hold (o AO, r roughness, s smoothness, m metallic,
                 ///< - nothing). Unused: why, as the end of a sentence.
};
inline constexpr int kLetterRank = 9;

/// The entry of that word; null if it names no kind of map. Single letters are found too.
const MapWord* find_map_word(std::string_view word);

struct NameToken {
    std::string word;                ///< lower case
    std::size_t begin = 0, end = 0;  ///< bytes in the name
    int chunk = 0;                   ///< which of the parts between separators it came from
    bool noise =
        false;  ///< resolution, file format, level of detail, "map", "texture"; plain numbers are none
};
/// A name without folder and extension: split at separators, camelCase humps and between letters and digits.
std::vector<NameToken> tokenize(std::string_view name);

bool is_number(std::string_view word);

/// What the noise tokens say; 0 or −1 where they say nothing.
struct NameNoise {
    int resolution = 0;  ///< pixels: "2k" and "2048" are 2048
    int lod = -1;        ///< level of detail
    int udim_tile = 0;   ///< 1001…1999
};
NameNoise noise_of(const std::vector<NameToken>& tokens);

}  // namespace patina

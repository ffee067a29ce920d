#include "materials/map_words.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace patina {

namespace {

constexpr std::string_view kHeight =
    "is a height map; nothing is displaced here, the normal map carries the relief";
constexpr std::string_view kOpacity = "is an opacity map; this material is opaque";
constexpr std::string_view kSpecular =
    "is a specular map; this material takes its mirror strength from albedo and metallic";
constexpr std::string_view kCavity =
    "is a baked helper map (cavity, curvature, …), which this material does not use";
constexpr std::string_view kLayer =
    "belongs to a layer (coat, sheen, subsurface, …) that this material does not have";
constexpr std::string_view kOtherSpace =
    "holds normals of the whole object, not of the surface; only tangent-space ones fit";
constexpr std::string_view kId = "marks regions by colour; it says nothing about the surface";

using enum MapRole;
constexpr std::array kWords{
    MapWord{"basecolor", Albedo, 0},
    MapWord{"basecolour", Albedo, 0},
    MapWord{"basecol", Albedo, 0},
    MapWord{"albedo", Albedo, 0},
    MapWord{"alb", Albedo, 0},
    MapWord{"albedocolor", Albedo, 0},
    MapWord{"bc", Albedo, 0},
    MapWord{"color", Albedo, 1},
    MapWord{"colour", Albedo, 1},
    MapWord{"col", Albedo, 1},
    MapWord{"diffuse", Albedo, 2},
    MapWord{"diffusecolor", Albedo, 2},
    MapWord{"diffusecolour", Albedo, 2},
    MapWord{"diff", Albedo, 2},
    MapWord{"base", Albedo, 3},
    MapWord{"d", Albedo, kLetterRank},
    MapWord{"roughness", Roughness},
    MapWord{"rough", Roughness},
    MapWord{"rgh", Roughness},
    MapWord{"r", Roughness, kLetterRank},
    MapWord{"glossiness", Glossiness},
    MapWord{"gloss", Glossiness},
    MapWord{"glossy", Glossiness},
    MapWord{"smoothness", Glossiness},
    MapWord{"smooth", Glossiness},
    MapWord{"metallic", Metallic},
    MapWord{"metalness", Metallic},
    MapWord{"metallness", Metallic},
    MapWord{"metal", Metallic},
    MapWord{"metall", Metallic},
    MapWord{"mtl", Metallic},
    MapWord{"met", Metallic},
    MapWord{"m", Metallic, kLetterRank},
    MapWord{"ao", Ao},
    MapWord{"ambientocclusion", Ao},
    MapWord{"occlusion", Ao},
    MapWord{"occ", Ao},
    MapWord{"ambient", Ao},
    MapWord{"o", Ao, kLetterRank},
    MapWord{"normal", Normal},
    MapWord{"normals", Normal},
    MapWord{"nor", Normal},
    MapWord{"nrm", Normal},
    MapWord{"nrml", Normal},
    MapWord{"norm", Normal},
    MapWord{"normalgl", Normal},
    MapWord{"normaldx", Normal},
    MapWord{"norgl", Normal},
    MapWord{"nordx", Normal},
    MapWord{"normalopengl", Normal},
    MapWord{"normaldirectx", Normal},
    MapWord{"n", Normal, kLetterRank},
    MapWord{"emission", Emission},
    MapWord{"emissive", Emission},
    MapWord{"emit", Emission},
    MapWord{"emissioncolor", Emission},
    MapWord{"emissivecolor", Emission},
    MapWord{"emissioncolour", Emission},
    MapWord{"emissivecolour", Emission},
    MapWord{"glow", Emission},
    MapWord{"selfillumination", Emission},
    MapWord{"selfillum", Emission},
    MapWord{"e", Emission, kLetterRank},
    MapWord{"orm", Packed, 0, "orm"},
    MapWord{"arm", Packed, 0, "orm"},
    MapWord{"occlusionroughnessmetallic", Packed, 0, "orm"},
    MapWord{"aoroughnessmetallic", Packed, 0, "orm"},
    MapWord{"aoroughmetal", Packed, 0, "orm"},
    MapWord{"rma", Packed, 0, "rmo"},
    MapWord{"mra", Packed, 0, "mro"},
    MapWord{"metalroughness", Packed, 0, "-rm"},
    MapWord{"metallicroughness", Packed, 0, "-rm"},
    MapWord{"metalrough", Packed, 0, "-rm"},
    MapWord{"roughnessmetallic", Packed, 0, "-rm"},
    MapWord{"roughao", Packed, 0, "or"},
    MapWord{"maskmap", Packed, 0, "mo-s"},
    MapWord{"metallicsmoothness", Packed, 0, "m--s"},
    MapWord{"specularglossiness", Packed, 0, "---s"},
    MapWord{"height", Unused, 0, kHeight},
    MapWord{"heightmap", Unused, 0, kHeight},
    MapWord{"displacement", Unused, 0, kHeight},
    MapWord{"displace", Unused, 0, kHeight},
    MapWord{"disp", Unused, 0, kHeight},
    MapWord{"dsp", Unused, 0, kHeight},
    MapWord{"bump", Unused, 0, kHeight},
    MapWord{"bmp", Unused, 0, kHeight},
    MapWord{"parallax", Unused, 0, kHeight},
    MapWord{"h", Unused, kLetterRank, kHeight},
    MapWord{"opacity", Unused, 0, kOpacity},
    MapWord{"alpha", Unused, 0, kOpacity},
    MapWord{"transparency", Unused, 0, kOpacity},
    MapWord{"mask", Unused, 0, kOpacity},
    MapWord{"specular", Unused, 0, kSpecular},
    MapWord{"spec", Unused, 0, kSpecular},
    MapWord{"specularcolor", Unused, 0, kSpecular},
    MapWord{"specularlevel", Unused, 0, kSpecular},
    MapWord{"reflection", Unused, 0, kSpecular},
    MapWord{"cavity", Unused, 0, kCavity},
    MapWord{"curvature", Unused, 0, kCavity},
    MapWord{"thickness", Unused, 0, kCavity},
    MapWord{"position", Unused, 0, kCavity},
    MapWord{"translucency", Unused, 0, kLayer},
    MapWord{"translucent", Unused, 0, kLayer},
    MapWord{"transmission", Unused, 0, kLayer},
    MapWord{"subsurface", Unused, 0, kLayer},
    MapWord{"scattering", Unused, 0, kLayer},
    MapWord{"sss", Unused, 0, kLayer},
    MapWord{"sheen", Unused, 0, kLayer},
    MapWord{"fuzz", Unused, 0, kLayer},
    MapWord{"anisotropy", Unused, 0, kLayer},
    MapWord{"clearcoat", Unused, 0, kLayer},
    MapWord{"clearcoatroughness", Unused, 0, kLayer},
    MapWord{"clearcoatnormal", Unused, 0, kLayer},
    MapWord{"sheencolor", Unused, 0, kLayer},
    MapWord{"sheenroughness", Unused, 0, kLayer},
    MapWord{"subsurfacecolor", Unused, 0, kLayer},
    MapWord{"worldnormal", Unused, 0, kOtherSpace},
    MapWord{"worldspacenormal", Unused, 0, kOtherSpace},
    MapWord{"worldspacenormals", Unused, 0, kOtherSpace},
    MapWord{"wsnormal", Unused, 0, kOtherSpace},
    MapWord{"objectnormal", Unused, 0, kOtherSpace},
    MapWord{"objectspacenormal", Unused, 0, kOtherSpace},
    MapWord{"objectspacenormals", Unused, 0, kOtherSpace},
    MapWord{"osnormal", Unused, 0, kOtherSpace},
    MapWord{"bentnormal", Unused, 0, kOtherSpace},
    MapWord{"bentnormals", Unused, 0, kOtherSpace},
    MapWord{"id", Unused, 0, kId},
    MapWord{"idmap", Unused, 0, kId},
    MapWord{"colorid", Unused, 0, kId},
    MapWord{"materialid", Unused, 0, kId},
    MapWord{"preview", Preview},
    MapWord{"thumb", Preview},
    MapWord{"thumbs", Preview},
    MapWord{"thumbnail", Preview},
    MapWord{"popup", Preview},
    MapWord{"icon", Preview},
    MapWord{"render", Preview},
    MapWord{"ref", Preview},
};

constexpr std::array<std::string_view, 21> kNoise{
    "png", "jpg",     "jpeg",     "tif",    "tiff", "tga",  "exr", "hdr",   "webp",   "map", "maps",
    "tex", "texture", "textures", "texmap", "bit",  "srgb", "lod", "image", "linear", "lin"};

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// Bytes of other alphabets count as small letters.
bool is_lower(char c) { return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; }
bool is_word(char c) { return is_upper(c) || is_lower(c) || is_digit(c); }

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](char c) { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; });
    return result;
}

/// 0 if the text is not a number of at most five digits.
int number(std::string_view text) {
    static constexpr std::size_t most_digits = 5;
    int value = 0;
    if (text.empty() || text.size() > most_digits) return 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    return failure == std::errc() && end == text.data() + text.size() ? value : 0;
}

/// "2k" and "2048" are 2048; 0 for everything else.
int resolution_in(std::string_view word) {
    static constexpr int largest_in_k = 32;
    static constexpr int smallest = 256;
    if (word.ends_with('k')) {
        const int thousands = number(word.substr(0, word.size() - 1));
        return thousands <= largest_in_k ? thousands * 1024 : 0;
    }
    const int pixels = number(word);
    const bool power_of_two = pixels >= smallest && (pixels & (pixels - 1)) == 0;
    return power_of_two ? pixels : 0;
}

/// True if a new word starts at i.
bool is_boundary(std::string_view name, std::size_t i) {
    const char before = name[i - 1];
    const char here = name[i];
    if (is_digit(before) != is_digit(here)) return true;
    if (is_lower(before) && is_upper(here)) return true;
    return is_upper(before) && is_upper(here) && i + 1 < name.size() && is_lower(name[i + 1]);
}

void add_token(std::string_view name, std::size_t begin, std::size_t end, int chunk,
               std::vector<NameToken>& tokens) {
    tokens.push_back({lower(name.substr(begin, end - begin)), begin, end, chunk});
}

void split_chunk(std::string_view name, std::size_t begin, std::size_t end, int chunk,
                 std::vector<NameToken>& tokens) {
    if (resolution_in(lower(name.substr(begin, end - begin))) > 0) {
        add_token(name, begin, end, chunk, tokens);  // "4K" is one word
        return;
    }
    std::size_t start = begin;
    for (std::size_t i = begin + 1; i < end; ++i)
        if (is_boundary(name.substr(0, end), i)) {
            add_token(name, start, i, chunk, tokens);
            start = i;
        }
    add_token(name, start, end, chunk, tokens);
}

}  // namespace

bool is_number(std::string_view word) {
    return !word.empty() && std::all_of(word.begin(), word.end(), is_digit);
}

const MapWord* find_map_word(std::string_view word) {
    const auto entry = std::find_if(kWords.begin(), kWords.end(),
                                    [&](const MapWord& candidate) { return candidate.word == word; });
    return entry == kWords.end() ? nullptr : &*entry;
}

std::vector<NameToken> tokenize(std::string_view name) {
    std::vector<NameToken> tokens;
    int chunk = 0;
    for (std::size_t begin = 0; begin < name.size(); ++chunk) {
        if (!is_word(name[begin])) {
            ++begin;
            continue;
        }
        const auto last =
            std::find_if_not(name.begin() + static_cast<std::ptrdiff_t>(begin), name.end(), is_word);
        const auto end = static_cast<std::size_t>(last - name.begin());
        split_chunk(name, begin, end, chunk, tokens);
        begin = end;
    }
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        NameToken& token = tokens[i];
        const std::string_view before = i > 0 ? std::string_view(tokens[i - 1].word) : std::string_view();
        const std::string_view after =
            i + 1 < tokens.size() ? std::string_view(tokens[i + 1].word) : std::string_view();
        token.noise = std::find(kNoise.begin(), kNoise.end(), token.word) != kNoise.end() ||
                      resolution_in(token.word) > 0 ||
                      (is_number(token.word) && (before == "lod" || after == "bit")) ||
                      (token.word == "x" && resolution_in(before) > 0 && resolution_in(after) > 0);
    }
    return tokens;
}

NameNoise noise_of(const std::vector<NameToken>& tokens) {
    static constexpr int first_tile = 1001;
    static constexpr int last_tile = 1999;
    NameNoise noise;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const int value = number(tokens[i].word);
        if (const int resolution = resolution_in(tokens[i].word))
            noise.resolution = std::max(noise.resolution, resolution);
        if (i > 0 && tokens[i - 1].word == "lod" && is_number(tokens[i].word)) noise.lod = value;
        if (value >= first_tile && value <= last_tile && i + 1 == tokens.size()) noise.udim_tile = value;
    }
    return noise;
}

}  // namespace patina

#include "renderer/ibl/cache.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <type_traits>
#include <utility>

namespace patina {
namespace {

// One entry: LevelEntry × levels, ExtractedLight × lights, notes, texels of the irradiance, texels of each
// level. Texels are kept as floats: a cached bake is bit for bit the bake, so a picture does not depend on
// the cache.
constexpr EntryKind kKind{
    .magic = {'P', 'a', 't', 'i', 'n', 'a', 'I', 'B'}, .format = 2, .extension = ".patina-ibl"};
enum Count : std::uint8_t { Levels, Lights, NoteBytes, IrradianceSize };  ///< of EntryCounts
constexpr std::uint32_t kMaxCount = 4096;                                 ///< levels, or lights, in one entry
constexpr std::size_t kMostLevels = 64;  ///< an entry that would grow beyond starts anew
constexpr std::uint32_t kMaxNoteBytes = 1 << 20;
constexpr std::uint32_t kMaxFace = 8192;

struct LevelEntry {
    float roughness = 0.0f;
    std::uint32_t size = 0;
};
static_assert(std::is_trivially_copyable_v<ExtractedLight> && sizeof(ExtractedLight) == 28);
static_assert(std::is_trivially_copyable_v<glm::vec3> && sizeof(glm::vec3) == 12);

std::uint64_t cube_texels(std::uint64_t size) { return 6 * size * size; }

bool is_plausible(const EntryCounts& counts) {
    return counts[Levels] <= kMaxCount && counts[Lights] <= kMaxCount && counts[NoteBytes] <= kMaxNoteBytes &&
           counts[IrradianceSize] <= kMaxFace;
}

/// True if the sizes the entries promise add up to exactly what is left of the file.
bool sizes_add_up(const EntryReader& reader, const std::vector<LevelEntry>& entries) {
    const EntryCounts& counts = reader.counts();
    std::uint64_t bytes = counts[Lights] * sizeof(ExtractedLight) + counts[NoteBytes] +
                          cube_texels(counts[IrradianceSize]) * sizeof(glm::vec3);
    for (const LevelEntry& entry : entries) {
        if (entry.size > kMaxFace) return false;
        bytes += cube_texels(entry.size) * sizeof(glm::vec3);
    }
    return bytes == reader.left();
}

CubeMap empty_cube(std::uint32_t size) { return {int(size), std::vector<glm::vec3>(cube_texels(size))}; }

const PrefilteredLevel* find_level(const BakedEnvironment& baked, float roughness) {
    for (const PrefilteredLevel& level : baked.levels)
        if (level.roughness == roughness) return &level;
    return nullptr;
}

}  // namespace

std::string bake_key(std::uint64_t content_hash, glm::ivec2 size_px, const BakeSettings& settings) {
    std::vector<std::uint64_t> words = {std::uint64_t(kBakerVersion),
                                        content_hash,
                                        std::uint64_t(size_px.x),
                                        std::uint64_t(size_px.y),
                                        std::uint64_t(settings.max_face_size),
                                        std::uint64_t(settings.extract_lights)};
    if (!settings.face_sizes.empty())
        for (const float roughness : settings.roughness)
            words.push_back(std::bit_cast<std::uint32_t>(roughness));
    for (const int size : settings.face_sizes) words.push_back(std::uint64_t(size) << 32);
    return entry_key(words);
}

std::string bake_key(const Environment& environment, const BakeSettings& settings) {
    return bake_key(environment.content_hash, {environment.width, environment.height}, settings);
}

std::optional<BakedEnvironment> load_baked(const BakeCache& cache, const std::string& key) {
    std::optional<EntryReader> reader = EntryReader::open(cache, kKind, key);
    if (!reader || !is_plausible(reader->counts())) return std::nullopt;
    const EntryCounts& counts = reader->counts();
    std::vector<LevelEntry> entries(counts[Levels]);
    if (!reader->read(section_of(entries)) || !sizes_add_up(*reader, entries)) return std::nullopt;

    BakedEnvironment baked;
    baked.lights.resize(counts[Lights]);
    std::vector<char> notes(counts[NoteBytes]);
    baked.irradiance = empty_cube(counts[IrradianceSize]);
    bool is_whole = reader->read(section_of(baked.lights)) && reader->read(section_of(notes)) &&
                    reader->read(section_of(baked.irradiance.texels));
    for (const LevelEntry& entry : entries) {
        baked.levels.push_back({entry.roughness, empty_cube(entry.size)});
        is_whole = is_whole && reader->read(section_of(baked.levels.back().cube.texels));
    }
    if (!is_whole || !reader->finish()) return std::nullopt;
    baked.notes = split_texts(notes);
    return baked;
}

std::string save_baked(const BakeCache& cache, const std::string& key, const BakedEnvironment& baked) {
    std::vector<LevelEntry> entries;
    for (const PrefilteredLevel& level : baked.levels)
        entries.push_back({level.roughness, std::uint32_t(level.cube.size)});
    const std::vector<char> notes = joined_texts(baked.notes);
    std::vector<std::span<const std::byte>> sections{section_of(std::as_const(entries)),
                                                     section_of(baked.lights), section_of(notes),
                                                     section_of(baked.irradiance.texels)};
    for (const PrefilteredLevel& level : baked.levels) sections.push_back(section_of(level.cube.texels));
    const EntryCounts counts{std::uint32_t(entries.size()), std::uint32_t(baked.lights.size()),
                             std::uint32_t(notes.size()), std::uint32_t(baked.irradiance.size)};
    return save_entry(cache, kKind, key, counts, sections);
}

bool holds(const BakedEnvironment& entry, const BakeSettings& settings) {
    return (!settings.irradiance || entry.irradiance.size > 0) &&
           std::ranges::all_of(settings.roughness,
                               [&](float roughness) { return find_level(entry, roughness) != nullptr; });
}

BakedEnvironment selected(BakedEnvironment entry, const BakeSettings& settings) {
    assert(holds(entry, settings));
    if (!settings.irradiance) entry.irradiance = {};
    if (std::ranges::equal(entry.levels, settings.roughness, {}, &PrefilteredLevel::roughness)) return entry;
    std::vector<PrefilteredLevel> levels;
    levels.reserve(settings.roughness.size());
    for (const float roughness : settings.roughness) levels.push_back(*find_level(entry, roughness));
    entry.levels = std::move(levels);
    return entry;
}

BakeSettings lacking(const BakedEnvironment& entry, const BakeSettings& settings) {
    if (!settings.face_sizes.empty()) return settings;
    BakeSettings rest = settings;
    std::erase_if(rest.roughness, [&](float roughness) { return find_level(entry, roughness) != nullptr; });
    rest.irradiance = settings.irradiance && entry.irradiance.size == 0;
    return rest;
}

BakedEnvironment merged(BakedEnvironment entry, BakedEnvironment added) {
    BakedEnvironment both = std::move(added);
    if (both.irradiance.size == 0) both.irradiance = std::move(entry.irradiance);
    if (both.lights.empty()) both.lights = std::move(entry.lights);
    for (const std::string& note : entry.notes)
        if (std::find(both.notes.begin(), both.notes.end(), note) == both.notes.end())
            both.notes.push_back(note);
    for (PrefilteredLevel& level : entry.levels)
        if (!find_level(both, level.roughness)) both.levels.push_back(std::move(level));
    std::stable_sort(both.levels.begin(), both.levels.end(),
                     [](const auto& a, const auto& b) { return a.roughness < b.roughness; });
    return both;
}

std::optional<CachedBake> cached_bake(const Environment& environment, const BakeSettings& settings,
                                      const BakeControl& control, const BakeCache& cache) {
    if (settings.roughness.empty() && !settings.irradiance) return CachedBake{.from_disk = true, .note = {}};
    const std::string key = bake_key(environment, settings);
    BakedEnvironment entry = load_baked(cache, key).value_or(BakedEnvironment{});
    if (holds(entry, settings)) {
        control.progress(1.0f);
        return CachedBake{.baked = selected(std::move(entry), settings), .from_disk = true, .note = {}};
    }
    const BakeSettings rest = lacking(entry, settings);
    const std::optional<BakedEnvironment> baked = bake_environment(environment, rest, control);
    if (!baked) return std::nullopt;
    BakedEnvironment whole = merged(std::move(entry), *baked);
    std::string note = save_baked(cache, key, whole.levels.size() <= kMostLevels ? whole : *baked);
    CachedBake result{.levels_baked = int(rest.roughness.size()),
                      .irradiance_baked = rest.irradiance,
                      .note = std::move(note)};
    result.baked = settings.face_sizes.empty() ? selected(std::move(whole), settings) : *baked;
    result.baked.timings = baked->timings;
    return result;
}

}  // namespace patina

#include "renderer/ibl/cache.h"

#include "renderer/core/hash.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <chrono>
#include <fstream>
#include <limits>
#include <random>
#include <system_error>
#include <type_traits>

namespace patina {
namespace {

namespace fs = std::filesystem;

// One entry, in the machine's byte order (marked, so that another machine's file counts as foreign): Header,
// LevelEntry × level_count, ExtractedLight × light_count, notes (each ended by a zero byte), texels of the
// irradiance, texels of each level. Texels are kept as floats: a cached bake is bit for bit the bake, so a
// picture does not depend on the cache.
constexpr std::array<char, 8> kMagic = {'P', 'a', 't', 'i', 'n', 'a', 'I', 'B'};
constexpr std::uint32_t kFormat = 2;
constexpr std::uint32_t kByteOrder = 0x01020304;
constexpr std::uint32_t kMaxCount = 4096;  ///< levels, or lights, in one entry
constexpr std::size_t kMostLevels = 64;    ///< an entry that would grow beyond starts anew
constexpr std::uint32_t kMaxNoteBytes = 1 << 20;
constexpr std::uint32_t kMaxFace = 8192;
constexpr std::size_t kKeyLength = 32;
constexpr const char* kExtension = ".patina-ibl";
constexpr const char* kTemporary = ".patina-tmp";

struct Header {
    std::array<char, 8> magic = kMagic;
    std::uint32_t format = kFormat;
    std::uint32_t byte_order = kByteOrder;
    std::array<char, kKeyLength> key{};
    std::uint64_t file_bytes = 0;
    std::uint64_t payload_hash = 0;  ///< of everything after the header
    std::uint32_t level_count = 0;
    std::uint32_t light_count = 0;
    std::uint32_t note_bytes = 0;
    std::uint32_t irradiance_size = 0;
    std::uint64_t header_hash = 0;  ///< of the fields above
};
struct LevelEntry {
    float roughness = 0.0f;
    std::uint32_t size = 0;
};
static_assert(std::is_trivially_copyable_v<Header> && sizeof(Header) == 88);
static_assert(std::is_trivially_copyable_v<ExtractedLight> && sizeof(ExtractedLight) == 28);
static_assert(std::is_trivially_copyable_v<glm::vec3> && sizeof(glm::vec3) == 12);

std::uint64_t hash_of(const void* data, std::size_t size, std::uint64_t seed = 0) {
    return hash_bytes({static_cast<const std::byte*>(data), size}, seed);
}

std::uint64_t header_hash(const Header& header) { return hash_of(&header, offsetof(Header, header_hash)); }

std::uint64_t cube_texels(std::uint64_t size) { return 6 * size * size; }

/// A section of the file, wherever it lives in memory.
struct Section {
    void* data;
    std::size_t bytes;
};
template <class T>
Section section(std::vector<T>& values) {
    return {values.data(), values.size() * sizeof(T)};
}

/// What stands between header and texels, and the texels' place in the result.
struct Body {
    std::vector<LevelEntry> entries;
    std::vector<char> notes;
};
std::vector<Section> sections(Body& body, BakedEnvironment& baked) {
    std::vector<Section> all = {section(body.entries), section(baked.lights), section(body.notes),
                                section(baked.irradiance.texels)};
    for (PrefilteredLevel& level : baked.levels) all.push_back(section(level.cube.texels));
    return all;
}

fs::path entry_path(const BakeCache& cache, const std::string& key) {
    return cache.folder / (key + kExtension);
}

bool is_plausible(const Header& header, const std::string& key, std::uint64_t actual_bytes) {
    return header.magic == kMagic && header.format == kFormat && header.byte_order == kByteOrder &&
           header.header_hash == header_hash(header) && header.file_bytes == actual_bytes &&
           key == std::string(header.key.data(), kKeyLength) && header.level_count <= kMaxCount &&
           header.light_count <= kMaxCount && header.note_bytes <= kMaxNoteBytes &&
           header.irradiance_size <= kMaxFace;
}

/// Reads into memory that is already sized, and continues the hash.
bool read_section(std::ifstream& in, Section part, std::uint64_t& hash) {
    if (!in.read(static_cast<char*>(part.data), std::streamsize(part.bytes))) return false;
    hash = hash_of(part.data, part.bytes, hash);
    return true;
}

/// True if the sizes the entries promise add up to exactly the file's size. Nothing large is allocated before
/// this holds.
bool sizes_add_up(const Header& header, const std::vector<LevelEntry>& entries) {
    std::uint64_t bytes = sizeof(Header) + entries.size() * sizeof(LevelEntry) +
                          header.light_count * sizeof(ExtractedLight) + header.note_bytes +
                          cube_texels(header.irradiance_size) * sizeof(glm::vec3);
    for (const LevelEntry& entry : entries) {
        if (entry.size > kMaxFace) return false;
        bytes += cube_texels(entry.size) * sizeof(glm::vec3);
    }
    return bytes == header.file_bytes;
}

void split_notes(const std::vector<char>& bytes, std::vector<std::string>& notes) {
    for (auto begin = bytes.begin(); begin != bytes.end();) {
        const auto end = std::find(begin, bytes.end(), '\0');
        notes.emplace_back(begin, end);
        begin = end == bytes.end() ? end : end + 1;
    }
}

std::string hex(std::uint64_t value) {
    std::string digits(16, '0');
    for (int i = 0; i < 16; ++i) digits[i] = "0123456789abcdef"[(value >> (60 - 4 * i)) & 15];
    return digits;
}

Header make_header(const std::string& key, Body& body, BakedEnvironment& baked) {
    Header header;
    assert(key.size() == kKeyLength);
    std::copy(key.begin(), key.end(), header.key.begin());
    header.level_count = std::uint32_t(body.entries.size());
    header.light_count = std::uint32_t(baked.lights.size());
    header.note_bytes = std::uint32_t(body.notes.size());
    header.irradiance_size = std::uint32_t(baked.irradiance.size);
    header.file_bytes = sizeof(Header);
    for (const Section& part : sections(body, baked)) {
        header.file_bytes += part.bytes;
        header.payload_hash = hash_of(part.data, part.bytes, header.payload_hash);
    }
    header.header_hash = header_hash(header);
    return header;
}

bool write_file(const fs::path& file, const Header& header, const std::vector<Section>& parts) {
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(&header), sizeof(header));
    for (const Section& part : parts)
        out.write(static_cast<const char*>(part.data), std::streamsize(part.bytes));
    out.close();
    return !out.fail();
}

/// Oldest entries out until the rest fits, and what writers that died left behind. Other processes may do the
/// same at the same time: what is already gone is no error.
void trim(const BakeCache& cache, const fs::path& keep) {
    struct Entry {
        fs::path path;
        fs::file_time_type time;
        std::uint64_t bytes;
    };
    std::error_code error;
    std::vector<Entry> entries;
    std::uint64_t total = 0;
    const auto now = fs::file_time_type::clock::now();
    for (fs::directory_iterator it(cache.folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code gone;
        const Entry entry{it->path(), it->last_write_time(gone), it->file_size(gone)};
        if (gone) continue;
        if (entry.path.extension() == kTemporary && now - entry.time > std::chrono::hours(1))
            fs::remove(entry.path, gone);
        if (entry.path.extension() != kExtension) continue;
        total += entry.bytes;
        if (entry.path != keep) entries.push_back(entry);
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.time < b.time; });
    for (const Entry& entry : entries) {
        if (total <= cache.max_bytes) break;
        std::error_code gone;
        fs::remove(entry.path, gone);
        total -= entry.bytes;
    }
}

const PrefilteredLevel* find_level(const BakedEnvironment& baked, float roughness) {
    for (const PrefilteredLevel& level : baked.levels)
        if (level.roughness == roughness) return &level;
    return nullptr;
}

std::string cannot_keep(const BakeCache& cache, const std::string& why) {
    return "The baked light could not be kept in " + cache.folder.string() + " (" + why +
           "); it will be computed again next time.";
}

}  // namespace

std::string bake_key(const Environment& environment, const BakeSettings& settings) {
    std::vector<std::uint64_t> words = {
        std::uint64_t(kBakerVersion),          environment.content_hash,
        std::uint64_t(environment.width),      std::uint64_t(environment.height),
        std::uint64_t(settings.max_face_size), std::uint64_t(settings.extract_lights)};
    if (!settings.face_sizes.empty())
        for (const float roughness : settings.roughness)
            words.push_back(std::bit_cast<std::uint32_t>(roughness));
    for (const int size : settings.face_sizes) words.push_back(std::uint64_t(size) << 32);
    const std::size_t bytes = words.size() * sizeof(words[0]);
    return hex(hash_of(words.data(), bytes, 1)) + hex(hash_of(words.data(), bytes, 2));
}

std::optional<BakedEnvironment> load_baked(const BakeCache& cache, const std::string& key) {
    const fs::path path = entry_path(cache, key);
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    if (!in) return std::nullopt;
    const std::streamoff end = in.tellg();
    if (end < std::streamoff(sizeof(Header))) return std::nullopt;
    in.seekg(0);

    Header header;
    if (!in.read(reinterpret_cast<char*>(&header), sizeof(header)) ||
        !is_plausible(header, key, std::uint64_t(end)))
        return std::nullopt;
    std::uint64_t hash = 0;
    Body body;
    body.entries.resize(header.level_count);
    if (!read_section(in, section(body.entries), hash) || !sizes_add_up(header, body.entries))
        return std::nullopt;

    BakedEnvironment baked;
    baked.lights.resize(header.light_count);
    body.notes.resize(header.note_bytes);
    baked.irradiance = {int(header.irradiance_size),
                        std::vector<glm::vec3>(cube_texels(header.irradiance_size))};
    for (const LevelEntry& entry : body.entries)
        baked.levels.push_back(
            {entry.roughness, {int(entry.size), std::vector<glm::vec3>(cube_texels(entry.size))}});
    const std::vector<Section> parts = sections(body, baked);
    for (std::size_t i = 1; i < parts.size(); ++i)
        if (!read_section(in, parts[i], hash)) return std::nullopt;
    if (hash != header.payload_hash) return std::nullopt;
    split_notes(body.notes, baked.notes);

    std::error_code ignored;  // the order of removal is by last use, where the folder lets us say so
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
    return baked;
}

std::string save_baked(const BakeCache& cache, const std::string& key, const BakedEnvironment& baked) {
    BakedEnvironment& source =
        const_cast<BakedEnvironment&>(baked);  // NOLINT: sections() serves reading too; only read here
    Body body;
    for (const PrefilteredLevel& level : baked.levels)
        body.entries.push_back({level.roughness, std::uint32_t(level.cube.size)});
    for (const std::string& note : baked.notes) {
        body.notes.insert(body.notes.end(), note.begin(), note.end());
        body.notes.push_back('\0');
    }
    const Header header = make_header(key, body, source);
    if (header.file_bytes > cache.max_bytes)
        return cannot_keep(cache, "it is larger than the cache may grow");

    std::error_code error;
    fs::create_directories(cache.folder, error);
    if (error) return cannot_keep(cache, error.message());
    const fs::path target = entry_path(cache, key);
    std::random_device random;
    const fs::path temporary =
        cache.folder / (key + "." + hex((std::uint64_t(random()) << 32) | random()) + kTemporary);
    if (!write_file(temporary, header, sections(body, source))) {
        fs::remove(temporary, error);
        return cannot_keep(cache, "it cannot be written");
    }
    fs::rename(temporary, target, error);
    if (error) {
        const std::string why = error.message();
        fs::remove(temporary, error);
        return cannot_keep(cache, why);
    }
    trim(cache, target);
    return {};
}

std::optional<BakedEnvironment> selected(const BakedEnvironment& entry, const BakeSettings& settings) {
    BakedEnvironment result{.irradiance = {}, .lights = entry.lights, .notes = entry.notes};
    if (settings.irradiance) {
        if (entry.irradiance.size == 0) return std::nullopt;
        result.irradiance = entry.irradiance;
    }
    for (const float roughness : settings.roughness) {
        const PrefilteredLevel* level = find_level(entry, roughness);
        if (!level) return std::nullopt;
        result.levels.push_back(*level);
    }
    return result;
}

BakeSettings lacking(const BakedEnvironment& entry, const BakeSettings& settings) {
    if (!settings.face_sizes.empty()) return settings;
    BakeSettings rest = settings;
    std::erase_if(rest.roughness, [&](float roughness) { return find_level(entry, roughness) != nullptr; });
    rest.irradiance = settings.irradiance && entry.irradiance.size == 0;
    return rest;
}

BakedEnvironment merged(const BakedEnvironment& entry, const BakedEnvironment& added) {
    BakedEnvironment both = added;
    if (both.irradiance.size == 0) both.irradiance = entry.irradiance;
    if (both.lights.empty()) both.lights = entry.lights;
    for (const std::string& note : entry.notes)
        if (std::find(both.notes.begin(), both.notes.end(), note) == both.notes.end())
            both.notes.push_back(note);
    for (const PrefilteredLevel& level : entry.levels)
        if (!find_level(added, level.roughness)) both.levels.push_back(level);
    std::stable_sort(both.levels.begin(), both.levels.end(),
                     [](const auto& a, const auto& b) { return a.roughness < b.roughness; });
    return both;
}

std::optional<CachedBake> cached_bake(const Environment& environment, const BakeSettings& settings,
                                      const BakeControl& control, const BakeCache& cache) {
    if (settings.roughness.empty() && !settings.irradiance) return CachedBake{.from_disk = true, .note = {}};
    const std::string key = bake_key(environment, settings);
    const BakedEnvironment entry = load_baked(cache, key).value_or(BakedEnvironment{});
    if (std::optional<BakedEnvironment> found = selected(entry, settings)) {
        control.progress(1.0f);
        return CachedBake{.baked = std::move(*found), .from_disk = true, .note = {}};
    }
    const BakeSettings rest = lacking(entry, settings);
    const std::optional<BakedEnvironment> baked = bake_environment(environment, rest, control);
    if (!baked) return std::nullopt;
    BakedEnvironment whole = merged(entry, *baked);
    std::string note = save_baked(cache, key, whole.levels.size() <= kMostLevels ? whole : *baked);
    CachedBake result{.levels_baked = int(rest.roughness.size()),
                      .irradiance_baked = rest.irradiance,
                      .note = std::move(note)};
    result.baked = settings.face_sizes.empty() ? *selected(whole, settings) : *baked;
    result.baked.timings = baked->timings;
    return result;
}

}  // namespace patina

#include "app/kept_environment.h"

#include "renderer/core/hash.h"
#include "renderer/ibl/bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <type_traits>
#include <utility>

namespace patina {

namespace {

// One entry: Numbers, ExtractedLight × lights, texts (the title, then the notes), half floats of each level.
// A level's size follows from the one before.
constexpr EntryKind kKind{
    .magic = {'P', 'a', 't', 'i', 'n', 'a', 'E', 'V'}, .format = 1, .extension = ".patina-environment"};
enum Count : std::uint8_t { Lights, TextBytes, Width, Height };  ///< of EntryCounts; of the first level
constexpr std::uint32_t kMaxLights = 4096;
constexpr std::uint32_t kMaxTextBytes = 1 << 20;
constexpr std::uint64_t kShareOfCache = 4;  ///< one entry may have a 4th of it

struct Numbers {
    std::uint64_t content_hash = 0;
    std::int32_t width = 0, height = 0;
    float max_radiance = 0.0f;
    glm::vec3 mean{0.0f};
    std::int32_t exponent = 0;
    std::uint32_t unused = 0;
};
static_assert(std::is_trivially_copyable_v<Numbers> && sizeof(Numbers) == 40);
static_assert(std::is_trivially_copyable_v<ExtractedLight> && sizeof(ExtractedLight) == 28);

/// Empty levels of a panorama, each half the one before, to a single texel.
std::vector<PanoramaLevels::Level> level_sizes(int width, int height) {
    std::vector<PanoramaLevels::Level> levels{{width, height, {}}};
    while (width > 1 || height > 1) {
        width = std::max(width / 2, 1);
        height = std::max(height / 2, 1);
        levels.push_back({width, height, {}});
    }
    return levels;
}

std::uint64_t halves_in(const PanoramaLevels::Level& level) {
    return 4 * std::uint64_t(level.width) * std::uint64_t(level.height);
}

std::uint64_t bytes_in(const std::vector<PanoramaLevels::Level>& levels) {
    std::uint64_t halves = 0;
    for (const PanoramaLevels::Level& level : levels) halves += halves_in(level);
    return halves * sizeof(std::uint16_t);
}

bool is_plausible(const EntryCounts& counts) {
    const auto is_side = [](std::uint32_t side) { return side >= 1 && side <= kMaxPanoramaWidth; };
    return counts[Lights] <= kMaxLights && counts[TextBytes] <= kMaxTextBytes && is_side(counts[Width]) &&
           is_side(counts[Height]);
}

/// Rows share their solid angle, 2π (cos θ₀ − cos θ₁).
glm::vec3 mean_radiance(const Environment& environment) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < environment.height; ++y) {
        glm::dvec3 row(0.0);
        for (int x = 0; x < environment.width; ++x)
            row += glm::dvec3(environment.radiance[std::size_t(y) * environment.width + x]);
        const double upper = std::cos(std::numbers::pi * y / environment.height);
        const double lower = std::cos(std::numbers::pi * (y + 1) / environment.height);
        sum += row * (0.5 * (upper - lower) / environment.width);
    }
    return glm::vec3(sum);
}

float largest_radiance(const Environment& environment) {
    float largest = 0.0f;
    for (const glm::vec3& radiance : environment.radiance)
        largest = std::max({largest, radiance.x, radiance.y, radiance.z});
    return largest;
}

}  // namespace

EnvironmentFacts facts_of(const Environment& environment) {
    return {.title = environment.title,
            .width = environment.width,
            .height = environment.height,
            .max_radiance = largest_radiance(environment),
            .mean = mean_radiance(environment),
            .content_hash = environment.content_hash,
            .notes = environment.notes};
}

std::string kept_key(const std::string& id, std::uint64_t fingerprint) {
    const std::array<std::uint64_t, 5> words{std::uint64_t(kEnvironmentVersion),
                                             std::uint64_t(kPanoramaVersion), std::uint64_t(kBakerVersion),
                                             hash_bytes(std::as_bytes(std::span(id))), fingerprint};
    return entry_key(words);
}

std::optional<KeptEnvironment> load_kept(const BakeCache& cache, const std::string& key) {
    std::optional<EntryReader> reader = EntryReader::open(cache, kKind, key);
    if (!reader || !is_plausible(reader->counts())) return std::nullopt;
    const EntryCounts& counts = reader->counts();
    KeptEnvironment kept;
    kept.panorama.levels = level_sizes(int(counts[Width]), int(counts[Height]));
    if (reader->left() != sizeof(Numbers) + counts[Lights] * sizeof(ExtractedLight) + counts[TextBytes] +
                              bytes_in(kept.panorama.levels))
        return std::nullopt;
    Numbers numbers;
    std::vector<char> texts(counts[TextBytes]);
    kept.panorama.lights.resize(counts[Lights]);
    bool is_whole = reader->read(std::as_writable_bytes(std::span(&numbers, 1))) &&
                    reader->read(section_of(kept.panorama.lights)) && reader->read(section_of(texts));
    for (PanoramaLevels::Level& level : kept.panorama.levels) {
        level.rgba.resize(halves_in(level));
        is_whole = is_whole && reader->read(section_of(level.rgba));
    }
    if (!is_whole || !reader->finish()) return std::nullopt;
    std::vector<std::string> names = split_texts(texts);
    if (names.empty()) return std::nullopt;
    kept.panorama.exponent = numbers.exponent;
    kept.facts = {.title = std::move(names.front()),
                  .width = numbers.width,
                  .height = numbers.height,
                  .max_radiance = numbers.max_radiance,
                  .mean = numbers.mean,
                  .content_hash = numbers.content_hash,
                  .notes = {names.begin() + 1, names.end()}};
    return kept;
}

std::string save_kept(const BakeCache& cache, const std::string& key, const EnvironmentFacts& facts,
                      const PanoramaLevels& panorama) {
    if (kShareOfCache * bytes_in(panorama.levels) > cache.max_bytes)
        return facts.title + " is too large to be kept ready in the cache; it is decoded again next time.";
    const Numbers numbers{.content_hash = facts.content_hash,
                          .width = facts.width,
                          .height = facts.height,
                          .max_radiance = facts.max_radiance,
                          .mean = facts.mean,
                          .exponent = panorama.exponent};
    std::vector<std::string> names{facts.title};
    names.insert(names.end(), facts.notes.begin(), facts.notes.end());
    const std::vector<char> texts = joined_texts(names);
    std::vector<std::span<const std::byte>> sections{std::as_bytes(std::span(&numbers, 1)),
                                                     section_of(panorama.lights), section_of(texts)};
    for (const PanoramaLevels::Level& level : panorama.levels) sections.push_back(section_of(level.rgba));
    const EntryCounts counts{std::uint32_t(panorama.lights.size()), std::uint32_t(texts.size()),
                             std::uint32_t(panorama.levels.front().width),
                             std::uint32_t(panorama.levels.front().height)};
    return save_entry(cache, kKind, key, counts, sections);
}

}  // namespace patina

#include "materials/map_naming.h"

#include "materials/map_words.h"
#include "materials/params.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

namespace patina {

namespace {

constexpr std::array<std::string_view, 9> kPictures{"png", "jpg", "jpeg", "tif", "tiff",
                                                    "tga", "bmp", "exr",  "hdr"};

struct MapUse {
    MapSlot slot;
    Channel channel = Channel::R;
    bool invert = false;
};

/// What one name says, before it is weighed against the others.
struct Reading {
    const std::string* file = nullptr;
    std::string folder, name, extension;  ///< extension in lower case
    std::vector<NameToken> tokens;
    const MapWord* word = nullptr;
    std::size_t first = 0, last = 0;  ///< the word's tokens
    const MapWord* packed = nullptr;  ///< the two words before and at `last`, read as one packed map
    std::optional<NormalConvention> convention;
    std::string set;    ///< folder and words before the word, without noise: what the files of one set share
    std::string whole;  ///< the same with all words
    bool names_set_only = false;
    std::vector<MapUse> uses;
};

struct Candidate {
    const Reading* reading;
    MapUse use;
    int slots_in_set = 0;
};

template <class Text>
bool contains(std::initializer_list<Text> list, const Text& text) {
    return std::find(list.begin(), list.end(), text) != list.end();
}

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

std::string joined(const std::vector<NameToken>& tokens, std::size_t first, std::size_t last) {
    std::string text;
    for (std::size_t i = first; i <= last; ++i) text += tokens[i].word;
    return text;
}

/// True if nothing but noise and numbers follows, and the token is a whole part of the name.
bool is_last_letter(const std::vector<NameToken>& tokens, std::size_t at) {
    for (std::size_t i = at + 1; i < tokens.size(); ++i)
        if (tokens[i].chunk == tokens[at].chunk || !(tokens[i].noise || is_number(tokens[i].word)))
            return false;
    return at == 0 || tokens[at - 1].chunk != tokens[at].chunk;
}

/// The word that ends at a token: the longest that has an entry. Two words that could be a packed map are
/// only remembered.
bool find_word_at(Reading& reading, std::size_t last) {
    static constexpr std::size_t most_tokens = 4;
    const auto& tokens = reading.tokens;
    for (std::size_t count = std::min(most_tokens, last + 1); count > 0; --count) {
        const std::size_t first = last + 1 - count;
        if (count == 1 && tokens[last].noise) return false;
        const MapWord* word = find_map_word(joined(tokens, first, last));
        if (!word || (word->rank == kLetterRank && (count > 1 || !is_last_letter(tokens, last)))) continue;
        if (word->role == MapRole::Packed && count == 2 && find_map_word(tokens[last].word)) {
            reading.packed = word;
            continue;
        }
        reading.word = word;
        reading.first = first;
        reading.last = last;
        return true;
    }
    return false;
}

std::optional<NormalConvention> convention_named(const std::string& word) {
    if (contains<std::string>({"gl", "ogl", "opengl"}, word)) return NormalConvention::OpenGl;
    if (contains<std::string>({"dx", "directx", "d3d"}, word)) return NormalConvention::DirectX;
    return std::nullopt;
}

/// Looks for "gl", "OpenGL", "dx", "DirectX" inside, after and before the word for normals.
void find_convention(Reading& reading) {
    const auto& tokens = reading.tokens;
    if (reading.word->word.ends_with("gl")) reading.convention = NormalConvention::OpenGl;
    if (reading.word->word.ends_with("dx") || reading.word->word.ends_with("directx"))
        reading.convention = NormalConvention::DirectX;
    for (std::size_t count = 2; count > 0 && !reading.convention; --count) {
        if (reading.last + count < tokens.size())
            reading.convention = convention_named(joined(tokens, reading.last + 1, reading.last + count));
        if (reading.convention) {
            reading.last += count;
        } else if (reading.first >= count) {
            reading.convention = convention_named(joined(tokens, reading.first - count, reading.first - 1));
            if (reading.convention) reading.first -= count;
        }
    }
}

std::string set_key(const Reading& reading, std::size_t end) {
    std::string key = reading.folder + '\n';
    for (std::size_t i = 0; i < end; ++i)
        if (!reading.tokens[i].noise) key += reading.tokens[i].word + ' ';
    return key;
}

Reading read_name(const std::string& file) {
    Reading reading;
    reading.file = &file;
    const std::size_t slash = file.find_last_of("/\\");
    if (slash != std::string::npos) reading.folder = file.substr(0, slash);
    reading.name = slash == std::string::npos ? file : file.substr(slash + 1);
    const std::size_t dot = reading.name.rfind('.');
    if (dot != std::string::npos) {
        reading.extension = lower(reading.name.substr(dot + 1));
        reading.name.resize(dot);
    }
    reading.tokens = tokenize(reading.name);
    for (std::size_t i = reading.tokens.size(); i-- > 0;)
        if (find_word_at(reading, i)) break;
    if (reading.word && reading.word->role == MapRole::Normal) find_convention(reading);
    reading.whole = set_key(reading, reading.tokens.size());
    reading.set = reading.word ? set_key(reading, reading.first) : reading.whole;
    return reading;
}

bool is_picture(const Reading& reading) {
    return std::find(kPictures.begin(), kPictures.end(), reading.extension) != kPictures.end();
}

bool has_set_name(const std::string& key) { return !key.ends_with('\n'); }

/// How many other files name a kind of map after exactly these words.
std::size_t others_in_set(const std::vector<Reading>& readings, const Reading& self, const std::string& key) {
    return static_cast<std::size_t>(
        std::count_if(readings.begin(), readings.end(), [&](const Reading& other) {
            return &other != &self && other.word && other.word->rank != kLetterRank && other.set == key;
        }));
}

/// "metal_roughness" is the roughness of a metal if the set is called metal, or if nothing speaks for a
/// packed map.
void settle_packed(std::vector<Reading>& readings) {
    std::vector<const Reading*> packed;
    for (const Reading& reading : readings) {
        if (!reading.packed || !reading.word) continue;
        const bool set_name = others_in_set(readings, reading, reading.set) > 0;
        const NameToken& before = reading.tokens[reading.last - 1];
        const bool one_part = before.chunk == reading.tokens[reading.last].chunk;
        const bool material = contains<std::string>({"metal", "metall", "specular"}, before.word);
        if (!set_name && (one_part || !material)) packed.push_back(&reading);
    }
    for (Reading& reading : readings)
        if (std::find(packed.begin(), packed.end(), &reading) != packed.end()) {
            reading.word = reading.packed;
            reading.first = reading.last - 1;
            reading.set = set_key(reading, reading.first);
        }
}

/// "Metal014.png" beside "Metal014_Color.png" shows the set; in a set without a colour map it is the colour.
void settle_set_pictures(std::vector<Reading>& readings) {
    static constexpr std::size_t a_set = 2;
    std::vector<Reading*> found;
    for (Reading& reading : readings) {
        if (is_picture(reading) && has_set_name(reading.whole) &&
            others_in_set(readings, reading, reading.whole) >= a_set)
            found.push_back(&reading);
    }
    for (Reading* reading : found) {
        const bool has_color = std::any_of(readings.begin(), readings.end(), [&](const Reading& other) {
            return &other != reading && other.word && other.word->role == MapRole::Albedo &&
                   other.set == reading->whole;
        });
        reading->names_set_only = true;
        reading->word = find_map_word(has_color ? "preview" : "base");
        reading->first = reading->tokens.size();
        reading->set = reading->whole;
    }
}

std::vector<MapUse> packed_uses(std::string_view layout) {
    std::vector<MapUse> uses;
    for (std::size_t i = 0; i < layout.size(); ++i) {
        const auto channel = static_cast<Channel>(i);
        if (layout[i] == 'o') uses.push_back({MapSlot::Ao, channel});
        if (layout[i] == 'r') uses.push_back({MapSlot::Roughness, channel});
        if (layout[i] == 's') uses.push_back({MapSlot::Roughness, channel, true});
        if (layout[i] == 'm') uses.push_back({MapSlot::Metallic, channel});
    }
    return uses;
}

std::vector<MapUse> uses_of(const MapWord& word) {
    switch (word.role) {
        case MapRole::Albedo:
            return {{MapSlot::Albedo}};
        case MapRole::Roughness:
            return {{MapSlot::Roughness}};
        case MapRole::Glossiness:
            return {{MapSlot::Roughness, Channel::R, true}};
        case MapRole::Metallic:
            return {{MapSlot::Metallic}};
        case MapRole::Ao:
            return {{MapSlot::Ao}};
        case MapRole::Normal:
            return {{MapSlot::Normal}};
        case MapRole::Emission:
            return {{MapSlot::Emission}};
        case MapRole::Packed:
            return packed_uses(word.detail);
        case MapRole::Unused:
        case MapRole::Preview:
            break;
    }
    return {};
}

std::string quoted(const std::string& text) { return "'" + text + "'"; }
std::string file_name(const Reading& reading) {
    return quoted(reading.name + (reading.extension.empty() ? "" : "." + reading.extension));
}
std::string word_in_name(const Reading& reading) {
    const std::size_t begin = reading.tokens[reading.first].begin;
    const std::string word = quoted(reading.name.substr(begin, reading.tokens[reading.last].end - begin));
    return reading.word->rank == kLetterRank ? "by custom the last letter " + word : word;
}

bool is_float(const Reading& reading) { return reading.extension == "exr" || reading.extension == "hdr"; }
bool says_linear(const Reading& reading) {
    return std::any_of(reading.tokens.begin(), reading.tokens.end(),
                       [](const NameToken& token) { return token.word == "linear" || token.word == "lin"; });
}

std::string packed_reason(const Reading& reading, const MapUse& use) {
    static constexpr std::array names{"red", "green", "blue", "alpha"};
    const std::string channel = names[static_cast<std::size_t>(use.channel)];
    return word_in_name(reading) + " packs several maps: " + channel + " is " +
           (use.invert ? "smoothness, so it is inverted to roughness"
                       : lower(std::string(slot_row(use.slot).label)));
}

std::string normal_reason(const Reading& reading) {
    const std::string word = word_in_name(reading);
    if (!reading.convention)
        return word +
               " names normals without a convention: OpenGL is assumed; switch it if bumps look like dents";
    if (*reading.convention == NormalConvention::DirectX)
        return word + " names DirectX normals: their green is flipped when read";
    return word + " names OpenGL normals";
}

/// Without its full stop.
std::string reason_of(const Reading& reading, const MapUse& use) {
    const std::string slot = lower(std::string(slot_row(use.slot).label));
    if (reading.names_set_only)
        return "carries only the name of its set, which has no other colour map: taken as albedo";
    if (!reading.word) return "the only picture, and its name says nothing: taken as albedo";
    if (reading.word->role == MapRole::Packed) return packed_reason(reading, use);
    std::string reason = word_in_name(reading) + " names " + slot;
    if (reading.word->role == MapRole::Normal) reason = normal_reason(reading);
    if (reading.word->role == MapRole::Glossiness)
        reason = word_in_name(reading) + " names glossiness, so it is inverted to roughness";
    const bool color = use.slot == MapSlot::Albedo || use.slot == MapSlot::Emission;
    if (color && is_float(reading))
        reason += "; float files hold linear light";
    else if (color && says_linear(reading))
        reason += "; the name says linear";
    return reason;
}

Confidence confidence_of(const Reading& reading) {
    if (!reading.word || reading.names_set_only || reading.word->rank == kLetterRank)
        return Confidence::Guess;
    const bool unstated = reading.word->role == MapRole::Normal && !reading.convention;
    return unstated || reading.packed || reading.word->word == "base" ? Confidence::Likely : Confidence::Sure;
}

struct Preference {
    int (*cost)(const Candidate&);  ///< the lower wins
    std::string_view why;
};
constexpr std::array kPreferences{
    Preference{
        [](const Candidate& c) { return static_cast<int>(confidence_of(*c.reading) == Confidence::Guess); },
        "its name is clearer"},
    Preference{[](const Candidate& c) { return -c.slots_in_set; }, "it belongs to the fuller set"},
    Preference{[](const Candidate& c) {
                   if (c.use.slot != MapSlot::Normal || !c.reading->convention) return 1;
                   return *c.reading->convention == NormalConvention::OpenGl ? 0 : 2;
               },
               "OpenGL normals are preferred to DirectX ones"},
    Preference{[](const Candidate& c) {
                   return static_cast<int>(c.reading->word && c.reading->word->role == MapRole::Packed);
               },
               "a file of its own needs no channel and shares no JPEG colour with other maps"},
    Preference{[](const Candidate& c) { return static_cast<int>(c.use.invert); },
               "roughness needs no inversion"},
    Preference{[](const Candidate& c) { return c.reading->word ? c.reading->word->rank : kLetterRank; },
               "its word is more exact"},
    Preference{[](const Candidate& c) { return noise_of(c.reading->tokens).lod; },
               "it is the finer level of detail"},
    Preference{[](const Candidate& c) { return -noise_of(c.reading->tokens).resolution; },
               "it has more pixels"},
    Preference{[](const Candidate& c) { return noise_of(c.reading->tokens).udim_tile; },
               "only the first UDIM tile is used"},
    Preference{[](const Candidate& c) { return static_cast<int>(c.reading->extension.starts_with("jp")); },
               "it is stored without loss"},
};

/// Why a is taken rather than b; empty if b is to be taken.
std::string_view why_better(const Candidate& a, const Candidate& b) {
    for (const Preference& preference : kPreferences) {
        const int difference = preference.cost(a) - preference.cost(b);
        if (difference != 0) return difference < 0 ? preference.why : std::string_view();
    }
    return *a.reading->file < *b.reading->file ? "it comes first in the alphabet" : std::string_view();
}

std::vector<Candidate> candidates_of(const std::vector<Reading>& readings) {
    std::map<std::string_view, std::set<MapSlot>> slots;
    for (const Reading& reading : readings)
        for (const MapUse& use : reading.uses) slots[reading.set].insert(use.slot);
    std::vector<Candidate> candidates;
    for (const Reading& reading : readings)
        for (const MapUse& use : reading.uses)
            candidates.push_back({&reading, use, static_cast<int>(slots[reading.set].size())});
    return candidates;
}

ImportRow row_of(const Candidate& candidate) {
    const Reading& reading = *candidate.reading;
    ImportRow row;
    row.file = *reading.file;
    row.fits = candidate.use.slot;
    row.channel = candidate.use.channel;
    row.invert = candidate.use.invert;
    row.color_space = is_float(reading) || says_linear(reading) ? ColorSpace::Linear : ColorSpace::Srgb;
    row.convention = reading.convention.value_or(NormalConvention::OpenGl);
    row.confidence = confidence_of(reading);
    row.reason = reason_of(reading, candidate.use);
    return row;
}

void add_rows_for_slot(const std::vector<Candidate>& candidates, MapSlot slot, ImportProposal& proposal) {
    static constexpr std::size_t most_named = 2;
    std::vector<const Candidate*> rivals;
    for (const Candidate& candidate : candidates)
        if (candidate.use.slot == slot) rivals.push_back(&candidate);
    if (rivals.empty()) return;
    const auto winner = std::min_element(
        rivals.begin(), rivals.end(),
        [](const Candidate* a, const Candidate* b) { return a != b && !why_better(*a, *b).empty(); });
    std::rotate(rivals.begin(), winner, winner + 1);
    std::vector<ImportRow> rows;
    rows.reserve(rivals.size());
    for (const Candidate* rival : rivals) rows.push_back(row_of(*rival));
    rows[0].slot = slot;
    for (std::size_t i = 1; i < rivals.size(); ++i) {
        const std::string_view better = why_better(*rivals[0], *rivals[i]);
        const std::string why(better.empty() ? "it was named first" : better);
        if (i <= most_named)
            rows[0].reason += "; preferred to " + file_name(*rivals[i]->reading) + ": " + why;
        rows[i].reason += ", but " + file_name(*rivals[0]->reading) + " is taken: " + why;
    }
    if (rivals.size() > most_named + 1)
        rows[0].reason += "; and to " + std::to_string(rivals.size() - 1 - most_named) + " more";
    for (ImportRow& row : rows) {
        row.reason += ".";
        proposal.rows.push_back(std::move(row));
    }
}

ImportRow unused_row(const Reading& reading) {
    ImportRow row;
    row.file = *reading.file;
    if (!is_picture(reading))
        row.reason = "Not a picture that can be a map (PNG, JPEG, TIFF, TGA, BMP, EXR, HDR).";
    else if (!reading.word)
        row.reason = "Its name names no kind of map; choose a slot if it is one.";
    else if (reading.names_set_only)
        row.reason = "Carries only the name of its set: taken as the vendor's preview picture.";
    else if (reading.word->role == MapRole::Preview)
        row.reason = word_in_name(reading) + " marks a preview picture, not a map.";
    else
        row.reason = word_in_name(reading) + " " + std::string(reading.word->detail) + ".";
    return row;
}

/// What the files' names share before the word, else their folder.
std::string set_name(const Reading& reading) {
    std::string name;
    std::size_t end = reading.word && !reading.names_set_only ? reading.first : 0;
    while (end > 0 && reading.tokens[end - 1].noise) --end;
    if (end > 0)
        name = reading.name.substr(reading.tokens[0].begin,
                                   reading.tokens[end - 1].end - reading.tokens[0].begin);
    else if (reading.names_set_only)
        name = reading.name;
    if (name.empty()) name = reading.folder.substr(reading.folder.find_last_of("/\\") + 1);
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

}  // namespace

ImportProposal propose_import(std::span<const std::string> files) {
    std::vector<Reading> readings;
    for (const std::string& file : files) readings.push_back(read_name(file));
    for (Reading& reading : readings)
        if (!is_picture(reading)) reading.word = nullptr;
    settle_packed(readings);
    settle_set_pictures(readings);
    const auto pictures = std::count_if(readings.begin(), readings.end(), is_picture);
    for (Reading& reading : readings) {
        if (reading.word)
            reading.uses = uses_of(*reading.word);
        else if (pictures == 1 && is_picture(reading))
            reading.uses = {{MapSlot::Albedo}};
    }

    ImportProposal proposal;
    const std::vector<Candidate> candidates = candidates_of(readings);
    for (int slot = 0; slot < kMapSlots; ++slot)
        add_rows_for_slot(candidates, static_cast<MapSlot>(slot), proposal);
    std::stable_partition(proposal.rows.begin(), proposal.rows.end(),
                          [](const ImportRow& row) { return row.slot.has_value(); });
    const auto used = std::count_if(proposal.rows.begin(), proposal.rows.end(),
                                    [](const ImportRow& row) { return row.slot.has_value(); });
    proposal.clear_other_maps = used > 1;
    for (const Reading& reading : readings) {
        if (reading.uses.empty())
            proposal.rows.push_back(unused_row(reading));
        else if (*reading.file == proposal.rows[0].file)
            proposal.name = set_name(reading);
    }
    return proposal;
}

void choose_slot(ImportProposal& proposal, std::size_t row, std::optional<MapSlot> slot) {
    for (ImportRow& other : proposal.rows)
        if (slot && other.slot == slot) other.slot.reset();
    proposal.rows[row].slot = slot;
}

Material apply_import(Material material, const ImportProposal& proposal) {
    const Material defaults;
    std::set<MapSlot> filled;
    for (const ImportRow& row : proposal.rows) {
        if (!row.slot) continue;
        filled.insert(*row.slot);
        const MapRef ref = map_of(material, *row.slot);
        *ref.map = row.file;
        if (ref.color_space) *ref.color_space = row.color_space;
        if (ref.channel) *ref.channel = row.channel;
        if (ref.invert) *ref.invert = row.invert;
        if (ref.convention) *ref.convention = row.convention;
        std::ranges::fill(values_of(*find_param(slot_row(*row.slot).key), material), 1.0f);
    }
    for (const MaterialSlot& slot : material_slots()) {
        if (!proposal.clear_other_maps || filled.count(slot.slot) || slot.edit(material).map->empty())
            continue;
        reset_slot(material, slot.slot);
    }
    // Whoever sells a metal sells its metallic map: a set without one is none, whatever was there before.
    if (proposal.clear_other_maps && filled.count(MapSlot::Albedo) && !filled.count(MapSlot::Metallic))
        reset_slot(material, MapSlot::Metallic);
    if (material.name == defaults.name && !proposal.name.empty()) material.name = proposal.name;
    return material;
}

}  // namespace patina

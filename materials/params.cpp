#include "materials/params.h"

#include <algorithm>
#include <cstdio>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace patina {

namespace {

MapRef ref_to(ColorSlot& slot) { return {.map = &slot.map, .color_space = &slot.color_space}; }
MapRef ref_to(ScalarSlot& slot) {
    return {.map = &slot.map, .channel = &slot.channel, .invert = &slot.invert};
}
MapRef ref_to(NormalSlot& slot) { return {.map = &slot.map, .convention = &slot.convention}; }

constexpr std::array kSlots{
    MaterialSlot{MapSlot::Albedo, "albedo", "Albedo",
                 "A picture of the surface's colour without light and shadow.",
                 [](Material& m) { return ref_to(m.albedo); }},
    MaterialSlot{MapSlot::Roughness, "roughness", "Roughness",
                 "A grey picture: black is polished, white is matte; invert it if it shows glossiness.",
                 [](Material& m) { return ref_to(m.roughness); }},
    MaterialSlot{MapSlot::Metallic, "metallic", "Metallic",
                 "A grey picture: white is bare metal, black is not metal.",
                 [](Material& m) { return ref_to(m.metallic); }},
    MaterialSlot{MapSlot::Ao, "ao", "Ambient occlusion",
                 "A grey picture: dark where crevices hide from the light.",
                 [](Material& m) { return ref_to(m.ao); }},
    MaterialSlot{MapSlot::Normal, "normal", "Normal",
                 "A bluish picture whose colours are the directions the surface faces.",
                 [](Material& m) { return ref_to(m.normal); }},
    MaterialSlot{MapSlot::Emission, "emission", "Emission",
                 "A picture of the light that the surface gives off by itself.",
                 [](Material& m) { return ref_to(m.emission); }},
};
static_assert(kSlots.size() == kMapSlots);

std::string number_text(float value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", static_cast<double>(value));
    return text.data();
}

std::string range_text(const MaterialParam& param) {
    static constexpr std::array counts{"", "a number", "two numbers", "three numbers"};
    std::string text = counts[components(param.kind)];
    text += param.kind == ParamKind::Scalar ? " from " : " (x,y) from ";
    if (param.kind == ParamKind::Color) text = "a colour (r,g,b) from ";
    return text + number_text(param.range.min) + " to " + number_text(param.range.max) +
           std::string(param.unit);
}

std::string setting_keys(const MaterialSlot& slot) {
    Material scratch;
    const MapRef ref = slot.edit(scratch);
    std::string keys = std::string(slot.key) + ".map";
    if (ref.color_space != nullptr) keys += ", " + std::string(slot.key) + ".color_space";
    if (ref.channel != nullptr) keys += ", " + std::string(slot.key) + ".channel";
    if (ref.invert != nullptr) keys += ", " + std::string(slot.key) + ".invert";
    if (ref.convention != nullptr) keys += ", " + std::string(slot.key) + ".convention";
    return keys;
}

std::string all_keys() {
    std::string keys;
    for (const MaterialParam& param : kMaterialParams)
        keys += (keys.empty() ? "" : ", ") + std::string(param.key);
    for (const MaterialSlot& slot : kSlots) keys += ", " + setting_keys(slot);
    return keys;
}

std::optional<float> number_in(std::string_view text) {
    std::istringstream stream{std::string(text)};
    stream.imbue(std::locale::classic());
    float value = 0.0f;
    stream >> value;
    if (stream.fail()) return std::nullopt;
    stream >> std::ws;
    if (!stream.eof()) return std::nullopt;
    return value;
}

/// The numbers between commas; empty where one of them is none.
std::vector<float> numbers_in(std::string_view text) {
    std::vector<float> numbers;
    while (true) {
        const std::size_t comma = text.find(',');
        const std::optional<float> number = number_in(text.substr(0, comma));
        if (!number) return {};
        numbers.push_back(*number);
        if (comma == std::string_view::npos) return numbers;
        text.remove_prefix(comma + 1);
    }
}

void set_numbers(Material& material, const MaterialParam& param, std::string_view text) {
    std::vector<float> numbers = numbers_in(text);
    const std::size_t wanted = components(param.kind);
    if (numbers.size() == 1) numbers.resize(wanted, numbers[0]);
    const auto outside = [&](float v) { return !(v >= param.range.min && v <= param.range.max); };
    if (numbers.size() != wanted || std::any_of(numbers.begin(), numbers.end(), outside))
        throw std::runtime_error("'" + std::string(text) + "' does not fit " + std::string(param.key) +
                                 ": it takes " + range_text(param) + ".");
    std::copy(numbers.begin(), numbers.end(), values_of(param, material).begin());
}

template <class T, std::size_t n>
void set_choice(T& target, const std::array<Choice<T>, n>& choices, std::string_view key,
                std::string_view text) {
    const std::optional<T> value = choice_of(choices, text);
    if (!value) {
        std::string ids;
        for (const auto& row : choices) ids += (ids.empty() ? "" : ", ") + std::string(row.id);
        throw std::runtime_error("'" + std::string(text) + "' does not fit " + std::string(key) +
                                 ": it is one of " + ids + ".");
    }
    target = *value;
}

/// True if the slot has such a setting.
bool set_slot(const MapRef& ref, std::string_view setting, std::string_view key, std::string_view text) {
    static constexpr std::array yes_no{Choice<bool>{true, "true", "", ""},
                                       Choice<bool>{false, "false", "", ""}};
    if (setting == "map")
        *ref.map = text;
    else if (setting == "color_space" && ref.color_space)
        set_choice(*ref.color_space, kColorSpaces, key, text);
    else if (setting == "channel" && ref.channel)
        set_choice(*ref.channel, kChannels, key, text);
    else if (setting == "invert" && ref.invert)
        set_choice(*ref.invert, yes_no, key, text);
    else if (setting == "convention" && ref.convention)
        set_choice(*ref.convention, kNormalConventions, key, text);
    else
        return false;
    return true;
}

}  // namespace

const MaterialParam* find_param(std::string_view key) {
    const auto row = std::find_if(kMaterialParams.begin(), kMaterialParams.end(),
                                  [&](const MaterialParam& param) { return param.key == key; });
    return row == kMaterialParams.end() ? nullptr : &*row;
}

std::span<float> values_of(const MaterialParam& param, Material& material) {
    return {param.field.edit(material), static_cast<std::size_t>(components(param.kind))};
}
std::span<const float> values_of(const MaterialParam& param, const Material& material) {
    return {param.field.read(material), static_cast<std::size_t>(components(param.kind))};
}

bool is_default(const MaterialParam& param, const Material& material) {
    const Material defaults;
    const auto now = values_of(param, material);
    return std::equal(now.begin(), now.end(), values_of(param, defaults).begin());
}

void reset(const MaterialParam& param, Material& material) {
    const Material defaults;
    const auto from = values_of(param, defaults);
    std::copy(from.begin(), from.end(), values_of(param, material).begin());
}

std::span<const MaterialSlot> material_slots() { return kSlots; }
const MaterialSlot& slot_row(MapSlot slot) { return kSlots[static_cast<std::size_t>(slot)]; }
MapRef map_of(Material& material, MapSlot slot) { return slot_row(slot).edit(material); }
ConstMapRef map_of(const Material& material, MapSlot slot) {
    // The rows only take addresses; nothing is written through a material that came in as const.
    const MapRef ref = slot_row(slot).edit(const_cast<Material&>(material));
    return {ref.map, ref.color_space, ref.channel, ref.invert, ref.convention};
}

void reset_slot(Material& material, MapSlot slot) {
    Material defaults;
    const MapRef ref = map_of(material, slot);
    const MapRef standard = map_of(defaults, slot);
    ref.map->clear();
    if (ref.color_space) *ref.color_space = *standard.color_space;
    if (ref.channel) *ref.channel = *standard.channel;
    if (ref.invert) *ref.invert = *standard.invert;
    if (ref.convention) *ref.convention = *standard.convention;
    for (const MaterialParam& param : kMaterialParams)
        if (param.slot == slot) reset(param, material);
}

void set_parameter(Material& material, std::string_view key, std::string_view text) {
    if (const MaterialParam* param = find_param(key)) {
        set_numbers(material, *param, text);
        return;
    }
    const std::size_t dot = key.find('.');
    for (const MaterialSlot& slot : kSlots)
        if (dot != std::string_view::npos && slot.key == key.substr(0, dot) &&
            set_slot(slot.edit(material), key.substr(dot + 1), key, text))
            return;
    throw std::runtime_error("There is no parameter '" + std::string(key) + "'. There are: " + all_keys() +
                             ".");
}

}  // namespace patina

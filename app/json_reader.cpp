#include "app/json_reader.h"

#include "materials/json_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace patina {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::size_t kMaxNotes = 50;

}  // namespace

JsonDocument::JsonDocument(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
    std::vector<std::string> repeated;
    root_ = parse_json(text_, name_, repeated);
    if (!root_.is_object()) fail("", "is " + type_of(root_) + "; it must be an object");
    for (const std::string& key : repeated) note(key, "is there more than once; the last one counts");
}

std::string JsonDocument::sentence(const std::string& pointer, const std::string& what) const {
    const TextPosition at = position_of(text_, nlohmann::json_pointer<std::string>(pointer));
    return name_ + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": " +
           (pointer.empty() ? "the document" : printable(pointer)) + " " + printable(what, 400) + ".";
}

void JsonDocument::fail(const std::string& pointer, const std::string& what) const {
    throw std::runtime_error(sentence(pointer, what));
}

void JsonDocument::note(const std::string& pointer, const std::string& what) {
    if (notes_.size() < kMaxNotes) notes_.push_back(sentence(pointer, what));
}

JsonObject::JsonObject(JsonDocument& document, const Json& json, std::string pointer)
    : document_(document), json_(json), pointer_(std::move(pointer)) {
    if (!json_.is_object()) document_.fail(pointer_, "is " + type_of(json_) + "; it must be an object");
}

std::string JsonObject::pointer_of(std::string_view key) const { return pointer_to(pointer_, key); }
bool JsonObject::has(std::string_view key) const { return json_.contains(std::string(key)); }

const Json* JsonObject::find(std::string_view key) {
    known_.emplace(key);
    const auto member = json_.find(std::string(key));
    return member == json_.end() ? nullptr : &*member;
}

void JsonObject::read_text(std::string_view key, std::string& target) {
    const Json* json = find(key);
    if (!json) return;
    if (!json->is_string()) document_.fail(pointer_of(key), "is " + type_of(*json) + "; it must be text");
    target = json->get<std::string>();
}

float JsonObject::number(const Json& json, const std::string& pointer, NumberRange range) {
    const std::string allowed = "from " + number_text(range.min) + " to " + number_text(range.max);
    if (!json.is_number())
        document_.fail(pointer, "is " + type_of(json) + "; it must be a number " + allowed);
    const double value = json.get<double>();
    const double clamped = std::clamp(value, double(range.min), double(range.max));
    if (clamped != value)
        document_.note(pointer, "is " + json.dump() + ", outside " + allowed + "; taken as " +
                                    number_text(float(clamped)));
    return float(clamped);
}

void JsonObject::read_number(std::string_view key, NumberRange range, float& target) {
    if (const Json* json = find(key)) target = number(*json, pointer_of(key), range);
}

void JsonObject::numbers(std::string_view key, NumberRange range, float* target, std::size_t count) {
    const Json* json = find(key);
    if (!json) return;
    if (!json->is_array() || json->size() != count)
        document_.fail(pointer_of(key), "is " + type_of(*json) + "; it must be an array of " +
                                            std::to_string(count) + " numbers");
    for (std::size_t i = 0; i < count; ++i)
        target[i] = number((*json)[i], pointer_to(pointer_of(key), std::to_string(i)), range);
}

void JsonObject::read_vector(std::string_view key, NumberRange range, glm::vec2& target) {
    numbers(key, range, &target.x, 2);
}
void JsonObject::read_vector(std::string_view key, NumberRange range, glm::vec3& target) {
    numbers(key, range, &target.x, 3);
}

std::optional<JsonObject> JsonObject::object(std::string_view key) {
    const Json* json = find(key);
    if (!json) return std::nullopt;
    return JsonObject(document_, *json, pointer_of(key));
}

std::vector<JsonObject> JsonObject::objects(std::string_view key, std::size_t most) {
    const Json* json = find(key);
    std::vector<JsonObject> result;
    if (!json) return result;
    if (!json->is_array() || json->size() > most)
        document_.fail(pointer_of(key), "is " + type_of(*json) + "; it must be an array of at most " +
                                            std::to_string(most) + " objects");
    for (std::size_t i = 0; i < json->size(); ++i)
        result.emplace_back(document_, (*json)[i], pointer_to(pointer_of(key), std::to_string(i)));
    return result;
}

std::vector<glm::vec2> JsonObject::points(std::string_view key, std::size_t count, NumberRange range) {
    const Json* json = find(key);
    std::vector<glm::vec2> result;
    if (!json) return result;
    const std::string wanted = "; it must be an array of " + std::to_string(count) + " pairs of numbers";
    if (!json->is_array() || json->size() != count)
        document_.fail(pointer_of(key), "is " + type_of(*json) + wanted);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string pointer = pointer_to(pointer_of(key), std::to_string(i));
        const Json& pair = (*json)[i];
        if (!pair.is_array() || pair.size() != 2) document_.fail(pointer, "is " + type_of(pair) + wanted);
        result.emplace_back(number(pair[0], pointer + "/0", range), number(pair[1], pointer + "/1", range));
    }
    return result;
}

std::string JsonObject::unknown() {
    Json rest = Json::object();
    for (const auto& [key, value] : json_.items()) {
        if (known_.contains(key)) continue;
        rest[key] = value;
        document_.note(pointer_of(key), "is not known to this version; it is kept when the file is saved");
    }
    return rest.empty() ? std::string{} : rest.dump();
}

Json shortest_number(float value) {
    std::array<char, 32> text{};
    *std::to_chars(text.data(), text.data() + text.size() - 1, std::isfinite(value) ? value : 0.0f).ptr =
        '\0';
    return Json::parse(text.data());
}

void add_unknown(Json& into, const std::string& unknown_json) {
    if (unknown_json.empty()) return;
    const Json unknown = Json::parse(unknown_json, nullptr, false);
    if (!unknown.is_object()) return;
    for (const auto& [key, value] : unknown.items())
        if (!into.contains(key)) into[key] = value;
}

}  // namespace patina

// Reading a JSON document member by member: what is missing means its default, what is wrong is said with
// file, line and pointer, what is unknown is kept and noted. Opens no file.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

class JsonDocument {
public:
    /// Throws std::runtime_error "NAME:LINE:COLUMN: what is wrong."; a document that is no object is wrong
    /// too.
    JsonDocument(std::string_view text, std::string name);

    [[noreturn]] void fail(const std::string& pointer, const std::string& what) const;
    void note(const std::string& pointer, const std::string& what);
    const nlohmann::ordered_json& root() const { return root_; }
    std::vector<std::string> take_notes() { return std::move(notes_); }

private:
    std::string sentence(const std::string& pointer, const std::string& what) const;

    std::string_view text_;
    std::string name_;
    nlohmann::ordered_json root_;
    std::vector<std::string> notes_;
};

struct NumberRange {
    float min = 0.0f, max = 1.0f;
};

/// One object of it. Each read_ leaves its target alone where the key is missing; a number out of range is
/// clamped and noted.
class JsonObject {
public:
    JsonObject(JsonDocument& document, const nlohmann::ordered_json& json, std::string pointer);

    void read_text(std::string_view key, std::string& target);
    void read_number(std::string_view key, NumberRange range, float& target);
    void read_vector(std::string_view key, NumberRange range, glm::vec2& target);
    void read_vector(std::string_view key, NumberRange range, glm::vec3& target);
    /// One of a table of rows with id and value.
    template <class Table, class T>
    void read_choice(std::string_view key, const Table& table, T& target) {
        std::string id;
        read_text(key, id);
        if (id.empty()) return;
        std::string ids;
        for (const auto& row : table) {
            if (row.id == id) {
                target = row.value;
                return;
            }
            ids += (ids.empty() ? "'" : " or '") + std::string(row.id) + "'";
        }
        document_.fail(pointer_of(key), "is '" + id + "'; it must be " + ids);
    }
    std::optional<JsonObject> object(std::string_view key);
    /// An array of objects; empty where the key is missing.
    std::vector<JsonObject> objects(std::string_view key, std::size_t most);
    /// An array of exactly that many pairs of numbers.
    std::vector<glm::vec2> points(std::string_view key, std::size_t count, NumberRange range);
    bool has(std::string_view key) const;

    /// The members nobody read, noted, as text; empty if there are none.
    std::string unknown();

    std::string pointer_of(std::string_view key) const;
    JsonDocument& document() { return document_; }

private:
    const nlohmann::ordered_json* find(std::string_view key);
    float number(const nlohmann::ordered_json& json, const std::string& pointer, NumberRange range);
    void numbers(std::string_view key, NumberRange range, float* target, std::size_t count);

    JsonDocument& document_;
    const nlohmann::ordered_json& json_;
    std::string pointer_;
    std::set<std::string, std::less<>> known_;
};

/// The double with the digits of the shortest text that reads back the same float.
nlohmann::ordered_json shortest_number(float value);
/// Adds the members of that text (an object's) that are not there yet.
void add_unknown(nlohmann::ordered_json& into, const std::string& unknown_json);

}  // namespace patina

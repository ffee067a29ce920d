// JSON between text and tree: bounded parsing that knows line and column, and a printer that a person likes
// to read. Knows nothing of materials and opens no file.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

/// Deeper or wider than this is not a preset but an attack or an accident.
inline constexpr std::size_t kMaxJsonDepth = 64;
inline constexpr std::size_t kMaxJsonMembers = 1024;

/// 1-based; columns count characters, not bytes.
struct TextPosition {
    std::size_t line = 1;
    std::size_t column = 1;
};
TextPosition position_at(std::string_view text, std::size_t byte);

/// Throws std::runtime_error "NAME:LINE:COLUMN: what is wrong." A byte order mark is skipped. Of a repeated
/// key the last value counts; its JSON pointer is added to repeated_keys.
nlohmann::ordered_json parse_json(std::string_view text, const std::string& name,
                                  std::vector<std::string>& repeated_keys);

/// Where the value at a JSON pointer starts; of something that is not there, where the innermost thing around
/// it starts. Precondition: parse_json accepted the text.
TextPosition position_of(std::string_view text, const nlohmann::json_pointer<std::string>& pointer);

/// What fits in 100 columns stays on one line; the outermost object is always broken. Numbers use the
/// shortest text that reads back the same double. Ends with a newline.
std::string to_text(const nlohmann::ordered_json& json);

/// A pointer's text with one more key; '~' and '/' are escaped.
std::string pointer_to(const std::string& parent, std::string_view key);

// Words for messages about a file.

/// One line of at most about `readable` bytes, cut between characters, whatever the file holds.
std::string printable(std::string_view text, std::size_t readable = 80);
/// "an object", "an array of 3", "text", "a number", "true", "null".
std::string type_of(const nlohmann::ordered_json& json);
/// The shortest text that reads back the same number.
std::string number_text(double value);
std::string number_text(float value);

}  // namespace patina

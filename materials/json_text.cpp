#include "materials/json_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace patina {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

[[noreturn]] void refuse(const std::string& name, std::string_view text, std::size_t byte,
                         const std::string& why) {
    const TextPosition at = position_at(text, byte);
    throw std::runtime_error(name + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": " +
                             why + ".");
}

/// Bytes of the UTF-8 character that starts there; 0 if none does (overlong forms and surrogates are none).
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return static_cast<unsigned char>(i < text.size() ? text[i] : 0);
    };
    const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0) == 0x80; };
    if (byte(0) < 0x80) return 1;
    if (byte(0) >= 0xC2 && byte(0) <= 0xDF) return continues(1) ? 2 : 0;
    if ((byte(0) & 0xF0) == 0xE0) {
        const bool overlong = byte(0) == 0xE0 && byte(1) < 0xA0;
        const bool surrogate = byte(0) == 0xED && byte(1) > 0x9F;
        return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
    }
    const bool in_plane = (byte(0) == 0xF0 && byte(1) >= 0x90) || (byte(0) >= 0xF1 && byte(0) <= 0xF3) ||
                          (byte(0) == 0xF4 && byte(1) <= 0x8F);
    return in_plane && continues(1) && continues(2) && continues(3) ? 4 : 0;
}

/// nlohmann's message without its number, its own idea of the place and the raw bytes it last read.
std::string plain_reason(std::string_view what) {
    if (const auto bracket = what.find("] "); bracket != std::string_view::npos)
        what.remove_prefix(bracket + 2);
    if (what.starts_with("parse error"))
        if (const auto colon = what.find(": "); colon != std::string_view::npos)
            what.remove_prefix(colon + 2);
    std::string reason(what);
    if (const auto last_read = reason.find("; last read: "); last_read != std::string::npos) {
        const auto end = reason.find('\'', reason.find('\'', last_read) + 1);
        reason.erase(last_read, end == std::string::npos ? end : end + 1 - last_read);
    }
    if (reason.starts_with("number overflow")) reason = "the number is too large";
    return reason;
}

/// Builds the tree from the parser's events, so that depth, width and repeated keys are seen while they come.
class TreeBuilder final : public nlohmann::json_sax<Json> {
public:
    TreeBuilder(std::string_view text, const std::string& name, std::vector<std::string>& repeated_keys)
        : text_(text), name_(name), repeated_keys_(repeated_keys) {}

    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(number_integer_t value) override { return put(value); }
    bool number_unsigned(number_unsigned_t value) override { return put(value); }
    bool number_float(number_float_t value, const string_t&) override { return put(value); }
    bool string(string_t& value) override { return put(std::move(value)); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& key) override {
        Json& object = *open_.back();
        if (object.contains(key)) repeated_keys_.push_back(pointer_to(pointer(), key));
        if (object.size() >= kMaxJsonMembers)
            throw std::runtime_error(name_ + ": " + where() + " has more than " +
                                     std::to_string(kMaxJsonMembers) + " keys; Patina writes no such file.");
        key_ = key;
        return true;
    }
    bool parse_error(std::size_t position, const std::string& token,
                     const nlohmann::detail::exception& error) override {
        static constexpr int number_overflow = 406;
        const std::string_view what = error.what();
        // The position is one past what was read; an overflow is noticed at the number's end.
        std::size_t byte = std::min(position, text_.size());
        if (what.find("unexpected end of input") == std::string_view::npos)
            byte -= std::min(byte, error.id == number_overflow ? token.size() : 1);
        refuse(name_, text_, byte, "not valid JSON: " + plain_reason(what));
    }

    Json take() { return std::move(root_); }

private:
    Json* place(Json value) {
        if (open_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        Json& parent = *open_.back();
        if (parent.is_array()) {
            parent.push_back(std::move(value));
            return &parent.back();
        }
        Json& member = parent[key_];
        member = std::move(value);
        return &member;
    }
    bool put(Json value) {
        place(std::move(value));
        return true;
    }
    bool open(Json value) {
        if (open_.size() >= kMaxJsonDepth)
            throw std::runtime_error(name_ + ": " + where() + " is nested deeper than " +
                                     std::to_string(kMaxJsonDepth) + " levels; Patina writes no such file.");
        const bool in_object = !open_.empty() && open_.back()->is_object();
        keys_.push_back(in_object       ? pointer_to("", key_)
                        : open_.empty() ? ""
                                        : pointer_to("", std::to_string(open_.back()->size())));
        open_.push_back(place(std::move(value)));
        return true;
    }
    bool close() {
        open_.pop_back();
        keys_.pop_back();
        return true;
    }
    std::string pointer() const {
        std::string text;
        for (const std::string& key : keys_) text += key;
        return text;
    }
    std::string where() const {
        const std::string text = pointer();
        return text.empty() ? "the document" : printable(text, 60);
    }

    std::string_view text_;
    const std::string& name_;
    std::vector<std::string>& repeated_keys_;
    Json root_;
    std::vector<Json*> open_;        ///< the containers around the next value, outermost first
    std::vector<std::string> keys_;  ///< their keys, with the slash
    std::string key_;
};

/// Walks text that is known to be valid JSON.
class Cursor {
public:
    explicit Cursor(std::string_view text) : text_(text) {
        if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
        skip_space();
    }
    std::size_t at() const { return at_; }
    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

    /// Goes to the member's value (the last one of that key) or the element; false, and not moved, if there
    /// is none.
    bool enter(const std::string& key) {
        const std::size_t start = at_;
        std::size_t found = std::string_view::npos;
        const bool object = peek() == '{';
        if (!object && peek() != '[') return false;
        step();
        for (std::size_t index = 0; peek() != '}' && peek() != ']'; ++index) {
            const std::string name = object ? read_key() : std::to_string(index);
            if (name == key) found = at_;
            skip_value();
            if (peek() == ',') step();
        }
        at_ = found == std::string_view::npos ? start : found;
        return found != std::string_view::npos;
    }

private:
    void skip_space() {
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
            ++at_;
    }
    void step() {
        ++at_;
        skip_space();
    }
    void skip_string() {
        for (++at_; peek() != '"'; ++at_)
            if (peek() == '\\') ++at_;
        ++at_;
    }
    std::string read_key() {
        const std::size_t start = at_;
        skip_string();
        const Json key = Json::parse(text_.substr(start, at_ - start), nullptr, false);
        skip_space();
        step();  // the colon
        return key.is_string() ? key.get<std::string>() : std::string();
    }
    void skip_value() {
        static constexpr std::string_view after_value = ",]} \t\r\n";
        int depth = 0;
        do {
            const char c = peek();
            if (c == '"') {
                skip_string();
                continue;
            }
            depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
            ++at_;
            while (depth == 0 && at_ < text_.size() && after_value.find(peek()) == std::string_view::npos)
                ++at_;
        } while (depth > 0);
        skip_space();
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

std::string scalar_text(const Json& json) {
    if (!json.is_number_float()) return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    const double value = json.get<double>();
    if (value == 0.0 && std::signbit(value)) return "-0.0";  // "-0" would come back as an integer
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

std::string key_text(const std::string& key) { return scalar_text(Json(key)) + ": "; }

std::string inline_text(const Json& json) {
    if (!json.is_structured()) return scalar_text(json);
    if (json.empty()) return json.is_array() ? "[]" : "{}";
    std::string text = json.is_array() ? "[" : "{ ";
    for (auto item = json.begin(); item != json.end(); ++item) {
        if (item != json.begin()) text += ", ";
        if (json.is_object()) text += key_text(item.key());
        text += inline_text(*item);
    }
    return text + (json.is_array() ? "]" : " }");
}

std::size_t column_count(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

void print(const Json& json, std::size_t indent, std::size_t used, std::string& out) {
    static constexpr std::size_t columns = 100;
    static constexpr std::size_t step = 2;
    const std::string one_line = inline_text(json);
    const bool outermost = indent == 0 && used == 0;
    if (!json.is_structured() || json.empty() || (!outermost && used + column_count(one_line) <= columns)) {
        out += one_line;
        return;
    }
    out += json.is_array() ? "[" : "{";
    for (auto item = json.begin(); item != json.end(); ++item) {
        out += item == json.begin() ? "\n" : ",\n";
        const std::string key = json.is_object() ? key_text(item.key()) : "";
        out += std::string(indent + step, ' ') + key;
        print(*item, indent + step, indent + step + column_count(key) + 1, out);
    }
    out += "\n" + std::string(indent, ' ') + (json.is_array() ? "]" : "}");
}

}  // namespace

TextPosition position_at(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    TextPosition position;
    position.line += static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
    const std::size_t line_start = before.rfind('\n');
    std::string_view line = line_start == std::string_view::npos ? before : before.substr(line_start + 1);
    if (line_start == std::string_view::npos && line.starts_with(kByteOrderMark))
        line.remove_prefix(kByteOrderMark.size());
    position.column += column_count(line);
    return position;
}

Json parse_json(std::string_view text, const std::string& name, std::vector<std::string>& repeated_keys) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = utf8_length(text.substr(at));
        if (length == 0) refuse(name, text, at, "not valid UTF-8 text; save the file as UTF-8");
        at += length;
    }
    TreeBuilder builder(text, name, repeated_keys);
    Json::sax_parse(text, &builder);
    return builder.take();
}

TextPosition position_of(std::string_view text, const nlohmann::json_pointer<std::string>& pointer) {
    std::vector<std::string> keys;
    for (auto rest = pointer; !rest.empty(); rest.pop_back()) keys.push_back(rest.back());
    Cursor cursor(text);
    while (!keys.empty() && cursor.enter(keys.back())) keys.pop_back();
    return position_at(text, cursor.at());
}

std::string to_text(const Json& json) {
    std::string out;
    print(json, 0, 0, out);
    return out + "\n";
}

std::string pointer_to(const std::string& parent, std::string_view key) {
    std::string text = parent + "/";
    for (const char c : key) {
        if (c == '~')
            text += "~0";
        else if (c == '/')
            text += "~1";
        else
            text += c;
    }
    return text;
}

std::string printable(std::string_view text, std::size_t readable) {
    std::string result;
    for (const char c : text) {
        const bool starts_character = (static_cast<unsigned char>(c) & 0xC0) != 0x80;
        if (result.size() >= readable && starts_character) return result + "…";
        result += std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
    }
    return result;
}

std::string type_of(const Json& json) {
    if (json.is_object()) return "an object";
    if (json.is_array()) return "an array of " + std::to_string(json.size());
    if (json.is_string()) return "text";
    if (json.is_number()) return "a number";
    return json.dump();
}

template <class Number>
static std::string shortest_text(Number value) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}
std::string number_text(double value) { return shortest_text(value); }
std::string number_text(float value) { return shortest_text(value); }

}  // namespace patina

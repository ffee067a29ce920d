#include "renderer/core/mesh_guard.h"
#include "renderer/core/mesh_text.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace patina {
namespace {

/// Two walks over the lines: numbers first, then faces, which may point at what comes later.
class ObjGuard {
public:
    explicit ObjGuard(std::string text) { file_.text = std::move(text); }

    GuardedFile run() {
        unify_line_ends(file_.text);
        join_continued_lines();
        for_each_line([&](Span line) { check_numbers_of(line); });
        if (single_texcoords_ > 0) drop_texcoords();
        total_ = seen_;
        seen_ = {};
        for_each_line([&](Span line) { check_face(line); });
        if (!bridged_.empty()) append_bridged();
        write_notes();
        return std::move(file_);
    }

private:
    struct Counts {
        std::int64_t positions = 0, texcoords = 0, normals = 0;
    };

    template <class Check>
    void for_each_line(const Check& check) {
        Span rest{0, file_.text.size()};
        line_number_ = 0;
        while (!rest.empty()) {
            ++line_number_;
            const Span line = next_line(file_.text, rest);
            cut_off_ = rest.empty() && file_.text.back() != '\n';
            check(line);
        }
    }

    [[noreturn]] void refuse(const std::string& what) const {
        throw std::runtime_error("line " + std::to_string(line_number_) + ": " + what +
                                 (cut_off_ ? " The file ends here: it seems to be cut off." : ""));
    }

    /// A backslash before the line end: both become blanks.
    void join_continued_lines() {
        std::string& text = file_.text;
        for (std::size_t i = text.find('\\'); i != std::string::npos; i = text.find('\\', i + 1)) {
            std::size_t end = i + 1;
            if (end < text.size() && text[end] == '\r') ++end;
            if (end < text.size() && text[end] == '\n') overwrite(text, {i, end + 1}, "");
        }
    }

    void check_numbers_of(Span line) {
        std::string& text = file_.text;
        const std::size_t comment = line.of(text).find('#');
        if (comment != std::string_view::npos) overwrite(text, {line.begin + comment, line.end}, "");
        Span rest = line;
        const Span keyword = next_word(text, rest);
        const std::string_view word = keyword.of(text);
        if (word == "v") {
            if (zero_lost_numbers(rest, 3, "a vertex") > 0)
                file_.lost_positions.push_back(std::uint32_t(seen_.positions));
            if (++seen_.positions > std::int64_t(kMaxMeshVertices))
                refuse("more than 100 million vertices are not supported.");
        } else if (word == "vn") {
            const Span numbers = rest;
            if (zero_lost_numbers(rest, 3, "a normal") > 0) overwrite(text, numbers, " 0 0 0");
            ++seen_.normals;
        } else if (word == "vt") {
            check_texcoord(line, rest);
            ++seen_.texcoords;
        } else if (word == "fo") {
            overwrite(text, keyword, "f");
        } else if (!word.empty() && word != "f") {
            overwrite(text, line,
                      "");  // materials, groups, smoothing: nothing a mesh is made of, nothing to open
        }
    }

    /// The next n words have to be numbers; those that are not finite become 0. Returns how many.
    int zero_lost_numbers(Span rest, int n, const char* what) {
        int lost = 0;
        for (int k = 0; k < n; ++k) {
            const Span word = next_word(file_.text, rest);
            const auto value = parse_number(word.of(file_.text));
            if (!value) refuse(std::string(what) + " needs " + std::to_string(n) + " numbers.");
            if (std::isfinite(*value)) continue;
            overwrite(file_.text, word, "0");
            ++lost;
        }
        return lost;
    }

    void check_texcoord(Span line, Span rest) {
        Span words = rest;
        next_word(file_.text, words);
        if (!next_word(file_.text, words).empty()) {
            if (zero_lost_numbers(rest, 2, "a texture coordinate") > 0) ++lost_texcoords_;
            return;
        }
        zero_lost_numbers(rest, 1, "a texture coordinate");
        overwrite(file_.text, line, "");
        ++single_texcoords_;
    }

    /// The reader knows pairs only, and leaving out some would shift the rest.
    void drop_texcoords() {
        for_each_line([&](Span line) {
            Span rest = line;
            if (next_word(file_.text, rest).of(file_.text) == "vt") overwrite(file_.text, line, "");
        });
        seen_.texcoords = 0;
        file_.notes.emplace_back(
            "Texture coordinates of a single number are not supported and were dropped.");
    }

    void check_face(Span line) {
        Span rest = line;
        const std::string_view keyword = next_word(file_.text, rest).of(file_.text);
        seen_.positions += keyword == "v";
        seen_.texcoords += keyword == "vt";
        seen_.normals += keyword == "vn";
        if (keyword != "f") return;
        ++file_.faces;
        if (file_.faces > kMaxMeshFaces) refuse("more than 100 million faces are not supported.");
        const Span words = rest;
        face_.clear();
        bool in_range = true;
        for (Span word = next_word(file_.text, rest); !word.empty(); word = next_word(file_.text, rest))
            in_range = check_corner(word) && in_range;
        if (face_.size() < 3 && cut_off_) refuse("a face needs three corners.");
        if (in_range && face_.size() > 3 && repeats_a_position())
            keep_bridged(words);
        else if (in_range && face_.size() >= 3)
            return;
        overwrite(file_.text, line, "");
        if (in_range) return;
        ++out_of_range_;
        --file_.faces;
    }

    /// Indices count from 1, or back from the last one read.
    static bool in_range(std::int64_t index, std::int64_t seen, std::int64_t total) {
        return index < 0 ? index >= -seen : index >= 1 && index <= total;
    }

    /// "position", "position/uv", "position//normal" or "position/uv/normal"; false if the position does not
    /// exist. Other parts that point nowhere are taken out.
    bool check_corner(Span word) {
        const std::string corner(word.of(file_.text));
        const std::size_t first = corner.find('/');
        const std::size_t second = first == std::string::npos ? first : corner.find('/', first + 1);
        const std::string position = corner.substr(0, first);
        const std::string uv = first == std::string::npos ? "" : corner.substr(first + 1, second - first - 1);
        const std::string normal = second == std::string::npos ? "" : corner.substr(second + 1);
        const auto index = parse_integer(position);
        const auto uv_index = parse_integer(uv);
        const auto normal_index = parse_integer(normal);
        if (!index || (!uv.empty() && !uv_index) || (!normal.empty() && !normal_index))
            refuse("a face has the unreadable corner '" + corner.substr(0, 40) + "'.");
        const bool keep_uv = uv_index && in_range(*uv_index, seen_.texcoords, total_.texcoords);
        const bool keep_normal = normal_index && in_range(*normal_index, seen_.normals, total_.normals);
        if ((uv_index && !keep_uv) || (normal_index && !keep_normal)) {
            std::string kept = position;
            if (keep_uv || keep_normal) kept += "/" + (keep_uv ? uv : std::string());
            if (keep_normal) kept += "/" + normal;
            overwrite(file_.text, word, kept);
            if (single_texcoords_ == 0 || (normal_index && !keep_normal)) ++lost_attributes_;
        }
        face_.push_back(*index < 0 ? seen_.positions + *index + 1 : *index);
        return in_range(*index, seen_.positions, total_.positions);
    }

    bool repeats_a_position() {
        std::sort(face_.begin(), face_.end());
        return std::adjacent_find(face_.begin(), face_.end()) != face_.end();
    }

    /// A polygon with a hole is often written as one loop that runs along a bridge twice. The reader takes
    /// the second visit to a vertex out, so such faces are set aside, with indices that hold anywhere in the
    /// file …
    void keep_bridged(Span words) {
        std::vector<std::pair<std::int64_t, std::string>>& face = bridged_.emplace_back();
        const auto absolute = [](std::int64_t index, std::int64_t seen) {
            return index < 0 ? seen + index + 1 : index;
        };
        for (Span word = next_word(file_.text, words); !word.empty(); word = next_word(file_.text, words)) {
            const std::string_view corner = word.of(file_.text);
            const std::size_t first = std::min(corner.find('/'), corner.size());
            const std::size_t second = std::min(corner.find('/', first + 1), corner.size());
            const auto position = parse_integer(corner.substr(0, first));
            const auto uv = parse_integer(
                corner.substr(std::min(first + 1, second), second - std::min(first + 1, second)));
            const auto normal = parse_integer(corner.substr(std::min(second + 1, corner.size())));
            std::string rest = uv || normal ? "/" : "";
            if (uv) rest += std::to_string(absolute(*uv, seen_.texcoords));
            if (normal) rest += "/" + std::to_string(absolute(*normal, seen_.normals));
            face.emplace_back(absolute(*position, seen_.positions), rest);
        }
    }

    /// … and appended with a copy of the vertex for every further visit.
    void append_bridged() {
        std::vector<std::string> vertices;
        for_each_line([&](Span line) {
            if (next_word(file_.text, line).of(file_.text) == "v") vertices.emplace_back(line.of(file_.text));
        });
        std::string more;
        for (const auto& face : bridged_) {
            std::set<std::int64_t> visited;
            std::string line = "\nf";
            for (const auto& [position, rest] : face) {
                std::int64_t index = position;
                if (!visited.insert(position).second) {
                    more += "\nv" + vertices[std::size_t(position - 1)];
                    index = ++total_.positions;
                    const auto& lost = file_.lost_positions;
                    if (std::find(lost.begin(), lost.end(), std::uint32_t(position - 1)) != lost.end())
                        file_.lost_positions.push_back(std::uint32_t(index - 1));
                }
                line += " " + std::to_string(index) + rest;
            }
            more += line;
        }
        file_.text += more + "\n";
    }

    void write_notes() {
        const auto note = [&](std::size_t n, const std::string& what) {
            if (n > 0) file_.notes.push_back(std::to_string(n) + what);
        };
        note(out_of_range_, " face(s) dropped: a corner points at no vertex of the file.");
        note(lost_attributes_, " corner(s) point at no normal or texture coordinate of the file.");
        note(lost_texcoords_, " texture coordinate(s) that are not finite were set to 0.");
        if (cut_off_) file_.notes.emplace_back("The last line has no end: perhaps the file was cut off.");
    }

    GuardedFile file_;
    Counts seen_, total_;
    std::vector<std::int64_t> face_;  ///< positions of the face at hand
    std::vector<std::vector<std::pair<std::int64_t, std::string>>> bridged_;
    std::size_t line_number_ = 0;
    bool cut_off_ = false;  ///< the line at hand is the last and has no end
    std::size_t single_texcoords_ = 0, lost_texcoords_ = 0, lost_attributes_ = 0, out_of_range_ = 0;
};

}  // namespace

GuardedFile guard_obj(std::string text) { return ObjGuard(std::move(text)).run(); }

}  // namespace patina

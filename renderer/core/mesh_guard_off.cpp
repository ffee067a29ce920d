#include "renderer/core/mesh_guard.h"
#include "renderer/core/mesh_text.h"

#include <array>
#include <cmath>
#include <stdexcept>

namespace patina {
namespace {

/// OFF as text: a header [ST][C][N]OFF, three counts, a line a vertex, a line a face. The reader knows
/// neither comments nor counts on the header's line, and takes a face's colour for the next face unless the
/// header announces one.
class OffGuard {
public:
    explicit OffGuard(std::string text) { file_.text = std::move(text); }

    GuardedFile run() {
        unify_line_ends(file_.text);
        blank_comments();
        rest_ = {0, file_.text.size()};
        read_header();
        for (vertex_ = 0; vertex_ < vertices_; ++vertex_) check_vertex();
        for (std::size_t f = 0; f < file_.faces; ++f) check_face();
        if (lost_uvs_ > 0)
            file_.notes.push_back(std::to_string(lost_uvs_) +
                                  " texture coordinate(s) that are not finite were set to 0.");
        return std::move(file_);
    }

private:
    void blank_comments() {
        Span rest{0, file_.text.size()};
        while (!rest.empty()) {
            const Span line = next_line(file_.text, rest);
            const std::size_t comment = line.of(file_.text).find('#');
            if (comment != std::string_view::npos)
                overwrite(file_.text, {line.begin + comment, line.end}, "");
        }
    }

    [[noreturn]] void refuse(const std::string& what) const {
        throw std::runtime_error("line " + std::to_string(line_number_) + ": " + what);
    }

    /// The next line that says anything.
    Span filled_line(const std::string& wanted) {
        while (!rest_.empty()) {
            ++line_number_;
            const Span line = next_line(file_.text, rest_);
            Span words = line;
            if (!next_word(file_.text, words).empty()) return line;
        }
        throw std::runtime_error("it is cut off: it ends where " + wanted + " has to be.");
    }

    void read_header() {
        Span line = filled_line("the header");
        if (line.begin != 0 || is_space(file_.text[0])) refuse("the first line has to say OFF.");
        std::string_view kind = next_word(file_.text, line).of(file_.text);
        if (kind.starts_with("ST")) {
            texcoords_ = true;
            kind.remove_prefix(2);
        }
        if (kind.starts_with("C")) kind.remove_prefix(1);
        if (kind.starts_with("N")) {
            normals_ = true;
            kind.remove_prefix(1);
        }
        if (kind != "OFF")
            refuse("only points in three dimensions are supported, not " + std::string(kind) + ".");
        Span counts = line;
        const std::string_view next = next_word(file_.text, counts).of(file_.text);
        if (next == "BINARY") refuse("binary OFF is not supported; save it as text.");
        if (next.empty())
            line = filled_line("the number of vertices");
        else
            file_.text[line.begin] = '\n';  // the reader skips the whole first line
        read_counts(line);
    }

    void read_counts(Span line) {
        std::array<std::uint64_t, 2> counts{};
        for (std::uint64_t& count : counts) {
            const auto value = parse_integer(next_word(file_.text, line).of(file_.text));
            if (!value || *value < 0) refuse("here have to be the numbers of vertices and faces.");
            count = std::uint64_t(*value);
        }
        if (next_word(file_.text, line).empty())
            refuse("the number of edges is missing after vertices and faces.");
        overwrite(file_.text, line, "");  // the reader would take what follows for the first vertex
        // A vertex line takes at least six bytes, a face line eight.
        const std::size_t left = rest_.end - rest_.begin + 1;
        if (counts[0] > kMaxMeshVertices || counts[1] > kMaxMeshFaces)
            refuse("more than 100 million vertices or faces are not supported.");
        if (counts[0] * 6 > left || counts[1] * 2 > left)
            refuse("it promises " + std::to_string(counts[0]) + " vertices and " + std::to_string(counts[1]) +
                   " faces but is too short for them; it is cut off.");
        vertices_ = counts[0];
        file_.faces = counts[1];
    }

    void check_vertex() {
        Span line = filled_line("vertex " + std::to_string(vertex_));
        bool lost = false;
        for (int k = 0; k < 3; ++k) lost = zero_if_lost(next_word(file_.text, line)) || lost;
        if (lost) file_.lost_positions.push_back(std::uint32_t(vertex_));
        const Span normal = line;
        lost = false;
        for (int k = 0; normals_ && k < 3; ++k) lost = zero_if_lost(next_word(file_.text, line)) || lost;
        if (lost) {
            Span words = normal;
            for (int k = 0; k < 3; ++k) overwrite(file_.text, next_word(file_.text, words), "0");
        }
        check_rest(line);
    }

    /// Behind point and normal come a colour of some numbers, which is blanked, and two texture coordinates,
    /// which are kept with a single blank between: the reader counts blanks to tell them apart.
    void check_rest(Span line) {
        const Span all = line;
        std::array<Span, 2> last;
        std::size_t words = 0;
        for (Span word = next_word(file_.text, line); !word.empty(); word = next_word(file_.text, line)) {
            last = {last[1], word};
            ++words;
        }
        if (!texcoords_) return overwrite(file_.text, all, "");
        if (words < 2) refuse("a vertex needs two texture coordinates.");
        bool lost = false;
        for (const Span& word : last) lost = zero_if_lost(word) || lost;
        if (lost) ++lost_uvs_;
        std::string pair;  // anew, because what was zeroed is shorter now
        for (Span word : last) pair += ' ' + std::string(next_word(file_.text, word).of(file_.text));
        overwrite(file_.text, all, pair);
    }

    bool zero_if_lost(Span word) {
        const auto value = parse_number(word.of(file_.text));
        if (!value) refuse("vertex " + std::to_string(vertex_) + " has too few numbers.");
        if (std::isfinite(*value)) return false;
        overwrite(file_.text, word, "0");
        return true;
    }

    void check_face() {
        Span line = filled_line("a face");
        const auto corners = parse_integer(next_word(file_.text, line).of(file_.text));
        if (!corners || *corners < 0) refuse("a face has to begin with its number of corners.");
        for (std::int64_t k = 0; k < *corners; ++k)
            if (!parse_integer(next_word(file_.text, line).of(file_.text)))
                refuse("a face has fewer than its " + std::to_string(*corners) + " corners.");
        overwrite(file_.text, line, "");
    }

    GuardedFile file_;
    Span rest_;
    std::size_t line_number_ = 0;
    std::uint64_t vertices_ = 0, vertex_ = 0;
    bool texcoords_ = false, normals_ = false;
    std::size_t lost_uvs_ = 0;
};

}  // namespace

GuardedFile guard_off(std::string text) { return OffGuard(std::move(text)).run(); }

}  // namespace patina

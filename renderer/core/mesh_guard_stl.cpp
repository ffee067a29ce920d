#include "renderer/core/mesh_guard.h"
#include "renderer/core/mesh_text.h"

#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace patina {
namespace {

constexpr std::size_t kHeader = 84;    // 80 bytes of anything, then the number of triangles
constexpr std::size_t kTriangle = 50;  // normal, three points, two bytes of anything

std::uint32_t little_endian_word(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k)
        word |= std::uint32_t(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
    return word;
}

bool is_finite_bits(std::uint32_t word) { return (word & 0x7f800000u) != 0x7f800000u; }

/// Many binary files start with "solid" too: text is what also says "facet", or nothing at all, in its first
/// lines.
bool looks_like_text(const std::string& text) {
    Span rest{0, std::min<std::size_t>(text.size(), 1024)};
    const std::string_view start = rest.of(text);
    if (start.find('\0') != std::string_view::npos) return false;
    const std::string_view word = next_word(text, rest).of(text);
    return word == "solid" || word == "facet" || word == "SOLID";
}

GuardedFile guard_binary(std::string text) {
    GuardedFile file;
    file.binary = true;
    if (text.size() < kHeader) throw std::runtime_error("it is too short for an STL file.");
    file.faces = little_endian_word(text, 80);
    const std::size_t held = (text.size() - kHeader) / kTriangle;
    if (file.faces > held)
        throw std::runtime_error("it is cut off: it promises " + std::to_string(file.faces) +
                                 " triangles but holds " + std::to_string(held) + ".");
    if (file.faces > kMaxMeshFaces)
        throw std::runtime_error("more than 100 million triangles are not supported.");
    std::size_t lost = 0;
    for (std::size_t t = 0; t < file.faces; ++t) {
        const std::size_t points = kHeader + t * kTriangle + 12;
        bool finite = true;
        for (std::size_t k = 0; k < 9; ++k)
            finite = finite && is_finite_bits(little_endian_word(text, points + 4 * k));
        if (finite) continue;
        std::memset(text.data() + points, 0, 36);  // without an area: the reader drops it
        ++lost;
    }
    file.faces -= lost;
    if (lost > 0)
        file.notes.push_back(std::to_string(lost) + " triangle(s) dropped: a corner is not a finite point.");
    file.text = std::move(text);
    return file;
}

/// Line by line as the reader goes: after a line with "outer" come three lines "vertex x y z".
class StlTextGuard {
public:
    explicit StlTextGuard(std::string text) { file_.text = std::move(text); }

    GuardedFile run() {
        unify_line_ends(file_.text);
        std::string& text = file_.text;
        Span rest{0, text.size()};
        std::size_t ends = 0;
        while (!rest.empty()) {
            const Span line = take_line(rest);
            Span words = line;
            const std::string_view word = next_word(text, words).of(text);
            if (word == "outer" || word == "OUTER")
                check_triangle(rest);
            else if (word == "endfacet" || word == "ENDFACET")
                ++ends;
            else if (word == "solid" || word == "SOLID" || word == "endsolid")
                overwrite(text, line, "");  // a name may say anything, "outer" included
            else if (word == "vertex" || word == "VERTEX")
                refuse("a vertex stands outside 'outer loop'.");
        }
        if (ends != file_.faces)
            throw std::runtime_error("it is cut off or damaged: " + std::to_string(file_.faces) +
                                     " triangles begin and " + std::to_string(ends) + " end.");
        if (lost_ > 0)
            file_.notes.push_back(std::to_string(lost_) +
                                  " triangle(s) dropped: a corner is not a finite point.");
        file_.faces -= lost_;
        return std::move(file_);
    }

private:
    Span take_line(Span& rest) {
        ++line_number_;
        return next_line(file_.text, rest);
    }
    [[noreturn]] void refuse(const std::string& what) const {
        throw std::runtime_error("line " + std::to_string(line_number_) + ": " + what);
    }

    void check_triangle(Span& rest) {
        std::array<Span, 3> numbers;
        bool finite = true;
        for (Span& three : numbers) {
            if (rest.empty()) refuse("the file ends in the middle of a triangle; it is cut off.");
            three = take_line(rest);
            const std::string_view word = next_word(file_.text, three).of(file_.text);
            if (word != "vertex" && word != "VERTEX")
                refuse("here has to be a vertex" +
                       std::string(rest.empty() ? "; the file is cut off." : "."));
            Span words = three;
            for (int k = 0; k < 3; ++k) {
                const auto value = parse_number(next_word(file_.text, words).of(file_.text));
                if (!value)
                    refuse("a vertex needs three numbers" +
                           std::string(rest.empty() ? "; the file is cut off." : "."));
                finite = finite && std::isfinite(*value);
            }
        }
        if (++file_.faces > kMaxMeshFaces) refuse("more than 100 million triangles are not supported.");
        if (finite) return;
        for (const Span& three : numbers) overwrite(file_.text, three, " 0 0 0");  // the reader drops it
        ++lost_;
    }

    GuardedFile file_;
    std::size_t line_number_ = 0;
    std::size_t lost_ = 0;
};

}  // namespace

GuardedFile guard_stl(std::string text) {
    const bool sizes_agree = text.size() >= kHeader &&
                             text.size() == kHeader + kTriangle * std::size_t(little_endian_word(text, 80));
    if (!sizes_agree && looks_like_text(text)) return StlTextGuard(std::move(text)).run();
    return guard_binary(std::move(text));
}

}  // namespace patina

#include "renderer/core/mesh_guard.h"
#include "renderer/core/mesh_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>

namespace patina {
namespace {

struct Type {
    std::string_view name, other_name;
    std::size_t size;
    bool is_float;
    std::string_view count_name;  ///< what the reader calls it as a list's length (lengths are below 2³¹)
};
constexpr std::array kTypes{
    Type{"char", "int8", 1, false, "uchar"},    Type{"uchar", "uint8", 1, false, "uchar"},
    Type{"short", "int16", 2, false, "uint16"}, Type{"ushort", "uint16", 2, false, "uint16"},
    Type{"int", "int32", 4, false, "int"},      Type{"uint", "uint32", 4, false, "int"},
    Type{"float", "float32", 4, true, ""},      Type{"double", "float64", 8, true, ""}};

/// What a property means here; Unused ones are skipped.
enum class Meaning { Unused, Position, Normal, Uv, Corners, CornerUvs };

struct Property {
    std::string name;  ///< as the reader knows it
    const Type* type = nullptr;
    const Type* count = nullptr;  ///< of a list
    Meaning meaning = Meaning::Unused;
    bool kept = true;
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
    std::size_t begin = 0, end = 0;  ///< in the text
    bool has_lists() const {
        return std::any_of(properties.begin(), properties.end(),
                           [](const Property& p) { return p.count != nullptr; });
    }
};

/// The names in use for what the reader calls x y z nx ny nz s t.
void give_meaning(Property& property, const std::string& element) {
    struct Row {
        std::string_view name, known_as;
        Meaning meaning;
    };
    static constexpr std::array rows{
        Row{"x", "x", Meaning::Position},    Row{"y", "y", Meaning::Position},
        Row{"z", "z", Meaning::Position},    Row{"nx", "nx", Meaning::Normal},
        Row{"ny", "ny", Meaning::Normal},    Row{"nz", "nz", Meaning::Normal},
        Row{"u", "s", Meaning::Uv},          Row{"v", "t", Meaning::Uv},
        Row{"s", "s", Meaning::Uv},          Row{"t", "t", Meaning::Uv},
        Row{"texture_u", "s", Meaning::Uv},  Row{"texture_v", "t", Meaning::Uv},
        Row{"texcoord_u", "s", Meaning::Uv}, Row{"texcoord_v", "t", Meaning::Uv}};
    if (element == "face" && property.count) {
        if (property.name == "vertex_index" || property.name == "vertex_indices")
            property.meaning = Meaning::Corners;
        if (property.name == "texcoord" && property.type->name == "float")
            property.meaning = Meaning::CornerUvs;
    }
    if (element != "vertex" || property.count) return;
    for (const Row& row : rows)
        if (property.name == row.name) {
            property.name = row.known_as;
            property.meaning = row.meaning;
        }
}

class PlyGuard {
public:
    explicit PlyGuard(std::string text) { file_.text = std::move(text); }

    GuardedFile run() {
        read_header();
        check_vertex_element();
        check_face_element();
        std::size_t at = body_;
        for (Element& element : elements_) {
            element.begin = at;
            at = file_.binary ? walk_binary(element, at) : walk_text(element, at);
            element.end = std::max(element.begin, kept_end_);
        }
        rebuild();
        return std::move(file_);
    }

private:
    [[noreturn]] static void refuse(const std::string& what) { throw std::runtime_error(what); }
    [[noreturn]] static void cut_off(const Element& element, std::uint64_t item) {
        refuse("it is cut off: it promises " + std::to_string(element.count) + " of element '" +
               element.name + "' but ends in number " + std::to_string(item + 1) + ".");
    }

    static const Type& type_named(std::string_view name) {
        for (const Type& type : kTypes)
            if (name == type.name || name == type.other_name) return type;
        refuse("the header has the unknown type '" + std::string(name.substr(0, 40)) + "'.");
    }

    void read_header() {
        Span rest{0, file_.text.size()};
        bool has_format = false;
        for (std::size_t number = 0;; ++number) {
            if (rest.empty()) refuse("it is cut off in the header: there is no end_header.");
            Span line = next_line(file_.text, rest);
            const std::string_view keyword = next_word(file_.text, line).of(file_.text);
            if (number == 0 && keyword != "ply" && keyword != "PLY") refuse("it does not begin with 'ply'.");
            if (keyword == "end_header") break;
            if (keyword == "format") {
                has_format = true;
                read_format(line);
            } else if (keyword == "element") {
                read_element(line);
            } else if (keyword == "property") {
                read_property(line);
            }
        }
        if (!has_format) refuse("its header does not say which format the data have.");
        body_ = rest.begin;
    }

    void read_format(Span line) {
        format_ = next_word(file_.text, line).of(file_.text);
        if (format_ != "ascii" && format_ != "binary_little_endian" && format_ != "binary_big_endian")
            refuse("its header has the unknown format '" + format_.substr(0, 40) + "'.");
        file_.binary = format_ != "ascii";
    }

    void read_element(Span line) {
        Element element;
        element.name = next_word(file_.text, line).of(file_.text);
        const std::string count(next_word(file_.text, line).of(file_.text));
        const auto value = parse_integer(count);
        if (!value || *value < 0 || *value > std::int64_t(std::max(kMaxMeshFaces, kMaxMeshVertices)))
            refuse("it promises " + count.substr(0, 40) + " of element '" + element.name.substr(0, 40) +
                   "'; more than 100 million are not supported.");
        element.count = std::uint64_t(*value);
        elements_.push_back(std::move(element));
    }

    void read_property(Span line) {
        if (elements_.empty()) refuse("its header has a property before any element.");
        const auto word = [&] { return next_word(file_.text, line).of(file_.text); };
        Property property;
        const std::string_view first = word();
        if (first == "list") {
            property.count = &type_named(word());
            if (property.count->is_float) refuse("its header has a list whose length is not a whole number.");
            property.type = &type_named(word());
        } else {
            property.type = &type_named(first);
        }
        property.name = word();
        give_meaning(property, elements_.back().name);
        elements_.back().properties.push_back(std::move(property));
    }

    Element& element_named(std::string_view name) {
        for (Element& element : elements_)
            if (element.name == name) return element;
        if (name == "face") refuse("it has no faces; point clouds and triangle strips are not supported.");
        refuse("it has no element '" + std::string(name) + "'.");
    }

    void check_vertex_element() {
        Element& vertex = element_named("vertex");
        std::string coordinates;
        int normals = 0;
        int uvs = 0;
        const bool pack = vertex.has_lists();
        for (Property& p : vertex.properties) {
            if (p.meaning == Meaning::Position) coordinates += p.name;
            normals += p.meaning == Meaning::Normal;
            uvs += p.meaning == Meaning::Uv;
            if (p.meaning != Meaning::Unused && file_.binary && !p.type->is_float)
                refuse("the vertex property '" + p.name + "' is a " + std::string(p.type->name) +
                       "; only float and double are supported.");
            p.kept = !pack || p.meaning != Meaning::Unused;
        }
        if (coordinates != "xyz") refuse("its vertices need the properties x, y, z, in this order.");
        for (Property& p : vertex.properties)  // half a normal is none
            if ((p.meaning == Meaning::Normal && normals != 3) || (p.meaning == Meaning::Uv && uvs != 2))
                p.meaning = Meaning::Unused;
    }

    void check_face_element() {
        Element& face = element_named("face");
        if (&face < &element_named("vertex"))
            refuse("its faces come before its vertices, which is not supported.");
        bool corners = false;
        for (Property& p : face.properties) {
            p.kept =
                (p.meaning == Meaning::Corners && !corners) || (p.meaning == Meaning::CornerUvs && corners);
            corners = corners || p.meaning == Meaning::Corners;
            if (p.meaning == Meaning::Corners && p.type->is_float)
                refuse("its faces count corners in fractions.");
            file_.has_lists = file_.has_lists || (p.kept && p.meaning == Meaning::CornerUvs);
        }
        if (!corners || face.count == 0)
            refuse("it has no faces; point clouds and triangle strips are not supported.");
        file_.faces = face.count;
    }

    std::uint64_t integer_at(std::size_t at, const Type& type) const {
        std::uint64_t value = 0;
        for (std::size_t k = 0; k < type.size; ++k) {
            const std::size_t from = format_ == "binary_big_endian" ? type.size - 1 - k : k;
            value |= std::uint64_t(static_cast<unsigned char>(file_.text[at + from])) << (8 * k);
        }
        return value;
    }

    /// Returns the position behind the element. Dropped properties are squeezed out; kept_end_ is the end of
    /// the rest.
    std::size_t walk_binary(const Element& element, std::size_t at) {
        std::size_t stride = 0;
        for (const Property& p : element.properties) stride += p.type->size;
        if (!element.has_lists()) {
            if (stride > 0 && element.count > (file_.text.size() - at) / stride)
                cut_off(element, (file_.text.size() - at) / stride);
            return kept_end_ = at + element.count * stride;
        }
        kept_end_ = at;
        for (std::uint64_t item = 0; item < element.count; ++item)
            for (const Property& p : element.properties) {
                const std::size_t begin = at;
                std::uint64_t values = 1;
                if (p.count) {
                    if (file_.text.size() - at < p.count->size) cut_off(element, item);
                    values = integer_at(at, *p.count);
                    at += p.count->size;
                }
                if ((file_.text.size() - at) / p.type->size < values) cut_off(element, item);
                at += values * p.type->size;
                if (!p.kept) continue;
                if (kept_end_ != begin) std::memmove(&file_.text[kept_end_], &file_.text[begin], at - begin);
                kept_end_ += at - begin;
            }
        return at;
    }

    /// The same for words; dropped ones are blanked.
    std::size_t walk_text(const Element& element, std::size_t at) {
        Span rest{at, file_.text.size()};
        for (std::uint64_t item = 0; item < element.count && !element.properties.empty(); ++item)
            for (const Property& p : element.properties) {
                std::uint64_t values = 1;
                if (p.count) {
                    const Span word = next_word(file_.text, rest);
                    const auto length = parse_integer(word.of(file_.text));
                    if (!length && word.empty()) cut_off(element, item);
                    if (!length || *length < 0) refuse_word(element, item, word);
                    if (!p.kept) overwrite(file_.text, word, "");
                    values = std::uint64_t(*length);
                }
                for (std::uint64_t k = 0; k < values; ++k) check_word(element, item, p, rest);
            }
        return kept_end_ = rest.begin;
    }

    [[noreturn]] void refuse_word(const Element& element, std::uint64_t item, Span word) const {
        refuse(element.name + " " + std::to_string(item + 1) + " has the unreadable value '" +
               std::string(word.of(file_.text).substr(0, 40)) + "'.");
    }

    void check_word(const Element& element, std::uint64_t item, const Property& p, Span& rest) {
        const Span word = next_word(file_.text, rest);
        if (word.empty()) cut_off(element, item);
        if (p.kept && p.meaning == Meaning::Corners) {
            const auto index = parse_integer(word.of(file_.text));
            if (!index || std::abs(*index) > 0x7fffffff) refuse_word(element, item, word);
        } else if (p.kept && p.meaning != Meaning::Unused) {
            const auto value = parse_number(word.of(file_.text));
            if (!value) refuse_word(element, item, word);
            if (std::isfinite(*value)) return;
            overwrite(file_.text, word, "0");
            if (p.meaning == Meaning::Position &&
                (file_.lost_positions.empty() || file_.lost_positions.back() != item))
                file_.lost_positions.push_back(std::uint32_t(item));
        } else if (!p.kept) {
            overwrite(file_.text, word, "");
        }
    }

    std::string header_of(const Element& element) const {
        std::string header = "element " + element.name + " " + std::to_string(element.count) + "\n";
        int unused = 0;
        for (const Property& p : element.properties) {
            if (!p.kept) continue;
            header += "property ";
            if (p.count) header += "list " + std::string(p.count->count_name) + " ";
            header += std::string(p.type->name) + " ";
            header += p.meaning == Meaning::Unused ? "unused_" + std::to_string(unused++) : p.name;
            header += "\n";
        }
        return header;
    }

    /// Vertices and faces, in words the reader knows.
    void rebuild() {
        const Element& vertex = element_named("vertex");
        const Element& face = element_named("face");
        std::string header =
            "ply\nformat " + format_ + " 1.0\n" + header_of(vertex) + header_of(face) + "end_header\n";
        std::string& text = file_.text;
        text.erase(face.end);
        text.erase(vertex.end, face.begin - vertex.end);
        text.replace(0, vertex.begin, header);
        if (!file_.binary && text.back() != '\n') text += '\n';
    }

    GuardedFile file_;
    std::string format_;
    std::vector<Element> elements_;
    std::size_t body_ = 0;
    std::size_t kept_end_ = 0;
};

}  // namespace

GuardedFile guard_ply(std::string text) { return PlyGuard(std::move(text)).run(); }

}  // namespace patina

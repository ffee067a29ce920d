#include "renderer/core/mesh_io.h"

#include "renderer/core/file_io.h"
#include "renderer/core/mesh_guard.h"
#include "renderer/core/mesh_soup.h"

#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/OFFReader.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <locale>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace patina {
namespace {

namespace fs = std::filesystem;
namespace om = OpenMesh;

enum class Format { Obj, Ply, Off, Stl };

struct FormatRow {
    Format format;
    const char* extension;
    GuardedFile (*guard)(std::string text);
};
constexpr std::array kFormats{
    FormatRow{Format::Obj, "obj", guard_obj}, FormatRow{Format::Ply, "ply", guard_ply},
    FormatRow{Format::Off, "off", guard_off}, FormatRow{Format::Stl, "stl", guard_stl}};

/// Where OpenMesh's readers keep properties they do not know; big enough from the start for what the header
/// promises.
class PropertyStore : public om::BaseKernel {
public:
    std::size_t vertices = 0, faces = 0;
    std::size_t n_vertices() const override { return vertices; }
    std::size_t n_faces() const override { return faces; }
};

/// Takes what a reader reports into plain arrays. OpenMesh's own meshes are half-edge structures, which
/// cannot hold faces around a non-manifold edge or vertex, nor two normals at one; this holds anything.
///
/// The OBJ reader reports the normal and texture coordinate of each corner, as those of the vertex, right
/// before the face they belong to: per_corner takes them for that face only.
class SoupImporter : public om::IO::BaseImporter {
public:
    SoupImporter(PolygonSoup& soup, bool per_corner, std::stop_token stop)
        : soup_(soup), per_corner_(per_corner), stop_(std::move(stop)) {}

    om::VertexHandle add_vertex(const om::Vec3f& point) override {
        if (soup_.positions.size() % 4096 == 0) check_stop();
        soup_.positions.emplace_back(point[0], point[1], point[2]);
        return om::VertexHandle(int(soup_.positions.size()) - 1);
    }
    om::VertexHandle add_vertex() override { return add_vertex(om::Vec3f(0.0f)); }
    void set_point(om::VertexHandle v, const om::Vec3f& point) override {
        soup_.positions[std::size_t(v.idx())] = {point[0], point[1], point[2]};
    }
    void set_normal(om::VertexHandle v, const om::Vec3f& n) override {
        normals_.set(v.idx(), soup_.positions.size(), face_, {n[0], n[1], n[2]});
    }
    void set_normal(om::VertexHandle v, const om::Vec3d& n) override { set_normal(v, om::Vec3f(n)); }
    void set_texcoord(om::VertexHandle v, const om::Vec2f& uv) override {
        uvs_.set(v.idx(), soup_.positions.size(), face_, {uv[0], uv[1]});
    }

    om::FaceHandle add_face(const VHandles& corners) override {
        if (face_ % 4096 == 0) check_stop();
        const std::size_t before = soup_.corner_position.size();
        if (!normals_.empty()) soup_.corner_normal.resize(before, glm::vec3(0.0f));
        if (!uvs_.empty()) soup_.corner_uv.resize(before, kNoUv);
        for (const om::VertexHandle v : corners) {
            soup_.corner_position.push_back(std::uint32_t(v.idx()));
            if (!normals_.empty())
                soup_.corner_normal.push_back(normals_.get(v.idx(), face_, per_corner_, glm::vec3(0.0f)));
            if (!uvs_.empty()) soup_.corner_uv.push_back(uvs_.get(v.idx(), face_, per_corner_, kNoUv));
        }
        soup_.face_begin.push_back(std::uint32_t(soup_.corner_position.size()));
        return om::FaceHandle(int(face_++));
    }

    void reserve(unsigned vertices, unsigned /*edges*/, unsigned faces) override {
        store_.vertices = vertices;
        store_.faces = faces;
        soup_.positions.reserve(vertices);
        soup_.face_begin.reserve(std::size_t(faces) + 1);
    }
    om::BaseKernel* kernel() override { return &store_; }
    std::size_t n_vertices() const override { return soup_.positions.size(); }
    std::size_t n_faces() const override { return face_; }
    std::size_t n_edges() const override { return 0; }

    /// What a mesh for display has no use for.
    om::HalfedgeHandle add_edge(om::VertexHandle, om::VertexHandle) override { return om::HalfedgeHandle(); }
    om::FaceHandle add_face(om::HalfedgeHandle) override { return om::FaceHandle(); }
    void add_face_texcoords(om::FaceHandle, om::VertexHandle, const std::vector<om::Vec2f>&) override {}
    void add_face_texcoords(om::FaceHandle, om::VertexHandle, const std::vector<om::Vec3f>&) override {}
    void set_face_texindex(om::FaceHandle, int) override {}
    void set_halfedge(om::VertexHandle, om::HalfedgeHandle) override {}
    void set_texcoord(om::VertexHandle, const om::Vec3f&) override {}
    void set_texcoord(om::HalfedgeHandle, const om::Vec2f&) override {}
    void set_texcoord(om::HalfedgeHandle, const om::Vec3f&) override {}
    void set_color(om::VertexHandle, const om::Vec3uc&) override {}
    void set_color(om::VertexHandle, const om::Vec4uc&) override {}
    void set_color(om::VertexHandle, const om::Vec3f&) override {}
    void set_color(om::VertexHandle, const om::Vec4f&) override {}
    void set_color(om::EdgeHandle, const om::Vec3uc&) override {}
    void set_color(om::EdgeHandle, const om::Vec4uc&) override {}
    void set_color(om::EdgeHandle, const om::Vec3f&) override {}
    void set_color(om::EdgeHandle, const om::Vec4f&) override {}
    void set_color(om::FaceHandle, const om::Vec3uc&) override {}
    void set_color(om::FaceHandle, const om::Vec4uc&) override {}
    void set_color(om::FaceHandle, const om::Vec3f&) override {}
    void set_color(om::FaceHandle, const om::Vec4f&) override {}
    void set_status(om::VertexHandle, const om::Attributes::StatusInfo&) override {}
    void set_status(om::HalfedgeHandle, const om::Attributes::StatusInfo&) override {}
    void set_status(om::EdgeHandle, const om::Attributes::StatusInfo&) override {}
    void set_status(om::FaceHandle, const om::Attributes::StatusInfo&) override {}
    void set_normal(om::FaceHandle, const om::Vec3f&) override {}
    void set_normal(om::FaceHandle, const om::Vec3d&) override {}
    void set_next(om::HalfedgeHandle, om::HalfedgeHandle) override {}
    void set_face(om::HalfedgeHandle, om::FaceHandle) override {}
    void request_face_texcoords2D() override {}
    void add_texture_information(int, std::string) override {}

private:
    /// A value a vertex, and the face it was last set for.
    template <class Value>
    struct Attribute {
        std::vector<Value> values;
        std::vector<std::uint32_t> faces;
        bool empty() const { return values.empty(); }
        void set(int vertex, std::size_t vertices, std::uint32_t face, const Value& value) {
            if (vertex < 0 || std::size_t(vertex) >= vertices) return;
            if (values.size() < vertices) {
                values.resize(vertices);
                faces.resize(vertices, ~0u);
            }
            values[std::size_t(vertex)] = value;
            faces[std::size_t(vertex)] = face;
        }
        Value get(int vertex, std::uint32_t face, bool only_this_face, const Value& otherwise) const {
            if (vertex < 0 || std::size_t(vertex) >= values.size()) return otherwise;
            const std::uint32_t set_for = faces[std::size_t(vertex)];
            return set_for == ~0u || (only_this_face && set_for != face) ? otherwise
                                                                         : values[std::size_t(vertex)];
        }
    };

    void check_stop() const {
        if (stop_.stop_requested()) throw std::runtime_error("reading it was stopped.");
    }

    PolygonSoup& soup_;
    bool per_corner_;
    std::stop_token stop_;
    PropertyStore store_;
    Attribute<glm::vec3> normals_;
    Attribute<glm::vec2> uvs_;
    std::uint32_t face_ = 0;
};

/// While this lives no other thread is inside OpenMesh's readers, and numbers are read with a decimal point
/// whatever the program's global C++ locale is (the OBJ reader makes streams of its own).
class ReaderLease {
public:
    ReaderLease() {
        while (busy().test_and_set(std::memory_order_acquire)) busy().wait(true, std::memory_order_relaxed);
        omerr().disable();
        omlog().disable();
        if (std::locale() != std::locale::classic())
            locale_before_ = std::locale::global(std::locale::classic());
    }
    ~ReaderLease() {
        if (locale_before_) std::locale::global(*locale_before_);
        busy().clear(std::memory_order_release);
        busy().notify_one();
    }
    ReaderLease(const ReaderLease&) = delete;
    ReaderLease& operator=(const ReaderLease&) = delete;
    ReaderLease(ReaderLease&&) = delete;
    ReaderLease& operator=(ReaderLease&&) = delete;

private:
    static std::atomic_flag& busy() {
        static std::atomic_flag flag;
        return flag;
    }
    std::optional<std::locale> locale_before_;
};

/// The corner texture coordinates that MeshLab writes as a list of 2n floats a face.
void take_corner_uvs(om::BaseKernel& store, PolygonSoup& soup) {
    om::FPropHandleT<std::vector<float>> property;
    if (!store.get_property_handle(property, "texcoord")) return;
    soup.corner_uv.assign(soup.corner_position.size(), kNoUv);
    for (std::size_t f = 0; f + 1 < soup.face_begin.size(); ++f) {
        const std::vector<float>& list = store.property(property, om::FaceHandle(int(f)));
        const std::size_t begin = soup.face_begin[f];
        const std::size_t corners = soup.face_begin[f + 1] - begin;
        if (list.size() != 2 * corners) continue;
        for (std::size_t k = 0; k < corners; ++k) soup.corner_uv[begin + k] = {list[2 * k], list[2 * k + 1]};
    }
}

PolygonSoup read_polygons(const fs::path& file, const FormatRow& row, GuardedFile guarded,
                          const std::stop_token& stop) {
    PolygonSoup soup;
    SoupImporter importer(soup, row.format == Format::Obj, stop);
    om::IO::Options options = om::IO::Options::VertexNormal | om::IO::Options::VertexTexCoord;
    if (guarded.binary) options += om::IO::Options::Binary;
    if (guarded.has_lists) options += om::IO::Options::Custom;
    std::istringstream stream(std::move(guarded.text));
    {
        const ReaderLease lease;
        // What an OFF file's vertices hold the reader learns only here, from the header on disk.
        const bool known = row.format != Format::Off || om::IO::OFFReader().can_u_read(file.string());
        if (!known || !om::IO::IOManager().read(stream, row.extension, importer, options))
            throw std::runtime_error("OpenMesh cannot read it.");
    }
    if (guarded.has_lists) take_corner_uvs(*importer.kernel(), soup);
    if (!soup.corner_normal.empty()) soup.corner_normal.resize(soup.corner_position.size(), glm::vec3(0.0f));
    if (!soup.corner_uv.empty()) soup.corner_uv.resize(soup.corner_position.size(), kNoUv);
    for (const std::uint32_t lost : guarded.lost_positions)
        soup.positions.at(lost) = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    soup.faces_without_area = guarded.faces - std::min(guarded.faces, soup.face_begin.size() - 1);
    return soup;
}

std::string lower_extension(const fs::path& file) {
    std::string extension = path_text(file.extension());
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    return extension.empty() ? extension : extension.substr(1);
}

/// By extension; what says of itself that it is PLY is read as PLY whatever it is called.
const FormatRow& format_of(const fs::path& file, const std::string& text) {
    std::string extension = lower_extension(file);
    if (extension == "stla" || extension == "stlb") extension = "stl";
    if (text.starts_with("ply\n") || text.starts_with("ply\r")) extension = "ply";
    for (const FormatRow& row : kFormats)
        if (extension == row.extension) return row;
    throw std::runtime_error("'." + extension +
                             "' is not a mesh format that can be read; use OBJ, PLY, OFF or STL.");
}

std::string load_text(const fs::path& file) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (!error && size > kMaxMeshFileBytes)
        throw std::runtime_error(path_text(file) + ": more than 4 GiB are not supported.");
    const std::vector<std::byte> bytes = read_file(file);
    const auto* begin = reinterpret_cast<const char*>(bytes.data());
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    std::string_view text(begin, bytes.size());
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    return std::string(text);
}

}  // namespace

Mesh load_mesh(const fs::path& file, const std::stop_token& stop) {
    std::string text = load_text(file);
    try {
        if (text.empty()) throw std::runtime_error("it is empty.");
        const FormatRow& row = format_of(file, text);
        GuardedFile guarded = row.guard(std::move(text));
        std::vector<std::string> notes = std::move(guarded.notes);
        if (row.extension != lower_extension(file).substr(0, 3))
            notes.insert(notes.begin(),
                         "The file is named otherwise but was read as ." + std::string(row.extension) + ".");
        Mesh mesh = make_mesh(read_polygons(file, row, std::move(guarded), stop));
        mesh.name = path_text(file.stem());
        mesh.notes.insert(mesh.notes.begin(), notes.begin(), notes.end());
        return mesh;
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(path_text(file) + ": there is not enough memory to read it.");
    } catch (const std::exception& error) {
        throw std::runtime_error(path_text(file) + ": " + error.what());
    }
}

}  // namespace patina

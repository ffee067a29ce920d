#include "renderer/gl/surfaces.h"

#include "renderer/gl/program.h"
#include "renderer/gl/read_state.h"
#include "renderer/gl/texture.h"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace patina::gl {

namespace {

constexpr std::uint32_t kMixedPixel = 0x80000000u;
constexpr int kRoomStep = 32;  ///< rows: pictures that differ little have the same room

/// Never a power of two: a software renderer compiles all that reads the texture anew where one side becomes
/// one.
int room_for(int rows) { return std::max((rows + kRoomStep - 1) / kRoomStep, 1) * kRoomStep + 1; }

/// In the order of shaders/stored.glsl: normals, turns, scalars, colours, emission. 0: not kept.
std::array<GLenum, 5> formats_of(SurfaceLayers kept) {
    const GLenum scalars = kept.maps ? GL_RGBA32F : kept.turns ? GL_R32F : 0;
    const auto if_kept = [](bool is_kept) { return GLenum(is_kept ? GL_RGBA32F : 0); };
    return {GL_RGBA32F, if_kept(kept.turns), scalars, if_kept(kept.maps), if_kept(kept.emission)};
}

std::uint64_t bytes_a_fragment(SurfaceLayers kept) {
    std::uint64_t bytes = 0;
    for (const GLenum format : formats_of(kept)) bytes += format == 0 ? 0 : format == GL_R32F ? 4 : 16;
    return bytes;
}

std::uint64_t texels_in(glm::ivec2 size) { return std::uint64_t(size.x) * std::uint64_t(size.y); }

void exact_texels(GLenum kind) {
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(kind, filter, GL_NEAREST);
    glTexParameteri(kind, GL_TEXTURE_MAX_LEVEL, 0);
}

/// One level without multisampling; data may be nullptr.
Texture make_texture(GLenum internal, glm::ivec2 size, std::pair<GLenum, GLenum> external, const void* data) {
    Texture texture = Texture::make();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GLint(internal), size.x, size.y, 0, external.first, external.second, data);
    exact_texels(GL_TEXTURE_2D);
    return texture;
}

Texture make_layer(GLenum internal, glm::ivec2 size, int samples) {
    if (samples == 1) return make_texture(internal, size, {GL_RGBA, GL_FLOAT}, nullptr);
    Texture texture = Texture::make();
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture.name());
    glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, internal, size.x, size.y, GL_TRUE);
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
    return texture;
}

void attach(int place, GLenum kind, const Texture& texture) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + GLenum(place), kind, texture.name(), 0);
}

/// first: the attachment of the first layer, 0 or, where what comes before them is drawn, too, 1.
void draw_into(std::size_t first, SurfaceLayers kept) {
    const std::array<GLenum, 5> formats = formats_of(kept);
    std::array<GLenum, 1 + formats.size()> places{GL_COLOR_ATTACHMENT0};
    for (std::size_t i = 0; i < formats.size(); ++i)
        places[first + i] = formats[i] == 0 ? GL_NONE : GL_COLOR_ATTACHMENT0 + GLenum(first + i);
    glDrawBuffers(GLsizei(first + formats.size()), places.data());
}

void require_complete(glm::ivec2 size) {
    check_memory("the surface of the picture");
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    throw std::runtime_error("The graphics driver cannot keep the surface of a picture of " +
                             std::to_string(size.x) + "×" + std::to_string(size.y) +
                             ": choose a smaller size.");
}

/// Layers with room for the rows, old's where they fit.
void make_room(GpuSurfaces& surfaces, SurfaceLayers kept, GpuSurfaces old) {
    const std::array<GLenum, 5> formats = formats_of(kept);
    const auto fits = [](int rows, int room) { return room >= rows && room <= 2 * (rows + kRoomStep); };
    const auto is_alike = [](const Texture& layer, GLenum format) { return bool(layer) == (format != 0); };
    if (std::ranges::equal(old.layers, formats, is_alike) && fits(surfaces.mesh_rows, old.mesh_room) &&
        fits(surfaces.rows, old.room)) {
        surfaces.mesh_room = old.mesh_room;
        surfaces.room = old.room;
        surfaces.layers = std::move(old.layers);
        return;
    }
    surfaces.mesh_room = room_for(surfaces.mesh_rows);
    surfaces.room = room_for(surfaces.rows);
    for (std::size_t i = 0; i < formats.size(); ++i)
        if (formats[i] != 0)
            surfaces.layers[i] = make_texture(formats[i], {GpuSurfaces::kWidth, surfaces.mesh_room},
                                              {GL_RGBA, GL_FLOAT}, nullptr);
}

/// Where every fragment was found, and which fragments make up a pixel.
struct Sorted {
    struct Place {
        std::uint16_t x = 0, y = 0, sample = 0, unused = 0;
    };
    std::vector<Place> mesh, behind;
    std::vector<std::uint32_t> pixels;                ///< a fragment, or kMixedPixel and a row of mixed
    std::vector<std::array<std::uint32_t, 4>> mixed;  ///< fragments of the samples
    int mesh_rows = 0, rows = 0;
};

int rows_of(std::size_t fragments) {
    return int((fragments + GpuSurfaces::kWidth - 1) / GpuSurfaces::kWidth);
}

constexpr std::uint32_t kBehindMark = 0x40000000u;

/// The number of one fragment more. Those behind count from their own first, marked, until it is known how
/// many lie before them.
std::uint32_t add(Sorted& to, float id, Sorted::Place place) {
    auto& list = id > 0.0f ? to.mesh : to.behind;
    list.push_back(place);
    return std::uint32_t(list.size() - 1) | (id > 0.0f ? 0u : kBehindMark);
}

/// A pixel whose samples meet more than one triangle.
std::array<std::uint32_t, 4> add_mixed(Sorted& to, std::span<const float> ids, Sorted::Place place) {
    std::array<std::uint32_t, 4> numbers{};
    for (std::size_t i = 0; i < ids.size(); ++i) {
        place.sample = std::uint16_t(std::ranges::find(ids, ids[i]) - ids.begin());
        numbers[i] = place.sample < i ? numbers[place.sample] : add(to, ids[i], place);
    }
    return numbers;
}

void number_behind_after_mesh(Sorted& fragments) {
    fragments.mesh_rows = rows_of(fragments.mesh.size());
    fragments.rows = std::max(fragments.mesh_rows + rows_of(fragments.behind.size()), 1);
    const std::uint32_t first_behind = std::uint32_t(fragments.mesh_rows) * GpuSurfaces::kWidth;
    const auto placed = [&](std::uint32_t number) {
        return (number & kBehindMark) != 0 ? (number & ~kBehindMark) + first_behind : number;
    };
    for (std::uint32_t& number : fragments.pixels)
        if ((number & kMixedPixel) == 0) number = placed(number);
    for (auto& numbers : fragments.mixed)
        for (std::uint32_t& number : numbers) number = placed(number);
}

/// fragments: four a pixel, 0 where a sample meets nothing; of fewer samples the first fills the rest.
Sorted sorted(const std::vector<float>& fragments, glm::ivec2 size, int samples) {
    Sorted result;
    result.pixels.resize(texels_in(size));
    result.mesh.reserve(texels_in(size));
    result.behind.reserve(texels_in(size));
    const float* ids = fragments.data();
    std::uint32_t* pixel = result.pixels.data();
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x, ids += 4, ++pixel) {
            const Sorted::Place place{std::uint16_t(x), std::uint16_t(y)};
            if (ids[0] == ids[1] && ids[0] == ids[2] && ids[0] == ids[3]) {
                *pixel = add(result, ids[0], place);
                continue;
            }
            *pixel = kMixedPixel | std::uint32_t(result.mixed.size());
            result.mixed.push_back(add_mixed(result, {ids, std::size_t(samples)}, place));
        }
    number_behind_after_mesh(result);
    return result;
}

Texture make_places(const Sorted& fragments) {
    const int rows = room_for(fragments.rows);
    std::vector<Sorted::Place> places(std::size_t(rows) * GpuSurfaces::kWidth);
    std::ranges::copy(fragments.mesh, places.begin());
    std::ranges::copy(fragments.behind,
                      places.begin() + std::ptrdiff_t(fragments.mesh_rows) * GpuSurfaces::kWidth);
    return make_texture(GL_RGBA16UI, {GpuSurfaces::kWidth, rows}, {GL_RGBA_INTEGER, GL_UNSIGNED_SHORT},
                        places.data());
}

Texture make_mixed(Sorted& fragments) {
    const int rows = room_for(rows_of(fragments.mixed.size()));
    fragments.mixed.resize(std::size_t(rows) * GpuSurfaces::kWidth);
    return make_texture(GL_RGBA32UI, {GpuSurfaces::kWidth, rows}, {GL_RGBA_INTEGER, GL_UNSIGNED_INT},
                        fragments.mixed.data());
}

int most_rows() {
    GLint most = 1024;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    return most;
}

}  // namespace

void draw_all(GLuint program, GLuint nothing, glm::ivec4 box) {
    glViewport(box.x, box.y, box.z, box.w);
    glDisable(GL_DEPTH_TEST);
    glUseProgram(program);
    glBindVertexArray(nothing);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

bool SurfaceScratch::fits(glm::ivec2 size_px, int samples, SurfaceLayers kept) const {
    return size_px_ == size_px && samples_ == samples && kept_ == kept;
}

std::uint64_t SurfaceScratch::bytes_for(glm::ivec2 size_px, int samples, SurfaceLayers kept) {
    return texels_in(size_px) * std::uint64_t(samples) * (bytes_a_fragment(kept) + 8);
}

void SurfaceScratch::make(glm::ivec2 size_px, int samples, SurfaceLayers kept) {
    *this = {};
    const KeepTextureBindings keep;
    framebuffer_ = Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    size_px_ = size_px;
    samples_ = samples;
    fragments_ = make_layer(GL_R32F, size_px, samples);
    attach(0, kind(), fragments_);
    const std::array<GLenum, 5> formats = formats_of(kept);
    for (std::size_t i = 0; i < formats.size(); ++i) {
        if (formats[i] == 0) continue;
        layers_[i] = make_layer(formats[i], size_px, samples);
        attach(1 + int(i), kind(), layers_[i]);
    }
    draw_into(1, kept);
    depth_ = Renderbuffer::make();
    glBindRenderbuffer(GL_RENDERBUFFER, depth_.name());
    if (samples > 1)
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, size_px.x,
                                         size_px.y);
    else
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size_px.x, size_px.y);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
    require_complete(size_px);
    kept_ = kept;
}

void SurfaceScratch::begin() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    draw_into(1, kept_);
    glViewport(0, 0, size_px_.x, size_px_.y);
    const GLfloat far = 1.0f;
    const GLfloat nothing[] = {0.0f, 0.0f, 0.0f, 0.0f};
    glClearBufferfv(GL_DEPTH, 0, &far);
    glClearBufferfv(GL_COLOR, 0, nothing);
}

void SurfaceScratch::bind_layers() const {
    bind_texture(kFragmentPlacesUnit, GL_TEXTURE_2D, fragments_);
    for (std::size_t i = 0; i < layers_.size(); ++i)
        if (layers_[i]) bind_texture(kFirstStoredUnit + GLuint(i), GL_TEXTURE_2D, layers_[i]);
}

std::vector<float> SurfaceScratch::read_fragments(const SurfacePrograms& programs) {
    if (!ids_) {
        ids_ = make_texture(GL_RGBA32F, size_px_, {GL_RGBA, GL_FLOAT}, nullptr);
        ids_framebuffer_ = Framebuffer::make();
        glBindFramebuffer(GL_FRAMEBUFFER, ids_framebuffer_.name());
        attach(0, GL_TEXTURE_2D, ids_);
        require_complete(size_px_);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, ids_framebuffer_.name());
    bind_texture(kPictureUnit, kind(), fragments_);
    draw_all(programs.fragments, programs.nothing, {0, 0, size_px_});
    const KeepReadState pack;
    std::vector<float> fragments(4 * texels_in(size_px_));
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, size_px_.x, size_px_.y, GL_RGBA, GL_FLOAT, fragments.data());
    return fragments;
}

/// Copies every fragment of the mesh to its place.
void SurfaceScratch::draw_sorted(const GpuSurfaces& surfaces, const SurfacePrograms& programs) const {
    const Framebuffer framebuffer = Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        if (!layers_[i]) continue;
        attach(int(i), GL_TEXTURE_2D, surfaces.layers[i]);
        bind_texture(kFirstStoredUnit + GLuint(i), kind(), layers_[i]);
    }
    draw_into(0, kept_);
    require_complete({GpuSurfaces::kWidth, surfaces.mesh_rows});
    shade_rows(surfaces, StoredRows::Mesh, programs.sorted, programs.nothing);
}

GpuSurfaces SurfaceScratch::finish(const SurfacePrograms& programs, GpuSurfaces old) {
    const KeepTextureBindings keep;
    Sorted fragments = sorted(read_fragments(programs), size_px_, samples_);
    if (room_for(fragments.rows) > most_rows())
        throw std::runtime_error("The picture has more fragments than the graphics driver has room for.");
    GpuSurfaces surfaces{.size_px = size_px_,
                         .samples = samples_,
                         .kept = kept_,
                         .mesh_rows = fragments.mesh_rows,
                         .rows = fragments.rows,
                         .layers = {},
                         .places = make_places(fragments),
                         .fragment_of_pixel = {},
                         .fragments_of_samples = {},
                         .mesh_fragments = fragments.mesh.size(),
                         .bytes = 0};
    make_room(surfaces, kept_, std::move(old));
    bind_texture(kFragmentPlacesUnit, GL_TEXTURE_2D, surfaces.places);
    draw_sorted(surfaces, programs);
    surfaces.fragment_of_pixel =
        make_texture(GL_R32UI, size_px_, {GL_RED_INTEGER, GL_UNSIGNED_INT}, fragments.pixels.data());
    surfaces.fragments_of_samples = make_mixed(fragments);
    check_memory("the surface of the picture");
    const std::uint64_t a_column =
        bytes_a_fragment(kept_) * std::uint64_t(surfaces.mesh_room) + 8 * std::uint64_t(surfaces.room);
    surfaces.bytes =
        a_column * GpuSurfaces::kWidth + 4 * texels_in(size_px_) + 16 * std::uint64_t(fragments.mixed.size());
    return surfaces;
}

void bind_surface_layers(const GpuSurfaces& surfaces) {
    bind_texture(kFragmentPlacesUnit, GL_TEXTURE_2D, surfaces.places);
    for (std::size_t i = 0; i < surfaces.layers.size(); ++i)
        if (surfaces.layers[i]) bind_texture(kFirstStoredUnit + GLuint(i), GL_TEXTURE_2D, surfaces.layers[i]);
}

void bind_surface_pixels(const GpuSurfaces& surfaces) {
    bind_texture(kFragmentOfPixelUnit, GL_TEXTURE_2D, surfaces.fragment_of_pixel);
    bind_texture(kFragmentsOfSamplesUnit, GL_TEXTURE_2D, surfaces.fragments_of_samples);
}

void begin_shading(StoredPicture& picture, std::shared_ptr<const GpuSurfaces> surfaces, bool full_float) {
    const glm::ivec2 extent{GpuSurfaces::kWidth, surfaces->room};
    if (!picture.colors || picture.extent != extent) {
        const KeepTextureBindings keep;
        picture.framebuffer = Framebuffer::make();
        glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer.name());
        picture.colors =
            make_texture(full_float ? GL_RGBA32F : GL_RGBA16F, extent, {GL_RGBA, GL_FLOAT}, nullptr);
        attach(0, GL_TEXTURE_2D, picture.colors);
        require_complete(extent);
        picture.extent = extent;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer.name());
    const GLfloat empty[] = {0.0f, 0.0f, 0.0f, 0.0f};
    glClearBufferfv(GL_COLOR, 0, empty);
    picture.surfaces = std::move(surfaces);
}

void shade_rows(const GpuSurfaces& surfaces, StoredRows rows, GLuint program, GLuint nothing) {
    const bool mesh = rows == StoredRows::Mesh;
    const int first = mesh ? 0 : surfaces.mesh_rows;
    const int count = (mesh ? surfaces.mesh_rows : surfaces.rows) - first;
    if (count > 0) draw_all(program, nothing, {0, first, GpuSurfaces::kWidth, count});
}

}  // namespace patina::gl

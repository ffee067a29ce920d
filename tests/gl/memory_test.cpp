// A driver without memory: what has a coarser form is drawn in that, all else is refused in one sentence.
#include "renderer/gl/target.h"
#include "renderer/gl/texture.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>

namespace patina {
namespace {

using namespace test;

/// Stands in for the driver's own functions in libepoxy's table while it lives: what refuse says true to gets
/// no memory.
class SmallCard {
public:
    using Refuse = std::function<bool(int width)>;
    SmallCard(Refuse textures, Refuse written, Refuse buffers, Refuse multisampled) {
        renderer();  // fills the table
        glGetError();
        textures_ = std::move(textures);
        written_ = std::move(written);
        buffers_ = std::move(buffers);
        multisampled_ = std::move(multisampled);
        error_ = std::exchange(epoxy_glGetError, [] {
            return std::exchange(out_of_memory_, false) ? GLenum(GL_OUT_OF_MEMORY) : error_();
        });
        glTexImage2D(GL_PROXY_TEXTURE_2D, 0, GL_R8, 1, 1, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
        texture_ = std::exchange(epoxy_glTexImage2D, tex_image);
        part_ = std::exchange(epoxy_glTexSubImage2D, tex_sub_image);
        buffer_ = std::exchange(epoxy_glBufferData, buffer_data);
        samples_ = std::exchange(epoxy_glTexImage2DMultisample, tex_image_multisample);
    }
    ~SmallCard() {
        epoxy_glGetError = error_;
        epoxy_glTexImage2D = texture_;
        epoxy_glTexSubImage2D = part_;
        epoxy_glBufferData = buffer_;
        epoxy_glTexImage2DMultisample = samples_;
        out_of_memory_ = false;
    }
    SmallCard(const SmallCard&) = delete;
    SmallCard& operator=(const SmallCard&) = delete;

private:
    static bool refuses(const Refuse& refuse, int size) {
        if (refuse && refuse(size)) out_of_memory_ = true;
        return out_of_memory_;
    }
    static void tex_image(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height,
                          GLint border, GLenum format, GLenum type, const void* pixels) {
        if (!refuses(textures_, width))
            texture_(target, level, internal, width, height, border, format, type, pixels);
    }
    static void tex_sub_image(GLenum target, GLint level, GLint x, GLint y, GLsizei width, GLsizei height,
                              GLenum format, GLenum type, const void* pixels) {
        if (!refuses(written_, width)) part_(target, level, x, y, width, height, format, type, pixels);
    }
    static void buffer_data(GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
        if (!refuses(buffers_, int(size))) buffer_(target, size, data, usage);
    }
    static void tex_image_multisample(GLenum target, GLsizei samples, GLenum internal, GLsizei width,
                                      GLsizei height, GLboolean fixed) {
        if (!refuses(multisampled_, width)) samples_(target, samples, internal, width, height, fixed);
    }

    static inline bool out_of_memory_ = false;
    static inline Refuse textures_, written_, buffers_, multisampled_;
    static inline PFNGLGETERRORPROC error_ = nullptr;
    static inline PFNGLTEXIMAGE2DPROC texture_ = nullptr;
    static inline PFNGLTEXSUBIMAGE2DPROC part_ = nullptr;
    static inline PFNGLBUFFERDATAPROC buffer_ = nullptr;
    static inline PFNGLTEXIMAGE2DMULTISAMPLEPROC samples_ = nullptr;
};

bool all(int) { return true; }

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

MapLevels red_map(int side) {
    const Image image = make_picture(side, side, [](int, int) { return glm::ivec3(255, 0, 0); });
    return make_map_levels(image, MapKind::Color, ColorSpace::Srgb);
}

/// The colour that a map shows as on a quad that glows with it.
glm::vec3 glow(const MapHandle& map) {
    Scene scene = make_scene(nullptr, quad());
    scene.material.emission.value = glm::vec3(1.0f);
    scene.maps[std::size_t(MapSlot::Emission)] = map;
    return center(radiance_of(scene));
}

TEST(Memory, a_map_falls_back_to_the_finest_level_that_has_a_place) {
    for (const bool late : {false, true}) {  // refused at once, or where it is written
        MapHandle map;
        {
            const auto large = [](int width) { return width > 100; };
            const SmallCard card(late ? nullptr : SmallCard::Refuse(large),
                                 late ? SmallCard::Refuse(large) : nullptr, nullptr, nullptr);
            map = renderer().upload_map(red_map(512));
        }
        EXPECT_NE(Renderer::note_of(*map).find("64×64 of 512×512"), std::string::npos)
            << Renderer::note_of(*map);
        EXPECT_EQ(glow(map), glm::vec3(1.0f, 0.0f, 0.0f));
        EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    }
    EXPECT_EQ(Renderer::note_of(*renderer().upload_map(red_map(512))), "");
}

TEST(Memory, what_has_no_place_at_all_is_refused_in_one_sentence) {
    const Environment panorama = make_panorama([](glm::vec3) { return glm::vec3(1.0f); });
    const BakedEnvironment baked = make_baked([](glm::vec3, float) { return glm::vec3(1.0f); });
    Mesh mesh;
    mesh.vertices.resize(3);
    mesh.vertices[1].position.x = mesh.vertices[2].position.y = 1.0f;
    mesh.indices = {0, 1, 2};
    const TargetHandle undrawn = renderer().make_target(glm::ivec2(64), 1);
    const Scene scene = make_scene(nullptr, quad());
    const std::pair<const char*, std::function<void()>> uploads[] = {
        {"a map", [] { renderer().upload_map(red_map(256)); }},
        {"a map", [] { renderer().upload_map(red_map(1)); }},
        {"the mesh", [&] { renderer().upload_mesh(mesh); }},
        {"the light", [&] { renderer().upload_environment(panorama, baked); }},
        {"the picture", [] { renderer().make_target(glm::ivec2(64), 1); }},
        {"the picture", [&] { renderer().draw(scene, *undrawn); }},
    };
    for (const auto& [what, upload] : uploads) {
        std::string said;
        {
            const SmallCard card(all, all, all, all);
            said = refusal(upload);
        }
        EXPECT_NE(said.find(std::string("no memory left for ") + what), std::string::npos) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
        EXPECT_EQ(refusal(upload), "");  // and all is well when there is memory again
    }
}

TEST(Memory, a_picture_that_has_no_place_with_smooth_edges_is_drawn_without) {
    Scene scene = make_scene(constant_light(1.0f), sphere());
    const TargetHandle target = renderer().make_target(glm::ivec2(64), 4);
    {
        const SmallCard card(nullptr, nullptr, nullptr, all);
        renderer().draw(scene, *target);
    }
    EXPECT_EQ(target->samples, 1);
    EXPECT_GT(center(renderer().read_radiance(*target)).y, 0.1f);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST(Memory, radiance_has_a_place_only_where_it_is_drawn_into) {
    const Scene scene = make_scene(constant_light(1.0f), sphere());
    const TargetHandle target = renderer().make_target(glm::ivec2(64), 4);
    renderer().draw(scene, *target, Reuse::Expected);
    ASSERT_TRUE(target->stored.surfaces);
    EXPECT_FALSE(target->radiance);
    const glm::vec3 stored = center(renderer().read_radiance(*target));
    renderer().draw(scene, *target);
    EXPECT_TRUE(target->radiance);
    const glm::vec3 at_once = center(renderer().read_radiance(*target));
    EXPECT_NEAR(stored.y, at_once.y, 1e-3f * at_once.y);
    renderer().draw(scene, *target, Reuse::Expected);
    EXPECT_EQ(center(renderer().read_radiance(*target)), stored);
}

}  // namespace
}  // namespace patina

// Light that lay ready on disk gives the picture that decoding gives, bit for bit.
#include "app/scene_loader.h"
#include "app/temporary_folder.h"
#include "materials/text_io.h"
#include "renderer/core/image_io.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

using namespace test;

/// A panorama with a lamp that is kept apart from it, as a file.
void write_room(const std::filesystem::path& file) {
    const Environment room = make_panorama(
        [](glm::vec3 d) {
            const float lamp =
                glm::dot(d, glm::normalize(glm::vec3(0.4f, 0.7f, -0.6f))) > 0.9998f ? 9000.0f : 0.0f;
            return glm::vec3(0.3f + 0.2f * d.y + lamp, 0.4f + lamp, 0.6f - 0.3f * d.x + lamp);
        },
        256);
    save_image(file, radiance_image(room));
}

struct Look {
    const char* preset;
    Shading shading;
    Background background;
};

TEST(KeptLight, draws_the_picture_of_what_was_decoded_bit_for_bit) {
    const TemporaryFolder folder("patina-kept");
    const std::filesystem::path file = folder.path() / "room.exr";
    write_room(file);
    const Registry registry = builtin_parts();
    const WorkLedger& work = renderer().work();
    for (const Look& look : {Look{"plastic-glossy-red", Shading::Fitted, Background::Environment},
                             Look{"gold", Shading::SplitSum, Background::Blurred},
                             Look{"porcelain", Shading::Fitted, Background::Plain}}) {
        const BakeCache cache{.folder = folder.path() / look.preset};
        std::vector<Image> radiance, display;
        for (const std::uint64_t decoded : {1u, 0u}) {
            SceneLoader loader(renderer(), registry, {.cache = cache});
            SceneOptions options{.size_px = glm::ivec2(96)};
            options.view.shading = look.shading;
            options.view.background = look.background;
            Scene scene = loader.scene(look.preset, options);
            const WorkLedger before = work;
            scene.environment = loader.environment(path_to_utf8(file), loader.needed_light(scene));
            const WorkLedger done = since(work, before);
            EXPECT_EQ(done.environments_decoded, decoded) << look.preset;
            EXPECT_EQ(done.environments_from_disk, 1 - decoded) << look.preset;
            if (decoded == 0) {
                EXPECT_EQ(done.levels_baked + done.irradiance_bakes + done.sphere_transforms, 0u);
            }
            radiance.push_back(radiance_of(scene, options.size_px, 4));
            display.push_back(display_of(scene, options.size_px, 4));
        }
        EXPECT_EQ(radiance[0].bytes, radiance[1].bytes) << look.preset;
        EXPECT_EQ(display[0].bytes, display[1].bytes) << look.preset;
    }
}

TEST(SceneLoader, gives_a_mesh_that_has_tangents_to_whoever_needs_none) {
    const Registry registry = builtin_parts();
    const WorkLedger& work = renderer().work();
    SceneLoader loader(renderer(), registry, {});
    const SceneOptions options{.size_px = glm::ivec2(96)};
    const WorkLedger before = work;
    const Scene painted = loader.scene("worn-paint", options);  // has a normal map
    const Scene gold = loader.scene("gold", options);
    const WorkLedger done = since(work, before);
    EXPECT_EQ(done.meshes_loaded, 1u);
    EXPECT_EQ(done.meshes_from_memory, 1u);
    EXPECT_EQ(gold.mesh, painted.mesh);
    SceneLoader alone(renderer(), registry, {});
    const Scene bare = alone.scene("gold", options);
    EXPECT_NE(bare.mesh, gold.mesh);
    EXPECT_EQ(display_of(bare, options.size_px, 4).bytes, display_of(gold, options.size_px, 4).bytes);
}

}  // namespace
}  // namespace patina

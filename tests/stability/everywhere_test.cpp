// The same preset, the same picture: whatever the number of threads, the instruction set and the
// build.
#include "app/headless.h"
#include "app/registry.h"
#include "app/scene_loader.h"
#include "renderer/core/image_io.h"
#include "renderer/ibl/bench.h"
#include "tests/stability/process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <hwy/targets.h>
#include <sched.h>
#include <vector>

namespace patina {
namespace {

using namespace test;

struct Difference {
    int largest = 0;  ///< of 255 steps
    double mean = 0.0;
};
Difference difference(const Image& a, const Image& b) {
    Difference result;
    EXPECT_EQ(a.bytes.size(), b.bytes.size());
    for (std::size_t i = 0; i < std::min(a.bytes.size(), b.bytes.size()); ++i) {
        const int step = std::abs(int(a.bytes[i]) - int(b.bytes[i]));
        result.largest = std::max(result.largest, step);
        result.mean += double(step) / double(a.bytes.size());
    }
    return result;
}

/// Every shipped preset, small, one after the other, under light baked here and now.
std::vector<Image> sheet(std::size_t every) {
    static auto* context = new HeadlessContext;  // lives until the process ends
    static auto* renderer = new Renderer;
    static_cast<void>(context);
    const Registry registry = builtin_parts();
    const Folder cache;
    SceneLoader loader(*renderer, registry, {.cache = {.folder = cache.path}});
    const EnvironmentHandle light = loader.environment("studio");
    std::vector<Image> pictures;
    const std::vector<std::filesystem::path> presets = shipped_presets();
    EXPECT_FALSE(presets.empty());
    for (std::size_t i = 0; i < presets.size(); i += every) {
        Scene scene = loader.scene(presets[i].string(), {});
        scene.environment = light;
        const TargetHandle target = renderer->make_target(glm::ivec2(64), 1);
        renderer->draw(scene, *target);
        pictures.push_back(renderer->read_display(*target));
    }
    return pictures;
}

void use_instruction_sets(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

void expect_the_same_on_every_instruction_set(std::size_t every) {
    const std::vector<Image> best = sheet(every);
    const std::int64_t all = hwy::SupportedTargets();
    // The plainest, and the best there is, which is what ran already: the lowest bit is the best.
    std::int64_t plainest = all;
    while ((plainest & (plainest - 1)) != 0) plainest &= plainest - 1;
    use_instruction_sets(plainest);
    const std::vector<Image> plain = sheet(every);
    testing::Test::RecordProperty("instruction_set", ibl_instruction_set());
    use_instruction_sets(0);
    ASSERT_EQ(best.size(), plain.size());
    for (std::size_t i = 0; i < best.size(); ++i) {
        const Difference found = difference(best[i], plain[i]);
        EXPECT_LE(found.largest, 2) << "preset " << i;
        EXPECT_LE(found.mean, 0.02) << "preset " << i;
    }
}

TEST(Everywhere, simd_or_not_a_few_presets_look_the_same) { expect_the_same_on_every_instruction_set(12); }
TEST(SlowEverywhere, simd_or_not_every_preset_looks_the_same) { expect_the_same_on_every_instruction_set(1); }

/// Two builds of the same tree, one perhaps with sanitizers, bake and draw the presets each for itself.
void expect_the_same_from_another_build(std::size_t every) {
    const char* other = std::getenv("PATINA_OTHER_PROGRAM");
    if (!other) GTEST_SKIP() << "PATINA_OTHER_PROGRAM names no other build (`./patina test asan` does)";
    std::vector<Image> pictures;
    for (const std::string program : {PATINA_PROGRAM, other}) {
        const Folder folder;
        std::vector<std::string> words{program, "compare"};
        const std::vector<std::filesystem::path> presets = shipped_presets();
        for (std::size_t i = 0; i < presets.size(); i += every) words.push_back(presets[i].string());
        words.insert(words.end(), {"--env", "studio", "-o", "a.png", "--size", "64x64"});
        const Ended ended = run_process(words, {.environment = {{"PATINA_CACHE_DIR", folder.path.string()},
                                                                {"ASAN_OPTIONS", "detect_leaks=0"}},
                                                .folder = folder.path});
        ASSERT_EQ(ended.exit_status, 0) << program << ": " << ended.errors;
        pictures.push_back(load_image(folder.path / "a.png").image);
    }
    const Difference found = difference(pictures[0], pictures[1]);
    EXPECT_LE(found.largest, 2);
    EXPECT_LE(found.mean, 0.02);
}

TEST(Everywhere, another_build_draws_a_few_presets_the_same) { expect_the_same_from_another_build(12); }
TEST(SlowEverywhere, another_build_draws_every_preset_the_same) { expect_the_same_from_another_build(1); }

/// Through the program, pinned to one processor and with one rasterizer thread, against two.
TEST(Everywhere, one_thread_or_two_give_the_same_file) {
    std::vector<Image> pictures;
    for (const char* threads : {"1", "2"}) {
        const Folder folder;
        std::vector<std::string> words{"render", "gold", "-o", "a.png", "--size", "96x96", "--env", "sunset"};
        cpu_set_t before, one;
        sched_getaffinity(0, sizeof before, &before);
        one = before;
        if (threads[0] == '1') {
            int first = 0;
            while (!CPU_ISSET(first, &before)) ++first;
            CPU_ZERO(&one);
            CPU_SET(first, &one);
        }
        sched_setaffinity(0, sizeof one, &one);  // a started process inherits it
        const Ended ended = run_patina(folder, words, {.environment = {{"LP_NUM_THREADS", threads}}});
        sched_setaffinity(0, sizeof before, &before);
        ASSERT_EQ(ended.exit_status, 0) << ended.errors;
        pictures.push_back(load_image(folder.path / "a.png").image);
    }
    EXPECT_EQ(difference(pictures[0], pictures[1]).largest, 0);
}

}  // namespace
}  // namespace patina

// Every program that the features of a material can ask for, compiled and linked: a subset every day
// (shaders_test.cpp), all of them in the slow suite, in parts.
#include "renderer/features.h"
#include "renderer/gl/program.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>

namespace patina {
namespace {

using namespace test;

constexpr int kParts = 8;

/// A fragment shader of the mesh, and which of kParts parts of the feature sets it is compiled with.
using Part = std::tuple<const char*, int>;

class SlowShaders : public testing::TestWithParam<Part> {};

/// The reference's two, which read what was rasterised before.
bool is_of_reference(const std::string& fragment) { return fragment.starts_with("reference"); }

/// Those that differ to that shader: the reference's reads maps and emission alone.
std::set<Features> feature_sets(const std::string& fragment) {
    std::set<Features> sets;
    for (const Features features : all_features())
        sets.insert(is_of_reference(fragment) ? reference_features(features) : features);
    return sets;
}

TEST_P(SlowShaders, every_permutation_compiles) {
    renderer();
    const auto& [name, part] = GetParam();
    const gl::ShaderText fragment = gl::embedded_shader(name);
    const bool is_reference = is_of_reference(fragment.name);
    const gl::ShaderText vertex = gl::embedded_shader(is_reference ? "display.vert.glsl" : "mesh.vert.glsl");
    int compiled = 0, index = 0;
    for (const Features features : feature_sets(name)) {
        if (index++ % kParts != part) continue;
        std::vector<std::string> defines = defines_of(features);
        if (fragment.name == "rivals.frag.glsl")
            defines.push_back("RIVAL_SAMPLES=" + std::to_string(compiled % 2 * 16));
        if (is_reference && (features & ~Features(Feature::Emission)) != 0)
            defines.emplace_back("HAS_STORED_MAPS");
        ASSERT_NO_THROW(gl::make_program(vertex, fragment, defines)) << features;
        ++compiled;
    }
    EXPECT_GE(compiled, index / kParts);
    EXPECT_GT(compiled, 0);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

/// "mesh_part_1_of_8".
std::string name_of(const testing::TestParamInfo<Part>& info) {
    const std::string name = std::get<0>(info.param);
    return name.substr(0, name.find('.')) + "_part_" + std::to_string(std::get<1>(info.param) + 1) + "_of_" +
           std::to_string(kParts);
}

INSTANTIATE_TEST_SUITE_P(SlowPermutations, SlowShaders,
                         testing::Combine(testing::Values("mesh.frag.glsl", "reference.frag.glsl",
                                                          "reference_cells.frag.glsl", "rivals.frag.glsl"),
                                          testing::Range(0, kParts)),
                         name_of);

}  // namespace
}  // namespace patina

#include "renderer/brdf.h"
#include "renderer/features.h"
#include "renderer/gl/program.h"
#include "renderer/gl/target.h"
#include "renderer/tonemap.h"
#include "tests/gl/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

namespace patina {
namespace {

using namespace test;

TEST(Shaders, permutations_of_few_and_of_nearly_all_features_compile) {
    renderer();
    const auto vertex = gl::embedded_shader("mesh.vert.glsl");
    const auto fragment = gl::embedded_shader("mesh.frag.glsl");
    const std::vector<Features> all = all_features();
    EXPECT_EQ(std::set<Features>(all.begin(), all.end()).size(), all.size());
    // Every pair of features is met on, off and one without the other; all sets: permutations_test.cpp.
    std::set<Features> chosen;
    for (const Features features : all) {
        const int set = std::popcount(features);
        if (set <= 3 || set >= 9) chosen.insert(features);
    }
    for (const Features features : chosen)
        ASSERT_NO_THROW(gl::make_program(vertex, fragment, defines_of(features))) << features;
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST(Shaders, features_are_only_what_the_material_uses) {
    Material material;
    material.roughness.value = 0.5f;
    MapRanges bound;
    const float light = 0.1f;
    View view;
    EXPECT_EQ(features_of(material, bound, view, light), Features(Feature::Fitted));
    view.quality = Quality::High;
    EXPECT_EQ(features_of(material, bound, view, light),
              Features(Feature::Fitted) | Features(Feature::FourLevels));
    view.shading = Shading::SplitSum;
    EXPECT_EQ(features_of(material, bound, view, light), 0u);
    material.roughness.value = 0.12f;
    EXPECT_EQ(features_of(material, bound, view, light), 0u);
    view = {};
    EXPECT_EQ(features_of(material, bound, view, light),
              Features(Feature::Fitted) | Features(Feature::Sharp));
    view.shading = Shading::SplitSum;
    material.roughness.value = 0.05f;
    EXPECT_EQ(features_of(material, bound, view, light), Features(Feature::Sharp));
    EXPECT_EQ(features_of(material, bound, view, 0.0f), 0u);
    bound.fill(ChannelRanges{});
    material.roughness.value = 1.0f;
    material.normal.value = 0.0f;  // flat, whatever the map says
    const Features features = features_of(material, bound, {}, light);
    EXPECT_TRUE(has(features, Feature::AlbedoMap));
    EXPECT_TRUE(has(features, Feature::RoughnessMap));
    EXPECT_TRUE(has(features, Feature::Sharp));
    EXPECT_FALSE(has(features, Feature::MetallicMap));  // its value is 0
    EXPECT_FALSE(has(features, Feature::NormalMap));
    EXPECT_FALSE(has(features, Feature::EmissionMap));
    EXPECT_FALSE(has(features, Feature::Debug));
    // Of what the map holds, times the value, the least counts.
    ValueRange& held = (*bound[std::size_t(MapSlot::Roughness)])[std::size_t(material.roughness.channel)];
    held = {0.2f, 0.8f};
    EXPECT_FALSE(has(features_of(material, bound, {}, light), Feature::Sharp));
    material.roughness.value = 0.6f;
    EXPECT_TRUE(has(features_of(material, bound, {}, light), Feature::Sharp));
    material.roughness.value = 1.0f;
    material.roughness.invert = true;
    EXPECT_FALSE(has(features_of(material, bound, {}, light), Feature::Sharp));
    held = {0.2f, 0.95f};
    EXPECT_TRUE(has(features_of(material, bound, {}, light), Feature::Sharp));
    material.roughness = {};
    const auto all = all_features();
    for (unsigned bits = 0; bits < 64; ++bits) {
        for (const Named<DebugView>& debug : kDebugViews) {
            view.debug = debug.value;
            view.shading = kShadings[bits % kShadings.size()].value;
            view.quality = kQualities[bits / 4 % kQualities.size()].value;
            material.metallic.value = material.normal.value = 1.0f;
            material.emission.value = glm::vec3(bits % 3 == 0 ? 0.0f : 1.0f);
            MapRanges maps;
            for (std::size_t slot = 0; slot < maps.size(); ++slot)
                if ((bits >> slot & 1u) != 0) maps[slot] = ChannelRanges{};
            const Features some = features_of(material, maps, view, light);
            EXPECT_TRUE(std::find(all.begin(), all.end(), some) != all.end()) << some;
        }
    }
}

TEST(Shaders, an_error_names_file_and_line) {
    renderer();
    const gl::ShaderText vertex = gl::embedded_shader("display.vert.glsl");
    const gl::ShaderText broken{
        "broken.glsl",
        "// nothing\n#include \"brdf.glsl\"\nout vec4 color;\nvoid main() { color = wrong; }\n"};
    try {
        gl::make_program(vertex, broken);
        FAIL() << "it compiled";
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("broken.glsl:4"), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
    try {
        gl::make_program(vertex, {"outer.glsl", "#include \"no_such.glsl\"\nvoid main() {}\n"});
        FAIL() << "it compiled";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("no_such.glsl"), std::string::npos);
    }
}

/// Runs an expression over a grid of (x, y) in (0, 1)² on the GPU: result[y · size + x].
std::vector<glm::vec4> evaluate(const std::string& includes, const std::string& expression, int size) {
    renderer();
    RenderTarget target = gl::make_render_target(glm::ivec2(size), 1, true);
    const gl::ShaderText fragment{
        "grid.glsl", includes + "\nout vec4 color;\nvoid main() {\n vec2 p = gl_FragCoord.xy / " +
                         std::to_string(size) + ".0;\n color = " + expression + ";\n}\n"};
    const gl::Program program = gl::make_program(gl::embedded_shader("display.vert.glsl"), fragment);
    const gl::VertexArray nothing = gl::VertexArray::make();
    gl::bind_radiance(target);
    glViewport(0, 0, size, size);
    glUseProgram(program.name());
    glBindVertexArray(nothing.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<glm::vec4> pixels(std::size_t(size) * size);
    glReadPixels(0, 0, size, size, GL_RGBA, GL_FLOAT, pixels.data());
    glUseProgram(0);
    glBindVertexArray(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return pixels;
}

/// |a − b| ≤ 1e-4 of the larger of b and 1.
void expect_near(const glm::vec3& a, const glm::vec3& b, glm::vec2 p) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a[c], b[c], 1e-4f * std::max(std::abs(b[c]), 1.0f)) << p.x << " " << p.y;
}

constexpr int kGrid = 32;

template <class Reference>
void expect_agreement(const std::string& includes, const std::string& expression,
                      const Reference& reference) {
    const auto gpu = evaluate(includes, expression, kGrid);
    for (int y = 0; y < kGrid; ++y) {
        for (int x = 0; x < kGrid; ++x) {
            const glm::vec2 p((float(x) + 0.5f) / kGrid, (float(y) + 0.5f) / kGrid);
            expect_near(glm::vec3(gpu[std::size_t(y) * kGrid + x]), reference(p), p);
        }
    }
}

TEST(Shaders, the_reflection_model_is_the_same_on_both_sides) {
    const std::string brdf = "#include \"brdf.glsl\"";
    expect_agreement(brdf, "vec4(fresnel_schlick(vec3(0.04, 0.5, p.y), p.x), 1.0)",
                     [](glm::vec2 p) { return brdf::fresnel_schlick(glm::vec3(0.04f, 0.5f, p.y), p.x); });
    expect_agreement(
        brdf, "vec4(fresnel_schlick_roughness(p.x, vec3(0.04, 0.5, 0.9), p.y), 1.0)",
        [](glm::vec2 p) { return brdf::fresnel_schlick_roughness(p.x, glm::vec3(0.04f, 0.5f, 0.9f), p.y); });
    expect_agreement(brdf,
                     "vec4(distribution_ggx(p.x, p.y), visibility_smith(p.x, 0.3, p.y), core_tangent2(p.x, "
                     "p.y, 1.0), 1.0)",
                     [](glm::vec2 p) {
                         return glm::vec3(brdf::distribution_ggx(p.x, p.y),
                                          brdf::visibility_smith(p.x, 0.3f, p.y),
                                          brdf::core_tangent2(p.x, p.y, 1.0f));
                     });
    const char* const kSum = "vec4(w.single + 2.0 * w.multiple + 3.0 * w.diffuse, 1.0)";
    const std::string split =
        brdf +
        "\nvec4 f(vec2 p) { ReflectionWeights w = split_sum_weights(vec3(0.9, 0.5, 0.1), p.y, "
        "vec2(0.9 * p.x, 0.1 * p.x)); return " +
        kSum + "; }";
    expect_agreement(split, "f(p)", [](glm::vec2 p) {
        const auto w = brdf::split_sum_weights({0.9f, 0.5f, 0.1f}, p.y, {0.9f * p.x, 0.1f * p.x});
        return w.single + 2.0f * w.multiple + 3.0f * w.diffuse;
    });
    const std::string course =
        brdf +
        "\nvec4 f(vec2 p) { ReflectionWeights w = course_weights(vec3(0.9, 0.5, 0.1), 0.5, p.y, "
        "p.x, vec2(0.8, 0.1)); return " +
        kSum + "; }";
    expect_agreement(course, "f(p)", [](glm::vec2 p) {
        const auto w = brdf::course_weights({0.9f, 0.5f, 0.1f}, 0.5f, p.y, p.x, {0.8f, 0.1f});
        return w.single + 2.0f * w.multiple + 3.0f * w.diffuse;
    });
    expect_agreement(
        brdf,
        "vec4(light_specular(vec3(0.04, 0.5, 0.9), p.x, vec3(p.y, 0.6, 0.7), vec2(0.2, 0.1 * p.y)), 1.0)",
        [](glm::vec2 p) {
            return brdf::light_specular({0.04f, 0.5f, 0.9f}, p.x, {p.y, 0.6f, 0.7f}, {0.2f, 0.1f * p.y});
        });
}

TEST(Shaders, the_lobes_formulas_are_the_same_on_both_sides) {
    const std::string brdf = "#include \"brdf.glsl\"";
    expect_agreement(brdf,
                     "vec4(fresnel_share(p.x, vec2(0.8 - 0.5 * p.y, 0.2 * p.y)), "
                     "lobe_coordinates(p.x, -4.0 * p.y), 1.0)",
                     [](glm::vec2 p) {
                         return glm::vec3(brdf::fresnel_share(p.x, {0.8f - 0.5f * p.y, 0.2f * p.y}),
                                          brdf::lobe_coordinates(p.x, -4.0f * p.y));
                     });
    expect_agreement(
        brdf, "vec4(swept_direction(vec3(p.x, 0.3, -p.y), vec3(0.0, 1.0, 0.0), 3.0 * p.y - 1.0, p.x), 1.0)",
        [](glm::vec2 p) {
            return brdf::swept_direction({p.x, 0.3f, -p.y}, {0.0f, 1.0f, 0.0f}, 3.0f * p.y - 1.0f, p.x);
        });
    expect_agreement(brdf, "vec4(sweep_weights(p.x, vec2(8.0 * p.y - 4.0, 2.0 - 3.0 * p.y)).yzw, 1.0)",
                     [](glm::vec2 p) {
                         const glm::vec4 w = brdf::sweep_weights(p.x, {8.0f * p.y - 4.0f, 2.0f - 3.0f * p.y});
                         return glm::vec3(w.y, w.z, w.w);
                     });
    expect_agreement(brdf, "vec4(multi_bounce_occlusion(p.x, vec3(0.1, p.y, 0.9)), 1.0)", [](glm::vec2 p) {
        return brdf::multi_bounce_occlusion(p.x, {0.1f, p.y, 0.9f});
    });
    expect_agreement(
        brdf, "vec4(specular_occlusion(p.x, p.y, 0.2), widened_roughness(p.x, p.y), luminance(p.xyx), 1.0)",
        [](glm::vec2 p) {
            return glm::vec3(brdf::specular_occlusion(p.x, p.y, 0.2f), brdf::widened_roughness(p.x, p.y),
                             brdf::luminance({p.x, p.y, p.x}));
        });
}

TEST(Shaders, the_tone_mappers_are_the_same_on_both_sides) {
    const std::string tone = "#include \"tonemap.glsl\"";
    const auto color = [](glm::vec2 p) { return glm::vec3(8.0f * p.x * p.x, p.y, 2.0f * p.x * p.y); };
    const std::string glsl = "vec3(8.0 * p.x * p.x, p.y, 2.0 * p.x * p.y)";
    expect_agreement(tone, "vec4(tonemap_neutral(" + glsl + "), 1.0)",
                     [&](glm::vec2 p) { return tone::tonemap_neutral(color(p)); });
    expect_agreement(tone, "vec4(tonemap_aces(" + glsl + "), 1.0)",
                     [&](glm::vec2 p) { return tone::tonemap_aces(color(p)); });
    expect_agreement(tone, "vec4(encode_srgb(p.x), decode_srgb(p.y), decode_srgb(encode_srgb(p.x)), 1.0)",
                     [](glm::vec2 p) { return glm::vec3(linear_to_srgb(p.x), srgb_to_linear(p.y), p.x); });
}

TEST(Tonemap, neutral_has_the_published_values) {
    // Grey below the toe loses 6.25 x², above it 0.04; base colours up to 0.8 keep their hue and nothing
    // passes 1.
    EXPECT_NEAR(tone::tonemap_neutral(glm::vec3(0.04f)).x, 6.25f * 0.0016f, 1e-6f);
    EXPECT_NEAR(tone::tonemap_neutral(glm::vec3(0.5f)).x, 0.46f, 1e-6f);
    EXPECT_NEAR(tone::tonemap_neutral(glm::vec3(0.8f)).x, 0.76f, 1e-6f);
    // 1.04 − 0.04 = 1: 1 − 0.24²/(1 + 0.24 − 0.76) = 0.88.
    EXPECT_NEAR(tone::tonemap_neutral(glm::vec3(1.04f)).x, 0.88f, 1e-5f);
    // (10, 0.04, 0.04): offset 0.03; peak 9.97 → 1 − 0.0576/9.45; desaturated by 1 − 1/(0.15 (9.97 − peak') +
    // 1).
    const glm::vec3 red = tone::tonemap_neutral({10.0f, 0.04f, 0.04f});
    const float peak = 1.0f - 0.0576f / 9.45f;
    const float g = 1.0f - 1.0f / (0.15f * (9.97f - peak) + 1.0f);
    EXPECT_NEAR(red.x, peak, 1e-5f);
    EXPECT_NEAR(red.y, glm::mix(0.01f * peak / 9.97f, peak, g), 1e-5f);
    EXPECT_LT(tone::tonemap_neutral(glm::vec3(1e6f)).x, 1.0f);
}

TEST(Tonemap, aces_has_the_fits_values) {
    // Grey is kept grey by both matrices; the curve alone: (x² + .0245786 x − .000090537)/(.983729 x² +
    // .4329510 x + .238081).
    for (const float x : {0.18f, 1.0f, 4.0f}) {
        const float expected =
            (x * (x + 0.0245786f) - 0.000090537f) / (x * (0.983729f * x + 0.4329510f) + 0.238081f);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(tone::tonemap_aces(glm::vec3(x))[c], expected, 2e-3f);
    }
    EXPECT_EQ(tone::tonemap_aces(glm::vec3(0.0f)), glm::vec3(0.0f));
    for (int c = 0; c < 3; ++c) {
        EXPECT_TRUE(std::isfinite(tone::tonemap_aces(glm::vec3(1e30f))[c]));
        EXPECT_LE(tone::tonemap_aces(glm::vec3(1e30f))[c], 1.0f);
    }
}

TEST(Tonemap, the_display_picture_is_the_tone_mapped_and_encoded_radiance) {
    for (const Named<Tonemap>& row : kTonemaps) {
        Scene scene = make_scene(constant_light(0.7f), nullptr);
        scene.view.tonemap = row.value;
        const glm::vec3 light(0.7f);
        const glm::vec3 mapped = row.value == Tonemap::Neutral ? tone::tonemap_neutral(light)
                                 : row.value == Tonemap::Aces  ? tone::tonemap_aces(light)
                                                               : light;
        const glm::vec3 expected = tone::encode_srgb(mapped);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(255 * center(display_of(scene, glm::ivec2(8)))[c], 255 * expected[c], 0.51f)
                << row.id;
    }
}

}  // namespace
}  // namespace patina

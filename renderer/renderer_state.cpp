// The renderer's programs and the textures that every picture reads.
#include "renderer/renderer_state.h"

#include "renderer/brdf.h"
#include "renderer/gl/brdf_table.h"
#include "renderer/gl/texture.h"
#include "renderer/lobes/lobe_table.h"

#include <cassert>

namespace patina {

gl::Texture make_brdf_texture() {
    assert(brdf::kAlbedoTableSize == float(kShadingTableSize));
    const gl::KeepTextureBindings keep;
    gl::Texture texture = gl::Texture::make();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG16, kShadingTableSize, kShadingTableSize, 0, GL_RG, GL_UNSIGNED_SHORT,
                 embedded::brdf_table().data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    return texture;
}

/// Pairs of slices, F0 = 1 first: the sweep over two levels; that over four; the lean of the latter's
/// weights.
gl::Texture make_lobe_texture() {
    constexpr int size = kLobeTableSize;
    std::vector<glm::vec4> texels(std::size_t(6) * size * size);
    for (int i = 0; i < size * size; ++i) {
        for (int metal = 0; metal < 2; ++metal) {
            const LobeNode& node = lobe_nodes()[i].by_reflectance[metal];
            const auto put = [&](int slice, glm::vec4 texel) {
                texels[std::size_t(slice + metal) * size * size + i] = texel;
            };
            const auto put_sweep = [&](int slice, const LobeSweep& sweep) {
                put(slice, {sweep.log2_ratio, sweep.kappa, sweep.slope, sweep.irradiance});
            };
            put_sweep(0, node.two);
            put_sweep(2, node.four);
            put(4, {node.four.lean, 0.0f, 0.0f});
        }
    }
    const gl::KeepTextureBindings keep;
    gl::Texture texture = gl::Texture::make();
    glBindTexture(GL_TEXTURE_3D, texture.name());
    glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA32F, size, size, 6, 0, GL_RGBA, GL_FLOAT, texels.data());
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTexParameteri(GL_TEXTURE_3D, axis, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAX_LEVEL, 0);
    return texture;
}

/// No light at all, for scenes that have none yet.
EnvironmentHandle make_darkness() {
    const CubeMap black{1, std::vector<glm::vec3>(6, glm::vec3(0.0f))};
    BakedEnvironment baked;
    baked.levels = {{1.0f, black}};
    baked.irradiance = black;
    Environment environment;
    environment.width = environment.height = 1;
    environment.radiance = {glm::vec3(0.0f)};
    return Renderer::begin_upload(std::make_shared<PreparedLight>(PreparedLight{
                                      make_panorama_levels(environment), make_light_levels(baked)}))
        .finish();
}

LightLayout layout_of(const GpuEnvironment& environment) {
    return {environment.panorama_scale,    environment.levels_scale, environment.irradiance_scale,
            environment.texels_per_radian, environment.layers,       environment.roughness,
            environment.sharpest,          environment.lights,       environment.panorama_lights};
}

Features features_for(const Scene& scene, const GpuEnvironment& environment) {
    return features_of(scene.material, Renderer::ranges_of(scene), scene.view, environment.sharpest);
}

void set_switches() {
    for (const GLenum off : {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_FRAMEBUFFER_SRGB,
                             GL_RASTERIZER_DISCARD, GL_COLOR_LOGIC_OP, GL_SAMPLE_ALPHA_TO_COVERAGE})
        glDisable(off);
    for (const GLenum on : {GL_DEPTH_TEST, GL_MULTISAMPLE, GL_TEXTURE_CUBE_MAP_SEAMLESS}) glEnable(on);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

gl::Program Renderer::State::compiled(const char* vertex, const char* fragment,
                                      const std::vector<std::string>& defines) {
    gl::ProgramText text(gl::embedded_shader(vertex), gl::embedded_shader(fragment), defines);
    const std::string key = programs.load ? gl::program_key(text) : std::string{};
    if (!key.empty())
        if (gl::Program kept = gl::program_from(programs.load(key))) {
            ++work.programs_from_disk;
            return kept;
        }
    ++work.programs_compiled;
    glFlush();  // software draws what was asked for so far while it compiles
    gl::Program program = gl::make_program(text);
    if (!key.empty())
        if (const std::vector<std::byte> bytes = gl::to_bytes(program); !bytes.empty())
            programs.save(key, bytes);
    return program;
}

void Renderer::State::count_draw(std::uint64_t triangles, std::uint64_t calls) {
    work.draw_calls += calls;
    work.triangles_drawn += triangles;
}

const gl::Program& Renderer::State::surface(Features features) {
    gl::Program& program = surfaces[features];
    if (!program) program = compiled("mesh.vert.glsl", "mesh.frag.glsl", defines_of(features));
    return program;
}

const gl::Program& Renderer::State::reference(Features features) {
    gl::Program& program = references[features];
    if (!program) program = compiled("display.vert.glsl", "reference.frag.glsl", stored_defines(features));
    return program;
}

const gl::Program& Renderer::State::cells_of(Features features) {
    gl::Program& program = reference_cells[features];
    if (!program)
        program = compiled("display.vert.glsl", "reference_cells.frag.glsl", stored_defines(features));
    return program;
}

const gl::Program& Renderer::State::rival(Features features, int samples) {
    gl::Program& program = rivals[{features, samples}];
    if (program) return program;
    std::vector<std::string> defines = defines_of(features);
    defines.push_back("RIVAL_SAMPLES=" + std::to_string(samples));
    program = compiled("mesh.vert.glsl", "rivals.frag.glsl", defines);
    return program;
}

const gl::Program& Renderer::State::background(Background background, bool stored_rays) {
    const bool blurred = background == Background::Blurred;
    gl::Program& program = backgrounds[(blurred ? 1 : 0) + (stored_rays ? 2 : 0)];
    if (program) return program;
    std::vector<std::string> defines;
    if (blurred) defines.emplace_back("HAS_BLUR");
    if (stored_rays) defines.emplace_back("HAS_STORED");
    program = compiled("display.vert.glsl", "background.frag.glsl", defines);
    return program;
}

const gl::Program& Renderer::State::display(int samples, Tonemap tonemap, bool stored_picture) {
    gl::Program& program = displays[{samples, int(tonemap), stored_picture}];
    if (program) return program;
    std::vector<std::string> defines{"TONEMAP=" + std::to_string(int(tonemap))};
    if (samples > 1) defines.push_back("SAMPLES=" + std::to_string(samples));
    if (stored_picture) defines.insert(defines.end(), {"HAS_STORED", stored_width()});
    program = compiled("display.vert.glsl", "display.frag.glsl", defines);
    return program;
}

}  // namespace patina

#include "renderer/gl/program.h"

#include "renderer/core/hash.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace patina::embedded {
std::span<const unsigned char> shaders(std::string_view file_name);
}

namespace patina::gl {

namespace {

constexpr std::string_view kInclude = "#include \"";

/// One stage's text: the files it is made of, in the order of their source string numbers, and the whole.
struct Expansion {
    std::vector<std::string> files;
    std::string text;
};

void expand(const ShaderText& shader, Expansion& out) {
    const std::size_t number = out.files.size();
    out.files.push_back(shader.name);
    const auto line_directive = [&](int line) {
        out.text += "#line " + std::to_string(line) + " " + std::to_string(number) + "\n";
    };
    line_directive(1);
    int line = 1;
    for (std::size_t at = 0; at < shader.text.size(); ++line) {
        const std::size_t end = std::min(shader.text.find('\n', at), shader.text.size());
        const std::string_view row(shader.text.data() + at, end - at);
        at = end + 1;
        if (row.substr(0, kInclude.size()) != kInclude) {
            out.text.append(row).append("\n");
            continue;
        }
        std::string_view path = row.substr(kInclude.size());
        path = path.substr(0, path.find('"'));
        const std::string name(path);
        if (std::find(out.files.begin(), out.files.end(), name) == out.files.end())
            expand(embedded_shader(name), out);
        line_directive(line + 1);
    }
}

/// The driver's log with source string numbers replaced by file names: "1:23(5): …" or "1(23) : …" becomes
/// "brdf.glsl:23…". Only the first line that names a place is kept: the others follow from it.
std::string readable_log(const std::string& log, const std::vector<std::string>& files) {
    std::string first;
    for (std::size_t at = 0; at < log.size();) {
        const std::size_t end = std::min(log.find('\n', at), log.size());
        std::string line = log.substr(at, end - at);
        at = end + 1;
        if (line.rfind("ERROR: ", 0) == 0) line.erase(0, 7);
        std::size_t digits = 0;
        while (digits < line.size() && std::isdigit(static_cast<unsigned char>(line[digits]))) ++digits;
        if (first.empty()) first = line;
        if (digits == 0 || digits > 4 || digits + 1 >= line.size()) continue;
        if (line[digits] != ':' && line[digits] != '(') continue;
        const auto file = std::size_t(std::stoul(line.substr(0, digits)));
        return (file < files.size() ? files[file] : "?") + ":" + line.substr(digits + 1);
    }
    return first;
}

std::string define_lines(std::span<const std::string> defines) {
    std::string text;
    for (std::string define : defines) {
        const std::size_t equals = define.find('=');
        if (equals == std::string::npos)
            define += " 1";
        else
            define[equals] = ' ';
        text += "#define " + define + "\n";
    }
    return text;
}

struct Stage {
    explicit Stage(GLenum kind) : name(glCreateShader(kind)) {}
    ~Stage() { glDeleteShader(name); }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    GLuint name;
};

void compile(const Stage& stage, const ProgramText::Stage& shader) {
    const char* pointer = shader.text.c_str();
    glShaderSource(stage.name, 1, &pointer, nullptr);
    glCompileShader(stage.name);
    GLint done = GL_FALSE;
    glGetShaderiv(stage.name, GL_COMPILE_STATUS, &done);
    if (done == GL_TRUE) return;
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(stage.name, GLsizei(log.size()), &length, log.data());
    log.resize(std::size_t(std::max(length, 0)));
    throw std::runtime_error("The graphics driver refuses the shader " + shader.name + ": " +
                             readable_log(log, shader.files));
}

ProgramText::Stage expanded(const ShaderText& shader, std::span<const std::string> defines) {
    Expansion expansion;
    expand(shader, expansion);
    return {shader.name, std::move(expansion.files),
            "#version 410 core\n#define PATINA_FN\n" + define_lines(defines) + expansion.text};
}

void bind_interface(GLuint program) {
    static constexpr std::pair<const char*, GLuint> samplers[] = {
        {"panorama_map", kPanoramaUnit},
        {"level_maps", kLevelsUnit},
        {"irradiance_map", kIrradianceUnit},
        {"brdf_table", kBrdfUnit},
        {"albedo_map", kFirstMapUnit + 0},
        {"roughness_map", kFirstMapUnit + 1},
        {"metallic_map", kFirstMapUnit + 2},
        {"ao_map", kFirstMapUnit + 3},
        {"normal_map", kFirstMapUnit + 4},
        {"emission_map", kFirstMapUnit + 5},
        {"lobe_table", kLobesUnit},
        {"picture", kPictureUnit},
        {"stored_normals", kFirstStoredUnit + 0},
        {"stored_turns", kFirstStoredUnit + 1},
        {"stored_scalars", kFirstStoredUnit + 2},
        {"stored_colors", kFirstStoredUnit + 3},
        {"stored_emissions", kFirstStoredUnit + 4},
        {"fragment_places", kFragmentPlacesUnit},
        {"stored_fragments", kFragmentPlacesUnit},
        {"reference_counts", kFragmentPlacesUnit},
        {"light_points", kLightPointsUnit},
        {"light_texels", kLightTexelsUnit},
        {"slice_points", kSlicePointsUnit},
        {"first_reflected_cells", kFirstReflectedCellsUnit},
        {"last_reflected_cells", kLastReflectedCellsUnit},
        {"fragment_of_pixel", kFragmentOfPixelUnit},
        {"picture_behind", kPictureBehindUnit},
        {"fragments_of_samples", kFragmentsOfSamplesUnit},
    };
    GLint previous = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &previous);
    glUseProgram(program);
    for (const auto& [name, unit] : samplers) {
        const GLint location = glGetUniformLocation(program, name);
        if (location >= 0) glUniform1i(location, GLint(unit));
    }
    glUseProgram(GLuint(previous));
    static constexpr std::pair<const char*, GLuint> uniform_blocks[] = {
        {"FrameBlock", kFrameSlot}, {"MaterialBlock", kMaterialSlot}, {"CellBlock", kCellSlot}};
    for (const auto& [name, slot] : uniform_blocks) {
        const GLuint index = glGetUniformBlockIndex(program, name);
        if (index != GL_INVALID_INDEX) glUniformBlockBinding(program, index, slot);
    }
}

}  // namespace

ShaderText embedded_shader(std::string_view name) {
    const auto bytes = embedded::shaders(name);
    if (bytes.empty())
        throw std::runtime_error("The shader " + std::string(name) + " is not part of this build.");
    return {std::string(name), std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())};
}

ProgramText::ProgramText(const ShaderText& vertex_shader, const ShaderText& fragment_shader,
                         std::span<const std::string> defines)
    : vertex(expanded(vertex_shader, defines)), fragment(expanded(fragment_shader, defines)) {}

Program make_program(const ShaderText& vertex, const ShaderText& fragment,
                     std::span<const std::string> defines) {
    return make_program(ProgramText(vertex, fragment, defines));
}

Program make_program(const ProgramText& text) {
    const Stage vertex_stage(GL_VERTEX_SHADER);
    const Stage fragment_stage(GL_FRAGMENT_SHADER);
    compile(vertex_stage, text.vertex);
    compile(fragment_stage, text.fragment);
    Program program = Program::make();
    glAttachShader(program.name(), vertex_stage.name);
    glAttachShader(program.name(), fragment_stage.name);
    static constexpr const char* attributes[] = {"vertex_position", "vertex_normal", "vertex_uv",
                                                 "vertex_tangent"};
    for (GLuint i = 0; i < 4; ++i) glBindAttribLocation(program.name(), i, attributes[i]);
    glProgramParameteri(program.name(), GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    glLinkProgram(program.name());
    GLint done = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &done);
    if (done != GL_TRUE) {
        std::string log(4096, '\0');
        GLsizei length = 0;
        glGetProgramInfoLog(program.name(), GLsizei(log.size()), &length, log.data());
        log.resize(std::size_t(std::max(length, 0)));
        throw std::runtime_error("The graphics driver cannot link " + text.vertex.name + " with " +
                                 text.fragment.name + ": " + log.substr(0, log.find('\n')));
    }
    glDetachShader(program.name(), vertex_stage.name);
    glDetachShader(program.name(), fragment_stage.name);
    bind_interface(program.name());
    return program;
}

std::string program_key(const ProgramText& text) {
    GLint formats = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    if (formats < 1) return {};
    std::string all;
    for (const GLenum each : {GL_VENDOR, GL_RENDERER, GL_VERSION}) {
        const auto* const word = reinterpret_cast<const char*>(glGetString(each));
        all.append(word ? word : "").push_back('\n');
    }
    all += text.vertex.text + text.fragment.text;
    char name[48];
    std::snprintf(name, sizeof name, "%016llx-%zx",
                  static_cast<unsigned long long>(hash_bytes(std::as_bytes(std::span(all)))), all.size());
    return name;
}

namespace {
/// Before what the driver gave.
struct StoredHeader {
    std::uint32_t magic = 0x31475050;  ///< "PPG1"
    std::uint32_t format = 0;
    std::uint64_t hash = 0;
};
}  // namespace

std::vector<std::byte> to_bytes(const Program& program) {
    GLint size = 0;
    glGetProgramiv(program.name(), GL_PROGRAM_BINARY_LENGTH, &size);
    if (size <= 0) return {};
    StoredHeader header;
    std::vector<std::byte> bytes(sizeof header + std::size_t(size));
    GLsizei written = 0;
    GLenum format = 0;
    glGetProgramBinary(program.name(), size, &written, &format, bytes.data() + sizeof header);
    if (written <= 0) return {};
    bytes.resize(sizeof header + std::size_t(written));
    header.format = format;
    header.hash = hash_bytes(std::span(bytes).subspan(sizeof header));
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
}

Program program_from(std::span<const std::byte> bytes) {
    StoredHeader header;
    const StoredHeader expected;
    if (bytes.size() <= sizeof header) return {};
    std::memcpy(&header, bytes.data(), sizeof header);
    const std::span<const std::byte> own = bytes.subspan(sizeof header);
    if (header.magic != expected.magic || header.hash != hash_bytes(own)) return {};
    Program program = Program::make();
    glProgramBinary(program.name(), header.format, own.data(), GLsizei(own.size()));
    GLint done = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &done);
    if (done != GL_TRUE) {
        glGetError();  // of another driver's format
        return {};
    }
    bind_interface(program.name());
    return program;
}

void bind_texture(GLuint unit, GLenum kind, const Texture& texture) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindSampler(unit, 0);
    glBindTexture(kind, texture.name());
}

}  // namespace patina::gl

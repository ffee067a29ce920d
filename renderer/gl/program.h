// From embedded .glsl files to linked programs: #include, the version line and the permutation's defines.
#pragma once

#include "renderer/gl/handles.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina::gl {

struct ShaderText {
    std::string name;  ///< for messages
    std::string text;  ///< without #version; may #include "file.glsl"
};

/// A file of renderer/shaders as the build embedded it. Throws std::runtime_error if there is none of that
/// name.
ShaderText embedded_shader(std::string_view name);

/// A program's two stages with their defines, expanded.
struct ProgramText {
    ProgramText(const ShaderText& vertex, const ShaderText& fragment, std::span<const std::string> defines);
    struct Stage {
        std::string name;                ///< for messages
        std::vector<std::string> files;  ///< in the order of their source string numbers
        std::string text;
    };
    Stage vertex, fragment;
};
Program make_program(const ProgramText& text);

/// Names text and driver, for a file; empty where the driver hands no programs out.
std::string program_key(const ProgramText& text);
/// What the driver keeps of a program, to be taken by program_from; empty where it keeps nothing.
std::vector<std::byte> to_bytes(const Program& program);
/// No program (false) where the bytes are not whole or the driver does not want them any more.
Program program_from(std::span<const std::byte> bytes);

/// Compiles and links; defines become `#define NAME 1` (or `NAME VALUE` from "NAME=VALUE"). Samplers and
/// uniform blocks are bound by the tables in program.cpp. Throws std::runtime_error: one sentence with file,
/// line and the driver's words.
Program make_program(const ShaderText& vertex, const ShaderText& fragment,
                     std::span<const std::string> defines = {});

/// Texture units, by sampler name in the shaders.
inline constexpr GLuint kPanoramaUnit = 0;
inline constexpr GLuint kLevelsUnit = 1;
inline constexpr GLuint kIrradianceUnit = 2;
inline constexpr GLuint kBrdfUnit = 3;
inline constexpr GLuint kFirstMapUnit = 4;  ///< five of them, in MapSlot's order
inline constexpr GLuint kLobesUnit = 10;
inline constexpr GLuint kFirstStoredUnit = 4;  ///< six of them, while no map is bound
inline constexpr GLuint kFragmentPlacesUnit = 11;
inline constexpr GLuint kLightPointsUnit = 12;  ///< of the reference, as those that follow
inline constexpr GLuint kLightTexelsUnit = 13;
inline constexpr GLuint kSlicePointsUnit = 14;
inline constexpr GLuint kFirstReflectedCellsUnit = kLevelsUnit;     ///< which it does not read
inline constexpr GLuint kLastReflectedCellsUnit = kIrradianceUnit;  ///< likewise
inline constexpr GLuint kFragmentOfPixelUnit = 4;                   ///< beside the picture
inline constexpr GLuint kPictureBehindUnit = 4;                     ///< likewise
inline constexpr GLuint kFragmentsOfSamplesUnit = 5;                ///< likewise
inline constexpr GLuint kPictureUnit = 0;                           ///< what the display pass reads
inline constexpr GLuint kFrameSlot = 0;                             ///< uniform buffer binding of FrameBlock
inline constexpr GLuint kMaterialSlot = 1;                          ///< and of MaterialBlock
inline constexpr GLuint kCellSlot = 2;                              ///< and of CellBlock

/// To be read through the texture's own parameters. Leaves the unit active.
void bind_texture(GLuint unit, GLenum kind, const Texture& texture);

}  // namespace patina::gl

# Writes OUTPUT: each of FILES as a byte array, found by its base name (see PatinaEmbed.cmake).
set(arrays "")
set(cases "")
set(index 0)
foreach(file IN LISTS FILES)
    get_filename_component(base "${file}" NAME)
    file(READ "${file}" hex HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
    string(REGEX REPLACE "(0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,)" "\\1\n" bytes "${bytes}")
    string(APPEND arrays "const unsigned char kFile${index}[] = {\n${bytes}0x00};\n")
    string(APPEND cases "    if (file_name == \"${base}\") return {kFile${index}, sizeof(kFile${index}) - 1};\n")
    math(EXPR index "${index} + 1")
endforeach()
file(WRITE "${OUTPUT}" "#include <span>\n#include <string_view>\n\nnamespace {\n${arrays}}  // namespace\n\n"
    "namespace patina::embedded {\nstd::span<const unsigned char> ${NAME}(std::string_view file_name);\n"
    "std::span<const unsigned char> ${NAME}(std::string_view file_name) {\n${cases}    return {};\n}\n}  // namespace patina::embedded\n")

# Compiler warnings and sanitizers for our own targets; packages' headers are SYSTEM and stay quiet.
option(PATINA_WERROR "Treat compiler warnings as errors" OFF)
option(PATINA_SANITIZE "Build with the address and undefined-behaviour sanitizers" OFF)
option(PATINA_FUZZ "Build patina_fuzz for LLVM's coverage-guided fuzzer (needs clang)" OFF)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

add_library(patina_flags INTERFACE)
if(MSVC)
    target_compile_options(patina_flags INTERFACE /W4 /utf-8 $<$<BOOL:${PATINA_WERROR}>:/WX>)
    target_compile_definitions(patina_flags INTERFACE _USE_MATH_DEFINES NOMINMAX)
else()
    target_compile_options(patina_flags INTERFACE
        -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wno-missing-field-initializers
        # GCC 12 sees overlaps in std::string's operator+ that are not there (its bug 105651).
        $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
        $<$<BOOL:${PATINA_WERROR}>:-Werror>)
endif()
if(PATINA_SANITIZE)
    target_compile_options(patina_flags INTERFACE
        -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer -O1)
    target_link_options(patina_flags INTERFACE -fsanitize=address,undefined)
endif()
if(PATINA_FUZZ)
    add_compile_options(-fsanitize=fuzzer-no-link,address -fno-omit-frame-pointer)
    add_link_options(-fsanitize=address)
endif()

# patina_library(NAME [PUBLIC libs...] [PRIVATE libs...]): a static library of every source in the calling folder.
function(patina_library name)
    cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE;SOURCES" ${ARGN})
    if(NOT ARG_SOURCES)
        file(GLOB ARG_SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
    endif()
    add_library(${name} STATIC ${ARG_SOURCES})
    set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
    target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
    target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE patina_flags ${ARG_PRIVATE})
endfunction()

#!/bin/sh
# The layering check must notice what it forbids: plants one violation of each kind in a copy and expects a failure.
set -u
root=$1
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
failed=0

expect_caught() {
    file=$1 line=$2
    rm -rf "$work/tree"
    mkdir -p "$work/tree"
    cp -R "$root/app" "$root/renderer" "$root/ui" "$root/materials" "$work/tree/"
    printf '%s\n' "$line" >> "$work/tree/$file"
    if sh "$root/tests/layering/check.sh" "$work/tree" > /dev/null; then
        echo "not caught: '$line' in $file"
        failed=1
    fi
}

expect_caught materials/planted.cpp '#include "renderer/core/image.h"'
expect_caught renderer/core/planted.cpp '#include "materials/material.h"'
expect_caught renderer/ibl/planted.cpp '#include "renderer/gl/texture.h"'
expect_caught renderer/gl/planted.cpp '#include "renderer/renderer.h"'
expect_caught renderer/planted.cpp '#include "app/registry.h"'
expect_caught ui/planted.cpp '#include "app/document.h"'
expect_caught app/planted.cpp '#include <OpenImageIO/imageio.h>'
expect_caught renderer/core/image_io.cpp '#include <ImfInputFile.h>'
expect_caught app/planted.cpp '#include <png.h>'
expect_caught app/planted.cpp '    dlopen("module.so", 0);'
expect_caught renderer/core/mesh.cpp '#include <OpenMesh/Core/IO/MeshIO.hh>'
expect_caught ui/planted.cpp '    glClear(GL_COLOR_BUFFER_BIT);'
expect_caught app/editor.cpp '    ImGui::Text("hello");'
expect_caught renderer/ibl/bake.cpp '    std::thread worker([] {});'
expect_caught ui/planted.cpp '    std::ifstream file("x");'
expect_caught renderer/planted.cpp '    } catch (const std::exception&) {'
expect_caught app/report.cpp '#include <hpdf.h>'
expect_caught app/planted.cpp '    std::system(command.c_str());'
expect_caught app/planted.cpp '#include <QWidget>'

[ "$failed" = 0 ] && echo 'layering: every planted violation was caught'
exit "$failed"

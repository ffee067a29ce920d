#!/bin/sh
# Who may know whom, and who may do what: each rule is one grep over the sources. Usage: check.sh ROOT
set -u
cd "$1" || exit 2
failed=0

# forbid WHAT PATTERN FILES...: no line of FILES may match PATTERN.
forbid() {
    what=$1 pattern=$2
    shift 2
    hits=$(grep -nE "$pattern" "$@" /dev/null 2>/dev/null)
    if [ -n "$hits" ]; then
        printf '%s:\n%s\n' "$what" "$hits"
        failed=1
    fi
}
# sources DIR... [-- EXCLUDED...]: the C++ files below DIRs, less those whose path ends in an excluded name.
sources() {
    dirs= excluded='^$'
    while [ $# -gt 0 ] && [ "$1" != -- ]; do dirs="$dirs $1"; shift; done
    [ $# -gt 0 ] && shift
    for name; do excluded="$excluded|$name\$"; done
    # shellcheck disable=SC2086
    find $dirs -name '*.cpp' -o -name '*.h' | grep -vE "$excluded" | sort
}

# Directions: app -> ui -> {materials, renderer/core}; app -> renderer/gl -> renderer/{core, ibl}; renderer -> materials.
forbid 'materials is a leaf' '#include "(app|renderer|ui)/' $(sources materials)
forbid 'renderer/core knows only itself' '#include "(app|ui|materials|renderer/(ibl|gl|maps|renderer|features))' $(sources renderer/core)
forbid 'renderer/ibl knows only renderer/core' '#include "(app|ui|materials|renderer/(gl|renderer|features))' $(sources renderer/ibl)
forbid 'renderer/gl knows only renderer/core and renderer/ibl' '#include "(app|ui|materials|renderer/(renderer|features))' $(sources renderer/gl)
forbid 'renderer/maps knows only renderer/core' '#include "(app|ui|materials|renderer/(ibl|gl|lobes|renderer|features))' $(sources renderer/maps)
forbid 'the renderer knows neither app nor ui' '#include "(app|ui)/' $(sources renderer)
forbid 'ui knows only materials and renderer/core' '#include "(app|renderer/(ibl|gl|maps|renderer|features))' $(sources ui)

# Packages behind one door each.
forbid 'only image_module may name OpenImageIO' '#include <OpenImageIO' \
    $(sources app renderer ui materials -- core/image_module.cpp)
forbid 'only image_exr_io may name OpenEXR' '#include <(Imf|Iex|Ilm|Imath|openexr)' \
    $(sources app renderer ui materials -- core/image_exr_io.cpp)
forbid 'only image_png_io may name libpng' '#include <png\.h' $(sources app renderer ui materials -- core/image_png_io.cpp)
forbid 'only module_io may load code' '(dlopen|LoadLibrary[A-Za-z]*)\(' \
    $(sources app renderer ui materials -- core/module_io.cpp)
forbid 'only image_jpeg_io may name libjpeg' '#include <jpeglib\.h' $(sources app renderer ui materials -- core/image_jpeg_io.cpp)
forbid 'only mesh_io may name OpenMesh' '#include <OpenMesh' $(sources app renderer ui materials -- core/mesh_io.cpp)
forbid 'only report_pdf may name libharu' '#include <hpdf' $(sources app renderer ui materials -- app/report_pdf.cpp)
forbid 'no Qt' '#include <Q[A-Z]' $(sources app renderer ui materials)

# Actions.
gl_rooms='renderer/gl/[^/]* renderer/renderer[_a-z]*.(cpp|h) app/window.cpp app/headless.cpp app/bare_window.cpp'
# shellcheck disable=SC2086
forbid 'GL calls only in renderer/gl, renderer.cpp, window.cpp, headless.cpp' \
    '(^|[^A-Za-z0-9_:.>])gl[A-Z][A-Za-z0-9]*\(|<epoxy/' $(sources app renderer ui materials -- $gl_rooms)
forbid 'ImGui calls only in ui and app/window.cpp' 'ImGui::|<imgui' $(sources app renderer materials -- app/window.cpp app/bare_window.cpp)
forbid 'threads and mutexes only in app/jobs' \
    'std::(jthread|thread|mutex|async|condition_variable)|<(thread|mutex|future|condition_variable)>' \
    $(sources app renderer ui materials -- app/jobs.cpp app/jobs.h)
forbid 'files are opened only in *_io.cpp' \
    'std::[io]?fstream|<fstream>|[^a-z_]fopen\(' \
    $(sources app renderer ui materials -- _io.cpp app/bare_window.cpp)
forbid 'exceptions are caught only in main, jobs, plug-in calls and shader reload' '(^|[^a-z_])catch \(' \
    $(sources renderer ui materials -- _io.cpp lobes/fit_main.cpp)
# But the system's file manager, by the one function that shows a folder in it; ffmpeg, to join frames where a video is
# asked for; and this program itself, whose start is measured.
forbid 'no shell and no other program is started' \
    '(^|[^A-Za-z0-9_.>])(system|popen|_popen|execlp?|execvp?e?|posix_spawnp?|ShellExecute[AW]?|CreateProcess[AW]?)\(' \
    $(sources app renderer ui materials -- app/file_dialog.cpp app/video.cpp app/bench_start.cpp app/bench_skip.cpp)

[ "$failed" = 0 ] && echo 'layering: every rule holds'
exit "$failed"

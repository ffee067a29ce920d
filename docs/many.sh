#!/bin/sh
# Renders every preset under every light, several at once. Run again, it makes only what is missing or has changed:
# each picture knows what it was made from.
#   docs/many.sh FOLDER "LIGHT..." PRESET...          LIGHT: an id or a file without blanks in its name
#   PATINA=build/release/bin/patina JOBS=8 OPTIONS="--mesh shaderball --size 256x256" docs/many.sh out "studio sky" presets/*.json
# With GNU parallel, on several machines too:  parallel -S host1,host2 --wd "$PWD" patina render {1} --env {2} --up-to-date \
#   -o out/{1/.}-{2}.png ::: presets/*.json ::: studio sky
# On a cluster, one task a preset:  sbatch --array=1-100 --wrap 'docs/many.sh out "studio sky" \
#   "$(ls presets/*.json | sed -n "${SLURM_ARRAY_TASK_ID}p")"'
set -eu
folder=$1 lights=$2
shift 2
mkdir -p "$folder"
for preset; do
    for light in $lights; do printf '%s\0%s\0' "$preset" "$light"; done
done | xargs -0 -n 2 -P "${JOBS:-$(getconf _NPROCESSORS_ONLN)}" sh -c '
    light=$(basename "$2")
    # shellcheck disable=SC2086
    exec "${PATINA:-patina}" render "$1" --env "$2" --up-to-date ${OPTIONS:-} \
        -o "$0/$(basename "$1" .json)-${light%.*}.png"' "$folder"

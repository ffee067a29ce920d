#!/bin/sh
# Coverage-guided fuzzing of one target, a folder of tests/fuzz/corpus. Usage: run.sh TARGET
# PATINA_FUZZ_SECONDS: how long (60); PATINA_FUZZ_SEED: what it starts from (1; 0: another one every time).
# Needs the fuzz build, which `./patina fuzz` and `./patina test slow` make where clang is; exits with 77 (skipped)
# where it is missing. What is new goes to build/fuzz/found/TARGET, what fails beside it.
set -eu
cd "$(dirname "$0")/../.."
target=$1
found=build/fuzz/found/$target
if [ ! -x build/fuzz/bin/patina_fuzz ]; then
    echo "skipped: the fuzz build is missing; ./patina fuzz makes it where clang is installed"
    exit 77
fi
mkdir -p "$found"
# Slow and large are judged generously: a busy machine must not look like a defect.
if ! ASAN_OPTIONS=detect_leaks=0 PATINA_FUZZ_TARGET=$target build/fuzz/bin/patina_fuzz -seed="${PATINA_FUZZ_SEED:-1}" -max_total_time="${PATINA_FUZZ_SECONDS:-60}" \
        -max_len=65536 -rss_limit_mb=2048 -timeout=120 -detect_leaks=0 -print_final_stats=1 \
        -artifact_prefix="$found-failed-" "$found" "tests/fuzz/corpus/$target" >"$found.log" 2>&1; then
    tail -n 40 "$found.log"
    echo "fuzz: $target failed; its log is $found.log, the input that fails begins with $found-failed-"
    exit 1
fi
grep -E 'number_of_executed_units|peak_rss_mb' "$found.log" | sed "s/^/fuzz: $target: /"

#!/usr/bin/env bash
# gpu_kernel_tests.sh SOURCE_DIR BUILD_DIR: bench/gpu/kernel_tests.sh finds the tests of the kernels, and fails when one
# fails, is skipped or was not built, or when there is none. Made-up build folders; of the real one only the names.
set -euo pipefail
tool=$1/bench/gpu/kernel_tests.sh build_dir=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "gpu kernel tests: $*" >&2; exit 1; }

names=$("$tool" list "$build_dir")
for source in "$1"/tests/kernels/test_kernels_*.c; do
    name=${source##*/test_}
    grep -qx "${name%.c}" <<<"$names" || fail "${name%.c} is not found in: $names"
done

build() { # NAME COMMAND LABEL...: a folder with these tests
    rm -rf "$scratch/build" && mkdir "$scratch/build"
    while (($#)); do
        printf 'add_test(%s "%s")\nset_tests_properties(%s PROPERTIES LABELS "%s" SKIP_RETURN_CODE 77)\n' \
            "$1" "$2" "$1" "$3" >>"$scratch/build/CTestTestfile.cmake"
        shift 3
    done
}
expect() { # 0|1 WORDS
    local code=0 said
    said=$("$tool" run "$scratch/build" "$scratch/log" 2>&1) || code=$?
    [[ $code == "$1" && $said == *"$2"* ]] || fail "code $code (wanted $1), said: $said"
}
printf '#!/bin/sh\nexit 77\n' >"$scratch/skip"
chmod +x "$scratch/skip"
build a /bin/true kernel b /bin/true kernel c /bin/false unit
expect 0 "2 of 2 ran and passed"
build a /bin/true kernel b /bin/false kernel
expect 1 "1 of 2 ran and passed"
build a /bin/true kernel b "$scratch/skip" kernel
expect 1 "Skipped"
build a /bin/true kernel b "$scratch/none" kernel
expect 1 "Not Run"
build a /bin/true unit b /bin/true kernels
expect 1 "no test with the label kernel"
rm "$scratch/build/CTestTestfile.cmake"
expect 1 "no test with the label kernel"
echo "gpu kernel tests: found, and missed where one is missing"

#!/usr/bin/env bash
# gpu_kernel_tests.sh SOURCE_DIR BUILD_DIR: bench/gpu/kernel_tests.sh finds the tests of the kernels, and fails when one
# fails, is skipped or was not built, or when there is none. Made-up build folders; of the real one only the names.
# bench/gpu/measure.sh gives each case a process and a limit of its own, and keeps the rows of the others.
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

# Of four cases one is ended by the limit after a row, and one fails.
cat >"$scratch/bench" <<'PROGRAM'
#!/bin/sh
[ "$1" != --cases ] || { printf 'good 1\nlong 2\nbad 3\ngood 4\n'; exit; }
printf '# device\nnames\n%s\n# after it\n' "$1"
case $1 in long*) exit 124 ;; bad*) exit 1 ;; esac
PROGRAM
chmod +x "$scratch/bench"
say() { said+="$*"; }
out=$scratch patience=600 failed=0 said=
# shellcheck source=bench/gpu/measure.sh
. "$1/bench/gpu/measure.sh"
measure_cases rows "$scratch/bench"
wanted=$'# device\nnames\ngood 1\n# after it\nlong 2\n# after it\nbad 3\n# after it\ngood 4\n# after it'
[[ $(<"$scratch/rows.txt") == "$wanted" ]] || fail "rows: $(<"$scratch/rows.txt")"
[[ $failed == 1 && $said == *"ended with 124: $scratch/bench long 2"*"ended with 1: $scratch/bench bad 3"* ]] ||
    fail "failed $failed, said: $said"
failed=0
measure_cases rows "$scratch/bench" 'long 5' 'good 6'
[[ $failed == 0 && $(tail -n 2 "$scratch/rows.txt") == $'good 6\n# after it' ]] || fail "a case that takes long is a failure"
[[ ! -e $scratch/one-case.txt ]] || fail "a file is left"
echo "gpu kernel tests: found, and missed where one is missing"

#!/usr/bin/env bash
# kernel_tests.sh list BUILD [REGEX]: names of the tests labelled kernel in that build folder (that REGEX fits), one per line;
# none is an error.
# kernel_tests.sh run BUILD LOG [REGEX]: runs them JOBS (default 2) at a time. Fails when one fails, is skipped or was not built:
# a machine that is asked for its kernels must not be taken for one whose kernels are right.
set -euo pipefail
what=$1 build=$2 log=${3-}
[[ $what == run ]] || set -- "$1" "$2" "" "${3-}"
fitting=(-L '^kernel$' -R "${4:-.}")

list() {
    local names
    # "  Test  #7: kernels_fft", with CTest's own numbers
    names=$(ctest --test-dir "$build" -N "${fitting[@]}" | sed -n 's/^ *Test *#[0-9]*: *//p')
    [[ -n $names ]] || { echo "kernel tests: $build has no test with the label kernel" >&2; return 1; }
    printf '%s\n' "$names"
}

run() {
    local num passed
    num=$(list | wc -l)
    ctest --test-dir "$build" "${fitting[@]}" --parallel "${JOBS:-2}" --output-on-failure >"$log" 2>&1 || true
    passed=$(grep -cE '^ *[0-9]+/[0-9]+ Test +#[0-9]+: .* Passed ' "$log" || true)
    echo "kernel tests: $passed of $num ran and passed"
    ((passed == num)) && return
    grep -E '^ *[0-9]+/[0-9]+ Test +#[0-9]+: .*\*\*\*' "$log" >&2 || tail -n 3 "$log" >&2
    return 1
}

case $what in
    list) list ;;
    run) run ;;
    *) sed -n '2,5s/^# //p' "$0" >&2; exit 2 ;;
esac

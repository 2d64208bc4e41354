#!/usr/bin/env bash
# devices.sh PROGRAM: of two devices that share a job one is lost at some call of OpenCL, or an allocation fails. Either that ends the job
# with one sentence, as of one device, or the device is dropped with a warning, and the answer is the same to the bit.
# PROGRAM is pointspec_faults. Skipped (77) where there is no device that is split.
set -euo pipefail
program=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
export POINTSPEC_CACHE_DIR=$scratch/no-cache ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=0
unset POINTSPEC_FAULT POINTSPEC_FAULT_REPORT
most=6 # faults of a class, evenly over its calls

complain() { echo "devices: $1, fault $2 of: ${*:3}: $(<err)" >&2; exit 1; }
try() { # CLASS SUFFIX WORD...: SUFFIX @: that call and all after it of the same thread
    local class=$1 suffix=$2 calls number step code dropped=0 refused=0
    shift 2
    "$program" "$@" --device cpu 2>err >whole.csv || { echo "devices: skipped: $(<err)" >&2; exit 77; }
    POINTSPEC_FAULT_REPORT=report "$program" "$@" --device cpu:split=2 2>err >/dev/null ||
        { echo "devices: skipped: $(<err)" >&2; exit 77; }
    calls=$(awk -v class="$class" '/^calls/ && $2 == class { print $3 }' report)
    step=$((calls > most ? calls / most : 1))
    for ((number = 1 + RANDOM % step; number <= calls; number += step)); do
        code=0
        rm -f report
        POINTSPEC_FAULT=$class:$number$suffix POINTSPEC_FAULT_REPORT=report \
            timeout 300 "$program" "$@" --device cpu:split=2 >out.csv 2>err || code=$?
        ! grep -E '^(leak|unknown)' report >>err || complain "a leak" "$class:$number" "$@"
        case $code:$(wc -l <err) in
        0:0) ;;
        0:1) grep -qE 'is dropped, and the others (do its work|begin anew without it)' err || complain "another warning" "$class:$number" "$@"
            dropped=$((dropped + 1)) ;;
        # Of rows the first device left works in the thread of the program, whose calls go on failing.
        1:1 | 1:2) [[ ! -s out.csv ]] || complain "an answer" "$class:$number" "$@"
            [[ $(wc -l <err) == 1 ]] || grep -q 'is dropped, and the others begin anew' err || complain "another warning" "$class:$number" "$@"
            refused=$((refused + 1)) ;;
        *) complain "exit status $code" "$class:$number" "$@" ;;
        esac
        [[ $code == 1 ]] || diff <(grep -Ev '^# (command|engine)' whole.csv) <(grep -Ev '^# (command|engine)' out.csv) ||
            complain "other bits" "$class:$number" "$@"
    done
    ((dropped > 0)) || { echo "devices: no device was dropped: $class, $*" >&2; exit 1; }
    echo "devices: $class: of $calls calls $most: $dropped times a device was dropped, same bits; $refused jobs refused: $*"
}

RANDOM=1
job=(power --engine torus_direct --sampler white -n 16 -k 2 -m 1100)
try opencl @ "${job[@]}"
try memory '' "${job[@]}"
job=(quadrature --sampler white-hemisphere -n 16 -m 60 --brdf diffuse -l 8)
try opencl @ "${job[@]}"
try memory '' "${job[@]}"

#!/usr/bin/env bash
# same_bits.sh COMMIT: builds that commit beside the tree and compares every table, array and record that both programs make
# of tests/faults/commands.txt, scripts/same_bits.txt and the quick scenes of docs/scenes. Exit code 1 where a result differs.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
(($# == 1)) || { sed -n '2,3s/^# //p' scripts/same_bits.sh >&2; exit 2; }
commit=$(git rev-parse --verify "$1^{commit}")
root=$PWD/build/same-bits
jobs=${JOBS:-$(nproc)}
scratch=$root/runs
export POCL_CACHE_DIR=$PWD/build/pocl-cache POINTSPEC_CACHE_DIR=$scratch/no-cache
unset POINTSPEC_DEVICE POINTSPEC_KERNEL_DIR POINTSPEC_MEMORY

build() { # SOURCE BUILD
    cmake -S "$1" -B "$2" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPOINTSPEC_BUILD_TESTS=OFF -DPOINTSPEC_BUILD_BENCH=OFF >/dev/null
    cmake --build "$2" --parallel "$jobs" --target pointspec_program -- --quiet
}
rm -rf "$root/source" "$scratch"
mkdir -p "$root/source" "$scratch" "$POCL_CACHE_DIR"
git archive "$commit" | tar -x -C "$root/source"
build "$root/source" "$root/before"
build . "$root/after"

# shellcheck source=tests/faults/inputs.sh
. tests/faults/inputs.sh
# shellcheck source=tests/faults/same.sh
. tests/faults/same.sh
here=$PWD/tests/faults # where lines of the list look for kernels
program=$root/before/pointspec
make_inputs >/dev/null

run_all() { # WHICH: every line in a folder of its own
    program=$root/$1/pointspec
    local number=0 name stdin words line out
    while read -r -a line; do
        # Kernels from a folder are those of this tree, which the other program need not fit.
        [[ ${#line[@]} -gt 0 && ${line[0]} != \#* && " ${line[*]} " != *POINTSPEC_@(FAULT_|KERNEL_DIR)* && ${line[*]} != *" bench "* ]] || continue
        read_line "${line[@]}"
        number=$((number + 1))
        name=$(printf '%03d-%s' $number "${line[0]}")
        out=$scratch/$1/$name
        mkdir -p "$out"
        cp -r "$scratch/initial" "$out/folder"
        (cd "$out/folder" && env "${words[@]}" <"$stdin" >"$out/stdout" 2>"$scratch/messages") ||
            echo "exit $?: $(<"$scratch/messages")" >"$out/failure"
    done < <(cat "$here/commands.txt"; grep -v '^#' scripts/same_bits.txt | sed 's/^\([a-z]*\) /\1 - \1 /'
        for scene in docs/scenes/{*,*/*}.yaml; do
            [[ ! -f $scene || $scene == *_full.yaml ]] || echo "scene-$(basename "$scene" .yaml) - run --cache 0 --quiet $PWD/$scene -o new.folder"
        done)
    echo "same_bits: $number command lines of $1"
}
# Texts are compared by their doubles, whatever digits they are written with.
write_doubles() { # FOLDER
    grep -rlIZ '' "$1" | xargs -0 perl -pi -e 's/(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.])/sprintf("%.17g", $&)/ge'
}
run_all before
run_all after
write_doubles "$scratch/before"
write_doubles "$scratch/after"
if diff -r "${same[@]}" "$scratch/before" "$scratch/after"; then
    echo "same_bits: every result is that of $(git log -1 --format='%h, %s' "$commit")"
else
    echo "same_bits: results differ from those of $(git log -1 --format='%h, %s' "$commit")" >&2
    exit 1
fi

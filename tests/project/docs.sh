#!/usr/bin/env bash
# docs.sh PROGRAM SOURCE_DIR: every ```sh block of the README, the tutorial, the recipes, the conventions, the
# formats, samplers, quadrature, variance, reproduction, gate, needs and scenes runs, in the order of the page, in one empty folder for each page; ```python blocks too where there is numpy.
# Lines that begin with ./dev are left out. Then relative links of all pages are looked up.
set -euo pipefail
program=$(realpath "$1")
source_dir=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
PATH=$(dirname "$program"):$PATH
[[ $(basename "$program") == pointspec ]] || { echo "the program must be called pointspec" >&2; exit 1; }
# Leaks are other tests' business; the leak sanitizer trips over threads of PoCL in short runs.
export POINTSPEC_CACHE_DIR=$scratch/cache # neither figures nor results of who runs the tests
export ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=0
bad=0

has_numpy=no
if python3 -c 'import numpy' 2>/dev/null; then has_numpy=yes; else echo "no numpy: python blocks are not run"; fi

# Blocks of a page as files block-001.sh, block-002.python, ... in the current folder.
extract() { # PAGE
    awk '/^```(sh|python)$/ { kind = substr($0, 4); file = sprintf("block-%03d.%s", ++num, kind); printf "" >file; next }
         /^```/ { file = ""; next }
         file != "" && !/^\.\/dev / { print >file }' "$1"
}

run_page() { # PAGE
    local page=$1 block runner
    mkdir -p "$scratch/page/docs"
    cd "$scratch/page"
    cp -r "$source_dir/docs/scenes" docs/ # the pages name them as they lie in the source
    extract "$source_dir/$page"
    for block in block-*; do
        [[ -f $block ]] || { echo "$page: no block to run" >&2; bad=1; break; }
        runner=(bash -euo pipefail)
        if [[ $block == *.python ]]; then
            [[ $has_numpy == yes ]] || continue
            runner=(python3)
        fi
        if ! "${runner[@]}" "$block" </dev/null >output 2>&1; then
            printf '%s, %s failed:\n%s\n---- it printed\n%s\n' "$page" "$block" "$(<"$block")" "$(<output)" >&2
            bad=1
        fi
    done
    echo "$page: $(find . -name 'block-*' | wc -l) blocks"
    cd "$source_dir"
    rm -rf "$scratch/page"
}

check_links() { # PAGE
    local target folder
    folder=$(dirname "$1")
    while IFS= read -r target; do
        [[ $target == http* || $target == '#'* || -e $folder/${target%%#*} ]] ||
            { echo "$1: link to $target leads nowhere" >&2; bad=1; }
    done < <(grep -o '](\([^) ]*\))' "$1" | sed 's/^](//; s/)$//')
}

for page in README.md docs/user/tutorial.md docs/user/recipes.md docs/user/conventions.md docs/user/formats.md docs/user/quadrature.md docs/user/variance.md docs/user/reproduction.md docs/user/gate.md docs/user/needs.md docs/user/scenes.md docs/user/samplers.md docs/samplers/poisson_disks.md docs/samplers/optimized.md docs/samplers/forces.md; do
    run_page "$page"
done
# The scenes that pages run are shorter than some of those that lie there.
for scene in "$source_dir"/docs/scenes/*.yaml; do
    "$program" plan run "$scene" >"$scratch/plan" 2>&1 || { echo "$scene: $(<"$scratch/plan")" >&2; bad=1; }
done
for page in "$source_dir"/*.md "$source_dir"/docs/*/*.md; do
    check_links "$page"
done
exit $bad

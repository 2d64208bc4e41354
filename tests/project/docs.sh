#!/usr/bin/env bash
# docs.sh PROGRAM SOURCE_DIR [PAGE...]: every ```sh block of the pages runs, in the order of the page, in one empty folder
# for each page; ```python blocks too where there is numpy. Lines that begin with ./dev are left out. Indented lines
# behind a block are what it prints: tests/project/printed.awk compares. Without pages it is the README,
# relative links of all pages are looked up, lists of pages are compared with those of --help, and every
# scene is planned.
set -euo pipefail
source_dir=$(realpath "$2")
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" docs "$1"
PATH=$(dirname "$program"):$PATH
[[ $(basename "$program") == pointspec ]] || { echo "the program must be called pointspec" >&2; exit 1; }
# Leaks are other tests' business; the leak sanitizer trips over threads of PoCL in short runs.
export ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=0

python=$(numpy_python)
[[ -n $python ]] || echo "no numpy: python blocks are not run"

# Blocks of a page as files block-001.sh, block-002.python, ... in the current folder, and what they print as
# block-001.sh.printed.
extract() { # PAGE
    awk '/^```(sh|python)$/ { kind = substr($0, 4); file = block = sprintf("block-%03d.%s", ++num, kind); printf "" >file; next }
         /^```/ { file = ""; next }
         file != "" && !/^\.\/dev / { print >file }
         file != "" { next }
         block != "" && /^    / { print substr($0, 5) >(block ".printed") }
         /^[^ ]/ { block = "" }' "$1"
}

run_page() { # PAGE
    local page=$1 block runner
    mkdir -p "$scratch/page/docs"
    cd "$scratch/page"
    cp -r "$source_dir/docs/scenes" docs/ # the pages name them as they lie in the source
    extract "$source_dir/$page"
    for block in block-*.sh block-*.python; do
        [[ $block != block-\*.python ]] || continue
        [[ -f $block ]] || { echo "$page: no block to run" >&2; bad=1; break; }
        runner=(bash -euo pipefail)
        if [[ $block == *.python ]]; then
            [[ -n $python ]] || continue
            runner=("$python")
        fi
        if ! "${runner[@]}" "$block" </dev/null >output 2>&1; then
            printf '%s, %s failed:\n%s\n---- it printed\n%s\n' "$page" "$block" "$(<"$block")" "$(<output)" >&2
            bad=1
        elif [[ -f $block.printed ]]; then
            awk -f "$source_dir/tests/project/printed.awk" "$block.printed" output >&2 || {
                printf '%s, %s does not print what the page says:\n%s\n' "$page" "$block" "$(<"$block")" >&2
                bad=1
            }
        fi
    done
    echo "$page: $(find . -name 'block-*' ! -name '*.printed' | wc -l) blocks, of $(find . -name '*.printed' | wc -l) the page has what they print"
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

# Names of a list of --help, which begins with a title: the first word of its lines, which are indented by two.
help_names() { # TITLE COMMAND...
    "$program" "${@:2}" --help | awk -v title="$1" 'index($0, title) == 1 { on = 1; next } !NF { on = 0 } on && /^  [^ :]/ { print $1 }'
}
# The values that --help gives an option, which stand behind its colon.
help_values() { # OPTION COMMAND
    "$program" "$2" --help | awk -v option="$1" '/^ +-/ { on = $1 == option } on' | tr -d '\n' | sed 's/.*: //' | grep -oE '[a-z0-9-]+'
}
# Names in the first column of the tables of a page, or of a part of it.
page_names() { # PAGE [HEADING]
    awk -v heading="${2-}" '/^#/ { on = heading == "" || $0 ~ heading } on && /^\| `/' "$source_dir/$1" |
        cut -d'|' -f2 | grep -oE "[\`][a-z0-9-]+[\`]" | tr -d '\`'
}
same_names() { # WHAT; both lists in files here and there
    local difference
    difference=$(comm -3 <(sort -u "$scratch/here") <(sort -u "$scratch/there"))
    [[ -s $scratch/here && -z $difference ]] || { printf '%s: only there, or (indented) only in the program or in rooms.sh:\n%s\n' "$1" "$difference" >&2; bad=1; }
}
check_lists() {
    local kind house=docs/developer/architecture.md
    page_names docs/user/samplers.md >"$scratch/here"
    help_names 'Samplers' sample >"$scratch/there"
    same_names "the page of samplers"
    page_names docs/user/variance.md Integrands >"$scratch/here"
    help_names 'Integrands' variance >"$scratch/there"
    same_names "the integrands of the page of variance"
    page_names docs/user/formats.md "^# Formats" | grep -vx tokens >"$scratch/here"
    help_values --input-format convert >"$scratch/there"
    same_names "the page of formats"
    sed -n '/^\.Ss Point files/,/^\.El/s/^\.It Cm //p' "$source_dir/docs/man/pointspec.1" >"$scratch/here"
    same_names "the formats of pointspec.1"
    "$program" help | awk '/^Commands:/ { on = 1; next } !NF { on = 0 } on { print $1 }' >"$scratch/there"
    grep -o 'pointspec-[a-z]*' "$source_dir/docs/man/pointspec.1" | sed 's/pointspec-//' >"$scratch/here"
    same_names "the commands of pointspec.1"
    "$program" run --help | sed -n '/^Reads a scene/,/^table/p' | grep -oE '[a-z]+' | grep -xFf "$scratch/there" | grep -vx run >"$scratch/here"
    while read -r kind; do
        printf 'scene: 1\nresults:\n  - {result: %s}\n' "$kind" >"$scratch/kind.yaml"
        [[ $("$program" plan run "$scratch/kind.yaml" 2>&1) == *'is no kind of answer'* ]] || echo "$kind"
    done <"$scratch/there" >"$scratch/kinds"
    mv "$scratch/kinds" "$scratch/there"
    same_names "the kinds of answers in the help of run"
    # shellcheck source=scripts/rooms.sh
    . "$source_dir/scripts/rooms.sh"
    printf '%s\n' "${rooms[@]}" | sed 's|/.*||' >"$scratch/there"
    awk '/^### |^## /{ on = /The floors/ } on' "$source_dir/$house" | grep -oE '[a-z]+' | grep -xFf "$scratch/there" >"$scratch/here"
    same_names "the floors of the architecture"
}

pages=("${@:3}")
if ((${#pages[@]} == 0)); then
    pages=(README.md)
    check_lists
    # The scenes that pages run are shorter than some of those that lie there.
    for scene in "$source_dir"/docs/scenes/{*,*/*}.yaml; do
        "$program" plan run "$scene" >"$scratch/plan" 2>&1 || { echo "$scene: $(<"$scratch/plan")" >&2; bad=1; }
    done
    for page in "$source_dir"/*.md "$source_dir"/docs/{,*/}*.md; do
        check_links "$page"
    done
fi
for page in "${pages[@]}"; do
    run_page "$page"
done
exit $bad

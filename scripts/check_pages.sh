#!/usr/bin/env bash
# check_pages.sh [ROOT]: every page that a source, a script or another page names exists, and so does
# every heading, as in docs/mathematics/torus.md#rings. A name is a path from the root; pages may also
# name their neighbours. Headings are spelt as links spell them: small letters, hyphens for blanks.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

files=$(find host kernels tests bench docs scripts cmake dev .ci README.md CONTRIBUTING.md -type f)
pages=$(find ./*.md docs bench tests -name '*.md' | sed 's|^\./||')

# Of every file that is text: FILE:LINE:NAME
named=$(tr '\n' '\0' <<<"$files" |
    xargs -0 grep -HInoE '[A-Za-z0-9_./-]*[A-Za-z0-9_-]\.md(#[A-Za-z0-9_-]+)?|\]\(#[A-Za-z0-9_-]+\)')

# shellcheck disable=SC2086 # a page a word
awk -F: '
function spelt(heading) {
    heading = tolower(heading)
    gsub(/[^a-z0-9_ -]/, "", heading)
    gsub(/ /, "-", heading)
    return heading
}
function folder(path) { return sub(/[^\/]*$/, "", path) ? path : path }
function plain(path) {
    gsub(/\/\.\//, "/", path)
    sub(/^\.\//, "", path)
    while (sub(/[^\/]+\/\.\.\//, "", path)) {}
    return path
}
FILENAME != "-" {
    if (FNR == 1) exists[FILENAME]
    if (/^```/) code[FILENAME] = !code[FILENAME]
    if (/^#+ / && !code[FILENAME]) {
        sub(/^#+ +/, "")
        exists[FILENAME "#" spelt($0)]
    }
    next
}
{
    name = $3
    if (name ~ /^\/\//) next # of another site
    if (sub(/^\]\(/, "", name)) {
        sub(/\)$/, "", name)
        name = $1 name
    } else if (!(plain(name) in exists)) {
        name = folder($1) name
    }
    if (!(plain(name) in exists)) {
        printf "%s:%s: there is no %s\n", $1, $2, plain(name)
        bad = 1
    }
}
END { exit bad }' $pages - <<<"$named" >&2

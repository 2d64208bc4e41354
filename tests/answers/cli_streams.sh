#!/usr/bin/env bash
# cli_streams.sh PROGRAM: points that come but once, from standard input or a pipe, are kept and read again: the rows are those
# of the file, also where powers need a second plan; beyond 64 MiB the advice is one that works; --set a=-; named twice.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" streams "$1"

# Clusters, whose powers are near N: what is planned for a mean power of 1 is not exact enough.
awk 'BEGIN { for (r = 0; r < 2; r++) { for (j = 0; j < 300; j++) print 0.5 + 1e-4 * (j % 17), 0.5 + 1e-4 * (j % 19); print "#" } }' >two.txt
sed '/#/,$d' two.txt >one.txt
lines() { # ARGS...: of a command, without the names of files
    "$program" "$@" 2>err | grep -v '^# command: '
}
same() { # FILE WORD ARGS...: WORD is standard input where FILE has a name of its own
    local file=$1 word=$2 of_file
    shift 2
    checked=$((checked + 2))
    of_file=$(lines "$@" "${word/-/$file}") || complain "$* $file: $(<err)"
    [[ $(lines "$@" "$word" < <(cat "$file")) == "$of_file" ]] || complain "standard input: $* $word: $(<err)"
    out=$of_file
}
sphere=(--lift sphere -l 8)
for file in one.txt two.txt; do
    for words in 'power -k 8' "angular ${sphere[*]}" "pairs ${sphere[*]}"; do
        read -ra words <<<"$words"
        same $file - "${words[@]}"
        [[ $out == *planned_twice* ]] || complain "$file: ${words[*]} is planned once"
    done
    same $file - quadrature --brdf diffuse "${sphere[@]}"
done
[[ $(lines power -k 8 <(cat two.txt)) == "$(lines power -k 8 two.txt)" ]] || complain "a pipe with a name: $(<err)"

# ---- standard input under a name, in every command that has sets ----
for words in 'power -k 8' "angular ${sphere[*]}" "pairs ${sphere[*]}" "quadrature --brdf diffuse ${sphere[*]}" 'variance --integrand disk'; do
    read -ra words <<<"$words"
    same two.txt a=- "${words[@]}" --engine host_direct --set b=one.txt --set
    command=${words[0]}
    for twice in '- -' '--set a=- --set b=-' '--set a=one.txt,-,-' '--weights - -'; do
        read -ra twice <<<"$twice"
        refuses 'standard input (-) is named 2 times, but can be read once' "${words[@]:1}" "${twice[@]}"
    done
done
# a file of that name is another thing
cp one.txt ./-
same two.txt a=- power -k 2 --engine host_direct --set b=./- --set

# ---- more than is kept: points at one place, 67 million bytes as pairs of numbers in memory ----
many() { head -c 33600000 /dev/zero | tr '\0' '<'; }
cell=(power --input-format rps -k 2)
many | "$program" "${cell[@]}" - >out 2>err && complain 'more than 64 MiB are read again'
says 'above the tolerance 1e-06; they are to be read again, but standard input and pipes come once, and more than 64M of points are not kept: give a file'
many >many.rps
[[ $(lines "${cell[@]}" many.rps) == *'planned_twice'*'4200000.0'* ]] || complain "the advice: $(<err)"
command=streams
finish

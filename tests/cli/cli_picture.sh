#!/usr/bin/env bash
# cli_picture.sh PROGRAM: --plot: a picture that fails costs a warning, never the numbers; an error where it is all that was asked for.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" picture "$1"
mkdir none broken
printf '#!/bin/sh\necho "no terminal today" >&2\nexit 1\n' >broken/gnuplot
chmod +x broken/gnuplot
whole=$PATH
try() { # EXIT ARGS...: like runs, of any command
    local expected=$1 code=0
    shift
    checked=$((checked + 1))
    "$program" "$@" </dev/null >out 2>err || code=$?
    [[ $code == "$expected" ]] || complain "exit $code, not $expected: $*: $(<err)"
}
# shellcheck disable=SC2094 # the same names of other files
while read -r line; do
    read -r -a words <<<"$line"
    PATH=$whole try 0 "${words[@]}"
    cp out whole.csv
    PATH=$PWD/none try 0 "${words[@]}" --plot a.svg
    [[ $(head -n 1 err) == *'"a.svg" will not be drawn: plots need the program gnuplot'* ]] ||
        complain "not looked for before the work: $line: $(<err)"
    [[ $(tail -n 1 err) == *'"a.svg" was not drawn: '* && ! -e a.svg ]] || complain "no warning: $line: $(<err)"
    diff -I "^# " whole.csv out >differences || [[ ${words[0]} == bench ]] || complain "other numbers: $line: $(<differences)"
    [[ -s out ]] || complain "no numbers: $line"
    PATH=$PWD/broken:$whole try 0 "${words[@]}" --quiet --plot a.svg -o a.csv
    grep -q 'was not drawn: gnuplot could not draw the picture: no terminal today' err || complain "no reason: $line: $(<err)"
    [[ -s a.csv && ! -e a.svg ]] || complain "no table: $line"
    PATH=$PWD/none try 1 "${words[@]}" --plot a.svg -o /dev/null
    says 'plots need the program gnuplot'
    PATH=$PWD/broken:$whole try 1 "${words[@]}" --quiet --plot a.svg -o /dev/null
    says 'no terminal today'
    rm -f a.csv
done <<'LINES'
power --sampler white -n 4 -m 2 -k 2 --engine host_direct
angular --sampler white-sphere -n 4 -m 2 -l 4 --engine host_direct
pairs --sampler white-sphere -n 4 -m 2 -l 4 --engine host_direct
quadrature --sampler white-hemisphere -n 4 -m 2 -l 4 --brdf diffuse --engine host_direct
truncation --brdf diffuse -l 4
LINES
# another file is kept
PATH=$PWD/none try 0 quadrature --sampler fibonacci-hemisphere -n 4 -l 4 --brdf diffuse --engine host_direct --weights-out w.npy --plot a.svg -o /dev/null
[[ -s w.npy && $(<err) == *'"a.svg" was not drawn: '* ]] || complain "weights and a picture: $(<err)"
# the points of the first set stand beside the spectrum of one question
if PATH=$whole command -v gnuplot >/dev/null; then
    PATH=$whole
    while read -r num line; do
        read -r -a words <<<"$line"
        try 0 "${words[@]}" -k 4 --quiet -o /dev/null --plot a.svg
        [[ $(grep -c 'the first set' a.svg) == "$num" ]] || complain "not $num panels of points: $line"
        rm -f a.svg
    done <<'LINES'
1 power --sampler white -n 16384
0 power --sampler white -n 16385
0 power --sampler white -n 16384 --plot-points no
1 power --sampler white -n 64 -m 3 -d 3 --plot-points yes
1 power --sampler white -n 64 -d 1
0 power --sampler white --sampler jittered -n 64
0 power --sampler white -n 16,64
LINES
    "$program" sample --sampler white -n 64 -m 2 --quiet >two.txt
    "$program" power - -k 4 --quiet -o /dev/null --plot a.svg <two.txt || complain "no picture of standard input"
    grep -q 'the first set, N = 64' a.svg || complain "no points of standard input"
    try 0 angular --sampler fibonacci -n 64 -l 4 --quiet -o /dev/null --plot a.svg
    grep -q 'the first set, N = 64, z ≥ 0, from above' a.svg || complain "no points of the sphere"
    try 0 pairs --sampler fibonacci -n 64 -l 4 --quiet -o /dev/null --plot a.svg
    grep -q 'the first set' a.svg && complain "points beside pair sums"
fi
finish

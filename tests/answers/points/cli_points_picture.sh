#!/usr/bin/env bash
# cli_points_picture.sh PROGRAM: --plot of commands that make points: what is drawn, what is written beside it, what is refused.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" sample "$1"
mkdir none broken spy
whole=$PATH
printf '#!/bin/sh\necho "no terminal today" >&2\nexit 1\n' >broken/gnuplot
printf '#!/bin/sh\ntee "%s/script" | PATH="%s" exec gnuplot "$@"\n' "$scratch" "$whole" >spy/gnuplot
chmod +x broken/gnuplot spy/gnuplot
panel() { # NUMBER: the points that gnuplot was given for it
    sed -n "/^\$data$1_0 << EOD/,/^EOD/p" script | sed '1d;$d'
}
shows() { # PICTURE: it is there
    [[ -s $1 ]] || complain "no picture $1: $(<err)"
}

if command -v gnuplot >/dev/null; then
    export PATH=$PWD/spy:$whole
    # the picture alone: nothing on standard output, and the points of the first realization
    runs 0 --sampler jittered -n 64 --plot a.svg -m 3
    shows a.svg
    [[ ! -s out ]] || complain "points beside the picture: $(head -n 2 out)"
    cp script first.script
    runs 0 --sampler jittered -n 64
    panel 0 >drawn
    awk '{ printf " %.9g %.9g\n", $1, $2 }' out >points
    cmp -s points drawn || complain "other points: $(diff points drawn | head -n 3)"
    # beside files, with the same picture, and the points as without it
    runs 0 --sampler jittered -n 64 -m 3 -o with.txt --plot b.svg
    cmp -s script first.script || complain "another picture beside a file"
    runs 0 --sampler jittered -n 64 -m 3 -o without.txt
    cmp -s with.txt without.txt || complain "other points beside a picture"
    runs 0 --sampler jittered -n 64 --plot c.svg --format csv
    shows c.svg
    [[ $(wc -l <out) == 64 ]] || complain "--format csv: $(wc -l <out) lines"
    # sides of the sphere, one of the hemisphere, pairs of coordinates, several samplers
    runs 0 --sampler healpix:nside=2 --plot d.png
    [[ $(panel 0 | wc -l) == 28 && $(panel 1 | wc -l) == 20 ]] || # 12 nside^2, of which 4 nside on the equator
        complain "sides: $(panel 0 | wc -l), $(panel 1 | wc -l)"
    awk 'NF != 2 || $1 * $1 + $2 * $2 > 1.00000001 { exit 1 }' <(panel 0 && panel 1) || complain "outside of the circle"
    runs 0 --sampler white:lift=hemisphere -n 50 --plot e.pdf
    [[ $(panel 0 | wc -l) == 50 && -z $(panel 1) ]] || complain "hemisphere"
    shows e.pdf
    runs 0 --sampler white -n 50 -d 3 --plot f.png
    [[ $(panel 2 | wc -l) == 50 && -z $(panel 3) ]] || complain "pairs of three coordinates"
    runs 0 --sampler white --sampler poisson-disk --sampler white-sphere -n 50 --plot g.png
    [[ $(panel 0 | wc -l) == 50 && $(grep -c '^[$]data' script) == 4 ]] || complain "several samplers"
    runs 0 --sampler white --sampler bnot -n 16..64 --plot h.png
    [[ $(grep -c '^[$]data' script) == 6 && $(panel 5 | wc -l) == 64 ]] || complain "several samplers and N"
    grep -q ' sets.* seed ' script || complain "title: $(grep -m 3 title script)"
    runs 0 --sampler white -n 16..64 --plot h.png
    grep -qE 'white.{4} seed ' script || complain "title: $(grep -m 3 title script)"
    export PATH=$whole
fi

# the same of files
converts() { # EXIT ARGS...
    local code=0 expected=$1
    shift
    checked=$((checked + 1))
    "$program" convert "$@" >out 2>err || code=$?
    [[ $code == "$expected" ]] || complain "convert: exit $code, not $expected: $*: $(<err)"
}
"$program" sample --sampler white -n 40 -m 3 -o sets.txt
"$program" sample --sampler white-sphere -n 40 -o sphere.txt
"$program" sample --sampler white-hemisphere -n 40 -o hemisphere.txt
printf '0,90\n45,0\n-30,-60\n' >angles.csv
if command -v gnuplot >/dev/null; then
    export PATH=$PWD/spy:$whole
    converts 0 sets.txt --plot h.svg
    shows h.svg
    [[ ! -s out ]] || complain "points beside the picture of a file"
    head -n 40 sets.txt | awk '{ printf " %.9g %.9g\n", $1, $2 }' >points
    panel 0 | cmp -s - points || complain "other points than the first set of the file"
    converts 0 sets.txt --plot i.svg -o all.txt
    cmp -s all.txt sets.txt || complain "other points beside the picture of a file"
    panel 0 | cmp -s - points || complain "another set beside a file"
    converts 0 --merge --select-points 2..3 --plot j.svg - <sets.txt
    [[ $(panel 0 | wc -l) == 6 ]] || complain "merged sets: $(panel 0 | wc -l) points"
    converts 0 --select-sets 2 --plot k.svg --format csv sets.txt
    [[ $(wc -l <out) == 40 && $(panel 0 | wc -l) == 40 ]] || complain "the second set"
    panel 0 | cmp -s - points && complain "the first set instead of the second"
    converts 0 sets.txt sphere.txt hemisphere.txt --plot l.png
    [[ $(grep -c '^[$]data' script) == 4 ]] || complain "not a square, two sides and one"
    grep -q 'sphere' script || complain "panels without names"
    for output in "" "-o angles.npy --format openquad"; do # as vectors, and as angles beside
        # shellcheck disable=SC2086 # words
        converts 0 --columns lon-lat angles.csv --plot m.png $output
        { panel 0 && panel 1; } | awk '{ printf "%.6f %.6f,", $1 + 1e-12, $2 + 1e-12 }' >points
        [[ $(<points) == '0.000000 0.000000,0.707107 0.707107,0.433013 -0.250000,' ]] || complain "angles: $(<points)"
    done
    export PATH=$whole
fi
converts 1 absent.txt --plot n.png
converts 2 sets.txt --plot n.gif
says '--plot draws .png, .svg and .pdf'
converts 2 sets.txt --plot sets.txt.svg -o sets.txt.svg --format csv
says 'are the same file'
seventeen=$(printf 'sets.txt %.0s' {1..17})
# shellcheck disable=SC2086 # words
converts 2 $seventeen --plot n.png
says '17 files are more than 16'
converts 1 sets.txt --plot n.png --memory 100
says 'does not fit in the memory that is allowed'
[[ ! -e n.png ]] || complain "a picture of nothing"

# a picture that fails costs a warning, and is an error where it is all
PATH=$PWD/none:$PWD runs 0 --sampler white -n 4 --plot a.png -o points.txt
[[ $(head -n 1 err) == *'"a.png" will not be drawn: plots need the program gnuplot'* ]] || complain "not said before: $(<err)"
[[ $(wc -l <points.txt) == 4 && ! -e a.png ]] || complain "no points without gnuplot"
PATH=$PWD/none:$PWD runs 1 --sampler white -n 4 --plot a.png
says 'plots need the program gnuplot'
PATH=$PWD/broken:$whole runs 0 --sampler white -n 4 --plot a.png -o points.txt --quiet
says '"a.png" was not drawn: gnuplot could not draw the picture: no terminal today'
PATH=$PWD/broken:$whole runs 1 --sampler white -n 4 --plot a.png
says 'no terminal today'
PATH=$PWD/broken:$whole runs 1 --sampler white -n 4 --plot a.png -o /dev/null
says 'no terminal today'
[[ ! -e a.png ]] || complain "half a picture"

# refused before the work
refuses '--plot draws .png, .svg and .pdf, not "a.gif"' --sampler white -n 1e9 --plot a.gif
refuses '--plot draws .png, .svg and .pdf, not "-"' --sampler white -n 1e9 --plot -
runs 1 --sampler white -n 1e9 --plot absent/a.png
says 'cannot write absent/a.png: No such file or directory'
refuses 'are the same file' --sampler white --plot a.svg -o a.svg --format csv
refuses '2 samplers were given; one output holds the points of one' --sampler white --sampler bnot --plot a.png -o a.txt
refuses '2 samplers were given' --sampler white --sampler bnot
refuses '--plot-log is not an option of this command' --sampler white --plot a.png --plot-log x
refuses '--sampler NAME is needed' --plot a.png
finish

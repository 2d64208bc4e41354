#!/usr/bin/env bash
# cli_run_pictures.sh PROGRAM: pictures of scenes: panels for many curves, and pictures that fail, which cost no numbers.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" run "$1"

# Two lobes, five samplers, two weights: 20 curves, of which none was drawn once.
cat >many.yaml <<'SCENE'
scene: 1
results:
  - result: quadrature
    name: rules
    engine: host_direct
    brdf: [diffuse, "glossy:n=30"]
    samplers: [fibonacci-hemisphere, "larcher-pillichshammer:lift=hemisphere", "sobol:lift=hemisphere", white-hemisphere,
      "jittered:lift=hemisphere"]
    weights: [equal, optimal]
    points: 16
    max-degree: 6
  - result: truncation
    name: one-key
    brdf: ["glossy:n=1", "glossy:n=2", "glossy:n=3", "glossy:n=4", "glossy:n=5", "glossy:n=6", "glossy:n=7", "glossy:n=8",
      "glossy:n=9", "glossy:n=10"]
    max-degree: 6
SCENE

mkdir broken none
printf '#!/bin/sh\necho "no terminal today" >&2\nexit 1\n' >broken/gnuplot
chmod +x broken/gnuplot
whole=$PATH
for path in "$PWD/none" "$PWD/broken:$PATH"; do
    PATH=$path runs 0 many.yaml -o numbers
    grep -q '^pointspec: 8 pictures of "numbers" were not drawn: .*gnuplot' err || complain "no warning: $(<err)"
    [[ -s numbers/rules.csv && -s numbers/rules.summary.csv && -s numbers/one-key.csv && -s numbers/record.json ]] ||
        complain "numbers are missing: $(ls numbers)"
    [[ $(grep -c 'not drawn' numbers/index.html) == 8 ]] || complain "the page does not say what is missing"
    compgen -G 'numbers/*.svg' && complain "pictures without gnuplot"
    PATH=$path runs 0 --quiet many.yaml -o numbers
    says 'were not drawn'
    mv numbers "numbers.$((checked))"
done
PATH=$PWD/none runs 0 many.yaml -o early
head -n 1 err | grep -q 'plots need the program gnuplot' || complain "gnuplot is not looked for before the work: $(<err)"
PATH=$whole

# Numbers of points that change from realization to realization: a picture as of others.
cat >varying.yaml <<'SCENE'
scene: 1
results:
  - {result: power, name: disks, samplers: [poisson-disk], points: 64, realizations: 3, max-frequency: 8, pictures: true}
SCENE

# Keys of axes: one value each, of results and of defaults, where the kind has such pictures.
axes() { # LINES OF YAML: a result of white points with them
    printf 'scene: 1\nresults:\n  - result: %s\n    sampler: white\n    points: 16\n' "$1" >axes.yaml
    printf '    %s\n' "${@:2}" >>axes.yaml
    runs 2 axes.yaml -o axes
}
axes power 'plot-log: z' && says 'axes.yaml:6: plot-log: "z" is not one of x, y, xy, none'
axes power 'plot-log: [x, y]' && says 'axes.yaml:6: plot-log: one value is wanted here, not a list'
axes power 'plot-range: 3..1' && says 'axes.yaml:6: plot-range: 3..1 is no interval'
axes power 'plot-range: 0..1' 'plot-log: x' && says 'axes.yaml:7: plot-log: --plot-range: the x axis is logarithmic by --plot-log, and cannot begin at 0'
axes sample 'plot-log: x' && says 'axes.yaml:6: plot-log: not a key of this result'

if command -v gnuplot >/dev/null; then
    cat >axes.yaml <<'SCENE'
scene: 1
defaults: {engine: host_direct, plot-log: none, plot-range: "0.5..1.5"}
results:
  - {result: power, name: asked, title: T, sampler: jittered, points: 64, realizations: 4, max-frequency: 16}
  - {result: power, name: own, title: T, sampler: jittered, points: 64, realizations: 4, max-frequency: 16, plot-log: x, plot-range: "0.25..1.5,0.01..4"}
  - {result: truncation, name: lobes, brdf: [diffuse, "glossy:n=30"], max-degree: 6, plot-range: 1..4}
  - {result: variance, name: mean, sampler: white, points: 16..64, integrand: half-plane, shifts: 0, plot-log: xy, plot-range: "20..50,1e-6..1"}
  - {result: sample, name: points, sampler: white, points: 16}
SCENE
    ticks() { # FILE: labels of its axes that are numbers
        grep -o '<tspan[^>]*>[-+0-9. ]*<' "axes/$1.svg" | sed 's/.*> *//; s/ *<//' | grep . | tr '\n' ' '
    }
    runs 0 axes.yaml -o axes
    cmp -s <(grep -v '^#' axes/asked.csv) <(grep -v '^#' axes/own.csv) || complain "axes changed numbers"
    grep -q '^own,power,1,1,' out || complain "axes are part of the question: $(<out)"
    [[ $(ticks own) == *'3.5 4 '*' 0.5 1 ' && $(ticks asked) == *' 0.6 0.8 1 1.2 1.4 ' ]] || complain "axes: $(ticks own), $(ticks asked)"
    [[ $(ticks lobes-points) == *'1 1.5 2 2.5 3 3.5 4 ' ]] || complain "of a truncation: $(ticks lobes-points)"
    [[ $(ticks mean) == '10 -6 10 -5 '*' 10 0 20 25 30 35 40 45 50 ' ]] || complain "of a variance: $(ticks mean)"
    runs 0 axes/record.json -o again
    for file in own lobes-points mean; do
        cmp -s "axes/$file.svg" "again/$file.svg" || complain "a record has another $file"
    done
    runs 0 varying.yaml -o varying
    [[ -s varying/disks.svg && -s varying/disks-picture-1.svg ]] || complain "no picture: $(ls varying)"
    # one scale of colours for the images of a result: the same numbers at its ends
    cat >colours.yaml <<'SCENE'
scene: 1
results:
  - {result: power, name: both, samplers: [jittered, regular], points: 256, max-frequency: 16, pictures: true}
SCENE
    runs 0 colours.yaml -o colours
    for i in 1 2; do
        grep -q '<text><tspan[^>]*>100</tspan>' "colours/both-picture-$i.svg" || complain "image $i has a scale of its own"
    done
    runs 0 many.yaml -o many
    grep -q 'rules-d2-1.svg: 10 curves are too many for one frame: 2 panels, one for each of weights' err ||
        complain "panels are not said: $(<err)"
    grep -q 'rules-e2-2.svg: 10 curves are too many for one frame: 2 panels' many/index.html || complain "nor on the page"
    cmp -s many/rules.csv numbers.2/rules.csv || complain "numbers differ without pictures"
    for file in many/{rules-{d2,c2,e2}-{1,2},one-key-{error,points}}.svg; do
        [[ -s $file ]] || complain "$file is not there: $(ls many)"
        ! command -v python3 >/dev/null || python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' "$file" ||
            complain "$file is no XML"
    done
    # every curve of a sampler and a weight: 2 panels with 5 curves, and a key with 5 lines
    [[ $(grep -c '>equal<\|>optimal<' many/rules-e2-1.svg) == 2 && $(grep -c '<title>' many/rules-e2-1.svg) -ge 11 ]] ||
        complain "not all curves are drawn: $(grep '<title>' many/rules-e2-1.svg)"
    for label in white-hemisphere fibonacci-hemisphere jittered:lift=hemisphere; do
        [[ $(grep -c "<tspan[^>]*>$label" many/rules-e2-1.svg) == 1 ]] || complain "$label is not once in the key"
    done
    for n in 1 2 3 4 5 6 7 8 9 10; do
        grep -q "<tspan[^>]*>glossy:n=$n<" many/one-key-error.svg || complain "n=$n is not drawn"
    done
    # titles of all kinds
    cat >titles.yaml <<'SCENE'
scene: 1
title: "]]> <b> 'x"
results:
  - {result: truncation, name: a, title: "''lead ]]> `touch hostile` \\ {x}_y @a %d \u00e9", brdf: [diffuse, "glossy:n=30"], max-degree: 6}
SCENE
    runs 0 titles.yaml -o titles
    for file in titles/*.svg; do
        # shellcheck disable=SC2016 # Python's text
        ! command -v python3 >/dev/null || python3 -c 'import sys, xml.dom.minidom as m
text = "".join(n.data for t in m.parse(sys.argv[1]).getElementsByTagName("text") for n in t.childNodes if n.nodeType == 3)
sys.exit("\x27\x27lead ]]> `touch hostile` \\ {x}_y @a %d \u00e9" not in text)' "$file" || complain "$file has another title"
    done
    [[ -s titles/a-error.svg && -s titles/a-points.svg && ! -e hostile ]] || complain "pictures of hostile titles"
    # TMPDIR that cannot be written to
    TMPDIR=$PWD/nowhere runs 0 --cache 0 titles.yaml -o elsewhere
    grep -q 'were not drawn: .*nowhere.*TMPDIR' err || complain "TMPDIR is not honoured: $(<err)"
fi
finish

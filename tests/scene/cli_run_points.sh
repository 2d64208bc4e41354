#!/usr/bin/env bash
# cli_run_points.sh PROGRAM: points as a result of a scene: pictures, arrays, digests, the cache, the record, what is refused.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" run "$1"
mkdir none spy
whole=$PATH
cat >spy/gnuplot <<SPY
#!/bin/sh
script=\$(mktemp "$scratch/script.XXXXXX")
cat >"\$script"
PATH="$whole" exec gnuplot "\$@" <"\$script"
SPY
chmod +x spy/gnuplot
cat >points.yaml <<'SCENE'
scene: 1
defaults: {points: 64, seed: 3}
results:
  - {result: sample, name: plane, title: Some points, samplers: [jittered, poisson-disk], plot: true}
  - {result: sample, name: sphere, sampler: white-sphere, realizations: 3}
  - {result: sample, name: arrays, sampler: bnot, points: 16..32, realizations: 2, arrays: true, plot: false}
  - {result: truncation, name: lobe, brdf: diffuse, max-degree: 2, plot: false}
SCENE
PATH=$PWD/spy:$whole runs 0 points.yaml -o first
[[ $(grep -c ',sample,' out) == 3 ]] || complain "not three results: $(<out)"
for name in plane.csv plane.summary.csv sphere.csv arrays.csv arrays-array-1.npy arrays-array-2.npy index.html; do
    [[ -s first/$name ]] || complain "no $name: $(ls first)"
done
[[ ! -e first/arrays.svg ]] || complain "a picture that was not asked for"

# the points are those of the command
"$program" sample --sampler bnot -n 32 -m 2 --seed 3 -o own.npy
cmp own.npy first/arrays-array-2.npy || complain "other points than those of sample"
[[ $(grep -v '^#' first/sphere.csv | cut -d , -f 1,2 | paste -sd ' ') == 'realization,points 0,64 1,64 2,64' ]] ||
    complain "rows: $(<first/sphere.csv)"
[[ $(grep -v '^#' first/sphere.csv | sed 1d | cut -d , -f 3 | sort -u | wc -l) == 3 ]] || complain "digests are the same"
grep -q '^jittered,64,1,torus,2,3$' first/plane.summary.csv || complain "summary: $(<first/plane.summary.csv)"

if command -v gnuplot >/dev/null; then
    [[ -s first/plane.svg && -s first/sphere.svg && $(find . -name 'script.*' | wc -l) == 2 ]] || complain "no pictures"
    script=$(grep -l 'Some' script.*)
    "$program" sample --sampler jittered -n 64 --seed 3 | awk '{ printf " %.9g %.9g\n", $1, $2 }' >points
    sed -n '/^.data0_0 << EOD/,/^EOD/p' "$script" | sed '1d;$d' | cmp -s - points || complain "other points are drawn"
    [[ $(grep -c '^[$]data' "$script") == 2 ]] || complain "not a panel for each sampler"
    grep -q 'N = ' first/plane.svg || complain "panels without N"
fi

# the cache has all of it, and a record makes the same bits, with the engines of then, too
PATH=$PWD/none:$PWD runs 0 points.yaml -o again --quiet
[[ $(grep -c ',sample,' out) == 3 && $(awk -F , '$2 == "sample" { print $3 - $4 }' out | sort -u) == 0 ]] ||
    complain "not from the cache: $(<out)"
for name in plane.csv sphere.csv arrays.csv arrays-array-1.npy; do
    cmp -s first/$name again/$name || complain "another $name from the cache"
done
if command -v gnuplot >/dev/null; then
    cmp -s first/plane.svg again/plane.svg || complain "another picture from the cache"
fi
runs 0 first/record.json -o repeated
runs 0 first/record.json -o repeated --recorded-engines # the host has none
cmp -s first/arrays-array-1.npy repeated/arrays-array-1.npy || complain "other points by the record"
sed 's/"seed": \["3"\]/"seed": "4"/; s/"3"/"4"/' first/record.json >other.json
cmp -s other.json first/record.json && complain "the record has no seed"
runs 3 other.json -o other

# without gnuplot the points are there
PATH=$PWD/none:$PWD runs 0 points.yaml -o bare --cache 0
grep -q '^pointspec: 2 pictures of "bare" were not drawn: ' err || complain "no warning: $(<err)"
cmp -s first/arrays-array-1.npy bare/arrays-array-1.npy || complain "no points without gnuplot"

# thirteen sets are two pages
printf 'scene: 1\nresults:\n  - {result: sample, name: many, sampler: white, points: 4, seed: [%s]}\n' \
    "$(seq -s , 13)" >many.yaml
PATH=$PWD/none:$PWD runs 0 many.yaml --cache 0
grep -q '^pointspec: 2 pictures of "many" were not drawn: ' err || complain "not two pages: $(<err)"
grep -q 'many-page-2.svg' many/index.html || complain "no second page"

refuses_scene() { # PART RESULT
    printf 'scene: 1\nresults:\n  - %s\n' "$2" >bad.yaml
    refuses "bad.yaml:3: $1" bad.yaml
}
refuses_scene 'sample-1: sampler: points are of a sampler, and none is named' '{result: sample}'
refuses_scene 'sample-1: unknown sampler "bluenoise"; there are white, ' '{result: sample, sampler: bluenoise}'
refuses_scene 'files: not a key of this result' '{result: sample, sampler: white, files: a.txt}'
refuses_scene 'tol: not a key of this result' '{result: sample, sampler: white, tol: 1e-3}'
refuses_scene 'pictures: not a key of this result' '{result: sample, sampler: white, pictures: true}'
refuses_scene 'arrays: true or false, not "coefficients"' '{result: sample, sampler: white, arrays: coefficients}'
refuses_scene 'sample-1: arrays: an array holds sets of the same number of points' \
    '{result: sample, sampler: poisson-disk, realizations: 3, arrays: true}'
refuses_scene 'sample-1: sampler bnot: 3 points asked for' '{result: sample, sampler: bnot, points: 3}'
refuses_scene 'result: "sampl" is no kind of answer; did you mean sample?' '{result: sampl}'
printf 'scene: 1\nresults:\n  - {result: sample, sampler: white, points: 1e6, memory: 1e6}\n' >bad.yaml
runs 1 bad.yaml
says 'bad.yaml:3: sample-1: 2000000 points in 2 dimensions take 30.52M of memory, above the limit of 976.6K'
finish

#!/usr/bin/env bash
# cli_run_sets.sh PROGRAM: `sets` of scenes, files under names beside samplers: rows, labels, pictures, records, options of
# either, and what is refused.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" run "$1"

rows() { grep -v '^#' "$1" | sed 1d; }
values() { # RESULT: of the column sampler, in their order
    rows "folder/$1.summary.csv" | cut -d, -f1 | paste -sd' '
}
scene() { # LINES OF RESULTS
    printf 'scene: 1\ndefaults: {engine: host_direct, no-self-check: true, realizations: 5, seed: 3}\nresults:\n' >scene.yaml
    cat >>scene.yaml
    rm -rf folder
}
alone() { # NAME ARGS..: the rows of a command, behind a name
    local name=$1
    shift
    "$program" "$@" --engine host_direct --no-self-check >alone.csv 2>err || complain "$*: $(<err)"
    rows alone.csv | sed "s/^/$name,/"
}
mkdir data
for i in 1 2; do
    "$program" sample --sampler jittered -n 64 -m 6 -s "$i" -o "data/j$i.txt"
    "$program" sample --sampler latin-hypercube -n 49 -m 4 -s "$i" -o "data/l$i.txt"
done

# ---- samplers first, then sets; rows are those of the command ----
scene <<'END'
  - result: power
    name: spectra
    sets: {jit: data/j*.txt, lhs: [data/l1.txt, data/l2.txt]}
    samplers: [white, regular]
    points: 64
    max-frequency: 4
  - {result: variance, name: errors, sets: {jit: data/j*.txt, one: [data/l1.txt]}, integrand: [disk, gaussian], max-frequency: 8}
  - {result: power, name: single, sets: {jit: data/j1.txt}, max-frequency: 3, pictures: true}
  - {result: power, name: chosen, sets: {jit: data/j1.txt}, samplers: white, points: 64, max-frequency: 12, per-ring: 4, seed: 9}
END
runs 0 scene.yaml -o folder --cache 0
[[ $(values spectra) == "white regular jit lhs" ]] || complain "order: $(<folder/spectra.summary.csv)"
diff <(rows folder/spectra.csv) <(alone white power -k 4 --sampler white -n 64 -m 5 -s 3
    alone regular power -k 4 --sampler regular -n 64 -m 5 -s 3
    alone jit power -k 4 data/j1.txt data/j2.txt
    alone lhs power -k 4 data/l1.txt data/l2.txt) >differences || complain "rows: $(<differences)"
diff <(rows folder/errors.csv) <("$program" variance --engine host_direct --no-self-check -k 8 --integrand disk --integrand gaussian \
    --set 'jit=data/j*.txt' --set one=data/l1.txt | grep -v '^#' | sed 1d) >differences || complain "variances: $(<differences)"
diff <(rows folder/chosen.csv | grep '^jit') <(alone jit power -k 12 --per-ring 4 -s 9 data/j1.txt) >differences || complain "a subset of rings by the seed: $(<differences)"
if command -v gnuplot >/dev/null; then
    for label in white regular jit lhs; do
        grep -q ">$label<" folder/spectra.svg || complain "the picture lacks $label"
    done
fi
grep -q '"sets": {"jit": \["data/j1.txt", "data/j2.txt"\], "lhs": \["data/l1.txt", "data/l2.txt"\]}' folder/record.json ||
    complain "record: $(grep sets folder/record.json)"
# a record asks the same, also where there are more files by then
cp data/j1.txt data/j3.txt
runs 0 folder/record.json -o again --cache 0
diff <(rows folder/spectra.csv) <(rows again/spectra.csv) >differences || complain "the record asks otherwise"
rm data/j3.txt
"$program" plan run scene.yaml >planned.txt 2>err || complain "plan: $(<err)"
[[ $(grep -c ',chosen,' planned.txt) == 9 ]] || complain "plan: $(<planned.txt)"

# ---- what is about samplers or files is for those; a key of the other order; defaults ----
awk '/^#/ { print; next } { printf "%.17g %.17g\n", $1 * 8, $2 * 8 }' data/j1.txt >wide.txt
scene <<'END'
  - {result: power, name: wide, samplers: white, points: 64, box: "0,8", max-frequency: 3, sets: {wide: wide.txt}}
END
runs 0 scene.yaml -o folder --cache 0
diff <(rows folder/wide.csv) <(alone white power -k 3 --sampler white -n 64 -m 5 -s 3; alone wide power -k 3 --box 0,8 wide.txt) >differences ||
    complain "box: $(<differences)"
printf 'scene: 1\ndefaults: {engine: host_direct, sets: {a: data/j1.txt}, samplers: white, points: 64, realizations: 2}\nresults:\n%s\n%s\n' \
    '  - {result: power, name: both, max-frequency: 2}' '  - {result: power, name: own, max-frequency: 2, samplers: [regular, halton]}' >scene.yaml
rm -rf folder
runs 0 scene.yaml -o folder --cache 0
[[ $(values both) == "white a" && $(values own) == "regular halton" ]] || complain "defaults: $(values both); $(values own)"

# ---- ranks are of all samplers and sets of a result, also from its record ----
scene <<'END'
  - {result: variance, name: ranked, integrand: disk, max-frequency: 8, shifts: 0, rank: true, sets: {jit: data/j*.txt, lhs: [data/l1.txt, data/l2.txt]}, samplers: [white, halton], points: 64, realizations: 9}
  - {result: variance, name: alone, integrand: disk, max-frequency: 8, rank: true, shifts: 0, sets: {jit: data/j*.txt, lhs: data/l1.txt}}
END
runs 0 scene.yaml -o folder --cache 0
"$program" variance --integrand disk -k 8 --shifts 0 --rank --sampler white --sampler halton -n 64 -m 9 -s 3 --set 'jit=data/j*.txt' --set lhs=data/l1.txt,data/l2.txt \
    --engine host_direct --no-self-check >ranked.csv 2>err || complain "rank: $(<err)"
diff <(rows folder/ranked.csv) <(rows ranked.csv) >differences || complain "ranked: $(<differences)"
[[ $(rows folder/alone.csv | cut -d, -f1 | paste -sd' ') == "jit lhs" ]] || complain "alone: $(<folder/alone.csv)"
runs 0 folder/record.json -o again --cache 0
diff <(rows folder/ranked.csv) <(rows again/ranked.csv) >differences || complain "the record ranks otherwise"

# ---- what is refused, with its line ----
refused() { # SENTENCE: of the scene on standard input
    scene
    refuses "$1" scene.yaml -o folder
}
refused 'scene.yaml:4: sets: a mapping is wanted here' <<<'  - {result: power, sets: [data/j1.txt]}'
refused 'scene.yaml:4: a: sets: no file matches "none*.txt"' <<<'  - {result: power, sets: {a: "none*.txt"}}'
refused 'scene.yaml:4: a: a scene can be run again, standard input (-) cannot' <<<'  - {result: power, sets: {a: "-"}}'
refused 'needs a name of 1 to 63 bytes without =, and files' <<<'  - {result: power, sets: {a: []}}'
refused 'scene.yaml:4: sets: "a=b" needs a name' <<<'  - {result: power, sets: {"a=b": data/j1.txt}}'
refused 'sets: not a key of this result' <<<'  - {result: check, against: saved.json, sets: {a: data/j1.txt}}'
refused '"white" is the name of a sampler of line 4 already' <<<'  - {result: power, samplers: white, sets: {white: data/j1.txt}}'
refused 'files: beside sets files stand under a name' <<<'  - {result: power, files: data/j2.txt, sets: {a: data/j1.txt}}'
refused 'points: sets have their own, and one number is for samplers' <<<'  - {result: power, samplers: white, points: [64, 128], sets: {a: data/j1.txt}}'
refused 'sets: not a key of this result' <<<'  - {result: truncation, brdf: diffuse, sets: {a: data/j1.txt}}'
refused 'sets: not a key of this result' <<<'  - {result: sample, samplers: white, points: 4, sets: {a: data/j1.txt}}'
refused 'scene.yaml:4: a: "data/a,b.txt" has a comma' <<<'  - {result: variance, integrand: disk, samplers: white, rank: true, sets: {a: "data/a,b.txt"}}'
refused 'rank compares samplers and sets, which takes two of them' <<<'  - {result: variance, integrand: disk, rank: true, sets: {a: data/j1.txt}}'
refused 'realizations does not go with point files' <<<'  - {result: power, realizations: 4, sets: {a: data/j1.txt}}'
scene <<<'  - {result: power, sets: {a: [data/j1.txt, none.txt]}}'
runs 1 scene.yaml -o folder
says 'scene.yaml:4: sampler: cannot read "none.txt"'
finish

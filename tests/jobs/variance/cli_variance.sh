#!/usr/bin/env bash
# cli_variance.sh PROGRAM: pointspec variance: columns, formats, headers, the same bits beside other questions, scenes;
# what it refuses, and how it says it.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" variance "$1"

columns=points,predicted,predicted_error,lower,upper,measured,measured_error,z_score,white
table() { grep -v '^#' out; }
head_is() { # COLUMNS
    [[ $(table | head -n 1) == "$1" ]] || complain "columns: $(table | head -n 1)"
}
is() { # KEY VALUE
    [[ $(key "$1") == "$2" ]] || complain "$1: $(key "$1"), not $2"
}
near() { # WHAT VALUE EXACT RELATIVE
    awk -v a="$2" -v b="$3" -v r="$4" 'BEGIN { exit !(a - b <= r * b && b - a <= r * b) }' || complain "$1: $2, not $3"
}
column() { # NAME of the only row
    table | awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i } NR == 2 { print $at }'
}
# frequencies enough for what is not about the prediction
few=(-k 4)

# ---- columns ----

runs 0 --sampler white -n 16 -m 50 --integrand disk
head_is $columns
[[ $(table | wc -l) == 2 ]] || complain "rows: $(table)"
near white "$(column white)" 9.862274916100424e-3 1e-14
near predicted "$(column predicted)" 9.862274916100424e-3 0.25
near z "$(column z_score)" "$(table | awk -F, 'NR == 2 { printf "%.17g", ($6 - $2) / sqrt($3 ^ 2 + $7 ^ 2) }')" \
    "$(awk -v z="$(column z_score)" 'BEGIN { print z < 0 ? -1e-12 : 1e-12 }')"
is seed 1
is trials 'sets moved at random, one for each trial'
is shifts 1
is integrand disk
is integral 0.19634954084936207
is sampler white
is points 16
is realizations 50
is max_frequency 20
is most_power 1
is most_power_is 'a bound'
[[ $(key normalization) == *'a variance'* && $(key command) == 'pointspec variance --sampler white'* ]] || complain "header: $(<out)"

runs 0 --sampler poisson-disk -n 16 -m 5 --integrand gaussian
is most_power_is 'assumed; nothing depends on it, for the integrands end before the cut-off'
is integrand_note 'summed over its periodic images'
[[ $(column points) =~ ^1[0-9](\.[0-9]+)?$ && $(key points_smallest) -le $(key points_largest) ]] || complain "points: $(<out)"
runs 0 --sampler poisson-disk -n 16 -m 5 --integrand disk
is most_power_is 'assumed: the largest that was measured, at least 1'
# what P may be in a set that never changes
runs 0 --sampler hammersley -n 16 -m 5 "${few[@]}" --integrand gaussian
is most_power 16
[[ $(column predicted_error) == 0 && $(column lower) != '' ]] || complain "hammersley: $(table)"

# several of each: what changes has a column, in the order of the words
runs 0 --sampler white --sampler jittered -n 8,16 -m 5 "${few[@]}" --integrand disk --integrand gaussian
head_is sampler,integrand,$columns
table | sed 1d | cut -d, -f1-3 >rows
printf '%s\n' {white,jittered}','{8,16} | while IFS=, read -r sampler num; do
    printf '%s\n' "$sampler,disk,$num" "$sampler,gaussian,$num"
done | cmp -s - rows || complain "rows: $(<rows)"
table | sed 1d >together
# and the bits do not depend on what else is asked, or on the order of lists
for sampler in white jittered; do
    for num in 8 16; do
        for integrand in disk gaussian; do
            runs 0 --sampler $sampler -n $num -m 5 "${few[@]}" --integrand $integrand
            head_is $columns
            [[ $(table | sed 1d) == "$(sed -n "s/^$sampler,$integrand,\($num,\)/\1/p" together)" ]] ||
                complain "$sampler, $integrand, $num differs beside others: $(table)"
        done
    done
done
runs 0 --sampler white -n 16,8 -m 5 "${few[@]}" --integrand disk --integrand 'gaussian:sigma=0.0625'
head_is integrand,$columns
runs 0 --sampler jittered --sampler white -n 16,8 -m 5 "${few[@]}" --integrand disk
head_is sampler,$columns
cmp -s <(table | sed 1d | sort) <(sed -n 's/^\([a-z]*\),disk,/\1,/p' together | sort) || complain "another order: $(table)"
runs 0 --sampler jittered -n 4..32 -m 2 "${few[@]}" --integrand disk
[[ $(table | sed 1d | cut -d, -f1 | tr '\n' ' ') == '4 8 16 32 ' ]] || complain "range: $(table)"
# another seed, other numbers
runs 0 --sampler jittered -n 8 -m 5 -s 2 "${few[@]}" --integrand disk
! grep -q "^jittered,disk,$(table | sed 1d)" together || complain 'the seed changes nothing'

# the prediction alone: the same one, and nothing is measured
runs 0 --sampler jittered -n 8 -m 5 "${few[@]}" --integrand disk --shifts 0
is trials none
[[ $(table | sed 1d | cut -d, -f1-5) == "$(sed -n 's/^jittered,disk,\(8,.*\)/\1/p' together | cut -d, -f1-5)" ]] ||
    complain "another prediction: $(table)"
[[ $(table | sed 1d | cut -d, -f6-8) == ,, ]] || complain "measured without trials: $(table)"

# the sphere and the hemisphere
runs 0 --sampler healpix-jittered -n 48 -m 5 --integrand cap --integrand harmonic
head_is integrand,$columns
is max_degree 28
runs 0 --sampler jittered:lift=hemisphere -n 16 -m 5 --integrand square --integrand diffuse
[[ $(table | wc -l) == 3 ]] || complain "hemisphere: $(table)"

# ---- shifts, in place, one realization ----

runs 0 --sampler jittered -n 16 -m 10 --integrand disk
once=$(table | sed 1d)
runs 0 --sampler jittered -n 16 -m 10 --integrand disk --shifts 20
is shifts 20
[[ $(table | sed 1d | cut -d, -f1-5) == "$(cut -d, -f1-5 <<<"$once")" ]] || complain "shifts change the prediction: $(table)"
[[ $(column measured) != "$(cut -d, -f6 <<<"$once")" ]] || complain 'shifts change nothing'
runs 0 --sampler jittered -n 16 -m 10 --integrand disk --in-place
is trials 'sets where they are'
[[ $(column z_score) == '' && $(column measured) != '' && $(column measured_error) != '' ]] || complain "in place: $(table)"
[[ $(table | sed 1d | cut -d, -f1-5) == "$(cut -d, -f1-5 <<<"$once")" ]] || complain "in place: another prediction: $(table)"
runs 0 --sampler white -n 16 -m 1 "${few[@]}" --integrand disk
[[ $(column predicted_error)$(column measured_error)$(column z_score) == '' && $(column measured) != '' ]] || complain "-m 1: $(table)"
is standard_error 'none: one realization'
runs 0 --sampler white -n 10 -m 4 "${few[@]}" --integrand constant:value=0.1
[[ $(table | sed 1d) == 10,0,0,0,0,0,0,,0 ]] || complain "constant: $(table)"
# of a map of one value rounding is left, and of a wave that a grid integrates, which has no z-score
printf 'Pf 2 1 -1\n\0\0\100\100\0\0\100\100' >flat.pfm # 3, 3
for asked in 'white-sphere map:file=flat.pfm' 'regular wave:k=1x0' 'regular gaussian:sigma=0.25'; do
    runs 0 --sampler "${asked% *}" -n 64 -m 20 --integrand "${asked#* }"
    awk -v p="$(column predicted)" 'BEGIN { exit !(p > 0 && p < 1e-16) }' || complain "$asked varies: $(table)"
    [[ $(column z_score) == '' ]] || complain "$asked: $(table)"
done
# no device is needed for the engines of the host
POINTSPEC_DEVICE=none-such runs 0 --engine host_direct --sampler white -n 10 -m 4 "${few[@]}" --integrand disk
head_is $columns

# ---- formats ----

words=(--sampler white -n '8,16' -m 3 "${few[@]}" --integrand disk)
runs 0 "${words[@]}"
table | sed 1d | tr , '\n' >numbers
runs 0 "${words[@]}" --format json
grep -q '"command": "variance"' out || complain "json: $(head -c 300 out)"
[[ $(grep -c '"z_score": ' out) == 2 && $(grep -c '"white": ' out) == 2 ]] || complain "json: rows"
sed -n 's/^ *{\("points".*\)}.*/\1/p' out | tr , '\n' | sed 's/.*: //' | cmp -s - numbers || complain "json: other numbers than csv"
runs 0 "${words[@]}" --in-place --format json
[[ $(grep -c '"z_score": null' out) == 2 ]] || complain "json: a z-score in place"
runs 0 "${words[@]}" -o made.npy
[[ $(head -c 6 made.npy | tail -c 5) == NUMPY && -s made.json ]] || complain 'npy'
grep -aq "'shape': (2, 9)" made.npy || complain "npy: $(head -c 128 made.npy)"
tail -c 144 made.npy | od -An -v -tf8 -w8 | awk '{ printf "%.6g\n", $1 }' |
    cmp -s - <(awk '{ printf "%.6g\n", $1 }' numbers) || complain "npy: other numbers than csv"
runs 0 "${words[@]}" --in-place -o made.npy
[[ $(tail -c 144 made.npy | od -An -v -tf8 -w8 | grep -c nan) == 2 ]] || complain 'npy: a z-score in place'
runs 0 "${words[@]}" --format jsonl
[[ -s out ]] || complain 'jsonl'
refuses 'holds text, which NPY cannot' "${words[@]}" --sampler jittered -o texts.npy
[[ ! -e texts.npy ]] || complain 'texts.npy is there'

# ---- what is refused ----

refuses '--integrand NAME is needed; there are disk, box, half-plane, gaussian' --sampler white -n 8
refuses 'unknown integrand "dsk"; there are disk' --sampler white -n 8 --integrand dsk
refuses 'or a --sampler' --integrand disk -n 8
refuses 'morphed points have the density of a lobe' --sampler white-hemisphere:morph=diffuse -n 8 --integrand cap
refuses 'radius of integrand disk: 0.6 is not between 0 and 0.5' --sampler white -n 8 --integrand disk:radius=0.6
refuses 'integrand disk: there is none on the sphere' --sampler white-sphere -n 8 --integrand disk
refuses 'integrand cap: there is none on the torus' --sampler white -n 8 --integrand cap
# all of them are looked at before any work
refuses 'integrand cap: there is none on the torus' --sampler white-sphere --sampler white -n 8 --integrand cap
refuses 'half-plane' --sampler white -n 8 -d 3 --integrand half-plane
refuses 'half-plane' --sampler white -n 8 --integrand half-plane:offset=7
refuses '--shifts does not go with --in-place' --sampler white -n 8 --integrand disk --shifts 2 --in-place
refuses '--shifts' --sampler white -n 8 --integrand disk --shifts -1
many=()
for i in {11..27}; do many+=(--integrand "disk:radius=0.$i"); done
refuses 'more than 16 integrands' --sampler white -n 8 "${many[@]}"
runs 0 --sampler white -n 4 -k 2 "${many[@]:2}"
[[ $(table | wc -l) == 17 ]] || complain "16 integrands: $(table | wc -l) rows"
"$program" power --sampler white -n 8 --integrand disk >out 2>err && complain 'power takes --integrand'
[[ $(<err) == *--integrand* ]] || complain "power --integrand: $(<err)"

# ---- plan, scenes, pictures ----

"$program" plan variance --sampler white -n 16 -m 5 --integrand disk >out 2>err || complain "plan: $(<err)"
[[ $(key seconds) == [0-9]* ]] || complain "plan: $(<out)"
cat >scene.yaml <<'END'
scene: 1
results:
  - {result: variance, name: two, samplers: [white, jittered], points: [8, 16], realizations: 3, max-frequency: 4, integrand: [disk, gaussian]}
  - {result: variance, name: one, samplers: poisson-disk, points: 16, realizations: 3, max-frequency: 4, integrand: 'box:sides=0.3', shifts: 2, seed: 7}
END
"$program" run --cache 0 scene.yaml -o made >out 2>err </dev/null || complain "scene: $(<err)"
# one question for all integrands of a sampler and N; the number of points stands once, where the command has it
[[ $(grep -c '^# command: ' made/two.csv) == 4 ]] || complain "scene: $(grep '^# command' made/two.csv)"
[[ $(grep -v '^#' made/two.summary.csv | head -n 2) == $'sampler,points,realizations,shifts,most_power,most_power_is\nwhite,8,3,1,1,a bound' ]] ||
    complain "summary: $(<made/two.summary.csv)"
[[ $(grep -c '<td class="text">gaussian</td>' made/index.html) == 4 ]] || complain 'a page without rows'
grep -v '^#' made/two.csv >rows
[[ $(head -n 1 rows) == sampler,integrand,$columns && $(wc -l <rows) == 9 ]] || complain "scene: $(<rows)"
runs 0 --sampler white --sampler jittered -n 8,16 -m 3 -k 4 --integrand disk --integrand gaussian
cmp -s <(sed 1d rows) <(table | sed 1d) || complain "scene: $(<rows) not $(table)"
grep -v '^#' made/one.csv >rows
runs 0 --sampler poisson-disk -n 16 -m 3 -k 4 --integrand box:sides=0.3 --shifts 2 -s 7
cmp -s rows <(table) || complain "scene: $(<rows) not $(table)"
[[ -s made/one.csv && -s made/record.json ]] || complain "scene: $(ls made)"
"$program" run --cache 0 made/record.json -o again >out 2>err </dev/null || complain "record: $(<err)"
for name in one two; do
    cmp -s <(grep -v '^#' made/$name.csv) <(grep -v '^#' again/$name.csv) || complain "record: $name differs"
done
sed 's/gaussian/gausian/' scene.yaml >wrong.yaml
"$program" run --cache 0 wrong.yaml -o wrong >out 2>err </dev/null && complain 'a scene with an unknown integrand'
[[ $(<err) == *'unknown integrand "gausian"'* && ! -e wrong ]] || complain "wrong scene: $(<err)"
if command -v gnuplot >/dev/null; then
    runs 0 --sampler jittered --sampler white -n 8..32 -m 5 "${few[@]}" --integrand disk --plot lines.svg
    [[ -s lines.svg ]] || complain 'no picture'
    grep -q jittered lines.svg || complain 'a picture without a name of a sampler'
    runs 0 --sampler jittered -n 8 -m 1 "${few[@]}" --integrand disk --plot lines.png
    [[ -s lines.png ]] || complain 'no picture of one set'
    # that of a scene is that of the command, but for its title: a panel for each integrand, whose key has every sampler once
    runs 0 --sampler white --sampler jittered -n 8,16 -m 3 -k 4 --integrand disk --integrand gaussian --plot lines.svg
    cmp -s <(sed 's/variance, M = 3, 3 trials/two/' lines.svg) made/two.svg || complain 'a scene has another picture'
    for text in 'jittered: slope' 'white: slope' 'white noise: slope'; do
        [[ $(grep -c "<tspan[^>]*>$text -[0-9.]*<" lines.svg) == 2 ]] || complain "$text: $(grep '<text>' lines.svg)"
    done
    for text in disk gaussian 'variance, M = 3, 3 trials'; do
        [[ $(grep -c ">$text<" lines.svg) == 1 ]] || complain "no $text: $(grep '<text>' lines.svg)"
    done
    # nothing but zeros is no picture, and costs no numbers; beside other integrands it is an empty panel
    runs 0 --sampler white -n 8 -m 3 -k 4 --integrand constant --plot none.svg
    [[ $(table | wc -l) == 2 && ! -e none.svg ]] || complain 'a picture of nothing'
    says 'was not drawn'
    runs 0 --sampler white -n 8 -m 3 -k 4 --integrand constant --integrand disk --plot some.svg
    [[ -s some.svg ]] || complain 'no picture beside a constant'
fi
finish

#!/usr/bin/env bash
# cli_variance_bounds.sh PROGRAM: pointspec variance --bounds: closed forms, profiles that are given and that are found, refusals.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" variance "$1"

column() { # NAME of the first row
    grep -v '^#' out | awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i } NR == 2 { print $at }'
}
near() { # WHAT VALUE EXPRESSION of awk, to 12 digits
    awk -v a="$2" "BEGIN { b = $3; exit !(a - b <= 1e-12 * b && b - a <= 1e-12 * b) }" || complain "$1: $2, not $3"
}
bounds=(--sampler jittered -m 2 --shifts 0 --bounds)

# ---- given profiles: what one frequency or one degree has is known ----

# A wave has |f_k|^2 = 1/4 at k and -k: profile(|k|/sqrt N) / (2N)
runs 0 "${bounds[@]}" 0.5,0.8,3..1.25,0.6,2 -n 256 --integrand wave:k=3x4
near 'a wave below alpha' "$(column best_bound)" '0.5 * (5 / 16 / 0.8) ^ 3 / 512'
near 'a wave below alpha, above' "$(column worst_bound)" '1.25 * (5 / 16 / 0.6) ^ 2 / 512'
[[ $(key upper_profile) == 'P <= 1.25 (nu/0.6)^2 below nu = 0.6, P <= 1.25 above' && $(key lower_gamma) == 0.5 &&
    $(key lower_alpha) == 0.8 && $(key lower_exponent) == 3 && $(key upper_exponent) == 2 ]] || complain "header: $(grep '^#' out)"
[[ $(key best_case_rate) == 2 && $(key worst_case_rate) == 1.5 ]] || complain "rates: $(grep '^# .*rate' out)"
grep -qx 'points,predicted,predicted_error,lower,upper,measured,measured_error,z_score,white,best_bound,worst_bound' out ||
    complain "columns: $(grep -v '^#' out | head -n 1)"
runs 0 "${bounds[@]}" 0.5,0.8,inf..1.25,0.6,inf -n 16 --integrand wave:k=3x4
near 'a wave above alpha' "$(column best_bound)" '0.5 / 32'
near 'a wave above a step' "$(column worst_bound)" '1.25 / 32'
runs 0 "${bounds[@]}" 0..1,0.6,inf -n 256 --integrand wave:k=3x4
[[ $(column best_bound) == 0 && $(column worst_bound) == 0 ]] || complain "a wave below a step: $(column worst_bound)"
# Y_40: (4 pi/N) 9 P(4) P_F(4), P_F(4) = 1/9; on the hemisphere as on the sphere of even functions
runs 0 --sampler white-sphere -m 2 --shifts 0 --bounds 0.5,0.8,1..2 -n 100 --integrand harmonic:degree=4
near 'a harmonic' "$(column best_bound)" '4 * atan2(0, -1) / 100 * 0.5 * 0.4 / 0.8'
near 'a harmonic, constant' "$(column worst_bound)" '4 * atan2(0, -1) / 100 * 2'
# A constant profile is white noise, with what lies beyond the cut-off, in one to three dimensions.
for d in 1 2 3; do
    runs 0 "${bounds[@]}" 0.5..2 -n 64 -d $d --integrand disk --paper-formula
    near "white noise, d = $d" "$(column best_bound)" "0.5 * $(column white)"
    near "white noise, d = $d" "$(column worst_bound)" "2 * $(column white)"
done
[[ $(grep -v '^#' out | head -n 1) == *,white,best_bound,worst_bound,paper ]] || complain 'columns with that of the paper'
# Beyond the cut-off the profile counts, too: the same at any cut-off.
same() { # ARGS... --bounds of profiles that are alike, a small cut-off, one that has all below alpha
    local small=("${@: -4:2}") large=("${@: -2}") words=("${@:1:$#-4}") whole
    runs 0 --shifts 0 -m 2 "${words[@]}" "${large[@]}"
    whole=$(column worst_bound)
    near "${words[*]} ${large[*]}" "$(column best_bound)" "$whole"
    runs 0 --shifts 0 -m 2 "${words[@]}" "${small[@]}"
    near "${words[*]} ${small[*]}" "$(column best_bound)" "$whole"
    near "${words[*]} ${small[*]}, above" "$(column worst_bound)" "$whole"
}
same --sampler jittered -n 256 --integrand disk --bounds 1,3,2..1,3,2 -k 10 -k 60
same --sampler jittered -n 256 --integrand disk --bounds 1,3,2..1,3,2 --bins shells -k 10 -k 60
same --sampler jittered -n 64 --integrand box:sides=0.3 -d 3 --bounds 1,2,inf..1,2,inf -k 3 -k 9
same --sampler healpix-jittered -n 192 --integrand cap --bounds 2,3,4..2,3,4 -l 5 -l 60
same --sampler jittered:lift=hemisphere -n 64 --integrand cap --bounds 1,3,2..1,3,2 -l 5 -l 60
# Where that are too many frequencies the bounds are wider: 1/(2 pi k)^2 sin^2(2 pi k r) of an interval, beyond 4096, at least there.
runs 0 "${bounds[@]}" 1,1000,2..1,1000,2 -n 16 -d 1 --integrand disk -k 5
awk -v a="$(column best_bound)" -v b="$(column worst_bound)" 'BEGIN {
    pi = atan2(0, -1)
    for (k = 1; k < 1e6; k++) { nu = k / 16000; sum += 2 * (sin(pi * k / 2) / (pi * k)) ^ 2 * (nu < 1 ? nu ^ 2 : 1) }
    exit !(a < sum / 16 && a > sum / 64 && b > sum / 16 && b < sum / 4) }' || complain "an interval: $(grep -v '^#' out)"
# P15's profiles of jittered points hold in every direction: the prediction is between, to the noise of 400 sets.
runs 0 --sampler jittered -m 400 --shifts 0 --bounds 0.5,0.5513,2..1,0.5513,2 -n 256 --integrand disk
awk -v a="$(column best_bound)" -v p="$(column predicted)" -v e="$(column predicted_error)" -v b="$(column worst_bound)" \
    'BEGIN { exit !(a < p - 3 * e && p < b + 3 * e && b < 1.15 * p) }' || complain "jittered: $(grep -v '^#' out)"

# ---- profiles that are found are those of power --fit, of the same sets ----

runs 0 --sampler jittered -m 20 --shifts 0 --bounds auto -n 256 --integrand gaussian
[[ $(key skipped) != *beyond* ]] || complain "profiles of too few rings: $(key skipped)"
found=$(sed -n '/^# \(upper\|lower\)_/p' out)
awk -v a="$(column best_bound)" -v p="$(column predicted)" -v b="$(column worst_bound)" \
    'BEGIN { exit !(0 < a && a < p && p < b) }' || complain "bounds: $(grep -v '^#' out)"
command=power
runs 0 --sampler jittered -m 20 -n 256 --fit auto
[[ $(sed -n '/^# \(upper\|lower\)_/p' out) == "$found" ]] || complain "profiles $found, and of power $(grep '^# .*_profile' out)"
command=variance
runs 0 --sampler jittered -m 10 --shifts 0 --bounds auto -n 16 --integrand disk
[[ $(key upper_profile) == 'none: 1 ring up to 0.5'* && -z $(column best_bound) && -z $(column worst_bound) ]] ||
    complain "16 points: $(key upper_profile)"

# ---- every sampler has a pair of its own, of its own profile ----

of_each() { # NAME of a column, a line for each row
    grep -v '^#' out | awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i } NR > 1 { print $at }'
}
alone=() profiles=()
for sampler in white jittered poisson-disk; do
    runs 0 --sampler $sampler -m 20 --shifts 0 --bounds auto -n 256,400 --integrand gaussian --integrand disk
    alone+=("$(of_each best_bound | paste -sd' ') $(of_each worst_bound | paste -sd' ')")
    profiles+=("$(grep '^# \(upper\|lower\)_' out)")
done
runs 0 --sampler white --sampler jittered --sampler poisson-disk -m 20 --shifts 0 --bounds auto -n 256,400 --integrand gaussian --integrand disk
for i in 0 1 2; do
    rows=$((4 * i + 1)),$((4 * i + 4))p
    [[ "$(of_each best_bound | sed -n "$rows" | paste -sd' ') $(of_each worst_bound | sed -n "$rows" | paste -sd' ')" == "${alone[i]}" ]] ||
        complain "bounds of sampler $i: $(grep -v '^#' out), alone ${alone[i]}"
done
[[ $(grep '^# \(upper\|lower\)_' out) == "$(printf '%s\n' "${profiles[@]}")" ]] || complain "profiles of three: $(grep '^# .*_profile' out)"
[[ $(of_each worst_bound | sort -u | wc -l) == 12 && $(key upper_profile | sort -u | wc -l) == 6 ]] || complain "alike: $(grep -v '^#' out)"
# Given: one for all, or one for each, in their order, found or not.
runs 0 --sampler white --sampler jittered -m 2 --shifts 0 -n 16,64 --integrand wave:k=3x4 --bounds 0.5..2
[[ $(of_each worst_bound | paste -sd' ') == '0.0625 0.015625 0.0625 0.015625' ]] || complain "one for all: $(grep -v '^#' out)"
runs 0 --sampler white --sampler jittered -m 2 --shifts 0 -n 16,64 --integrand wave:k=3x4 --bounds 0.5..2 --bounds 0.25,2,2..1,0.5,1
[[ $(of_each worst_bound | paste -sd' ') == '0.0625 0.015625 0.03125 0.0078125' && $(key upper_gamma | paste -sd' ') == '2 2 1 1' ]] ||
    complain "one for each: $(grep -v '^#' out)"
[[ $(of_each best_bound | paste -sd' ') == '0.015625 0.00390625 0.0030517578125 0.00019073486328125' ]] || complain "one for each: $(grep -v '^#' out)"
runs 0 --sampler white --sampler jittered -m 20 --shifts 0 -n 256 --integrand disk --bounds auto --bounds 0.5,0.5513,2..1,0.5513,2
[[ $(key upper_gamma | sed -n 2p) == 1 && $(key upper_alpha | sed -n 2p) == 0.5513 && $(key upper_gamma | sed -n 1p) != 1 ]] ||
    complain "one found: $(key upper_profile)"
refuses '--bounds is there 2 times, and there are not as many samplers: it is said once for all samplers, or once for each' \
    --sampler white --sampler jittered --sampler halton --integrand disk --bounds 0..1 --bounds 0..2
refuses '--bounds auto finds profiles by standard errors' --sampler white --sampler jittered --integrand disk --bounds 0..1 --bounds auto
printf 'scene: 1\nresults:\n  - {result: variance, name: one, samplers: [white, jittered], points: 64, integrand: disk, realizations: 8, shifts: 0, rank: true, bounds: [0.5..2, 0..1]}\n' \
    >each.yaml
command=run
runs 0 each.yaml -o each
[[ $(grep '^# upper_gamma' each/one.csv | paste -sd' ') == '# upper_gamma: 2 # upper_gamma: 1' ]] || complain "a scene: $(grep '^#' each/one.csv)"
command=variance

# ---- pictures, scenes, refusals ----

if command -v gnuplot >/dev/null; then
    runs 0 "${bounds[@]}" 0.5..2 -n 64,256 --integrand disk --plot with.svg -o table.csv
    runs 0 --sampler jittered -m 2 --shifts 0 -n 64,256 --integrand disk --plot without.svg -o table.csv
    (($(grep -c '<path' with.svg) >= $(grep -c '<path' without.svg) + 2)) || complain 'the picture has no bounds'
    runs 0 "${bounds[@]}" 0.5..2 --bounds 0.1..1 --sampler white -n 64,256 --integrand disk --plot with.svg -o table.csv
    runs 0 --sampler jittered --sampler white -m 2 --shifts 0 -n 64,256 --integrand disk --plot without.svg -o table.csv
    (($(grep -c '<path' with.svg) >= $(grep -c '<path' without.svg) + 4)) || complain 'the picture has no bounds of each sampler'
fi
printf 'scene: 1\nresults:\n  - {result: variance, name: one, samplers: jittered, points: 64, integrand: disk, shifts: 0, bounds: 0.5..2}\n' \
    >scene.yaml
command=run
runs 0 scene.yaml -o folder
grep -q ',best_bound,worst_bound' folder/one.csv || complain 'a scene has no bounds'
# The key names one sampler, not its first N, and both bounds with their slopes; of several it has the samplers alone.
if command -v gnuplot >/dev/null; then
    sed -i 's/points: 64/points: [64, 256]/; s/0.5..2/"0.5,1,2..2,1,2"/' scene.yaml
    runs 0 scene.yaml -o single
    for text in 'jittered: slope -' 'best bound: slope -1.' 'worst bound: slope -1.'; do
        grep -q ">$text" single/one.svg || complain "the key of one sampler has no $text: $(grep -o '>[^<]*slope[^<]*' single/one.svg)"
    done
    sed -i 's/samplers: jittered/samplers: [jittered, white]/' scene.yaml
    runs 0 scene.yaml -o several
    grep -q '>jittered: slope' several/one.svg || complain 'the key of several samplers has none'
    ! grep -q 'bound: slope' several/one.svg || complain 'the key of several samplers has bounds'
fi
command=variance
for wrong in 1 1,2..3 1,2,3,4..1 much; do
    refuses "--bounds: \"$wrong\" is not one of auto, G,A,B..G,A,B" --sampler white --integrand disk --bounds "$wrong"
done
for wrong in 1,0.5513,2..0.5,0.5513,2 1..0.9 0.05..1,1,2 0.5,1,2..1,1,3 0.5,0.8,2..1.25,0.6,inf 1,0.5,inf..1,0.6,inf; do
    refuses "--bounds: \"$wrong\" has the profile below, which comes first, above the other one: " --sampler white --integrand disk --bounds "$wrong"
done
refuses '1 and 0.5 at the normalized frequency 0.3' --sampler white --integrand disk --bounds 0..1 --bounds 1,0.3,2..0.5,0.3,2 --sampler jittered
for wrong in 1,0,2..2 0..1,0,inf; do
    refuses "--bounds: \"$wrong\" has the exponent" --sampler white --integrand disk --bounds "$wrong"
done
runs 0 "${bounds[@]}" 0.5,0.5,2..2,1,2 -n 16 --integrand wave:k=3x4
runs 0 "${bounds[@]}" 1,0,0..2,0,0 -n 16 --integrand wave:k=3x4
printf 'scene: 1\nresults:\n  - {result: variance, name: one, samplers: jittered, integrand: disk, bounds: 2..0.5}\n' >crossed.yaml
command=run
refuses 'bounds: "2..0.5" has the profile below' crossed.yaml -o crossed
command=variance
refuses '--bounds: "x" is not a finite number' --sampler white --integrand disk --bounds x..1
refuses '--bounds: ' --sampler white --integrand disk --bounds=1..-1
refuses '--bounds auto finds profiles by standard errors, which need 8 realizations or more (--realizations), not 1' \
    --sampler white --integrand disk --bounds auto
finish

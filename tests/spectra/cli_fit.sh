#!/usr/bin/env bash
# cli_fit.sh PROGRAM: --fit of power and angular: numbers, columns, formats, pictures, scenes, what is refused, what there is none of.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" power "$1"

holds() { # EXPRESSION of awk, about keys of the header in out as names
    local text
    text=$(sed -n 's/^# \([a-z0-9_]*\): \(-\?[0-9.e+-]*\)$/\1=\2/p' out | sed 's/=$/=nan/')
    awk "$(printf 'BEGIN { %s exit !(%s) }' "$(tr '\n' ';' <<<"$text")" "$1")" || complain "not $1: $(grep '^#' out)"
}
rows() { sed '/^#/d' out | sed 1d; }

# ---- what is known of samplers: exponent 2 of jittered points, plateaus of white noise and Poisson disks ----
runs 0 --sampler jittered -n 1024 -m 60 -k 64 --fit auto
[[ $(key fit_shape) == 'power law' && $(key fit) == 'power law: up to 0.221 '* ]] || complain "jittered: $(grep '^#' out)"
holds 'exponent > 2 - 3 * exponent_error && exponent < 2 + 3 * exponent_error && exponent_error < 0.15'
holds 'plateau_score < 3 && upper_exponent == 2 && lower_exponent == 2 && upper_gamma > 1 && upper_gamma < 1.1 && upper_alpha > 0.45 && upper_alpha < 0.56'
holds 'effective_nyquist > 0.1 && effective_nyquist < 0.14 && peak > 1 && peak < 1.1 && mean_anisotropy_db < -10'
grep -qx 'bin,frequency,normalized_frequency,count,power,standard_error,anisotropy_db,lower,upper,fit' out ||
    complain "columns: $(sed '/^#/d' out | head -n 1)"
# Profiles are three standard errors away at least, and the fit ends at its reach.
rows | awk -F, -v reach="$(key fit_reach)" '
    $8 > $5 - 2.999 * $6 || $9 < $5 + 2.999 * $6 || ($10 != "") != ($3 <= reach) { bad = 1 }
    END { exit bad || NR != 64 }' || complain "rows: $(rows)"
[[ $(key convergence) == 'converges as N^-1.5 for discontinuous integrands and N^-'*', since power rises as nu^b from zero (b = '* ]] ||
    complain "jittered: $(key convergence)"
holds 'jump_rate == 1.5 && jump_rate_error == 0 && smooth_rate > 2 - 3 * smooth_rate_error && smooth_rate < 2 + 3 * smooth_rate_error'
cut -d, -f1-7 out | sed '/^#/d' >with
runs 0 --sampler jittered -n 1024 -m 60 -k 64
sed '/^#/d' out | cmp -s - with || complain "--fit changes powers"

runs 0 --sampler white -n 1024 -m 20 -k 64 --fit auto
[[ $(key fit_shape) == plateau && $(key upper_profile) == 'P <= 1.'* ]] || complain "white: $(grep '^#' out)"
holds 'plateau > 1 - 3 * plateau_error && plateau < 1 + 3 * plateau_error && upper_exponent == 0 && upper_alpha == 0'
holds 'smooth_rate == 1 && jump_rate == 1'
# A Latin hypercube has no power on the axes, and elsewhere that of white noise: N^-1, not what the means over rings look like
runs 0 --sampler latin-hypercube -n 1024 -m 40 -k 64 --fit auto
[[ $(key convergence) == 'unknown: up to nu = 0.221 power depends on the direction'* && -z $(key smooth_rate) ]] ||
    complain "Latin hypercube: $(key convergence)"
runs 0 --sampler poisson-disk -n 400 -m 20 -k 40 --fit 0 --format json
[[ $(grep -cE '"plateau": \[0.0[0-9]*\]|"fit_shape": \["plateau"\]' out) == 2 ]] || complain "Poisson disk: $(head -c 3000 out)"

# ---- the sphere, and several samplers: every key has a value for each ----
command=angular
runs 0 --sampler healpix-jittered --sampler white-sphere -n 432 -m 40 --fit auto
[[ $(key fit_shape | paste -sd,) == 'power law,plateau' && $(key upper_exponent | paste -sd,) == 2,0 ]] ||
    complain "sphere: $(grep '^#' out)"
grep -qx 'sampler,degree,normalized_degree,power,standard_error,lower,upper,fit' out || complain "columns of angular"
runs 0 --sampler white-hemisphere --hemisphere -n 432 -m 20 --fit auto
[[ $(key fit_shape) == plateau && $(key mean_anisotropy_db) == '' ]] || complain "hemisphere: $(grep '^#' out)"

# ---- pictures and NPY ----
command=power
runs 0 --sampler jittered -n 256 -m 10 --fit auto -o table.npy
grep -q '"exponent"' table.json || complain 'the JSON file of an array has no exponent'
has_shape() { # WITH WITHOUT: two profiles and a fit, and two entries of the key
    (($(grep -c '<path' "$1") == $(grep -c '<path' "$2") + 5)) && grep -q '>lower, upper profile<' "$1" && grep -q '>fit near 0<' "$1"
}
if command -v gnuplot >/dev/null; then
    runs 0 --sampler jittered -n 256 -m 10 --fit auto --plot with.svg -o table.csv
    runs 0 --sampler jittered -n 256 -m 10 --plot without.svg -o table.csv
    has_shape with.svg without.svg || complain 'the picture has no profiles and fit'
fi

# ---- scenes have it as a key ----
printf 'scene: 1\nresults:\n  - {result: power, name: one, samplers: jittered, points: 256, realizations: 10, fit: 2}\n' >scene.yaml
command=run
runs 0 scene.yaml -o folder
grep -q '^# exponent: ' folder/one.csv || complain "a scene: $(grep '^#' folder/one.csv)"
if command -v gnuplot >/dev/null; then
    sed -i 's/, fit: 2//' scene.yaml
    runs 0 scene.yaml -o bare
    has_shape folder/one.svg bare/one.svg || complain 'the picture of a scene has no profiles and fit'
fi

# ---- what there is none of says why, in the header; no number stands for it ----
command=power
"$program" sample --sampler white -n 256 -m 3 -o three.txt
runs 0 three.txt --fit auto
[[ $(key fit) == 'none: the standard errors of 3 realizations do not carry a fit; it needs 8 realizations' &&
    $(key fit_shape) == none && $(key exponent) == '' && $(key plateau) == '' && $(key upper_gamma) == '' ]] ||
    complain "three sets: $(grep '^#' out)"
runs 0 --sampler sobol -n 1024 -m 10 --fit auto
[[ $(key fit) == 'none: '*'its power is the same in all realizations' ]] || complain "Sobol': $(key fit)"
runs 0 --sampler jittered -n 16 -m 10 --fit auto
[[ $(key fit) == 'none: 1 ring up to 0.5 of the normalized frequency is fewer than the 6 that a fit needs; more points '* ]] ||
    complain "16 points: $(key fit)"
runs 0 --sampler jittered -n 1024 -m 8 -k 10 --fit 2
[[ $(key lower_profile) == 'none: no ring is at a normalized frequency of 0.6 or above'* && $(key lower_gamma) == '' ]] ||
    complain "no flat rings: $(key lower_profile)"
refuses '--fit weighs powers by their standard errors, which need 8 realizations or more (--realizations), not 1' \
    --sampler white --fit auto
refuses '--frequencies does not go with --fit' --frequencies list --sampler white -m 10 --fit auto
refuses '--fit: "much" is not a finite number' --sampler white -m 10 --fit much
refuses '--fit: -1' --sampler white -m 10 --fit -1
finish

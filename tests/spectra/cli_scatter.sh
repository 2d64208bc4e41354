#!/usr/bin/env bash
# cli_scatter.sh PROGRAM: --scatter of power: numbers of known sets, those of --coefficients, pictures, scenes, what is refused.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" power "$1"

near() { # KEY VALUE: of the header in out, to rounding
    awk -v a="$(key "$1")" -v b="$2" 'BEGIN { exit !(a != "" && a - b < 1e-6 && b - a < 1e-6) }' || complain "$1 is $(key "$1"), not $2"
}

# ---- one point: S(k) = exp(-2 pi i k.x), at (1/4, 1/8) a turn of k_1/4 + k_2/8 ----
printf '0.25 0.125\n' >point.txt
for known in '1,0 0 -1' '0,2 0 -1' '2,0 -1 0' '-1,0 0 1' '1,2 -1 0' '3,-2 -1 0' '-3,0 0 -1'; do
    read -r frequency real imaginary <<<"$known"
    runs 0 point.txt -k 3 "--scatter=$frequency"
    [[ $(key scatter_frequency) == "$frequency" ]] || complain "frequency $(key scatter_frequency)"
    near scatter_real "$real"
    near scatter_imaginary "$imaginary"
    [[ -z $(key scatter_error) && $(key scatter_phase_p_value) == 1 ]] || complain "one set: $(grep scatter out)"
done

# ---- the mean of what --coefficients writes; the opposite frequency is the conjugate ----
mean() { # FILE ENTRIES-OF-A-SET ENTRY: both parts, of complex128
    tail -c +129 "$1" | od -An -v -w16 -t f8 | awk -v num="$2" -v at="$3" '
        (NR - 1) % num == at { re += $1; im += $2; n++ } END { printf "%.12g %.12g\n", re / n, im / n }'
}
runs 0 --sampler jittered -n 16 -m 50 -k 4 --scatter 1,-2 --coefficients all.npy
read -r real imaginary < <(mean all.npy 81 $(((1 + 4) * 9 - 2 + 4)))
near scatter_real "$real"
near scatter_imaginary "$imaginary"
runs 0 --sampler jittered -n 16 -m 50 -k 4 --scatter=-1,2
near scatter_real "$real"
near scatter_imaginary "$(awk -v a="$imaginary" 'BEGIN { print -a }')"

# ---- white noise is homogeneous: mean 0, uniform phases; a lattice that stays where it is has one phase ----
runs 0 --sampler white -d 1 -n 16 -m 1024 -k 12 --scatter 3
awk -v re="$(key scatter_real)" -v im="$(key scatter_imaginary)" -v e="$(key scatter_error)" -v p="$(key scatter_phase_p_value)" '
    BEGIN { exit !(re ^ 2 + im ^ 2 < 16 * e ^ 2 && e > 0.08 && e < 0.095 && p > 0.001) }' || complain "white: $(grep scatter out)"
runs 0 --sampler regular -n 16 -m 20 -k 4 --scatter 4,0
[[ $(key scatter_phase_p_value) == *e-* ]] || complain "a lattice: $(grep scatter out)"
runs 0 --sampler regular -n 16 -m 20 -k 4 --scatter 4,0 --homogenize
[[ $(key scatter_phase_p_value) == 0.* ]] || complain "a shifted lattice: $(grep scatter out)"
runs 0 --sampler white --sampler jittered -n 16 -m 9 -k 4 --scatter 1,1
[[ $(key scatter_real | wc -l) == 2 ]] || complain "two samplers: $(grep scatter out)"
runs 0 --sampler jittered -n 16 -m 9 -k 4
sed '/^#/d' out >without
runs 0 --sampler jittered -n 16 -m 9 -k 4 --engine torus_direct --scatter 1,1
diff -q <(cut -d, -f1-4 without) <(sed '/^#/d' out | cut -d, -f1-4) >/dev/null || complain "other rows"

# ---- what is refused ----
refuses 'the frequency of the scatter has 1 number, and points have 2' --sampler white -n 16 -m 3 --scatter 3
refuses 'has the number 9, and the largest frequency (-k) is 8' --sampler white -n 16 -m 3 -k 8 --scatter 3,9
refuses '--scatter: 0.5 is not a whole number' --sampler white -n 16 --scatter 0.5,1
refuses '--scatter: S(0) is the sum of weights' --sampler white -n 16 --scatter 0,0
refuses '--scatter: a frequency has 6 numbers at most' --sampler white -n 16 --scatter 1,2,3,4,5,6,7
refuses '--scatter' --sampler white -n 16 --scatter 1,
refuses '--scatter does not go with --plot-log: coefficients have both signs' --sampler white -n 16 --scatter 1,1 --plot a.svg --plot-log xy
refuses 'does not go with several samplers or sets: a picture shows the sets of one' --sampler white --sampler jittered -n 16 --scatter 1,1 --plot a.svg
refuses 'does not go with --per-ring' --sampler white -n 16 --scatter 1,1 --per-ring 8
refuses '--scatter does not go with --frequencies: a list has no row' --sampler white -n 16 --scatter 1,1 --frequencies list
refuses '--scatter does not go with --plot-range: its panels' --sampler white -n 16 --scatter 1,1 --plot a.svg --plot-range 0..1
refuses '--scatter does not go with --plot-points: its picture' --sampler white -n 16 --scatter 1,1 --plot a.svg --plot-points yes
refuses 'does not go with --standard-error' --sampler white -n 16 --scatter 1,1 --standard-error 0.1

# ---- pictures, of commands and of scenes, whose answers come from the cache with the same numbers ----
cat >scene.yaml <<'SCENE'
scene: 1
results:
  - {result: power, name: sets, sampler: [white, jittered], dimension: 1, points: 16, realizations: 40, max-frequency: 12, scatter: 3}
SCENE
command=run
for folder in first second; do
    runs 0 scene.yaml -o $folder
    [[ $(grep -c '^# scatter_frequency: 3$\|^# scatter_frequency: 3,3$' $folder/sets.csv) -ge 1 ]] || complain "header: $(grep scatter $folder/sets.csv)"
done
cmp -s first/sets.csv second/sets.csv || complain "the cache has other rows"
if command -v gnuplot >/dev/null; then
    for file in sets.svg sets-scatter-1.svg sets-scatter-2.svg; do
        [[ -s first/$file ]] || complain "no $file: $(ls first)"
        cmp -s "first/$file" "second/$file" || complain "another $file"
    done
    grep -q 'S(3) of 40 sets' first/sets-scatter-1.svg || complain "no panel of all sets"
    command=power
    runs 0 --sampler white -n 64 -m 2 -k 6 --scatter=-2,5 --plot two.svg
    grep -q 'S(-2, 5) of 2 sets' two.svg || complain "a picture of two sets"
    command=run
fi
sed -i 's/scatter: 3/scatter: 3, arrays: coefficients/' scene.yaml
refuses 'an answer has one array' scene.yaml -o third
finish

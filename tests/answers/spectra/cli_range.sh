#!/usr/bin/env bash
# cli_range.sh PROGRAM: --range and merge: three ranges of a job, out of order, are the job; overlaps, gaps and ranges that
# there are not are refused, and powers that need another plan have exit status 3.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" merge "$1"

part() { # NAME RANGE ARGS...: the range as NAME.npz
    local name=$1 range=$2
    shift 2
    "$program" "$@" --range "$range" -o "$name.npz" 2>err || complain "$*: $(<err)"
}
lines() { # of a table but for those that say how it was made
    grep -v -e '^# command: ' -e '^# merged: ' "$1"
}
is_whole() { # ARGS...: of 300 realizations
    part a 0:128 "$@"
    part b 128:256 "$@"
    part c 256:300 "$@"
    runs 0 c.npz a.npz b.npz
    "$program" "$@" >whole.csv
    cmp <(lines out) <(lines whole.csv) || complain "$*: $(diff <(lines out) <(lines whole.csv))"
    [[ $(grep -c '^# merged: ' out) == 3 && $(key realizations) == 300 && $(key range) == '' ]] || complain "$(<out)"
    runs 0 c.npz b.npz -o late.npz
    says 'these are the realizations 128:300 of 300'
    runs 0 late.npz a.npz
    cmp <(lines out) <(lines whole.csv) || complain "$*: merged twice: $(diff <(lines out) <(lines whole.csv))"
}
awk 'BEGIN { srand(5); for (s = 0; s < 300; s++) { if (s) print "#"
    for (i = 0; i < 5 + s % 3; i++) printf "%.9f %.9f %.9f\n", rand(), rand(), 0.5 + rand() } }' >sets.txt
is_whole power --engine host_direct -m 300 --sampler jittered -n 9 -k 3
is_whole power --engine host_direct --columns xyw -k 2 --normalize integral sets.txt
is_whole angular --engine host_direct -m 300 --sampler white-sphere -n 4 -l 3
is_whole pairs --engine host_direct --columns xyw --lift sphere -l 3 sets.txt
if "$program" devices >out 2>err && grep -q '^[0-9]' out; then
    is_whole power -m 300 --sampler white -n 64 -k 8 --precision single
    is_whole power -m 300 --sampler white -n 64 -k 8 --precision double
    is_whole angular -m 300 --sampler white-sphere -n 64 -l 8
    is_whole pairs -m 300 --sampler white-sphere -n 64 -l 8
fi

# What a part says; a table of it is printed, too.
job=(power --engine host_direct -m 300 --sampler white -n 4 -k 1)
"$program" "${job[@]}" --range 128:256 >out
[[ $(key range) == '128:256 of 300' && $(key realizations) == 128 ]] || complain "header of a range: $(<out)"

# Overlaps, gaps, other jobs.
part a 0:128 "${job[@]}"
part b 0:256 "${job[@]}"
part c 256:300 "${job[@]}"
part seed 128:256 "${job[@]}" --seed 2
part points 128:256 "${job[@]}" -n 5
"$program" "${job[@]}" -o whole.npz
refuses '"b.npz" has the realizations 0:256, but those up to 128 are of "a.npz" already: they overlap' a.npz b.npz
refuses '"c.npz" has the realizations 256:300, but those up to 300 are of "c.npz" already: they overlap' c.npz b.npz c.npz
refuses 'the realizations 128:256 are missing, between those of "a.npz" and of "c.npz"' c.npz a.npz
refuses '"seed.npz" is a range of another job: its seed is 2 instead of 1' a.npz seed.npz
refuses '"points.npz" is a range of another job: its command is' a.npz points.npz
refuses 'is merged with the other ranges of that job alone' a.npz whole.npz

# Ranges that there are not, and what has none.
command=power
job=("${job[@]:1}")
refuses 'goes beyond the realizations, of which there are 300 (--realizations)' "${job[@]}" --range 256:384
refuses 'goes beyond the realizations, of which there are 300 (--realizations)' "${job[@]}" --range 384:512
refuses 'must end at a multiple of 128 or with the last realization, 300' "${job[@]}" --range 0:200
refuses '--range 5:128 must begin with a multiple of 128' "${job[@]}" --range 5:128
refuses '--range: 128:128 has no realization' "${job[@]}" --range 128:128
refuses '"128" is not A:B' "${job[@]}" --range 128
refuses '"x" is not a whole number' "${job[@]}" --range x:128
refuses '--range does not go with --standard-error' "${job[@]}" --range 0:128 --standard-error 0.1
refuses '--range does not go with --coefficients' "${job[@]}" --range 0:128 --coefficients c.npy
refuses '--range does not go with --scatter' "${job[@]}" --range 0:128 --scatter 1,1
refuses '--range does not go with --set' --engine host_direct -k 1 --set a=sets.txt --range 0:128
refuses 'one stands for all (--no-skip computes them)' --engine host_direct -m 300 --sampler sobol -n 4 -k 1 --range 0:128
files=(--engine host_direct --columns xyw -k 1 sets.txt)
refuses 'goes beyond the realizations, of which there are 300' "${files[@]}" --range 256:384
refuses 'goes beyond the realizations, of which there are 300' "${files[@]}" --range 384:512
refuses 'must end at a multiple of 128 or with the last realization, 300' "${files[@]}" --range 256:299
command=check
refuses '--range is not an option of this command' --against whole.npz --sampler white -n 4 --range 0:128

# Errors count in the whole job, also in what comes after a range that is passed over.
awk '/^#/ { s++ } s == 200 && !/^#/ { $3 = 0 } { print }' sets.txt >zero.txt
command=power
refuses 'set 201: all weights are 0' --engine host_direct --columns xyw -k 1 --range 128:256 zero.txt

# Points so close together that powers need another plan, in some sets of the second range alone.
if "$program" devices >out 2>err && grep -q '^[0-9]' out; then
    awk 'BEGIN { for (s = 0; s < 130; s++) { if (s) print "#"
        for (i = 0; i < 300; i++) print s < 129 ? (i * 0.618034 + s / 999) % 1 " " (i + 0.5) / 300 : \
            0.5 + 1e-4 * (i % 17) " " 0.5 + 1e-4 * (i % 19) } }' >corner.txt
    job=(power -k 8 corner.txt)
    part a 0:128 "${job[@]}"
    [[ ! -s err ]] || complain "a range within the tolerance: $(<err)"
    part b 128:130 "${job[@]}"
    says 'merge will refuse this range'
    command=merge
    runs 3 b.npz a.npz
    says 'run the ranges again with a smaller --tol, or with --precision double'
    [[ ! -s out ]] || complain "$(<out)"
fi
finish

#!/usr/bin/env bash
# cli_row_ranges.sh PROGRAM: --range and merge of kinds whose jobs add up rows of realizations: any ranges of a job are the
# job, to the bit, with arrays, also by ranks' and devices' teams and from checkpoints; what is no part of it is refused.
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
is_whole() { # M ARGS...: of so many realizations
    local last=$1
    shift
    part a 0:3 "$@"
    part b 3:5 "$@"
    part c "5:$last" "$@"
    runs 0 c.npz a.npz b.npz
    "$program" "$@" >whole.csv
    cmp <(lines out) <(lines whole.csv) || complain "$*: $(diff <(lines out) <(lines whole.csv))"
    [[ $(grep -c '^# merged: ' out) == 3 && $(key range) == '' ]] || complain "$(<out)"
    runs 0 c.npz b.npz -o late.npz
    says "these are the realizations 3:$last of $last"
    runs 0 late.npz a.npz
    cmp <(lines out) <(lines whole.csv) || complain "$*: merged twice: $(diff <(lines out) <(lines whole.csv))"
}
printf '2,0,1,0\n' >light.txt
printf 'v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 5 4\n' >corner.obj
awk 'BEGIN { srand(5); for (s = 0; s < 41; s++) { if (s) print "#"
    for (i = 0; i < 5 + s % 3; i++) printf "%.9f %.9f %.9f\n", rand(), rand(), 0.5 + rand() } }' >sets.txt
light=coefficients:file=light.txt
is_whole 20 variance --engine host_direct --integrand disk --integrand gaussian --sampler jittered --sampler white -n 4,9 -m 20 -k 3
is_whole 20 variance --engine host_direct --integrand disk --sampler white -n 9 -m 20 -k 3 --shifts 0
is_whole 21 variance --engine host_direct --integrand disk --columns xyw -k 3 sets.txt
is_whole 20 variance --engine host_direct --integrand cap --sampler white-sphere -n 9 -m 20 -l 4
is_whole 41 quadrature --engine host_direct --sampler white-hemisphere -n 9,16 -m 41 --brdf diffuse -l 5
is_whole 9 quadrature --engine host_direct --sampler white-hemisphere -n 16 -m 9 --brdf glossy:n=5 -l 5 --weights optimal
is_whole 41 quadrature --engine host_direct --columns xyw --lift hemisphere --brdf diffuse -l 5 sets.txt
is_whole 20 shade --engine host_direct --sampler white-hemisphere -n 9 -m 20 --brdf diffuse --integrand "$light"
is_whole 7 interpolation --sampler white-sphere -n 16 -m 7 --integrand "$light" --smoothness 1.1,1.5
is_whole 41 interpolation --lift sphere --columns xyw --integrand "$light" sets.txt
is_whole 7 occlusion --mesh corner.obj --image 8x7 --reference 64 --sampler white-sphere -n 4,9 -m 7
is_whole 41 occlusion --mesh corner.obj --image 7x7 --reference 64 --lift sphere --columns xyw sets.txt
has_device=no
if "$program" devices >out 2>err && grep -q '^[0-9]' out; then
    has_device=yes
    is_whole 20 variance --integrand disk --sampler jittered -n 64 -m 20 -k 8
    is_whole 20 quadrature --sampler white-hemisphere -n 64 -m 20 --brdf glossy:n=30 -l 20
    is_whole 20 measure --sampler jittered --sampler white -n 16 -m 20 -k 8
    is_whole 41 measure --wrap --columns xyw sets.txt -k 4
fi

# Arrays, of the first realization, too.
for job in 'occlusion --mesh corner.obj --image 8x8 --reference 64 --sampler white-sphere -n 9 -m 7' \
    "interpolation --sampler white-sphere -n 16 -m 7 --integrand $light"; do
    read -ra words <<<"$job"
    part a 0:2 "${words[@]}"
    part b 2:7 "${words[@]}"
    runs 0 b.npz a.npz -o merged.npz
    "$program" "${words[@]}" -o whole.npz
    checked=$((checked + 1))
    for name in $(unzip -Z1 whole.npz | grep -v -e '^meta' -e '^fields' -e '^file_digest'); do
        cmp <(unzip -p whole.npz "$name") <(unzip -p merged.npz "$name") || complain "$job: $name is another"
    done
done

# A range of two devices; one that was killed.
job=(quadrature --sampler white-hemisphere -n 64 -m 900 --brdf diffuse -l 12)
if [[ $has_device == yes ]]; then
    part a 0:500 "${job[@]}" --device cpu:split=2
    part b 500:900 "${job[@]}"
    runs 0 a.npz b.npz
    "$program" "${job[@]}" >whole.csv
    cmp <(lines out) <(lines whole.csv) || complain "a range of two devices: $(diff <(lines out) <(lines whole.csv))"
fi
job=(quadrature --engine host_direct --sampler white-hemisphere -n 64 -m 900 --brdf diffuse -l 12)
kept=("${job[@]}" --range 100:900 --checkpoint kept.npz --checkpoint-interval 0 -o b.npz)
"$program" "${kept[@]}" >/dev/null 2>&1 &
wait_until $! test -e kept.npz
kill -9 $! 2>/dev/null || true
wait $! 2>/dev/null || true
"$program" "${kept[@]}" 2>err || complain "a range that goes on: $(<err)"
part a 0:100 "${job[@]}"
runs 0 a.npz b.npz
"$program" "${job[@]}" >whole.csv
cmp <(lines out) <(lines whole.csv) || complain "a range that was killed: $(diff <(lines out) <(lines whole.csv))"

# One that was killed in its second job, when the rows of the first were complete.
job=(quadrature --engine host_direct --sampler white-hemisphere -n '9,64' -m 900 --brdf diffuse -l 12)
kept=("${job[@]}" --range 100:900 --checkpoint kept.npz --checkpoint-interval 0 -o b.npz)
"$program" "${kept[@]}" >/dev/null 2>&1 &
wait_until $! test -e kept-2.npz
kill -9 $! 2>/dev/null || true
wait $! 2>/dev/null || true
"$program" "${kept[@]}" 2>err || complain "a range of two jobs that goes on: $(<err)"
part a 0:100 "${job[@]}"
runs 0 a.npz b.npz
"$program" "${job[@]}" >whole.csv
cmp <(lines out) <(lines whole.csv) || complain "a range of two jobs: $(diff <(lines out) <(lines whole.csv))"

# What a part says is of its own sets: those of other realizations measure nothing.
checked=$((checked + 1))
job=(variance --engine host_direct --integrand disk --sampler white -n 9 -m 20 -k 3)
for range in 0:10 10:20 0:20; do
    "$program" "${job[@]}" --range $range | awk -F, '/^[0-9]/ { print $6 }'
done >measured.txt # the last is the mean of those before
awk 'NR < 3 { sum += $1 } NR == 3 { exit !((sum / 2 / $1 - 1) ^ 2 < 1e-20) }' measured.txt || complain "measured: $(<measured.txt)"
"$program" variance --engine host_direct --integrand disk --columns xyw -k 3 --range 20:21 sets.txt >out
[[ $(awk -F, '/^[0-9]/ { print $6 "," $7 }' out) == , ]] || complain "measured of no set: $(<out)"

# Points so close together that powers need another plan, in some sets of the second range alone.
if [[ $has_device == yes ]]; then
    awk 'BEGIN { for (s = 0; s < 260; s++) { if (s) print "#"
        for (i = 0; i < 300; i++) print s != 129 ? (i * 0.618034 + s / 999) % 1 " " (i + 0.5) / 300 : \
            0.5 + 1e-4 * (i % 17) " " 0.5 + 1e-4 * (i % 19) } }' >corner.txt
    job=(variance --integrand disk -k 8 corner.txt)
    part a 0:100 "${job[@]}"
    part b 100:130 "${job[@]}"
    runs 3 b.npz a.npz
    says 'run the ranges again with a smaller --tol, or with --precision double'
    [[ ! -s out ]] || complain "$(<out)"
fi

# Overlaps, gaps, other jobs, and what it needs.
job=(variance --engine host_direct --integrand "map:file=disk.pfm" --sampler white -n 4 -m 300 -k 3)
printf 'Pf\n2 2\n-1.0\n\0\0\200\77\0\0\0\0\0\0\0\0\0\0\200\77' >disk.pfm
part a 0:100 "${job[@]}"
part b 0:256 "${job[@]}"
part c 256:300 "${job[@]}"
part seed 100:256 "${job[@]}" --seed 2
"$program" "${job[@]}" -o whole.npz
refuses '"b.npz" has the realizations 0:256, but those up to 100 are of "a.npz" already: they overlap' a.npz b.npz
refuses 'the realizations 100:256 are missing, between those of "a.npz" and of "c.npz"' c.npz a.npz
refuses '"seed.npz" is a range of another job: its seed is 2 instead of 1' a.npz seed.npz
refuses '"whole.npz" is no answer to a range, or is damaged' a.npz whole.npz
refuses '"whole.npz" is no answer to a range, or is damaged' whole.npz
sed 's/\(Pf\)/\1/; $ s/.$/@/' disk.pfm >other.pfm
mv disk.pfm elsewhere.pfm
mv other.pfm disk.pfm
refuses '"b.npz" is of another content of --integrand disk.pfm' b.npz c.npz
part other 256:300 "${job[@]}"
refuses '"b.npz" is of another content of --integrand disk.pfm' b.npz other.npz
rm disk.pfm
runs 1 b.npz c.npz
says 'disk.pfm'
"$program" sample --sampler white -n 4 -o points.txt
"$program" check --homogeneous --engine host_direct --sampler white -n 4 -m 40 -k 1 -o check.npz
refuses '"check.npz" is an answer of check, and these are not merged' check.npz

# Ranges that there are not, and what has none.
command=variance
job=(--engine host_direct --integrand disk -k 3)
refuses '--range 5:21 goes beyond the realizations, of which there are 20 (--realizations)' "${job[@]}" --sampler white -n 4 -m 20 --range 5:21
refuses '--range 20:22 goes beyond the realizations, of which there are 21' "${job[@]}" --columns xyw --range 20:22 sets.txt
refuses 'one stands for all (--no-skip computes them)' "${job[@]}" --sampler sobol -n 4 -m 20 --range 0:2
refuses 'in one dimension there are none' "${job[@]}" -d 1 --sampler white -n 4 -m 20 --range 0:2
refuses 'is of files and samplers, which merge can read again' "${job[@]}" --columns xyw --range 0:5 -
command=quadrature
job=(--engine host_direct --brdf diffuse -l 5)
refuses '--range 41:43 goes beyond the realizations, of which there are 41' "${job[@]}" --lift hemisphere --columns xyw --range 41:43 sets.txt
refuses 'one stands for all (--no-skip computes them)' "${job[@]}" --sampler fibonacci-hemisphere -n 4 -m 20 --range 0:2
refuses '--range 0:1 has no use: there is one realization' "${job[@]}" --sampler white-hemisphere -n 4 --range 0:1
refuses '--range does not go with --standard-error' "${job[@]}" --sampler white-hemisphere -n 4 --range 0:2 --standard-error 0.1
refuses '--range does not go with --weights-out' "${job[@]}" --sampler white-hemisphere -n 4 --range 0:2 --weights-out w.txt
command=interpolation
refuses 'one stands for all (--no-skip computes them)' --integrand "$light" --sampler fibonacci -n 4 -m 20 --range 0:2
finish

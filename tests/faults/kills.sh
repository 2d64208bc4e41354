#!/usr/bin/env bash
# kills.sh PROGRAM: jobs with checkpoints are killed before file calls of theirs, which are writes, flushes and renames of checkpoints,
# and called again until they are done: what they write is what a job wrote that nobody killed. PROGRAM is pointspec_faults.
# Jobs of parts, too, which one process does as well as ranks where it finds the checkpoint, or its lock, of one.
set -euo pipefail
program=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
export POINTSPEC_CACHE_DIR=$scratch/no-cache ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=0
unset POINTSPEC_FAULT POINTSPEC_FAULT_REPORT
most=3 # kills of a command line, evenly over its calls

for i in 1 2 3; do
    "$program" sample --sampler jittered -n 16 --seed $i -o "$i.dat"
done

printf 'v -1 -1 -2\nv 1 -1 -2\nv 1 1 -2\nv -1 1 -2\nf 1 2 3 4\n' >quad.obj

kill_at() { # NUMBER WORD...
    local number=$1
    shift
    # The shell would say which of its children was killed.
    { POINTSPEC_FAULT=file:$number! "$program" "$@" -o out.csv --checkpoint job.npz --checkpoint-interval 0; } >/dev/null 2>&1
}

begin() { # the checkpoints of no job, or locks of one that has so many parts
    rm -f out.csv job*.npz*
    [[ $parts == 1 ]] || : >"job-part-1-of-$parts.npz.lock"
}

try() { # WORD...
    local calls number step code killed=0
    "$program" "$@" -o whole.csv
    begin
    POINTSPEC_FAULT_REPORT=report "$program" "$@" -o out.csv --checkpoint job.npz --checkpoint-interval 0
    calls=$(awk '/^calls file/ { print $3 }' report)
    step=$((calls > most ? calls / most : 1))
    for ((number = 1 + RANDOM % step; number <= calls; number += step)); do
        begin
        code=0
        kill_at "$number" "$@" || code=$?
        [[ $code == 137 ]] && killed=$((killed + 1))
        [[ $code == 137 || $code == 0 ]] || { echo "kills: exit code $code at call $number of: $*" >&2; exit 1; }
        # once more in the middle of what is left, then to the end
        kill_at 40 "$@" || true
        "$program" "$@" -o out.csv --checkpoint job.npz --checkpoint-interval 0
        diff <(grep -v '^# command' whole.csv) <(grep -v '^# command' out.csv) ||
            { echo "kills: other bits after a kill at call $number of: $*" >&2; exit 1; }
        [[ -z $(ls job*.npz* 2>/dev/null) ]] || { echo "kills: the checkpoint stays behind: $*" >&2; exit 1; }
    done
    ((killed > most / 2)) || { echo "kills: only $killed kills of: $*" >&2; exit 1; }
    echo "kills: $killed of $calls calls, $parts part(s), same bits: $*"
}

RANDOM=1
parts=1
try power --engine host_direct --sampler white -n 8 -k 3 -m 140
try power --engine torus_direct --sampler jittered -n 16 -k 4 -m 400
try power --engine host_direct 1.dat 2.dat 3.dat -k 4
try pairs --engine host_direct --sampler white-sphere -n 6 -l 3 -m 132
try quadrature --engine host_direct --sampler white-hemisphere -n 4 -l 4 -m 24 --brdf diffuse
try variance --engine host_direct --sampler white -n 4 -k 3 -m 12 --integrand disk
try measure --sampler jittered -n 16 -m 9 -k 3
try occlusion --mesh quad.obj --image 8x8 --reference 16 --sampler white-sphere -n 4,8 -m 9
try interpolation --integrand map:width=16 --sampler white-sphere -n 8 -m 12
try shade --integrand map:width=16 --brdf diffuse --engine host_direct --sampler white-hemisphere -n 4 -l 4 -m 12
try power --engine host_direct --sampler white --sampler jittered -n 4,9 -k 3 -m 12

# Clusters, whose powers are near N: all parts are planned once more.
awk 'BEGIN { for (r = 0; r < 260; r++) { if (r) print "#"
    for (j = 0; j < 300; j++) print 0.5 + 1e-4 * (j % 17) + 1e-6 * r, 0.5 + 1e-4 * (j % 19) } }' >clusters.txt
parts=3
try power --engine torus_direct --sampler white --sampler jittered -n 16 -k 4 -m 400
try power clusters.txt -k 8
try angular clusters.txt -l 8 --lift sphere

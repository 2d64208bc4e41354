#!/usr/bin/env bash
# soak.sh PROGRAM [SECONDS [SEED]]: jobs of every kind are killed after random times of up to three seconds, by SIGKILL, SIGTERM or
# SIGINT, and called again until they are done, for so long (default 1800); then what they wrote must be what a job wrote
# that nobody killed. Kinds without checkpoints begin anew each time. Ranges are killed likewise, and merged.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
program=$scratch/pointspec # a copy: checkpoints of one that is built meanwhile would be those of another
cp "$1" "$program"
seconds=${2:-1800} seed=${3:-$RANDOM}
cd "$scratch"
export POINTSPEC_CACHE_DIR=$scratch/no-cache
RANDOM=$seed
echo "soak: $seconds s, seed $seed (again: ./dev soak $seconds $seed)"

for i in 1 2 3 4 5 6; do
    "$program" sample --sampler jittered -n 65536 --seed $i -o $i.npy
done
printf 'v -1 -1 -2\nv 1 -1 -2\nv 1 1 -2\nv -1 1 -2\nf 1 2 3 4\n' >quad.obj
"$program" power --sampler jittered -n 256 -m 64 -k 16 -o saved.npz
cat >scene.yaml <<'END'
scene: 1
title: killed
results:
  - result: power
    name: torus
    samplers: [jittered, white]
    points: 4096
    realizations: 20000
    max-frequency: 64
  - result: angular
    name: sphere
    samplers: [white-sphere]
    points: 1024
    realizations: 20000
    max-degree: 64
  - result: variance
    name: disk
    integrands: [disk]
    samplers: [jittered, white]
    points: [64, 256]
    realizations: 20000
    rates: auto
  - result: check
    name: phases
    homogeneous: true
    samplers: [white]
    points: 16
    realizations: 1000
    max-frequency: 3
END

# Those that have checkpoints take some times three seconds, the others less than one.
saved=(
    "power --sampler jittered -n 4096 -m 60000 -k 64"
    "power --sampler white -n 1024 -m 40000 -k 32 --precision double"
    "power --sampler latin-hypercube -d 3 -n 512 -m 20000 -k 12"
    "power --sampler white -d 1 -n 256 -m 100000 -k 1024"
    "power --sampler sobol:scramble=owen --sampler jittered -n 256,1024 -m 30000 -k 32"
    "power 1.npy 2.npy 3.npy 4.npy 5.npy 6.npy -k 256 --precision double --engine torus_direct"
    "power --sampler jittered -n 256 -m 1e6 --standard-error 0.002 -k 64"
    "angular --sampler white-sphere -n 1024 -m 60000 -l 64"
    "pairs --sampler healpix-jittered -n 768 -m 60000 -l 64"
    "quadrature --brdf glossy:n=30 --sampler white-hemisphere -n 512 -m 20000"
    "quadrature --brdf diffuse --weights optimal --sampler white-hemisphere -n 256 -m 1500"
    "variance --sampler jittered -n 64,256 -m 100000 --integrand disk --shifts 40"
    "check --against saved.npz --sampler jittered -n 256 -m 300000 --seed 3"
    "shade --sampler white-hemisphere --brdf glossy:n=30 --integrand map:width=128 -n 64 -m 200 --shifts 300"
    "interpolation --sampler white-sphere --integrand map:width=128 -n 100,200 -m 800"
    "measure --sampler jittered -n 1024 -m 3000 -k 64"
    "occlusion --mesh quad.obj --sampler white-sphere -n 16,64 -m 1000 --image 128x128 --reference 4096"
)
# Two devices share a job, where one can be split.
if "$program" power --engine torus_direct --sampler white -n 4 -k 1 --device cpu:split=2/1 >/dev/null 2>&1; then
    saved+=(
        "power --sampler jittered -n 4096 -m 60000 -k 64 --device cpu:split=2"
        "quadrature --brdf glossy:n=30 --sampler white-hemisphere -n 512 -m 20000 --device cpu:split=2"
        "variance --sampler jittered -n 64,256 -m 100000 --integrand disk --shifts 40 --device cpu:split=2"
        "interpolation --sampler white-sphere --integrand map:width=128 -n 100,200 -m 800 --device cpu:split=2"
    )
fi
begun_anew=(
    "truncation --brdf glossy:n=30 -l 20"
    "light --integrand map:width=128 -l 20"
)
kills=0 jobs=0

# Runs to its end, or is killed after a random time; 0: done.
run_for_a_while() { # WORD...
    local signals=(KILL KILL TERM INT) code=0
    # The shell would say which of its children was killed. In the foreground timeout waits until the program is dead, after
    # SIGKILL, too: before that it has its lock.
    { timeout --foreground -k 10 -s "${signals[RANDOM % 4]}" "$((RANDOM % 3)).$((1 + RANDOM % 9))" "$program" "$@" --quiet \
        >/dev/null 2>stderr || code=$?; } 2>/dev/null
    case $code in
    0) return 0 ;;
    124 | 130 | 137 | 143) kills=$((kills + 1)) && return 1 ;;
    *) echo "soak: exit code $code: $*: $(<stderr)" >&2 && exit 1 ;;
    esac
}

run_to_the_end() { # WORD...
    until run_for_a_while "$@"; do :; done
}

compare() { # WHAT: out.csv with the reference
    diff <(grep -v '^# command' "$1") <(grep -v '^# command' out.csv) >&2 || { echo "soak: other bits: $2" >&2; exit 1; }
    [[ -z $(find . -name 'job*' -o -name '.pointspec-*.tmp') ]] || { echo "soak: left behind: $(ls -A)" >&2; exit 1; }
    jobs=$((jobs + 1))
}

reference() { # NAME WORD...: its file, made once
    local name=$1
    shift
    [[ -e $name.csv ]] || "$program" "$@" -o "$name.csv" --quiet
}

try_ranges() { # REALIZATIONS WORD...
    local realizations=$1 parts=() first=0 end
    shift
    reference "ranges-$1" "$@" -m "$realizations"
    while ((first < realizations)); do
        end=$((first + 128 * (1 + RANDOM % 60)))
        end=$((end < realizations ? end : realizations))
        run_to_the_end "$@" -m "$realizations" --range $first:$end -o "part$first.npz" --checkpoint job.npz --checkpoint-interval 0
        parts=("part$first.npz" "${parts[@]}")
        first=$end
    done
    "$program" merge "${parts[@]}" -o out.csv
    rm -f part*.npz
    diff <(grep -v '^# ' "ranges-$1.csv") <(grep -v '^# ' out.csv) >&2 || { echo "soak: other bits of ranges: $*" >&2; exit 1; }
    jobs=$((jobs + 1))
}

while ((SECONDS < seconds)); do
    number=$((RANDOM % (${#saved[@]} + ${#begun_anew[@]} + 2)))
    rm -f out.csv
    if ((number < ${#saved[@]})); then
        read -r -a words <<<"${saved[number]}"
        reference "$number" "${words[@]}"
        run_to_the_end "${words[@]}" -o out.csv --checkpoint job.npz --checkpoint-interval $((RANDOM % 2))
        compare "$number.csv" "${words[*]}"
    elif ((number < ${#saved[@]} + ${#begun_anew[@]})); then
        read -r -a words <<<"${begun_anew[number - ${#saved[@]}]}"
        reference "$number" "${words[@]}"
        run_to_the_end "${words[@]}" -o out.csv
        compare "$number.csv" "${words[*]}"
    elif ((number == ${#saved[@]} + ${#begun_anew[@]})); then
        if ((RANDOM % 2)); then
            try_ranges 20000 power --sampler jittered -n 1024 -k 32
        else
            try_ranges 20000 variance --sampler jittered -n 256 --integrand disk --shifts 40
        fi
    else
        [[ -d whole ]] || "$program" run scene.yaml -o whole --quiet --cache 0 >/dev/null
        run_to_the_end run scene.yaml -o killed --cache 0 --checkpoint job.npz --checkpoint-interval 0
        for file in whole/*.csv; do
            diff "$file" "killed/${file##*/}" || { echo "soak: other bits: run scene.yaml" >&2; exit 1; }
        done
        rm -rf killed
        jobs=$((jobs + 1))
    fi
done
echo "soak: $jobs jobs, $kills kills, same bits, $SECONDS s"

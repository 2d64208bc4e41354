#!/usr/bin/env bash
# cli_tolerance.sh PROGRAM: --tol and --floor through the program, by every engine of the torus and of the sphere:
# the header promises what was asked or the program refuses with exit 3; the same bits from one thread and from two.
set -euo pipefail
program=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
unset POINTSPEC_DEVICE

# The leak sanitizer may trip over threads of PoCL when a run is short: once more without it.
tripped='LeakSanitizer has encountered a fatal error'
bad=0
complain() {
    printf 'cli_tolerance: %s\n' "$*" >&2
    bad=1
}
runs() { # EXIT ARGS...: standard output in out, standard error in err
    local expected=$1 code
    shift
    for leaks in 1 0; do
        code=0
        ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=$leaks \
            "$program" "$@" </dev/null >out 2>err || code=$?
        grep -q "$tripped" err || break
    done
    [[ $code == "$expected" ]] || complain "exit $code, not $expected: $*: $(<err)"
}
key() { # NAME: of the header
    sed -n "s/^# $1: //p" out
}

# ---- what is promised, and what was measured by the self-check
promises() { # TOLERANCE ARGS...
    local tolerance=$1
    shift
    runs 0 power -n 200 -m 5 -k 12 --tol "$tolerance" "$@"
    holds "$tolerance" "$@"
}
holds() { # TOLERANCE ARGS...: the header in out
    local tolerance=$1
    shift
    awk -v e="$(key predicted_error)" -v t="$tolerance" 'BEGIN { exit !(e + 0 > 0 && e + 0 <= t + 0) }' ||
        complain "predicted_error $(key predicted_error) at --tol $tolerance: $*"
    awk -v c="$(key self_check)" -v t="$tolerance" 'BEGIN { exit !(c + 0 <= 16 * t) }' ||
        complain "self_check $(key self_check) at --tol $tolerance: $*"
}
for sampler in white jittered; do
    for tolerance in 1e-2 3e-4 1e-5 1e-6; do
        promises "$tolerance" --sampler "$sampler" --engine torus_nufft --precision single
    done
    for tolerance in 1e-2 1e-6 1e-9 1e-12; do
        promises "$tolerance" --sampler "$sampler" --engine torus_nufft --precision double
        promises "$tolerance" --sampler "$sampler"
    done
done
promises 1e-6 --sampler sobol --engine torus_nufft -d 3 -k 4
promises 1e-6 --sampler white --engine torus_nufft -d 1 -k 100
[[ $(key engine) == *torus_nufft* ]] || complain "--engine torus_nufft ran $(key engine)"

# ---- on the sphere, decade by decade: kept, or refused with nothing written
sphere() { # KEPT REFUSED ARGS...: kept down to the tolerance KEPT, refused from REFUSED on, either between
    local kept=$1 refused=$2 tolerance code
    shift 2
    for tolerance in 1e-2 1e-3 1e-4 1e-5 1e-6 1e-7 1e-8 1e-9 1e-10 1e-11 1e-12 1e-13 1e-16; do
        code=$(awk -v t=$tolerance -v k="$kept" -v r="$refused" \
            'BEGIN { print(t + 0 >= k + 0 ? 0 : t + 0 <= r + 0 ? 3 : "either") }')
        if [[ $code == either ]]; then
            code=0
            "$program" angular --tol $tolerance "$@" </dev/null >out 2>err || code=$?
            [[ $code == 0 || $code == 3 ]] || complain "exit $code: --tol $tolerance $*: $(<err)"
        else
            runs "$code" angular --tol $tolerance "$@"
        fi
        if [[ $code == 0 ]]; then
            holds $tolerance "$@"
        else
            [[ ! -s out && $(wc -l <err) == 1 ]] || complain "refused $tolerance $*: $(<err) $(<out)"
        fi
    done
}
for domain in '' --hemisphere; do
    options=(--sampler white-sphere -n 200 -m 3 -l 24 ${domain:+"$domain"})
    sphere 1e-5 1e-8 "${options[@]}" --engine sphere_direct --precision single
    sphere 1e-12 1e-16 "${options[@]}" --engine sphere_direct --precision double
    sphere 1e-5 1e-8 "${options[@]}" --engine sphere_nufft --precision single
    sphere 1e-12 1e-16 "${options[@]}" --engine sphere_nufft --precision double
    sphere 1e-5 1e-8 "${options[@]}" --engine sphere_grid --precision single
    sphere 1e-12 1e-16 "${options[@]}" --engine sphere_grid --precision double
    sphere 1e-12 1e-16 "${options[@]}"
done

# ---- beyond reach: refused, nothing written
for rest in "--tol 1e-9 --precision single" "--tol 1e-17" "--floor 1e-16 --precision single"; do
    read -ra options <<<"$rest"
    runs 3 power --sampler white -n 200 -k 12 --engine torus_nufft "${options[@]}"
    [[ ! -s out && -s err ]] || complain "refused $rest, but: $(<out)"
done
# All points in one place: the error grows with the power, which only the run tells.
for _ in {1..64}; do echo "0.3 0.7"; done >one_place.txt
runs 0 power -k 12 --engine torus_nufft --tol 1e-5 one_place.txt
awk -v e="$(key predicted_error)" 'BEGIN { exit !(e <= 1e-5) }' || complain "one place: $(key predicted_error)"
runs 3 power -k 12 --engine torus_nufft --precision single --tol 1e-6 one_place.txt

for _ in {1..64}; do echo "0.48 -0.6 0.64"; done >one_direction.txt
for engine in sphere_direct sphere_nufft sphere_grid; do
    runs 0 angular -l 12 --engine $engine --tol 1e-5 one_direction.txt
    awk -v e="$(key predicted_error)" 'BEGIN { exit !(e <= 1e-5) }' ||
        complain "one direction, $engine: $(key predicted_error)"
    runs 3 angular -l 12 --engine $engine --precision single --tol 1e-6 one_direction.txt
done

# ---- the same bits, whatever the number of threads; weights and N that varies
threads_agree() { # ARGS...
    local threads
    for threads in 1 2; do
        export POCL_MAX_PTHREAD_COUNT=$threads
        runs 0 "$@"
        mv out "threads$threads"
    done
    unset POCL_MAX_PTHREAD_COUNT
    [[ -s threads1 ]] || complain "nothing from: $*"
    cmp -s threads1 threads2 || complain "one thread and two differ: $*"
}
{
    "$program" sample --sampler white -n 100 -m 3 -d 2
    echo "#"
    "$program" sample --sampler jittered -n 400 -m 2 -d 2
} >sets.txt
for options in "--sampler jittered -n 900 -m 9 -k 40" "--sampler white -n 300 -m 3 -d 1 -k 200" \
    "--sampler white -n 300 -m 3 -d 3 -k 5" "-k 20 sets.txt"; do
    for precision in single double; do
        read -ra words <<<"$options"
        threads_agree power "${words[@]}" --engine torus_nufft --precision "$precision" --tol 1e-5
    done
done

# Many small realizations; one of several chunks, which threads share; weights, and N that varies.
{
    "$program" sample --sampler white-sphere -n 100 -m 3 | awk '{ print $0, 1 + NR % 7 }'
    echo "#"
    "$program" sample --sampler fibonacci -n 1300 | awk '{ print $0, NR % 3 - 0.5 }'
} | sed 's/^# .*/#/' >directions.txt
for options in "--sampler healpix-jittered:nside=4 -m 9 -l 33" \
    "--sampler white-sphere -n 3000 -m 1 -l 70 --no-self-check" \
    "--sampler white-hemisphere -n 300 -m 3 -l 40 --hemisphere" \
    "-l 21 --normalize effective --columns xyzw directions.txt"; do
    read -ra words <<<"$options"
    for engine in sphere_direct sphere_nufft sphere_grid; do
        for precision in single double; do
            threads_agree angular "${words[@]}" --engine $engine --precision $precision --tol 1e-3
        done
    done
done
exit $bad

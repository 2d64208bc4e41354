#!/usr/bin/env bash
# needs_times.sh PROGRAM: times of commands with and without skips, seconds of the processor and of the clock, the best of three;
# and how far answers are apart, in standard errors of their difference, where they have realizations of their own.
set -euo pipefail
(($# == 1)) || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
program=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

rules="--sampler fibonacci-hemisphere --sampler hammersley:lift=hemisphere --sampler jittered:lift=hemisphere --sampler white-hemisphere -n 1024 -m 1000"
cases=(
    "quadrature --brdf diffuse $rules --standard-error 0.1"
    "quadrature --brdf glossy:n=30 $rules --standard-error 0.1"
    "quadrature --brdf diffuse $rules"
    "quadrature --brdf diffuse --sampler white-hemisphere -n 1024 -m 1000 --tol 1e-2"
    "power --sampler jittered --sampler white -n 4096 -k 128 -m 10000 --standard-error 0.01 --floor 0.01"
    "power --sampler white -n 4096 -k 128 -m 2000 --tol 1e-4"
)

# Seconds of the processor and of the clock of one run, into the file of its name.
measure() { # NAME WORD...
    local name=$1 TIMEFORMAT='%U %S %R'
    shift
    { time "$program" "$@" -o "$name.csv" 2>/dev/null; } 2>"$name.time"
    awk '{ printf "%.2f %.2f\n", $1 + $2, $3 }' "$name.time" >>"$name.times"
}

# The largest |x - y| / hypot(errors): of powers or of E. Means of the same realizations differ by less than their errors.
distance() {
    awk -F, '
        FNR == 1 { file++ }
        /^# worst_case_error: / { sub(/.*: /, ""); value[file, ++n[file]] = $0; next }
        /^# worst_case_error_standard_error: / { sub(/.*: ?/, ""); error[file, n[file]] = $0; next }
        /^#/ { next }
        !is_power[file] && /power/ { for (i = 1; i <= NF; i++) { if ($i == "power") p = i; if ($i == "standard_error") e = i }
            is_power[file] = 1; next }
        is_power[file] { value[file, ++n[file]] = $p; error[file, n[file]] = $e }
        END {
            for (i = 1; i <= n[1]; i++) {
                d = value[1, i] - value[2, i]; s = sqrt(error[1, i] ^ 2 + error[2, i] ^ 2)
                d = d < 0 ? -d : d
                if (s > 0 && d / s > worst) worst = d / s
            }
            printf "%.2g", worst
        }' skip.csv full.csv
}

for case in "${cases[@]}"; do
    read -r -a words <<<"$case"
    rm -f ./*.times
    "$program" "${words[@]}" --no-skip -m 2 -o warm.csv 2>/dev/null # kernels into the cache
    "$program" "${words[@]}" -m 2 -o warm.csv 2>/dev/null
    for _ in 1 2 3; do
        measure skip "${words[@]}"
        measure full "${words[@]}" --no-skip
    done
    printf 'pointspec %s\n' "$case"
    paste -d ' ' <(sort -n skip.times | head -n 1) <(sort -n full.times | head -n 1) |
        awk -v far="$(distance)" '{ printf "    cpu %.2f s, without skips %.2f: %.1f times; clock %.2f s, %.2f: %.1f times; apart %s standard errors\n",
            $1, $3, $3 / $1, $2, $4, $4 / $2, far }'
done

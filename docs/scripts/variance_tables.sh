#!/usr/bin/env bash
# variance_tables.sh PROGRAM laws|scores|crossovers: the tables of docs/user/variance.md. laws: variances predicted and measured beside
# their laws for large N (twenty seconds of two cores). scores: z-scores of many cases, each of which has a seed of its own (some
# minutes). crossovers: of the scene p15/figure6.yaml (two minutes, for nothing is kept).
set -euo pipefail
(($# == 2)) || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
program=$(realpath "$1")
folder=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export POINTSPEC_CACHE_DIR=$scratch/cache

# ---- laws ----

law() { # LAW FACTOR EXPONENT N SAMPLER INTEGRAND: the law is FACTOR N^-EXPONENT; N a list
    "$program" variance --quiet --sampler "$5" --integrand "$6" -n "$4" -m 400 --seed 5 |
        awk -F, -v law="$1" -v factor="$2" -v exponent="$3" -v name="$5, $6" '
            function power_of(number) { number = sprintf("%.8e", number); sub(/.*e/, "", number); return number + 0 }
            # Two digits of the standard error in brackets: 3.730(29)e-6.
            function digits(value, error,  e, d) {
                e = power_of(value)
                d = e - power_of(error) + 1
                return sprintf("%.*f(%.0f)e%d", d, value / 10 ^ e, error / 10 ^ (e - d), e)
            }
            /^#/ { next }
            !is_named { for (i = 1; i <= NF; i++) at[$i] = i; is_named = 1; next }
            {
                n = $at["points"]
                printf "%-40s %-13s %5d %10.3e  %-15s %s\n", name, law, n, factor * n ^ -exponent,
                    digits($at["predicted"], $at["predicted_error"]), digits($at["measured"], $at["measured_error"])
                name = law = ""
            }'
}

laws() {
    local pi=3.14159265358979 # of awk, which has no other
    evaluate() { awk -v pi="$pi" "BEGIN { printf \"%.17g\", $1 }"; }
    printf '%-40s %-13s %5s %10s  %-15s %s\n' "sampler, integrand" law N "its value" predicted measured
    law "pi/(12 N^2)" "$(evaluate pi/12)" 2 256,1024,4096 jittered gaussian:sigma=0.0625
    law "1.043 R/N^1.5" "$(evaluate 1.043/4)" 1.5 256,1024,4096 jittered disk:radius=0.25
    law "281.1/N^2" 281.134 2 192,768,3072 healpix-jittered harmonic:degree=4
    law "E/N" "$(evaluate 'pi/16 - (pi/16)^2')" 1 256,1024 white disk:radius=0.25
    law "3 pi^2/N" "$(evaluate '3*pi^2')" 1 192 white-sphere cap
}

# ---- z-scores ----

seed=0
score() { # COLUMN SAMPLER N INTEGRAND OPTION...
    local column=$1 sampler=$2 points=$3 integrand=$4
    shift 4
    seed=$((seed + 1))
    "$program" variance --quiet --sampler "$sampler" --integrand "$integrand" -n "$points" --seed "$seed" "$@" |
        awk -F, -v key="$sampler $column" '
            /^#/ { next }
            !at { for (i = 1; i <= NF; i++) if ($i == "z_score") at = i; next }
            { print key, $at }' >>"$scratch/scores"
}

cases() { # COLUMN OPTION...
    local column=$1 sampler integrand points
    shift
    for sampler in white jittered latin-hypercube poisson-disk sobol:scramble=owen; do
        for integrand in disk gaussian:sigma=0.0625 box:sides=0.3x0.6 half-plane; do
            for points in 64 256; do score "$column" "$sampler" "$points" "$integrand" "$@"; done
        done
    done
    for sampler in white-sphere healpix-jittered zphi poisson-disk-sphere; do
        for integrand in cap harmonic:degree=4 lobe; do
            for points in 48 192; do score "$column" "$sampler" "$points" "$integrand" "$@"; done
        done
    done
    for sampler in fpo bnot; do
        ((column < 3)) || continue # two thousand sets of each case
        for integrand in disk gaussian:sigma=0.0625; do
            for points in 64 128; do score "$column" "$sampler" "$points" "$integrand" "$@"; done
        done
        score "$column" "$sampler" 256 disk "$@"
    done
    for integrand in diffuse square; do score "$column" white-hemisphere 64 "$integrand" "$@"; done
}

scores() {
    cases 1 -m 100
    cases 2 -m 100 --shifts 16
    cases 3 -m 1000
    awk '
        function add(name, column, z) {
            if (!(name in seen)) { seen[name] = 1; names[++num_names] = name }
            num[name, column]++
            sum[name, column] += z
            squares[name, column] += z * z
            if (z * z > most[name, column] ^ 2) most[name, column] = z < 0 ? -z : z
        }
        function say(name,  c, n, mean) {
            line = sprintf("%-22s", name)
            for (c = 1; c <= 3; c++) {
                n = num[name, c]
                mean = n ? sum[name, c] / n : 0
                line = line (n ? sprintf("  %3d %6.2f %5.2f %5.2f", n, mean, sqrt((squares[name, c] - n * mean ^ 2) / (n - 1)),
                    most[name, c]) : "")
            }
            print line
        }
        $3 != "" { add($1, $2, $3); all[++num_all] = $2 " " $3 }
        END {
            printf "%-22s  %-22s  %-22s  %s\n", "", "-m 100", "-m 100 --shifts 16", "-m 1000"
            line = sprintf("%-22s", "sampler")
            for (c = 1; c <= 3; c++) line = line sprintf("  %3s %6s %5s %5s", "num", "mean", "sd", "most")
            print line
            num_own = num_names
            for (i = 1; i <= num_own; i++) say(names[i])
            for (i = 1; i <= num_all; i++) { split(all[i], part); add("all", part[1], part[2]) }
            say("all")
        }' "$scratch/scores"
}

# ---- crossovers ----

crossovers() {
    "$program" run --quiet "$folder/../scenes/p15/figure6.yaml" -o "$scratch/figure6" >/dev/null
    "$folder/crossovers.sh" "$scratch/figure6/torus.csv"
    "$folder/crossovers.sh" "$scratch/figure6/sphere.csv" | tail -n +2
}

case $2 in
laws | scores | crossovers) "$2" ;;
*) echo "variance_tables: laws, scores or crossovers, not $2" >&2; exit 2 ;;
esac

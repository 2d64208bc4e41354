#!/usr/bin/env bash
# published_sets.sh PROGRAM DATA: which settings of samplers have the spectrum of the sets in DATA/pointsets that others
# publish, as pointspec check decides at its rate of 0.001 for all rings together, up to 2 sqrt(N). A set a line and
# setting: its points, least distance and mean to the nearest in units of hexagonal packing's; realizations of the
# setting, p of the ring that is furthest off (adjusted for all), rings that differ. Four minutes.
set -euo pipefail
(($# == 2)) || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
program=$(realpath "$1")
sets=$(realpath "$2")/pointsets
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export POINTSPEC_CACHE_DIR=$scratch/cache

distances() { # FILE
    awk '
        NF == 2 { x[++n] = $1; y[n] = $2 }
        function wrapped(d) { d = d < 0 ? -d : d; return d > 0.5 ? 1 - d : d }
        END {
            unit = sqrt(2 / (sqrt(3) * n)); least = 1
            for (i = 1; i <= n; i++) {
                nearest = 1
                for (j = 1; j <= n; j++) {
                    dx = wrapped(x[i] - x[j])
                    if (i != j && dx * dx < nearest) {
                        dy = wrapped(y[i] - y[j])
                        if (dx * dx + dy * dy < nearest) nearest = dx * dx + dy * dy
                    }
                }
                if (nearest < least) least = nearest
                sum += sqrt(nearest)
            }
            printf "%6d %6.3f %6.3f", n, sqrt(least) / unit, sum / n / unit
        }' "$1"
}

compare() { # NAME REALIZATIONS SETTING...: some realizations for each setting
    local name=$1 realizations=$2 file=$sets/utk_$1.txt known num setting
    shift 2
    [[ -r $file ]] || { echo "published_sets: no $file" >&2; return 1; }
    known=$(distances "$file")
    read -r num _ <<<"$known"
    for setting; do
        "$program" power --quiet --sampler "$setting" -n "$num" -m "$realizations" \
            -k "$(awk -v n="$num" 'BEGIN { printf "%d", 2 * sqrt(n) }')" -o "$scratch/saved.npz"
        { "$program" check --quiet "$file" --against "$scratch/saved.npz" || (($? == 3)); } |
            awk -v name="$name" -v known="$known" -v setting="$setting" -v realizations="$realizations" '
                sub(/^# different: /, "") { different = $0 }
                sub(/^# adjusted_p_value: /, "") { p = $0 }
                END { printf "%-24s %s  %-23s %5d  %8.2g  %s\n", name, known, setting, realizations, p, different }'
    done
}

printf '%-24s %6s %6s %6s  %-23s %5s  %8s  %s\n' "published set" N least mean setting sets p "rings that differ"
for size in 1024 4096; do
    compare BNOT_$size $((size == 1024 ? 100 : 30)) bnot:eps=0.5 bnot:eps=0.35 bnot:eps=0.7 bnot
    compare FPO_$size $((size == 1024 ? 100 : 16)) fpo fpo:distance=0.9
    compare dart_throwing_$size $((size == 1024 ? 100 : 30)) poisson-disk:exact=yes
    compare fastpoisson_Pure_$size $((size == 1024 ? 100 : 30)) poisson-disk:exact=yes
done
compare Bridson_nontoroidal_1024 100 bridson:exact=yes

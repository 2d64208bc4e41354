#!/usr/bin/env bash
# cli_variance_rates.sh PROGRAM: pointspec variance --rates: exponents and crossings of samplers, of section 7.2 of P15's numbers, refusals.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" variance "$1"

keys() { # NAME: its values, a line each
    sed -n "s/^# $1: //p; s/^# $1:$//p" out
}
# WHAT KEY LINE EXACT MOST: the exponent of that line, which has an error of no more than MOST, is within five of them
is_near() {
    local rate error
    rate=$(keys "$2" | sed -n "$3p")
    error=$(keys "$2_error" | sed -n "$3p")
    awk -v a="$rate" -v e="$error" -v b="$4" -v m="$5" 'BEGIN { exit !(a - b < 5 * e && b - a < 5 * e && e > 0 && e < m) }' ||
        complain "$1: $rate with the error $error, not $4"
}

# ---- white noise has 1, in one to three dimensions; jitter 1 + 1/d and 1 + 2/d ----

for d in 1 2 3; do
    runs 0 --sampler white -d $d --integrand disk --integrand gaussian:sigma=0.1 -n 16..256 -m 60 --rates auto
    for i in 1 2; do
        is_near "white noise, d = $d" rate $i 1 0.1
        is_near "white noise, d = $d, measured" measured_rate $i 1 0.2
        score=$(keys rate_white_score | sed -n "${i}p")
        awk -v s="$score" 'BEGIN { exit !(s < 5 && -s < 5) }' || complain "white noise, d = $d: $score standard errors from itself"
    done
    [[ -z $(keys crossing) ]] || complain "one sampler: $(keys crossing)"
done
runs 0 --sampler jittered -d 1 --integrand disk --integrand gaussian:sigma=0.1 -n 64..256 -m 60 --shifts 0 --rates auto
is_near 'jittered, d = 1, an interval' rate 1 2 0.05
is_near 'jittered, d = 1, a Gaussian' rate 2 3 0.1
runs 0 --sampler jittered -d 2 --integrand disk --integrand gaussian:sigma=0.1 -n 400,900,1600 -m 60 --shifts 0 --rates auto
is_near 'jittered, d = 2, a disk' rate 1 1.5 0.02
is_near 'jittered, d = 2, a Gaussian' rate 2 2 0.03
[[ $(keys rate_white_score | head -n 1 | cut -d. -f1) -gt 20 ]] || complain "jittered is like white noise: $(keys rate_white_score)"
[[ -z $(keys measured_rate | tr -d '\n') ]] || complain "nothing was measured: $(keys measured_rate)"
runs 0 --sampler jittered -d 3 --integrand disk --integrand gaussian:sigma=0.15 -n 512,1000,1728 -m 16 -k 30 --shifts 0 --rates auto
is_near 'jittered, d = 3, a ball' rate 1 1.3333333 0.03
is_near 'jittered, d = 3, a Gaussian' rate 2 1.6666667 0.1

# ---- columns: from N to N; the line of two N is the same; windows ----

runs 0 --sampler jittered --integrand disk -n 64,144,256 -m 20 --rates 100..256
grep -qx 'points,predicted,predicted_error,lower,upper,measured,measured_error,z_score,white,rate_here,rate_here_error' out ||
    complain "columns: $(grep -v '^#' out | head -n 1)"
[[ $(keys rate_from) == 144 && $(keys rate_to) == 256 && -z $(keys rate_change) ]] || complain "window: $(grep '^# rate' out)"
awk -F, -v r="$(keys rate)" -v e="$(keys rate_error)" '
    /^#/ { next }
    $1 == 64 && ($10 != "" || $11 != "") { exit 1 }
    $1 == 256 { exit !($10 - r < 1e-9 && r - $10 < 1e-9 && $11 - e < 1e-9 && e - $11 < 1e-9) }' out ||
    complain "two N: $(grep -v '^#' out)"
# Student's quantile of 19 degrees of freedom, from tables
keys student_95 | awk '{ bad += !($1 > 2.093023 && $1 < 2.093025) } END { exit bad || NR != 3 }' || complain "quantile: $(keys student_95)"
[[ $(keys false_alarm_rate) == 0.001 && $(keys measured_error_is) == *student_95* ]] || complain "what errors are: $(grep -v '^# rate' out | head -n 14)"
columns=$(grep -v '^#' out | cut -d, -f1-9)
runs 0 --sampler jittered --integrand disk -n 64,144,256 -m 20
[[ $(grep -v '^#' out) == "$columns" ]] || complain 'rates change the other columns'
runs 0 --sampler jittered --integrand disk -n 64,144,256 -m 20 --rates 70..80
[[ $(keys rates) == 'jittered, disk: predicted none: a line takes two numbers of points or more, and there are 0'* && -z $(keys rate) ]] ||
    complain "an empty window: $(keys rates)"

# ---- crossings: P15 says just after 200; in [100, 600] for Gaussians with sigma .05 to .1 ----

runs 0 --sampler jittered --sampler poisson-disk --sampler white --integrand gaussian -n 64,144,256,576,1024 -m 40 --shifts 0 --rates auto
awk -v n="$(keys crossing_points | head -n 1)" -v e="$(keys crossing_points_error | head -n 1)" \
    'BEGIN { exit !(n > 270 && n < 450 && e > 0 && e < 40) }' || complain "jittered and Poisson disk: $(keys crossing)"
[[ $(keys crossing | head -n 1) == 'gaussian: jittered has less variance from N = '*', and poisson-disk before' ]] ||
    complain "jittered and Poisson disk: $(keys crossing)"
[[ $(keys crossing | sed -n 2p) == 'gaussian: none from N = 64 to 1024: jittered has less variance than white at every N' &&
    -z $(keys crossing_points | sed -n 2p) ]] || complain "jittered and white: $(keys crossing)"
# one sampler under two names is told apart nowhere: the same realizations have the same bits
runs 0 --sampler jittered --sampler jittered --integrand disk -n 64,256 -m 8 --shifts 0 --rates auto
[[ $(keys crossing) == *'are told apart at no N' ]] || complain "one and the same: $(keys crossing)"

# ---- samplers without randomness: a sentence for what is predicted, a number for what is measured ----

runs 0 --sampler halton --integrand disk -n 64..1024 -m 20 --rates auto
[[ $(keys rates) == *'predicted none: the variance at N = 64 has no standard error'*'; measured N^-1.'* && -z $(keys rate) ]] ||
    complain "no randomness: $(keys rates)"

# ---- pictures have the same numbers, JSON has arrays; refusals ----

if command -v gnuplot >/dev/null; then
    runs 0 --sampler jittered --integrand disk --integrand gaussian -n 64,256 -m 20 --shifts 0 --rates auto --plot with.svg
    slope=$(keys rate | head -n 1 | awk '{ printf "slope -%.4g", $1 }')
    grep -q "$slope (" with.svg || complain "the picture lacks $slope"
fi
runs 0 --sampler jittered --sampler white --integrand disk -n 64,256 -m 8 --shifts 0 --rates auto -o rates.json
python3 - <<'END' || complain 'rates in JSON'
import json
meta = json.load(open("rates.json"))["meta"]
assert meta["rate_sampler"] == ["jittered", "white"] and meta["rate_integrand"] == ["disk", "disk"]
assert len(meta["rate"]) == 2 and 1.3 < meta["rate"][0] < 1.7 and meta["measured_rate"] == [None, None]
assert meta["crossing_points"] == [None] and meta["crossing_first"] == ["jittered"]
END
refuses '--rates is how variances of a sampler fall as N grows, which takes several numbers of points, as in' \
    --sampler white --integrand disk --rates auto
refuses '--rates has errors, which need 8 realizations or more (--realizations), not 7' \
    --sampler white --integrand disk -n 64..256 -m 7 --rates auto
refuses '--rates: "much" is not one of auto, A..B' --sampler white --integrand disk -n 64..256 -m 8 --rates much
refuses '--rates: 256..64 is no interval' --sampler white --integrand disk -n 64..256 -m 8 --rates 256..64
finish

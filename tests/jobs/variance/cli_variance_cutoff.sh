#!/usr/bin/env bash
# cli_variance_cutoff.sh PROGRAM: pointspec variance: --tail and the cut-off that would do, frequencies that do not matter,
# exact shells, the formula of the paper.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" variance "$1"

table() { grep -v '^#' out; }
column() { # NAME of the only row
    table | awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i } NR == 2 { print $at }'
}
is() { # KEY VALUE
    [[ $(key "$1") == "$2" ]] || complain "$1: $(key "$1"), not $2"
}
near() { # WHAT VALUE EXACT RELATIVE
    awk -v a="$2" -v b="$3" -v r="$4" 'BEGIN { exit !(a - b <= r * b && b - a <= r * b) }' || complain "$1: $2, not $3"
}
alone=(--shifts 0)

# ---- what the cut-off leaves open ----

# misses X ARGS...: exit code 3, the table all the same, one sentence; the cut-off that it names does
misses() {
    local most=$1
    shift
    runs 3 "$@" "${alone[@]}" --tail "$most"
    [[ $(table | wc -l) -ge 2 && $(wc -l <err) == 1 ]] || complain "--tail $most $*: $(table) $(<err)"
    [[ $(<err) =~ ^'pointspec variance: half of upper - lower of '(.*)'; about '(max-frequency|max-degree)' '([0-9]+)' would do'( for all rows)?$ ]] ||
        complain "--tail $most $*: $(<err)"
    sentence=$(<err)
    [[ $(key tail_verdict) == "${sentence#pointspec variance: }" ]] || complain "verdict: $(key tail_verdict)"
    cutoff=("--${BASH_REMATCH[2]:-}" "${BASH_REMATCH[3]:-}")
    runs 0 "$@" "${alone[@]}" --tail "$most" "${cutoff[@]}"
    is tail_verdict reached
    awk -v most="$most" -v tail="$(key tail_largest)" 'BEGIN { exit !(tail > 0 && tail <= most) }' ||
        complain "tail_largest $(key tail_largest) at ${cutoff[*]}"
}
misses 0.01 --sampler jittered --integrand disk -n 64 -m 20
[[ $sentence == *'of disk by jittered at N = 64 is 0.02'*' of predicted, above tail 0.01; about max-frequency '* ]] || complain "$sentence"
near 'cut-off' "${cutoff[1]}" 115 0.15 # half the bracket is 0.028 at 40 and falls as 1/K
misses 0.02 --sampler poisson-disk --integrand disk -n 100 -m 20
misses 0.5 --sampler sobol --integrand disk -n 64 -m 1
misses 0.02 --sampler latin-hypercube --integrand half-plane -n 64 -m 20
misses 0.015 --sampler white --integrand box:sides=0.3x0.5x0.7 -d 3 -n 27 -m 2
misses 0.002 --sampler jittered --integrand disk -d 1 -n 64 -m 20
misses 0.01 --sampler healpix-jittered --integrand cap -n 48 -m 20
[[ ${cutoff[0]} == --max-degree ]] || complain "the sphere: ${cutoff[*]}"
misses 0.05 --sampler fibonacci-hemisphere --integrand cap:angle=0.5 -n 64 -m 1
# from far below the peak of a spectrum
misses 0.05 --sampler poisson-disk --integrand disk -n 256 -m 20 -k 3
misses 0.05 --sampler jittered --integrand disk -n 256 -m 20 --max-frequency 2
misses 0.01 --sampler jittered --integrand disk -n 64 -m 20 --bins shells
# one cut-off for all rows, also for those that have a larger one by themselves
misses 0.025 --sampler jittered --sampler poisson-disk --integrand disk --integrand gaussian -n 16,64,400 -m 20
[[ $sentence == *' rows are above it; '*' for all rows' ]] || complain "$sentence"
# what ends, at its end
runs 3 --sampler white --integrand wave:k=100x3 -n 16 -m 2 "${alone[@]}" --tail 0.01
[[ $(<err) == *'; about max-frequency 100 would do' ]] || complain "a wave: $(<err)"
runs 3 --sampler white --integrand disk -n 16 -m 2 "${alone[@]}" --tail 1e-9
[[ $(<err) == *'; no cut-off that can be computed would do' ]] || complain "too small: $(<err)"
runs 3 --sampler white-sphere --integrand cap -n 16 -m 2 "${alone[@]}" --tail 1e-9
[[ $(<err) == *'; no cut-off that can be computed would do' ]] || complain "too small: $(<err)"
# sets of files
"$program" sample --sampler jittered -n 64 -m 6 -o sets.npy --quiet 2>err </dev/null || complain "sample: $(<err)"
misses 0.01 sets.npy --integrand disk
[[ $sentence == *'of disk by sets.npy at N = 64 is 0.0'* ]] || complain "$sentence"
# without the option, and where it is reached
runs 0 --sampler jittered --integrand disk -n 64 -m 20 "${alone[@]}" -k 2
[[ -z $(key tail) && -z $(key tail_verdict) ]] || complain "tail: $(<out)"
runs 0 --sampler jittered --integrand disk -n 64 -m 20 "${alone[@]}" --tail 0.1
is tail 0.1
is tail_verdict reached
near tail_largest "$(key tail_largest)" "$(awk -v u="$(column upper)" -v l="$(column lower)" -v p="$(column predicted)" \
    'BEGIN { print (u - l) / 2 / p }')" 1e-5
runs 0 --sampler jittered --integrand constant -n 64 -m 20 "${alone[@]}" --tail 1e-300
# files are written, too
runs 3 --sampler jittered --integrand disk -n 64 -m 20 "${alone[@]}" --tail 0.01 -o missed.json
[[ -s missed.json && $(wc -l <err) == 1 ]] || complain 'no missed.json'
for wrong in 0 -1 nan x; do
    refuses '--tail' --sampler white --integrand disk -n 8 --tail=$wrong
done
cat >scene.yaml <<'END'
scene: 1
results:
  - {result: variance, name: short, samplers: jittered, points: 64, realizations: 5, integrand: disk, shifts: 0, tail: 0.01}
END
code=0
"$program" run --cache 0 scene.yaml -o made >out 2>err </dev/null || code=$?
[[ $code == 3 && -s made/short.csv && $(<err) == *'short: half of upper - lower of disk by jittered'*'above tail 0.01; about max-frequency '* ]] ||
    complain "scene: $code $(<err)"
sed 's/tail: 0.01/tail: 0.5/' scene.yaml >reached.yaml
"$program" run --cache 0 reached.yaml -o reached >out 2>err </dev/null || complain "scene: $(<err)"

# ---- frequencies that do not matter ----

runs 0 --sampler jittered --integrand gaussian -n 256 -m 5 "${alone[@]}"
is max_frequency 15
[[ $(key skipped) == *'frequencies beyond 15 (less than 1e-16 of the energy of every integrand is there)'* ]] || complain "$(key skipped)"
short=$(column predicted)
runs 0 --sampler jittered --integrand gaussian -n 256 -m 5 "${alone[@]}" --no-skip
is max_frequency 80
[[ $(key skipped) != *beyond* ]] || complain "--no-skip: $(key skipped)"
near 'without skips' "$(column predicted)" "$short" 1e-5
runs 0 --sampler jittered --integrand gaussian -n 256 -m 5 "${alone[@]}" -k 7
is max_frequency 7
runs 0 --sampler white-sphere --integrand harmonic:degree=5 -n 48 -m 5 "${alone[@]}"
is max_degree 5
skip() { # ARGS...: the skip of a plan
    "$program" plan variance "$@" </dev/null >out 2>err || complain "plan: $(<err)"
    key skip | grep -E '^(frequencies|degrees) beyond'
}
[[ $(skip --sampler jittered --integrand gaussian -n 4096 -m 100) =~ ^'frequencies beyond 15; less than 1e-16 of the energy of every integrand is there; 0.'[0-9]+$ ]] ||
    complain "plan: $(<out)"
[[ $(skip --sampler white-sphere --integrand square -n 4096 -m 100) =~ ^'degrees beyond 2; '.*'; 0.'[0-9]+$ ]] || complain "plan: $(<out)"
[[ -z $(skip --sampler jittered --integrand gaussian --integrand disk -n 4096) ]] || complain "plan: $(<out)"
[[ -z $(skip --sampler jittered --integrand gaussian -n 4096 --no-skip) ]] || complain "plan: $(<out)"

# ---- exact shells ----

# of the table of power: r_2(n) powers of a Gaussian, sigma = 0.1 at any |k|^2 = n
words=(--sampler latin-hypercube -n 64 -m 7 -k 9 --engine host_direct)
"$program" power "${words[@]}" --bins shells --normalize integral -o shells.csv 2>err </dev/null || complain "power: $(<err)"
sum=$(awk -F, '!/^#/ && !/^bin/ { n = $1; sum += $4 * $5 * exp(-4 * atan2(0, -1) ^ 2 * 0.01 * n) }
    END { printf "%.17g", sum * (2 * atan2(0, -1) * 0.01) ^ 2 / 64 }' shells.csv)
[[ $(grep -v '^#' shells.csv | head -n 1) == bin,frequency,normalized_frequency,count,power,* ]] || complain "columns: $(grep -v '^#' shells.csv | head -n 1)"
runs 0 "${words[@]}" "${alone[@]}" --integrand gaussian:sigma=0.1 --bins shells
near shells "$(column lower)" "$sum" 1e-12
is sum 'over exact shells, |k|^2 <= K^2 + K'
runs 0 "${words[@]}" "${alone[@]}" --integrand gaussian:sigma=0.1 --bins shells --no-skip
near 'shells of a box' "$(column lower)" "$sum" 1e-12
runs 0 "${words[@]}" "${alone[@]}" --integrand disk --bins round
box=$(column lower)
runs 0 "${words[@]}" "${alone[@]}" --integrand disk --bins shells
awk -v box="$box" -v ball="$(column lower)" 'BEGIN { exit !(ball < box * (1 - 1e-4)) }' || complain "a ball has $(column lower), a box $box"
refuses 'integrand box: its powers depend on more than |k|' --sampler white -n 8 --integrand box --bins shells
refuses 'integrand box: its powers depend on more than |k|' sets.npy --integrand box --bins shells
refuses 'degrees are exact as they are' --sampler white-sphere -n 8 --integrand cap --bins shells
refuses '--bins floor: variances are sums over whole frequencies' --sampler white -n 8 --integrand disk --bins floor

# ---- the formula of the paper ----

runs 0 --sampler white -n 64 -m 400 --integrand disk --paper-formula "${alone[@]}"
[[ $(table | head -n 1) == *,white,paper ]] || complain "columns: $(table | head -n 1)"
[[ $(key paper) == *'(E-13)'*'neglects P(0+) f_0^2 / N'* ]] || complain "paper: $(key paper)"
near paper "$(column paper)" "$(awk -v white="$(column white)" 'BEGIN { print 1.2443 * white }')" 0.2
refuses 'integrand box: the integral of the paper' --sampler white -n 8 --integrand disk --integrand box --paper-formula
refuses 'integrand cap: the integral of the paper' --sampler white-sphere -n 8 --integrand cap --paper-formula
finish

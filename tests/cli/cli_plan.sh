#!/usr/bin/env bash
# cli_plan.sh PROGRAM BENCH_PLAN: the seconds that plan prints are those that commands take, within a factor of 4 of this
# machine's yardstick; what they are made of stands in the header; planning writes nothing.
set -euo pipefail
program=$1 bench=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
export POINTSPEC_CACHE_DIR=$PWD/cache

bad=0
complain() {
    printf 'cli_plan: %s\n' "$*" >&2
    bad=1
}
plan() { # WORDS
    "$program" plan "$@" >plan.csv 2>err || complain "plan $*: $(<err)"
}
total() { sed -n 's/^# seconds: //p' plan.csv; }
phase() { sed -n "s/^# phase: $1; \(at most \)\?\([^ ]*\) s; .*/\2/p" plan.csv; }
is_about() { awk -v a="$1" -v b="$2" -v f="$3" 'BEGIN { exit !(a > 0 && a < b * f && b < a * f) }'; }

# the sum is that of the phases, and the row's that of the whole command
plan quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 4000 --weights optimal
for name in start lobe points kappa weights "worst-case error" powers results; do
    [[ -n $(phase "$name") ]] || complain "no phase $name: $(<plan.csv)"
done
sum=$(sed -n 's/^# phase: [^;]*; \(at most \)\?\([^ ]*\) s; .*/\2/p' plan.csv | awk '{ s += $1 } END { print s }')
is_about "$sum" "$(total)" 1.02 || complain "phases: $sum, seconds: $(total)"
row=$(awk -F, '$2 == "chosen" { print $3 }' plan.csv)
is_about "$row" "$(total)" 1.01 || complain "row: $row, seconds: $(total)"

# what iterates says so
plan quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 5000 --memory 5e7 --weights optimal
[[ $(total) == "at most "* ]] || complain "gradients: $(<plan.csv)"
grep -q '^# phase: weights; at most .*conjugate gradients' plan.csv || complain "gradients: $(<plan.csv)"

# near and far pairs of many points: twice as many distances for twice the points
plan quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 100000
few=$(phase "worst-case error")
plan quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 200000
is_about "$(awk -v a="$few" 'BEGIN { print 2 * a }')" "$(phase "worst-case error")" 1.02 || complain "pairs: $few $(<plan.csv)"

# points of a file that are in one place: all their pairs, which nothing splits
awk 'BEGIN { for (i = 0; i < 40000; i++) print "0 0 1" }' >place.txt
plan quadrature --brdf diffuse --columns xyz place.txt
grep -q '^# phase: worst-case error; .*; 8e+08 distances' plan.csv || complain "one place: $(<plan.csv)"

# of more than 131072 points the self-check makes powers of the beginning
plan power --sampler white -n 131072 -k 2000
few=$(phase self-check)
plan power --sampler white -n 131073 -k 2000
awk -v a="$few" -v b="$(phase self-check)" -v p="$(phase powers)" 'BEGIN { exit !(b > a + p / 2) }' ||
    complain "beginning: $few $(<plan.csv)"

# no self-check, no seconds for it; sets of files are counted before they are read
plan power --sampler white -n 1e5 -k 16
[[ -n $(phase self-check) ]] || complain "self-check: $(<plan.csv)"
plan power --sampler white -n 1e5 -k 16 --no-self-check
[[ -z $(phase self-check) ]] || complain "without self-check: $(<plan.csv)"
"$program" sample --sampler white -n 512 -m 40 -o sets.txt
plan power -k 16 sets.txt
grep -q '^# phase: averages; .* powers of \(39\|40\|41\) realizations' plan.csv || complain "sets: $(<plan.csv)"

# points are planned and not written; -o is theirs
plan sample --sampler white -n 1e5 -m 10 -o points.npy
[[ ! -e points.npy ]] || complain "sample was not only planned"
grep -q '^# phase: writing; .* 2e+06 numbers as npy' plan.csv || complain "sample: $(<plan.csv)"
plan convert sets.txt -o sets.npy
[[ ! -e sets.npy && -n $(phase reading) && -n $(phase writing) ]] || complain "convert: $(<plan.csv)"

# a scene begins once, and its pictures are counted
printf 'scene: 1\nresults:\n  - {result: power, name: a, samplers: [white, jittered], points: 256}\n' >scene.yaml
plan run scene.yaml
[[ $(grep -c '^# phase: start' plan.csv) == 1 ]] || complain "scene: $(<plan.csv)"
grep -q '^# phase: pictures; .*; 1 by gnuplot' plan.csv || complain "scene: $(<plan.csv)"
grep -q '^a:2,,phase,' plan.csv || complain "rows of phases: $(<plan.csv)"
# the total stands before the first of the jobs
[[ $(grep -E '^# (seconds|job):' plan.csv | head -1) == '# seconds: '* ]] || complain "total: $(<plan.csv)"

# a verdict is the ratio of the seconds beside it, however much of them the other phases are
for points in 64 100000; do
    plan power --sampler bnot -n $points -m 3 -k 32
    awk -F, '$2 == "chosen" { chosen = $3 }
        $2 == "slower" { seconds[++n] = $3; said[n] = $6 + 0; as_long[n] = $6 ~ /^as long in all; powers alone/ }
        END {
            for (i = 1; i <= n; i++) {
                ratio = seconds[i] / chosen
                ratio = ratio < 1 ? 1 / ratio : ratio
                if (as_long[i] ? ratio > 1.005 : said[i] < ratio * .994 || said[i] > ratio * 1.006) { exit 1 }
            }
            exit n == 0
        }' plan.csv || complain "verdicts: $(<plan.csv)"
done

# what a sampler takes while it makes a set is in the bytes and in the time for memory
plan sample --sampler ccvt:M=4096 -n 1024
grep -q '^# phase: memory; .* 2.35e+08 bytes' plan.csv || complain "memory: $(<plan.csv)"
[[ $(awk -F, '$2 == "chosen" { print $4 }' plan.csv) == 2351* ]] || complain "bytes: $(<plan.csv)"

# The yardstick stands beside the command and not in it: what else runs may change between the two, but not every time.
for try in 1 2 3; do
    "$bench" --quick "$program" >table.txt 2>&1 && break || ((try < 3)) || complain "seconds: $(<table.txt)"
done
exit $bad

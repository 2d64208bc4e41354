#!/usr/bin/env bash
# cli_measure.sh PROGRAM: pointspec measure of samplers and files: rows, the same bits beside other questions, in scenes and
# ranges, sets of one point and with points at one place, pictures, plans, and what it refuses. Skipped (77) without a device.
data=$(realpath -m "${POINTSPEC_TEST_DATA:-../shared/data}")
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" measure "$1"
"$program" devices >out 2>err && grep -q '^[0-9]' out || exit 77

# a row for each measure of such points, whatever else is asked beside it
runs 0 --sampler jittered --sampler regular -n 16,64 -m 9 -o both.npz
runs 0 --sampler jittered --sampler regular -n 16,64 -m 9
grep -v '^#' out >both
[[ $(head -1 both) == 'sampler,points,measure,value,standard_error' ]] || complain "$(head -1 both)"
[[ $(cut -d, -f1,2 both | sed 1d | uniq -c | tr -s ' \n' ' ') == ' 12 jittered,16 12 jittered,64 12 regular,16 12 regular,64 ' ]] ||
    complain "rows: $(<both)"
grep -q '^regular,64,capacity_error,0,0$' both || complain "squares: $(<both)"
[[ $(key max_frequency | uniq | tr '\n' ' ') == '26 52 26 52 ' && $(key skipped | uniq) == none ]] || complain "header: $(<out)"
runs 0 --sampler jittered -n 64 -m 9
cmp <(grep -v '^#' out | sed 1d) <(sed -n 's/^jittered,64,//p' both) || complain "alone: $(<out)"
runs 0 --sampler jittered -n 64 -m 9 --measures capacity_error,mean_distance
[[ $(grep -v '^#' out | sed 1d | cut -d, -f1 | tr '\n' ' ') == 'mean_distance capacity_error ' && $(key engine) == '' ]] ||
    complain "named: $(<out)"
cmp <(grep '^mean_distance' out) <(sed -n 's/^jittered,64,\(mean_distance.*\)/\1/p' both) || complain "named: $(<out)"
POCL_MAX_PTHREAD_COUNT=1 runs 0 --sampler jittered -n 64 -m 9
cmp <(grep -v '^#' out | sed 1d) <(sed -n 's/^jittered,64,//p' both) || complain "one thread: $(<out)"

# large sets are not compared pair by pair unasked
runs 0 --sampler white -n 65537 --measures star_discrepancy
[[ $(key skipped) == none && $(tail -1 out) == star_discrepancy,0* ]] || complain "asked: $(<out)"
"$program" plan measure --sampler white -n 65537 >out
grep -q '^# phase: near pairs; ' out || complain "plan: $(<out)"
! grep -q '^# phase: discrepancies; ' out || complain "plan: $(<out)"
"$program" plan measure --sampler white -n 64 --measures least_distance,star_discrepancy >out
grep -q '^# phase: discrepancies; ' out || complain "plan of sets: $(<out)"

# files: one point, points at one place, sets of different N, standard input, the sphere
echo '.5 .25' >one.txt
runs 0 one.txt
[[ $(grep -c ',,$' out) == 6 && $(key points) == 1 ]] || complain "one point: $(<out)"
printf '.5 .5\n.5 .5\n.1 .2\n' >twice.txt
runs 0 twice.txt
says '2 of 3 points of a set are at the place of another one'
grep -q '^least_distance,0,$' out || complain "twice: $(<out)"
runs 0 --quiet one.txt twice.txt
[[ $(key points) == 2 && $(key points_largest) == 3 && $(key input) == '2 files, 2 realizations, one average' ]] || complain "$(<out)"
"$program" sample --sampler white -n 40 -m 3 >sets.txt
runs 0 sets.txt
cp out once
"$program" measure - <sets.txt >out 2>err || complain "$(<err)"
cmp <(grep -v '^# command' out) <(grep -v '^# command' once) || complain "standard input: $(<out)"
printf '1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n' >octahedron.txt
runs 0 --domain sphere octahedron.txt
awk -F, '$1 == "least_distance" && ($2 - 1) ^ 2 < 1e-28 || $1 == "separation" && ($2 - atan2(1, 0)) ^ 2 < 1e-28 { n++ }
    END { exit n != 2 }' out || complain "octahedron: $(<out)"
echo 1 0 0 >one.txt
runs 0 --domain sphere one.txt
[[ $(grep -c -e '_distance,,$' -e '^separation,,$' out) == 3 ]] || complain "one point: $(<out)"

# published sets, by what psa 1.1 prints of them
while [[ -d $data/pointsets ]] && read -r name least mean; do
    runs 0 "$data/pointsets/utk_${name}_1024.txt" --measures least_distance,mean_distance
    [[ $(awk -F, '/^[a-z]*_distance,/ { printf "%.3f ", $2 }' out) == "$least $mean " ]] || complain "$name: $(<out)"
done <<<$'BNOT 0.770 0.896\nFPO 0.925 0.932\nCapCVT 0.751 0.898\ndart_throwing 0.750 0.805'

# pictures and scenes
if command -v gnuplot >/dev/null; then
    runs 0 --sampler jittered -n 64 --plot a.svg
    if ! grep -q 'number variance' a.svg || ! grep -q 'pair correlation' a.svg; then complain 'picture'; fi
fi
printf 'scene: 1\nresults:\n  - {result: measure, name: near, samplers: [jittered, white], points: 16, realizations: 2}\n' >scene.yaml
"$program" run scene.yaml -o scene >out 2>err || complain "scene: $(<err)"
grep -q '^white,number_variance,' scene/near.csv || complain "scene: $(ls scene)"

refuses 'is no measure; known are least_distance' --sampler white -n 4 --measures least
refuses 'measures are of the torus and the whole sphere' --sampler white-hemisphere -n 4
refuses 'the largest frequency must be given: -k K' --sampler white -d 4 -n 8
refuses 'name point files' --measures separation
printf 'nan 1\n' >bad.txt
refuses 'is not a finite number' bad.txt
finish

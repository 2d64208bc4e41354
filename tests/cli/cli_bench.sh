#!/usr/bin/env bash
# cli_bench.sh PROGRAM: pointspec bench: rows, formats, a picture, what it refuses; figures kept per device and who uses them.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" bench "$1"
export POINTSPEC_CACHE_DIR=$PWD/cache

columns=case,engine,tolerance,seconds_per_realization,error,points_per_second,fraction_of_peak,precision
columns+=,fraction_of_bandwidth,predicted_seconds,predicted_error,pareto
rows() { sed '/^#/d; /^case,/d' out; }

runs 0 --case list --quick --plot list.svg
[[ $(grep '^case' out) == "$columns" ]] || complain "columns: $(<out)"
[[ -n $(key device) && -n $(key driver) && $(key schema) == 3 && $(key peak_flops_single) == [0-9]* &&
    $(key time) == *median* && $(key figures) == built-in:*'not measured'* ]] || complain "header: $(<out)"
[[ $(rows | grep -c '^list,torus_direct,.*,single,') == 1 && $(rows | grep -vc '^list,torus_direct,') == 0 ]] ||
    complain "rows: $(<out)"
rows | awk -F, 'NF != 12 || !($4 > 0 && $5 > 0 && $5 <= $3 && $6 > 0 && $7 > 0 && $9 > 0 && $10 > 0) || $11 > $3 || $12 !~ /^[01]$/ {
    exit 1 }' || complain "numbers: $(<out)"
grep -q 'torus_direct, single' list.svg || complain "the picture has no key"
[[ ! -s err ]] || complain "nothing to say: $(<err)"

runs 0 --case list --quick --precision single -o t.json
grep -q "\"columns\": \[\"case\", \"engine\", \"tolerance\"" t.json || complain "json: $(<t.json)"
[[ ! -s out && ! -e cache ]] || complain "something else was written"

refuses 'there is no case "lists"; the nearest is list' --case lists
refuses 'there is no engine "torus_dirct"; the nearest is torus_direct' --engine torus_dirct
refuses 'no case is left' --case list --engine sphere_direct
refuses 'no file is read' points.txt
refuses '"npy" is not one of csv, json' --format npy
refuses '--plot draws .png, .svg and .pdf' --case list --plot x.txt
refuses '--tol is not an option of this command' --tol 1e-3
refuses '--plot does not go with --calibrate' --calibrate --plot x.svg
refuses '--engine does not go with --calibrate' --calibrate --engine torus_direct
refuses '--precision does not go with --calibrate' --calibrate --precision single

# figures of the device
plan() {
    # of so much work that launches, which have a figure of their own, are nothing
    "$program" plan power --sampler white -n 1e6 -d 3 --frequencies list.txt >plan.csv 2>err ||
        complain "plan: $(<err)"
}
seconds() { sed -n 's/^# phase: powers; \([^ ]*\) s; torus_direct in .*/\1/p' plan.csv; } # three digits
precision() { sed -n 's/^# phase: powers; .*; torus_direct in \(.*\) precision$/\1/p' plan.csv; }
figures() { sed -n 's/^# figures: //p' plan.csv; }
for ((i = 1; i <= 1000; i++)); do echo "$i 2 3"; done >list.txt
plan
builtin=$(seconds)
[[ $(figures) == built-in:* ]] || complain "built-in: $(figures)"
runs 0 --calibrate --case list --quick
file=$(key file)
[[ -f $file && $file == "$PWD"/cache/devices/*.result && -n $(key date) ]] || complain "calibration: $(<out)"
factor=$(sed -n "s/^torus_direct,$(precision),//p" out)
for name in device driver; do
    grep -qaxF "$(key $name)" "$file" || complain "no $name in $file"
done
plan
[[ $(figures) == "measured on $(key date)"* ]] || complain "measured: $(figures)"
awk -v a="$builtin" -v b="$(seconds)" -v f="$factor" 'BEGIN { exit !(b / (a * f) - 1 < 0.01 && b / (a * f) - 1 > -0.01) }' ||
    complain "the planner does not take the factor: $builtin $factor $(seconds)"
printf 'scene: 1\nresults:\n  - result: power\n    name: spectrum\n    samplers: white\n    points: 64\n' >scene.yaml
"$program" plan run scene.yaml >scene.csv 2>err || complain "scene: $(<err)"
grep -q "^# figures: measured on $(key date)" scene.csv || complain "scene: $(<scene.csv)"
"$program" devices >devices.csv 2>err
grep -q ",measured on $(key date)" devices.csv || complain "devices: $(<devices.csv)"

# a file that is not whole is as good as none
broken() {
    plan
    [[ $(figures) == built-in:*"was not measured"* && $(seconds) == "$builtin" ]] || complain "broken: $(figures) $(seconds)"
}
cp "$file" whole
{ head -c 700 whole && printf '\1' && tail -c +702 whole; } >"$file"
broken
head -c 100 whole >"$file"
broken
: >"$file"
broken
head -c 70000 /dev/zero >"$file"
broken
mkdir "$file"
broken
rmdir "$file"
cp whole "$file"
plan
[[ $(figures) == measured* ]] || complain "whole again: $(figures)"

POINTSPEC_CACHE_DIR=/dev/null runs 1 --calibrate --case list --quick
says '/dev/null/devices: Not a directory'
code=0
env -u POINTSPEC_CACHE_DIR -u XDG_CACHE_HOME -u HOME "$program" bench --calibrate --case list >out 2>err || code=$?
[[ $code == 2 && $(<err) == *'set POINTSPEC_CACHE_DIR'* ]] || complain "no folder: $code $(<err)"

# scenes with and without skips
cat >scene.yaml <<'SCENE'
scene: 1
results:
  - {result: power, name: rings, samplers: [jittered, white], points: 256, max-frequency: 8, realizations: 400, standard-error: 0.1, floor: 0.01}
  - {result: quadrature, name: rules, brdf: diffuse, samplers: [white-hemisphere, fibonacci-hemisphere], points: 32, realizations: 40}
  - {result: angular, name: degrees, samplers: fibonacci, points: 64, max-degree: 8, realizations: 3}
  - {result: pairs, name: sums, samplers: [zphi, healpix], points: 48, max-degree: 6, realizations: 2}
  - {result: truncation, name: products, brdf: diffuse, max-degree: 2}
SCENE
runs 0 --scenes scene.yaml
[[ $(grep '^scene,' out) == scene,result,questions,seconds,seconds_no_skip,speedup,difference,verdict ]] ||
    complain "columns: $(<out)"
awk -F, '/^scene.yaml,/ { n++; if (!($4 > 0 && $5 > 0 && $7 >= 0 && $7 <= 1 && $8 == "same")) exit 1 } END { exit n != 5 }' out ||
    complain "scenes: $(<out)"
refuses '--scenes needs scenes' --scenes
refuses '--plot does not go with --scenes' --scenes scene.yaml --plot x.svg
refuses '--calibrate does not go with --scenes' --scenes scene.yaml --calibrate
sed 's/diffuse/diffus/' scene.yaml >wrong.yaml
refuses 'wrong.yaml:' --scenes wrong.yaml

# stopped in the middle: no file
"$program" bench -o long.csv >out 2>err &
pid=$!
wait_until_it_catches $pid
sleep 0.5 # and some way into its work
kill -TERM $pid # the shell has background jobs ignore SIGINT
code=0
wait $pid || code=$?
[[ $code == 130 && ! -e long.csv && $(<err) == *interrupted* ]] || complain "interrupted: $code, $(<err)"
finish

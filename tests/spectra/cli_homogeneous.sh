#!/usr/bin/env bash
# cli_homogeneous.sh PROGRAM: pointspec check --homogeneous: what is known of samplers, files, scenes, plans, refusals.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" check "$1"

rows() { grep -vc '^#' out; }
is() { # VERDICT ARGS...
    local verdict=$1 code=0
    shift
    [[ $verdict == same ]] || code=3
    runs $code --homogeneous "$@"
    [[ $(key verdict) == "$verdict" ]] || complain "not $verdict: $*: $(<err)"
    [[ $verdict == same ]] || says "not homogeneous: "
}

# ---- samplers: a random shift or rotation makes any of them homogeneous ----
for sampler in white jittered sobol sobol:scramble=owen sobol:scramble=xor halton regular; do
    is same --sampler "$sampler" --homogenize -n 64
    [[ $sampler == white ]] || is different --sampler "$sampler" -n 64
done
is same --sampler white -n 64
is same --sampler white -n 64 -d 3 -k 5
# In three dimensions products off the axes would drown those on them, and so would a frequency far beyond the strata.
is different --sampler jittered -n 64 -d 3 -s 1
is same --sampler jittered -n 64 -d 3 -s 1 --homogenize
is different --sampler latin-hypercube -n 16 -k 80
[[ $(<err) =~ 'first of all ('(0,16|16,0)') of products up to 20 on axis '[12]' (their mean' ]] || complain "strata of axes: $(<err)"
is same --sampler latin-hypercube -n 16 -k 80 --homogenize
is different --sampler jittered -n 64 -k 64
is different --sampler jittered -n 16 -d 1
for sampler in zphi spiral; do
    is same --sampler "$sampler" --homogenize -n 64
    is different --sampler "$sampler" -n 64
done
is same --sampler white-sphere -n 64
is same --sampler white-hemisphere -n 64 --hemisphere
is different --sampler white-hemisphere -n 64 -l 4
[[ $(<err) == *'rotations change the law'* && $(<err) == *'degree 1, order 1 of amplitudes, about x'* ]] || complain "hemisphere: $(<err)"

# ---- the table ----
is different --sampler jittered -n 64 -m 60 -s 3
says 'translations change the law of these realizations'
[[ $(key invariance) == translations && $(key realizations) == 60 && $(key max_frequency) == 16 ]] || complain "header: $(<out)"
# 16 + 16 * 33 frequencies; sums of products up to 8, 4, 2, 1 for shifts of the plane and of each axis; rings up to the
# corners
[[ $(key different) == *"of 1344 phases" && $(rows) == 24 ]] || complain "table: $(<out)"
[[ $(grep '^bin' out) == bin,phases,resultant,z_score,p_value,adjusted_p_value,worst,verdict ]] || complain "columns: $(<out)"
[[ $(grep -c ',different$' out) == 1 && $(grep ',different$' out) =~ ^8,.*'"('(8,0|0,8)') of products up to '[48](' on axis '[12])?'",different'$ ]] || complain "row: $(<out)"
awk -F, '/^[0-9]/ { phases += $2 } END { exit phases != 1344 }' out || complain "phases: $(<out)"
cp out first
runs 3 --homogeneous --sampler jittered -n 64 -m 60 -s 3
cmp -s out first || complain "not the same bits"
is same --sampler jittered -n 64 -m 60 --false-alarm-rate 1e-30

# ---- files, and samplers' sets as files ----
"$program" sample --sampler jittered -n 64 -m 60 -s 3 -o sets.txt
is different sets.txt
[[ $(key different) == "$(sed -n 's/^# different: //p' first)" ]] || complain "files differ from their sampler: $(<out)"
"$program" sample --sampler white-sphere -n 64 -m 40 -o sphere.txt
is same --domain sphere sphere.txt
[[ $(key max_degree) == 32 ]] || complain "files of the sphere: $(<out)"
is different --lift hemisphere sets.txt
refuses 'realizations cannot tell' --homogeneous --select-sets 1..4 sets.txt
refuses 'outside' --homogeneous sphere.txt

# ---- plans and scenes ----
"$program" plan check --homogeneous --sampler zphi -n 64 >planned.txt 2>err || complain "plan: $(<err)"
[[ $(grep -c '^# phase: phases; .*products of 561 coefficients of 128 realizations' planned.txt) == 2 ]] || complain "plan: $(<planned.txt)"
cat >scene.yaml <<'END'
scene: 1
title: Are they homogeneous?
defaults: {points: 64, max-frequency: 9, dimension: 2, max-degree: 5, hemisphere: true}
results:
  - {result: check, name: torus, homogeneous: true, samplers: [white, jittered]}
  - {result: check, name: sphere, homogeneous: true, samplers: white-sphere, max-degree: 4}
END
code=0
"$program" run scene.yaml -o scene --quiet 2>err || code=$?
[[ $code == 3 && -s scene/torus.csv && -s scene/sphere.csv ]] || complain "scene: exit $code: $(<err)"
[[ $(grep -c '^jittered,.*,different$' scene/torus.csv) == 2 && $(grep -c '^white,.*,same$' scene/torus.csv) == 23 ]] || complain "scene: $(grep -v ^# scene/torus.csv)"
[[ $(grep -vc '^#' scene/sphere.csv) == 5 ]] || complain "scene: $(<scene/sphere.csv)"
[[ $(<err) == *': 1 check found sets that are not homogeneous: '*' phases are not uniform in torus ('* ]] || complain "scene: $(<err)"
cat >both.yaml <<'END'
scene: 1
defaults: {points: 64, engine: host_direct}
results:
  - {result: check, against: saved.npz, samplers: white}
  - {result: check, name: two, homogeneous: true, max-frequency: 9, samplers: [jittered, regular]}
END
"$program" power --sampler jittered -n 64 -m 16 -o saved.npz
code=0
"$program" run both.yaml -o both --quiet 2>err || code=$?
[[ $code == 3 && $(<err) == *': 1 check found another spectrum than the saved one, and 2 checks found sets that are not homogeneous: '*' differ in '* ]] ||
    complain "scene of both: exit $code: $(<err)"

# ---- what is refused ----
refuses 'does not go with' --homogeneous --against saved.npz --sampler white
refuses '-l is for points of the sphere' --homogeneous --sampler white -l 4
refuses '-k is for points of the torus' --homogeneous --sampler white-sphere -k 4
refuses '--hemisphere is for points of the sphere' --homogeneous --sampler white --hemisphere
refuses '--lift is for points of the sphere' --homogeneous --domain torus --lift sphere sets.txt
refuses 'it says how point files are read' --homogeneous --domain sphere --sampler white
refuses 'one sampler is checked at a time' --homogeneous --sampler white --sampler jittered
# One number, before the work: the same for 1 realization and for 9, and for plans and scenes.
for m in 1 9; do
    refuses "among 1344 phases even equal ones would not be an alarm at a rate of 0.001; at least 10 realizations are needed" \
        --homogeneous --sampler white -m $m -n 64
done
refuses 'among 2112 phases' --homogeneous --sampler white-sphere -m 9 -n 64
is same --sampler white -m 10 -n 64
"$program" plan check --homogeneous --sampler white -m 9 -n 64 >out 2>err && complain "a plan of too few"
[[ $(<err) == *'at least 10 realizations are needed' ]] || complain "a plan of too few: $(<err)"
"$program" sample --sampler white -n 64 -m 9 -o few.txt
refuses 'among 1344 phases even equal ones would not be an alarm at a rate of 0.001; at least 10 realizations are needed' \
    --homogeneous few.txt
refuses 'at least' --homogeneous --sampler white -m 9 --false-alarm-rate 1e-9
refuses 'in dimension 4 the largest frequency must be given' --homogeneous --sampler white -n 64 -d 4
refuses 'the saved spectrum says it' --against saved.npz --sampler white -k 4
refuses '--sampler' --homogeneous
finish

#!/usr/bin/env bash
# cli_shade.sh PROGRAM: pointspec shade of samplers and files: columns, the same bits beside other questions, scenes,
# pictures, plans, the library's merge of none, and what it refuses.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" shade "$1"

printf '0,0,2,0\n1,0,1,0\n2,1,.5,.25\n' >light.txt
printf 'Pf 2 1 -1\n\0\0\200\77\0\0\0\100' >sky.pfm # light 1 and 2
light=(--integrand coefficients:file=light.txt --shifts 200)

# a row for each sampler and number of points, whatever else is asked beside it
runs 0 --brdf diffuse "${light[@]}" --sampler fibonacci-hemisphere --sampler white-hemisphere -n 8,16 -m 3
grep -v '^#' out >both
[[ $(head -1 both) == 'sampler,points,rmse,rmse_error,predicted,predicted_error,z_score' ]] || complain "$(head -1 both)"
[[ $(cut -d, -f1,2 both | sed 1d | tr '\n' ' ') == 'fibonacci-hemisphere,8 fibonacci-hemisphere,16 white-hemisphere,8 white-hemisphere,16 ' ]] ||
    complain "rows: $(<both)"
awk -F, 'NR > 1 && !(sqrt($7 ^ 2) < 4 && $3 > 0 && $4 > 0) { exit 1 }' both || complain "scores: $(<both)"
runs 0 --brdf diffuse "${light[@]}" --sampler white-hemisphere -n 16 -m 3
[[ $(tail -1 out) == $(tail -1 both | cut -d, -f3-) ]] || complain "alone: $(tail -1 out)"
[[ $(key orientations) == 200 && $(key light_degree) == 2 && $(key weights) == equal ]] || complain "header: $(<out)"
runs 0 --brdf diffuse "${light[@]}" --sampler white-hemisphere -n 16 -m 3 --engine host_direct
awk -F, -v other="$(tail -1 both | cut -d, -f3)" 'END { exit !($1 / other - 1 < 1e-9 && other / $1 - 1 < 1e-9) }' out ||
    complain "host_direct: $(tail -1 out)"

# maps, optimal weights, and files of the same points
runs 0 --brdf glossy:n=30 --integrand map:file=sky.pfm --sampler fibonacci-hemisphere -n 32 --weights optimal
[[ $(key light_degree) == 256 && $(key orientations) == 1000 ]] || complain "map: $(<out)"
"$program" sample --sampler fibonacci-hemisphere:morph=diffuse -n 16 -o points.npy
runs 0 --brdf diffuse "${light[@]}" --sampler fibonacci-hemisphere -n 16
predicted=$(tail -1 out | cut -d, -f3)
runs 0 --brdf diffuse "${light[@]}" points.npy
[[ $(tail -1 out | cut -d, -f3) == "$predicted" ]] || complain "files: $(tail -1 out)"

# every integrand of the sphere is light: what is measured about tilted axes is what spectra say
for integrand in cap:angle=2,axis=1x2x2 harmonic:degree=3,axis=1x-1x0.3 lobe:n=30,axis=1x0x0 square:axis=3x4x12; do
    runs 0 --brdf diffuse --integrand $integrand --sampler fibonacci-hemisphere -n 16
    awk -F, -v name=$integrand 'END { if (!(sqrt($5 ^ 2) < 4 && $1 > 0 && $3 > 0)) { print name ": " $0; exit 1 } }' out || complain "light: $(tail -1 out)"
done
runs 0 --brdf diffuse --integrand constant --sampler fibonacci-hemisphere -n 16
awk -F, 'END { exit !($1 < 1e-14 && $3 == 0 && $5 == "") }' out || complain "constant light: $(tail -1 out)"

# a normal aside of the lobe: near it nothing changes, far from it measurement and prediction agree
runs 0 --brdf phong:n=40 --integrand map:file=sky.pfm --sampler fibonacci-hemisphere -n 32 --shifts 100
whole=$(tail -1 out)
runs 0 --brdf phong:n=40 --integrand map:file=sky.pfm --sampler fibonacci-hemisphere -n 32 --shifts 100 --view 5
[[ $(tail -1 out) == "$whole" && $(key horizon_points) == 0 && $(key view) == 5 ]] || complain "view of 5 degrees: $(<out)"
runs 0 --brdf phong:n=40 --integrand map:file=sky.pfm --sampler fibonacci-hemisphere -n 32 --shifts 100 --view 88
awk -F, 'END { exit !(sqrt($5 ^ 2) < 4 && $1 > 0) }' out || complain "view of 88 degrees: $(tail -1 out)"
[[ $(tail -1 out) != "$whole" && $(key points) == 32 && $(key below_horizon) == 0.4* ]] || complain "view of 88 degrees: $(<out)"
"$program" plan shade --brdf diffuse "${light[@]}" --view 80 --sampler fibonacci-hemisphere -n 8 >planned || complain 'plan with a view'
grep -q '^# horizon_points: [1-9]' planned || complain "plan with a view: $(<planned)"
runs 0 --brdf phong:n=40 --integrand map:file=sky.pfm --sampler fibonacci-hemisphere -n 32 --shifts 100 --view 0
[[ $(tail -1 out) == "$whole" ]] || complain "view of 0 degrees: $(<out)"
printf '%s\n' x,y,z -.8,0,.6 >aside.csv # the only point is below the horizon, and the lobe is all above
runs 2 --brdf phong:n=4000 --integrand map:file=sky.pfm --view 60 aside.csv
says 'no point of set 1 is above the horizon'

runs 0 --brdf diffuse --integrand coefficients:file=light.txt --shifts 0 --sampler fibonacci-hemisphere -n 16
[[ $(tail -1 out) == ,,"$predicted",0, ]] || complain "predicted alone: $(tail -1 out)"

# pictures, plans and scenes
runs 0 --brdf diffuse "${light[@]}" --sampler fibonacci-hemisphere -n 8,16 --plot a.svg
grep -q RMSE a.svg || complain 'picture'
"$program" plan shade --brdf diffuse "${light[@]}" --sampler fibonacci-hemisphere -n 8 >planned || complain 'plan'
grep -q '^# phase: trials' planned || complain "plan: $(<planned)"
cat >scene.yaml <<'EOF'
scene: 1
results:
  - {result: shade, brdf: diffuse, integrand: "coefficients:file=light.txt", shifts: 200, samplers: [fibonacci-hemisphere, white-hemisphere], points: [8, 16], realizations: 3}
EOF
"$program" run scene.yaml -o folder --quiet >/dev/null || complain 'scene'
[[ $(grep -h '^white-hemisphere,16' folder/*.csv | head -1) == "$(tail -1 both)" ]] || complain "scene: $(ls folder)"

# of test data that is not there an integrand does without its file, and other files are missed
printf 'scene: 1\nresults:\n  - {result: shade, brdf: diffuse, integrand: "map:width=64,file=data:sky.pfm", samplers: fibonacci-hemisphere, points: 8}\n' >data.yaml
POINTSPEC_TEST_DATA=$PWD "$program" run data.yaml -o there --quiet >/dev/null || complain 'test data'
grep -q "^# integrand: map:width=64,file=$PWD/sky.pfm" there/*.csv || complain "test data: $(<there/shade-1.csv)"
grep -q 'data:sky.pfm' there/record.json || complain 'record of test data'
POINTSPEC_TEST_DATA=$PWD/nowhere "$program" run data.yaml -o absent >/dev/null 2>err || complain 'no test data'
says '"data:sky.pfm": it is not in the folder that POINTSPEC_TEST_DATA names; what the integrand is without a file stands in for it'
grep -q '^# integrand_note: 64 x 32 pixels made up for want of a file' absent/*.csv || complain "no test data: $(<absent/shade-1.csv)"
sed 's/map:width=64,file=data:sky.pfm/coefficients:file=data:lm.txt,odd/' data.yaml >others.yaml
POINTSPEC_TEST_DATA=$PWD/nowhere "$program" run others.yaml -o others >/dev/null 2>err && complain 'coefficients of test data'
says 'others.yaml:3: cannot read "data:lm.txt": it is not in the folder that POINTSPEC_TEST_DATA names'
sed -i 's/data:sky.pfm/data:sky.pfm,channel=red/' data.yaml
POINTSPEC_TEST_DATA=$PWD "$program" run data.yaml -o red --quiet >/dev/null || complain 'a parameter behind test data'
grep -q "^# integrand: map:width=64,file=$PWD/sky.pfm,channel=red" red/*.csv || complain "red: $(<red/shade-1.csv)"
POINTSPEC_TEST_DATA='' "$program" run data.yaml -o neither --quiet >/dev/null || complain 'a parameter behind no test data'
grep -q "^# integrand: map:width=64,channel=red" neither/*.csv || complain "red: $(<neither/shade-1.csv)"
sed -i 's/integrand: .*=red"/integrand: map, weights: "data:w.txt"/' data.yaml
POINTSPEC_TEST_DATA='' "$program" run data.yaml -o other >/dev/null 2>err && complain 'weights of test data'
says 'cannot read "data:w.txt"'

# truncated products have errors with that light, too
"$program" truncation --brdf diffuse -l 3 --integrand coefficients:file=light.txt >out || complain 'truncation'
[[ $(grep '^degree' out) == degree,error,equivalent_points,rmse,rmse_points && $(tail -1 out) == *,0, ]] || complain "truncation: $(<out)"
"$program" truncation --brdf diffuse --integrand cap --integrand cap >out 2>err && complain 'two lights'
says 'one --integrand is the light'

# what is refused
refuses 'one --integrand is the light' --brdf diffuse --sampler fibonacci-hemisphere
refuses 'one --integrand is the light' --brdf diffuse --integrand cap --integrand square --sampler fibonacci-hemisphere
refuses 'integrand disk: there is none on the sphere' --brdf diffuse --integrand disk --sampler fibonacci-hemisphere
refuses '--brdf NAME is needed' "${light[@]}" --sampler fibonacci-hemisphere
refuses '--weights optimal does not go with --view: they are made for a whole lobe' --brdf diffuse "${light[@]}" --view 60 --weights optimal --sampler fibonacci-hemisphere
printf '1 1\n0.9 0\n' >lobe.txt
refuses 'a lobe from a table has kinks' --brdf zonal:file=lobe.txt "${light[@]}" --view 60 --sampler fibonacci-hemisphere
refuses '--view: 91' --brdf diffuse "${light[@]}" --view 91 --sampler fibonacci-hemisphere
refuses 'makes points of the torus' --brdf diffuse "${light[@]}" --sampler white
refuses 'below the horizon' --brdf diffuse "${light[@]}" --sampler white-sphere
runs 1 --brdf diffuse --integrand map:file=nothing.hdr --sampler fibonacci-hemisphere
says 'cannot read nothing.hdr'
finish

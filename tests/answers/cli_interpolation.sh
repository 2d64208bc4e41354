#!/usr/bin/env bash
# cli_interpolation.sh PROGRAM: pointspec interpolation of maps and coefficients at samplers and files: rows, the same bits
# beside other questions and on one processor, arrays, scenes, pictures, plans, a map of the data, and what it refuses.
data=$(realpath -m "${POINTSPEC_TEST_DATA:-../shared/data}")
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" interpolation "$1"

printf '0,0,2,0\n1,0,1,0\n2,1,.5,.25\n' >light.txt
printf 'Pf 4 2 -1\n\0\0\200\77\0\0\0\100\0\0\200\77\0\0\0\100\0\0\0\100\0\0\200\77\0\0\0\100\0\0\200\77' >sky.pfm # light 1 and 2
sky=(--integrand map:file=sky.pfm)

# a row for each sampler, number of points and smoothness, whatever else is asked beside it
runs 0 "${sky[@]}" --sampler fibonacci --sampler white-sphere -n 8,16 -m 3 --smoothness 1.1,1.5
grep -v '^#' out >both
[[ $(head -1 both) == 'sampler,points,smoothness,rmse,rmse_error,largest_error,norm,residual,condition,iterations' ]] || complain "$(head -1 both)"
[[ $(cut -d, -f1-3 both | sed 1d | tr '\n' ' ') == 'fibonacci,8,1.1 fibonacci,8,1.5 fibonacci,16,1.1 fibonacci,16,1.5 white-sphere,8,1.1 white-sphere,8,1.5 white-sphere,16,1.1 white-sphere,16,1.5 ' ]] ||
    complain "rows: $(<both)"
awk -F, 'NR > 1 && !($4 > 0 && $4 <= $6 && $8 < 1e-12 && $9 > 1 && $10 == 0) { exit 1 }' both || complain "numbers: $(<both)"
[[ $(sed -n 's/^# realizations: //p' out | tr '\n' ' ') == '1 1 3 3 ' && $(key pixels) == '4 x 2' ]] || complain "header: $(<out)"
runs 0 "${sky[@]}" --sampler white-sphere -n 16 -m 3
[[ $(tail -1 out) == $(tail -1 both | cut -d, -f2-) ]] || complain "alone: $(tail -1 out)"
[[ $(grep -v '^#' out | head -1) == points,* ]] || complain "columns: $(<out)"

# several functions have one factor, and the same numbers
runs 0 "${sky[@]}" --integrand coefficients:file=light.txt --sampler white-sphere -n 16 -m 3
[[ $(grep '^16,1.5,map' out | cut -d, -f4-) == $(tail -1 both | cut -d, -f4-) ]] || complain "two functions: $(<out)"

# sets that are the same are interpolated at once, unless nothing is to be skipped: the same error, in each of them
for skip in '' --no-skip; do
    runs 0 "${sky[@]}" --sampler fibonacci -n 16 -m 5 $skip
    [[ $(key skipped) == "$([[ $skip ]] && echo none || echo 'all realizations but the first: they are the same')" &&
        $(key realizations) == "$([[ $skip ]] && echo 5 || echo 1)" ]] || complain "skipped: $skip $(<out)"
    "$program" plan interpolation "${sky[@]}" --sampler fibonacci -n 16 -m 5 $skip >planned
    grep -q "; $([[ $skip ]] && echo 80 || echo 16) of fibonacci" planned || complain "plan: $skip $(<planned)"
    tail -1 out | cut -d, -f3 >>skips
    tail -1 out | cut -d, -f4 >>skips
done
awk 'NR == 1 { first = $1 } NR == 3 && !(sqrt(($1 / first - 1) ^ 2) < 1e-14) { exit 1 } NR == 4 && !($1 != "" && $1 < 1e-8) { exit 1 }' skips ||
    complain "errors with and without skips: $(<skips)"

# files of the same points; weights of them change nothing
"$program" sample --sampler fibonacci -n 16 -o points.npy
"$program" convert points.npy -o points.txt
sed 's/$/ 2/' points.txt >weighted.txt
runs 0 "${sky[@]}" --sampler fibonacci -n 16
expected=$(tail -1 out)
runs 0 "${sky[@]}" points.npy
[[ $(tail -1 out) == "$expected" ]] || complain "files: $(tail -1 out)"
runs 0 "${sky[@]}" weighted.txt
[[ $(tail -1 out) == "$expected" ]] || complain "weighted: $(tail -1 out)"

# without a matrix, on a device or not, and with all points of one processor
runs 0 --integrand coefficients:file=light.txt --sampler fibonacci -n 700 --smoothness 1.1
cp out dense
runs 0 --integrand coefficients:file=light.txt --sampler fibonacci -n 700 --smoothness 1.1 --memory 2.5M
[[ $(key engine) == 'conjugate gradients' ]] || complain "engine: $(<out)"
awk -F, -v other="$(tail -1 dense | cut -d, -f3)" 'END { exit !(sqrt(($3 / other - 1) ^ 2) < 1e-8 && $9 > 0) }' out ||
    complain "conjugate gradients: $(tail -1 out) $(tail -1 dense)"
if taskset -c 0 true 2>/dev/null; then
    taskset -c 0 "$program" interpolation --integrand coefficients:file=light.txt --sampler fibonacci -n 700 --smoothness 1.1 >alone
    cmp -s dense alone || complain "one processor: $(tail -1 alone)"
fi

# images of the largest number of points, smoothness by smoothness: the errors again, by weights that differ in form
"$program" interpolation "${sky[@]}" --integrand coefficients:file=light.txt --sampler white-sphere -n 8,16 -m 1 --smoothness 1.1,1.5 -o images.npz
python=$(numpy_python)
if [[ -n $python ]]; then
    "$python" - images.npz <<'END' || complain "arrays"
import sys
import numpy as np
table = np.load(sys.argv[1])
image, light, rmse = table["image"], table["light"], table["rmse"][-4:]
edges = np.cos(np.linspace(0, np.pi, light.shape[1] + 1))
weights = (edges[:-1] - edges[1:])[:, None] / 2 / light.shape[2]
assert image.shape == (4, 2, 4) and light.shape == (2, 2, 4)
assert np.array_equal(light[0], [[2, 1, 2, 1], [1, 2, 1, 2]])
own = np.sqrt((weights * (image - np.tile(light, (2, 1, 1))) ** 2).sum((1, 2)))
assert np.allclose(own, rmse, rtol=1e-13), (own, rmse)
END
else
    echo "cli_interpolation: no numpy: without arrays"
fi

# pictures, plans and scenes
runs 0 "${sky[@]}" --sampler fibonacci -n 8,16 --smoothness 1.1,1.5 --plot a.svg
[[ $(<a.svg) == *RMSE*'s = 1.1: slope'* ]] || complain 'picture'
runs 0 "${sky[@]}" --sampler fibonacci -n 8 --smoothness 1.1,1.5 --plot b.svg
[[ $(grep -c '<image' b.svg) == 3 && $(<b.svg) == *map:file=sky.pfm*'N = 8, s = 1.1'*'N = 8, s = 1.5'* ]] || complain 'images'
"$program" plan interpolation "${sky[@]}" --sampler fibonacci -n 5000 >planned || complain 'plan'
[[ $(<planned) == *'# phase: kernel systems'*'conjugate gradients'* ]] || complain "plan: $(<planned)"
cat >scene.yaml <<'END'
scene: 1
results:
  - {result: interpolation, integrand: "map:file=sky.pfm", smoothness: [1.1, 1.5], samplers: [fibonacci, white-sphere], points: [8, 16], realizations: 3, pictures: true}
  - {result: interpolation, name: red, integrand: "map:file=sky.pfm,channel=red", sampler: fibonacci, points: 16}
END
"$program" run scene.yaml -o folder --quiet >/dev/null || complain 'scene'
[[ $(cat folder/*.csv | grep -c "^$(tail -1 both)\$") == 1 ]] || complain "scene: $(cat folder/*.csv)"
[[ $(tail -1 folder/red.csv) == "$expected" ]] || complain "red: $(cat folder/red.csv)"
[[ $(grep -c '<image' folder/interpolation-1-image.svg) == 9 && $(<folder/interpolation-1-rmse.svg) == *fibonacci*slope* ]] || complain "scene: $(ls folder)"

# Pisa: the same numbers by NumPy
if [[ -r $data/env/pisa_1024x512.hdr ]]; then
    runs 0 --integrand "map:file=$data/env/pisa_1024x512.hdr" --sampler fibonacci -n 100,500 --smoothness 1.1,1.5,1.9
    rows=$(grep -v '^[#p]' out | awk -F, '{ printf "%.8f ", $3 }')
    [[ $rows == '0.19060341 0.15394916 0.15314125 0.14973593 0.12836604 0.13059018 ' ]] || complain "Pisa: $rows"
else
    echo "cli_interpolation: $data/env is not there: without Pisa"
fi

# what is refused
printf '0 0 1\n0 1 0\n0 0 1\n' >equal.txt
refuses '--integrand NAME is what is interpolated' --sampler fibonacci
refuses 'makes points of the torus' "${sky[@]}" --sampler white
refuses 'makes points of the hemisphere' "${sky[@]}" --sampler fibonacci-hemisphere
refuses 'smoothness 2 is not between 1 and 2' "${sky[@]}" --sampler fibonacci --smoothness 1.5,2
refuses '9 numbers are more than 8' "${sky[@]}" --sampler fibonacci --smoothness 1.1,1.1,1.1,1.1,1.1,1.1,1.1,1.1,1.1
refuses '1.1 is there twice' "${sky[@]}" --sampler fibonacci --smoothness 1.1,1.5,1.1
echo '.25 .5' >plane.txt
refuses '--lift hemisphere takes points to the hemisphere' "${sky[@]}" --lift hemisphere plane.txt
runs 0 "${sky[@]}" --lift sphere plane.txt
refuses 'are the same file' --integrand map:file=sky.pfm,channel=red --sampler fibonacci --format csv -o sky.pfm
refuses 'nothing to interpolate at' "${sky[@]}"
refuses 'points 1 and 3 are equal' "${sky[@]}" equal.txt
runs 1 "${sky[@]}" --sampler fibonacci -n 100000 --memory 1M
says 'interpolation at 100000 points takes'
runs 1 --integrand map:file=nothing.hdr --sampler fibonacci
says 'cannot read nothing.hdr'
"$program" quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 8 --smoothness 1.1,1.5 >out 2>err && complain 'two spaces'
says 'several numbers of smoothness does not go with --brdf'
finish

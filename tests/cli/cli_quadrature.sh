#!/usr/bin/env bash
# cli_quadrature.sh PROGRAM: pointspec quadrature of samplers and files; what it refuses, and how it says it.
source_dir=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/../..")
# shellcheck source=tests/harness/harness.sh
. "$source_dir/tests/harness/harness.sh" quadrature "$1"

always=(--engine host_direct) # most of this hangs on no engine, and that of the host starts in milliseconds
near() { # WHAT VALUE EXACT RELATIVE
    awk -v a="$2" -v b="$3" -v r="$4" 'BEGIN { exit !(a - b <= r * b && b - a <= r * b) }' ||
        complain "$1: $2, not $3"
}

# spherical Fibonacci points, equal and optimal weights
# (docs/mathematics/quadrature.md#reference-errors)
fibonacci=(--sampler fibonacci-hemisphere -n 256)
runs 0 "${fibonacci[@]}" --brdf diffuse
near 'E, diffuse' "$(key worst_case_error)" 1.190e-2 5e-4
near 'W' "$(key weight_sum)" 1 1e-14
[[ $(grep -c '^[0-9]' out) == 65 ]] || complain "degrees 0..4 sqrt N"
# the parts and the tail are the whole
near 'parts' "$(awk -F': ' '/^# (zonal|anisotropic)_error:/ { sum += $2 ^ 2 } /^# tail:/ { sum += $2 }
    END { printf "%.17g", sqrt(sum) }' out)" "$(key worst_case_error)" 1e-12
near 'e2' "$(awk -F, '/^[0-9]/ { sum += $8 } END { printf "%.17g", sum }' out)" \
    "$(awk -F': ' '/^# (zonal|anisotropic)_error:/ { sum += $2 ^ 2 } END { printf "%.17g", sum }' out)" 1e-12
runs 0 "${fibonacci[@]}" --brdf diffuse --weights optimal
near 'E, optimal' "$(key worst_case_error)" 1.158e-2 5e-4
near 'W, optimal' "$(key weight_sum)" 0.99973 1e-5
free=$(key worst_case_error)
runs 0 "${fibonacci[@]}" --brdf diffuse --weights optimal --weight-sum one
near 'W, sum one' "$(key weight_sum)" 1 1e-13
[[ $(key weights) == 'optimal with sum 1' ]] || complain "weights: $(key weights)"
awk -v a="$free" -v b="$(key worst_case_error)" 'BEGIN { exit !(b > a && b < a * 1.001) }' ||
    complain "E with sum 1: $(key worst_case_error), $free without"

# weights as a file are read back: the same E by either format, and the same bits in both
"$program" sample --sampler fibonacci-hemisphere:morph=diffuse -n 256 -o fibonacci.npy || complain 'sample'
for sum in free one; do
    runs 0 --brdf diffuse --weights optimal --weight-sum $sum --weights-out w.npy fibonacci.npy
    mv out made
    runs 0 --brdf diffuse --weights w.npy fibonacci.npy
    near "E, $sum, read back" "$(key worst_case_error)" "$(sed -n 's/^# worst_case_error: //p' made)" 1e-12
    near "W, $sum, read back" "$(key weight_sum)" "$(sed -n 's/^# weight_sum: //p' made)" 1e-15
    runs 0 --brdf diffuse --weights optimal --weight-sum $sum --weights-out w.txt fibonacci.npy
    cmp -s out <(sed 's/w\.npy/w.txt/' made) || complain "$sum: text and array differ: $(diff out made | head -4)"
    runs 0 --brdf diffuse --weights w.npy fibonacci.npy
    grep -v '^# \(command\|weights\):' out >made
    runs 0 --brdf diffuse --weights w.txt fibonacci.npy
    grep -v '^# \(command\|weights\):' out | cmp -s - made || complain "$sum: text and array are read as others"
    [[ $(wc -l <w.txt) == 256 ]] || complain "$(wc -l <w.txt) weights"
done
# of points that are dropped they are 0, so that they still belong to the file
printf '0 0 1\n0.6 0 -0.8\n0 0.6 0.8\n' >some.txt
runs 0 --brdf diffuse --drop-below-horizon --weights optimal --weights-out w.txt some.txt
[[ $(sed -n 2p w.txt) == 0 && $(sed -n 1p w.txt) != 0 && $(wc -l <w.txt) == 3 ]] || complain "dropped: $(<w.txt)"
# points of the plane are lifted as a sampler lifts its own: the same rule, the density of the lobe by default
"$program" sample --sampler jittered -n 64 -o plane.npy
for sampler in jittered:lift=hemisphere jittered:lift=hemisphere,morph=none jittered:lift=hemisphere,morph=phong,n=3; do
    words=()
    [[ $sampler != *none ]] || words=(--morph none)
    [[ $sampler != *phong* ]] || words=(--morph phong:n=3)
    runs 0 --brdf glossy:n=30 --sampler "$sampler" -n 64
    of_sampler=$(grep -E '^(# worst_case_error|[0-9])' out)
    runs 0 --brdf glossy:n=30 plane.npy --lift hemisphere "${words[@]}"
    [[ $(grep -E '^(# worst_case_error|[0-9])' out) == "$of_sampler" ]] || complain "$sampler is another rule than the lifted file"
    [[ $(grep '^# lift' out) == "# lift: hemisphere" ]] || complain "no lift in the header: $(<out)"
done
[[ $(grep '^# morph' out) == "# morph: phong,n=3" ]] || complain "no morph in the header: $(<out)"
runs 0 --brdf glossy:n=30 plane.npy --lift hemisphere --weights optimal --weights-out w.npy
best=$(grep '^# worst_case_error:' out)
runs 0 --brdf glossy:n=30 plane.npy --lift hemisphere --weights w.npy
[[ $(grep '^# worst_case_error:' out) == "$best" ]] || complain "lifted: $(grep '^# worst' out), not $best"
refuses 'needs n=, the exponent' --brdf diffuse plane.npy --lift hemisphere --morph glossy
refuses 'add --lift hemisphere' --brdf diffuse plane.npy --lift sphere --morph diffuse
refuses '--lift takes points of the plane to the sphere' --brdf diffuse plane.npy
refuses 'is below the horizon' --brdf diffuse plane.npy --lift sphere
refuses 'does not go with --sampler' --brdf diffuse --sampler jittered:lift=hemisphere -n 64 --lift hemisphere
refuses '"w.foo": weights are written to .npy or .txt, not .foo' --brdf diffuse --weights optimal --weights-out w.foo some.txt
refuses 'are the same file' --brdf diffuse --weights optimal --weights-out some.txt some.txt
printf '0,1\n1,.5\n2,.25\n' >z.txt
cp z.txt z.csv
refuses '--weights-out "z.txt" and --brdf "z.txt" are the same file' --brdf zonal:file=z.txt --weights-out z.txt some.txt
refuses '-o "z.csv" and --brdf "z.csv" are the same file' --brdf zonal:file=z.csv -o z.csv some.txt
refuses '--weights-out - and the table would both go to standard output' --brdf diffuse --weights-out - some.txt
refuses '--weights-out - and the table would both go to standard output' --brdf diffuse --weights-out - -o - some.txt
cmp -s z.txt z.csv || complain "a lobe was written over"
refuses '--weights-out has the weights of one rule' --brdf diffuse --weights-out w.txt --sampler white-hemisphere -n 4 -m 2
printf '0 0 1\n#\n0 0.6 0.8\n' >two.txt
refuses 'the weights of one rule are to be kept, but there are several sets' --brdf diffuse --weights-out w2.txt two.txt
[[ ! -e w2.txt ]] || complain 'w2.txt is there'
refuses '--weight-sum is about --weights optimal, which was not given' --brdf diffuse --weight-sum one some.txt
refuses '--weight-sum: "two" is not one of free, one' --brdf diffuse --weights optimal --weight-sum two some.txt
runs 0 "${fibonacci[@]}" --brdf glossy:n=30
near 'E, glossy' "$(key worst_case_error)" 7.390e-3 5e-4
runs 0 "${fibonacci[@]}" --brdf glossy:n=30 --weights optimal -l 8
near 'E, glossy, optimal' "$(key worst_case_error)" 7.076e-3 5e-4

# random points: E = .98274/sqrt N, and sum_l of d2 + c2 as for independent points
runs 0 --sampler white-hemisphere -n 64 -m 400 --brdf diffuse -l 20
near 'E, random' "$(key worst_case_error)" "$(awk 'BEGIN { print .98274 / 8 }')" 0.04
awk -F, '/^[0-9]/ && $1 > 0 {
    expected = ((2 * $1 + 1) / 12.566370614359172 - $2 ^ 2) / 64
    off = ($3 + $5 - expected) / sqrt($4 ^ 2 + $6 ^ 2)
    if (off > 5 || off < -5) exit 1 }' out || complain "random points: d2 + c2"

# files are rules as they stand: the same points, with and without weights of their own
"$program" sample --sampler fibonacci-hemisphere:morph=diffuse -n 256 -o morphed.txt
runs 0 --brdf diffuse morphed.txt
near 'E of a file' "$(key worst_case_error)" 1.190e-2 5e-4
awk 'BEGIN { for (i = 0; i < 256; i++) print 1 / 256 }' >weights.txt
runs 0 --brdf diffuse --weights weights.txt morphed.txt
near 'E of weights' "$(key worst_case_error)" 1.190e-2 5e-4
runs 0 --brdf diffuse --weights optimal --format json morphed.txt
grep -q '"e2_error"' out || complain "json: $(head -c 300 out)"
runs 0 "${fibonacci[@]}" -m 5 --brdf diffuse -l 4
[[ $(key realizations) == 1 && $(key skipped) == *"all realizations but the first"* ]] || complain "repeated: $(key skipped)"
# the result does not depend on the engine
for engine in host_direct sphere_direct sphere_nufft sphere_grid pairs_direct; do
    runs 0 --sampler white-hemisphere -n 32 -l 16 --brdf glossy:n=5 --engine $engine
    awk -F, '/^[0-9]/ { printf "%.7e ", $5 }' out >"$engine.c2"
    cmp -s host_direct.c2 "$engine.c2" || complain "$engine: other c2"
done
# nor on whether realizations come together, through sums over pairs, or one by one, through coefficients
"$program" sample --sampler white-hemisphere -n 16 -m 3 -o three.txt
runs 0 --brdf glossy:n=5 -l 12 three.txt
together_c2=$(awk -F, '/^[0-9]/ { printf "%.9e\n", $5 }' out) together_d2=$(awk -F, '/^[0-9]/ { printf "%.9e\n", $3 + 1 }' out)
for set in 1 2 3; do
    runs 0 --brdf glossy:n=5 -l 12 --select-sets $set three.txt
    grep '^[0-9]' out
done | awk -F, '{ c2[$1] += $5 / 3; d2[$1] += $3 / 3 } END { for (l = 0; l <= 12; l++) printf "%.9e\n", c2[l] > "c2.txt"
    for (l = 0; l <= 12; l++) printf "%.9e\n", d2[l] + 1 > "d2.txt" }'
awk -v mine="$together_c2" 'BEGIN { split(mine, a, "\n") } { if ($1 - a[NR] > 1e-9 || a[NR] - $1 > 1e-9) exit 1 }' c2.txt ||
    complain "together and one by one: c2"
awk -v mine="$together_d2" 'BEGIN { split(mine, a, "\n") } { if ($1 - a[NR] > 1e-9 || a[NR] - $1 > 1e-9) exit 1 }' d2.txt ||
    complain "together and one by one: d2"
# a morph of another lobe: powers that the plan does not expect
runs 0 --sampler white-hemisphere:morph=glossy,n=200 -n 64 -m 4 -l 8 --brdf diffuse

# several samplers
runs 0 --sampler white-hemisphere --sampler fibonacci-hemisphere -n 64 -m 3 --brdf diffuse -l 5
[[ $(grep -c '^white-hemisphere,' out) == 6 && $(grep -c '^fibonacci-hemisphere,' out) == 6 ]] || complain "two samplers"
grep -q '^sampler,degree,b,d2,' out || complain "two samplers: $(grep ^sampler out)"
mapfile -t errors < <(sed -n 's/^# worst_case_error: //p' out)
runs 0 --sampler fibonacci-hemisphere -n 64 --brdf diffuse -l 5
near 'the second sampler' "${errors[1]}" "$(key worst_case_error)" 1e-14
if command -v gnuplot >/dev/null; then
    runs 0 --sampler white-hemisphere --sampler fibonacci-hemisphere -n 64 --brdf diffuse --plot lines.svg
    grep -q 'C_l^2, fibonacci' lines.svg || grep -q 'fibonacci' lines.svg || complain "picture: no lines"
fi
refuses '--plot draws' "${fibonacci[@]}" --brdf diffuse --plot lines.gif
runs 0 "${fibonacci[@]}" --brdf diffuse -o table.npy
[[ -s table.npy && -s table.json ]] || complain "npy"

# rules whose N varies: the mean of what was made, not what was asked for
"$program" sample --sampler poisson-disk -n 64 -m 5 -o disks.txt
counts=$(awk 'BEGIN { least = 1e9; sets = 1 } /^#/ { add(); sets++; n = 0; next } { n++ } END { add(); printf "%.15g %d %d", all / sets, least, most }
    function add() { all += n; if (n < least) least = n; if (n > most) most = n }' disks.txt)
runs 0 --sampler poisson-disk:lift=hemisphere -n 64 -m 5 --brdf diffuse -l 4
[[ "$(key points) $(key points_smallest) $(key points_largest)" == "$counts" && $(key points) != 64 ]] || complain "N of rules: $(grep points out), not $counts"
runs 0 disks.txt --lift hemisphere --brdf diffuse -l 4
[[ "$(key points) $(key points_smallest) $(key points_largest)" == "$counts" ]] || complain "N of files: $(grep points out), not $counts"
# with several samplers every one has its range, so that JSON has no gaps
runs 0 --sampler poisson-disk:lift=hemisphere --sampler white-hemisphere -n 64 -m 5 --brdf diffuse -l 4 --format json
[[ $(tr -d ' \n' <out) == *'"points":['*',64],"points_smallest":['*',64],"points_largest":['*',64],'* ]] || complain "ranges: $(grep points out)"

# the last degree: where the bound of the rest meets the tolerance, or 4 sqrt N with the reason
runs 0 "${fibonacci[@]}" --brdf diffuse --tol 1e-2
[[ $(key degrees) == "$(key max_degree), where"* ]] || complain "degrees: $(key degrees)"
awk -v bound="$(key tail_bound)" 'BEGIN { exit !(bound <= 1e-2 * 8 / 3) }' || complain "tail_bound $(key tail_bound)"
runs 0 "${fibonacci[@]}" --brdf diffuse --tol 1e-2 -l $(($(key max_degree) - 1))
awk -v bound="$(key tail_bound)" 'BEGIN { exit !(bound > 1e-2 * 8 / 3) }' || complain "one degree less: $(key tail_bound)"
[[ -z $(key degrees) ]] || complain "-l: $(key degrees)"
runs 0 "${fibonacci[@]}" --brdf diffuse
[[ $(key degrees) == "64 = 4 sqrt N: the bound of the rest"* ]] || complain "degrees: $(key degrees)"
"$program" plan quadrature "${fibonacci[@]}" -m 3 --brdf diffuse --tol 1e-2 >out 2>err || complain "plan: $(<err)"
grep -q '^# skip: degrees [0-9]* to 64; ' out || complain "plan: $(grep skip out)"
grep -q '^# skip: all realizations but the first' out || complain "plan: $(grep skip out)"
[[ $(grep -c ',chosen,' out) == 1 ]] || complain "plan: $(grep chosen out)"
# --no-skip does all of it, with the same numbers; --verbose and --profile say what was done
runs 0 --sampler fibonacci-hemisphere -n 256 -m 2 --brdf diffuse --tol 1e-2
few=$(key max_degree)
runs 0 --sampler fibonacci-hemisphere -n 256 -m 2 --brdf diffuse --tol 1e-2 --no-skip
[[ $(key max_degree) == 64 && $few -lt 64 && $(key realizations) == 2 ]] || complain "--no-skip: $(grep '^#' out)"
[[ $(key skipped) != *realizations* ]] || complain "--no-skip: $(key skipped)"
# --standard-error: ends at a look, says where it stands and warns where it does not get there; plan says so before
white=(--sampler white-hemisphere -n 16 --brdf diffuse -l 8)
runs 0 "${white[@]}" --standard-error 0.2
[[ $(key relative_standard_error) == "0.2, reached; largest "*", of "*" with the correction" ]] || complain "look: $(key relative_standard_error)"
[[ $(key realizations) -gt 16 && $(key skipped) == *'beyond the standard error'* ]] || complain "$(key realizations) realizations: $(key skipped)"
num=$(key realizations)
runs 0 "${white[@]}" --standard-error 0.2 -m 20
[[ $(key relative_standard_error) == *'not reached'* && $(<err) == *'was not reached in 20 realizations'* ]] || complain "not reached: $(<err)"
runs 0 "${white[@]}" --standard-error 0.2 -m 200 --no-skip
[[ $(key realizations) == 200 && $num -lt 200 ]] || complain "--standard-error --no-skip: $(key realizations)"
"$program" plan quadrature "${white[@]}" --standard-error 0.2 -m 1000 >out 2>err || complain "plan: $(<err)"
grep -q '^# skip: realizations beyond the standard error asked for; .*; 0\.[0-9]*$' out || complain "plan: $(grep skip out)"
grep -q '^# skip: odd degrees above 1 of kappa; ' out || complain "plan: $(grep skip out)"
runs 0 --sampler fibonacci-hemisphere -n 16 --brdf diffuse --verbose
grep -q '^sphere_direct (double): ' err || complain "--verbose: $(<err)"
if "$program" devices >out 2>err && grep -q '^[0-9]' out; then
    runs 0 --sampler fibonacci-hemisphere -n 16 --brdf diffuse --engine sphere_direct --profile
    [[ $(<err) == *GFLOP/s*sphere_* ]] || complain "--profile: $(<err)"
fi
"$program" plan quadrature --brdf diffuse morphed.txt >out 2>err || complain "plan of a file: $(<err)"

refuses '--brdf NAME is needed' "${fibonacci[@]}"
refuses 'no rule' --brdf diffuse
refuses 'points come from one of them' --brdf diffuse "${fibonacci[@]}" morphed.txt
refuses 'points of the whole sphere' --sampler fibonacci -n 16 --brdf diffuse
refuses 'points of the torus' --sampler white -n 16 --brdf diffuse
refuses 'is not between 1 and 2' "${fibonacci[@]}" --brdf diffuse --smoothness 2.5
refuses 'samplers make points only' "${fibonacci[@]}" --brdf diffuse --weights column
printf '0 0 1\n0.6 0 -0.8\n' >below.txt
refuses 'below.txt, line 2: z = -0.8 is below the horizon' --brdf diffuse below.txt
[[ $(<err) == *--drop-below-horizon* ]] || complain "below the horizon: $(<err)"
printf '0 0 1\n' >one.txt
printf '0,90\n10,45\n3,-1\n' >below.csv
refuses 'below.csv, line 3: a direction is below the horizon' --brdf phong:n=3 --columns lon-lat --input-format csv below.csv
printf '0.1 0.2\n0.1 1.6\n' >below_angles.txt
refuses 'below_angles.txt, line 2: a direction is below the horizon' --brdf diffuse --columns phi-theta below_angles.txt
runs 0 --brdf diffuse --columns phi-theta --drop-below-horizon below_angles.txt
[[ $(key dropped_below_horizon) == 1 ]] || complain "dropped angles: $(key dropped_below_horizon)"
runs 0 --brdf glossy:n=2,cut=none below.txt
[[ $(key note) == *"a part of it is below the horizon"* ]] || complain "note: $(key note)"
runs 0 --brdf glossy:n=0.5 one.txt
[[ $(key note) == *"its cut at the horizon matters"* ]] || complain "note: $(key note)"
refuses 'is not between 0.001 and 1e+06' --brdf glossy:n=0 one.txt
refuses 'is not between 0.001 and 1e+06' --brdf phong:n=-1 one.txt
runs 0 --brdf diffuse --drop-below-horizon below.txt
[[ $(key dropped_below_horizon) == 1 ]] || complain "dropped: $(key dropped_below_horizon)"
near 'E of what is left' "$(key worst_case_error)" 0.736694436886575 1e-12
runs 0 --brdf diffuse one.txt
near 'E of one point' "$(key worst_case_error)" 0.736694436886575 1e-12
printf '5\n1\n' >two.txt
runs 0 --brdf diffuse --drop-below-horizon --weights two.txt below.txt
[[ $(key weight_sum) == 5 ]] || complain "weights of what is left: $(key weight_sum)"
printf '0.6 0 -0.8\n' >all_below.txt
refuses 'no point of set 1 is above the horizon' --brdf diffuse --drop-below-horizon all_below.txt
printf '0\n0\n' >zero.txt
refuses 'all weights are 0' --brdf diffuse --drop-below-horizon --weights zero.txt below.txt
runs 0 --sampler white-hemisphere -n 1 -m 2 --brdf diffuse
refuses 'is not between 1 and 2' "${fibonacci[@]}" --brdf diffuse --smoothness 1
printf '0 0 1\n1e-9 0 1\n' >near.txt
refuses 'points 2 and 1 are 1e-09 from each other' --brdf diffuse --smoothness 1.9 --weights optimal near.txt
printf '0 0 1\n0 0 1\n0.6 0 0.8\n' >twice.txt
runs 0 --brdf diffuse --weights optimal twice.txt
[[ $(key duplicates) == 1 ]] || complain "duplicates: $(key duplicates)"
printf '0 0 1\n1e-7 0 1\n0.6 0 0.8\n' >near.txt
runs 0 --brdf diffuse --smoothness 1.9 --weights optimal near.txt
[[ $(key warning) == 'the condition number is '*'e+1'*' so near each other that the weights have'* ]] ||
    complain "near duplicates: $(key warning)"
# Without memory for a matrix: the same weights by conjugate gradients, by a device and by threads.
optimal=(--sampler fibonacci-hemisphere -n 400 -l 4 --brdf diffuse --weights optimal)
runs 0 "${optimal[@]}"
[[ $(key weights_by) == Cholesky ]] || complain "dense: $(key weights_by)"
dense=$(key worst_case_error)
for engine in pairs_direct host_direct; do
    runs 0 "${optimal[@]}" --engine "$engine" --memory 5e5
    [[ $(key weights_by) == 'conjugate gradients, '*' steps to a residual of '* ]] ||
        complain "$engine: $(key weights_by)"
    near 'E by conjugate gradients' "$(key worst_case_error)" "$dense" 1e-10
done
"$program" plan quadrature "${optimal[@]}" >out 2>err || complain "plan: $(<err)"
grep -q '^# weights: optimal, by Cholesky; a matrix of 400 x 400, 2.23e+06 bytes' out ||
    complain "plan: $(grep weights out)"
"$program" plan quadrature "${optimal[@]}" --memory 5e5 >out 2>err || complain "plan: $(<err)"
grep -q '^# weights: optimal, by conjugate gradients.*2.23e+06 bytes, and --memory is less' out ||
    complain "plan: $(grep weights out)"
head -3 weights.txt >few.txt
refuses 'holds 3 weights, but a set has 256 points' --brdf diffuse --weights few.txt morphed.txt
# Figure 2 of M18 is C_l^2 of the diffuse lobe for l <= 10; the shipped scene draws it, and no glossy result says it is that.
scene=$source_dir/docs/scenes/m18/figures.yaml
awk '/^  - result:/ { block = ""; inside = 1 }
    !inside { print; next }
    { block = block $0 "\n" }
    /title: "Figure 2/ { wanted = 1 }
    /^    max-degree:/ { if (wanted) printf "%s", block; wanted = 0 }' "$scene" >figure2.yaml
[[ $(grep -c '^  - result:' figure2.yaml) == 1 ]] || complain "Figure 2: $(grep -c '^  - result:' figure2.yaml) results"
grep -q 'brdf: diffuse' figure2.yaml || complain "Figure 2 is not diffuse"
"$program" run figure2.yaml -o figure2 --quiet >run.out 2>&1 || complain "Figure 2: $(tail -1 run.out)"
grep -v '^#' figure2/low-degrees.csv >low.csv || complain "Figure 2: no table"
# 6 samplers x 2 weights x degrees 0..10, whatever the order of the first two columns
[[ $(wc -l <low.csv) == 133 ]] || complain "Figure 2: $(wc -l <low.csv) lines"
# of Fibonacci points c2 + c_l0^2 is (2l+1)/4 pi times the mean of P_l over all pairs
awk '{ x[NR] = $1; y[NR] = $2; z[NR] = $3 }
    END {
        for (i = 1; i <= NR; i++) {
            for (j = 1; j <= NR; j++) {
                t = x[i] * x[j] + y[i] * y[j] + z[i] * z[j]; p = 1; q = t
                for (l = 1; l <= 10; l++) { sum[l] += q; r = ((2 * l + 1) * t * q - l * p) / (l + 1); p = q; q = r }
            }
            p = 1; q = z[i]
            for (l = 1; l <= 10; l++) { zonal[l] += q; r = ((2 * l + 1) * z[i] * q - l * p) / (l + 1); p = q; q = r }
        }
        for (l = 1; l <= 10; l++)
            printf "%d,%.17g\n", l, (2 * l + 1) / 12.566370614359172 * (sum[l] - zonal[l] ^ 2) / NR ^ 2
    }' morphed.txt >pairs.csv
grep -E 'fibonacci' low.csv | grep ',\?equal,' | awk -F, 'NR == FNR { c2[$1] = $2; next }
    $3 > 0 { num++; off = $7 / c2[$3] - 1; if (off > 1e-6 || off < -1e-6) bad = 1 }
    END { exit bad || num != 10 }' pairs.csv - || complain "Figure 2: c2 of Fibonacci points"
# of random points d2 + c2 is known, and optimal weights lower c2 of every set
grep 'white' low.csv | grep 'equal' | awk -F, '$3 > 0 {
    num++
    off = ($5 + $7 - ((2 * $3 + 1) / 12.566370614359172 - $4 ^ 2) / 256) / sqrt($6 ^ 2 + $8 ^ 2)
    if (off > 5 || off < -5) bad = 1 }
    END { exit bad || num != 10 }' || complain "Figure 2: random points"
awk -F, '/equal/ { equal += $7 } /optimal/ { optimal += $7; num++ } END { exit !(num == 66 && optimal < equal / 2) }' low.csv ||
    complain "Figure 2: optimal weights"
finish

#!/usr/bin/env bash
# cli_pairs.sh PROGRAM: pointspec pairs from points to tables by every route; what it refuses, and how it says it.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" pairs "$1"

column() { # NUMBER: of the table in out, with 9 decimals; -0 is 0
    awk -F, -v column="$1" '!/^#/ && !/^degree/ { x = sprintf("%.9f", $column); sub(/^-0\.0*$/, "0.000000000", x)
        printf "%s:%s ", $1, x }' out
}
has_device=yes
"$program" devices >out 2>err && grep -q '^[0-9]' out || has_device=no
routes=(host_direct)
[[ $has_device == no ]] || routes+=(pairs_direct pairs_histogram sphere_direct sphere_nufft sphere_grid)

# The octahedron with one vertex heavier: 1/49 for weights that sum to 1 at l = 1, 2, 3, 17 + 32 * 3/8 over 49 at l = 4. The
# zonal sums are 0, -1/2 * 5 + 2, 0 and 2 + 5 * 3/8.
cat >octahedron.txt <<'END'
1 0 0 2
-1 0 0 1
0 1 0 1
0 -1 0 1
0 0 1 1
0 0 -1 1
END
sums='1:1.000000000 2:1.000000000 3:1.000000000 4:29.000000000 '
for engine in "${routes[@]}"; do
    runs 0 --engine "$engine" --tol 1e-11 -l 4 --columns xyzw octahedron.txt
    [[ $(column 2) == "$sums" ]] || complain "$engine: $(column 2), not $sums"
    # C^2 = (2l + 1) / (4 pi) (Q - Z^2)
    awk -F, '/^[0-9]/ { split("0 -0.5 0 3.875", z, " "); want = (2 * $1 + 1) / 12.566370614359172 * ($2 - z[$1] * z[$1])
        if (($4 - want) ^ 2 > 1e-18) exit 1 }' out || complain "$engine: C_l^2: $(grep '^[0-9]' out)"
    [[ $(key weight_sum) == 7 && $(key engine) == "($engine "* ]] || complain "header: $(grep '^#' out)"
done
grep -qx 'degree,legendre_sum,legendre_sum_error,c2,c2_error' out || complain "column names: $(<out)"
runs 0 --engine host_direct -l 4 --columns xyzw --weights equal octahedron.txt
[[ $(key weight_sum) == 1 ]] || complain "equal weights sum to $(key weight_sum)"
[[ $(column 2) == '1:0.000000000 2:0.000000000 3:0.000000000 4:0.583333333 ' ]] || complain "equal: $(column 2)"
[[ $(key normalization) == pairs:* ]] || complain "normalization: $(key normalization)"

# Weights that sum to 0 are as good as others; all zero are not.
sed 's/ 2$/ -5/' octahedron.txt >balanced.txt
runs 0 --engine host_direct -l 2 --columns xyzw balanced.txt
[[ $(key weight_sum) == 0 && $(column 2) == '1:36.000000000 2:36.000000000 ' ]] || complain "balanced: $(column 2)"
sed 's/ [0-9]$/ 0/' octahedron.txt >zero.txt
runs 2 --engine host_direct -l 2 --columns xyzw zero.txt
says 'all weights are 0'

# One point; one realization has no standard error, several have, of both columns.
echo '0 0.6 0.8' >one.txt
for engine in "${routes[@]}"; do
    runs 0 --engine "$engine" --tol 1e-11 -l 3 one.txt
    [[ $(column 2) == '1:1.000000000 2:1.000000000 3:1.000000000 ' ]] || complain "$engine, one point: $(column 2)"
done
awk -F, '/^[0-9]/ && ($3 != "" || $5 != "") { exit 1 }' out || complain "standard errors of one: $(<out)"
runs 0 --engine host_direct --sampler white-sphere -n 8 -m 5 -l 3
awk -F, '/^[0-9]/ && ($3 == "" || $5 == "" || $3 + 0 <= 0 || $5 + 0 <= 0) { exit 1 }' out ||
    complain "standard errors of five: $(<out)"
# A turn about a random axis leaves Q, not C_l^2: no realization is left out.
runs 0 --engine host_direct --sampler fibonacci -n 8 -m 4 -l 3 --homogenize
awk -F, '/^[0-9]/ && (!($5 > 0) || $3 > 1e-15) { exit 1 }' out || complain "rotations: $(<out)"
runs 0 --engine host_direct --sampler fibonacci -n 8 -m 4 -l 3
[[ $(key skipped) == *'all realizations but the first'* ]] || complain "skipped: $(key skipped)"
awk -F, '/^[0-9]/ && ($3 != "0" || $5 != "0") { exit 1 }' out || complain "four equal ones: $(<out)"

# The hemisphere: even degrees, the same numbers by every engine whether a point or its opposite is given.
awk '{ print ($4 == 2 ? -$1 : $1), $2, $3, $4 }' octahedron.txt >other_side.txt
for engine in "${routes[@]}"; do
    runs 0 --engine "$engine" --tol 1e-11 -l 5 --hemisphere --columns xyzw other_side.txt
    [[ $(column 2) == '2:1.000000000 4:29.000000000 ' ]] || complain "$engine, hemisphere: $(column 2)"
    awk -F, '/^[0-9]/ { z = $1 == 2 ? -0.5 : 3.875; want = (2 * $1 + 1) / 12.566370614359172 * ($2 - z * z)
        if (($4 - want) ^ 2 > 1e-18) exit 1 }' out || complain "$engine, hemisphere: C_l^2: $(grep '^[0-9]' out)"
done
[[ $(key skipped) == *'odd degrees'* ]] || complain "hemisphere, skipped: $(key skipped)"

# Formats and several samplers.
runs 0 --engine host_direct --sampler white-sphere --sampler zphi -n 8 -l 2
grep -qx 'sampler,degree,legendre_sum,legendre_sum_error,c2,c2_error' out || complain "two samplers: $(<out)"
runs 0 --engine host_direct --sampler zphi -n 8 -l 2 --format json
grep -q '"command": *"pairs".*null' <(tr -d '\n' <out) || complain "json: $(head -c 300 out)"
runs 0 --engine host_direct --sampler zphi -n 8 -l 2 -o table.npy
head -c 128 table.npy | grep -aq "(2, 5)" || complain "npy: $(head -c 128 table.npy | tr -d '\0')"

# The floor: sums over pairs lose small powers, coefficients do not.
if [[ $has_device == yes ]]; then
    runs 3 --engine pairs_direct --sampler white-sphere -n 64 -l 8 --floor 1e-13
    says 'floor'
    runs 0 --sampler white-sphere -n 64 -l 8 --floor 1e-13
    [[ $(key engine) == '(sphere_'* || $(key engine) == '(host_'* ]] || complain "floor: $(key engine)"
    "$program" plan pairs --sampler white-sphere -n 64 -l 8 --floor 1e-13 >out
    grep -q '^pairs_direct:double,infeasible,.*has a floor' out || complain "plan: $(<out)"
    "$program" plan angular --sampler white-sphere -n 64 -l 8 >out
    grep -q '^pairs_direct:double,not applicable' out || complain "plan angular: $(<out)"
fi

# What is refused.
runs 2 --sampler white
says 'lift=sphere'
runs 2 -l 3 --engine torus_direct one.txt
says 'not for points on the sphere'
runs 3 --engine host_direct --tol 1e-30 -l 3 one.txt
says 'tolerance'
printf '0.1 0.2\n0.3 0.4\n' >plane.txt
runs 2 -l 3 plane.txt
finish

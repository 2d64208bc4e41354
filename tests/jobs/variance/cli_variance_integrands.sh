#!/usr/bin/env bash
# cli_variance_integrands.sh PROGRAM: pointspec variance of integrands from files: the same numbers as integrands that are
# known otherwise, what scenes make of files, what is refused.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" variance "$1"

table() { grep -v '^#' out; }
column() { # NAME of the only row
    table | awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i } NR == 2 { print $at }'
}
near() { # WHAT A B RELATIVE
    awk -v a="$2" -v b="$3" -v r="$4" 'BEGIN { exit !(a - b <= r * b && b - a <= r * b && b > 0) }' ||
        complain "$1: $2, not $3"
}
few=(--engine host_direct -k 4)

# ---- coefficients of the torus ----

# a wave is 1/2 at k and -k
printf '# a wave\n2,-3,0.5,0\n-2 3 0.5 0\n' >wave.txt
runs 0 --sampler jittered -n 16 -m 20 "${few[@]}" --integrand wave:k=2x-3
wave=$(table | sed 1d | cut -d, -f1-3,9)
measured=$(column measured)
runs 0 --sampler jittered -n 16 -m 20 "${few[@]}" --integrand coefficients:file=wave.txt
[[ $(table | sed 1d | cut -d, -f1-3,9) == "$wave" ]] || complain "a wave: $(table), not $wave"
near 'a wave, measured' "$(column measured)" "$measured" 1e-9
[[ $(column lower) == "$(column predicted)" && $(column upper) == "$(column predicted)" ]] ||
    complain "beyond the file there is nothing: $(table)"
# a wave that the cut-off leaves out is told
runs 0 --sampler jittered -n 16 -m 20 --engine host_direct -k 2 --integrand coefficients:file=wave.txt
[[ $(column lower) == 0 && $(column predicted) == 0.03125 ]] || complain "beyond the cut-off: $(table)"

# what --coefficients writes: the density of a set; its text has the same numbers
"$program" power --engine host_direct --sampler white -n 6 -k 2 --coefficients set.npy -o set.csv 2>err || complain "power: $(<err)"
runs 0 --sampler sobol:scramble=none -n 32 "${few[@]}" --integrand coefficients:file=set.npy
near 'pairs' "$(key pairwise_variance)" "$(column predicted)" 1e-9
[[ $(key integral) == 6* ]] || complain "integral: $(key integral)"
of_array=$(table)
tail -c 400 set.npy | od -An -v -tf8 -w16 | awk '{ print int((NR - 1) / 5) - 2, (NR - 1) % 5 - 2, $1, $2 }' >set.txt
runs 0 --sampler sobol:scramble=none -n 32 "${few[@]}" --integrand coefficients:file=set.txt
near 'as text' "$(column predicted)" "$(cut -d, -f2 <<<"$(sed 1d <<<"$of_array")")" 1e-9

# a tilted sum of waves in one and in three dimensions, with z-scores that are possible
printf '0 1 0\n1 .25 .5\n-1 .25 -.5\n' >line.txt
printf '1 0 2 .5 .5\n-1 0 -2 .5 -.5\n0 1 0 1 0\n0 -1 0 1 0\n' >space.txt
runs 0 --sampler jittered -d 1 -n 16 -m 100 --shifts 4 --engine host_direct --integrand coefficients:file=line.txt
awk -v z="$(column z_score)" 'BEGIN { exit !(z < 4 && z > -4 && z != 0) }' || complain "line: $(table)"
runs 0 --sampler white -d 3 -n 27 -m 100 --shifts 4 --engine host_direct --integrand coefficients:file=space.txt
awk -v z="$(column z_score)" 'BEGIN { exit !(z < 4 && z > -4 && z != 0) }' || complain "space: $(table)"
near 'space' "$(column white)" 0.11111111111111 1e-12

# ---- coefficients of the sphere ----

printf '# Y_40\n4,0,1,0\n' >harmonic.txt
runs 0 --sampler healpix-jittered -n 48 -m 20 --integrand harmonic:degree=4
harmonic=$(table | sed 1d | cut -d, -f1-3,9)
measured=$(column measured)
runs 0 --sampler healpix-jittered -n 48 -m 20 --integrand coefficients:file=harmonic.txt
[[ $(table | sed 1d | cut -d, -f1-3,9) == "$harmonic" ]] || complain "a harmonic: $(table), not $harmonic"
near 'a harmonic, measured' "$(column measured)" "$measured" 1e-9
"$program" angular --engine host_direct --sampler white-sphere -n 6 -l 6 --coefficients clm.npy -o clm.csv 2>err || complain "angular: $(<err)"
runs 0 --sampler fibonacci -n 32 -l 8 --engine host_direct --integrand coefficients:file=clm.npy
near 'pairs of the sphere' "$(key pairwise_variance)" "$(column predicted)" 1e-9
near 'integral of a density' "$(key integral)" 6 1e-12
runs 0 --sampler white-hemisphere -n 16 -m 20 --integrand coefficients:file=harmonic.txt
refuses 'on the hemisphere' --sampler white-hemisphere -n 16 --integrand coefficients:file=clm.npy

# ---- pixels ----

# bytes of an image of 5 x 11 and one of 4 x 8, of which the second is a box
make_image() { # SHAPE BYTES...
    local header="{'descr': '|u1', 'fortran_order': False, 'shape': $1, }"
    printf '\x93NUMPY\x01\x00\x76\x00%-117s\n' "$header"
    printf '%b' "$(printf '\\x%02x' "${@:2}")"
}
make_image '(5, 11)' {1..55} >slope.npy
make_image '(4, 8)' 1 1 0 0 0 0 0 0 1 1 0 0 0 0 0 0 {0,0,0,0}{,,,} >box.npy
runs 0 --sampler white -n 16 -m 20 --integrand box:sides=0.5x0.25
box=$(column predicted)
for engine in host_direct torus_direct torus_nufft; do
    runs 0 --engine $engine --sampler white -n 16 -m 20 --integrand pixels:file=box.npy
    near "a box by $engine" "$(column predicted)" "$box" 1e-5
done
near 'energy of the box' "$(column white)" 0.0068359375 1e-12
runs 0 --sampler jittered -n 16 -m 200 --shifts 4 --integrand pixels:file=slope.npy
awk -v z="$(column z_score)" 'BEGIN { exit !(z < 4 && z > -4 && z != 0) }' || complain "slope: $(table)"
near 'integral of the slope' "$(key integral)" 28 1e-12
"$program" plan variance --engine host_direct --sampler white -n 16 --integrand pixels:file=slope.npy >out 2>err || complain "plan: $(<err)"
grep -q '^# phase: images; .* their powers, from pixels$' out || complain "phases: $(<out)"
{
    make_image '(1000, 1000)' 1
    head -c 999999 /dev/zero
} >large.npy
runs 0 --engine host_direct --sampler white -n 8 -k 1 --shifts 0 --memory 400M --integrand pixels:file=large.npy
! "$program" variance --engine host_direct --sampler white -n 8 -k 1 --shifts 0 --memory 1M --integrand pixels:file=large.npy >out 2>err ||
    complain "a large image: $(<out)"
grep -q 'needs .* of memory, above the limit of 1.05e+06' err || complain "a large image: $(<err)"
# pairs are exact: they lie within the bracket
runs 0 --sampler sobol:scramble=none -n 16 -k 40 --integrand pixels:file=slope.npy
awk -v a="$(column lower)" -v x="$(key pairwise_variance)" -v b="$(column upper)" \
    'BEGIN { exit !(a < x && x < b && b > 0) }' || complain "pairs of pixels: $(<out)"
make_image '(3, 3)' 7 7 7 7 7 7 7 7 7 >flat.npy
runs 0 --sampler white -n 8 -m 3 --integrand pixels:file=flat.npy
[[ $(table | sed 1d) == 8,0,0,0,0,0,0,,0 ]] || complain "a flat image: $(table)"
refuses 'are the same file' --sampler white -n 8 --integrand pixels:file=slope.npy -o slope.npy
refuses 'is no NPY array' --sampler white -n 8 --integrand pixels:file=wave.txt
refuses 'needs its file' --sampler white -n 8 --integrand pixels
refuses 'pixels have an axis for each of the 3 dimensions' --sampler white -d 3 -n 8 --integrand pixels:file=slope.npy

# ---- images on the torus ----

# floats of digits as letters: numbers of many sizes. The same of any batch, and on the host
{
    printf 'Pf 64 48 -1\n'
    printf '%d' {1000..4071}
} >digits.pfm
runs 0 --sampler white -n 100 -m 40 --shifts 4 -k 60 --integrand map:file=digits.pfm
awk -v z="$(column z_score)" 'BEGIN { exit !(z < 4 && z > -4 && z != 0) }' || complain "an image: $(table)"
awk -v a="$(column lower)" -v x="$(column white)" -v b="$(column upper)" 'BEGIN { exit !(a > .8 * x && b < 1.2 * x) }' ||
    complain "white noise: $(table)"
digits=$(table | cut -d, -f6,7)
runs 0 --sampler white -n 100 -m 40 --shifts 4 -k 60 --memory 2M --integrand map:file=digits.pfm
[[ $(table | cut -d, -f6,7) == "$digits" ]] || complain "in another batch: $(table), not $digits"
runs 0 --engine host_direct --sampler white -n 100 -m 40 --shifts 4 -k 20 --integrand map:file=digits.pfm
near 'an image on the host' "$(column measured)" "$(sed 1d <<<"$digits" | cut -d, -f1)" 1e-9
runs 1 --sampler white -n 8 --memory 10K --integrand map:file=digits.pfm
says 'digits.pfm: 64 x 48 pixels take 12K of memory, above 10K, the limit of --memory'
refuses 'points have 3 dimensions, and it has 2 to 2' --sampler white -d 3 -n 8 --integrand map:file=digits.pfm
head -c 4000 digits.pfm >short.pfm
refuses '64 x 48 pixels take at least 12288 bytes, and 3988 are left' --sampler white -n 8 --integrand map:file=short.pfm

# ---- files are known as such ----

cp wave.txt kept.txt
refuses 'are the same file' --sampler white -n 8 --integrand coefficients:file=wave.txt -o wave.txt
refuses 'are the same file' --sampler white -n 8 --integrand disk --integrand coefficients:file=./wave.txt -o "../${PWD##*/}/wave.txt"
cmp -s wave.txt kept.txt || complain 'an input was overwritten'
mkdir folder
cp wave.txt folder/own.txt
cat >folder/scene.yaml <<'END'
scene: 1
results:
  - {result: variance, name: own, samplers: white, points: 8, realizations: 3, max-frequency: 4, integrand: ['coefficients:file=own.txt', disk]}
END
run_scene() { # OUTPUT
    "$program" run folder/scene.yaml -o "$1" >out 2>err </dev/null || complain "scene: $(<err)"
}
run_scene first
run_scene second
grep -q '^own,variance,1,1,' out || complain "not from the cache: $(<out)"
cmp -s <(grep -v '^#' first/own.csv) <(grep -v '^#' second/own.csv) || complain 'the cache has other numbers'
printf '0,0,1,0\n' >folder/own.txt
run_scene third
! cmp -s <(grep -v '^#' first/own.csv) <(grep -v '^#' third/own.csv) || complain 'the scene has numbers of the old file'

# ---- what is refused ----

fails() { # PART ROWS
    printf '%s\n' "${@:2}" >bad.txt
    refuses "$1" --sampler white -n 8 --integrand coefficients:file=bad.txt
}
fails 'line 1: the coefficient at k = (1, 0) is that of no real function without its opposite' 1,0,0.5,0.3
fails 'lines 1 and 2: the coefficients at k = (1, 0) and k = (-1, 0) are those of no real function' 1,0,0.5,0.3 -1,0,0.5,0.3
fails 'imaginary part 0.3' 0,0,0.5,0.3
fails 'is given twice' 0,0,1,0 0,0,1,0
fails 'not a finite number' 0,0,nan,0
refuses 'needs its file' --sampler white -n 8 --integrand coefficients
refuses 'standard input' --sampler white -n 8 --integrand coefficients:file=-
refuses 'no regular file' --sampler white -n 8 --integrand coefficients:file=/dev/zero
refuses 'coefficients have an axis for each of the 3 dimensions' --sampler white -d 3 -n 8 -k 2 --integrand coefficients:file=set.npy
runs 1 --sampler white -n 8 --integrand coefficients:file=none.txt
says none.txt
finish

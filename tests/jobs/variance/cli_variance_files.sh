#!/usr/bin/env bash
# cli_variance_files.sh PROGRAM: pointspec variance of point files: halves, single sets, weights, the sphere, streams, limits
# of memory; saved results, and what else is refused.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" variance "$1"

columns=points,predicted,predicted_error,lower,upper,measured,measured_error,z_score,white
table() { grep -v '^#' out; }
row() { table | sed 1d; }
is() { # KEY VALUE
    [[ $(key "$1") == "$2" ]] || complain "$1: $(key "$1"), not $2"
}
same() { # WHAT ROWS: those of the last run, too
    [[ $(row) == "$2" ]] || complain "$1: $(row), not $2"
}
make() { "$program" sample "$@" 2>err || complain "sample $*: $(<err)"; }
# the referee of the host, and few frequencies, for what is not about the spectrum
few=(--engine host_direct -k 4)

make --sampler jittered -n 16 -m 20 -o sets.npy
make --sampler jittered -n 16 -m 20 -o sets.txt
make --sampler jittered -n 16 -m 1 -o one.txt

# ---- halves: as a sampler's realizations 0..M-1 and M..2M-1 -------------------------------------

runs 0 "${few[@]}" --integrand disk --in-place sets.npy
[[ $(table | head -n 1) == "$columns" ]] || complain "columns: $(table)"
is realizations 10
is measured_sets 10
is white_power 1
is most_power_is 'assumed: the largest that was measured, at least 1'
is input_format npy
is seed 1
of_files=$(row | cut -d, -f1-4,6-)
runs 0 "${few[@]}" --integrand disk --in-place --sampler jittered -n 16 -m 10
[[ $(row | cut -d, -f1-4,6-) == "$of_files" ]] || complain "files: $of_files, sampler: $(row)"
runs 0 "${few[@]}" --integrand disk sets.npy
whole=$(row)
[[ $(cut -d, -f1-5 <<<"$whole") == "$(row | cut -d, -f1-5)" && $(cut -d, -f8 <<<"$whole") != '' ]] || complain "moved: $whole"
runs 0 "${few[@]}" --integrand disk sets.npy -s 2
[[ $(row) != "$whole" && $(row | cut -d, -f1-5) == "$(cut -d, -f1-5 <<<"$whole")" ]] || complain "another seed: $(row)"
runs 0 "${few[@]}" --integrand disk sets.npy --shifts 0
is trials none
[[ $(row | cut -d, -f6-8) == ,, ]] || complain "no shifts: $(row)"
# then all of them predict, not a half
is realizations 20
is measured_sets 0
# an odd number: one more predicts
runs 0 "${few[@]}" --integrand disk --select-sets 1..5 sets.npy
is realizations 3
is measured_sets 2
# another format, several files as realizations, standard input, a pipe
runs 0 "${few[@]}" --integrand disk sets.txt
same 'as text' "$whole"
cut_sets() { "$program" convert --select-sets "$1" sets.npy -o "$2" 2>err || complain "convert $*: $(<err)"; }
cut_sets 1..7 a.npy
cut_sets 8..20 b.txt
runs 0 "${few[@]}" --integrand disk a.npy b.txt
same 'two files' "$whole"
is input_format 'npy; utk-text'
is input '2 files, 10 realizations to predict, the others to measure'
for file in sets.txt sets.npy; do
    "$program" variance "${few[@]}" --integrand disk - <$file >out 2>err || complain "stdin: $(<err)"
    same "standard input, $file" "$whole"
    # shellcheck disable=SC2002 # a pipe, which cannot be read twice
    cat $file | "$program" variance "${few[@]}" --integrand disk - >out 2>err || complain "a pipe: $(<err)"
    same "a pipe, $file" "$whole"
done
# shellcheck disable=SC2002
cat b.txt | "$program" variance "${few[@]}" --integrand disk a.npy - >out 2>err || complain "a file and a stream: $(<err)"
same 'a file and a stream' "$whole"
runs 0 "${few[@]}" --integrand disk a.npy <(cat b.txt)
same 'a file and a pipe' "$whole"
# different N: the mean, as of samplers
make --sampler white -n 8 -s 5 -m 2 -o few.txt
make --sampler white -n 24 -s 6 -m 2 -o many.txt
runs 0 "${few[@]}" --integrand disk --in-place few.txt many.txt
is realizations 2
cp few.txt few_more.txt && cp many.txt many_more.txt
runs 0 "${few[@]}" --integrand disk --in-place --select-sets 1 few.txt many.txt few_more.txt many_more.txt
is points 16
is points_smallest 8
is points_largest 24
[[ $(key white_power) == 1.333333333333333* ]] || complain "white_power: $(key white_power)"
[[ $(row | cut -d, -f1) == 16 ]] || complain "points: $(row)"

# ---- single sets ---------------------------------------------------------------------------------

runs 0 --engine host_direct --integrand disk --integrand gaussian one.txt
is shifts 100
is measured_sets 1
is most_power 16
is most_power_is 'a bound'
[[ $(key pairwise_variance | wc -l) -ge 1 && $(row | cut -d, -f4 | sort -u) == 0 ]] || complain "single: $(<out)"
runs 0 --engine host_direct --integrand gaussian one.txt --shifts 40
is shifts 40
awk -v p="$(key pairwise_variance)" -v row="$(row)" 'BEGIN { split(row, v, ","); r = 1e-12 * v[9]
    exit !(v[4] - r <= p && p <= v[5] + r && v[7] > 0 && v[3] == 0) }' || complain "bracket: $(key pairwise_variance), $(row)"
runs 0 --engine host_direct --integrand gaussian one.txt --in-place
[[ $(key shifts) == 1 && $(row | cut -d, -f7,8) == , ]] || complain "in place: $(row)"
# a sampler without randomness is one set; moves of it have an error, also where they are of one realization
runs 0 --engine host_direct --integrand gaussian --sampler hammersley -n 16 -m 1 --shifts 30
[[ $(key pairwise_variance) == [0-9]* && $(row | cut -d, -f7) == [0-9]* && $(row | cut -d, -f8) != '' ]] || complain "hammersley: $(<out)"
runs 0 "${few[@]}" --integrand gaussian --sampler white -n 16 -m 2
[[ -z $(key pairwise_variance) ]] || complain 'pairs of a random sampler'

# ---- weights -------------------------------------------------------------------------------------

grep -v '^#' one.txt | awk '{ print $1, $2, 1 + NR % 3 }' >weighted.txt
awk '{ print $3 }' weighted.txt >weights.txt
runs 0 --engine host_direct --integrand disk --columns xyw weighted.txt
weighted=$(row)
[[ $(key white_power) == 1.1[0-9]* ]] || complain "white_power: $(key white_power)"
runs 0 --engine host_direct --integrand disk --weights weights.txt one.txt
same 'weights of a file' "$weighted"
runs 0 --engine host_direct --integrand disk --weights equal --columns xyw weighted.txt
equal=$(row)
runs 0 --engine host_direct --integrand disk one.txt
same 'weights that are dropped' "$equal"
echo 1 >>weights.txt
refuses '"weights.txt" holds 17 weights, but a set has 16 points' --integrand disk --weights weights.txt one.txt
sed 's/[0-9]*$/0/' weighted.txt >none.txt
refuses 'set 1: all weights are 0' --integrand disk --columns xyw none.txt

# ---- reading: boxes, the sphere, the hemisphere ---------------------------------------------------

grep -v '^#' one.txt | awk '{ printf "%.17g %.17g\n", 8 * $1, 8 * $2 }' >box.txt
runs 0 --engine host_direct --integrand disk --box 0,8 box.txt
same 'a box' "$equal"
is box 0,8
refuses 'is outside [0,1)' --integrand disk box.txt
runs 0 "${few[@]}" --integrand disk --wrap box.txt
make --sampler zphi -n 32 -m 6 -o sphere.txt
make --sampler white-hemisphere -n 32 -m 1 -o dome.txt
runs 0 --engine host_direct --integrand cap sphere.txt
is domain sphere
sphere=$(row)
runs 0 --engine host_direct --integrand cap --domain sphere sphere.txt
same 'where it is said' "$sphere"
runs 0 --engine host_direct --integrand constant --domain sphere sphere.txt
is domain sphere
runs 0 --engine host_direct --integrand cap --hemisphere dome.txt
is domain 'hemisphere, even degrees'
[[ $(key integral) == 3.14159265358979* ]] || complain "integral: $(key integral)"
make --sampler jittered:lift=hemisphere -n 16 -m 20 -o domes.txt
runs 0 --engine host_direct --integrand cap --hemisphere --in-place domes.txt
dome=$(row | cut -d, -f1,6)
runs 0 --engine host_direct --integrand cap --lift hemisphere --in-place sets.txt
is domain 'hemisphere, even degrees'
awk -v a="$(row | cut -d, -f6)" -v b="${dome#*,}" 'BEGIN { exit !(a - b <= 1e-9 * b && b - a <= 1e-9 * b) }' ||
    complain "lifted: $(row), not $dome"

# ---- memory: smaller batches, the same bits -------------------------------------------------------

runs 0 "${few[@]}" --integrand disk --shifts 500 sets.npy
whole=$(row)
for limit in 1M 150K; do
    runs 0 "${few[@]}" --integrand disk --shifts 500 --memory $limit sets.npy
    same "$limit" "$whole"
done
runs 1 "${few[@]}" --integrand disk --shifts 100000 --memory 150K sets.npy
says 'measuring sets of 16 points, 100000 shifts each, needs 2.289M of memory, above 150K, the limit of --memory; --shifts 0 only predicts'
"$program" plan variance "${few[@]}" --integrand disk --shifts 100000 --memory 150K sets.npy >out 2>err && complain 'plan takes it'
[[ $(<err) == *'the limit of --memory'* ]] || complain "plan: $(<err)"
"$program" plan variance "${few[@]}" --integrand disk --shifts 500 sets.npy >out 2>err || complain "plan: $(<err)"
grep -q '^# phase: trials; .*8e+04 values of integrands, .* of memory' out || complain "plan: $(grep phase out)"
make --sampler white -n 4000 -m 20 -o large.txt
# shellcheck disable=SC2002
cat large.txt | "$program" variance "${few[@]}" --integrand disk --memory 500K - >out 2>err && complain 'a stream without end'
[[ $(<err) == *'standard input: 9 sets take more than 500K, the limit of --memory, and are kept in memory'*'give a file'* ]] || complain "stream: $(<err)"

# ---- what is refused -----------------------------------------------------------------------------

"$program" power --engine host_direct --sampler jittered -n 16 -m 3 -k 2 -o saved.csv 2>err || complain "$(<err)"
"$program" power --engine host_direct --sampler jittered -n 16 -m 3 -k 2 -o saved.json 2>err || complain "$(<err)"
"$program" power --engine host_direct --sampler jittered -n 16 -m 3 -k 2 -o saved.jsonl 2>err || complain "$(<err)"
"$program" power --engine host_direct --sampler jittered -n 16 -m 3 -k 2 -o array.npy 2>err || complain "$(<err)"
"$program" angular --engine host_direct sphere.txt -l 2 -o angular.json 2>err || complain "$(<err)"
for file in saved.csv saved.json saved.jsonl array.npy; do
    refuses "\"$file\" holds no points: pointspec power saved it, of sampler jittered, N = 16, and" --integrand disk $file
    says '; use pointspec variance --sampler jittered -n 16'
done
refuses '"angular.json" holds no points: pointspec angular saved it, N = 32, and' --integrand cap angular.json
says '; use pointspec variance on the point files'
# a table beside points is none of theirs
"$program" power --engine host_direct sets.npy -k 2 -o sets.json 2>err || complain "$(<err)"
runs 0 "${few[@]}" --integrand disk sets.npy
refuses '--sampler does not go with one.txt' --sampler white --integrand disk one.txt
refuses '-m does not go with point files' -m 5 --integrand disk one.txt
refuses '--weights does not go with --sampler' --sampler white --weights weights.txt --integrand disk
refuses '--hemisphere does not go with --sampler' --sampler white-hemisphere --hemisphere --integrand cap
refuses '--wrap does not go with --sampler' --sampler white --wrap --integrand disk
refuses '-l is for points of the sphere' --integrand disk -l 4 one.txt
refuses '-k is for points of the torus' --integrand cap -k 4 sphere.txt
refuses '-l is for points of the sphere' --integrand disk -l 4 --sampler jittered
refuses '-k is for points of the torus' --integrand cap -k 4 --sampler jittered:lift=hemisphere
refuses '-d is for points of the torus' --integrand cap -d 3 --sampler healpix -n 48
refuses 'integrand cap: there is none on the torus' --integrand cap --domain torus one.txt
refuses 'integrand disk: there is none on the sphere' --integrand cap --integrand disk --domain sphere sphere.txt
make --sampler white -n 8 -d 3 -o three.txt
refuses 'integrand half-plane: points have 3 dimensions' --integrand half-plane three.txt
runs 1 --integrand disk none-such.txt
says 'cannot read none-such.txt'
refuses 'unknown integrand "dsk"' --integrand dsk one.txt

# ---- scenes --------------------------------------------------------------------------------------

cat >scene.yaml <<'END'
scene: 1
results:
  - {result: variance, name: files, files: sets.npy, engine: host_direct, max-frequency: 4, integrand: disk, plot: false}
END
"$program" run --cache 0 scene.yaml -o made >out 2>err </dev/null || complain "scene: $(<err)"
grep -v '^#' made/files.csv >rows
runs 0 "${few[@]}" --integrand disk sets.npy
cmp -s rows <(table) || complain "scene: $(<rows), not $(table)"
if command -v gnuplot >/dev/null; then
    runs 0 "${few[@]}" --integrand disk sets.npy --plot picture.svg
    grep -q '>files<' picture.svg || complain 'no picture of files'
fi
finish

#!/usr/bin/env bash
# cli_check.sh PROGRAM: pointspec check against saved spectra of all kinds: verdicts, exit codes, header, what it refuses.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" check "$1"

# Small sets: the referee is done before a device is open. The first check is on one.
host=(--engine host_direct)

column() { # NAME ROW: of the table
    awk -F, -v name="$1" -v row="$2" '/^#/ { next }
        !at { for (i = 1; i <= NF; i++) if ($i == name) at = i; next } ++n == row { print $at }' out
}
rows() { grep -vc '^#' out; }

# ---- the torus: the question is that of the file ----
"$program" power "${host[@]}" --sampler jittered -n 64 -m 40 -k 12 -o saved.npz
runs 0 --against saved.npz --sampler jittered -m 8
[[ $(key verdict) == same && $(key different) == "0 of 12 rings" && $(key seed) == 2 ]] || complain "header: $(<out)"
[[ $(key points) == 64 && $(key realizations) == 8 && $(key saved_realizations) == 40 ]] || complain "question: $(<out)"
[[ $(key max_frequency) == 12 && $(key false_alarm_rate) == 0.001 && $(rows) == 13 ]] || complain "rows: $(<out)"
"$program" plan check --against saved.npz --sampler jittered >planned.txt 2>err || complain "plan: $(<err)"
[[ $(grep -c ',chosen,' planned.txt) == 1 && $(<planned.txt) == *'# skip: frequencies -k'* ]] || complain "plan: $(<planned.txt)"
"$program" plan check --sampler jittered >planned.txt 2>err && complain "plan without --against"
[[ $(<err) == *'--against FILE, the saved spectrum, or --homogeneous is needed'* ]] || complain "plan without --against: $(<err)"
[[ $(grep '^bin' out) == bin,frequency,saved,saved_error,measured,measured_error,z_score,p_value,adjusted_p_value,detectable_change,verdict ]] ||
    complain "columns: $(<out)"
cp out checked
"$program" power "${host[@]}" --sampler jittered -n 64 -m 40 -k 12 -o table.csv
cut -d , -f 1,2 checked >both && cp table.csv out && saved=$(column power 2) && cp checked out
[[ $(column saved 2) == "$saved" ]] || complain "saved power: $saved, $(<out)"
runs 0 "${host[@]}" --against saved.npz --sampler jittered
[[ $(key realizations) == 40 ]] || complain "as many realizations as saved: $(<out)"
# the same realizations: no difference at all, and that is said
runs 0 "${host[@]}" --against saved.npz --sampler jittered --seed 1
[[ $(key note) == *"not independent"* && $(column z_score 3) == 0 && $(column p_value 12) == 1 ]] || complain "same seed: $(<out)"

# files; one set has no standard error of its own
"$program" sample --sampler jittered -n 64 -m 6 -s 9 -o sets.txt
runs 0 "${host[@]}" --against saved.npz sets.txt
runs 0 "${host[@]}" --against saved.npz --select-sets 2 sets.txt
[[ $(key realizations) == 1 && -z $(column measured_error 1) && $(column verdict 1) == same ]] || complain "one set: $(<out)"
"$program" sample --sampler jittered -n 64 -m 6 -s 9 --quiet -o sets.rps
runs 0 "${host[@]}" --against saved.npz -n 64 sets.rps

# another sampler: exit 3, the table all the same, and the worst rings in the sentence
runs 3 "${host[@]}" --against saved.npz --sampler white -m 8
says 'not the spectrum of "saved.npz"'
says 'ring 1 (power '
[[ $(key verdict) == different && $(column verdict 1) == different && $(column z_score 1) != -* && $(rows) == 13 ]] ||
    complain "white: $(<out)"
runs 3 "${host[@]}" --against saved.npz --sampler white -m 8 -o verdict.json
[[ ! -s out && $(<verdict.json) == *'"command": "check"'*'"different"'* ]] || complain "json"
# the rate decides: a p value between the two rates
runs 0 "${host[@]}" --against saved.npz --sampler jittered -m 8 --seed 3 --false-alarm-rate 1e-9
p=$(key adjusted_p_value)
awk -v p="$p" 'BEGIN { exit !(p > 0 && p <= 1) }' || complain "adjusted_p_value: $p"

# ---- other kinds of spectra: shells, subsets, normalization, several dimensions, all N ----
"$program" power "${host[@]}" --sampler halton -d 3 -n 32 -m 2 -k 3 --bins shells --normalize effective -o shells.npz
runs 0 "${host[@]}" --against shells.npz --sampler halton
[[ $(key different) == "0 of 11 shells" && $(key normalization) == effective* && $(key dimension) == 3 ]] || complain "shells: $(<out)"
[[ $(column z_score 1) == 0 && $(column saved_error 1) == 0 ]] || complain "a deterministic set is itself: $(<out)"
runs 3 "${host[@]}" --against shells.npz --sampler hammersley
says 'shell 1 (power '
# rings by other rules: bins that begin with 0, and borders that depend on the number of points
for bins in floor width=3/2 relative=1/8; do
    "$program" power "${host[@]}" --sampler halton -n 48 -m 2 -k 5 --bins "$bins" -o bins.npz
    runs 0 "${host[@]}" --against bins.npz --sampler halton
    [[ $(key different) == "0 of "*" rings" && $(key bins) == "$bins" ]] || complain "$bins: $(<out)"
    [[ $(column z_score 1) == 0 ]] || complain "$bins, a deterministic set is itself: $(<out)"
done
"$program" power "${host[@]}" --sampler white -d 4 -n 32 -m 20 -k 5 --per-ring 8 -s 5 -o subset.npz
runs 0 "${host[@]}" --against subset.npz --sampler white -m 9
[[ $(key per_ring) == 8 && $(key seed) == 6 ]] || complain "subset: $(<out)"
# the subset is that of the saved seed: the same realizations have the same powers
runs 0 "${host[@]}" --against subset.npz --sampler white -m 20 -s 5
[[ $(column z_score 5) == 0 ]] || complain "another subset: $(<out)"
printf '0.1 0.2\n0.7 0.4\n0.3 0.9\n#\n0.2 0.2\n0.6 0.5\n' >mixed.txt
"$program" power "${host[@]}" -k 3 mixed.txt -o mixed.npz
runs 0 "${host[@]}" --against mixed.npz mixed.txt
[[ "$(key points) $(key points_smallest) $(key points_largest)" == "2.5 2 3" ]] || complain "numbers of points: $(<out)"
# sets of any N in the saved range, although none of them is the mean
for n in 2 3; do
    "$program" sample --sampler white -n "$n" -m 9 -o "of_$n.txt"
    runs 0 "${host[@]}" --against mixed.npz "of_$n.txt"
done
"$program" sample --sampler white -n 4 -m 2 -o of_4.txt
refuses 'these sets have 4 points, those of "mixed.npz" have 2 to 3' --against mixed.npz of_4.txt
cat of_4.txt <(echo '#') of_4.txt <(printf '#\n0.1 0.2\n') >wide.txt
runs 0 "${host[@]}" --against mixed.npz wide.txt

# ---- the sphere ----
"$program" angular "${host[@]}" --sampler healpix-jittered:nside=2 -m 40 -l 10 -o sphere.npz
runs 0 "${host[@]}" --against sphere.npz --sampler healpix-jittered:nside=2 -m 10
[[ $(key different) == "0 of 10 degrees" && $(grep '^degree' out) == degree,saved,* && $(column degree 10) == 10 ]] ||
    complain "degrees: $(<out)"
runs 3 "${host[@]}" --against sphere.npz --sampler white-sphere -m 10
says 'degree 2 (power '
"$program" angular "${host[@]}" --sampler white-hemisphere -n 16 --hemisphere -m 20 -l 8 -o even.npz
runs 0 "${host[@]}" --against even.npz --sampler white-hemisphere -m 5
[[ $(key different) == "0 of 4 degrees" && $(key domain) == hemisphere* ]] || complain "hemisphere: $(<out)"

# ---- one realization on both sides: equal or nothing can be said ----
"$program" power "${host[@]}" --sampler hammersley -n 20 -k 5 -o one.npz
runs 0 "${host[@]}" --against one.npz --sampler hammersley
refuses 'save at least 2 realizations' --against one.npz --sampler white

# ---- two saved spectra: nothing is computed ----
"$program" power "${host[@]}" --sampler jittered -n 64 -m 30 -k 12 -s 7 -o again.npz
"$program" power "${host[@]}" --sampler white -n 64 -m 30 -k 12 -s 7 -o white.npz
runs 0 --against saved.npz again.npz
[[ $(key verdict) == same && $(key different) == "0 of 12 rings" && $(key measured) == again.npz && $(key against) == saved.npz &&
    $(key realizations) == 30 && $(key saved_realizations) == 40 && $(key points) == 64 && $(key engine) == none && $(rows) == 13 ]] ||
    complain "two saved: $(<out)"
# the same numbers as where the other side is measured anew, but for the digits of the error bounds
grep -v '^#' out >of_files
runs 0 "${host[@]}" --against saved.npz --sampler jittered -m 30 -s 7
grep -v '^#' out | cmp -s - of_files || complain "measured and saved: $(diff of_files <(grep -v '^#' out))"
runs 3 --against saved.npz white.npz -o both.csv
says 'not the spectrum of "saved.npz"'
says 'ring 1 (power '
grep -q '^# verdict: different' both.csv || complain "different: $(<both.csv)"
runs 0 --against saved.npz saved.npz
[[ $(key note) == *"not independent"* && $(column z_score 3) == 0 && $(column p_value 12) == 1 ]] || complain "itself: $(<out)"
for of in shells bins sphere even one; do
    runs 0 --against $of.npz $of.npz
    [[ $(column z_score 1) == 0 ]] || complain "$of itself: $(<out)"
done
"$program" plan check --against saved.npz again.npz >planned.txt 2>err || complain "plan: $(<err)"
[[ $(<planned.txt) == *'both spectra were saved'* && $(grep -c ',chosen,' planned.txt) == 1 ]] || complain "plan: $(<planned.txt)"
# other kinds and frequencies: one sentence
kinds='spectra of two kinds are not compared'
refuses '"sphere.npz" has degrees of the sphere up to 10, normalization power, and "saved.npz" has rings of the torus in 2 dimensions up to 12, normalization power: '"$kinds" \
    --against saved.npz sphere.npz
"$program" power "${host[@]}" --sampler jittered -n 64 -m 9 -k 11 -o fewer.npz
refuses 'up to 11, normalization power, and' --against saved.npz fewer.npz
"$program" power "${host[@]}" --sampler jittered -n 64 -m 9 -k 12 --normalize effective -o effective.npz
refuses 'normalization effective, and' --against saved.npz effective.npz
"$program" power "${host[@]}" --sampler jittered -n 64 -m 9 -k 12 --bins floor -o floor.npz
refuses 'rings by floor of the torus in 2 dimensions' --against saved.npz floor.npz
"$program" power "${host[@]}" --sampler white -d 4 -n 32 -m 20 -k 5 --per-ring 8 -s 6 -o other_subset.npz
refuses '8 of every ring by the seed 6' --against subset.npz other_subset.npz
runs 0 --against subset.npz subset.npz
modes=$(grep -v '^#' out)
runs 0 "${host[@]}" --against subset.npz --sampler white -m 20 -s 5
[[ $(grep -v '^#' out) == "$modes" ]] || complain "a subset that is saved has other errors than one that is measured"
refuses 'even degrees of the hemisphere' --against sphere.npz even.npz
"$program" power "${host[@]}" --sampler jittered -n 81 -m 9 -k 12 -o larger.npz
refuses 'the sets of "larger.npz" have 81 points, those of "saved.npz" have 64; spectra change' --against saved.npz larger.npz
refuses '-m does not go with two saved spectra' --against saved.npz again.npz -m 4
refuses '--box does not go with two saved spectra' --against saved.npz again.npz --box 0,1
refuses '--engine does not go with two saved spectra' "${host[@]}" --against saved.npz again.npz
refuses '--tol does not go with two saved spectra' --against saved.npz again.npz --tol 1e-3
refuses '--precision does not go with two saved spectra' --against saved.npz again.npz --precision double
# ---- what is refused ----
refuses '--against FILE, the saved spectrum, or --homogeneous is needed' sets.txt
refuses 'nothing to take a spectrum of' --against saved.npz
refuses 'one sampler is compared' --against saved.npz --sampler white --sampler jittered
refuses 'not .npy' --against saved.npz sets.txt -o x.npy
refuses '--against "saved.npz" are the same file' --against saved.npz sets.txt -o saved.npz
refuses 'standard input is none' --against - sets.txt
runs 1 --against no-such.npz sets.txt
says 'cannot read no-such.npz'
refuses 'is not above 0 and below 1' --against saved.npz sets.txt --false-alarm-rate 1
refuses 'above 0' --against saved.npz sets.txt --false-alarm-rate 0
refuses 'did you mean --against' --agains saved.npz sets.txt
"$program" sample --sampler white -n 63 -o fewer.txt
refuses 'these sets have 63 points, those of "saved.npz" have 64' --against saved.npz fewer.txt
"$program" sample --sampler white -n 64 -d 3 -o space.txt
refuses 'the dimension asked for is 2' --against saved.npz space.txt
refuses 'makes points of the sphere' --against saved.npz --sampler fibonacci
refuses 'makes points of the torus' --against sphere.npz --sampler halton

refuses 'is no saved spectrum' --against sets.txt sets.txt
for format in csv json jsonl; do
    "$program" power "${host[@]}" --sampler jittered -n 64 -m 6 -k 12 -o table.$format
    refuses "\"table.$format\" is no saved spectrum: pointspec power and angular save one with -o FILE.npz" --against table.$format sets.txt
    refuses "\"table.$format\" is no saved spectrum: pointspec power and angular save one with -o FILE.npz" --against saved.npz table.$format
done
head -c -1 saved.npz >bad.npz
refuses '"bad.npz" is no NPZ file of pointspec, or damaged or cut off' --against bad.npz sets.txt
printf '1 0\n0 2\n' >list.txt
"$program" power "${host[@]}" --sampler jittered -n 64 -m 6 --frequencies list.txt -o list.npz
refuses 'list of frequencies' --against list.npz sets.txt
finish

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
"$program" power "${host[@]}" --sampler jittered -n 64 -m 40 -k 12 -o saved.json
runs 0 --against saved.json --sampler jittered -m 8
[[ $(key verdict) == same && $(key different) == "0 of 12 rings" && $(key seed) == 2 ]] || complain "header: $(<out)"
[[ $(key points) == 64 && $(key realizations) == 8 && $(key saved_realizations) == 40 ]] || complain "question: $(<out)"
[[ $(key max_frequency) == 12 && $(key false_alarm_rate) == 0.001 && $(rows) == 13 ]] || complain "rows: $(<out)"
"$program" plan check --against saved.json --sampler jittered >planned.txt 2>err || complain "plan: $(<err)"
[[ $(grep -c ',chosen,' planned.txt) == 1 && $(<planned.txt) == *'# skip: frequencies -k'* ]] || complain "plan: $(<planned.txt)"
"$program" plan check --sampler jittered >planned.txt 2>err && complain "plan without --against"
[[ $(<err) == *'--against FILE, the saved spectrum, or --homogeneous is needed'* ]] || complain "plan without --against: $(<err)"
[[ $(grep '^bin' out) == bin,frequency,saved,saved_error,measured,measured_error,z_score,p_value,adjusted_p_value,detectable_change,verdict ]] ||
    complain "columns: $(<out)"
[[ $(column saved 1) == "$(sed -n 's/^ *{"bin": 1, .*"power": \([^,]*\),.*/\1/p' saved.json)" ]] || complain "saved power: $(<out)"
runs 0 "${host[@]}" --against saved.json --sampler jittered
[[ $(key realizations) == 40 ]] || complain "as many realizations as saved: $(<out)"
# the same realizations: no difference at all, and that is said
runs 0 "${host[@]}" --against saved.json --sampler jittered --seed 1
[[ $(key note) == *"not independent"* && $(column z_score 3) == 0 && $(column p_value 12) == 1 ]] || complain "same seed: $(<out)"

# files; one set has no standard error of its own
"$program" sample --sampler jittered -n 64 -m 6 -s 9 -o sets.txt
runs 0 "${host[@]}" --against saved.json sets.txt
runs 0 "${host[@]}" --against saved.json --select-sets 2 sets.txt
[[ $(key realizations) == 1 && -z $(column measured_error 1) && $(column verdict 1) == same ]] || complain "one set: $(<out)"
"$program" sample --sampler jittered -n 64 -m 6 -s 9 --quiet -o sets.rps
runs 0 "${host[@]}" --against saved.json -n 64 sets.rps

# another sampler: exit 3, the table all the same, and the worst rings in the sentence
runs 3 "${host[@]}" --against saved.json --sampler white -m 8
says 'not the spectrum of "saved.json"'
says 'ring 1 (power '
[[ $(key verdict) == different && $(column verdict 1) == different && $(column z_score 1) != -* && $(rows) == 13 ]] ||
    complain "white: $(<out)"
runs 3 "${host[@]}" --against saved.json --sampler white -m 8 -o verdict.json
[[ ! -s out && $(<verdict.json) == *'"command": "check"'*'"different"'* ]] || complain "json"
# the rate decides: a p value between the two rates
runs 0 "${host[@]}" --against saved.json --sampler jittered -m 8 --seed 3 --false-alarm-rate 1e-9
p=$(key adjusted_p_value)
awk -v p="$p" 'BEGIN { exit !(p > 0 && p <= 1) }' || complain "adjusted_p_value: $p"

# ---- other kinds of spectra: shells, subsets, normalization, several dimensions, all N ----
"$program" power "${host[@]}" --sampler halton -d 3 -n 32 -m 2 -k 3 --bins shells --normalize effective -o shells.json
runs 0 "${host[@]}" --against shells.json --sampler halton
[[ $(key different) == "0 of 11 shells" && $(key normalization) == effective* && $(key dimension) == 3 ]] || complain "shells: $(<out)"
[[ $(column z_score 1) == 0 && $(column saved_error 1) == 0 ]] || complain "a deterministic set is itself: $(<out)"
runs 3 "${host[@]}" --against shells.json --sampler hammersley
says 'shell 1 (power '
# rings by other rules: bins that begin with 0, and borders that depend on the number of points
for bins in floor width=3/2 relative=1/8; do
    "$program" power "${host[@]}" --sampler halton -n 48 -m 2 -k 5 --bins "$bins" -o bins.json
    runs 0 "${host[@]}" --against bins.json --sampler halton
    [[ $(key different) == "0 of "*" rings" && $(key bins) == "$bins" ]] || complain "$bins: $(<out)"
    [[ $(column z_score 1) == 0 ]] || complain "$bins, a deterministic set is itself: $(<out)"
done
"$program" power "${host[@]}" --sampler white -d 4 -n 32 -m 20 -k 5 --per-ring 8 -s 5 -o subset.json
runs 0 "${host[@]}" --against subset.json --sampler white -m 9
[[ $(key per_ring) == 8 && $(key seed) == 6 ]] || complain "subset: $(<out)"
# the subset is that of the saved seed: the same realizations have the same powers
runs 0 "${host[@]}" --against subset.json --sampler white -m 20 -s 5
[[ $(column z_score 5) == 0 ]] || complain "another subset: $(<out)"
printf '0.1 0.2\n0.7 0.4\n0.3 0.9\n#\n0.2 0.2\n0.6 0.5\n' >mixed.txt
"$program" power "${host[@]}" -k 3 mixed.txt -o mixed.json
runs 0 "${host[@]}" --against mixed.json mixed.txt
[[ "$(key points) $(key points_smallest) $(key points_largest)" == "2.5 2 3" ]] || complain "numbers of points: $(<out)"
# sets of any N in the saved range, although none of them is the mean; tables that said the range in words are read, too
sed 's/"points": \[2.5\]/"points": ["mean 2.5, from 2 to 3"]/; /"points_/d' mixed.json >words.json
! cmp -s words.json mixed.json || complain "words.json is mixed.json"
for n in 2 3; do
    "$program" sample --sampler white -n "$n" -m 9 -o "of_$n.txt"
    runs 0 "${host[@]}" --against mixed.json "of_$n.txt"
    grep -v '^# \(command\|against\)' out >of_numbers
    runs 0 "${host[@]}" --against words.json "of_$n.txt"
    grep -v '^# \(command\|against\)' out | cmp -s - of_numbers || complain "the range in words is another"
done
"$program" sample --sampler white -n 4 -m 2 -o of_4.txt
refuses 'these sets have 4 points, those of "mixed.json" have 2 to 3' --against mixed.json of_4.txt
cat of_4.txt <(echo '#') of_4.txt <(printf '#\n0.1 0.2\n') >wide.txt
runs 0 "${host[@]}" --against mixed.json wide.txt

# ---- the sphere ----
"$program" angular "${host[@]}" --sampler healpix-jittered:nside=2 -m 40 -l 10 -o sphere.json
runs 0 "${host[@]}" --against sphere.json --sampler healpix-jittered:nside=2 -m 10
[[ $(key different) == "0 of 10 degrees" && $(grep '^degree' out) == degree,saved,* && $(column degree 10) == 10 ]] ||
    complain "degrees: $(<out)"
runs 3 "${host[@]}" --against sphere.json --sampler white-sphere -m 10
says 'degree 2 (power '
"$program" angular "${host[@]}" --sampler white-hemisphere -n 16 --hemisphere -m 20 -l 8 -o even.json
runs 0 "${host[@]}" --against even.json --sampler white-hemisphere -m 5
[[ $(key different) == "0 of 4 degrees" && $(key domain) == hemisphere* ]] || complain "hemisphere: $(<out)"

# ---- one realization on both sides: equal or nothing can be said ----
"$program" power "${host[@]}" --sampler hammersley -n 20 -k 5 -o one.json
runs 0 "${host[@]}" --against one.json --sampler hammersley
refuses 'save at least 2 realizations' --against one.json --sampler white

# ---- two saved spectra: nothing is computed ----
"$program" power "${host[@]}" --sampler jittered -n 64 -m 30 -k 12 -s 7 -o again.json
"$program" power "${host[@]}" --sampler white -n 64 -m 30 -k 12 -s 7 -o white.jsonl
runs 0 --against saved.json again.json
[[ $(key verdict) == same && $(key different) == "0 of 12 rings" && $(key measured) == again.json && $(key against) == saved.json &&
    $(key realizations) == 30 && $(key saved_realizations) == 40 && $(key points) == 64 && $(key engine) == none && $(rows) == 13 ]] ||
    complain "two saved: $(<out)"
# the same numbers as where the other side is measured anew, but for the digits of the error bounds
grep -v '^#' out >of_files
runs 0 "${host[@]}" --against saved.json --sampler jittered -m 30 -s 7
grep -v '^#' out | cmp -s - of_files || complain "measured and saved: $(diff of_files <(grep -v '^#' out))"
runs 3 --against saved.json white.jsonl -o both.csv
says 'not the spectrum of "saved.json"'
says 'ring 1 (power '
grep -q '^# verdict: different' both.csv || complain "different: $(<both.csv)"
runs 0 --against saved.json saved.json
[[ $(key note) == *"not independent"* && $(column z_score 3) == 0 && $(column p_value 12) == 1 ]] || complain "itself: $(<out)"
for of in shells bins sphere even one; do
    runs 0 --against $of.json $of.json
    [[ $(column z_score 1) == 0 ]] || complain "$of itself: $(<out)"
done
"$program" plan check --against saved.json again.json >planned.txt 2>err || complain "plan: $(<err)"
[[ $(<planned.txt) == *'both spectra were saved'* && $(grep -c ',chosen,' planned.txt) == 1 ]] || complain "plan: $(<planned.txt)"
# two of files are the same, too, in gzip as well
gzip -kf again.json
runs 0 --against saved.json again.json.gz
# other kinds and frequencies: one sentence
kinds='spectra of two kinds are not compared'
refuses '"sphere.json" has degrees of the sphere up to 10, normalization power, and "saved.json" has rings of the torus in 2 dimensions up to 12, normalization power: '"$kinds" \
    --against saved.json sphere.json
"$program" power "${host[@]}" --sampler jittered -n 64 -m 9 -k 11 -o fewer.json
refuses 'up to 11, normalization power, and' --against saved.json fewer.json
"$program" power "${host[@]}" --sampler jittered -n 64 -m 9 -k 12 --normalize effective -o effective.json
refuses 'normalization effective, and' --against saved.json effective.json
"$program" power "${host[@]}" --sampler jittered -n 64 -m 9 -k 12 --bins floor -o floor.json
refuses 'rings by floor of the torus in 2 dimensions' --against saved.json floor.json
"$program" power "${host[@]}" --sampler white -d 4 -n 32 -m 20 -k 5 --per-ring 8 -s 6 -o other_subset.json
refuses '8 of every ring by the seed 6' --against subset.json other_subset.json
runs 0 --against subset.json subset.json
modes=$(grep -v '^#' out)
runs 0 "${host[@]}" --against subset.json --sampler white -m 20 -s 5
[[ $(grep -v '^#' out) == "$modes" ]] || complain "a subset that is saved has other errors than one that is measured"
refuses 'even degrees of the hemisphere' --against sphere.json even.json
"$program" power "${host[@]}" --sampler jittered -n 81 -m 9 -k 12 -o larger.json
refuses 'the sets of "larger.json" have 81 points, those of "saved.json" have 64; spectra change' --against saved.json larger.json
sed '/^    {"bin": 5, /d' again.json >bad.json
refuses '"bad.json" and "saved.json" do not have the same rings: the first that differs is number 5, of 11 and 12' --against saved.json bad.json
refuses '-m does not go with two saved spectra' --against saved.json again.json -m 4
refuses '--box does not go with two saved spectra' --against saved.json again.json --box 0,1
refuses '--engine does not go with two saved spectra' "${host[@]}" --against saved.json again.json
refuses '--tol does not go with two saved spectra' --against saved.json again.json --tol 1e-3
refuses '--precision does not go with two saved spectra' --against saved.json again.json --precision double
head -c 300 again.json >bad.json
refuses 'no JSON at byte' --against saved.json bad.json

# ---- what is refused ----
refuses '--against FILE, the saved spectrum, or --homogeneous is needed' sets.txt
refuses 'nothing to take a spectrum of' --against saved.json
refuses 'one sampler is compared' --against saved.json --sampler white --sampler jittered
refuses 'not .npy' --against saved.json sets.txt -o x.npy
refuses '--against "saved.json" are the same file' --against saved.json sets.txt -o saved.json
refuses 'standard input is none' --against - sets.txt
runs 1 --against no-such.json sets.txt
says 'cannot read no-such.json'
refuses 'is not above 0 and below 1' --against saved.json sets.txt --false-alarm-rate 1
refuses 'above 0' --against saved.json sets.txt --false-alarm-rate 0
refuses 'did you mean --against' --agains saved.json sets.txt
"$program" sample --sampler white -n 63 -o fewer.txt
refuses 'these sets have 63 points, those of "saved.json" have 64' --against saved.json fewer.txt
"$program" sample --sampler white -n 64 -d 3 -o space.txt
refuses 'the dimension asked for is 2' --against saved.json space.txt
refuses 'makes points of the sphere' --against saved.json --sampler fibonacci
refuses 'makes points of the torus' --against sphere.json --sampler halton

damaged() { # PART SED-SCRIPT
    sed "$2" saved.json >bad.json
    cmp -s saved.json bad.json && complain "$2 changes nothing"
    refuses "$1" --against bad.json sets.txt
}
refuses 'is no saved spectrum' --against sets.txt sets.txt
"$program" power "${host[@]}" --sampler jittered -n 64 -m 6 -k 12 -o table.csv
refuses '"table.csv" is no saved spectrum: pointspec power and angular save one with -o FILE.json' --against table.csv sets.txt
refuses '"table.csv" is no saved spectrum: pointspec power and angular save one with -o FILE.json' --against saved.json table.csv
cat saved.json <(echo '{"rows": []}') >bad.json
refuses 'is damaged: there is more behind the table, at byte' --against bad.json sets.txt
cat saved.json <(printf '\n \t\n') >blank.json
runs 0 "${host[@]}" --against blank.json sets.txt
damaged 'ring 2 has the frequency 1.5, which cannot be: it is 2.157' 's/"frequency": 2.157[0-9]*/"frequency": 1.5/'
damaged 'ring 1 has the count 7, which cannot be: there are 8 frequencies' 's/"count": 8,/"count": 7,/'
damaged 'row 1 is not what' 's/"count": 8,/"count": 0,/'
damaged 'row 1 is not what' '0,/"standard_error": [0-9.e-]*/s//"standard_error": 1e200/'
# JSON Lines are the same table
"$program" power "${host[@]}" --sampler jittered -n 64 -m 40 -k 5 -o lines.jsonl
"$program" power "${host[@]}" --sampler jittered -n 64 -m 40 -k 5 -o lines.json
runs 0 "${host[@]}" --against lines.jsonl --sampler jittered -m 20
grep -v '^# \(command\|against\)' out >of_lines
runs 0 "${host[@]}" --against lines.json --sampler jittered -m 20
cmp -s of_lines <(grep -v '^# \(command\|against\)' out) || complain "JSON Lines are compared otherwise: $(diff of_lines out)"
head -c -40 lines.jsonl >bad.jsonl
refuses 'is damaged: no row of JSON Lines at byte' --against bad.jsonl --sampler jittered
head -n 3 lines.jsonl >bad.jsonl
refuses '"bad.jsonl" lacks ring' --against bad.jsonl --sampler jittered -m 2
head -c 900 saved.json >bad.json
refuses 'no JSON at byte' --against bad.json sets.txt
damaged 'no table of this version' 's/"schema": 3,$/"schema": 2,/'
damaged 'table of another command' 's/^  "command": "power"/  "command": "pairs"/'
damaged '"realizations"' 's/"realizations": \[40/"realizations": [0/'
damaged '"points"' 's/"points": \[64/"points": [64.5/'
for range in '"mean 5, from 7 to 9"' '"no range"'; do
    damaged 'not in their range' "s/\"points\": \[64/\"points\": [$range/"
done
for range in '[65],"points_largest": [66]' '[60],"points_largest": [63]' '[66],"points_largest": [60]'; do
    damaged 'not in their range' "s/\"points\": \[64\]/&, \"points_smallest\": $range/"
done
damaged '"points_largest"' 's/"points": \[64\]/&, "points_smallest": [60]/'
damaged '"points_smallest"' 's/"points": \[64\]/&, "points_smallest": [0.5], "points_largest": [70]/'
damaged '"max_frequency"' '/"max_frequency"/d'
damaged '"dimension"' 's/"dimension": \[2/"dimension": [7/'
damaged 'none of power, effective, integral' 's/"normalization": "power/"normalization": "pairs/'
damaged 'predicted_error' 's/"predicted_error": [^,]*/"predicted_error": [1e999]/'
damaged 'columns' 's/"frequency", //'
damaged 'several samplers' 's/"columns": \[/&"sampler", /'
damaged 'list of frequencies' 's/"columns": \["bin"/"columns": ["k1"/'
damaged 'row 3 is not' 's/^    {"bin": 3, /    {"bin": 3.5, /'
damaged 'row 3 is not' 's/^    {"bin": 3, /    {"bin": 2, /'
damaged 'row 1 is not' 's/^    {"bin": 1, [^,]*, /    {"bin": 1, /'
damaged 'row 12 is not' '/^    {"bin": 12,/s/"power": /"power": -/'
damaged 'row 2 is not' '/^    {"bin": 2,/s/"standard_error": [^,]*/"standard_error": null/'
damaged 'row 2 is not' '/^    {"bin": 2,/s/"power"/"powre"/'
damaged 'no "rows"' '/^    {"bin"/d'
damaged 'lacks ring 5' '/^    {"bin": 5, /d'
damaged 'lacks ring 12' '/^    {"bin": 12, /d; s/^\(    {"bin": 11, .*}\),/\1/'
damaged 'has 12 rings, but up to 11 there are 11' 's/"max_frequency": \[12/"max_frequency": [11/'
sed 's/"seed": 5/"seed": -1/' subset.json >bad.json
refuses 'random subset' --against bad.json --sampler white
finish

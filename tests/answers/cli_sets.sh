#!/usr/bin/env bash
# cli_sets.sh PROGRAM: --set NAME=FILES beside --sampler in power, angular, pairs, quadrature and variance: the rows are those
# of the files and samplers alone, tables, pictures, plans, comparison of two sets, and what is refused.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" power "$1"

host=(--engine host_direct --no-self-check)
rows_of() { # NAME: of the table, without the name
    grep "^$1," out | sed "s/^$1,//"
}
rows() { grep -v '^#' "$1" | sed 1d; }
alone() { # COMMAND ARGS..: the rows of one question
    "$program" "$@" >alone.csv 2>err || complain "$*: $(<err)"
    rows alone.csv
}
for i in 1 2; do
    "$program" sample --sampler jittered -n 64 -m 6 -s "$i" -o "j$i.txt"
    "$program" sample --sampler latin-hypercube -n 49 -m 4 -s "$i" -o "l$i.txt"
    "$program" sample --sampler zphi -n 36 -m 4 -s "$i" -o "z$i.txt"
    "$program" sample --sampler jittered:lift=hemisphere -n 36 -m 4 -s "$i" -o "h$i.txt"
done

# ---- several files are realizations of one average, and the header says so ----
runs 0 "${host[@]}" -k 4 j1.txt j2.txt
[[ $(key input) == "2 files, 12 realizations, one average" ]] || complain "two files: $(<out)"
runs 0 "${host[@]}" -k 4 j1.txt
[[ -z $(key input) ]] || complain "one file: $(<out)"

# ---- a set is what its files are alone, and samplers beside it are what they are alone ----
runs 0 "${host[@]}" -k 4 --set 'jit=j*.txt' --sampler white -n 64 -m 5 --set lhs=l1.txt,l2.txt --plot sets.svg
[[ $(grep -v '^#' out | cut -d, -f1 | uniq | paste -sd' ') == "sampler jit white lhs" ]] || complain "order: $(<out)"
[[ $(rows_of jit) == "$(alone power "${host[@]}" -k 4 j1.txt j2.txt)" ]] || complain "jit: $(<out)"
[[ $(rows_of lhs) == "$(alone power "${host[@]}" -k 4 l1.txt l2.txt)" ]] || complain "lhs: $(<out)"
[[ $(rows_of white) == "$(alone power "${host[@]}" -k 4 --sampler white -n 64 -m 5)" ]] || complain "white: $(<out)"
[[ $(key input | paste -sd';') == "2 files, 12 realizations, one average;2 files, 8 realizations, one average" ]] ||
    complain "input: $(key input)"
[[ $(key sampler | paste -sd,) == jit,white,lhs && $(key points | paste -sd,) == 64,64,49 && $(key seed) == 1 ]] ||
    complain "header: $(grep '^#' out)"
if command -v gnuplot >/dev/null; then
    for label in jit white lhs; do
        grep -q ">$label<" sets.svg || complain "the picture lacks $label"
    done
    grep -q '3 sets of points' sets.svg || complain "title"
fi
runs 0 "${host[@]}" -k 4 --set 'jit=j*.txt' --sampler white -n 64 -m 5 --format json
python3 - <<'END' || complain "JSON"
import json
all = json.load(open("out"))
assert all["meta"]["sampler"] == ["jit", "white"] and all["meta"]["realizations"] == [12, 5]
assert [row["sampler"] for row in all["rows"]] == ["jit"] * 4 + ["white"] * 4
END
# one set alone is the files under a name; two sets need no sampler, and then nothing is random
runs 0 "${host[@]}" -k 4 --set jit=j1.txt
[[ $(rows out) == "$(alone power "${host[@]}" -k 4 j1.txt)" && $(key sampler) == jit && -z $(key seed) ]] || complain "one set: $(<out)"
cp j1.txt same.txt
runs 0 "${host[@]}" -k 4 --set a=j1.txt --set b=same.txt
[[ $(rows_of a) == "$(rows_of b)" && -n $(rows_of a) ]] || complain "twice the same: $(<out)"
"$program" plan power "${host[@]}" -k 4 --set a=j1.txt --sampler white -n 64 >plan.csv 2>err || complain "plan: $(<err)"
[[ $(grep -c '^a,host_direct:.*,chosen,' plan.csv) == 1 && $(grep -c '^white,host_direct:.*,chosen,' plan.csv) == 1 ]] ||
    complain "plan: $(<plan.csv)"
# what is about files is for sets, what is about samplers for samplers
awk '/^#/ { print; next } { printf "%.17g %.17g\n", $1 * 8, $2 * 8 }' j1.txt >wide.txt
runs 0 "${host[@]}" -k 4 --set a=wide.txt --box 0,8 --sampler white -n 64 -m 5
[[ $(rows_of a) == "$(alone power "${host[@]}" -k 4 --box 0,8 wide.txt)" && $(key box) == 0,8 ]] || complain "box: $(<out)"

# ---- other commands ----
command=angular
runs 0 "${host[@]}" -l 4 --set 'z=z*.txt' --sampler white-sphere -n 36 -m 5
[[ $(rows_of z) == "$(alone angular "${host[@]}" -l 4 z1.txt z2.txt)" &&
    $(rows_of white-sphere) == "$(alone angular "${host[@]}" -l 4 --sampler white-sphere -n 36 -m 5)" ]] || complain "angular: $(<out)"
command=pairs
runs 0 -l 4 --set 'z=z*.txt' --sampler white-sphere -n 36 -m 5
[[ $(rows_of z) == "$(alone pairs -l 4 z1.txt z2.txt)" && $(key input) == "2 files, 8 realizations, one average" ]] || complain "pairs: $(<out)"
command=quadrature
runs 0 --brdf diffuse -l 4 --set 'h=h*.txt' --sampler white-hemisphere -n 36 -m 5 --plot rules.svg
[[ $(rows_of h) == "$(alone quadrature --brdf diffuse -l 4 h1.txt h2.txt)" &&
    $(rows_of white-hemisphere) == "$(alone quadrature --brdf diffuse -l 4 --sampler white-hemisphere -n 36 -m 5)" ]] ||
    complain "quadrature: $(<out)"
[[ $(key sampler | paste -sd,) == h,white-hemisphere && $(key realizations | paste -sd,) == 8,5 &&
    $(key input) == "2 files, 8 realizations, one average" ]] || complain "rules: $(grep '^#' out)"
refuses 'several samplers, sets, numbers of points' --brdf diffuse --set h=h1.txt --set i=h2.txt --weights optimal --weights-out w.txt

# ---- variance: which of two sets of files has less ----
command=variance
disk=(--integrand disk -k 24 "${host[@]}" --shifts 0)
runs 0 "${disk[@]}" --set 'jit=j*.txt' --set 'lhs=l*.txt' --sampler white -n 64 -m 12 --rank --plot variance.svg
[[ $(rows_of jit | cut -d, -f1-8) == "$(alone variance "${disk[@]}" j1.txt j2.txt | cut -d, -f1-8)" ]] || complain "variance: $(<out)"
[[ $(key ranking) == 'disk, N = 49 to 64: jit has the least variance; lhs has '*' times as much (standard error '*'; white has '* &&
    $(key ranking_first) == jit && $(key ranking_points) == 64 ]] || complain "ranking: $(key ranking)"
rows out | awk -F, '{ v[$1] = $3; f[$1] = $12; s[$1] = $15 }
    END { r = v["lhs"] / v["jit"] / f["lhs"]; exit !(r > 0.95 && r < 1.05 && s["lhs"] > 3 && s["white"] > 3) }' || complain "factor: $(<out)"
# titles say the sets of each
runs 0 "${disk[@]}" --set 'jit=j*.txt' --sampler white -n 64 -m 5 --plot variance.svg
grep -q 'disk, M = 12 of jit, 5 of white<' variance.svg || complain "title: $(grep -o '[^>]*M = [^<]*' variance.svg)"
# (`head` behind a pipe ends what writes into it)
for num in 60 64; do awk -v num=$num '!/^#/ && ++row <= num' j1.txt >j$num.dat; done
"$program" power -k 4 j60.dat j64.dat --plot power.svg -o power.csv 2>err || complain "different N: $(<err)"
grep -q '2 files, mean N = 62 (sets of 60 to 64), 2 realizations<' power.svg || complain "title of different N: $(grep -o '[^>]*N = [^<]*' power.svg)"
"$program" quadrature --brdf diffuse --lift hemisphere j60.dat j64.dat --plot rules.svg -o rules.csv 2>err || complain "rules: $(<err)"
grep -q ', mean N = 62 (sets of 60 to 64), 2 realizations<' rules.svg || complain "title of rules: $(grep -o '[^>]*N = [^<]*' rules.svg)"
# a set beside its copy is not told apart; of a single set all that is random are moves, and a few sets tell no error
runs 0 "${disk[@]}" --set a=j1.txt --set b=same.txt --rank
[[ $(rows out | cut -d, -f11-13 | paste -sd' ') == '1,1,0 1,1,0' ]] || complain "beside itself: $(<out)"
runs 0 "${disk[@]}" --select-sets 1 --set a=j1.txt --set b=l1.txt --rank
[[ $(key ranking) == *'b has '*' times as much, by sums over pairs of points; '* ]] || complain "one set each: $(key ranking)"
runs 0 "${disk[@]}" --select-sets 1..3 --set a=j1.txt --set b=l1.txt --rank
[[ $(key ranking) == *'times as much, from too few sets for an error'* ]] || complain "three sets each: $(key ranking)"
# measured ones are moved by moves of their own
runs 0 --integrand disk "${host[@]}" -k 8 --set a=j1.txt --set b=same.txt
[[ $(rows_of a | cut -d, -f2) == "$(rows_of b | cut -d, -f2)" && $(rows_of a | cut -d, -f6) != "$(rows_of b | cut -d, -f6)" ]] ||
    complain "moves: $(<out)"
runs 0 --integrand disk "${host[@]}" -k 8 --set a=j1.txt --sampler white -n 64 -m 2
[[ $(key measured_sets) == 3 && $(rows out | wc -l) == 2 ]] || complain "measured: $(<out)"
refuses '--rank compares samplers and sets' "${disk[@]}" --set a=j1.txt --rank
refuses 'takes several numbers of points' "${disk[@]}" --set a=j1.txt --rates auto
"$program" power "${host[@]}" -k 4 j1.txt -o saved.json
refuses 'variances are formed from sums of each set' "${disk[@]}" --set a=saved.json --set b=j1.txt

# ---- what is refused ----
command=power
# a file counts once, whatever its names are, in one set or in two that are compared
ln -s j1.txt link.txt
for twice in 'j1.txt ./j1.txt' 'link.txt j1.txt' '--set a=j1.txt,j*.txt' '--set a=j1.txt --set b=j1.txt' '--set a=j1.txt --set b=l*.txt'; do
    read -ra words <<<"$twice"
    refuses 'are one file, which would count twice' -k 4 "${words[@]}"
done
refuses '--set a: no file matches "none*.txt"' --set 'a=none*.txt'
runs 1 --set a=none.txt
says 'cannot read none.txt'
refuses '"j1.txt" is no NAME=FILES' --set j1.txt
refuses 'a name of a file is empty' --set a=j1.txt,
refuses '--set a=j2.txt: another set or sampler has this name' --set a=j1.txt --set a=j2.txt
refuses '--sampler white: another set or sampler has this name' --set white=j1.txt --sampler white
refuses '--set does not go with j2.txt: points come from one of them; --set NAME=FILES' --set a=j1.txt j2.txt
refuses '--sampler does not go with j2.txt' --sampler white --set a=j1.txt j2.txt
refuses 'point files have their own' --set a=j1.txt --sampler white -n 64,128
refuses '-m does not go with point files' --set a=j1.txt -m 4
refuses '--full does not go with several samplers or sets' --set a=j1.txt --set b=j2.txt --full f.npy
refuses '--weights column does not go with --sampler' --set a=j1.txt --sampler white --weights column
refuses 'are the same file' --set a=j1.txt -o j1.txt
finish

#!/usr/bin/env bash
# cli_truncation.sh PROGRAM: pointspec truncation with every lobe and format; what it refuses, and how it says it.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" truncation "$1"

row() { # DEGREE: error and points with 4 digits
    awk -F, -v l="$1" '!/^#/ && $1 == l { printf "%.3e,%.4g", $2, $3 }' out
}

# Table 1 of the paper, as docs/mathematics/quadrature.md#truncation has it
runs 0 --brdf diffuse -l 4
[[ $(row 4) == 2.656e-03,1843 ]] || complain "diffuse, L = 4: $(row 4)"
[[ $(grep -c '^[0-9]' out) == 5 ]] || complain "degrees 0..4"
[[ $(key smoothness) == 1.5 && $(key harmonics) == spherical ]] || complain "header: $(<out)"
runs 0 --brdf glossy:n=30 -l 13
[[ $(row 13) == 2.560e-03,103[34] ]] || complain "glossy, L = 13: $(row 13)"
runs 0 --brdf glossy:n=30 -l 9 --harmonics hemispherical
[[ $(row 9) == 2.03[45]e-03,* ]] || complain "glossy, hemispherical, L = 9: $(row 9)"
runs 0 --brdf diffuse -l 2 --harmonics hemispherical
[[ $(grep '^1,' out) == 1,0, ]] || complain "the diffuse lobe has two hemispherical degrees: $(<out)"

# a table is the lobe that it holds; angles may fall or rise
printf '0 0\n1 1\n' >cosine.txt
runs 0 --brdf diffuse -l 3
cut -d, -f1,2 out | grep '^[0-9]' >expected
runs 0 --brdf zonal:file=cosine.txt -l 3
paste -d, expected <(grep '^[0-9]' out) | awk -F, '
    { if (($2 - $4) ^ 2 > 1e-18 || $5 != "") exit 1 }' || complain "zonal: $(<out)"
[[ $(key equivalent_points) == "not known"* ]] || complain "zonal: $(key equivalent_points)"

# formats
runs 0 --brdf phong:n=7 --smoothness 1.2 -l 2 --format json
grep -q '"columns":.*"degree".*"error".*"equivalent_points"' <(tr -d '\n ' <out) || complain "json: $(<out)"
runs 0 --brdf phong:n=7 -l 2 -o t.npy --plot t.svg
[[ -s t.npy && -s t.json && $(head -c 500 t.svg) == *svg* ]] || complain "npy and svg"
runs 0 --brdf glossy:n=2,cut=none -l 2
[[ $(key note) == *"below the horizon"* ]] || complain "note: $(key note)"

refuses '--brdf NAME is needed'
refuses 'did you mean glossy?' --brdf glosy:n=3
refuses 'exponent n of the lobe' --brdf glossy:n=0
refuses 'needs its exponent' --brdf phong
refuses 'is not between 1 and 2' --brdf diffuse --smoothness 2
refuses 'is not between 1 and 2' --brdf diffuse --smoothness 1
refuses 'smoothness' --brdf diffuse --smoothness nan
refuses 'below the horizon' --brdf glossy:n=3,cut=none --harmonics hemispherical
refuses '600 of hemispherical' --brdf diffuse --harmonics hemispherical -l 600
refuses '-l: degree 20000 is more than 10000' --brdf diffuse -l 20000
refuses '--max-degree: degree 10001 is more than 10000' --brdf diffuse --max-degree 10001
refuses 'no file is read' --brdf diffuse points.txt
refuses 'not "t.gif"' --brdf diffuse --plot t.gif
refuses '"none" is not one of' --brdf diffuse --harmonics none
printf '0 1\n2 1\n' >bad.txt
refuses 'bad.txt, line 2: 2 is no cosine' --brdf zonal:file=bad.txt
# The table of the lobe is an input.
printf '0,1\n1,.5\n2,.25\n' >own.csv
cp own.csv kept.csv
refuses '-o "own.csv" and --brdf "own.csv" are the same file' --brdf zonal:file=own.csv -o own.csv
cmp -s own.csv kept.csv || complain "a lobe was written over"
finish

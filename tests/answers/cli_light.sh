#!/usr/bin/env bash
# cli_light.sh PROGRAM: pointspec light of functions whose powers have a closed form, of maps that are turned, several at
# once, arrays, pictures, plans, scenes, a map of the data, and what it refuses.
data=$(realpath -m "${POINTSPEC_TEST_DATA:-../shared/data}")
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" light "$1"

printf '0,0,2,0\n1,0,1,0\n2,1,.5,.25\n' >light.txt
printf 'Pf 4 2 -1\n\0\0\200\77\0\0\0\100\0\0\200\77\0\0\0\101\0\0\0\100\0\0\200\77\0\0\0\100\0\0\200\77' >sky.pfm   # 2 1 2 1, 1 2 1 8
printf 'Pf 4 2 -1\n\0\0\0\100\0\0\200\77\0\0\0\101\0\0\200\77\0\0\200\77\0\0\0\100\0\0\200\77\0\0\0\100' >turn.pfm  # a quarter
printf 'Pf 4 2 -1\n\0\0\0\100\0\0\200\77\0\0\0\100\0\0\200\77\0\0\200\77\0\0\0\100\0\0\200\77\0\0\0\101' >below.pfm # its rows exchanged
printf 'Pf 2 1 -1\n\0\0\200\77\0\0\0\100' >other.pfm
rows() { grep -v '^[#a-z]' out; }
is_near() { # COLUMN: that of out beside stdin, "degree value" a line, to 1e-12 of the largest
    awk -F'[, ]' -v c="$1" 'NR == FNR { want[$1] = $2; if ($2 > most) most = $2; num++; next }
        !/^[#a-z]/ { if (!($1 in want) || !(sqrt(($c - want[$1]) ^ 2) <= 1e-12 * most)) exit 1; found++ }
        END { exit found != num }' - out || complain "column $1 of $(key command): $(rows | head -5)"
}
holds() { # CONDITION of numbers
    awk "BEGIN { exit !($1) }" || complain "not $1: $(grep '^#' out)"
}
pi=3.141592653589793

# closed forms
runs 0 --integrand constant:value=3 -l 2
printf '%s\n' "0 $(awk "BEGIN { printf \"%.17g\", 36 * $pi }")" '1 0' '2 0' | is_near 2
[[ $(rows | cut -d, -f3 | tr -d '\n') == '' && $(key least) == 3 && $(key largest) == 3 && $(key energy) == 0 ]] || complain "constant: $(<out)"
holds "($(key mean) - 3) ^ 2 < 1e-30"
# a map of one value, or of none, has no share either, though its second degree has what rounding leaves
for value in '\0\0\100\100' '\0\0\0\0'; do # 3, 0
    printf 'Pf 2 1 -1\n%b' "$value$value" >flat.pfm
    runs 0 --integrand map:file=flat.pfm -l 3
    [[ $(rows | cut -d, -f3 | tr -d '\n') == '' ]] || complain "a flat map: $(<out)"
done
runs 0 --integrand square -l 3
awk "BEGIN { printf \"0 %.17g\n1 0\n2 %.17g\n3 0\n\", 4 * $pi / 9, 16 * $pi / 225 }" | is_near 2
printf '%s\n' '0 0' '1 0' '2 1' '3 1' | is_near 3
[[ $(key pixels) == '512 x 256' ]] || complain "pixels: $(key pixels)"
holds "$(key least) > 0 && $(key least) < 1e-4 && $(key largest) < 1 && $(key largest) > .9999"
runs 0 --integrand harmonic:degree=4,axis=1x2x2 -l 5
printf '%s\n' '0 0' '1 0' '2 0' '3 0' "4 $(awk 'BEGIN { printf "%.17g", 1 / 9 }')" '5 0' | is_near 2
runs 0 --integrand coefficients:file=light.txt -l 3
printf '%s\n' '0 4' "1 $(awk 'BEGIN { printf "%.17g", 1 / 3 }')" '2 .125' '3 0' | is_near 2
awk 'BEGIN { printf "0 0\n1 %.17g\n2 1\n3 1\n", 1 / 1.625 }' | is_near 3

# caps: F_l0 = sqrt(pi/(2l+1)) (P_(l-1)(x) - P_(l+1)(x)), and beyond L about 2 sin t/(L + 1/2) of pi sin^2 t
runs 0 --integrand cap:angle=0.7
awk -v pi=$pi 'BEGIN {
    x = cos(.7); p[0] = 1; p[1] = x
    for (l = 1; l < 66; l++) p[l + 1] = ((2 * l + 1) * x * p[l] - l * p[l - 1]) / (l + 1)
    printf "0 %.17g\n", pi * (1 - x) ^ 2
    for (l = 1; l < 65; l++) printf "%d %.17g\n", l, pi * ((p[l - 1] - p[l + 1]) / (2 * l + 1)) ^ 2
}' | is_near 2
holds "($(key energy) - $pi * sin(.7) ^ 2) ^ 2 < 1e-28 && ($(key integral) - 2 * $pi * (1 - cos(.7))) ^ 2 < 1e-28"
rest=$(rows | tail -1 | cut -d, -f3)
holds "((1 - $rest) * $pi * sin(.7) ^ 2 / (2 * sin(.7) / 64.5) - 1) ^ 2 < .02 ^ 2"

# of a map shares grow, and stay below 1; its pixels are where values are looked at; turned, it has the same powers
runs 0 --integrand map:file=sky.pfm -l 40
rows | awk -F, 'NR > 1 && !($3 >= last && $3 < 1) { exit 1 } { last = $3 } END { exit !(last > .99) }' || complain "shares: $(rows)"
[[ $(key pixels) == '4 x 2' && $(key least) == 1 && $(key largest) == 8 ]] || complain "map: $(<out)"
holds "($(key mean) * 4 * $pi / $(key integral) - 1) ^ 2 < 1e-30"
rows | cut -d, -f1,2 | tr , ' ' >powers
rows >alone
for turned in turn below; do
    runs 0 --integrand map:file=$turned.pfm -l 40
    is_near 2 <powers
done

# the same by another program, NumPy with 24 Gauss nodes between any two centres
runs 0 --integrand map:file=sky.pfm -l 6
printf '%s\n' '0 63.6172512352' '1 3.78321049754' '2 1.02565654775' '3 .335936657512' '4 .0183310352887' '5 .0181608270485' '6 .00532720243342' | is_near 2

# several functions: the same rows, each beside its name
runs 0 --integrand map:file=sky.pfm --integrand square --integrand map:file=turn.pfm -l 40
[[ $(grep -v '^#' out | head -1) == integrand,degree,power,share && $(grep -c '^[ms]' out) == 123 ]] || complain "several: $(<out)"
[[ $(grep '^map:file=sky' out | cut -d, -f2-) == "$(<alone)" ]] || complain "beside others: $(<out)"
[[ $(sed -n 's/^# integrand: //p' out | tr '\n' ' ') == 'map:file=sky.pfm square map:file=turn.pfm ' && $(grep -c '^# largest:' out) == 3 ]] || complain "header: $(<out)"
"$program" light --integrand map:file=sky.pfm --integrand square -l 2 -o light.npz
python=$(numpy_python)
if [[ -n $python ]]; then
    "$python" - light.npz <<'END' || complain "arrays"
import sys
import numpy as np
light = np.load(sys.argv[1])["light"]
assert np.array_equal(light[0], [[2, 1, 2, 1], [1, 2, 1, 8]]) and light.shape == (2, 2, 4)
assert np.allclose(light[1], 0.5, rtol=1e-15)
END
else
    echo "cli_light: no numpy: without arrays"
fi

# pictures, plans and scenes
runs 0 --integrand map:file=sky.pfm --plot a.svg
[[ $(grep -c '<image' a.svg) == 1 && $(<a.svg) == *'map:file=sky.pfm, 4 x 2 pixels'* ]] || complain 'image'
runs 0 --integrand map:file=sky.pfm --integrand square -l 8 --plot b.svg
[[ $(grep -c '<image' b.svg) == 0 && $(<b.svg) == *'2 functions of the sphere'*'degree l'* && $(<b.svg) == *square* ]] || complain 'powers'
"$program" plan light --integrand map:file=sky.pfm -l 40 >planned || complain 'plan'
[[ $(<planned) == *'# phase: values'*'8 pixels'*'# phase: powers'* ]] || complain "plan: $(<planned)"
cat >scene.yaml <<'END'
scene: 1
results:
  - {result: light, integrand: "map:file=sky.pfm", max-degree: 40, pictures: true}
  - {result: light, name: two, integrands: ["map:file=sky.pfm", square], max-degree: 4}
END
"$program" run scene.yaml -o folder --quiet >/dev/null || complain 'scene'
[[ $(grep -v '^[#a-z]' folder/light-1.csv) == "$(<alone)" ]] || complain "scene: $(ls folder)"
[[ $(grep -c '<image' folder/light-1-image.svg) == 1 && -s folder/light-1-power.svg && -s folder/two-power.svg && ! -e folder/two-image.svg ]] || complain "scene: $(ls folder)"

# a real map: shares are sums of powers, of nearly all of the energy
if [[ -r $data/env/wells_256x128.hdr ]]; then
    runs 0 --integrand "map:file=$data/env/wells_256x128.hdr" -l 200
    rows | awk -F, -v energy="$(key energy)" 'NR > 1 { sum += (2 * $1 + 1) * $2; if ((sum / energy - $3) ^ 2 > 1e-26) exit 1 }
        END { exit !($3 > .99 && $3 < 1) }' || complain "wells: $(tail -1 out)"
else
    echo "cli_light: $data/env is not there: without a real map"
fi

# what is refused
refuses '--integrand NAME is what is shown'
refuses 'there is none on the sphere' --integrand disk
refuses '-l: degree 1001 is more than 1000' --integrand square -l 1001
refuses 'no file is read' --integrand square points.txt
refuses 'maps of one table have the same pixels' --integrand map:file=sky.pfm --integrand map:file=other.pfm
refuses 'are the same file' --integrand map:file=sky.pfm --format csv -o sky.pfm
refuses 'unknown integrand "sqare"' --integrand sqare
runs 1 --integrand map:file=nothing.hdr
says 'cannot read nothing.hdr'
finish

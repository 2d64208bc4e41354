#!/usr/bin/env bash
# reproduction.sh PROGRAM table: what Marques et al. (M18) print beside what PROGRAM, a pointspec, computes.
# reproduction.sh PROGRAM figures FOLDER: their Figures 1 to 5 as FOLDER/m18/figure*.png.
# update_tables.sh and make_figures.sh call it. About a minute on one core.
set -euo pipefail
(($# == 2 && ${#2} == 5 || $# == 3)) || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
program=$(realpath "$1")
what=$2
folder=$(realpath "${3:-.}")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
[[ $what != figures ]] || mkdir -p "$folder/m18"

brdfs=(diffuse glossy:n=30)
lobes=(diffuse 'glossy, n = 30')
samplers=(fibonacci-hemisphere larcher-pillichshammer:lift=hemisphere sobol:lift=hemisphere
    white-hemisphere jittered:lift=hemisphere bnot:lift=hemisphere)
titles=("spherical Fibonacci" Larcher-Pillichshammer "Sobol'" random jittered BNOT)
sets=50 # of samplers that have several; one realization of the others is all there is
sizes=(64 128 256 512)

rule_error() { # BRDF WEIGHTS SAMPLER N: root mean square of E over the sets
    "$program" quadrature --quiet --brdf "$1" --weights "$2" --sampler "$3" -n "$4" -m $sets -l 1 |
        sed -n 's/^# worst_case_error: //p'
}
curve() { # BRDF WEIGHTS SAMPLER: lines "N E"
    local n
    for n in "${sizes[@]}"; do
        printf '%s %s\n' "$n" "$(rule_error "$1" "$2" "$3" "$n")"
    done
}
slope() { # of log E over log N, least squares, for the lines of a curve
    awk '{ x = log($1); y = log($2); n++; sx += x; sy += y; xx += x * x; xy += x * y }
        END { printf "%.6f", (n * xy - sx * sy) / (n * xx - sx * sx) }'
}

# ---- table -----------------------------------------------------------------------------------------

row() { # QUANTITY REFERENCE OURS DIGITS [%]: the difference, or its percentage
    awk -v name="$1" -v theirs="$2" -v ours="$3" -v digits="$4" -v part="${5-}" 'BEGIN {
        difference = part == "" ? sprintf("%.*f", digits, ours - theirs) : sprintf("%.2f %%", 100 * (ours / theirs - 1))
        if (digits == 0) difference = part == "" ? sprintf("%d", ours - theirs) : difference
        printf "%-68s %10s %10.*f %12s\n", name, theirs, digits, ours, difference }'
}
first_degree() { # LIMIT ARGUMENTS OF truncation...: the first L with E(L) <= LIMIT
    local limit=$1
    shift
    "$program" truncation "$@" | awk -F, -v limit="$limit" '/^[0-9]/ && $2 <= limit { print $1; exit }'
}
first_points() { # BRDF LIMIT: the first N that bisection finds with E_SF(N) <= LIMIT
    local low=1 high=4096 middle
    while ((high - low > 1)); do
        middle=$(((low + high) / 2))
        if awk -v e="$(rule_error "$1" equal fibonacci-hemisphere $middle)" -v limit="$2" 'BEGIN { exit !(e <= limit) }'
        then high=$middle; else low=$middle; fi
    done
    echo $high
}
table_1() {
    local points
    row 'Table 1: L, diffuse, spherical harmonics' 4 "$(first_degree 2.7e-3 --brdf diffuse)" 0
    row 'Table 1: L, glossy, spherical harmonics' 13 "$(first_degree 2.7e-3 --brdf glossy:n=30)" 0
    row 'Table 1: L, glossy, hemispherical harmonics' 9 \
        "$(first_degree 2.7e-3 --brdf glossy:n=30 --harmonics hemispherical)" 0
    points=$(first_points diffuse 2.5e-3)
    row 'Table 1: N for E = 2.5e-3, diffuse' 2000 "$points" 0 %
    points=$(first_points glossy:n=30 2.5e-3)
    row 'Table 1: N for E = 2.5e-3, glossy' 1000 "$points" 0 %
}
slopes() {
    # of the paper: a line for each sampler; diffuse and glossy with equal weights, then with optimal ones
    local -a theirs=(-0.77 -0.76 -0.75 -0.74 -0.77 -0.85 -0.75 -0.75 -0.75 -0.81 -0.74 -0.73
        -0.52 -0.52 -0.73 -0.71 -0.75 -0.75 -0.74 -0.74 -0.76 -0.76 -0.76 -0.75)
    local i k=0 weights brdf
    for i in "${!samplers[@]}"; do
        for weights in equal optimal; do
            for brdf in "${brdfs[@]}"; do
                row "Fig. 4: slope, ${titles[i]}, ${brdf%:*}, $weights weights" "${theirs[k]}" \
                    "$(curve "$brdf" "$weights" "${samplers[i]}" | slope)" 3
                k=$((k + 1))
            done
        done
    done
}
golden() {
    local -a diffuse=(.03451 .0202 .0119 .007017 .004144 .002452) glossy=(.02133 .01253 .00739 .004364 .002578 .001526)
    local i n
    for i in "${!diffuse[@]}"; do
        n=$((64 << i))
        row "E of spherical Fibonacci points, N = $n, diffuse" "${diffuse[i]}" \
            "$(rule_error diffuse equal fibonacci-hemisphere $n)" 6 %
        row "E of spherical Fibonacci points, N = $n, glossy" "${glossy[i]}" \
            "$(rule_error glossy:n=30 equal fibonacci-hemisphere $n)" 6 %
    done
    for i in 0 1; do # sqrt(D_0)
        row "E sqrt(N) of $sets random sets, N = 256, ${brdfs[i]%:*}" "$([[ $i == 0 ]] && echo .98274 || echo .56708)" \
            "$(rule_error "${brdfs[i]}" equal white-hemisphere 256 | awk '{ print 16 * $1 }')" 5 %
    done
}

# ---- figures ---------------------------------------------------------------------------------------

draw() { # NAME HEIGHT COMMANDS: gnuplot's, with colours 1 to 6
    echo "figures: $1.png" >&2
    gnuplot <<GNUPLOT
set terminal pngcairo size 900,$2 font "DejaVu Sans,10"
set output "$folder/$1.png"
set datafile separator ","
set datafile missing ""
set grid linetype 1 linewidth 0.5 linecolor "#dddddd"
set logscale y
set format y "10^{%L}"
set linetype 1 linecolor "#0072b2" linewidth 1.5 pointtype 7 pointsize 0.6
set linetype 2 linecolor "#d55e00" linewidth 1.5 pointtype 5 pointsize 0.6
set linetype 3 linecolor "#009e73" linewidth 1.5 pointtype 9 pointsize 0.7
set linetype 4 linecolor "#777777" linewidth 1.5 pointtype 11 pointsize 0.7
set linetype 5 linecolor "#cc79a7" linewidth 1.5 pointtype 13 pointsize 0.7
set linetype 6 linecolor "#e69f00" linewidth 1.5 pointtype 2 pointsize 0.7
$3
GNUPLOT
}
spectra() { # the rules of 256 points whose degrees Figures 1 to 3 show: BRDF-WEIGHTS-SAMPLER.csv, the sampler by its index
    local i brdf weights
    for brdf in "${brdfs[@]}"; do
        for weights in equal optimal; do
            for i in "${!samplers[@]}"; do
                "$program" quadrature --quiet --brdf "$brdf" --weights $weights --sampler "${samplers[i]}" -n 256 \
                    -m $sets -l 100 --format csv | grep '^[0-9]' >"${brdf%:*}-$weights-$i.csv"
            done
        done
    done
}
degree_curves() { # BRDF WEIGHTS COLUMN [STYLE]: of all sets; random points, the highest curve, lie under the others
    local i plots=
    for i in 3 4 5 2 1 0; do
        plots+=" '$1-$2-$i.csv' using 1:$3 with ${4:-lines} linetype $((i + 1)) title \"${titles[i]}\","
    done
    echo "plot ${plots%,}"
}
degree_panels() { # COLUMN WEIGHTS...: for each lobe a row, with a panel for each of the weights
    local column=$1 k weights
    shift
    for k in 0 1; do
        for weights in "$@"; do
            printf '%s\n' "set title '${lobes[k]}, $weights weights'" "$(degree_curves "${brdfs[k]%:*}" "$weights" "$column")"
        done
    done
}
draw_spectra() {
    local k row=
    for k in 0 1; do
        row+="set ylabel 'd_l^2'
set yrange [1e-12:1e-1]
set title '${lobes[k]}, equal weights'
$(degree_curves "${brdfs[k]%:*}" equal 3)
set ylabel 'C_l^2'
set yrange [1e-9:1e-1]
set title '${lobes[k]}, equal weights'
$(degree_curves "${brdfs[k]%:*}" equal 5)
set title '${lobes[k]}, optimal weights'
$(degree_curves "${brdfs[k]%:*}" optimal 5)
"
    done
    draw m18/figure1 700 "set multiplot layout 2,3 title 'spectra of rules, N = 256'
set xlabel 'degree l'
set key right bottom font ',8'
$row"
    draw m18/figure2 420 "set multiplot layout 1,2 title 'low degrees, N = 256, diffuse'
set xlabel 'degree l'
set xrange [0:10]
set xtics 1
set ylabel 'C_l^2'
set yrange [1e-12:1e-1]
set key right bottom
set title 'equal weights'
$(degree_curves diffuse equal 5 linespoints)
set title 'optimal weights'
$(degree_curves diffuse optimal 5 linespoints)"
    draw m18/figure3 700 "set multiplot layout 2,2 title 'share of a degree in E^2, N = 256, s = 1.5'
set xlabel 'degree l'
set ylabel 'e_l^2 = a_l (d_l^2 + C_l^2)'
set yrange [1e-9:1e-2]
set key right top
$(degree_panels 8 equal optimal)"
}
draw_errors() {
    local brdf weights i plots=
    for brdf in "${brdfs[@]}"; do
        for weights in equal optimal; do
            plots+="set title '${brdf%:*}, $weights weights'"$'\n'plot
            for i in "${!samplers[@]}"; do
                curve "$brdf" $weights "${samplers[i]}" | tr ' ' , >"error-${brdf%:*}-$weights-$i.csv"
                plots+=" 'error-${brdf%:*}-$weights-$i.csv' using 1:2 with linespoints linetype $((i + 1)) \
title \"${titles[i]}: $(tr , ' ' <"error-${brdf%:*}-$weights-$i.csv" | slope | awk '{ printf "%.2f", $1 }')\","
            done
            plots=${plots%,}$'\n'
        done
    done
    draw m18/figure4 800 "set multiplot layout 2,2
set logscale x 2
set xrange [56:585]
set xtics (64, 128, 256, 512)
set yrange [3e-3:0.3]
set xlabel 'points N'
set ylabel 'E'
$plots"
}
draw_truncation() {
    "$program" truncation --brdf diffuse -l 20 | grep '^[0-9]' >truncation-diffuse.csv
    "$program" truncation --brdf glossy:n=30 -l 20 | grep '^[0-9]' >truncation-glossy.csv
    "$program" truncation --brdf glossy:n=30 --harmonics hemispherical -l 20 | grep '^[0-9]' >truncation-hsh.csv
    draw m18/figure5 420 "set multiplot layout 1,2
set xlabel 'degree L'
set key right top
set ylabel 'E(L)'
set yrange [1e-5:1]
plot 'truncation-diffuse.csv' using 1:2 with linespoints linetype 1 title 'diffuse, SH', \\
    'truncation-glossy.csv' using 1:2 with linespoints linetype 2 title 'glossy, SH', \\
    'truncation-hsh.csv' using 1:2 with linespoints linetype 3 title 'glossy, HSH'
set ylabel 'N with E_{SF}(N) = E(L)'
set yrange [1:1e5]
set xrange [0:20]
set key right bottom
plot 'truncation-diffuse.csv' using 1:3 with linespoints linetype 1 title 'diffuse, SH', \\
    'truncation-glossy.csv' using 1:3 with linespoints linetype 2 title 'glossy, SH', \\
    'truncation-hsh.csv' using 1:3 with linespoints linetype 3 title 'glossy, HSH'"
}

case $what in
    table)
        printf '%-68s %10s %10s %12s\n' quantity reference here difference
        table_1
        slopes
        golden
        ;;
    figures)
        spectra
        draw_spectra
        draw_errors
        draw_truncation
        ;;
    *)
        echo "reproduction.sh: no $what" >&2
        exit 2
        ;;
esac

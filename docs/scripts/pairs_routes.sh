#!/usr/bin/env bash
# pairs_routes.sh figure LINES PICTURE | table LINES: from what "bench_pairs routes" prints, the run time of every way to pair sums
# against the error asked for and against the number of points, and where one way overtakes another.
set -euo pipefail
(($# >= 2)) || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
lines=$(realpath "$2")
engines=(pairs_direct pairs_histogram sphere_direct sphere_nufft)

figure() { # PICTURE
    local picture=$1 colors=("#0072b2" "#d55e00" "#009e73" "#cc79a7") plots="" i panel
    # shellcheck disable=SC2016 # for awk
    local conditions=('$1 == "tolerance" && $3 == 128' '$1 == "tolerance" && $3 == 512'
        '$1 == "points" && $3 == 128 && $4 == 1e-05' '$1 == "points" && $3 == 128 && $4 == 1e-10')
    local titles=("N = 1024, L = 128" "N = 1024, L = 512" "L = 128, error 1e-5" "L = 128, error 1e-10")
    for panel in 0 1 2 3; do
        local x=4
        plots+="set title \"${titles[panel]}\""$'\n'
        if ((panel < 2)); then
            plots+='set xlabel "error asked for, in (sum |w|)^2"; set xrange [2e-3:5e-15]; set xtics ("10^{-3}" 1e-3, "10^{-6}" 1e-6, "10^{-9}" 1e-9, "10^{-12}" 1e-12)'$'\n'
        else
            x=2
            plots+='set xlabel "points N"; set xrange [50:5200]; set xtics (64, 256, 1024, 4096)'$'\n'
        fi
        plots+="plot"
        for i in "${!engines[@]}"; do
            plots+=" '< awk ''${conditions[panel]} && \$5 == \"${engines[i]}\"'' $lines' using $x:7"
            plots+=" with linespoints pointtype 7 pointsize 0.6 linecolor \"${colors[i]}\" title \"${engines[i]}\","
        done
        plots=${plots%,}$'\n'
    done
    gnuplot <<GNUPLOT
set terminal pngcairo size 900,720 font "DejaVu Sans,10"
set output "$picture"
set multiplot layout 2,2
set logscale xy
set format y "%g"
set grid linecolor "#dddddd"
set ylabel "microseconds of a realization"
set key below maxcols 2 noenhanced
$plots
GNUPLOT
}

# The cheapest way at every N, and where lines cross, on a logarithmic scale between two N.
table() {
    awk '
        function cross(a, b,   i, x, y, n) { # the largest N where b begins to be faster than a
            y = log(us[key, a, 1] / us[key, b, 1])
            n = y >= 0 ? "< " points[1] : ""
            for (i = 2; i <= num; i++) {
                x = y
                y = log(us[key, a, i] / us[key, b, i])
                if (x < 0 && y >= 0) n = sprintf("%.0f", exp(log(points[i - 1]) + log(points[i] / points[i - 1]) * x / (x - y)))
            }
            return y < 0 ? "> " points[num] : n
        }
        $1 == "points" {
            key = $3 " " $4
            if (!(key in seen)) { seen[key] = 1; keys[++num_keys] = key }
            if (!($2 in at)) { at[$2] = ++num; points[num] = $2 }
            us[key, $5, at[$2]] = $7
        }
        END {
            printf "%5s %6s  %22s %22s %22s\n", "L", "error", "direct, histogram", "histogram, nufft", "direct, nufft"
            for (k = 1; k <= num_keys; k++) {
                key = keys[k]
                split(key, part, " ")
                printf "%5d %6s  %22s %22s %22s\n", part[1], part[2], cross("pairs_direct", "pairs_histogram"),
                    cross("pairs_histogram", "sphere_nufft"), cross("pairs_direct", "sphere_nufft")
            }
        }' "$lines"
}

case $1 in
figure) figure "$3" ;;
table) table ;;
*) exit 2 ;;
esac

#!/usr/bin/env bash
# plot.sh CSV PNG: microseconds of a realization against the measured error, a panel for each case and a line
# for each peer and each engine of pointspec (filled circles: what the planner chose), from what bench_peers.sh
# wrote. Peers, engines and cases that are missing are left out.
set -euo pipefail
(($# == 2)) || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
[[ $(head -n 1 "$1") == dimension,points,max_frequency,realizations,tolerance,peer,version,setting,realizations_used,error,*,microseconds,* ]] ||
    { echo "plot: $1 is not from bench_peers.sh" >&2; exit 1; }

mapfile -t cases < <(tail -n +2 "$1" | cut -d, -f1-4 | awk '!seen[$0]++')
styles=("plain:1:#aaaaaa:1" "NFSFT:11:#cc79a7:1" "finufft:5:#0072b2:1" "finufft fp32:4:#56b4e9:1" "ducc0:9:#009e73:1" "NFFT:11:#cc79a7:1"
    "host_direct:2:#777777:1" "torus_direct:6:#e69f00:1.5" "torus_nufft:6:#8c510a:1.5"
    "numpy:5:#0072b2:1" "pairs_direct:6:#0072b2:1.5" "pairs_histogram:6:#cc79a7:1.5"
    "sphere_direct:6:#e69f00:1.5" "sphere_nufft:6:#8c510a:1.5" "sphere_grid:4:#0072b2:1.5" "pointspec:7:#d55e00:2")
width=3
((${#cases[@]} < width)) && width=${#cases[@]}
rows=$(((${#cases[@]} + width - 1) / width))
{
    echo "set terminal pngcairo size $((width * 420)),$((rows * 350 + 20)) font \"DejaVu Sans,9\""
    echo "set output \"$2\""
    echo 'set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [1e-2:1e-15]
set grid linecolor "#cccccc" linetype 1
set bmargin 7
set pointsize 1.2
set xlabel "measured error"
set ylabel "us for a realization"
set key below noenhanced samplen 1 maxrows 2'
    echo "set multiplot layout $rows,$width"
    for case in "${cases[@]}"; do
        IFS=, read -r dimension points frequency realizations <<<"$case"
        title="d = $dimension, N = $points, K"
        [[ $dimension != s ]] || title="sphere, N = $points, L"
        [[ $dimension != p ]] || title="pairs, N = $points, L"
        echo "set title \"$title = $frequency, R = $realizations\""
        plots=()
        # Direct sums have one error whatever is asked: the fastest of these is drawn.
        for style in "${styles[@]}"; do
            IFS=: read -r peer point color line <<<"$style"
            data=$scratch/${case//,/-}-${peer// /-}
            awk -F, -v which="$case" -v peer="$peer" \
                '$1 "," $2 "," $3 "," $4 == which && $6 == peer && $10 != "" && (!($10 in least) || $12 < least[$10]) { least[$10] = $12 }
                END { for (error in least) print error, least[error] }' "$1" | sort -g >"$data"
            [[ ! -s $data ]] ||
                plots+=("\"$data\" with linespoints pointtype $point linecolor \"$color\" linewidth $line title \"$peer\"")
        done
        (IFS=,; echo "plot ${plots[*]}")
    done
    echo "unset multiplot"
} >"$scratch/script"
gnuplot "$scratch/script"

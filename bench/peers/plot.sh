#!/usr/bin/env bash
# plot.sh CSV PNG: microseconds of a realization against the measured error, a panel for each case and a line
# for each peer, from what bench_peers.sh wrote. Peers and cases that are missing are left out.
set -euo pipefail
(($# == 2)) || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
[[ $(head -n 1 "$1") == dimension,points,max_frequency,realizations,tolerance,peer,version,setting,realizations_used,error,*,microseconds,* ]] ||
    { echo "plot: $1 is not from bench_peers.sh" >&2; exit 1; }

mapfile -t cases < <(tail -n +2 "$1" | cut -d, -f1-4 | awk '!seen[$0]++')
styles="pointspec:7:#d55e00 finufft:5:#0072b2 finufft_fp32:4:#56b4e9 ducc0:9:#009e73 NFFT:11:#cc79a7"
width=3
((${#cases[@]} < width)) && width=${#cases[@]}
rows=$(((${#cases[@]} + width - 1) / width))
{
    echo "set terminal pngcairo size $((width * 400)),$((rows * 330 + 20)) font \"DejaVu Sans,9\""
    echo "set output \"$2\""
    echo 'set logscale xy
set format x "10^{%L}"
set format y "%g"
set xrange [1e-2:1e-15]
set grid linecolor "#dddddd"
set xlabel "measured error"
set ylabel "us for a realization"
set key below noenhanced samplen 1'
    echo "set multiplot layout $rows,$width"
    for case in "${cases[@]}"; do
        IFS=, read -r dimension points frequency realizations <<<"$case"
        echo "set title \"d = $dimension, N = $points, K = $frequency, R = $realizations\""
        plots=()
        for style in $styles; do
            IFS=: read -r peer point color <<<"$style"
            data=$scratch/${case//,/-}-$peer
            awk -F, -v which="$case" -v peer="${peer/_/ }" \
                '$1 "," $2 "," $3 "," $4 == which && $6 == peer { print $10, $12 }' "$1" | sort -g >"$data"
            [[ ! -s $data ]] ||
                plots+=("\"$data\" with linespoints pointtype $point linecolor \"$color\" title \"${peer/_/ }\"")
        done
        (IFS=,; echo "plot ${plots[*]}")
    done
    echo "unset multiplot"
} >"$scratch/script"
gnuplot "$scratch/script"

#!/usr/bin/env bash
# make_figures.sh [BUILD_DIR]: makes docs/images/*.png anew from what the programs of BUILD_DIR
# compute (default: build/dev of this checkout; needs pointspec and bench/bench_torus there).
# Eight minutes on two cores; the times in torus_direct_time.png want a quiet machine.
set -euo pipefail
docs=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/..")
build=$(realpath "${1:-$docs/../build/dev}")
images=$docs/images
pointspec=$build/pointspec
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$images"
cd "$scratch"

echo "figures: jittered.png" >&2
"$pointspec" power --sampler jittered -n 4096 -m 500 -k 96 --quiet -o jittered.csv \
    --plot "$images/jittered.png"

echo "figures: sphere.png" >&2
"$pointspec" angular --sampler healpix-jittered:nside=16 -m 1000 -l 256 --quiet -o sphere.csv \
    --plot "$images/sphere.png"

# Variance against N, for docs/user/variance.md: twenty seconds of two cores.
echo "figures: variance.png" >&2
"$pointspec" variance --sampler jittered --sampler poisson-disk --sampler white --integrand disk:radius=0.25 \
    -n 16..4096 -m 200 --quiet -o variance.csv --plot "$images/variance.png"

# Those of the scene p15/figure6.yaml: three minutes, unless sets of FPO and ccvt-sphere are kept.
echo "figures: p15/figure6_torus.png p15/figure6_sphere.png" >&2
"$pointspec" variance --sampler white --sampler jittered --sampler poisson-disk --sampler fpo --sampler bnot \
    --integrand gaussian:sigma=0.0625 --integrand disk:radius=0.25 --integrand map:width=2000 -n 16,64,256,1024,4096 -m 40 --shifts 10 \
    --quiet -o variance.csv --plot "$images/p15/figure6_torus.png"
"$pointspec" variance --sampler white-sphere --sampler healpix-jittered --sampler poisson-disk-sphere --sampler ccvt-sphere \
    --integrand harmonic:degree=4 --integrand cap -n 12,48,192,768 -m 200 \
    --quiet -o variance.csv --plot "$images/p15/figure6_sphere.png"

# That of the scene p15/figure6f.yaml.
echo "figures: p15/figure6f.png" >&2
"$pointspec" occlusion --mesh "$docs/scenes/p15/box.obj" --camera 2.75,2.75,-8,2.75,2.75,0,40 --image 64x64 --sampler white-sphere \
    --sampler healpix-jittered --sampler poisson-disk-sphere --sampler ccvt-sphere --sampler healpix -n 48,192,768,3072 -m 8 \
    --quiet -o occlusion.csv --plot "$images/p15/figure6f.png"

echo "figures: occlusion.png" >&2
"$pointspec" occlusion --mesh "$docs/scenes/p15/box.obj" --camera 2.75,2.75,-8,2.75,2.75,0,40 --image 112x112 --sampler white-sphere \
    --sampler ccvt-sphere -n 48 --quiet -o occlusion.csv --plot "$images/occlusion.png"

echo "figures: measures.png" >&2
"$pointspec" measure --sampler white --sampler jittered --sampler poisson-disk --sampler bnot -n 256 -m 100 --quiet -o measures.csv \
    --plot "$images/measures.png"

# Points and spectra of the samplers.
"$docs/scripts/points_figures.sh" "$pointspec" "$images"

# Error of S against |k|: 60 random frequencies of the plane in every decade, each engine against
# host_direct, and against it also what a phase 2 pi k.x in float does, all else being exact.
echo "figures: torus_direct_error.png" >&2
decades=9 # up to 10^8; the limit is 2^28 on an axis
"$pointspec" sample --sampler white -n 1000 --seed 3 -o points.txt
awk -v decades=$decades 'BEGIN {
    srand(1)
    print "1 0\n0 1\n1 1\n1 -1"
    for (e = 1; e < decades; e++)
        for (i = 0; i < 60; i++) {
            angle = 6.283185307179586 * rand()
            printf "%d %d\n", 10^e * cos(angle), 10^e * sin(angle)
        }
}' >frequencies.txt
list() { # NAME ARGUMENTS...
    local name=$1
    shift
    "$pointspec" power --quiet --no-self-check --frequencies frequencies.txt "$@" points.txt |
        grep -v '^#' >"$name.csv"
}
list referee --engine host_direct
list single --engine torus_direct --precision single
list double --engine torus_direct --precision double
# |S| / sqrt(N) of a sum whose phases are float: k.x, times 2 pi, each rounded to 24 bits.
awk 'function rounded(x,   e, s) {
         if (x == 0) return 0
         e = int(log(x < 0 ? -x : x) / log(2))
         s = 2 ^ (23 - e)
         x *= s
         return (x < 0 ? -int(0.5 - x) : int(x + 0.5)) / s
     }
     BEGIN { two_pi = rounded(6.283185307179586) }
     NR == FNR { x[++n] = rounded($1); y[n] = rounded($2); next }
     {
         re = im = 0
         for (j = 1; j <= n; j++) {
             phase = rounded(two_pi * rounded(rounded($1 * x[j]) + rounded($2 * y[j])))
             re += cos(phase)
             im -= sin(phase)
         }
         printf "%d,%d,%.17g,\n", $1, $2, (re * re + im * im) / n
     }' points.txt frequencies.txt >naive.csv
sed -i 1i\\k1,k2,power,standard_error naive.csv
for name in single double naive; do
    # Root mean square over a decade, times sqrt(2) as in tests/engines/torus/test_tolerance.c.
    awk -F , 'FNR == 1 { next }
              NR == FNR { expected[FNR] = $3; next }
              {
                  k = sqrt($1 * $1 + $2 * $2)
                  e = int(log(k) / log(10) + 0.5)
                  sum[e] += (sqrt($3) - sqrt(expected[FNR])) ^ 2
                  num[e]++
              }
              END { for (e in sum) print 10 ^ e, sqrt(2 * sum[e] / num[e]) }' \
        referee.csv $name.csv | sort -g >$name.txt
done
gnuplot <<GNUPLOT
set terminal pngcairo size 760,460 font "DejaVu Sans,10"
set output "$images/torus_direct_error.png"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [0.7:1.4e8]
set yrange [1e-17:10]
set grid linecolor "#dddddd"
set xlabel "|k|"
set ylabel "root mean square error of S / sqrt(N)"
set title "Error against frequency, white noise, N = 1000"
set key left top noenhanced
plot "naive.txt" with linespoints pointtype 8 linecolor "#999999" title "phase 2 pi k.x in float", \
     "single.txt" with linespoints pointtype 7 linecolor "#0072b2" title "torus_direct, single", \
     "double.txt" with linespoints pointtype 5 linecolor "#d55e00" title "torus_direct, double", \
     1e-6 with lines dashtype 2 linecolor "#555555" title "default tolerance"
GNUPLOT
for name in single double naive; do
    awk -v name=$name '{ print name, $0 }' $name.txt
done

# Time of one realization against N, for one grid and one list, measured by bench_torus.
echo "figures: torus_direct_time.png" >&2
cases=()
for n in 64 256 1024 4096 16384 65536; do
    m=$((131072 / n))
    cases+=("grid 2 $n 64 $m single" "grid 2 $n 64 $m double" "list 2 $n 4096 $m single")
done
"$build/bench/bench_torus" "${cases[@]}" >bench.txt
grep -E '^(grid|list)' bench.txt
for what in "grid single" "grid double" "list single"; do
    awk -v kind="${what% *}" -v precision="${what#* }" \
        '$1 == kind && $6 == precision { print $3, $7 }' bench.txt >"${what/ /-}.txt"
done
gnuplot <<GNUPLOT
set terminal pngcairo size 760,460 font "DejaVu Sans,10"
set output "$images/torus_direct_time.png"
set logscale xy
set format y "%g"
set grid linecolor "#dddddd"
set xlabel "points N"
set ylabel "ms per realization, best of 9"
set yrange [0.005:200]
set title "torus_direct on $(sed -n 's/^# device: \([^(]*\) (.*, /\1, /p' bench.txt)" noenhanced
set key left top noenhanced
plot "grid-single.txt" with linespoints pointtype 7 linecolor "#0072b2" \
        title "grid K = 64 (8320 frequencies), single", \
     "grid-double.txt" with linespoints pointtype 5 linecolor "#d55e00" \
        title "grid K = 64, double", \
     "list-single.txt" with linespoints pointtype 9 linecolor "#009e73" \
        title "list of 4096 frequencies, single"
GNUPLOT

# Run time against error, for docs/developer/performance.md: the picture of the last update_tables.sh, whose numbers the page has.
echo "figures: bench.png" >&2
bench=$docs/../bench-output/bench.png
[[ -s $bench ]] || { mkdir -p "${bench%/*}" && "$pointspec" bench --quiet -o bench.csv --plot "$bench"; }
cp "$bench" "$images/bench.png"

# Ways to pair sums, for docs/engines/pairs_direct.md: some minutes, unless the last update_tables.sh left its numbers.
echo "figures: pairs_routes.png" >&2
routes=$docs/../bench-output/pairs_routes.txt
[[ -s $routes ]] || { mkdir -p "${routes%/*}" && "$build/bench/bench_pairs" routes >"$routes"; }
"$docs/scripts/pairs_routes.sh" figure "$routes" "$images/pairs_routes.png"

# Figures 1 to 5 of Marques et al., for docs/user/reproduction.md.
"$docs/scripts/reproduction.sh" "$pointspec" figures "$images"
echo "figures: m18/figure6.png" >&2
"$pointspec" interpolation --integrand map:width=512 --sampler white-sphere -n 2500 --smoothness 1.1,1.5,1.9 \
    --quiet -o interpolation.csv --plot "$images/m18/figure6.png"

# Time against error, pointspec and the libraries of others, from the last ./dev bench peers.
for name in peers peers_sphere peers_pairs; do
    peers=$docs/../bench-output/$name.csv
    if [[ -s $peers ]]; then
        echo "figures: $name.png" >&2
        "$docs/../bench/peers/plot.sh" "$peers" "$images/$name.png"
    fi
done

#!/usr/bin/env bash
# points_figures.sh POINTSPEC FOLDER: writes FOLDER/points/*.png, spectra/*.png and p15/figure*.png, pictures of points for
# docs/user/samplers.md, of points and spectra for docs/samplers, and of both papers for docs/user/reproduction.md. Four minutes
# on two cores; needs gnuplot and rsvg-convert.
set -euo pipefail
pointspec=$(realpath "$1") folder=$2
mkdir -p "$folder"/{points,spectra,p15,m18}

points() { # NAME N SAMPLER...
    local name=$1 num=$2 sampler
    local samplers=()
    shift 2
    for sampler; do samplers+=(--sampler "$sampler"); done
    echo "figures: points/$name.png" >&2
    "$pointspec" sample "${samplers[@]}" -n "$num" --plot "$folder/points/$name.png"
}
points torus 256 white regular jittered latin-hypercube sobol sobol:scramble=owen halton hammersley larcher-pillichshammer
points lattices 144 pmj02 sobol:scramble=hash cmj fibonacci-lattice rank1:generator=1x55 kronecker
points blue_noise 1024 jittered poisson-disk fpo bnot
points disks 1024 poisson-disk bridson
points optimized 1024 bnot fpo ccvt
points sphere 768 white-sphere zphi healpix-jittered fibonacci spiral poisson-disk-sphere
points hemisphere 512 white-hemisphere fibonacci-hemisphere fibonacci-hemisphere:morph=diffuse \
    larcher-pillichshammer:lift=hemisphere

# P15's Figures 1 to 5 and M18's Figures 7 and 8, as docs/scenes have them; of Figure 2 one picture of all five results.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
scenes=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/../scenes")
scene() { # NAME: the pictures of a scene in a folder of its name
    echo "figures: $1.png" >&2
    mkdir -p "$scratch/${1%/*}"
    "$pointspec" run "$scenes/$1.yaml" -o "$scratch/$1" >/dev/null
}
scene p15/figure1
rsvg-convert -w 1080 "$scratch/p15/figure1/coefficients-scatter-1.svg" -o "$folder/p15/figure1.png"
scene p15/figure2
gnuplot <<GNUPLOT
set terminal pngcairo size 1260,440 font "DejaVu Sans,10"
set output "$folder/p15/figure2.png"
set multiplot layout 1,3
set grid linecolor "#dddddd"
set key left top
set samples 1000
set title "profile, gamma = alpha = 1, step at 1/sqrt(pi)"
set xlabel "normalized frequency"
set xrange [0:1.5]
set yrange [0:1.8]
law(x, b) = x < 1 ? x ** b : 1
plot 1 linecolor "#555555" title "constant", law(x, 0.5) linecolor "#d55e00" title "b = 0.5", \
     law(x, 1) linecolor "#0072b2" title "b = 1", law(x, 2) linecolor "#009e73" title "b = 2", \
     x < 0.56419 ? 0 : 1 linecolor "#cc79a7" title "step"
set datafile separator ","
set logscale xy
set format y "10^{%L}"
set xlabel "points N"
set ylabel "variance by the profile"
set xrange [50:20000]
set key right top
bound(name, integrand) = sprintf("<grep '^%s' $scratch/p15/figure2/%s.csv", integrand, name)
do for [panel in "gaussian disk"] {
    set title panel eq "gaussian" ? "best case: Gaussian, sigma 1/16" : "worst case: disk, radius 1/4"
    set yrange [panel eq "gaussian" ? 1e-12 : 1e-8 : *]
    plot bound("constant", panel) using 2:11 with linespoints pointtype 7 linecolor "#555555" title "constant", \
         bound("below_1", panel) using 2:11 with linespoints pointtype 7 linecolor "#d55e00" title "b = 0.5", \
         bound("linear", panel) using 2:11 with linespoints pointtype 7 linecolor "#0072b2" title "b = 1", \
         bound("quadratic", panel) using 2:11 with linespoints pointtype 7 linecolor "#009e73" title "b = 2", \
         bound("step", panel) using 2:11 with linespoints pointtype 7 linecolor "#cc79a7" title "step"
}
GNUPLOT
panels() { # NAME SCENE PICTURE...: pictures of a scene, two in a row
    local name=$1 page=$scratch/$2/page.svg i=0 picture
    shift 2
    {
        echo "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"2000\" height=\"$(((($# + 1) >> 1) * 700))\">"
        for picture; do
            echo "<image x=\"$((i % 2 * 1000))\" y=\"$(((i >> 1) * 700))\" width=\"1000\" height=\"700\" href=\"$picture.svg\"/>"
            i=$((i + 1))
        done
        echo '</svg>'
    } >"$page"
    rsvg-convert -w 1100 "$page" -o "$folder/$name.png"
}
scene m18/figure7 # with the map of POINTSPEC_TEST_DATA
panels m18/figure7 m18/figure7 {diffuse,glossy}-rmse-{1,2}
panels m18/figure8 m18/figure7 truncation-rmse truncation-rmse_points
echo "figures: p15/figure3.png" >&2
"$pointspec" sample --sampler healpix --sampler healpix-jittered --sampler ccvt-sphere --sampler poisson-disk-sphere --sampler white-sphere \
    -n 768 --plot "$folder/p15/figure3.png"
spectrum() { # NAME COMMAND SAMPLER...
    local name=$1 what=$2 sampler
    local samplers=()
    shift 2
    for sampler; do samplers+=(--sampler "$sampler"); done
    echo "figures: $name.png" >&2
    local size=(-n 1024 -k 128 -m 200)
    [[ $what == power ]] || size=(-n 3072 -l 222 -m 100)
    "$pointspec" "$what" "${samplers[@]}" "${size[@]}" --quiet -o "$scratch/rows.csv" --plot "$folder/$name.png"
}
spectrum p15/figure4 power jittered poisson-disk fpo bnot step
spectrum p15/figure5 angular white-sphere healpix-jittered poisson-disk-sphere ccvt-sphere
spectrum spectra/poisson_disk power poisson-disk
spectrum spectra/bridson power bridson
spectrum spectra/bnot power bnot
spectrum spectra/fpo power fpo

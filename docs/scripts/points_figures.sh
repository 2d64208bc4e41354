#!/usr/bin/env bash
# points_figures.sh POINTSPEC FOLDER: writes FOLDER/points/*.png, spectra/*.png and p15_figure*.png, pictures of points for
# docs/user/samplers.md and of points and spectra for docs/samplers. Four minutes on two cores.
set -euo pipefail
pointspec=$(realpath "$1") folder=$2
mkdir -p "$folder"/{points,spectra}

points() { # NAME N SAMPLER...
    local name=$1 num=$2 sampler
    local samplers=()
    shift 2
    for sampler; do samplers+=(--sampler "$sampler"); done
    echo "figures: points/$name.png" >&2
    "$pointspec" sample "${samplers[@]}" -n "$num" --plot "$folder/points/$name.png"
}
points torus 256 white regular jittered latin-hypercube sobol sobol:scramble=owen halton hammersley larcher-pillichshammer
points blue_noise 1024 jittered poisson-disk fpo bnot
points disks 1024 poisson-disk bridson
points optimized 1024 bnot fpo ccvt
points sphere 768 white-sphere zphi healpix-jittered fibonacci spiral poisson-disk-sphere
points hemisphere 512 white-hemisphere fibonacci-hemisphere fibonacci-hemisphere:morph=diffuse \
    larcher-pillichshammer:lift=hemisphere

# P15's Figures 3, 4 and 5, as docs/scenes/p15_figure*.yaml have them.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
echo "figures: p15_figure3.png" >&2
"$pointspec" sample --sampler healpix --sampler healpix-jittered --sampler ccvt-sphere --sampler poisson-disk-sphere --sampler white-sphere \
    -n 768 --plot "$folder/p15_figure3.png"
spectrum() { # NAME COMMAND SAMPLER...
    local name=$1 what=$2 sampler
    local samplers=()
    shift 2
    for sampler; do samplers+=(--sampler "$sampler"); done
    echo "figures: $name.png" >&2
    local size=(-n 1024 -k 128)
    [[ $what == power ]] || size=(-n 3072 -l 222)
    "$pointspec" "$what" "${samplers[@]}" "${size[@]}" -m 200 --quiet -o "$scratch/rows.csv" --plot "$folder/$name.png"
}
spectrum p15_figure4 power jittered poisson-disk fpo bnot step
spectrum p15_figure5 angular white-sphere healpix-jittered poisson-disk-sphere ccvt-sphere
spectrum spectra/poisson_disk power poisson-disk
spectrum spectra/bridson power bridson
spectrum spectra/bnot power bnot
spectrum spectra/fpo power fpo

#!/usr/bin/env bash
# points_figures.sh POINTSPEC FOLDER: writes FOLDER/points_*.png, pictures of points for docs/user/samplers.md and
# docs/mathematics. Some seconds on one core.
set -euo pipefail
pointspec=$(realpath "$1") folder=$2

points() { # NAME N SAMPLER...
    local name=$1 num=$2 sampler
    local samplers=()
    shift 2
    for sampler; do samplers+=(--sampler "$sampler"); done
    echo "figures: points_$name.png" >&2
    "$pointspec" sample "${samplers[@]}" -n "$num" --plot "$folder/points_$name.png"
}
points torus 256 white regular jittered latin-hypercube sobol sobol:scramble=owen halton hammersley larcher-pillichshammer
points blue_noise 1024 jittered poisson-disk fpo bnot
points disks 1024 poisson-disk bridson
points optimized 1024 bnot fpo
points sphere 768 white-sphere zphi healpix-jittered fibonacci spiral poisson-disk-sphere
points hemisphere 512 white-hemisphere fibonacci-hemisphere fibonacci-hemisphere:morph=diffuse \
    larcher-pillichshammer:lift=hemisphere

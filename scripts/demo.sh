#!/usr/bin/env bash
# demo.sh PROGRAM FOLDER: the averaged periodogram of samplers that everyone knows, of built-in blue noise, and of
# published sets when the test data are there; angular spectra of samplers of the sphere. FOLDER gets a table and a picture of each and one picture of
# all; the terminal a table whose numbers are computed from those tables.
set -euo pipefail
program=$1 folder=$2
points=1024 realizations=200
blue_points=256 # 200 sets of fpo take 10 s of a processor for 128 points, 31 s for 256; bnot and Poisson disks 3 s
data=${POINTSPEC_TEST_DATA:-../shared/data}/pointsets
mkdir -p "$folder"
rm -f "$folder"/*.csv "$folder"/*.png
summary=$(mktemp)
trap 'rm -f "$summary"' EXIT

# estimate NAME FACT WHAT-TO-LOOK-AT ARGUMENTS...: FACT names the number that demo_facts.awk adds.
estimate() {
    local name=$1 fact=$2 look=$3
    shift 3
    echo "demo: $name" >&2
    "$program" power "$@" --quiet \
        -o "$folder/$name.csv" --plot "$folder/$name.png"
    [[ -s $folder/$name.png ]] || { echo "demo: no picture $folder/$name.png" >&2; exit 1; }
    awk -v name="$name" -v fact="$fact" -v look="$look" -f scripts/demo_facts.awk \
        "$folder/$name.csv" >>"$summary"
}
sampler() { # NAME FACT LOOK SAMPLER
    estimate "$1" "$2" "$3" --sampler "$4" -n $points -k 96 -m $realizations --seed 1
}
blue() { # NAME LOOK
    estimate "$1" ring "$2" --sampler "$1" -n $blue_points -k 48 -m $realizations --seed 1
}
published() { # NAME FACT LOOK
    local file=$data/utk_$1_1024.txt
    [[ ! -f $file ]] || estimate "published-$1" "$2" "$3" "$file" -k 96
}

start=$SECONDS
sampler white flat "flat at 1, no structure" white
sampler jittered slope "no peak; dark middle" jittered
sampler latin-hypercube anisotropy "dark lines on the two axes" latin-hypercube
sampler sobol-owen anisotropy "dark cross along the axes, not a disc" sobol:scramble=owen
blue poisson-disk "grey disc: Poisson disk is not empty there"
blue fpo "empty disc, then rings"
blue bnot "empty disc, then rings"
num_samplers=$(wc -l <"$summary")
published BNOT ring "empty disc, then rings"
published FPO ring "empty disc, then rings"
published dart_throwing ring "grey disc: Poisson disk is not empty there"

curves=$(cut -f 1 "$summary" | tr '\n' ' ')
gnuplot -e "folder='$folder'; curves='$curves'; num_samplers=$num_samplers" scripts/demo.gnuplot

echo "demo: sphere" >&2
"$program" angular --sampler white-sphere --sampler healpix-jittered --sampler fibonacci \
    --sampler sobol:lift=sphere -n 768 -m $realizations -l 96 --homogenize --quiet \
    -o "$folder/sphere.csv" --plot "$folder/sphere.png"
[[ -s $folder/sphere.png ]] || { echo "demo: no picture $folder/sphere.png" >&2; exit 1; }

cat <<TEXT

Radially averaged power; white noise is 1. Frequency in units of sqrt(N), N = $points, of
poisson-disk, fpo and bnot $blue_points; samplers: $realizations realizations, published sets: one each.

TEXT
awk -F '\t' -f scripts/demo_table.awk "$summary"
if [[ ! -d $data ]]; then
    echo
    echo "No published sets: $data is not there (POINTSPEC_TEST_DATA)."
fi
echo
echo "Look at: $folder/comparison.png (all sets), then $folder/NAME.png (spectrum, radial mean with"
echo "error bars, anisotropy), and $folder/sphere.png (four samplers of the sphere, also with"
echo "logarithmic axes); the numbers are in $folder/NAME.csv. Took $((SECONDS - start)) s."

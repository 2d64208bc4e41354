#!/usr/bin/env bash
# cli_weights.sh PROGRAM: weights at the ends of the range of doubles, and sums of them that are 0: a right result, or
# exit 2 and a sentence with the limit.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" weights "$1"

# Points of the torus and of the sphere, above the horizon, with these weights.
make_sets() { # WEIGHT...
    local -i i=0
    local plane=('0.1 0.35' '0.4 0.6' '0.85 0.3') sphere=('0.6 0 0.8' '0 0 1' '-0.48 0.64 0.6') weight
    rm -f plane.txt sphere.txt
    for weight; do
        echo "${plane[i]} $weight" >>plane.txt
        echo "${sphere[i]} $weight" >>sphere.txt
        i+=1
    done
}
on() { # COMMAND: sets command and words, the question about the set
    command=$1 words=(--engine host_direct)
    case $1 in
    power) words+=(-k 3 --columns xyw plane.txt) ;;
    angular | pairs) words+=(-l 3 --columns xyzw sphere.txt) ;;
    quadrature) words+=(-l 3 --brdf diffuse --columns xyzw sphere.txt) ;;
    esac
}
rows() {
    ! grep -qiE '(^|[^a-z])-?(nan|inf)([^a-z]|$)' out || complain "no numbers: $(grep -iE 'nan|inf' out)"
    grep -v '^#' out
}
limits='is not between 1e-60 and 1e+60, where squares of errors are numbers; multiply all weights by a constant'
sums='sum to more than 1e+290, up to which sums over sets are numbers; multiply all weights by a constant'

# ---- powers do not depend on a factor of all weights, from the least double to sums of 1e290
for name in power angular; do
    make_sets 1 2 3
    on $name
    runs 0 "${words[@]}"
    rows >expected
    for weights in '1e160 2e160 3e160' '1e-170 2e-170 3e-170' '1e289 2e289 3e289' '5e-324 1e-323 1.5e-323'; do
        read -r -a list <<<"$weights"
        make_sets "${list[@]}"
        runs 0 "${words[@]}"
        rows | tr , '\n' | paste - <(tr , '\n' <expected) |
            awk 'NF == 2 && $1 != $2 && ($1 - $2) ^ 2 > 1e-24 * $2 ^ 2 { exit 1 }' || complain "$name $weights: $(rows)"
        [[ $(key weight_sum) =~ ^[0-9.e+-]+$ ]] || complain "$name $weights: W = $(key weight_sum)"
    done
    for weights in '1e308 1e308 1.5e308' '1e291 -1e291' '1e160 1e300'; do
        read -r -a list <<<"$weights"
        make_sets "${list[@]}"
        refuses "$sums" "${words[@]}"
        says "pointspec $name: set 1: the largest |weight| is "
    done
done
# Coefficients are weights as they are, and numbers.
make_sets 1e289 2e289 -3e289
on angular
runs 0 "${words[@]}" --normalize effective --coefficients c.npy
python3 -c 'import struct, sys, math
data = open("c.npy", "rb").read()[-160:]
sys.exit(not all(math.isfinite(x) for x in struct.unpack("<20d", data)))' || complain 'coefficients are not finite'

# ---- pairs and quadrature take weights as they are: squares of them are C_l^2
square_sums() { # COLUMN UNIT: of the table in out, divided by the square of the unit
    rows | awk -F, -v column="$1" -v unit="$2" '/^[0-9]/ { printf "%.9e ", $column / unit / unit }'
}
for name in pairs quadrature; do
    on $name
    c2=4 about=("${words[@]:0:4}")
    [[ $name == pairs ]] || c2=5 about+=(--brdf diffuse)
    make_sets 1 -0.25 0.5
    runs 0 "${words[@]}"
    expected=$(square_sums $c2 1)
    for unit in 1e60 1e-60; do
        make_sets $unit "-0.25${unit#1}" "0.5${unit#1}"
        runs 0 "${words[@]}"
        [[ $(square_sums $c2 $unit) == "$expected" ]] || complain "$name $unit: $(square_sums $c2 $unit), not $expected"
    done
    make_sets 1 1e-100 0.5
    runs 0 "${words[@]}"
    rows >mixed
    make_sets 1 0 0.5
    runs 0 "${words[@]}"
    rows | cmp -s - mixed || complain "$name: 1e-100 beside 1 is not as 0: $(diff <(rows) mixed)"
    # Standard errors of small weights are not 0.
    make_sets 1e-60 -0.25e-60 0.5e-60
    cp sphere.txt other.txt
    make_sets 0.5e-60 0.25e-60 1e-60
    runs 0 "${words[@]}" other.txt
    rows | awk -F, -v column=$((c2 + 1)) '/^[1-9]/ && !($column > 0) { exit 1 }' || complain "$name: $(rows)"
    for weights in '1e160 1e160 2e160' '1e-170 2e-170' '1e308 1e308 1.5e308' '5e-324 5e-324' '1.1e60 1' '1e-61 -1e-100'; do
        read -r -a list <<<"$weights"
        make_sets "${list[@]}"
        refuses "$limits" "${words[@]}"
        says "pointspec $name: set 1: the largest |weight|, "
        cut -d ' ' -f 1-3 sphere.txt >plain.txt
        printf '%s\n' "${list[@]}" >list.txt
        refuses "$limits" "${about[@]}" --weights list.txt plain.txt
    done
done

# ---- sums that are 0, or as small as what rounding leaves of 0; all weights 0
for weights in '1 -1' '0.1 0.2 -0.3' '1 -1 1e-16' '1e289 -1e289' '5e-324 -5e-324'; do
    read -r -a list <<<"$weights"
    make_sets "${list[@]}"
    for name in power angular; do
        on $name
        refuses 'use --normalize effective' "${words[@]}"
        says 'set 1: the weights sum to 0'
        [[ ${#list[@]} == 2 || $(<err) == *'sum to 0 within rounding, so'* ]] || complain "rounding: $(<err)"
        runs 0 "${words[@]}" --normalize effective
        rows >/dev/null
    done
done
make_sets 1 -1 1e-10
for name in power angular; do
    on $name
    runs 0 "${words[@]}"
    [[ $(key weight_sum) == 1e-10 ]] || complain "W = $(key weight_sum), not 1e-10"
    rows >/dev/null
done
for name in pairs quadrature; do
    on $name
    make_sets 1 -1
    runs 0 "${words[@]}"
    rows >/dev/null
done
for name in power angular pairs quadrature; do
    make_sets 0 0 0
    on $name
    refuses 'set 1: all weights are 0' "${words[@]}"
done

# ---- other commands: check and run say the same, convert keeps all bits
make_sets 1 2 3
on power
runs 0 "${words[@]}" -o saved.npz
make_sets 1e308 1e308 1e308
command=check
refuses "$sums" --engine host_direct --against saved.npz --columns xyw plane.txt
cat >scene.yaml <<'END'
scene: 1
defaults: {engine: host_direct}
results:
  - {result: pairs, files: sphere.txt, columns: xyzw, max-degree: 3, plot: false}
END
command=run
runs 2 scene.yaml -o folder
[[ $(<err) == *"$limits"* ]] || complain "run: $(<err)"
make_sets 1.7976931348623157e+308 5e-324 -1e-170
cp plane.txt before.txt
command=convert
runs 0 --columns xyw plane.txt -o plane.npy
runs 0 --columns xyw plane.npy -o after.txt
diff <(awk '{ print $3 }' before.txt) <(awk '!/^#/ { print $3 }' after.txt) >diff.txt || complain "convert: $(<diff.txt)"
# ---- an array of weights is one however it is packed, in every command
make_sets 1 2 3.5
cut -d' ' -f1-2 plane.txt >xy.txt
cut -d' ' -f1-3 sphere.txt >xyz.txt
cut -d' ' -f3 plane.txt >weights.txt
{
    header="{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }"
    printf '\x93NUMPY\1\0\x76\0%-117s\n' "$header"
    printf '\0\0\0\0\0\0\xf0\x3f\0\0\0\0\0\0\0\x40\0\0\0\0\0\0\x0c\x40'
} >weights.npy
gzip -c weights.npy >weights.npy.gz
for name in power angular pairs quadrature; do
    on $name
    words=("${words[@]/*.txt/xyz.txt}") words=("${words[@]/xyzw/xyz}")
    [[ $name != power ]] || words=(--engine host_direct -k 3 xy.txt)
    runs 0 "${words[@]}" --weights weights.txt
    rows >expected
    for file in weights.npy weights.npy.gz; do
        runs 0 "${words[@]}" --weights $file
        rows | cmp -s - expected || complain "$name: $file gives other numbers than weights.txt"
    done
done
finish

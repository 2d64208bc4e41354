#!/usr/bin/env bash
# cli_stress_broken.sh PROGRAM KERNELS: drivers that compute wrongly, by kernels with one line broken: pointspec stress
# fails, and names the case. Each breaks as a driver might: maths, double precision, barriers, addresses.
kernels=$(realpath "$2")
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" stress "$1"

# FILE OLD NEW CASE ENGINE PRECISION: with OLD, which is one line of FILE, as NEW
breaks() {
    local file=$1 old=$2 new=$3 case=$4 engine=$5 precision=$6
    rm -rf broken
    cp -r "$kernels" broken
    awk -v old="$old" -v new="$new" '
        (at = index($0, old)) > 0 && !done {
            $0 = substr($0, 1, at - 1) new substr($0, at + length(old))
            done = 1
        }
        { print }
        END { exit !done }' "$kernels/$file" >"broken/$file" || complain "$file has no \"$old\""
    POINTSPEC_KERNEL_DIR=$PWD/broken runs 3 --case "$case" --engine "$engine" --precision "$precision"
    grep -qE "^$case,$engine,$precision,.*,fail(:|$)" out || complain "$file, $new: no failure of $case: $(<out)"
    says "failed, the first of them $case by $engine in $precision precision"
}

# maths: a literal of double precision rounded to float, a fused product rounded twice, a remainder that is lost
breaks shared/turn.h 3.1415926535897932323 3.1415926535897932323f frequencies-1e3 torus_direct double
breaks torus/phase.h 'turn + AS_WORDV(TO_SWORDV(low))' turn frequencies-1e6 torus_direct single
breaks pairs/walk.h 'fma((realv)inverses[i], e, p)' 'p + (realv)((float)inverses[i]) * e' pairs-white pairs_direct double
# exponents of numbers too small for a float
breaks sphere/scaled.h 'high < (realv)SCALED_LOW ? x->scale - (swordv)1 : x->scale' x-\>scale high-degree-white sphere_direct single
# a twiddle factor of the wrong sign
breaks nufft/transform/butterfly.h '(complexv){a.re + b.im, a.im - b.re}' '(complexv){a.re - b.im, a.im + b.re}' white torus_nufft single
# an index off by one
breaks torus/fold.cl 'uint chunk = 0' 'uint chunk = 1' white torus_direct single
# barriers that do not wait: CPUs need work-groups of more than one work-item to tell
breaks accumulate/blocks.cl 'barrier(CLK_LOCAL_MEM_FENCE);' '' groups-averages averages single
finish

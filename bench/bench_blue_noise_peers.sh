#!/usr/bin/env bash
# bench_blue_noise_peers.sh CLONE [ROW]: sets of 1024 to 16384 points by our samplers and by those of others, at the same stop
# (docs/developer/peers.md). CLONE is a clone of UTK (bench/blue_noise/peers.sh says which); what is built goes into
# build/peers/blue_noise. BUILD is the folder of our build (default build/dev).
set -euo pipefail
(($# == 1 || $# == 2)) || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
bench=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
built=$bench/../build/peers/blue_noise
"$bench/blue_noise/peers.sh" "$1" "$built"
# The linear algebra of a peer in one thread, as everything else here.
exec env OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "${BUILD:-$bench/../build/dev}/bench/bench_blue_noise" peers "$built" "${2-}"

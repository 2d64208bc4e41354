#!/usr/bin/env bash
# predict.sh PROGRAM: what PROGRAM, pointspec, plans for jobs on an H200 that is not there (launches.c, which says that a
# device of this machine is one): a table with the seconds of the whole command and of its kernels, beside those that were
# measured on one on 2026-11-28, before kernels were written for GPUs. The host's are those of this machine's processors.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
program=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${CC:-cc}" -std=gnu11 -shared -fPIC -DCL_TARGET_OPENCL_VERSION=120 "$here/launches.c" -o "$folder/launches.so"
export POINTSPEC_LAUNCHES=/dev/null POINTSPEC_CACHE_DIR=$folder/cache

printf '%9s %9s %9s %9s  %-14s %-9s %s\n' predicted kernels measured kernels engine precision command
while IFS='|' read -r seconds kernels words; do
    # shellcheck disable=SC2086 # words of a command
    LD_PRELOAD=$folder/launches.so "$program" plan $words </dev/null |
        awk -v seconds="$seconds" -v kernels="$kernels" -v words="$words" '
            /^# seconds: / { all = $3 }
            /^# phase: powers; / { powers = $4; engine = $6; precision = $8 }
            END { printf "%9s %9s %9s %9s  %-14s %-9s %s\n", all, powers, seconds, kernels, engine, precision, words }'
done <<'END'
1.97|0.41|power --sampler white -n 256 -k 32 -m 200000
1.14|0.28|power --sampler white -n 1024 -k 128 -m 20000
1.22|0.36|power --sampler white -n 4096 -k 256 -m 4000
2.1|1.08|power --sampler white -n 16384 -k 512 -m 1000
2.19|0.87|power --sampler white -n 1e7 -k 1024
1.65|0.82|power --sampler white -d 3 -n 1e6 -k 64 -m 4
1.96|0.27|angular --sampler white-sphere -n 1024 -l 64 -m 20000
1.2|0.50|angular --sampler white-sphere -n 4096 -l 256 -m 1000
0.88|0.22|angular --sampler white-sphere -n 1e6 -l 1000
2.35|0.16|quadrature --brdf glossy:n=30 --sampler white-hemisphere -n 1024 -m 2000
0.60|0.05|pairs --sampler white-sphere -n 4096 -l 256 -m 100
END

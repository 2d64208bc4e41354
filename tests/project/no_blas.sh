#!/usr/bin/env bash
# no_blas.sh PROGRAM LIBRARY: neither loads a BLAS with threads, whose buffers of 128 MB are asked for over and over where
# memory is refused, nor any LAPACK. GSL brings its own BLAS, plain loops.
set -euo pipefail
for file in "$@"; do
    loaded=$(ldd "$file")
    if grep -iE 'openblas|lapack|/libblas|mkl|atlas|blis' <<<"$loaded" >&2; then
        echo "no_blas: $file loads these" >&2
        exit 1
    fi
    grep -q libc.so <<<"$loaded" || { echo "no_blas: ldd says nothing of $file" >&2; exit 1; }
done
! nm -u --dynamic "$2" | grep -E ' (cblas_|dpo[a-z]*_|dtr[a-z]*_|openblas)'

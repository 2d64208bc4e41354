#!/usr/bin/env bash
# test_headers.sh SOURCE_DIR C_COMPILER: every header compiles alone. The public ones as C and as
# C++, with every compiler found here; the internal and the kernels' shared ones as C11.
set -euo pipefail
source_dir=$1 compiler=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

compiled=0 bad=0
compile_alone() { # HEADER SUFFIX COMPILER OPTIONS...
    local header=$1 file=$scratch/alone.$2
    shift 2
    printf '#include "%s"\n#include "%s"\nextern int alone;\n' "$header" "$header" >"$file"
    compiled=$((compiled + 1))
    "$@" -Wall -Wextra -Wpedantic -Wshadow -Werror -fsyntax-only "$file" || {
        echo "failed: $header with $*" >&2
        bad=1
    }
}

public=("$source_dir"/host/include/pointspec/*.h)
public=("${public[@]#"$source_dir/host/include/"}")
include=(-I "$source_dir/host/include")
for cc in "$compiler" gcc clang; do
    command -v "$cc" >/dev/null || continue
    for standard in c99 c11 c17; do
        for header in "${public[@]}"; do
            compile_alone "$header" c "$cc" -std=$standard -Wstrict-prototypes -Wconversion "${include[@]}"
        done
    done
done
for cxx in g++ clang++; do
    command -v "$cxx" >/dev/null || continue
    for standard in c++11 c++17; do
        for header in "${public[@]}"; do
            compile_alone "$header" cc "$cxx" -std=$standard "${include[@]}"
        done
    done
done

include+=(-I "$source_dir/host" -I "$source_dir/kernels" -D_POSIX_C_SOURCE=200809L
    -D_FILE_OFFSET_BITS=64 -DCL_TARGET_OPENCL_VERSION=120)
while IFS= read -r header; do
    compile_alone "$header" c "$compiler" -std=c11 -Wno-unused-function "${include[@]}"
done < <(cd "$source_dir" && find host/*/ -name '*.h' -not -path 'host/include/*' | sed 's|^host/||' | sort
    cd "$source_dir/kernels" && find shared -name '*.h' | sort)

echo "headers: $compiled compilations"
exit $bad

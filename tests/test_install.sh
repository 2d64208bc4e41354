#!/usr/bin/env bash
# test_install.sh SOURCE_DIR BUILD_DIR C_COMPILER: installs into an empty folder, moves that folder,
# and builds and runs tests/consume against it by CMake and by pkg-config, shared and static.
set -euo pipefail
source_dir=$1 build_dir=$2 compiler=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
consume=$source_dir/tests/consume
example=$source_dir/docs/examples/many_realizations.c
prefix=$scratch/moved

cmake --install "$build_dir" --prefix "$scratch/installed" >/dev/null
mv "$scratch/installed" "$prefix" # what is installed must not know where it was put
libdir=$(dirname "$(find "$prefix" -name libpointspec.a)")
"$prefix/bin/pointspec" --help >/dev/null
echo "installed: program runs"

needs_shared() {
    readelf -d "$1" | grep -q 'NEEDED.*libpointspec\.so'
}
check_program() { # shared|static PROGRAM
    if [[ $1 == shared ]]; then
        needs_shared "$2" || { echo "$2 does not use the shared library" >&2; return 1; }
    else
        ! needs_shared "$2" || { echo "$2 uses the shared library" >&2; return 1; }
    fi
    LD_LIBRARY_PATH=$libdir "$2" | grep -q "^[0-9]" || { echo "$2 prints no spectrum" >&2; return 1; }
}

cmake -S "$consume" -B "$scratch/cmake" -DCMAKE_C_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$prefix" \
    >/dev/null
cmake --build "$scratch/cmake" >/dev/null
for kind in shared static; do
    check_program $kind "$scratch/cmake/consume_$kind"
    echo "installed: CMake, $kind"
done

export PKG_CONFIG_PATH=$libdir/pkgconfig
words() { # pkg-config's answer as words, one per line
    pkg-config "$@" pointspec | xargs -n 1
}
mapfile -t cflags < <(words --cflags)
mapfile -t libs < <(words --libs)
mapfile -t static_libs < <(words --static --libs)
"$compiler" -std=c11 -Wall -Werror "${cflags[@]}" "$example" "${libs[@]}" \
    -o "$scratch/pc_shared"
check_program shared "$scratch/pc_shared"
echo "installed: pkg-config, shared"
"$compiler" -std=c11 -Wall -Werror "${cflags[@]}" "$example" -Wl,--as-needed \
    -Wl,--whole-archive "$libdir/libpointspec.a" -Wl,--no-whole-archive "${static_libs[@]}" \
    -o "$scratch/pc_static"
check_program static "$scratch/pc_static"
echo "installed: pkg-config, static"

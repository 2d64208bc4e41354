#!/usr/bin/env bash
# test_install.sh SOURCE_DIR BUILD_DIR C_COMPILER: installs into an empty folder, moves that folder,
# and builds and runs the examples of the documentation, and those of the installed manual page, against it
# by CMake and by pkg-config, shared and static. What was installed can be taken away again, without a trace.
set -euo pipefail
source_dir=$1 build_dir=$2 compiler=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
examples=("$source_dir"/docs/examples/*.c)

mkdir "$scratch/used"
touch "$scratch/used/file"
for prefix in "$scratch/für alle" "$scratch/used"; do
    cmake --install "$build_dir" --prefix "$prefix" >/dev/null
    cmake -DMANIFEST="$build_dir/install_manifest.txt" -DPREFIX="$prefix" -P "$source_dir/cmake/uninstall.cmake" 2>/dev/null
done
[[ $(cd "$scratch" && find . | sort) == $'.\n./für alle\n./used\n./used/file' ]] || { find "$scratch" >&2; exit 1; }
echo "installed: and uninstalled"

prefix=$scratch/moved
cmake --install "$build_dir" --prefix "$scratch/installed" >/dev/null
mv "$scratch/installed" "$prefix" # what is installed must not know where it was put
libdir=$(dirname "$(find "$prefix" -name libpointspec.a)")
"$prefix/bin/pointspec" --help >/dev/null
for file in docs/user/tutorial.md docs/scenes/rates.yaml docs/examples/sphere.c; do
    [[ -f $prefix/share/doc/pointspec/$file ]] || { echo "$file is not installed" >&2; exit 1; }
done
echo "installed: program runs"

# ---- the manual page: every example is a whole program; every function is named ----------------------
page=$(find "$prefix" -name pointspec.3)
"$source_dir/tests/project/man_examples.sh" "$page" "$scratch/page"
pages=("$scratch"/page/*.c)
cmp "${pages[0]}" <(sed '1,/^ \*\/$/d' "$source_dir/docs/examples/one_pattern.c") ||
    { echo "pointspec.3 does not have docs/examples/one_pattern.c" >&2; exit 1; }
while IFS= read -r name; do
    grep -qE "^\.(Fo|Ft|Fn|It Fn|Nm) (.* )?$name( |$)" "$page" ||
        { echo "pointspec.3 lacks $name" >&2; exit 1; }
done < <(nm -D --defined-only "$(readlink -f "$libdir/libpointspec.so")" | awk '{ print $NF }' | grep '^pspec_')
if command -v groff >/dev/null; then
    said=$(groff -mdoc -Tascii -ww -z "$page" 2>&1)
    [[ -z $said ]] || { echo "$page: $said" >&2; exit 1; }
fi
echo "installed: pointspec.3 names every function, ${#pages[@]} examples"

# ---- programs ----------------------------------------------------------------------------------------
needs_shared() {
    readelf -d "$1" | grep -q 'NEEDED.*libpointspec\.so'
}
check_program() { # shared|static PROGRAM
    if [[ $1 == shared ]]; then
        needs_shared "$2" || { echo "$2 does not use the shared library" >&2; return 1; }
    else
        ! needs_shared "$2" || { echo "$2 uses the shared library" >&2; return 1; }
    fi
    (cd "$scratch" && LD_LIBRARY_PATH=$libdir "$2" 2>errors >output) ||
        { echo "$2 failed: $(<"$scratch/errors")" >&2; return 1; }
    grep -q "^[0-9]" "$scratch/output" || { echo "$2 prints no spectrum" >&2; return 1; }
}
list=$(IFS=';' && echo "${pages[*]}")
cmake -S "$source_dir/tests/consume" -B "$scratch/cmake" -DCMAKE_C_COMPILER="$compiler" \
    -DCMAKE_PREFIX_PATH="$prefix" -DEXTRA="$list" >/dev/null
cmake --build "$scratch/cmake" --parallel 2 >"$scratch/log" || { cat "$scratch/log" >&2; exit 1; }
for kind in shared static; do
    for source in "${examples[@]}" "${pages[@]}" own_names; do
        check_program $kind "$scratch/cmake/$(basename "$source" .c)_$kind"
    done
    echo "installed: CMake, $kind"
done

# Where no other library has its development files, pointspec still has what programs need to be compiled.
alone=$(PKG_CONFIG_PATH='' PKG_CONFIG_LIBDIR=$libdir/pkgconfig pkg-config --cflags --libs pointspec)
[[ $alone == *-lpointspec* && $alone != *-lyaml* ]] ||
    { echo "pkg-config alone says \"$alone\"" >&2; exit 1; }

export PKG_CONFIG_PATH=$libdir/pkgconfig
words() { # pkg-config's answer as words, one per line
    pkg-config "$@" pointspec | xargs -n 1
}
mapfile -t cflags < <(words --cflags)
mapfile -t libs < <(words --libs)
mapfile -t static_libs < <(words --static --libs)
for source in "${examples[@]}"; do
    "$compiler" -std=c11 -Wall -Werror "${cflags[@]}" "$source" "${libs[@]}" -lm \
        -o "$scratch/pc_shared"
    check_program shared "$scratch/pc_shared"
done
echo "installed: pkg-config, shared"
for source in "${examples[@]}"; do
    "$compiler" -std=c11 -Wall -Werror "${cflags[@]}" "$source" -Wl,--as-needed \
        -Wl,--whole-archive "$libdir/libpointspec.a" -Wl,--no-whole-archive "${static_libs[@]}" \
        -o "$scratch/pc_static"
    check_program static "$scratch/pc_static"
done
echo "installed: pkg-config, static"

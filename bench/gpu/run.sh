#!/usr/bin/env bash
# run.sh [--quick]: builds pointspec in a copy of the working tree on a machine with one NVIDIA GPU, its driver
# and a compiler, with the packages of build/carry (bench/gpu/carry.sh) and no network; runs the tests of the
# kernels, bench_nufft, bench_torus and bench_device, prints one table (bench/bench_device.c says what its
# columns are), and leaves everything in OUT (default build/gpu). Without such a GPU it takes the
# device that there is, or POINTSPEC_DEVICE. --quick: three small cases. The exit code is 1 when a test of the
# kernels did not run or did not pass; what can be measured is measured first.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
cd "$here/../.."
carry=$PWD/build/carry
unpacked=$PWD/build/carried
out=${OUT:-$PWD/build/gpu}
mkdir -p "$out"
say() { echo "gpu: $*" >&2; }

large=("65536 1024 16 1e-6 single" "65536 1024 8 1e-12 double" "65536 32768 64 1e-6 double 1")
cases=() nufft_cases=() torus_cases=()
if [[ ${1-} == --quick ]]; then
    cases=("2 256 32 256 1e-6 single" "2 1024 128 8 1e-12 double")
    nufft_cases=("256 32 256 1e-6 single" "1024 128 8 1e-12 double")
    torus_cases=("grid 2 256 32 256 single")
    large=("65536 256 2 1e-6 single")
fi

# ---- packages --------------------------------------------------------------------------------

unpack() { # FOLDER
    [[ -d $carry/$1 && ! -d $unpacked/$1 ]] || return 0
    local deb link
    mkdir -p "$unpacked/$1"
    for deb in "$carry/$1"/*.deb; do dpkg -x "$deb" "$unpacked/$1"; done
    # Links to places on the machine that the package was made for.
    while IFS= read -r -d '' link; do
        ln -sfn "$unpacked/$1$(readlink "$link")" "$link"
    done < <(find "$unpacked/$1" -type l -lname '/*' -print0)
}
library_path() { # FOLDER
    find "$unpacked/$1" -type f -name '*.so*' -printf '%h\n' | sort -u | paste -sd:
}

use_libraries() {
    unpack libraries
    [[ -d $unpacked/libraries ]] || { say "no $carry/libraries: with what is installed"; return; }
    local root=$unpacked/libraries path
    path=$(library_path libraries)
    export PATH=$PATH:$root/usr/bin LD_LIBRARY_PATH=$path${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
    export CMAKE_PREFIX_PATH=$root/usr GSL_ROOT_DIR=$root/usr C_INCLUDE_PATH=$root/usr/include
    export LIBRARY_PATH=$path PKG_CONFIG_SYSROOT_DIR=$root
    PKG_CONFIG_LIBDIR=$(find "$root" -type d -name pkgconfig | paste -sd:)
    export PKG_CONFIG_LIBDIR
}

# The machine's own CMake, else the one carried, which alone sees its libraries.
use_cmake() {
    command -v cmake >/dev/null && return
    unpack cmake
    local tool
    mkdir -p "$unpacked/tools"
    for tool in cmake ctest; do
        cat >"$unpacked/tools/$tool" <<EOF
#!/bin/sh
LD_LIBRARY_PATH=$(library_path cmake) exec $unpacked/cmake/usr/bin/$tool "\$@"
EOF
        chmod +x "$unpacked/tools/$tool"
    done
    export PATH=$unpacked/tools:$PATH
}

# The driver is there, the file that tells the loader about it may not be.
use_driver() {
    local driver
    driver=$({ ldconfig -p | awk '/libnvidia-opencl\.so/ { print $NF }'
        find /usr/local/nvidia /usr/lib /usr/lib64 -name 'libnvidia-opencl.so.*'; } 2>/dev/null | head -n 1) || true
    [[ -n $driver ]] || { say "no libnvidia-opencl: the drivers of the loader"; return; }
    mkdir -p "$unpacked/vendors"
    echo "$driver" >"$unpacked/vendors/nvidia.icd"
    export OCL_ICD_VENDORS=$unpacked/vendors LD_LIBRARY_PATH=${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}${driver%/*}
    export POINTSPEC_DEVICE=${POINTSPEC_DEVICE-gpu}
}

# ---- work ------------------------------------------------------------------------------------

configure() { # PRESET
    scripts/configure.sh "$1" "${options[@]}" >>"$out/build.txt" 2>&1
}

build() { # PRESET [cmake --build arguments]
    flock "build/$1.lock" cmake --build --preset "$1" --parallel "${JOBS:-$(nproc)}" "${@:2}" >>"$out/build.txt" 2>&1
}

# The dev build has assertions, which the release does not.
test_kernels() {
    local names targets
    configure dev || { say "no tests: $(tail -n 1 "$out/build.txt")"; return 1; }
    names=$("$here/kernel_tests.sh" list build/dev) || return 1
    mapfile -t targets <<<"$names"
    build dev --target "${targets[@]/#/test_}" || { say "no tests: $(tail -n 1 "$out/build.txt")"; return 1; }
    "$here/kernel_tests.sh" run build/dev "$out/tests.txt" >&2
}

# cuFINUFFT on the cases of the table, where its wheel was carried and loads.
run_peer() {
    local wheel
    [[ -d $carry/python ]] || return 0
    wheel=$(find "$carry/python" -name 'cufinufft-*.whl' -print -quit)
    python3 -m zipfile -e "$wheel" "$unpacked/python"
    awk '!/^#/ && NR > 3 && !seen[$1 FS $2 FS $3 FS $5]++ { print $1, $2, $3, $8, $5, $6 }' "$out/table.txt" |
        PYTHONPATH=$unpacked/python python3 "$here/cufinufft_cases.py" >"$out/peer.txt" 2>"$out/peer_errors.txt" ||
        echo "# no cufinufft: $(tail -n 1 "$out/peer_errors.txt")" >>"$out/peer.txt"
    cat "$out/peer.txt" >>"$out/table.txt"
}

use_libraries
use_cmake
use_driver
options=()
[[ ! -d $unpacked/libraries ]] || options=(-DPOINTSPEC_WERROR=OFF) # another compiler, other warnings
# Kernels are compiled once for tests, benchmarks and other presets, by drivers that keep them here.
export POCL_CACHE_DIR=${POCL_CACHE_DIR:-$PWD/build/pocl-cache}
: >"$out/build.txt"
if ! configure release || ! build release --target bench_device bench_nufft bench_torus; then
    tail -n 20 "$out/build.txt" >&2
    exit 1
fi
nvidia-smi -L 2>/dev/null >"$out/device.txt" || true
clinfo -l >>"$out/device.txt" 2>&1 || true
failed=0
test_kernels || failed=1
benches=build/release/bench
"$benches/bench_device" "${cases[@]}" >"$out/table.txt"
run_peer
"$benches/bench_nufft" "${nufft_cases[@]}" >"$out/nufft.txt"
"$benches/bench_nufft" "${large[@]}" | tail -n +2 >>"$out/nufft.txt"
"$benches/bench_torus" "${torus_cases[@]}" >"$out/torus.txt"
cat "$out/table.txt"
exit $failed

#!/usr/bin/env bash
# run.sh [--quick]: builds pointspec in a copy of the working tree on a machine with one NVIDIA GPU, its driver
# and a compiler, with the packages of build/carry (bench/gpu/carry.sh) and no network; runs the tests of the
# kernels, bench_nufft, bench_torus and bench_device, prints one table (bench/bench_device.c says what its
# columns are), and leaves everything in OUT (default build/gpu). Without such a GPU it takes the
# device that there is, or POINTSPEC_DEVICE. --quick: two small cases.
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

build() { # PRESET [cmake --build arguments]
    cmake --preset "$1" "${options[@]}" >"$out/build.txt" 2>&1 &&
        cmake --build --preset "$1" --parallel "${JOBS:-$(nproc)}" "${@:2}" >>"$out/build.txt" 2>&1
}

test_kernels() {
    local targets
    options=(-DPOINTSPEC_WERROR=OFF) # another compiler, other warnings
    mapfile -t targets < <(sed -n 's/^set(KERNEL_TESTS \(.*\))$/\1/p' tests/CMakeLists.txt | tr ' ' '\n' | sed 's/^/test_/')
    build dev --target "${targets[@]}" || { say "no tests: $(tail -n 1 "$out/build.txt")"; return; }
    ctest --preset dev -L kernel >"$out/tests.txt" 2>&1 || true
    say "kernels: $(grep 'tests passed' "$out/tests.txt" || tail -n 1 "$out/tests.txt"), $(
        grep -c '\*\*\*Skipped' "$out/tests.txt") skipped"
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
build release || { tail -n 20 "$out/build.txt" >&2; exit 1; }
nvidia-smi -L 2>/dev/null >"$out/device.txt" || true
clinfo -l >>"$out/device.txt" 2>&1 || true
test_kernels
benches=build/release/bench
"$benches/bench_device" "${cases[@]}" >"$out/table.txt"
run_peer
"$benches/bench_nufft" "${nufft_cases[@]}" >"$out/nufft.txt"
"$benches/bench_nufft" "${large[@]}" | tail -n +2 >>"$out/nufft.txt"
"$benches/bench_torus" "${torus_cases[@]}" >"$out/torus.txt"
cat "$out/table.txt"

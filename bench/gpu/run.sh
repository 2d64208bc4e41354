#!/usr/bin/env bash
# run.sh [--quick]: builds pointspec in a copy of the working tree on a machine with one NVIDIA GPU, its driver
# and a compiler, with the packages of build/carry (bench/gpu/carry.sh) and no network; runs the tests of the
# kernels, bench_nufft, bench_torus and bench_device, prints one table (bench/bench_device.c says what its
# columns are), and leaves everything in OUT (default build/gpu). Without such a GPU it takes the
# device that there is, or POINTSPEC_DEVICE. --quick: three small cases. Every case is a process of its own, which is
# ended after PATIENCE seconds (default 60; rows take 2 to 6 on an H200, stress 34) with what it has. The exit code is
# 1 when a test of the kernels did not run or did not pass, or a case failed; all that can be measured is measured first.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
cd "$here/../.."
carry=$PWD/build/carry
unpacked=$PWD/build/carried
out=${OUT:-$PWD/build/gpu}
mkdir -p "$out"
say() { echo "gpu: $*" >&2; }

large=("65536 1024 16 1e-6 single" "65536 1024 8 1e-12 double" "65536 32768 64 1e-6 double 1")
cases=() nufft_cases=() torus_cases=() kernels=.
if [[ ${1-} == --quick ]]; then
    cases=("2 256 32 256 1e-6 single" "2 1024 128 8 1e-12 double")
    nufft_cases=("256 32 256 1e-6 single" "1024 128 8 1e-12 double")
    torus_cases=("grid 2 256 32 256 single")
    large=("65536 256 2 1e-6 single")
    kernels='^kernels_(fft|values)$'
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

build() { # TARGET...
    { scripts/configure.sh dev "${options[@]}" &&
        flock build/dev.lock cmake --build --preset dev --parallel "${JOBS:-$(nproc)}" --target "$@"; } >>"$out/build.txt" 2>&1
}

test_kernels() {
    local names targets
    names=$("$here/kernel_tests.sh" list build/dev "$kernels") || return 1
    mapfile -t targets <<<"$names"
    build "${targets[@]/#/test_}" || { say "no tests: $(tail -n 1 "$out/build.txt")"; return 1; }
    "$here/kernel_tests.sh" run build/dev "$out/tests.txt" "$kernels" >&2
}

# shellcheck source=bench/gpu/measure.sh
. "$here/measure.sh"

# cuFINUFFT on the cases of the table, where its wheel, or its package built for the CUDA there, was carried.
run_peer() {
    local wheel libraries
    [[ -d $carry/python ]] || return 0
    wheel=$(find "$carry/python" -name 'cufinufft-*.whl' -print -quit)
    if [[ -n $wheel ]]; then python3 -m zipfile -e "$wheel" "$unpacked/python"; fi
    libraries=$(find /usr /opt -name 'libcufft.so.*' -printf '%h\n' 2>/dev/null | sort -u | paste -sd:)
    awk '!/^#/ && NR > 3 && !seen[$1 FS $2 FS $3 FS $5]++ { print $1, $2, $3, $8, $5, $6 }' "$out/table.txt" |
        PYTHONPATH=$unpacked/python:$carry/python LD_LIBRARY_PATH=$LD_LIBRARY_PATH:$libraries \
            timeout "$patience" python3 "$here/cufinufft_cases.py" >"$out/peer.txt" 2>"$out/peer_errors.txt" ||
        echo "# no cufinufft: $(tail -n 1 "$out/peer_errors.txt")" >>"$out/peer.txt"
    cat "$out/peer.txt" >>"$out/table.txt"
}

# Where the time of a job goes, by kernels.
profiles=(
    "power --sampler white -n 256 -k 32 -m 200000" "power --sampler white -n 4096 -k 256 -m 2000"
    "power --sampler white -n 1e7 -k 1024" "power --sampler white -d 3 -n 1e6 -k 64 -m 4"
    "power --sampler white -d 1 -n 65536 -k 32768 -m 200" "power --sampler white -n 1024 -k 64 -m 4000 --tol 1e-9"
    "angular --sampler white-sphere -n 1024 -l 64 -m 20000" "angular --sampler white-sphere -n 4096 -l 256 -m 1000"
    "angular --sampler white-sphere -n 1e6 -l 1000" "pairs --sampler white-sphere -n 4096 -l 256 -m 100"
    "quadrature --brdf glossy:n=30 --sampler white-hemisphere -n 1024 -m 2000"
    "variance --integrand disk --sampler white -n 1024 -m 1000")
profile() {
    local each
    for each in "${profiles[@]}"; do
        echo "## $each" | tee -a "$out/profile.errors.txt" >>"$out/profile.txt"
        # shellcheck disable=SC2086 # words of a command
        measure profile build/dev/pointspec $each --seed 1 --profile -o /dev/null
    done
}

use_libraries
use_cmake
use_driver
options=()
patience=${PATIENCE:-60}
[[ ! -d $unpacked/libraries ]] || options=(-DPOINTSPEC_WERROR=OFF) # another compiler, other warnings
# Kernels are compiled once for tests, benchmarks and other presets, by drivers that keep them here.
export POCL_CACHE_DIR=${POCL_CACHE_DIR:-$PWD/build/pocl-cache}
rm -f "$out"/*.txt
if ! build pointspec_program bench_device bench_nufft bench_torus; then
    tail -n 20 "$out/build.txt" >&2
    exit 1
fi
nvidia-smi -L 2>/dev/null >"$out/device.txt" || true
clinfo -l >>"$out/device.txt" 2>&1 || true
failed=0
measure doctor build/dev/pointspec doctor
test_kernels || failed=1
benches=build/dev/bench
measure_cases table "$benches/bench_device" "${cases[@]}"
run_peer
measure_cases nufft "$benches/bench_nufft" "${nufft_cases[@]}"
measure_cases large "$benches/bench_nufft" "${large[@]}"
measure_cases torus "$benches/bench_torus" "${torus_cases[@]}"
if [[ ${1-} != --quick ]]; then
    profile
    measure stress build/dev/pointspec stress --quick
fi
cat "$out/table.txt"
exit $failed

#!/usr/bin/env bash
# install.sh FOLDER: the peers of bench_peers.sh, into FOLDER and nothing outside of it. Each is tried from
# its source with native flags, then as a wheel; one that cannot be had is one line, and the bench runs
# without it. What is there is left as it is: FOLDER/NAME.how says how it was installed; remove that
# file, or FOLDER, to try again. PEERS_JOBS compilers at a time (default 1; a build takes minutes).
set -uo pipefail
(($# == 1)) || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
mkdir -p "$1"
cd "$1" || exit 1
folder=$PWD
export CMAKE_BUILD_PARALLEL_LEVEL=${PEERS_JOBS:-1} MAKEFLAGS=-j${PEERS_JOBS:-1}
pip=$folder/venv/bin/pip

quietly() { # LOG COMMAND...
    local log=$folder/$1.log
    shift
    nice -n 10 "$@" >>"$log" 2>&1 </dev/null
}
is_settled() { # NAME
    [[ -s $1.how ]]
}
settle() { # NAME HOW...
    local name=$1
    shift
    echo "$*" >"$name.how"
    echo "peers: $name: $*" >&2
}
give_up() { # NAME: not written down, so that the next run tries again
    echo "peers: no $1: $(tail -n 1 "$1.log" 2>/dev/null); see $folder/$1.log" >&2
}

# The sources of a package as the registry has them, in sources/NAME-VERSION; prints that folder.
unpack() { # NAME LOG
    local have
    have=$(find sources -maxdepth 1 -type d -name "$1-*" -print -quit 2>/dev/null)
    if [[ -z $have ]]; then
        mkdir -p sources
        quietly "$2" "$pip" download --no-deps --no-binary "$1" --dest sources "$1" || return 1
        quietly "$2" tar -C sources -xzf sources/"$1"-*.tar.gz || return 1
        have=$(find sources -maxdepth 1 -type d -name "$1-*" -print -quit)
    fi
    [[ -n $have ]] && realpath "$have"
}

# The header library that finufft's spreader is written with; a wheel of pythran has it.
unpack_xsimd() { # LOG
    if [[ ! -f sources/pythran/xsimd/xsimd.hpp ]]; then
        mkdir -p sources
        quietly "$1" "$pip" download --no-deps --only-binary :all: --dest sources pythran || return 1
        quietly "$1" venv/bin/python -m zipfile -e sources/pythran-*.whl sources || return 1
    fi
    realpath sources/pythran
}

install_environment() {
    is_settled environment && return
    { quietly environment python3 -m venv venv &&
        quietly environment "$pip" install numpy; } || { give_up environment; exit 1; }
    settle environment numpy
}

# The C loops that call the peers, so that Python is not what is measured.
install_loops() {
    [[ libloops.so -nt $here/loops.c && libloops.so -nt $here/loops_sphere.c ]] && return
    quietly loops "${CC:-cc}" -std=c11 -O3 -march=native -fPIC -shared -o libloops.so "$here"/loops*.c -lm ||
        { give_up loops; exit 1; }
}

install_ducc0() {
    is_settled ducc0 && return
    echo "peers: building ducc0, some minutes" >&2
    if DUCC0_OPTIMIZATION=native-strip quietly ducc0 "$pip" install --no-binary ducc0 ducc0; then
        settle ducc0 source, -march=native
    elif quietly ducc0 "$pip" install --only-binary ducc0 ducc0; then
        settle ducc0 wheel
    else
        give_up ducc0
    fi
}

# finufft with the FFT of FFTW or with that of ducc0, since either can be the faster one.
build_finufft() { # NAME ON|OFF
    local name=$1 xsimd ducc0=
    xsimd=$(unpack_xsimd "$name") || return 1
    if [[ $2 == ON ]]; then
        ducc0=$(unpack ducc0 "$name") || return 1
    fi
    echo "peers: building $name, some minutes" >&2
    PEERS_XSIMD=$xsimd PEERS_DUCC0=$ducc0 CPM_SOURCE_CACHE=$folder/cpm quietly "$name" "$pip" install \
        --no-binary finufft --no-deps --target "$name" --upgrade \
        --config-settings=cmake.define.CPM_DOWNLOAD_VERSION=peers \
        --config-settings=cmake.define.FINUFFT_USE_DUCC0="$2" finufft
}
install_finufft() {
    quietly environment "$pip" install packaging
    mkdir -p cpm/cpm
    cp "$here"/cmake/*.cmake cpm/cpm/
    is_settled finufft-fftw || if build_finufft finufft-fftw OFF; then
        settle finufft-fftw source, -march=native, FFTW of Debian
    else
        give_up finufft-fftw
    fi
    is_settled finufft-ducc0 || if build_finufft finufft-ducc0 ON; then
        settle finufft-ducc0 source, -march=native, FFT of ducc0
    else
        give_up finufft-ducc0
    fi
    is_settled finufft-fftw || is_settled finufft-ducc0 || is_settled finufft-wheel && return
    if quietly finufft-wheel "$pip" install --only-binary :all: --no-deps --target finufft-wheel finufft; then
        settle finufft-wheel wheel
    else
        give_up finufft-wheel
    fi
}

install_nfft() {
    is_settled nfft && return
    if quietly nfft "$pip" install pynfft3; then
        settle nfft wheel of pynfft3
    else
        give_up nfft
    fi
}

install_environment
install_loops
install_nfft
install_finufft
install_ducc0
exit 0

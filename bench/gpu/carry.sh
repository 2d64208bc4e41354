#!/usr/bin/env bash
# carry.sh [--cufinufft VERSION]: downloads what bench/gpu/run.sh needs on a machine without network into
# build/carry: the Debian packages of the groups build and test (scripts/packages.txt) and what they
# depend on, but no compiler and no Python; with --cufinufft the wheel of that version for PYTHON (default
# 3.12) in the place of CMake, since with the sources everything stays below 64 MiB. Debian or Ubuntu, no
# older than this one, can use the packages.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
peer=
case ${1-} in
    '') ;;
    --cufinufft) peer=${2:?a version} ;;
    *) sed -n '2,6s/^# //p' "$0" >&2; exit 2 ;;
esac

# All that an empty machine would get with these packages.
resolve() { # PACKAGE...
    apt-get -s -o Dir::State::status=/dev/null install --no-install-recommends "$@" |
        awk '$1 == "Inst" { print $2 }' | sort -u
}

download() { # FOLDER PACKAGE...
    mkdir -p "build/carry/$1"
    (cd "build/carry/$1" && shift && apt-get -qq download "$@" 2>/dev/null)
}

mapfile -t wanted < <(awk '$1 == "build" || $1 == "test" { print $2 }' scripts/packages.txt |
    grep -vx -e build-essential -e cmake -e python3-numpy)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# There is a compiler, hence what compilers need; but the link to zlib is to its very version.
resolve build-essential | grep -vx zlib1g >"$scratch/there"
resolve "${wanted[@]}" clinfo >"$scratch/libraries"
resolve cmake >"$scratch/cmake"
mapfile -t libraries < <(comm -23 "$scratch/libraries" "$scratch/there")
# CMake apart: its libraries are not to be taken by other programs of the machine.
mapfile -t cmake < <(comm -23 "$scratch/cmake" "$scratch/there")

rm -rf build/carry
download libraries "${libraries[@]}"
if [[ -z $peer ]]; then
    download cmake "${cmake[@]}"
else
    python3 -m pip download -q --no-deps --only-binary=:all: --implementation cp \
        --python-version "${PYTHON:-3.12}" --platform manylinux_2_17_x86_64 \
        --platform manylinux_2_28_x86_64 -d build/carry/python "cufinufft==$peer"
fi

limit_kib=$((64 << 10))
sources_kib=$(git ls-files -z | du -ck --files0-from=- | awk 'END { print $1 }')
carry_kib=$(du -sk build/carry | cut -f1)
echo "carry: $(find build/carry -type f | wc -l) files, $carry_kib KiB, sources $sources_kib KiB" >&2
((carry_kib + sources_kib < limit_kib)) || { echo "carry: that is more than $limit_kib KiB" >&2; exit 1; }

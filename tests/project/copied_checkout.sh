#!/usr/bin/env bash
# copied_checkout.sh SOURCE_DIR: a checkout that was copied with its build folder is configured anew and says so
# (scripts/configure.sh, which ./dev and bench/gpu/run.sh go through); where nothing was copied nothing is said.
set -euo pipefail
source_dir=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "copied checkout: $*" >&2; exit 1; }

mkdir -p "$scratch/one/scripts"
cp "$source_dir/scripts/configure.sh" "$scratch/one/scripts"
cat >"$scratch/one/CMakeLists.txt" <<'TEXT'
cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES NONE)
set(WORD none CACHE STRING "")
file(WRITE ${CMAKE_BINARY_DIR}/word ${WORD})
TEXT
cat >"$scratch/one/CMakePresets.json" <<'TEXT'
{"version": 6, "configurePresets": [{"name": "dev", "generator": "Ninja", "binaryDir": "${sourceDir}/build/dev"}]}
TEXT
configure() { # FOLDER [OPTIONS]
    (cd "$scratch/$1" && scripts/configure.sh dev "${@:2}" 2>&1)
}
said=$(configure one -DWORD=first) || fail "a new checkout: $said"
[[ -z $said && $(<"$scratch/one/build/dev/word") == first ]] || fail "a new checkout: $said"
said=$(configure one) || fail "a second time: $said"
[[ -z $said && $(<"$scratch/one/build/dev/word") == first ]] || fail "a second time: $said"

cp -a "$scratch/one" "$scratch/two"
(cd "$scratch/two" && ! cmake --preset dev >"$scratch/log" 2>&1) || fail "cmake takes a copied build folder by now"
said=$(configure two) || fail "a copy: $said"
[[ $said == *"build/dev was made for $scratch/one; it is begun anew" ]] || fail "a copy says: $said"
[[ $(<"$scratch/two/build/dev/word") == none ]] || fail "a copy kept the options of the other"
[[ $(<"$scratch/one/build/dev/word") == first ]] || fail "a copy changed its original"
said=$(configure two) || fail "a copy, a second time: $said"
[[ -z $said ]] || fail "a copy, a second time: $said"

# ./dev and bench/gpu/run.sh configure in no other way.
if grep -nE '^[^#]*cmake .*--preset' "$source_dir/dev" "$source_dir/bench/gpu/run.sh" | grep -v -- '--build'; then
    fail "a script configures by itself"
fi
echo "copied checkout: begun anew"

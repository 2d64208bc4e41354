#!/usr/bin/env bash
# bench_measures.sh CLONE: measures of white sets of 10^3 to 10^6 points by pointspec, psa and freud (docs/user/measure.md),
# whole commands, the least of three. CLONE is a clone, bare or not, of psa's public repository, https://github.com/nodag/psa;
# it is built without CGAL into build/peers/psa, and needs cairo (libcairo2-dev). freud-analysis is installed beside it.
# BUILD is the folder of our build (default build/dev).
set -euo pipefail
(($# == 1)) || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
bench=$here/..
clone=$(readlink -f "$1")
program=$(readlink -f "${BUILD:-$bench/../build/dev}/pointspec")
mkdir -p "$bench/../build/peers"
cd "$bench/../build/peers"
[[ -d psa ]] || { mkdir psa.part && git -C "$clone" archive HEAD | tar -x -C psa.part && mv psa.part psa; }
[[ -x psa/psa ]] || make -C psa HAVE_CGAL=0 CXXFLAGS='-w -fopenmp -O3 -march=native' >psa.log 2>&1
[[ -d measures ]] || { python3 -m venv measures && measures/bin/pip install -q freud-analysis; }
# Caches of its own: PoCL's is listed at every start, and that of a developer has thousands of kernels.
export POINTSPEC_CACHE_DIR=$PWD/measures/cache POCL_CACHE_DIR=$PWD/measures/kernels
exec env PYTHONPYCACHEPREFIX="$PWD/measures/pycache" measures/bin/python "$here/peers.py" "$program" "$PWD/psa/psa"

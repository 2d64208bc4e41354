#!/usr/bin/env bash
# bench_peers.sh [OPTIONS]: averaged periodograms and angular power spectra by pointspec and by libraries of
# others, at equal measured error (docs/developer/peers.md; --help lists the options). The libraries are installed into
# build/peers.
set -euo pipefail
bench=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
cd "$bench/.."
"$bench/peers/install.sh" build/peers
# Python's byte code stays out of the sources.
exec env PYTHONPYCACHEPREFIX="$PWD/build/peers/pycache" build/peers/venv/bin/python "$bench/peers/main.py" "$@"

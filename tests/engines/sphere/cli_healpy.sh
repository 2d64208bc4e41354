#!/usr/bin/env bash
# cli_healpy.sh PROGRAM FOLDER: cli_healpy.py by the first python that has something to compare with: that of the
# path, or the one that `./dev bench peers` has installed into FOLDER.
set -euo pipefail
here=$(dirname "$0")
export PYTHONDONTWRITEBYTECODE=1
for python in python3 "$2/venv/bin/python"; do
    command -v "$python" >/dev/null || continue
    code=0
    "$python" "$here/cli_healpy.py" "$1" || code=$?
    [[ $code == 77 ]] || exit "$code"
done
echo 'cli_healpy: skipped, no python with healpy or ducc0'
exit 77

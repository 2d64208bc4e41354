#!/usr/bin/env bash
# reference.sh FOLDER: the reference of the public headers as FOLDER/html, by doxygen. A warning is an error;
# without doxygen the exit code is 77.
set -euo pipefail
mkdir -p "$1"
folder=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
command -v doxygen >/dev/null || { echo "no doxygen" >&2; exit 77; }
{
    cat docs/Doxyfile
    echo "OUTPUT_DIRECTORY = \"$folder\""
    echo "PROJECT_NUMBER = $(sed -n 's/^project(pointspec VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)"
} | doxygen -
[[ -f $folder/html/index.html ]]

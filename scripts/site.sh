#!/usr/bin/env bash
# site.sh FOLDER: the pages of docs/ as FOLDER/index.html by mkdocs, and the reference of the public headers beside them as
# FOLDER/reference by doxygen. A warning is an error; without one of the two programs the exit code is 77.
set -euo pipefail
mkdir -p "$1"
folder=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
for program in mkdocs doxygen; do
    command -v $program >/dev/null || { echo "no $program" >&2; exit 77; }
done
# From standard input, since mkdocs refuses pages in the folder of its own settings.
mkdocs build --quiet --strict --config-file - --site-dir "$folder" <docs/mkdocs.yml
{
    cat docs/Doxyfile
    echo "OUTPUT_DIRECTORY = \"$folder\""
    echo "PROJECT_NUMBER = $(sed -n 's/^project(pointspec VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)"
} | doxygen -
[[ -f $folder/index.html && -f $folder/reference/index.html ]]

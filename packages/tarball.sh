#!/usr/bin/env bash
# tarball.sh FOLDER: FOLDER/pointspec-VERSION.tar.gz, the sources of the last commit; the same commit has the same bytes.
set -euo pipefail
mkdir -p "$1"
folder=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
version=$(sed -n 's/^project(pointspec VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
git -c safe.directory='*' archive --prefix="pointspec-$version/" HEAD | gzip -n9 >"$folder/pointspec-$version.tar.gz"
echo "$folder/pointspec-$version.tar.gz"

#!/usr/bin/env bash
# release.sh FOLDER: tarball, wheel and Debian packages of the last commit in FOLDER, with SHA256SUMS. All is made twice, and
# must have the same bytes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=$(realpath -m "$1")
SOURCE_DATE_EPOCH=$(git -c safe.directory='*' log -1 --format=%ct)
export SOURCE_DATE_EPOCH
[[ -z $(git -c safe.directory='*' status --porcelain) ]] || { echo "release: there are changes that are not committed" >&2; exit 1; }

make_all() { # FOLDER
    local tarball sources
    rm -rf "$1"
    mkdir -p "$1"
    tarball=$(packages/tarball.sh "$1")
    sources=$(mktemp -d)
    tar xf "$tarball" -C "$sources" --strip-components 1 # what is not committed does not come in
    (cd "$sources" && ./dev wheel >/dev/null && cp build/wheel/*.whl "$1/")
    rm -rf "$sources"
    ./dev deb "$1" >/dev/null
    (cd "$1" && sha256sum -- * >SHA256SUMS)
}
make_all "$folder.again"
make_all "$folder"
diff "$folder.again/SHA256SUMS" "$folder/SHA256SUMS" || { echo "release: other bytes the second time" >&2; exit 1; }
rm -rf "$folder.again"
cat "$folder/SHA256SUMS"

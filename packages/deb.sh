#!/usr/bin/env bash
# deb.sh TARBALL FOLDER: Debian packages of these sources (packages/debian) and their source package in FOLDER, looked at
# by lintian, whose warnings are errors. The same sources on the same system have the same bytes.
set -euo pipefail
tarball=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
version=${tarball##*/pointspec-}
version=${version%.tar.gz}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
cp "$tarball" "pointspec_$version.orig.tar.gz"
tar xf "$tarball"
cp -r "pointspec-$version/packages/debian" "pointspec-$version/debian"
cd "pointspec-$version"
DEB_BUILD_OPTIONS="noautodbgsym parallel=${JOBS:-$(nproc)}" dpkg-buildpackage -us -uc --build=full >../log 2>&1 || { tail -n 60 ../log >&2; exit 1; }
cd ..
# There is no bug of Debian that asks for the package, and no address that answers mail.
lintian --allow-root --fail-on error,warning ./*.changes \
    --suppress-tags initial-upload-closes-no-bugs,bogus-mail-host,bogus-mail-host-in-debian-changelog
cp ./*.deb ./*.dsc ./*.debian.tar.* ./*.orig.tar.gz "$folder"
ls "$folder"/*.deb

#!/usr/bin/env bash
# packages.sh PROGRAM ROOT: what packages/ says of the project is true: its version, what is built and installed, and the step
# of a pipeline, which is run here as a runner would.
set -euo pipefail
program=$(realpath "$1") root=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
bad=0
complain() {
    printf 'packages: %s\n' "$*" >&2
    bad=1
}

version=$("$program" --version | grep -oE '[0-9]+\.[0-9]+\.[0-9]+')
(cd "$root" && grep -q "^## $version (" CHANGELOG.md) || complain "CHANGELOG.md has no $version"
for place in "debian/changelog:^pointspec ($version-[0-9]" "spack/package.py:version(\"$version\")" "conda/recipe.yaml:version: \"$version\"" \
    "debian/control:^Package: libpointspec${version%.*}\$"; do
    grep -q "${place#*:}" "$root/packages/${place%%:*}" || complain "packages/${place%%:*} is not of $version"
done

# What the build needs stands in one list, and packages have it.
while read -r package; do
    [[ $package == build-essential ]] || grep -qE "(^| )$package(,|\$)" "$root/packages/debian/control" || complain "debian/control lacks $package"
done < <(awk '$1 == "build" { print $2 }' "$root/scripts/packages.txt")
while read -r package; do
    for place in debian/control container/Containerfile; do
        grep -q "$package" "$root/packages/$place" || complain "packages/$place lacks $package"
    done
done < <(awk '$1 == "run" { print $2 }' "$root/scripts/packages.txt")

# The step that compares, with a runner's variables in the place of inputs.
awk '/name: Compare spectra/ { on = 1 } on && run { print substr($0, 9) } on && /run: \|/ { run = 1 }' "$root/packages/action/action.yml" >step.sh
grep -q 'pointspec check' step.sh || complain "no step: $(<step.sh)"
mkdir bin
ln -s "$program" bin/pointspec
export PATH=$PWD/bin:$PATH POINTSPEC_DEVICE=cpu VERDICT=verdict.csv AGAINST=saved.npz
export POINTSPEC_CACHE_DIR=$scratch/cache
pointspec devices 2>/dev/null | grep -q '^[0-9]' || exit $((bad ? bad : 77))
pointspec power --sampler jittered -n 64 -m 64 -k 12 -o saved.npz
step() { # EXIT ARGUMENTS
    local code=0
    rm -f verdict.csv
    ARGUMENTS=$2 bash -e step.sh >out 2>&1 || code=$?
    [[ $code == "$1" && -s verdict.csv ]] || complain "step: exit $code, not $1: $(<out)"
}
step 0 '--sampler jittered -m 16 -s 5'
pointspec sample --sampler latin-hypercube -n 64 -m 32 -o points.txt
step 3 'point*.txt'
exit $bad

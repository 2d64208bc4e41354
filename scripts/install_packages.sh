#!/usr/bin/env bash
# install_packages.sh GROUP...: installs the Debian packages of these groups (packages.txt) that are
# missing, and says which. Nothing missing: no network, no root. Elsewhere than on Debian it prints
# what is needed and leaves the rest to the build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

wanted=()
for group in "$@"; do
    mapfile -t -O "${#wanted[@]}" wanted < <(
        awk -v group="$group" '$1 == group { print $2 }' packages.txt)
done

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "dev: not a Debian system; needed are what Debian calls: ${wanted[*]}" >&2
    exit 0
fi

is_installed() {
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}
missing=()
for package in "${wanted[@]}"; do
    is_installed "$package" || missing+=("$package")
done
((${#missing[@]})) || exit 0

as_root=()
if [[ $(id -u) != 0 ]]; then
    if ! command -v sudo >/dev/null; then
        echo "dev: please install as root, there is no sudo here: apt-get install ${missing[*]}" >&2
        exit 1
    fi
    as_root=(sudo)
    [[ -t 2 ]] || as_root+=(-n) # nobody there to type a password
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get -y -qq -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3)

echo "dev: installing ${missing[*]}" >&2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
for attempt in 1 2 3 4; do
    if { "${apt[@]}" update && "${apt[@]}" install --no-install-recommends "${missing[@]}"; } \
        >"$log" 2>&1 </dev/null; then
        exit 0
    fi
    echo "dev: attempt $attempt failed: $(tail -n 1 "$log")" >&2
    sleep $((attempt * 3))
done
cat "$log" >&2
echo "dev: could not install: ${missing[*]}" >&2
exit 1

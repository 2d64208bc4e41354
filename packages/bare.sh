#!/usr/bin/env bash
# bare.sh RELEASE_FOLDER WAY...: a bare Debian 12 (mmdebstrap, as root), in which pointspec is installed as a new user does
# it, from the packages, the wheel or the sources (deb, wheel, source) of ./dev release: seconds from there to the first
# picture or page, with the network's; and of deb every command of CHANGELOG.md, and what a purge leaves behind.
set -euo pipefail
release=$(realpath "$1")
shift
scratch=$(mktemp -d)
root=$scratch/root
leave() {
    umount "$root/proc" "$root/sys" "$root/dev" 2>/dev/null || true
    rm -rf --one-file-system "$scratch"
}
trap leave EXIT

enter() { # COMMANDS of the shell
    chroot "$root" /usr/bin/env -i HOME=/srv PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        DEBIAN_FRONTEND=noninteractive PIP_CERT=/srv/certificates sh -ec "cd /srv; $1"
}
make_root() {
    [[ -f $scratch/root.tar ]] || mmdebstrap --quiet --variant=minbase bookworm "$scratch/root.tar"
    umount "$root/proc" "$root/sys" "$root/dev" 2>/dev/null || true
    rm -rf --one-file-system "$root"
    mkdir "$root"
    tar xf "$scratch/root.tar" -C "$root"
    for folder in proc sys dev; do # as containers have them; PoCL looks up processors in sys
        mount --bind "/$folder" "$root/$folder"
    done
    cp /etc/resolv.conf "$root/etc/"
    cp /etc/ssl/certs/ca-certificates.crt "$root/srv/certificates" # those that this machine's network has
    cp -r "$release" "$root/srv/release"
}
# What install_packages.sh and apt say goes to a log, which is shown where a step fails.
first_picture() { # WAY COMMANDS
    local begin=$SECONDS
    enter "$2" >"$scratch/log" 2>&1 || { tail -n 40 "$scratch/log" >&2; echo "bare.sh: $1 failed" >&2; return 1; }
    echo "$1: $((SECONDS - begin)) s"
}
page='pointspec sample --sampler sobol:scramble=owen -n 256 -o mine.txt && pointspec report mine.txt -o mine.html && test -s mine.html'

try_deb() {
    first_picture deb "apt-get -qq update; apt-get -qq install ./release/pointspec_*.deb ./release/libpointspec0*.deb ./release/pointspec-doc_*.deb; $page"
    # every command of the list of changes, in an empty folder, by what was installed
    # shellcheck disable=SC2016 # marks of Markdown
    sed -n '/^```sh$/,/^```$/p' "$root/usr/share/doc/pointspec/CHANGELOG.md" | grep -v '^```' >"$root/srv/rows.sh"
    enter 'mkdir rows; cd rows; sh -e ../rows.sh' >"$scratch/log" 2>&1 || { tail -n 20 "$scratch/log" >&2; return 1; }
    echo "deb: commands of CHANGELOG.md: $(grep -c pointspec "$root/srv/rows.sh")"
    enter 'apt-get -qq purge pointspec libpointspec0.9 pointspec-doc' >"$scratch/log" 2>&1
    find "$root/usr" "$root/etc" "$root/var/lib/dpkg/info" -name '*pointspec*' >"$scratch/left"
    [[ ! -s $scratch/left ]] || { cat "$scratch/left" >&2; return 1; }
    echo 'deb: a purge leaves nothing'
}
try_wheel() {
    first_picture wheel "apt-get -qq update; apt-get -qq install python3-venv pocl-opencl-icd; python3 -m venv v; v/bin/pip -q install ./release/pointspec-*.whl matplotlib
        v/bin/python -c 'import pointspec; pointspec.plot(pointspec.power(sampler=\"jittered\", points=256, realizations=20)).figure.savefig(\"mine.png\")'; test -s mine.png"
}
try_source() {
    first_picture source 'apt-get -qq update; tar xf release/pointspec-*.tar.gz; cd pointspec-*; ./dev demo; test -s demo-output/comparison.png'
}
for way in "$@"; do
    make_root
    "try_$way"
done

#!/usr/bin/env bash
# configure.sh PRESET [cmake options]: configures build/PRESET of the working folder. A build folder that came along
# with a copied checkout is of another source folder, which CMake refuses: it is begun anew then. Waits while another
# process configures or builds there: commands of ./dev may run at the same time.
set -euo pipefail
preset=$1
shift
cache=build/$preset/CMakeCache.txt
fresh=()
if [[ -f $cache ]]; then
    home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$cache")
    made=$(sed -n 's/^CMAKE_CACHEFILE_DIR:INTERNAL=//p' "$cache")
    if [[ ! $home -ef . || ! $made -ef build/$preset ]]; then
        echo "configure: build/$preset was made for ${home:-nothing}; it is begun anew" >&2
        fresh=(--fresh)
    fi
fi
mkdir -p build
flock "build/$preset.lock" cmake "${fresh[@]}" --preset "$preset" "$@" >/dev/null # what goes wrong is on standard error

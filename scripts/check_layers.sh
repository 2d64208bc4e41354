#!/usr/bin/env bash
# check_layers.sh [ROOT]: every #include "room/..." in host/ goes down, never up, and no folder is a heap.
# The rooms from the lowest to the highest: a file may include headers of its own room and of those before it.
# A folder inside a room that is not named here counts as its room.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

rooms=(
    base math math/random math/linear device files store points tables plots
    samplers samplers/torus samplers/sphere integrands frequencies
    engines engines/host engines/nufft engines/torus engines/torus/nufft engines/sphere engines/sphere/nufft
    engines/pairs plan spectra rules jobs jobs/parts jobs/spectrum jobs/quadrature verify verify/bench
    questions report results scene scene/run api cli cli/commands
)
most_files=25 # of a folder; corpora of the fuzz targets excepted

declare -A rank=()
for i in "${!rooms[@]}"; do
    rank[${rooms[i]}]=$i
done

# The longest room that the path lies in, or nothing.
room_of() {
    local folder=$1
    while [[ $folder == */* ]]; do
        folder=${folder%/*}
        [[ -z ${rank[$folder]+known} ]] || { room=$folder && return; }
    done
    room=""
}

bad=0
while IFS=: read -r file line text; do
    target=${text#*\"}
    target=${target%%\"*}
    room_of "$target"
    [[ -n $room ]] || continue # public, shared/, generated
    to=$room
    room_of "${file#host/}"
    if [[ -z $room ]]; then
        echo "$file is in no room; add its folder to scripts/check_layers.sh" >&2
        bad=1
    elif ((rank[$to] > rank[$room])) && [[ $file != */table.c ]]; then # a room's table names what is in its folders
        echo "$file:$line: $room may not include $to" >&2
        bad=1
    fi
done < <(grep -rnE --include='*.[ch]' '^[[:space:]]*#[[:space:]]*include[[:space:]]*"[^"]*/' host)

while IFS= read -r folder; do
    num=$(find "$folder" -maxdepth 1 -type f | wc -l)
    if ((num > most_files)); then
        echo "$folder has $num files, more than $most_files: a prefix that five of them share is a folder" >&2
        bad=1
    fi
done < <(find host kernels tests scripts docs -type d -not -path 'tests/fuzz/corpus*')
exit $bad

#!/usr/bin/env bash
# check_layers.sh [ROOT]: every #include "room/..." in host/ goes down, never up, and no folder is a heap.
# The rooms are those of rooms.sh: a file may include headers of its own room and of those before it.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

# shellcheck source=scripts/rooms.sh
. scripts/rooms.sh
most_files=25 # of a folder; corpora of the fuzz targets excepted

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
    elif ((rank[$to] > rank[$room])) && [[ " ${tables[*]} " != *" ${file#host/} "* ]]; then
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
done < <(find host kernels tests bench scripts docs -type d -not -path 'tests/fuzz/corpus*')
exit $bad

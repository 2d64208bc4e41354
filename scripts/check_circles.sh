#!/usr/bin/env bash
# check_circles.sh BUILD: by the symbols of that build's object files, no file of host/ needs one that needs it, directly or
# through others, and none needs a file of a higher room (rooms.sh). The tables that rooms.sh lists name what is in rooms
# above them, and cli/commands.c and cli/main.c are above all.
set -euo pipefail
build=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/rooms.sh
. scripts/rooms.sh

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for folder in pointspec_objects pointspec_program; do
    root=$build/CMakeFiles/$folder.dir/host
    find "$root" -name '*.c.o' -printf '%P\n' | while IFS= read -r object; do
        if [[ -f host/${object%.o} ]]; then echo "$object"; fi # no object of a file that is gone
    done >"$scratch/objects"
    (cd "$root" && xargs -r nm -A <"$scratch/objects") # FILE.o:[VALUE] KIND SYMBOL
done >"$scratch/symbols"
awk '{ file = $1; sub(/\.o:.*/, "", file) }
     $(NF - 1) == "U" { from[++num] = file; symbol[num] = $NF }
     $(NF - 1) ~ /^[TDBRV]$/ { owner[$NF] = file }
     END { for (i = 1; i <= num; i++)
               if (symbol[i] in owner && owner[symbol[i]] != from[i]) print from[i], owner[symbol[i]] }' \
    "$scratch/symbols" | sort -u >"$scratch/edges"
[[ -s $scratch/edges ]] || { echo "check_circles: no object files in $build" >&2; exit 1; }

bad=0
while read -r from to; do
    case " ${tables[*]} cli/commands.c cli/main.c " in *" $from "*) continue ;; esac
    room_of "$from" && mine=$room
    room_of "$to"
    if ((rank[$room] > rank[$mine])); then
        echo "host/$from: $mine needs host/$to of the higher room $room" >&2
        bad=1
    fi
done <"$scratch/edges"

# What needs no file that is left, or is needed by none, is in no circle and is left out, over and over. An edge that is
# left is part of a circle where its end needs its beginning.
awk '{ from[++num] = $1; to[num] = $2; is_left[num] = 1 }
     function leave_out(   i, is_less) {
         split("", needs)
         split("", is_needed)
         for (i = 1; i <= num; i++) if (is_left[i]) { needs[from[i]] = needs[from[i]] " " to[i]; is_needed[to[i]] = 1 }
         for (i = 1; i <= num; i++)
             if (is_left[i] && !(to[i] in needs && from[i] in is_needed)) { is_left[i] = 0; is_less = 1 }
         return is_less
     }
     function reaches(begin, end,   queue, seen, list, first, last, i, n) {
         queue[last = 1] = begin
         for (first = 1; first <= last; first++) {
             n = split(needs[queue[first]], list, " ")
             for (i = 1; i <= n; i++) {
                 if (list[i] == end) return 1
                 if (!(list[i] in seen)) { seen[list[i]] = 1; queue[++last] = list[i] }
             }
         }
         return 0
     }
     END { while (leave_out()) continue
           for (i = 1; i <= num; i++)
               if (is_left[i] && reaches(to[i], from[i])) print "    host/" from[i] " -> host/" to[i] }' \
    "$scratch/edges" >"$scratch/circles"
if [[ -s $scratch/circles ]]; then
    echo "files that need each other in a circle:" >&2
    cat "$scratch/circles" >&2
    bad=1
fi
exit $bad

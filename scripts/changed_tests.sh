#!/usr/bin/env bash
# changed_tests.sh BUILD SECONDS [FILE...]: the names of the tests of that build folder, one a line, that ask what became of
# changed files: of their rooms, however long these take, then of the rooms that include theirs, then of those that
# include these, while they fit into SECONDS of a processor by the times of earlier runs (CTest keeps them). Those of the
# room cli are tests of the whole program, and have to fit, too. Sweeps and the tests of the documentation are for
# ./dev test. What is left out is counted on standard error.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=$1 seconds=$2
shift 2

# The room of a file, the first folder: of kernels also the room of their own tests.
rooms_of() { # FILE
    case $1 in
    kernels/*/*) echo kernels && cut -d / -f 2 <<<"$1" ;;
    kernels/*) echo kernels ;;
    host/include/*) echo api ;;
    host/*/* | tests/*/*) cut -d / -f 2 <<<"$1" ;;
    dev | scripts/* | bench/* | .ci/*) echo project ;;
    docs/man/*) echo cli ;;
    esac
}

# Lines "DISTANCE ROOM", of rooms by the includes of others.
distances() {
    { for file in "$@"; do rooms_of "$file"; done | sed 's/^/changed /'
        grep -rhoE --include='*.[ch]' '^[[:space:]]*#[[:space:]]*include "[a-z]+/' host --with-filename |
            sed -E 's|^host/([a-z]+)/.*"([a-z]+)/$|includes \1 \2|' | sort -u; } |
        awk '$1 == "changed" { distance[$2] = 0 }
            $1 == "includes" && $2 != $3 { user[++num] = $2; used[num] = $3 }
            END {
                for (step = 0; step < 30; step++)
                    for (i = 1; i <= num; i++)
                        if (used[i] in distance && distance[used[i]] == step && !(user[i] in distance))
                            distance[user[i]] = step + 1
                for (room in distance) print distance[room], room
            }'
}

# Lines "NAME ROOM" of all tests of files, and of the engines that one of these asks one by one.
tests_of_rooms() {
    find tests -name 'test_*.c' -o -name 'cli_*.sh' -o -path 'tests/project/*.sh' |
        sed -E 's|^tests/([^/]*)/(.*/)?([^/]*)\.[a-z]*$|\3 \1|; s|^test_||'
    sed -n 's/^engine_contract_.*/& engines/p' "$build/known_tests.txt"
    echo faults faults
    echo fuzz_corpus fuzz
}

costs=$build/Testing/Temporary/CTestCostData.txt
[[ -f $costs ]] || costs=/dev/null
ctest --test-dir "$build" -N -LE 'sweep|oclgrind' | sed -nE 's/^ *Test +#[0-9]+: (.*)$/\1/p' >"$build/known_tests.txt"
awk '
    FILENAME == ARGV[1] { known[$1]; next }
    FILENAME == ARGV[2] { if (NF == 3) cost[$1] = $3; next }
    FILENAME == ARGV[3] { distance[$2] = $1; next }
    $1 in known && $2 in distance { print distance[$2], ($1 in cost ? cost[$1] : 2), $1, $2 }' \
    "$build/known_tests.txt" "$costs" <(distances "$@") <(tests_of_rooms) |
    sort -k 1,1n -k 2,2g | awk -v seconds="$seconds" '
        ($1 == 0 && $4 != "cli") || used + $2 <= seconds { used += $2; print $3; next }
        { left++; left_seconds += $2 }
        END { if (left) printf "changed_tests: %d tests of rooms above are left out, %.0f s; ./dev test has them\n",
                  left, left_seconds >"/dev/stderr" }'

#!/usr/bin/env bash
# check_lengths.sh [ROOT]: reports files above 400 lines (kernels 300) and functions above 100.
# A warning, not an error: it always exits 0.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

# shellcheck disable=SC2016  # the dollars are awk's
find host kernels tests bench \( -name '*.c' -o -name '*.h' -o -name '*.cl' \) -print0 2>/dev/null |
    xargs -0 -r awk '
    function finish(   limit) {
        limit = name ~ /^kernels\// ? 300 : 400
        if (lines > limit) printf "warning: %s has %d lines (%d)\n", name, lines, limit
    }
    FNR == 1 { if (name) finish(); name = FILENAME; start = 0; inside = 0 }
    { lines = FNR }
    # The code is clang-formatted: a definition starts and ends in column 1.
    /^[A-Za-z_]/ && !inside && !/;[ \t]*$/ { start = FNR; title = $0 }
    /\)[ \t]*\{[ \t]*$/ && start && !inside && !/^[ \t]+(if|for|while|switch)/ { inside = 1 }
    /^\}/ {
        if (inside && FNR - start + 1 > 100)
            printf "warning: %s:%d: %d lines in one function: %s\n", FILENAME, start,
                FNR - start + 1, title
        inside = 0; start = 0
    }
    END { if (name) finish() }'

#!/usr/bin/env bash
# check_library_calls.sh [ROOT]: the library never prints, exits or aborts; only host/cli/ may.
# One file switches GSL's error handler, and only its room calls GSL, always inside the fence. One file may name stdout, the one that opens the path "-".
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

word='(^|[^A-Za-z0-9_])'
forbidden="$word(_?exit|_Exit|quick_exit|abort|v?printf|puts|putchar|perror)[[:space:]]*\("
handler="${word}gsl_set_error_handler"
forbidden+="|${word}stderr([^A-Za-z0-9_]|$)"
stdout="${word}stdout([^A-Za-z0-9_]|$)"
# The preprocessor, which takes long for them all, sees files that have one of the names.
names='_?exit|_Exit|quick_exit|abort|v?printf|puts|putchar|perror|stderr|stdout|gsl_set_error_handler'
bad=0
while IFS= read -r file; do
    # -fpreprocessed drops comments and expands nothing; strings go with sed.
    text=$("${CC:-gcc}" -w -fpreprocessed -dD -E -P "$file" | sed -E 's/"([^"\\]|\\.)*"/""/g')
    pattern=$forbidden
    [[ $file == host/files/output_file.c ]] || pattern+="|$stdout"
    [[ $file == host/math/gsl/fence.c ]] || pattern+="|$handler"
    if found=$(grep -E "$pattern" <<<"$text"); then
        echo "$file: printing, exit or abort in the library:" >&2
        sed -E 's/^[[:space:]]*/    /' <<<"$found" >&2
        bad=1
    fi
done < <(find host -name '*.[ch]' -not -path 'host/cli/*' -exec grep -lwE "$names" {} + | sort)
if found=$(grep -rn '#include <gsl/' host --include='*.[ch]' | grep -v '^host/math/'); then
    printf 'GSL outside of host/math:\n%s\n' "$found" >&2
    bad=1
fi
exit $bad

#!/usr/bin/env bash
# check_kernels.sh [ROOT]: compiles every kernel offline with clang, no device needed: each .cl with
# the defaults of its parameters, and again for each line "file.cl -DX=.. -DY=.." of
# kernels/parameter_sets.txt.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}/kernels"

compile=("${CLANG:-clang}" -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -I.
    -Wall -Wextra -Werror -fsyntax-only)
checked=0 bad=0
check() { # FILE [DEFINITION...]
    local file=$1
    shift
    checked=$((checked + 1))
    if ! "${compile[@]}" "$@" "$file" </dev/null; then
        echo "kernels/$file does not compile with: ${*:-its defaults}" >&2
        bad=1
    fi
}
while IFS= read -r file; do
    check "${file#./}"
done < <(find . -name '*.cl' | sort)
if [[ -f parameter_sets.txt ]]; then
    while read -r -a words; do
        [[ ${#words[@]} == 0 || ${words[0]} == \#* ]] || check "${words[@]}"
    done <parameter_sets.txt
fi
echo "kernels: $checked compilations"
exit $bad

#!/usr/bin/env bash
# cli_examples.sh PROGRAM: every --help ends in two examples, and they work, as they stand, in an
# empty folder.
set -euo pipefail
program=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
PATH=$(dirname "$program"):$PATH
cd "$scratch"

# The leak sanitizer may trip over threads of PoCL when a run is short. That is no finding: once more
# without it.
tripped='LeakSanitizer has encountered a fatal error'
bad=0
mapfile -t commands < <(pointspec --help | awk '/^Commands:/ { on = 1; next } !NF { on = 0 } on { print $1 }')
((${#commands[@]} >= 4)) || { echo "only ${#commands[@]} commands in --help" >&2; exit 1; }
for command in '' "${commands[@]}"; do
    # shellcheck disable=SC2086  # the empty command is no word
    mapfile -t ending < <(pointspec $command --help | tail -n 3)
    if [[ ${ending[0]} != Examples: ]]; then
        echo "pointspec $command --help does not end in two examples" >&2
        bad=1
        continue
    fi
    for example in "${ending[@]:1}"; do
        echo "$example"
        for leaks in 1 0; do
            code=0
            ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=$leaks \
                bash -c "set -o pipefail; $example" </dev/null >output 2>messages || code=$?
            grep -q "$tripped" messages || break
        done
        if [[ $code != 0 || -s messages ]]; then
            printf 'exit %s: %s\n%s\n' "$code" "$example" "$(<messages)" >&2
            bad=1
        fi
    done
done
exit $bad

#!/usr/bin/env bash
# cli_completion.sh PROGRAM ROOT: what bash offers behind "pointspec": commands, options of each, and their words, as the
# program's tables have them.
set -euo pipefail
program=$1
bad=0
# shellcheck source=packages/completion/pointspec
. "$2/packages/completion/pointspec"
complete -p pointspec | grep -q _pointspec
offers() { # WORDS... the last of which is begun: what it may become
    COMP_WORDS=("$program" "$@") COMP_CWORD=$#
    _pointspec
    echo "${COMPREPLY[*]}"
}
expect() { # WHAT WORDS...
    local wanted=$1
    shift
    [[ $(offers "$@") == "$wanted" ]] || { echo "cli_completion: $*: \"$(offers "$@")\", not \"$wanted\"" >&2; bad=1; }
}
mapfile -t commands < <("$program" --help | awk '/^Commands:/ { on = 1; next } !NF { on = 0 } on { print $1 }')
expect "${commands[*]}" ''
expect power pow
expect 'shade sample stress' plan s
expect --sampler power --samp
expect --max-degree plan angular --max-d
expect 'fibonacci fibonacci-hemisphere fibonacci-lattice' sample --sampler fib
expect floor power --bins fl
expect relative= power --bins rel
expect double power --precision d
expect '' power --output x
for command in "${commands[@]}"; do
    [[ $command != plan ]] || continue # its options are those of the command behind it
    expect "$("$program" "$command" --help | grep -oE '^  (-[a-z],|   ) --[a-z-]+' | grep -oE -- '--[a-z-]+' | tr '\n' ' ' | sed 's/ $//')" "$command" --
done
exit $bad

# shellcheck shell=bash
# To be sourced by the test of a command: . harness.sh COMMAND PROGRAM. Goes to an empty folder.
set -euo pipefail
# shellcheck source=tests/harness/moments.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/moments.sh"
command=$1
program=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch" "$scratch.cache"' EXIT
cd "$scratch"
unset POINTSPEC_DEVICE
export POINTSPEC_CACHE_DIR=$scratch.cache # neither figures nor results of who runs the tests

checked=0 bad=0
always=() # words of every command line
complain() {
    printf 'cli_%s: %s\n' "$command" "$*" >&2
    bad=1
}
runs() { # EXIT ARGS...: standard output in out, standard error in err
    local expected=$1 code=0
    shift
    checked=$((checked + 1))
    "$program" "$command" "${always[@]}" "$@" </dev/null >out 2>err || code=$?
    # The leak sanitizer's tracer may die of a signal 11 of its own while it stops the threads of PoCL: again without it.
    if [[ $code != "$expected" && $(<err) == *'LeakSanitizer has encountered a fatal error'* ]]; then
        code=0
        ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=0 "$program" "$command" "${always[@]}" "$@" </dev/null >out 2>err || code=$?
    fi
    [[ $code == "$expected" ]] || complain "exit $code, not $expected: $*: $(<err)"
}
says() { # PART: of standard error, which is one line
    [[ $(wc -l <err) == 1 && $(<err) == *"$1"* ]] || complain "not \"$1\": $(<err)"
}
refuses() { # PART ARGS...: one line of standard error with that part, nothing on standard output
    local part=$1
    shift
    runs 2 "$@"
    [[ $(wc -l <err) == 1 && $(<err) == *"$part"* && ! -s out ]] || complain "not \"$part\": $* $(<err)"
}
key() { # NAME: of the header
    sed -n "s/^# $1: //p" out
}
numpy_python() { # the first Python that has NumPy, that of the path or Debian's; nothing where none has it
    local python
    for python in python3 /usr/bin/python3; do
        "$python" -c 'import numpy' 2>/dev/null || continue
        echo "$python"
        break
    done
}
finish() {
    echo "cli_$command: $checked command lines"
    exit $bad
}

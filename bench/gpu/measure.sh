# Sourced: what is measured on a machine that is lent for minutes, one case after another, so that a case that takes
# long costs its own limit and no other's rows. Wants out, a folder, and patience, seconds; sets failed.
# shellcheck shell=bash disable=SC2154,SC2034 # variables of who sources it

# Lines go out one by one, so that what was measured before an end is kept.
measure() { # NAME COMMAND...
    local name=$1 code=0
    timeout "$patience" stdbuf -oL "${@:2}" >>"$out/$name.txt" 2>>"$out/$name.errors.txt" || code=$?
    ((code == 0)) && return
    say "$name ended with $code: ${*:2}: $(tail -n 1 "$out/$name.errors.txt")"
    ((code == 124)) || failed=1
}

# Each case in a process; of the lines before the rows, which are comments and names of columns, those of the first.
measure_cases() { # NAME PROGRAM [CASE...]; without cases those of the program
    local name=$1 program=$2 case list
    shift 2
    (($#)) || { list=$("$program" --cases) && mapfile -t list <<<"$list" && set -- "${list[@]}"; }
    for case in "$@"; do
        measure one-case "$program" "$case"
        if [[ -s $out/$name.txt ]]; then
            awk 'has_names; !/^#/ { has_names = 1 }' "$out/one-case.txt"
        else
            cat "$out/one-case.txt"
        fi >>"$out/$name.txt"
        cat "$out/one-case.errors.txt" >>"$out/$name.errors.txt"
        rm -f "$out"/one-case.*
    done
}

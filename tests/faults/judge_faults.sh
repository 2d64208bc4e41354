#!/usr/bin/env bash
# judge_faults.sh NAME:CLASS:NUMBER[+]...: runs the command line NAME with each of these faults and prints
# one line for each: NAME CLASS VERDICT FUNCTION REMARK. Started by run_faults.sh, which sets FAULTS_PROGRAM and
# FAULTS_SCRATCH and has written, for every command line, cases/NAME/{words,stdin,things,expected/}.
set -euo pipefail
# As long as the name of the folder where run_faults.sh runs the same: the program's texts have its path, and grow with it.
run=$FAULTS_SCRATCH/run.$(printf %07d $$) initial=$FAULTS_SCRATCH/initial
trap 'rm -rf "$run"' EXIT
# shellcheck source=tests/faults/same.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/same.sh"
is_clean=no # the folder of the run is as it was before any

reset() {
    rm -rf "$run"
    mkdir "$run"
    cp -r "$initial" "$run/folder"
    is_clean=yes
}

# Runs the program; sets code, failed, leaks, and said, the lines on standard error. Temporary files have a folder of
# their own: the program takes away what others left behind, and its calls would be counted with that.
run_program() { # CASE FAULT
    local key value words
    mapfile -t words <"$1/words"
    code=0 failed=none leaks=
    rm -rf "$run/report" "$run/tmp"
    mkdir "$run/tmp"
    (cd "$run/folder" &&
        TMPDIR=$run/tmp POINTSPEC_FAULT=$2 POINTSPEC_FAULT_REPORT=$run/report exec timeout 600 env \
            "${words[@]}" <"$(<"$1/stdin")" >"$run/stdout" 2>"$run/stderr") || code=$?
    mapfile -t said <"$run/stderr"
    [[ -f $run/report ]] || return 0
    while read -r key value; do
        case $key in
        failed) failed=$value ;;
        leak) leaks+=" $value" ;;
        unknown) leaks+=" (freed but never taken: $value)" ;;
        esac
    done <"$run/report"
}

# An output is what it was or complete. Sets remark to what is not.
check_outputs() { # CASE
    local file name
    remark=
    diff -rq "$run/folder" "$initial" >/dev/null && return
    is_clean=no
    while read -r -d '' file; do # whole files in a folder of results are fine
        name=${file#"$run/folder/"}
        cmp -s "$file" "$initial/$name" ||
            diff -q "${same[@]}" "$file" "$1/expected/folder/$name" >/dev/null 2>&1 ||
            remark="left behind or spoilt: $name"
    done < <(find "$run/folder" -type f -print0)
    for file in "$initial"/*; do
        [[ -e $run/folder/${file##*/} ]] || remark="lost: ${file##*/}"
    done
}

# What the one sentence must say. Sets remark to what is wrong with it.
check_sentence() { # CASE CLASS NUMBER[+]
    local -i sentences=0
    local last things
    things=$(<"$1/things")
    remark=
    local -a said=("${said[@]}")
    case ${said[0]-} in # a warning before the work
    pointspec*' will not be drawn: '* | pointspec:*' kept sets of '* | pointspec:*' the checkpoint '* | pointspec:*'; pictures are left out '*) said=("${said[@]:1}") ;;
    esac
    for line in "${said[@]}"; do [[ $line != pointspec* ]] || sentences+=1; done
    last=${said[-1]-}
    if ((sentences != 1)) || [[ $last != pointspec*:* ]]; then
        remark="not one sentence"
    elif ((${#said[@]} > 1)) && [[ ! -s $1/expected.stderr ]]; then
        remark="more than the sentence"
    fi
    case $2 in
    memory) [[ ${last,,} == *memory* ]] || remark="does not speak of memory" ;;
    file) [[ $last =~ (cannot (read|write|create|run|make|find|open|look at|look into)|could not draw).*($things) || $last == *'PoCL cannot keep kernels in '* ||
        $last == *'plots need the program gnuplot'* ]] ||
        remark="does not name the file" ;;
    opencl)
        # Where everything fails from there on, the sentence may tell of a later call.
        [[ $last == *"$failed failed: CL_"* || ($3 == *+ && $last == *" cl"*" failed: CL_"*) ]] ||
            remark="does not name the call and the error"
        ;;
    esac
}

# A picture that fails costs a warning: everything else is as without the fault. A page says which picture is missing.
lacks_only_pictures() { # CASE
    local file
    ((${#said[@]} > 0)) && [[ ${said[-1]} == pointspec*' not drawn: '* ]] || return 1
    rm -rf "$run/expected"
    cp -r "$1/expected/folder" "$run/expected"
    for file in old.png new.html new.folder/index.html; do
        [[ ! -e $initial/$file ]] || cp "$initial/$file" "$run/expected/$file"
        [[ ! -e $run/folder/$file ]] || cp "$run/folder/$file" "$run/expected/$file"
    done
    for file in "$run"/expected/new.folder/*.svg; do
        [[ -e $run/folder/new.folder/${file##*/} ]] || rm -f "$file"
    done
    diff -rq "${same[@]}" "$run/folder" "$run/expected" >/dev/null &&
        diff -q "${same[@]}" "$run/stdout" "$1/expected/stdout" >/dev/null
}

# A set that cannot be kept costs a warning: everything else is as without the fault.
lacks_only_sets() { # CASE
    [[ ${#said[@]} == 1 && ${said[0]} == pointspec*': kept sets of '* ]] &&
        diff -rq -x kept.d "${same[@]}" "$run/folder" "$1/expected/folder" >/dev/null &&
        diff -q "${same[@]}" "$run/stdout" "$1/expected/stdout" >/dev/null
}

# A checkpoint that cannot be written costs a warning: everything else is as without the fault.
lacks_only_checkpoint() { # CASE
    [[ ${#said[@]} == 1 && ${said[0]} == pointspec*': the checkpoint "'*'" stays as it was: '* ]] &&
        diff -rq "${same[@]}" "$run/folder" "$1/expected/folder" >/dev/null &&
        diff -q "${same[@]}" "$run/stdout" "$1/expected/stdout" >/dev/null
}

# A checkpoint that is there after a failure is one that the same command goes on from to the end. It is no output, and goes.
# Sets stuck where that is not so.
check_checkpoint() { # CASE
    local words
    stuck=
    rm -f "$run/folder/job.npz.lock"
    [[ -e $run/folder/job.npz ]] || return 0
    mapfile -t words <"$1/words"
    rm -rf "$run/again"
    cp -r "$run/folder" "$run/again"
    (cd "$run/again" && TMPDIR=$run/tmp exec timeout 600 env "${words[@]}" <"$(<"$1/stdin")" >/dev/null 2>"$run/again.stderr") ||
        stuck="does not go on: $(<"$run/again.stderr")"
    rm -f "$run/folder/job.npz"
    diff -rq "${same[@]}" -x '.pointspec-*' "$run/again" "$1/expected/folder" >/dev/null || stuck+=" other results from its checkpoint"
}

# What a diagnosis says of a failure is its answer: whole lines, a code that goes with them, and one sentence at most.
is_diagnosis() { # NAME
    [[ $1 == doctor && ${#said[@]} -le 1 ]] || return 1
    ! grep -qvE '^(ok|note|WRONG) +[a-z]+ ' "$run/stdout" || return 1
    case $code in
    0) [[ -s $run/stdout ]] && ! grep -q '^WRONG' "$run/stdout" ;;
    3) grep -q '^WRONG' "$run/stdout" ;;
    *) [[ $code == 1 && ${#said[@]} == 1 ]] ;;
    esac
}

judge() { # NAME CLASS NUMBER[+]
    local case=$FAULTS_SCRATCH/cases/$1
    [[ $is_clean == yes ]] || reset
    run_program "$case" "$2:$3"
    verdict=refused
    check_checkpoint "$case"
    if [[ -n $stuck ]]; then
        remark=$stuck
    elif [[ ! -f $run/report ]]; then
        remark="crash or time-out"
    elif [[ $failed == none ]]; then
        remark="the call did not come"
    elif [[ -n $leaks ]]; then
        remark="leaks:$leaks"
    elif is_diagnosis "$1"; then
        remark=
    elif [[ $code == 0 ]] && lacks_only_pictures "$case"; then
        is_clean=no remark= # refused: the picture alone
    elif [[ $code == 0 ]] && { lacks_only_sets "$case" || lacks_only_checkpoint "$case"; }; then
        is_clean=no remark=
    elif [[ $code == $(<"$case/expected.code") ]]; then
        verdict=tolerated is_clean=no remark=
        # A temporary file that cannot be removed stays; the sentence of a failure would have said so.
        [[ $failed != unlink ]] || rm -f "$run"/folder/.pointspec-*
        diff -rq "${same[@]}" "$run/folder" "$case/expected/folder" >/dev/null &&
            diff -q "${same[@]}" "$run/stdout" "$case/expected/stdout" >/dev/null || remark="exit $code with another output"
    elif [[ $code != 1 ]]; then
        remark="exit $code"
    else
        check_outputs "$case"
        [[ -n $remark ]] || check_sentence "$case" "$2" "$3"
    fi
    [[ -z $remark ]] || is_clean=no verdict=FAILED remark+="; exit $code: ${said[*]-}"
    printf '%s %s %s %s %s: %s\n' "$1" "$2" "$verdict" "$failed" "$3" "$remark"
}

for fault in "$@"; do
    IFS=: read -r name class number <<<"$fault"
    judge "$name" "$class" "$number"
done

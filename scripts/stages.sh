#!/usr/bin/env bash
# stages.sh AT_ONCE SECONDS FOLDER <LIST: runs the stages of LIST, lines "NAME COMMAND...", AT_ONCE of them at a time, in
# the order of the list; also after one has failed. What a stage says goes to FOLDER/NAME.log, which is printed whole when
# it ends; what takes more than SECONDS is ended, and has failed. A table of times ends it all: of the clock, and of the
# processors, which is what a stage costs whatever runs beside it. The exit code is 1 when a stage failed.
set -euo pipefail
at_once=$1 most_seconds=$2 folder=$3
mapfile -t list < <(grep -v '^\(#\|$\)')
exec </dev/null
mkdir -p "$folder"

declare -A name_of=() begin_of=()
summary=() failed=0 all_cpu=0

# `timeout` is the head of a group of processes, with all that the stage starts, and hands signals on to them.
run_stage() { # NAME COMMAND...
    local log=$folder/$1.log code=0
    shift
    timeout -k 30 "$most_seconds" "$@" >"$log" 2>&1 &
    # shellcheck disable=SC2064 # this process
    trap "kill $!" TERM
    wait $! || code=$?
    times >"${log%.log}.time" # of this process, then of its children
    exit $code
}

end_stage() { # PROCESS CODE
    local name=${name_of[$1]} seconds=$((SECONDS - begin_of[$1])) verdict=ok cpu
    unset "name_of[$1]"
    case $2 in
    0) ;;
    124 | 137) verdict="FAILED, took more than $most_seconds s" ;;
    *) verdict="FAILED, exit code $2" ;;
    esac
    [[ $verdict == ok ]] || failed=1
    cpu=$(tail -n 1 "$folder/$name.time" | tr 'ms' '  ' | awk '{ printf "%.0f", 60 * ($1 + $3) + $2 + $4 }')
    all_cpu=$((all_cpu + cpu))
    printf '\n==== %s\n' "$name"
    cat "$folder/$name.log"
    printf '==== %s: %s after %s s, %s s of processors\n\n' "$name" "$verdict" "$seconds" "$cpu"
    summary+=("$(printf '%-10s %8s %10s  %s' "$name" "$seconds" "$cpu" "$verdict")")
}

wait_for_one() {
    local pid code=0
    wait -n -p pid "${!name_of[@]}" || code=$?
    end_stage "$pid" "$code"
}

trap '((${#name_of[@]} == 0)) || kill "${!name_of[@]}"' EXIT
trap 'exit 130' INT TERM HUP
for line in "${list[@]}"; do
    ((${#name_of[@]} < at_once)) || wait_for_one
    read -r -a words <<<"$line"
    printf -- '---- %s begins: %s\n' "${words[0]}" "${words[*]:1}"
    run_stage "${words[@]}" &
    name_of[$!]=${words[0]} begin_of[$!]=$SECONDS
done
while ((${#name_of[@]})); do wait_for_one; done

printf '%-10s %8s %10s\n' stage seconds processors
printf '%s\n' "${summary[@]}"
printf '%-10s %8s %10s\n' all "$SECONDS" "$all_cpu"
exit $failed

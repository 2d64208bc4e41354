# shellcheck shell=bash
# shellcheck disable=SC2154 # program and command are of harness.sh
# To be sourced behind harness.sh by tests that run the program under mpirun; ends them (77) where that cannot be.

module=$(dirname "$program")/libpointspec_mpi.so
if ! command -v mpirun >/dev/null || [[ ! -f $module ]]; then
    echo "cli_$command: skipped: no mpirun, or no $module" >&2
    exit 77
fi
# Open MPI ends with much of what it has taken.
export ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=0
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_orte_execute_quiet=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe

ranks() { # EXIT N ARGS...: standard output in out, standard error in err
    local expected=$1 num=$2 code=0
    shift 2
    checked=$((checked + 1))
    timeout 120 mpirun -n "$num" "$program" "$@" </dev/null >out 2>err || code=$?
    # What mpirun itself says of an exit status is no sentence of ours; gnuplot is not everywhere.
    grep '^pointspec' err | grep -v gnuplot >sentences || true
    [[ $code == "$expected" ]] || complain "exit $code, not $expected, of $num ranks: $*: $(<err)"
}
sentence() { # PART: of the only one; "": there is none
    if [[ -z $1 ]]; then
        [[ ! -s sentences ]] || complain "$(<sentences)"
    else
        [[ $(wc -l <sentences) == 1 && $(<sentences) == *"$1"* ]] || complain "not \"$1\": $(<err)"
    fi
}
kill_ranks() { # PATTERN N ARGS...: soon after a checkpoint of that pattern is there
    local pattern=$1 num=$2 pid kids
    shift 2
    mpirun -n "$num" "$program" "$@" </dev/null >/dev/null 2>&1 &
    pid=$!
    wait_until "$pid" compgen -G "$pattern"
    sleep "0.$((RANDOM % 1000))"
    kids=$(pgrep -P "$pid" || true)
    # shellcheck disable=SC2086 # several
    kill -9 "$pid" $kids 2>/dev/null || true
    wait "$pid" 2>/dev/null || true
    for pid in $kids; do
        while [[ -e /proc/$pid ]]; do sleep 0.02; done
    done
}
is_ended() { # PATTERN ARGS...: killed twice at any moment, and ended by others; one.csv is that of one process
    local last kept pattern=$1
    shift
    kept=("$@" --checkpoint kept.npz --checkpoint-interval 0)
    "$program" "$@" >one.csv
    for last in 3 1; do
        kill_ranks "$pattern" 4 "${kept[@]}"
        kill_ranks "$pattern" 2 "${kept[@]}"
        if ((last > 1)); then
            ranks 0 "$last" "${kept[@]}"
            sentence ''
        else
            "$program" "${kept[@]}" >out
        fi
        [[ $(answer out) == "$(answer one.csv)" ]] || complain "killed twice, and ended by $last: $*: $(<out)"
        [[ -z $(ls kept* 2>/dev/null) ]] || complain "checkpoints are left: $(ls kept*)"
    done
}
answer() { sed 's/^# command: .*//' "$1"; } # but for the command
is_as_one() { # N ARGS...: table, NPZ and arrays of one process and of N ranks
    local num=$1 file
    shift
    rm -rf one several
    mkdir one several
    (cd one && "$program" "$@" -o answer.npz) || complain "one process: $*"
    pushd several >/dev/null || exit 1
    ranks 0 "$num" "$@" -o answer.npz
    sentence ''
    popd >/dev/null || exit 1
    rm -f several/{out,err,sentences}
    [[ $(ls one) == "$(ls several)" ]] || complain "files of $num ranks: $(ls several)"
    for file in one/*; do
        cmp "$file" "several/${file#one/}" || complain "$file of $num ranks is another: $*"
    done
}

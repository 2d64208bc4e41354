#!/usr/bin/env bash
# run_limits.sh PROGRAM [the options of run_faults.sh]: starts every command line of commands.txt under limits of
# address space, open files, sizes of files and processor time, and of a memory cgroup where one can be made. Each must
# end, with a known exit code, one sentence where it is not 0, and nothing left behind (see docs/developer/reliability.md).
# --sample takes about N/12 of them, evenly, for a start takes as long as a dozen faults; --fault takes none.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
program=$(realpath "$1")
shift
sample=0 seed=0 only='' faults_per_start=12
while (($#)); do
    case $1 in
    --sample) sample=$(($2 / faults_per_start + 1)) && shift ;;
    --table) ;;
    --fault) exit 0 ;;
    --seed) seed=$2 && shift ;;
    --only) only=$2 && shift ;;
    *) sed -n '2,5s/^# //p' "$0" >&2 && exit 2 ;;
    esac
    shift
done
# Seconds after which something hangs, also a cold build on a machine with much to do; then SIGTERM, which must work.
patience=600 deaf=60
limits=("-v 40000" "-v 100000" "-v 200000" "-v 400000" "-v 800000" "-v 1500000" "-v 4000000"
    "-d 50000" "-d 100000" "-d 180000" "-s 64" "-s 256"
    "-n 4" "-n 5" "-n 7" "-n 10" "-n 20" "-f 0" "-f 1" "-f 8" "-t 1"
    "cgroup 24" "cgroup 80" "cgroup 400")
scratch=$(mktemp -d)
export POINTSPEC_CACHE_DIR=$scratch/no-cache ASAN_OPTIONS=${ASAN_OPTIONS-}:allocator_may_return_null=1
unset POINTSPEC_DEVICE POINTSPEC_KERNEL_DIR POINTSPEC_MEMORY
groups=()
tidy() {
    for group in "${groups[@]}"; do rmdir "$group" 2>/dev/null || true; done
    rm -rf "$scratch"
}
trap tidy EXIT

# shellcheck source=tests/faults/inputs.sh
. "$here/inputs.sh"

# A group of so many MiB; sets group. Version 2, or the controller of version 1.
make_group() { # MIB
    local root=/sys/fs/cgroup name=pointspec-limits-$$-$1
    group=''
    if [[ -w $root/cgroup.procs && -f $root/cgroup.controllers ]]; then
        mkdir "$root/$name" 2>/dev/null || return 1
        groups+=("$root/$name")
        { echo $(($1 << 20)) >"$root/$name/memory.max"; } 2>/dev/null || return 1
        { echo 0 >"$root/$name/memory.swap.max"; } 2>/dev/null || true
        group=$root/$name
    elif [[ -w $root/memory/cgroup.procs ]]; then
        mkdir "$root/memory/$name" 2>/dev/null || return 1
        groups+=("$root/memory/$name")
        { echo $(($1 << 20)) >"$root/memory/$name/memory.limit_in_bytes"; } 2>/dev/null || return 1
        group=$root/memory/$name
    else
        return 1
    fi
}

# The program alone is limited, and has no more files open than the standard three.
# shellcheck disable=SC2016 # another shell's
limit_itself='for fd in /proc/self/fd/*; do fd=${fd##*/}; ((fd < 3)) || eval "exec $fd>&-"; done
    [[ $1 != -* ]] || ulimit "$1" "$2"
    shift 2
    exec "$@"'

# Runs words under a limit in a new copy of the folder; sets code, said and seconds.
run_limited() { # KIND NUMBER
    local begin=$SECONDS
    rm -rf "$scratch/folder"
    cp -r "$scratch/initial" "$scratch/folder"
    code=0
    # Standard error through a pipe: what the harness keeps is under no limit.
    said=$( (cd "$scratch/folder"
        exec <"$stdin" 2>&1 >/dev/null
        [[ $1 != cgroup ]] || echo $BASHPID >"$group/cgroup.procs"
        exec timeout -k $deaf $patience bash -c "$limit_itself" limited "$1" "$2" env "${words[@]}") 2>&1) || code=$?
    seconds=$((SECONDS - begin))
}

# A driver that is refused memory ends the process itself: LLVM exits or aborts, the kernel kills. A
# limit of processor time kills as well. Both only where that is so. Sets remark to what is wrong.
judge() { # KIND NUMBER LOADS_DRIVER
    local -i sentences
    remark=
    # a checkpoint that cannot be written is told, and no error of the job
    sentences=$(grep '^pointspec' <<<"$said" | grep -vc 'the checkpoint .* stays as it was' || true)
    case $code in
    0) ;;
    1 | 2 | 3) ((sentences == 1)) || [[ $3 == yes && $1 != -f && $said == *"LLVM ERROR"* ]] || remark="$sentences sentences" ;;
    124) remark="did not end" ;;
    134 | 135 | 139) [[ $3 == yes && $1 =~ ^(-v|cgroup)$ ]] || remark="died of signal $((code - 128))" ;;
    137) [[ $1 == -t || ($1 == cgroup && $3 == yes) ]] || remark="killed, or deaf to SIGTERM" ;;
    152) [[ $1 == -t ]] || remark="died of SIGXCPU" ;;
    *) remark="unknown exit code" ;;
    esac
    [[ -n $remark ]] || ((seconds <= patience)) || remark="took $seconds s"
    if [[ -z $remark ]] && ((code < 128)); then
        remark=$(find "$scratch/folder" -name '.pointspec-*' -printf 'left behind: %f ')
    fi
}

# Does it load a driver when nothing is refused? The loader says so.
loads_driver() {
    (cd "$scratch/initial" && LD_DEBUG=files LD_DEBUG_OUTPUT=$scratch/loaded env "${words[@]}" <"$stdin" >/dev/null 2>&1) || true
    local answer=no
    ! cat "$scratch"/loaded.* 2>/dev/null | grep -qiE 'pocl|llvm|nvidia|rusticl|intelocl' || answer=yes
    rm -f "$scratch"/loaded.*
    rm -rf "$scratch/initial"
    cp -r "$scratch/kept" "$scratch/initial"
    echo $answer
}

make_inputs
cp -r "$scratch/initial" "$scratch/kept"
has_groups=yes
if ! { make_group 24 && make_group 80 && make_group 400; }; then
    has_groups=no
    echo "run_limits: no memory cgroup can be made here: left out" >&2
fi
lines=()
while read -r line; do
    name=${line%% *}
    [[ -z $name || $name == \#* || (-n $only && ,$only, != *,$name,*) ]] || lines+=("$line")
done <"$here/commands.txt"
total=$((${#lines[@]} * ${#limits[@]}))
step=$((sample > 0 && total > sample ? total / sample : 1))
num=0 runs=0 failures=0
for line in "${lines[@]}"; do
    read -r -a fields <<<"$line"
    read_line "${fields[@]}"
    driver=''
    for limit in "${limits[@]}"; do
        num=$((num + 1))
        ((num % step == seed % step)) || continue
        read -r kind number <<<"$limit"
        [[ $kind != cgroup || $has_groups == yes ]] || continue
        group=${groups[0]-}
        [[ $kind != cgroup ]] || group=${group%-*}-$number
        [[ -n $driver ]] || driver=$(loads_driver)
        run_limited "$kind" "$number"
        judge "$kind" "$number" "$driver"
        runs=$((runs + 1))
        [[ -z $remark ]] || {
            failures=$((failures + 1))
            echo "${fields[0]} FAILED under $limit: $remark; exit $code: ${said//$'\n'/ | }" | head -c 600 >&2
            echo >&2
        }
    done
done
echo "run_limits: $runs of $total starts, $failures failures, $SECONDS s" >&2
[[ $failures == 0 && $runs -gt 0 ]]

#!/usr/bin/env bash
# cli_machines.sh PROGRAM: two ranks that have nothing but a network between them, as on two machines: network namespaces with
# names of their own, joined by a pair of virtual cards, over which MPI speaks TCP. They write what one process writes, to the
# bit, and one that is killed ends both. Skipped (77) where there is no mpirun or no module, or namespaces are not allowed.
skip() { # WHY
    echo "cli_machines: skipped: $1" >&2
    exit 77
}

if [[ $1 != --inside ]]; then
    if ! command -v mpirun ip unshare >/dev/null || [[ ! -f $(dirname "$1")/libpointspec_mpi.so ]]; then
        skip 'no mpirun, ip or unshare, or no libpointspec_mpi.so'
    fi
    # All that is made there goes with its last process.
    unshare --user --map-root-user --net --mount --uts true 2>/dev/null || skip 'no namespaces'
    exec unshare --user --map-root-user --net --mount --uts bash "$0" --inside "$1"
fi

{
    mount -t tmpfs tmpfs /run && ip netns add far && ip link set lo up &&
        ip link add near0 type veth peer name far0 netns far &&
        ip addr add 10.77.0.1/24 dev near0 && ip link set near0 up &&
        ip -n far addr add 10.77.0.2/24 dev far0 && ip -n far link set far0 up && ip -n far link set lo up && hostname near
} 2>/dev/null || skip 'no virtual network cards'

# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" machines "$2"
export ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=0 # Open MPI ends with much of what it has taken
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_orte_execute_quiet=1
export OMPI_MCA_btl=tcp,self OMPI_MCA_btl_tcp_if_include=10.77.0.0/24 OMPI_MCA_oob_tcp_if_include=10.77.0.0/24

# What mpirun takes for ssh: HOST COMMAND...
cat >agent <<'END'
#!/bin/sh
shift
exec ip netns exec far unshare --uts sh -c "hostname far; cd '$PWD'; $*"
END
chmod +x agent
export OMPI_MCA_plm_rsh_agent=$PWD/agent
bytes() { ip netns exec far cat /sys/class/net/far0/statistics/tx_bytes; }
machines() { # EXIT ARGS...: one rank on each
    local expected=$1 code=0
    shift
    checked=$((checked + 1))
    timeout 120 mpirun --host 10.77.0.1:1,10.77.0.2:1 -n 2 "$program" "$@" </dev/null >out 2>err || code=$?
    [[ $code == "$expected" ]] || complain "exit $code, not $expected: $*: $(<err)"
}

job=(power --engine host_direct --sampler jittered -m 300 -n 16 -k 20 --full full.npy)
"$program" "${job[@]}" >one.csv
mv full.npy one.npy
before=$(bytes)
machines 0 "${job[@]}"
cmp out one.csv || complain 'the table of two machines'
cmp full.npy one.npy || complain 'the array of two machines'
after=$(bytes)
((after - before > 20000)) || complain "only $((after - before)) bytes went over the network"

# The far rank is killed in the middle, unless it is done: both end, and go on together from their checkpoints.
job=("${job[@]}" -m 520 -k 8 --checkpoint job.npz)
"$program" "${job[@]}" >one.csv
mv full.npy one.npy
mpirun --host 10.77.0.1:1,10.77.0.2:1 -n 2 "$program" "${job[@]}" --checkpoint-interval 0 </dev/null >out 2>err &
pid=$!
wait_until "$pid" test -e job-part-2-of-2.npz
for process in $(ip netns pids far); do
    if [[ $(readlink "/proc/$process/exe") == "$program" ]]; then kill -9 "$process"; fi
done
wait "$pid" || true
machines 0 "${job[@]}"
[[ $(grep -v '^# command' out) == "$(grep -v '^# command' one.csv)" ]] || complain 'a killed rank on another machine'
cmp full.npy one.npy || complain 'the array after a killed rank'
finish

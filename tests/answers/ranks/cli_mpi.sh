#!/usr/bin/env bash
# cli_mpi.sh PROGRAM: several ranks under mpirun write what one process writes, to the bit; what has no ranges is done by
# rank 0; an error of one rank is one sentence, and the end of all. Skipped (77) where there is no mpirun or no module.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" mpi "$1"

# shellcheck source=tests/answers/ranks/ranks.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/ranks.sh"

awk 'BEGIN { srand(5); for (s = 0; s < 300; s++) { if (s) print "#"
    for (i = 0; i < 5 + s % 3; i++) printf "%.9f %.9f %.9f\n", rand(), rand(), 0.5 + rand() } }' >sets.txt
sets=$PWD/sets.txt
is_as_one 2 power --engine host_direct -m 300 --sampler jittered --sampler white -n 9,16 -k 3
is_as_one 3 power --engine host_direct --columns xyw -k 2 --normalize integral --full full.npy "$sets"
is_as_one 2 angular --engine host_direct -m 300 --sampler white-sphere -n 4 -l 3
is_as_one 3 pairs --engine host_direct --columns xyw --lift sphere -l 3 "$sets"
if "$program" devices >out 2>err && grep -q '^[0-9]' out; then
    is_as_one 3 power -m 600 --sampler white -n 64 -k 8 --precision single
fi

# Powers of all parts decide together on another plan, each question for itself.
awk 'BEGIN { for (r = 0; r < 300; r++) { if (r) print "#"
    for (j = 0; j < 300; j++) print 0.5 + 1e-4 * (j % 17) + 1e-6 * r, 0.5 + 1e-4 * (j % 19) } }' >clusters.txt
clusters=$PWD/clusters.txt
is_planned_twice() { # N ARGS...
    is_as_one "$@"
    "$program" "${@:2}" >out
    [[ $(<out) == *planned_twice* ]] || complain "planned once: $*"
}
if "$program" devices >out 2>err && grep -q '^[0-9]' out; then
    is_planned_twice 2 power -k 8 --full full.npy "$clusters"
    is_planned_twice 3 angular --lift sphere -l 8 "$clusters"
    is_planned_twice 3 pairs --lift sphere -l 8 "$clusters"
    is_planned_twice 2 power --sampler white --sampler regular -n 64,256 --no-skip --no-self-check -m 300 -k 20
    ranks 3 2 power --precision single -k 8 "$clusters"
    sentence 'tolerance 1e-06 cannot be reached: the smallest error is'
fi
# Ranks of a machine share its devices.
if "$program" power --engine torus_direct --sampler white -n 4 -k 1 --device cpu:split=2/1 >out 2>err; then
    "$program" power -m 600 --sampler white -n 64 -k 8 --full one.npy >one.csv
    for num in 2 3; do
        ranks 0 $num power -m 600 --sampler white -n 64 -k 8 --device cpu:split=2 --full several.npy
        sentence ''
        cmp one.npy several.npy || complain "$num ranks with two devices"
        cmp <(grep -v '^# command' one.csv) <(grep -v '^# command' out) || complain "$num ranks with two devices"
    done
fi
job=(power --engine host_direct -m 300 --sampler jittered -n 9 -k 3)
"$program" "${job[@]}" >one.csv
ranks 0 4 "${job[@]}"
cmp out one.csv || complain 'more ranks than blocks'
sentence '1 of 4 ranks have nothing to do'
ranks 0 2 "${job[@]}" --checkpoint kept --checkpoint-interval 1
[[ $(answer out) == "$(answer one.csv)" ]] || complain "with a checkpoint: $(<out)"
[[ -z $(ls kept* 2>/dev/null) ]] || complain 'a checkpoint is left'

# The parts are those of the first start, which may be done before it is killed.
job=("${job[@]}" -m 520)
is_ended 'kept-part-*-of-4.npz' "${job[@]}"
kept=("${job[@]}" --checkpoint kept.npz --checkpoint-interval 0)
("$program" "${kept[@]}" >/dev/null 2>&1 & wait_until $! test -e kept.npz; kill -9 $! 2>/dev/null; wait $!) 2>/dev/null || true
ranks 0 2 "${kept[@]}"
sentence 'the others of 2 ranks wait: "kept.npz" is the checkpoint of one process'
[[ $(answer out) == "$(answer one.csv)" ]] || complain "of a process that was killed: $(<out)"
: >kept-part-2-of-4.npz.lock
ranks 0 5 "${kept[@]}"
sentence '1 of 5 ranks have nothing to do: by its checkpoints the job was begun in 4 parts'
rm -f kept*
: >kept-part-2-of-4.npz
: >kept-part-1-of-3.npz.lock
ranks 2 2 "${kept[@]}"
sentence 'there are checkpoints "kept.npz" of a job of'
rm -f kept*
: >kept-part-6-of-6.npz
ranks 2 2 "${kept[@]}"
sentence 'checkpoints of another job: it has 6 parts, and this one 5 blocks'
rm -f kept*

# What one rank does alone.
alone() { # WHY ARGS...
    local why=$1
    shift
    "$program" "$@" >one.csv
    ranks 0 2 "$@"
    sentence "rank 0 works alone, and the others of 2 ranks wait: $why"
    cmp out one.csv || complain "of one rank of two: $*"
}
alone 'all realizations of a sampler have the same powers' power --engine host_direct -m 300 --sampler sobol -n 4 -k 1
alone '--range does not go with --standard-error' "${job[@]}" --standard-error 0.1
alone 'realizations are shared in blocks of 128, and there are 100' "${job[@]}" -m 100
alone 'sample has no realizations' sample --sampler white -n 4

# Errors: one sentence, and the exit status of one process.
ranks 2 2 power --nonsense
sentence 'pointspec power: unknown option --nonsense'
ranks 1 2 "${job[@]}" -o nowhere/answer.csv
sentence 'pointspec power: cannot write nowhere/answer.csv'
awk '/^#/ { s++ } s == 200 && !/^#/ { $3 = 0 } { print }' sets.txt >zero.txt
ranks 2 3 power --engine host_direct --columns xyw -k 1 zero.txt
sentence 'set 201: all weights are 0'
[[ ! -s out ]] || complain "after an error: $(<out)"
command=mpi
checked=$((checked + 1))
mpirun -n 1 "$program" "${job[@]}" : -n 1 "$program" "${job[@]}" --seed 2 </dev/null >out 2>err && complain 'ranks of two jobs'
grep '^pointspec' err >sentences
sentence 'ranks of one job have the same command line: that of rank 1 is'

# What needs no command is said once.
for word in --version --help; do
    checked=$((checked + 1))
    mpirun -n 3 "$program" "$word" </dev/null >out 2>err || complain "$word of 3 ranks: $(<err)"
    "$program" "$word" | cmp - out || complain "$word is not said once: $(<out)"
done

# An interrupt of one rank is the word that one process has for it.
checked=$((checked + 1))
mpirun -n 2 "$program" "${job[@]}" -m 1e9 </dev/null >out 2>err &
pid=$!
wait_until "$pid" pgrep -P "$pid"
for rank in $(pgrep -P "$pid"); do
    wait_until_it_catches "$rank"
    last=$rank
done
kill -TERM "$last"
wait "$pid" && complain 'interrupted, and done'
[[ $(grep -c '^pointspec power: .*interrupted' err) == 1 ]] || complain "interrupted: $(<err)"

# Without the module each rank would do the whole job.
mkdir bare
cp "$program" bare/pointspec
checked=$((checked + 1))
mpirun -n 2 bare/pointspec "${job[@]}" </dev/null >out 2>err && complain 'ranks without a module'
grep '^pointspec' err >sentences
sentence 'the module libpointspec_mpi.so is not beside the program'
finish

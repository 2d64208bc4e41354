#!/usr/bin/env bash
# cli_mpi_run.sh PROGRAM: several ranks under mpirun share the questions of a scene by its cache, and the sets of sample
# --prefetch: what comes of it is what one process makes. Skipped (77) where there is no mpirun or no module.
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
# shellcheck source=tests/harness/harness.sh
. "$here/../../harness/harness.sh" mpi_run "$1"
# shellcheck source=tests/answers/ranks/ranks.sh
. "$here/ranks.sh"
# shellcheck source=tests/faults/same.sh
. "$here/../../faults/same.sh"

forget() { rm -rf "$POINTSPEC_CACHE_DIR/results"; }
is_same() { # the folder z of the former command is that of one process, but for times
    diff -r "${same[@]}" one/z z >differences || complain "another folder: $(head -5 differences)"
    rm -rf z
}
cached() { awk -F, '/^[a-z]+-[0-9]+,/ { sum += $4 } END { print sum + 0 }' out; }

cat >scene.yaml <<'END'
scene: 1
results:
  - {result: power, samplers: [white, jittered], points: [9, 16, 25], realizations: 40, max-frequency: 3, engine: host_direct}
  - {result: sample, samplers: jittered, points: [9, 16]}
END
mkdir one
cp scene.yaml one
(cd one && "$program" run scene.yaml -o z >out 2>err) || complain "one process: $(<one/err)"

for num in 2 3; do
    forget
    ranks 0 $num run scene.yaml -o z
    sentence ''
    (($(cached) > 0 && $(cached) < 8)) || complain "all, or nothing, is of other ranks than 0: $(<out)"
    is_same
done
ranks 0 2 run scene.yaml -o z
(($(cached) == 8)) || complain "not all is in the cache: $(<out)"
is_same
forget
ranks 0 9 run scene.yaml -o z
sentence '1 of 9 ranks have nothing to do: there is work for 8'
is_same

# Machines whose caches are their own.
forget
checked=$((checked + 1))
run=("$program" run scene.yaml -o z)
mpirun -n 1 "${run[@]}" : -n 1 env POINTSPEC_CACHE_DIR="$scratch/other" "${run[@]}" </dev/null >out 2>err || complain "two caches: $(<err)"
(($(cached) == 0)) || complain "from the cache of another machine: $(<out)"
[[ -n $(ls other/results) ]] || complain 'rank 1 had no cache'
is_same

# Where nothing is kept.
alone() { # WHY ARGS...
    ranks 0 2 run scene.yaml -o z "${@:2}"
    sentence "rank 0 works alone, and the others of 2 ranks wait: $1"
    (($(cached) == 0)) || complain "from a cache: $(<out)"
}
alone '--cache 0 keeps no answers' --cache 0
alone '--no-skip keeps no answers' --no-skip
mv z record
mv scene.yaml scene
cp record/record.json scene.yaml
alone 'answers that repeat a record are not kept'
rm -rf z record
sed '/result: sample/d; s/\[9, 16, 25\]/9/; s/\[white, jittered\]/white/' scene >scene.yaml
forget
alone 'the scene has one question'
rm -rf z
mv scene scene.yaml
ln -s /dev/stdin stream.yaml
ranks 2 2 run stream.yaml -o z
[[ $(<sentences) == *'the scene "stream.yaml" comes once'* ]] || complain "of a stream: $(<err)"
rm -rf z

# Killed at any moment, and again: every question goes on from its checkpoint.
forget
sed 's/realizations: 40/realizations: 200/' scene.yaml >one/scene.yaml
(cd one && "$program" run scene.yaml -o z >out 2>err) || complain "one process: $(<one/err)"
cp scene.yaml short.yaml
cp one/scene.yaml .
forget
kept=(run scene.yaml -o z --checkpoint kept.npz --checkpoint-interval 0)
for _ in 1 2; do
    kill_ranks 'kept*' 2 "${kept[@]}"
done
ranks 0 3 "${kept[@]}"
(cd one && rm -rf z && "$program" "${kept[@]}" >out 2>err) || complain "one process: $(<one/err)"
is_same
[[ -z $(ls kept* 2>/dev/null) ]] || complain "checkpoints are left: $(ls kept*)"

# Errors: one sentence, and the exit status of one process.
ranks 1 2 run scene.yaml -o nowhere/z
sentence 'pointspec run: cannot write the results "nowhere/z"'
ranks 2 2 run scene.yaml scene.yaml -o z
sentence 'pointspec run: one scene is run at a time, but 2 files were named'
printf '0.5 0.5 1\n#\n0.5 0.5 0\n' >zero.txt
for at in 2 3; do # a question of rank 1, and one of rank 0
    sed "${at}s/\$/\n  - {result: power, files: zero.txt, columns: xyw, max-frequency: 3, engine: host_direct}/" short.yaml >bad.yaml
    forget
    ranks 2 2 run bad.yaml -o z
    sentence 'set 2: all weights are 0'
    [[ ! -s out && ! -e z ]] || complain "after an error: $(<out)"
done

# An interrupt of one rank is the word that one process has for it.
sed 's/realizations: 40/realizations: 1e9/' short.yaml >long.yaml
checked=$((checked + 1))
mpirun -n 2 "$program" run long.yaml -o z </dev/null >out 2>err &
pid=$!
wait_until "$pid" pgrep -P "$pid"
for rank in $(pgrep -P "$pid"); do
    wait_until_it_catches "$rank"
    last=$rank
done
kill -TERM "$last"
wait "$pid" && complain 'interrupted, and done'
[[ $(grep -c '^pointspec run: .*interrupted' err) == 1 ]] || complain "interrupted: $(<err)"

# Sets that are kept: ranges of realizations.
prefetch=(sample --prefetch --sampler bnot -n "256,300" -m 5)
"$program" "${prefetch[@]}" 2>err || complain "$(<err)"
mv "$POINTSPEC_CACHE_DIR/sets" sets
for num in 2 3; do
    ranks 0 $num "${prefetch[@]}"
    [[ $(grep -c '^pointspec sample: bnot, [0-9]* points: all 5 sets are kept in ' sentences) == 2 ]] || complain "$(<err)"
    diff -r sets "$POINTSPEC_CACHE_DIR/sets" || complain "other sets of $num ranks"
    rm -r "$POINTSPEC_CACHE_DIR/sets"
done
ranks 2 2 "${prefetch[@]}" --sampler white
sentence '--prefetch: white makes 256 points about as fast as they are read'
ranks 0 2 "${prefetch[@]}" -m 1
[[ $(<sentences) == *'rank 0 works alone, and the others of 2 ranks wait: one set is not shared'* ]] || complain "$(<err)"
finish

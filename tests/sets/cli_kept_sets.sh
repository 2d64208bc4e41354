#!/usr/bin/env bash
# cli_kept_sets.sh PROGRAM: sets that take long to make are kept on the disk and come back with the same bits; --prefetch
# goes on where it was stopped; a store that is damaged, full or no folder is told and harms nothing.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" sample "$1"

store=$POINTSPEC_CACHE_DIR/sets
bnot=(--sampler bnot -n 100)
num_kept() { find "$store" -name '*.result' 2>/dev/null | wc -l; }
forget() { rm -rf "$POINTSPEC_CACHE_DIR"; }

# ---- the same points, kept or not ----
runs 0 "${bnot[@]}" -m 6 --kept-sets 0 -o anew.txt
[[ ! -e $store ]] || complain "--kept-sets 0 made $store"
runs 0 "${bnot[@]}" -m 6 -o first.txt
[[ $(num_kept) == 6 ]] || complain "$(num_kept) sets are kept, not 6"
runs 0 "${bnot[@]}" -m 6 -o second.txt
[[ ! -s err ]] || complain "kept sets: $(<err)"
cmp anew.txt first.txt || complain "points that are kept now are others"
cmp anew.txt second.txt || complain "points that were kept are others"
# what is cheap is not kept, and 200 bnot are other sets
runs 0 --sampler white -n 1000 -m 3 -o white.txt
[[ $(num_kept) == 6 ]] || complain "white points are kept"
runs 0 --sampler bnot -n 200 -o other.txt
[[ $(num_kept) == 7 ]] || complain "$(num_kept) sets are kept, not 7"

# kept sets need no device, others are refused before any work
step=(--sampler step:rounds=3 -n 1024)
if "$program" devices 2>/dev/null | grep -q '^0,'; then
    runs 0 "${step[@]}" -m 2 -o step.txt
    OCL_ICD_VENDORS=$PWD/none runs 0 "${step[@]}" -m 2 -o kept.txt
    cmp step.txt kept.txt || complain "step sets that were kept are others"
    OCL_ICD_VENDORS=$PWD/none runs 1 "${step[@]}" -m 3 -o kept.txt
    says 'no OpenCL driver'
    refuses 'no OpenCL device fits "quantum"' "${step[@]}" -m 3 --device quantum
    rm "$store"/*.result
    runs 0 "${bnot[@]}" -m 6 -o second.txt
    runs 0 --sampler bnot -n 200 -o other.txt
fi

# ---- results from kept sets ----
power=(power --engine host_direct -k 4 "${bnot[@]}" -m 6)
"$program" "${power[@]}" --kept-sets 0 2>err | grep -v '^# command' >anew.csv || complain "power: $(<err)"
"$program" "${power[@]}" 2>err | grep -v '^# command' >kept.csv || complain "power: $(<err)"
"$program" "${power[@]}" --no-skip --precision extended 2>err | grep -c . >/dev/null || complain "power: $(<err)"
cmp anew.csv kept.csv || complain "spectra of kept sets are others"
quadrature=(quadrature --engine host_direct --brdf diffuse --sampler bnot:lift=hemisphere -n 100 -m 3 -l 4)
"$program" "${quadrature[@]}" --kept-sets 0 2>err | grep -v '^# command' >anew.csv || complain "quadrature: $(<err)"
"$program" "${quadrature[@]}" 2>err | grep -v '^# command' >kept.csv || complain "quadrature: $(<err)"
cmp anew.csv kept.csv || complain "rules of kept sets are others"
[[ $(num_kept) == 7 ]] || complain "lifted points are kept again: $(num_kept)"

# ---- plan says what there is ----
"$program" plan "${power[@]}" >out 2>err || complain "plan: $(<err)"
[[ $(<out) == *"6 of 6 sets kept"* ]] || complain "plan power: $(<out)"
"$program" plan sample "${bnot[@]}" -m 20 >out 2>err || complain "plan: $(<err)"
[[ $(<out) == *"6 of 20 sets kept"* ]] || complain "plan sample: $(<out)"
"$program" plan sample "${bnot[@]}" -m 20 --kept-sets 0 >out 2>err || complain "plan: $(<err)"
[[ $(<out) != *" kept"* ]] || complain "plan without a store: $(<out)"

# ---- damage ----
for file in "$store"/*.result; do
    printf x | dd of="$file" bs=1 seek=700 conv=notrunc status=none
done
runs 0 "${bnot[@]}" -m 6 -o second.txt
says 'kept sets of bnot: 6 were damaged, made anew'
cmp anew.txt second.txt || complain "points after damage are others"
"$program" "${power[@]}" 2>err | grep -v '^# command' >kept.csv
[[ ! -s err ]] || complain "damage is mended: $(<err)"
for file in "$store"/*.result; do truncate -s 300 "$file"; done
"$program" "${power[@]}" 2>err >/dev/null
says 'kept sets of bnot: 6 were damaged, made anew'

# ---- prefetch ----
forget
runs 0 --prefetch "${bnot[@]}" -m 5
says '0 sets were kept already, 5 are made'
[[ ! -s out && $(num_kept) == 5 ]] || complain "prefetch: $(num_kept) sets; $(<out)"
runs 0 --prefetch "${bnot[@]}" -m 8
says '5 sets were kept already, 3 are made'
runs 0 --prefetch "${bnot[@]}" -m 8 --quiet
[[ ! -s err && ! -s out ]] || complain "--quiet: $(<err)"
runs 0 "${bnot[@]}" -m 6 -o second.txt
cmp anew.txt second.txt || complain "prefetched points are others"
runs 0 --prefetch --sampler bnot --sampler fpo -n 200,400 -m 2
[[ $(grep -c '0 sets were kept already, 2 are made' err) == 4 && $(num_kept) == 16 ]] || complain "lists: $(<err)"
# interrupted, it ends soon, and goes on from there
forget
env --default-signal=INT "$program" sample --prefetch --sampler fpo -n 400 -m 100000 2>err &
for _ in {1..600}; do
    (($(num_kept) < 3)) || break
    sleep 0.1
done
kill -INT $!
code=0
wait $! || code=$?
[[ $code == 130 ]] || complain "interrupted: exit $code, $(<err)"
had=$(num_kept)
((had >= 3)) || complain "interrupted: $had sets"
grep -qE "; $had sets are kept, the same command goes on\$" err || complain "interrupted with $had sets: $(<err)"
[[ -z $(find "$store" -name '.pointspec-*') ]] || complain "interrupted: $(ls -A "$store")"
runs 0 --prefetch --sampler fpo -n 400 -m 3
says '3 sets were kept already, 0 are made'
# two at once make the same sets
forget
"$program" sample --prefetch "${bnot[@]}" -m 40 --quiet &
runs 0 --prefetch "${bnot[@]}" -m 40 --quiet
wait $! || complain "the other prefetch: exit $?"
[[ $(num_kept) == 40 ]] || complain "two at once: $(num_kept) sets"
runs 0 "${bnot[@]}" -m 6 -o second.txt
cmp anew.txt second.txt || complain "points of two at once are others"

# a disk that fills, here a limit of the size of files, ends it with the first set that cannot be kept
forget
large=(--sampler fpo:distance=0.8 -n 2000)
runs 0 --prefetch "${large[@]}" -m 3
(
    ulimit -f 16 # KiB, of which a set takes 33
    runs 1 --prefetch "${large[@]}" -m 12
    says 'file size limit, see ulimit -f; 9 of 12 not kept'
    exit $bad
) || bad=1
[[ $(num_kept) == 3 ]] || complain "$(num_kept) sets are kept, not 3"

# ---- memory ----
# what makes a set counts, and is refused before it begins (sanitizers map more than that before the program begins)
! (ulimit -v 2000000 && "$program" --version) >/dev/null 2>&1 || (
    ulimit -v 2000000
    for how in '-o none.txt' --prefetch; do
        # shellcheck disable=SC2086
        runs 1 --sampler bnot -n 2e7 $how
        says '20000000 points in 2 dimensions take 5.886G of memory with what makes a set of them, but ulimit -v leaves 1'
    done
    "$program" plan sample --sampler bnot -n 2e7 >out 2>err || complain "plan without room: $(<err)"
    [[ $(<out) == *'phase: memory; '*' 6.32e+09 bytes'*'but there is no room for it now'* ]] || complain "plan: $(<out)"
    exit $bad
) || bad=1

# ---- the least recently used go ----
forget
runs 0 "${bnot[@]}" -m 20 --kept-sets 40960 -o second.txt
[[ $(num_kept) == 10 ]] || complain "40960 bytes hold $(num_kept) sets"

# ---- bad input ----
refuses 'white makes 16 points about as fast as they are read' --prefetch --sampler white -n 16
refuses 'larger sets are, of ' --prefetch --sampler bnot -n 16
refuses '-o does not go with --prefetch: it writes no points' --prefetch "${bnot[@]}" -o x.txt
refuses '--plot does not go with --prefetch: it writes no points' --prefetch "${bnot[@]}" --plot x.png
refuses '--format does not go with --prefetch: it writes no points' --prefetch "${bnot[@]}" --format npy
refuses 'unknown sampler "bluenoise"; there are white, ' --prefetch --sampler bluenoise -n 16
runs 1 --prefetch "${bnot[@]}" -m 1000 --kept-sets 1e6
says '1000 sets take '
# all of several questions must have room beside each other
runs 1 --prefetch --sampler bnot -n 100,200 -m 10 --kept-sets 6e4
says '20 sets take '
# no folder: points are made all the same, and that is said once; prefetch has nothing to do then
forget
mkdir "$POINTSPEC_CACHE_DIR"
: >"$store"
runs 0 "${bnot[@]}" -m 6 -o second.txt
says "kept sets of bnot: cannot make the folder of the cache $store: Not a directory"
cmp anew.txt second.txt || complain "points without a folder are others"
runs 1 --prefetch "${bnot[@]}"
says "kept sets of bnot: cannot make the folder of the cache $store: Not a directory"
forget
mkdir -m 777 "$POINTSPEC_CACHE_DIR"
runs 1 --prefetch "${bnot[@]}" --quiet
says 'there is no folder to keep sets in'
finish

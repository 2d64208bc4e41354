#!/usr/bin/env bash
# cli_run.sh PROGRAM: pointspec run: the folder, tables as the commands make them, the cache under every misfortune, records, what it refuses.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" run "$1"
export POINTSPEC_CACHE_DIR=$scratch/cache
unset POINTSPEC_KERNEL_DIR

cached() { # of all questions, as standard output says
    awk -F, '!/^#/ && NR > 1 && $4 ~ /^[0-9]+$/ { sum += $4 } END { print sum + 0 }' out
}
digests() { sed -n '/"digests"/,$p' "$1/record.json" | tr -d ' \n'; }
same_results() { # FOLDER FOLDER: tables and pictures
    local file
    for file in "$1"/*.csv "$1"/*.svg; do
        cmp -s "$file" "$2/${file##*/}" || complain "$file and $2/${file##*/} differ"
    done
}
no_folder() { [[ ! -e $1 ]] || complain "there is a folder $1"; }

"$program" power --engine host_direct --sampler jittered -n 16 -m 20 -k 5 -o saved.npz
printf '1 2\n-3 0\n1000000 1\n' >vectors.txt
mkdir sets
"$program" sample --sampler white -n 9 -m 2 -o 'sets/a&b.txt'
"$program" sample --sampler white -n 7 -o sets/-c.txt
cat >small.yaml <<'EOF'
scene: 1
title: "Less < more > & \"quotes\" 'n' $HOME `x`\ntwo lines"
description: "<script>alert(1)</script> & more"
defaults: {engine: host_direct, seed: 7}
results:
  - {result: power, name: plane, title: 'A <b> & "c"', samplers: [white, jittered], points: 16..64, realizations: 3, max-frequency: 4, pictures: true, arrays: true}
  - {result: power, name: files, seed: 1, files: [[sets/a&b.txt], [sets/-c.txt]], max-frequency: 3, per-ring: 2, pictures: true}
  - {result: power, name: list, samplers: white, points: 8, frequencies: vectors.txt, arrays: coefficients}
  - {result: angular, samplers: [zphi, white-sphere], points: 16, max-degree: 5, realizations: 2}
  - {result: pairs, samplers: zphi, points: 16, max-degree: 5, realizations: 2}
  - {result: quadrature, samplers: [fibonacci-hemisphere, white-hemisphere], weights: [equal, optimal], points: 4..8, brdf: diffuse, max-degree: 4, arrays: true}
  - {result: truncation, brdf: [diffuse, 'glossy:n=5'], max-degree: 5}
  - {result: check, against: saved.npz, samplers: jittered}
EOF

# ---- the folder ----
runs 0 small.yaml -o first
questions=$(awk -F, '/^[a-z]/ && NR > 3 { sum += $3 } END { print sum }' out)
[[ $questions == 23 && $(cached) == 0 && $(key page) == first/index.html ]] || complain "$questions questions: $(<out)"
for name in plane files list angular-4 pairs-5 quadrature-6 truncation-7 check-8; do
    [[ -s first/$name.csv && -s first/$name.summary.csv ]] || complain "no tables of $name"
done
for name in plane plane-picture-{1..6} files angular-4 pairs-5-{sums,c2} quadrature-6-{d2,c2,e2,convergence} truncation-7-{error,points} check-8-scores; do
    [[ -s first/$name.svg ]] || complain "no picture $name"
done
[[ $(find first -type f | wc -l) == 51 ]] || complain "other files: $(ls first)"
# the header of a table is one line for each key
! grep -v '^# [a-z_0-9]*: \|^[a-z0-9./&-]*,' first/plane.csv >odd || complain "odd lines: $(<odd)"

# rows are those of the commands in the header
check_rows() { # NAME FIRST-COLUMN-OF-THE-COMMAND
    local line=
    sed -n '/^[^#]/p' "first/$1.csv" | sed 1d | cut -d, -f"$2-" >rows
    sed -n 's/^# command: pointspec //p' "first/$1.csv" >commands
    while read -r line; do
        eval "\"\$program\" $line" | sed '/^#/d' | sed 1d
    done <commands >expected
    if [[ ! -s rows ]] || ! cmp -s rows expected; then complain "$1: other rows than its commands have"; fi
}
# arrays are those of --full, --weights-out and --coefficients
check_arrays() { # NAME OPTION
    local line='' number=0
    sed -n 's/^# command: pointspec //p' "first/$1.csv" >commands
    while read -r line; do
        number=$((number + 1))
        eval "\"\$program\" $line $2 expected.npy" >/dev/null
        cmp -s "first/$1-array-$number.npy" expected.npy || complain "$1-array-$number is not what $2 writes"
    done <commands
    ((number > 0)) || complain "$1 has no commands"
}
check_arrays plane --full
check_arrays quadrature-6 --weights-out
check_arrays list --coefficients
printf 'scene: 1\nresults:\n  - {result: %s, arrays: coefficients}\n' 'angular, engine: host_direct, samplers: [zphi, white-sphere], points: 12, max-degree: 4' >turned.yaml
runs 0 turned.yaml -o turned
"$program" angular --engine host_direct --sampler white-sphere -n 12 -l 4 --coefficients expected.npy >/dev/null
cmp -s turned/angular-1-array-2.npy expected.npy || complain "c_lm of a scene are not those of --coefficients"
check_rows plane 3
check_rows files 2
check_rows list 1
check_rows angular-4 2
check_rows pairs-5 1
check_rows quadrature-6 4
check_rows truncation-7 2
check_rows check-8 1

# ---- the page: tags are balanced, all pictures are inside, nothing is fetched, texts are escaped ----
page=first/index.html
awk 'BEGIN { RS = "<"; void["meta"]; void["br"] }
    NR == 1 || /^!/ || /^\?/ { next }
    {
        if (!match($0, /^\/?[a-zA-Z0-9:]+/)) { print "odd: <" substr($0, 1, 40); next }
        name = substr($0, 1, RLENGTH); end = index($0, ">")
        if (!end) { print "open: <" substr($0, 1, 40); next }
        if (name ~ /^\//) { if (stack[depth--] != substr(name, 2)) print "end: " name } else if (!(name in void) && substr($0, end - 1, 1) != "/") stack[++depth] = name
    }
    END { if (depth) print "left open: " stack[depth] }' "$page" >odd
[[ ! -s odd ]] || complain "page: $(head -n 3 odd)"
[[ $(grep -o '<svg' "$page" | wc -l) == $(find first -name "*.svg" | wc -l) ]] || complain "pictures of the page"
! grep -oE '(src|href)="(https?:|//)[^"]*"|url\(http[^)]*\)|@import|<(script|link|img|iframe)' "$page" || complain "the page fetches something"
grep -q 'Less &lt; more &gt; &amp; &quot;quotes&quot;' "$page" || complain "title"
grep -q '&lt;script&gt;alert(1)&lt;/script&gt; &amp; more' "$page" || complain "description"
grep -q 'A &lt;b.* &amp; ' first/plane.svg || complain "title of a picture"

# ---- a second run has everything from the cache, in less than half a second ----
before=$(now)
runs 0 small.yaml -o second
after=$(now)
[[ $(cached) == "$questions" ]] || complain "second run: $(<out)"
! took_longer "$before" "$after" 2 || complain "second run: from $before to $after s" # four times the limit
same_results first second
runs 0 small.yaml -o first # over an earlier run
[[ $(digests first) == "$(digests second)" ]] || complain "digests"
grep -q '<td class="text">cache</td>' first/index.html || complain "the page does not tell of the cache"
# nothing is taken from the cache, and nothing kept
runs 0 small.yaml -o none --cache 0 --quiet
[[ $(cached) == 0 && ! -s err ]] || complain "--cache 0: $(<out)"
same_results first none
POINTSPEC_KERNEL_DIR=$scratch runs 0 small.yaml -o none
[[ $(cached) == 0 ]] || complain "POINTSPEC_KERNEL_DIR: $(<out)"
runs 0 small.yaml -o unskipped --no-skip
[[ $(cached) == 0 ]] || complain "--no-skip: $(<out)"
for name in plane angular-4 pairs-5; do # powers and sums are right to the tolerance, 1e-6 of white noise
    paste -d, <(sed '/^#/d' first/$name.csv) <(sed '/^#/d' unskipped/$name.csv) | awk -F, 'NR > 1 {
        for (i = 1; i <= NF / 2; i++) { d = $i - $(i + NF / 2); if (d > 1e-5 || d < -1e-5) { print; exit 1 } } }' >odd ||
        complain "--no-skip: $name: $(<odd)"
done

# ---- records: the same bits from anywhere, or exit 3 ----
mkdir elsewhere
cp first/record.json elsewhere
cd elsewhere
runs 0 record.json # right after the run, whose answers are in the cache: computed all the same
[[ $(cached) == 0 && $(digests record) == "$(digests ../first)" ]] || complain "record: $(<out)"
for name in plane files list check-8; do # other headers: the paths are others
    cmp -s <(sed '/^#/d' ../first/$name.csv) <(sed '/^#/d' record/$name.csv) || complain "record: other rows of $name"
done
sed -E '/"digests"/,$ { 0,/"[0-9a-f]{32}"/ s/"[0-9a-f]{32}"/"00000000000000000000000000000000"/ }' record.json >altered.json
runs 3 altered.json
says 'has other bits than the record, which is of pointspec'
[[ -s altered/index.html ]] || complain "no page of an altered record"
# a record of another kind of device: what differs is said, and the engines of then can be asked for
sed -E 's/"kind": ".*"/"kind": "another driver"/; s/"engine": "\(host_direct/"engine": "(torus_direct/' altered.json >other.json
runs 3 other.json -o other
says 'a device of another kind (another driver) than this one ('
says '--recorded-engines takes the engines of then: pointspec power'
grep -q '"kind": "[^"]*, vectors of [0-9]* and [0-9]*, local memory' other/record.json || complain "no kind: $(grep kind other/record.json)"
printf 'scene: 1\nresults:\n  - {result: power, engine: host_direct, samplers: [white, jittered], points: 64, max-frequency: 6}\n' >forced.yaml
runs 0 forced.yaml -o forced
sed '/"engine": \["host_direct"\]/d' forced/record.json >free.json
runs 3 free.json -o free
[[ $(grep -c '(torus_[a-z]* ' free/record.json) == 2 && $(<err) != *'another kind'* ]] || complain "the engine of a record is taken unasked: $(<err)"
runs 0 free.json -o recorded --recorded-engines
[[ $(grep -c -- '--engine host_direct --precision extended' recorded/record.json) == 2 ]] || complain "engines: $(grep command recorded/record.json)"
sed 's/(host_direct/(sorcery/' free.json >magic.json
runs 2 magic.json -o magic --recorded-engines
says 'the record names an engine "(sorcery'
runs 2 ../small.yaml -o none --recorded-engines
says '--recorded-engines is for records'
sed -E '/"digests"/,$ s/"[0-9a-f]{32}",//' record.json >short.json
runs 3 short.json
cd ..

# ---- a check that fails: exit 3, everything written ----
cat >gate.yaml <<'EOF'
scene: 1
results:
  - {result: check, against: saved.npz, samplers: [jittered, white], engine: host_direct}
EOF
runs 3 gate.yaml
says '1 check found another spectrum than the saved one: '
[[ -s gate/index.html && -s gate/check-1.csv ]] || complain "gate: $(ls gate)"
grep -q 'class="bad">different' gate/index.html || complain "gate: no verdict"

# ---- standard input ----
runs 0 - <gate.yaml --help
checked=$((checked + 1))
sed 's/, white//' gate.yaml | "$program" run - >out 2>err || complain "standard input: $(<err)"
[[ -s scene-results/index.html ]] || complain "standard input: $(ls)"
printf 'scene: 1\nresult: 3\n' | "$program" run - 2>err && complain "standard input"
[[ $(<err) == *"-:2: result: unknown key; did you mean results?"* ]] || complain "standard input: $(<err)"

# ---- what is refused, before any work ----
nothing=$(find . -type f | wc -l)
refuses 'one scene is run at a time, but 0 files were named'
refuses 'one scene is run at a time, but 2 files' small.yaml gate.yaml
refuses "sets/a&b.txt:11: not YAML" "sets/a&b.txt" -o none2
refuses 'has files that are not of a run' small.yaml -o sets
refuses '"saved.npz" is no folder' small.yaml -o saved.npz
runs 1 small.yaml -o nowhere/at/all
says 'cannot write the results "nowhere/at/all" to "nowhere/at/"'
mkfifo fifo
printf 'scene: 1\nresults:\n  - {result: power, files: fifo, engine: host_direct}\n' >pipe.yaml
refuses '"fifo" is a pipe' pipe.yaml -o none2
printf 'scene: 1\nresults:\n  - {result: power, files: missing.txt}\n' >missing.yaml
runs 1 missing.yaml # as a command says
says 'missing.yaml:3: files: cannot read "missing.txt"'
printf 'scene: 1\nresults:\n  - {result: power, samplers: zphi}\n' >wrong.yaml
refuses 'wrong.yaml:3: power-1: --sampler zphi makes points of the sphere' wrong.yaml
"$program" angular --engine host_direct --sampler zphi -n 8 -m 5 -l 3 -o sphere.npz
printf 'scene: 1\nresults:\n  - {result: check, against: [saved.npz, sphere.npz], files: sets/-c.txt}\n' >both.yaml
runs 2 both.yaml
no_folder none2; no_folder missing; no_folder wrong
[[ $(find . -type f -not -path './cache/*' | wc -l) -le $((nothing + 9)) ]] || complain "something was left: $(ls)"

# ---- misfortunes of the cache: only warnings ----
rm -rf cache && runs 0 small.yaml -o first --quiet
entries=(cache/results/*)
for entry in cache/results/*; do # every second is cut, the others are damaged
    if ((${#entry} > 0 && (n = ${n-0} + 1) % 2)); then
        truncate -s 40 "$entry"
    else
        printf 'X' | dd of="$entry" bs=1 seek=$(($(stat -c %s "$entry") - 3)) conv=notrunc status=none
    fi
done
runs 0 small.yaml -o damaged --quiet
[[ $(cached) == 0 && ${#entries[@]} -gt 20 ]] || complain "damaged entries: $(<out)"
same_results first damaged
runs 0 small.yaml -o damaged
[[ $(cached) == "$questions" ]] || complain "the cache did not heal: $(<out)"
echo file >cache-file
POINTSPEC_CACHE_DIR=$scratch/cache-file/sub runs 0 small.yaml -o uncached
says 'no cache of results: '
POINTSPEC_CACHE_DIR=/proc/pointspec runs 0 small.yaml -o uncached --quiet
[[ ! -s err && $(cached) == 0 ]] || complain "--quiet: $(<err)"
same_results first uncached
if [[ $EUID != 0 ]]; then # root may write anywhere
    rm -rf cache/results/* && chmod a-w cache/results
    runs 0 small.yaml -o uncached
    grep -q 'the cache of results: ' err || complain "read-only cache: $(<err)"
    chmod u+w cache/results
fi
# a folder that others can write: the whole cache, or the results alone; one warning, and the results are there
for folder in cache cache/results; do
    rm -rf cache
    runs 0 small.yaml -o uncached --quiet
    chmod 777 "$folder"
    runs 0 small.yaml -o uncached
    [[ $(cached) == 0 && $(grep -c "$folder can be written by other users" err) == 1 ]] || complain "$folder, mode 777: $(<err)"
    same_results first uncached
done
rm -rf cache && runs 0 small.yaml -o uncached --quiet
# pipes in place of all entries: nobody waits for a writer
for entry in cache/results/*.result; do rm "$entry" && mkfifo "$entry"; done
timeout 600 "$program" run small.yaml -o uncached --quiet >out 2>err || complain "pipes for entries: $(<err)"
[[ $(cached) == 0 ]] || complain "pipes for entries: $(<out)"
runs 0 small.yaml -o uncached
[[ $(cached) == "$questions" ]] || complain "pipes for entries stayed: $(<out)"
# a cache where nothing can be written: one warning, not one per answer
rm -rf cache && runs 0 small.yaml -o uncached --quiet
for entry in cache/results/*.result; do rm "$entry" && mkdir "$entry"; done
runs 0 small.yaml -o uncached
[[ $(grep -c 'the cache of results: ' err) == 1 ]] || complain "folders for entries: $(<err)"
# a full disk: no file may have a byte
if (trap "" XFSZ; ulimit -f 0; POINTSPEC_CACHE_DIR=$scratch/full-cache exec "$program" run small.yaml -o full 2>&1 >/dev/null) | cat >said; then
    complain "full disk"
fi
[[ $(grep -c 'the cache of results: cannot write' said) == 1 && $(tail -n 1 said) == "pointspec run: cannot write"*full/* ]] || complain "full disk: $(<said)"
[[ -z $(ls -A full) ]] || complain "full disk: $(ls -A full)"

# ---- two at once, with one cache ----
rm -rf cache
"$program" run small.yaml -o one --quiet >/dev/null & one=$!
"$program" run small.yaml -o other --quiet >/dev/null & other=$!
wait $one || complain "two at once"
wait $other || complain "two at once"
same_results first one
same_results first other

# ---- interrupted: no folder, and the next run goes on ----
cat >long.yaml <<'EOF'
scene: 1
results:
  - {result: power, samplers: white, engine: host_direct, points: 256, max-frequency: 24, plot: false, no-self-check: true, seed: [1, 2, 3, 4, 5, 6, 7, 8]}
  - {result: power, samplers: white, engine: host_direct, points: 8192, realizations: 100, max-frequency: 64, plot: false, no-self-check: true}
EOF
rm -rf cache
set -m # else the shell has background processes ignore SIGINT
"$program" run long.yaml >out 2>err & run=$!
set +m
# shellcheck disable=SC2317 # wait_until calls it
has_two_results() { (($(find cache/results -name "*" -type f 2>/dev/null | wc -l) >= 2)); }
wait_until $run has_two_results
kill -INT $run
code=0
wait $run || code=$?
[[ $code == 130 && $(<err) == *"pointspec run: "*"interrupted"* ]] || complain "interrupted: $code $(<err)"
no_folder long
sed -i 4d long.yaml
runs 0 long.yaml
(($(cached) >= 2)) || complain "after the interruption: $(<out)"
finish

#!/usr/bin/env bash
# cli_program.sh PROGRAM: what goes to which stream, signals, formats, and same seed, same bits.
set -euo pipefail
program=$(realpath "$1")
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
unset POINTSPEC_DEVICE

# The leak sanitizer may trip over threads of PoCL when a run is short. That is no finding: once more
# without it.
tripped='LeakSanitizer has encountered a fatal error'
bad=0
complain() {
    printf 'cli_program: %s\n' "$*" >&2
    bad=1
}
# runs EXIT ARGS...: standard output in out, standard error in err.
runs() {
    local expected=$1 code
    shift
    for leaks in 1 0; do
        code=0
        ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=$leaks \
            "$program" "$@" </dev/null >out 2>err || code=$?
        grep -q "$tripped" err || break
    done
    [[ $code == "$expected" ]] || complain "exit $code, not $expected: $*: $(<err)"
}
quietly() { # ARGS...: exit 0 and nothing on standard error
    runs 0 "$@"
    [[ ! -s err ]] || complain "says something: $*: $(<err)"
}

# ---- help and version
quietly --version
quietly -V
[[ $(<out) =~ ^pointspec\ [0-9]+\.[0-9]+\.[0-9]+$ ]] || complain "version: $(<out)"
quietly --help
cp out help
quietly help
cmp -s help out || complain "help and --help differ"
quietly help sample
cp out help
quietly sample --help
cmp -s help out || complain "help sample and sample --help differ"
for name in white jittered sobol :scramble=none :strata=auto fibonacci :nside=auto :lift=none; do
    grep -q -e "^ *$name " out || complain "sample --help does not name $name"
done
[[ $(wc -L <out) -le 80 ]] || complain "sample --help is $(wc -L <out) columns wide"
runs 2
[[ ! -s out && $(<err) == *devices* ]] || complain "without arguments: $(<err)"

# ---- sample: shape and bits
quietly sample --sampler white -n 10 -m 3 -d 3
cp out first
[[ $(grep -c . out) == 32 && $(grep -c '^#$' out) == 2 ]] || complain "10 points in 3 sets"
awk '!/^#/ && NF != 3 { exit 1 }' out || complain "3 coordinates"
quietly sample --sampler white -n 10 -m 3 -d 3 -s 1 -o points.txt
cmp -s first points.txt || complain "-o writes something else than standard output"
[[ ! -s out ]] || complain "results beside -o"
quietly sample --sampler white -n 10 -m 3 -d 3 -s 2
cmp -s first out && complain "two seeds, same points"
quietly sample --sampler white -n 10 -m 2 -d 3
head -n 21 first | cmp -s - out || complain "realizations depend on how many there are"
quietly sample --sampler white -n 10 -m 3 -d 3 --homogenize
cmp -s first out && complain "--homogenize changes nothing"
quietly sample --sampler white -n 10 -m 3 -d 3 --format npy
cp out stream.npy
quietly sample --sampler white -n 10 -m 3 -d 3 -o points.npy
cmp -s stream.npy points.npy || complain "--format npy and .npy differ"

# ---- sample: the sphere
quietly sample --sampler fibonacci -n 100 -m 2 --homogenize -o sphere.npy
for format in utk-text csv utk-binary npy; do
    quietly sample --sampler fibonacci -n 100 -m 2 --homogenize --format $format -o "sphere.$format" -d 3
    quietly convert --domain sphere --input-format $format "sphere.$format" -o back.npy
    cmp -s sphere.npy back.npy || complain "sample and convert: other vectors in $format"
done
quietly sample --sampler healpix:nside=3
[[ $(wc -l <out) == 108 ]] || complain "nside=3: $(wc -l <out) points"
grep -aq "'shape': (3, 10, 3)" points.npy || complain "shape in NPY"
quietly power -k 4 --no-self-check points.npy
grep -v '^# ' out >from_npy
quietly power -k 4 --no-self-check points.txt
grep -v '^# ' out | cmp -s - from_npy || complain "UTK text and NPY have different spectra"
"$program" sample --sampler white -n 10 -m 3 -d 3 |
    ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=0 "$program" power -k 4 --no-self-check - |
    grep -v '^# ' | cmp -s - from_npy || complain "standard input has another spectrum"

# ---- weights of files: named by --columns, dropped by --weights equal; the header tells what was read
quietly sample --sampler white -n 2 -m 3 -o three.npy
printf '0.5 0.25 2\n0.75 0.5 1\n' >weighted.txt
printf '0.5 0.25\n0.75 0.5\n' >plain.txt
spectrum() { # ARGS...: rows of the table
    quietly power -k 4 --engine host_direct "$@"
    grep -v '^# ' out
}
spectrum --columns xyw weighted.txt >by_columns
grep -q '^# input_columns: xyw$' out || complain "columns in the header: $(grep input_ out)"
spectrum --weights column weighted.txt | cmp -s - by_columns || complain "--columns xyw drops weights"
spectrum plain.txt >without
cmp -s by_columns without && complain "weights change nothing"
spectrum --columns xyw --weights equal weighted.txt | cmp -s - without ||
    complain "--weights equal keeps the weights of the file"
cp plain.txt copy.txt
quietly power -k 4 --engine host_direct plain.txt three.npy copy.txt
grep -q '^# input_format: utk-text; npy$' out || complain "formats in the header: $(grep input_ out)"
printf '2\n1\n' >list.txt
spectrum --weights list.txt plain.txt | cmp -s - by_columns || complain "--weights FILE"
spectrum --columns xyw --weights list.txt weighted.txt | cmp -s - by_columns ||
    complain "--weights FILE beside a column"

# ---- random subsets of rings: of files too, by the seed; the header and plan say what was left out
quietly sample --sampler jittered -n 32 -d 5 -m 3 -o five.npy
spectrum --per-ring 8 five.npy >of_subset
grep -q '^# per_ring: 8$' out || complain "per_ring in the header: $(grep '^#' out)"
grep -q '^# seed: 1$' out || complain "seed in the header: $(grep '^#' out)"
grep -q '^# computed: 64 of 9904 frequencies of the rings, both signs$' out ||
    complain "computed in the header: $(grep '^#' out)"
spectrum --per-ring 8 --seed 1 five.npy | cmp -s - of_subset || complain "--per-ring: another subset"
spectrum --per-ring 8 --seed 2 five.npy | cmp -s - of_subset && complain "--per-ring: same subset"
spectrum --per-ring 8 --no-skip five.npy | cmp -s - of_subset || complain "--per-ring with --no-skip"
spectrum five.npy >of_all
spectrum --per-ring 1e6 five.npy | cmp -s - of_all || complain "--per-ring, complete"
cut -d , -f 1,4 of_all >counts
cut -d , -f 1,4 of_subset | cmp -s - counts || complain "--per-ring changes counts"
quietly power -k 4 --per-ring 8 --bins shells --format json five.npy
grep -q '"per_ring": \[8\]' out || complain "per_ring in JSON"
quietly power -k 4 --per-ring 8 --select-sets 1 -o one.npy five.npy
grep -q 'one realization: that of the choice' one.json || complain "one realization: $(<one.json)"
# a deterministic set has the error of the choice, however many realizations were asked for
spectrum --sampler hammersley -n 32 -d 4 --per-ring 8 | tail -n 1 >one_row
spectrum --sampler hammersley -n 32 -d 4 --per-ring 8 -m 5 | tail -n 1 | cmp -s - one_row ||
    complain "--per-ring of a deterministic set: $(tail -n 1 out)"
quietly plan power -k 4 --per-ring 8 five.npy
grep -q '^# skip: frequencies outside the random subset of each ring; .*; 0\.99' out ||
    complain "skip of --per-ring: $(grep skip out)"

# ---- float32 pairs, as many as -n says; some of the sets
quietly sample --sampler white -n 64 -m 3 --format rps -o three.rps --quiet
quietly convert -n 64 three.rps -o three.txt
spectrum three.txt >of_text
spectrum -n 64 three.rps | cmp -s - of_text || complain "-n of rps"
grep -q '^# realizations: 3$' out || complain "-n of rps: $(grep realizations out)"
quietly convert --select-sets 2.. three.txt -o two.txt
spectrum two.txt >of_two
spectrum -n 64 --select-sets 2.. three.rps | cmp -s - of_two || complain "--select-sets"

# ---- devices, and POINTSPEC_DEVICE as the default of --device
quietly devices
grep -q '^index,default,name,type,' out || complain "columns of devices"
[[ $(grep -v '^#' out | grep -c '^[0-9]*,1,') == 1 ]] || complain "one default device"
quietly devices --format json
grep -q '"schema": *3' out || complain "JSON of devices"
POINTSPEC_DEVICE=quantum runs 2 devices
POINTSPEC_DEVICE=quantum quietly devices --device 0

# ---- the header repeats the command line so that a shell takes it back
quietly devices -o "it's here.csv"
grep -qF "# command: pointspec devices -o 'it'\\''s here.csv'" "it's here.csv" ||
    complain "command line: $(grep command "it's here.csv")"

# ---- writes that fail
code=0
("$program" sample --sampler white -n 1e5 2>err || echo $? >code) | head -n 1 >out
[[ ! -s err && $(<code) == 141 ]] || complain "closed pipe: exit $(<code), $(<err)"
# who ignores SIGPIPE hears of it
(trap '' PIPE; "$program" sample --sampler white -n 1e5 2>err || echo $? >code) | head -n 1 >out
[[ $(<code) == 1 && $(<err) == "pointspec sample: cannot write standard output: Broken pipe" ]] ||
    complain "closed pipe, ignored: exit $(<code), $(<err)"
for arguments in --help --version 'sample --sampler white'; do
    code=0
    # shellcheck disable=SC2086  # words
    "$program" $arguments >/dev/full 2>err || code=$?
    [[ $code == 1 && $(wc -l <err) == 1 ]] || complain "full disk: $arguments: exit $code"
    code=0
    # shellcheck disable=SC2086
    "$program" $arguments >&- 2>err || code=$?
    [[ $code == 1 && $(wc -l <err) == 1 ]] || complain "closed output: $arguments: exit $code"
done

# ---- SIGTERM and SIGINT: exit 130, one line, nothing left behind
# shellcheck source=tests/harness/moments.sh
. "$here/../harness/moments.sh"
interrupts() { # SIGNAL ARGS...
    local signal=$1 code=0 pid
    shift
    mkdir interrupted
    # Background jobs ignore SIGINT, which the program respects; env takes that back.
    env --default-signal=INT "ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=0" \
        "$program" "$@" >/dev/null 2>err &
    pid=$!
    wait_until_it_catches $pid
    sleep 0.5 # and some way into its work
    kill -s "$signal" $pid
    wait $pid || code=$?
    [[ $code == 130 ]] || complain "$signal: exit $code: $*: $(<err)"
    # A driver whose compiler was interrupted may have its own words about that.
    [[ $(grep -c '^pointspec' err) == 1 ]] || complain "$signal: not one sentence: $(<err)"
    [[ -z $(ls -A interrupted) ]] || complain "$signal leaves $(ls -A interrupted): $*"
    rm -rf interrupted
}
interrupts TERM sample --sampler white -n 1000 -m 1e9 -o interrupted/points.txt
interrupts INT sample --sampler white -n 1000 -m 1e9 -o interrupted/points.npy
interrupts INT power --sampler white -n 1000 -m 1e9 -k 8 -o interrupted/power.csv
# inside one realization, too
interrupts INT power --sampler white -n 65536 -k 300 --engine host_direct -o interrupted/power.csv

# ---- a pipe with a name: its reader gets the whole table
mkfifo pipe
cat pipe >from_pipe.csv &
"$program" power --sampler white -n 64 -k 3 -o pipe || complain "named pipe: exit $?"
wait $!
grep -q '^3,' from_pipe.csv || complain "named pipe: no table"

exit $bad

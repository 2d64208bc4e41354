#!/usr/bin/env bash
# cli_signals.sh PROGRAM: whatever it is doing, a signal ends the program within a second: exit 130, one sentence, no
# temporary files, no children.
set -euo pipefail
program=$(realpath "$1")
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
unset POINTSPEC_DEVICE
export ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=0
mkdir work tmp
export TMPDIR=$scratch/tmp

bad=0
complain() {
    printf 'cli_signals: %s\n' "$*" >&2
    bad=1
}

# shellcheck source=tests/harness/moments.sh
. "$here/../harness/moments.sh"

# The promise is 1 s, of a machine with nothing else to do.
limit=1.5

# What is asked for here has room beside other work, on a machine where 6 GB are free.
ulimit -v 6000000

# interrupts SIGNAL MOMENT ARGS...: the signal comes so many seconds after the start, or when there is such a file. Files
# belong into work/.
interrupts() {
    local signal=$1 moment=$2 code=0 pid begin end left
    shift 2
    # Background jobs ignore SIGINT, which the program respects; env takes that back.
    env --default-signal=INT "$program" "$@" >/dev/null 2>err </dev/null &
    pid=$!
    wait_until_it_catches $pid
    case $moment in
    [0-9]*) sleep "$moment" ;;
    *) wait_until $pid test -s "$moment" ;;
    esac
    begin=$(now)
    kill -s "$signal" $pid 2>/dev/null || complain "ended before $moment: $*: $(<err)"
    wait $pid || code=$?
    end=$(now)
    ! took_longer "$begin" "$end" $limit || late+=("$signal: $*")
    [[ -z ${VERBOSE-} ]] || printf '%-5s %s .. %s s  %s: %s\n' "$signal" "$begin" "$end" "$*" "$(<err)"
    [[ $code == 130 ]] || complain "$signal: exit $code: $*: $(<err)"
    # A driver whose compiler was interrupted may have its own words about that.
    [[ $(grep -c '^pointspec.*: interrupted' err) == 1 && $(grep -c '^pointspec' err) == 1 ]] ||
        complain "$signal: not one sentence: $*: $(<err)"
    left=$(find work tmp -mindepth 1)
    [[ -z $left ]] || complain "$signal leaves $left: $*"
    rm -rf work/* tmp/*
}
# What else runs may be different in the very moment: who is late is asked again, and is late every time.
ends_in_time() { # SIGNAL MOMENT ARGS...
    local try
    for try in 1 2 3; do
        late=()
        interrupts "$@"
        ((${#late[@]})) || return 0
    done
    complain "more than $limit s, $try times: ${late[*]}"
}

# ---- what takes long, of every command
hemisphere=(--sampler fibonacci-hemisphere --brdf diffuse --smoothness 1.5)
ends_in_time INT 1 quadrature -n 1e6 "${hemisphere[@]}" -l 8 --weights optimal -o work/a.csv
ends_in_time TERM 1.5 quadrature -n 15000 "${hemisphere[@]}" -l 8 --weights optimal -o work/a.csv
ends_in_time INT 0.5 quadrature -n 1e6 "${hemisphere[@]}" -l 8 -o work/a.csv
ends_in_time HUP 1 pairs --sampler white-sphere -n 20000 -m 100 -l 3000 -o work/a.csv
ends_in_time INT 1 power --sampler white -d 1 -n 1024 -k 20000000 -o work/a.csv
ends_in_time INT 0.3 power --sampler white -d 1 -n 1024 -k 20000000 -o work/a.csv
ends_in_time TERM 1 power --sampler white -d 6 -n 4096 -k 60 --per-ring 100000 -o work/a.csv
ends_in_time INT 1 sample --sampler white -n 1e8 -m 3 -o work/a.npy
ends_in_time TERM 1 sample --sampler sobol -n 1e8 -o work/a.txt
ends_in_time INT 1 sample --sampler white -n 1e8 --plot work/a.svg
ends_in_time INT 0.7 power --sampler white -n 65536 -k 300 --engine host_direct -o work/a.csv
ends_in_time HUP 0.7 angular --sampler white-sphere -n 1e6 -m 100 -l 500 -o work/a.csv
ends_in_time INT 0.3 truncation --brdf glossy:n=30 --harmonics hemispherical -l 400 -o work/a.csv
ends_in_time TERM 1 stress
ends_in_time INT 1 bench
mkfifo endless
ends_in_time INT 0.3 convert --input-format rps /dev/zero -o work/a.npy
ends_in_time TERM 0.3 power --input-format csv endless -k 8 -o work/a.csv # nobody writes to the pipe

# ---- what takes long has a name on a terminal, and is never "0 of something at 0/s"
shows() { # PATTERN SECONDS ARGS...: within so many seconds, or within more where other work is in the way
    local pattern=$1 seconds=$2 patience
    shift 2
    for patience in 1 4 16; do
        script -qec "timeout -s INT $((patience * seconds)) $program $*" /dev/null </dev/null >seen || true
        tr '\r' '\n' <seen >lines
        ! grep -qE "$pattern" lines || break
    done
    grep -qE "$pattern" lines || complain "no \"$pattern\": $*: $(tail -n 3 lines)"
    if grep -qE '(^|[^0-9.])0 (of [0-9]+ )?[a-z]+, 0/s' lines; then complain "no progress: $*"; fi
}
if command -v script >/dev/null; then
    shows '^weights: [0-9]+ of 1000000 rows of an approximate inverse, .* left' 4 \
        quadrature -n 1e6 "${hemisphere[@]}" -l 8 --weights optimal --engine host_direct
    shows '^weights: [0-9]+ iterations of conjugate gradients, residual [0-9.e-]+' 4 \
        quadrature -n 9000 "${hemisphere[@]}" -l 8 --weights optimal --memory 100M --engine host_direct
    shows '^E: [0-9]+ of [0-9]+ blocks of pairs of points, .* left' 3 \
        quadrature -n 4e5 "${hemisphere[@]}" -l 8 --engine host_direct
    shows '^the first of 1 realizations, [1-9] s' 3 power --sampler white -n 1e6 -k 1000 --engine host_direct
fi

# ---- a program that we have started ends with us
mkdir bin
cat >bin/gnuplot <<'END'
#!/bin/sh
echo $$ >"$GNUPLOT_PID"
exec sleep 100
END
chmod +x bin/gnuplot
GNUPLOT_PID=$scratch/child PATH=$scratch/bin:$PATH \
    ends_in_time TERM "$scratch/child" power --sampler white -n 64 -k 4 -o work.csv --plot work/a.png
lives() { [[ -e /proc/$1/stat && $(awk '{ print $3 }' "/proc/$1/stat" 2>/dev/null) != [ZX] ]]; }
[[ -s child ]] || complain "gnuplot was not started"
for ((i = 0; i < 300; i++)); do lives "$(<child)" && sleep 0.2; done
if lives "$(<child)"; then complain "gnuplot lives on"; fi

# ---- the limit of file sizes is a sentence
code=0
(ulimit -f 100 && exec "$program" sample --sampler white -n 1e6 -o work/a.npy 2>err) || code=$?
[[ $code == 1 && $(<err) == *"file size limit"* && -z $(ls -A work) ]] ||
    complain "file size limit: exit $code, $(<err), $(ls -A work)"

# ---- what a killed run leaves goes with the next output, what a living one writes does not
"$program" sample --sampler white -n 1e8 -o work/dead.npy 2>err &
until compgen -G 'work/.pointspec-*.tmp' >/dev/null; do sleep 0.05; done
kill -KILL $!
wait $! 2>/dev/null || true
[[ -n $(ls -A work) ]] || complain 'a killed run left nothing'
"$program" sample --sampler white -n 1e8 -o work/living.npy 2>err &
living=$!
until compgen -G "work/.pointspec-*-$living-*.tmp" >/dev/null; do sleep 0.05; done
"$program" sample --sampler white -n 10 -o work/a.txt --quiet
[[ $(find work -name '.pointspec-*.tmp' | wc -l) == 1 ]] ||
    complain "temporary files: $(ls -A work)"
[[ -e $(compgen -G "work/.pointspec-*-$living-*.tmp") ]] || complain "a living run lost its file"
kill -TERM $living
wait $living || true
[[ $(ls -A work) == a.txt ]] || complain "at the end: $(ls -A work)"
rm -rf work/*

# ---- inside a driver that compiles, in the first second
export POCL_CACHE_DIR=$scratch/pocl
mkdir "$POCL_CACHE_DIR"
ends_in_time INT 0.4 power --sampler white -n 4096 -k 64 -m 1000 -o work/a.csv
ends_in_time TERM 0.4 angular --sampler white-sphere -n 4096 -l 64 -m 1000 -o work/a.csv

exit $bad

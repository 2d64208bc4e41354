#!/usr/bin/env bash
# cli_signals.sh PROGRAM: whatever it is doing, a signal ends the program within a second: exit 130, one sentence, no
# temporary files, no children.
set -euo pipefail
program=$(realpath "$1")
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

# The promise is 1 s. Machines with more to do than they have processors need longer for anything: what is
# measured is what is above the time that such a machine takes to end a process that only sleeps.
limit=1.5
now() { date +%s.%N; }
exceeds() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }'; }
minus() { awk -v a="$1" -v b="$2" 'BEGIN { print a - b }'; }

catches_term() { # PROCESS
    local term=0x4000 # bit 14 is SIGTERM, 15
    local caught
    caught=$(awk '/^SigCgt/ { print $2 }' "/proc/$1/status" 2>/dev/null) || return 0
    (((16#${caught:-0} & term) != 0))
}

# The seconds that a process needs to end when nothing keeps it.
slowness() {
    local begin
    sleep 100 &
    begin=$(now)
    kill -TERM $!
    wait $! 2>/dev/null || true
    minus "$(now)" "$begin"
}

# interrupts SIGNAL SECONDS ARGS...: the signal comes so long after the start. Files belong into work/.
interrupts() {
    local signal=$1 moment=$2 code=0 pid begin took left
    shift 2
    # Background jobs ignore SIGINT, which the program respects; env takes that back.
    env --default-signal=INT "$program" "$@" >/dev/null 2>err </dev/null &
    pid=$!
    until [[ ! -e /proc/$pid ]] || catches_term $pid; do sleep 0.02; done
    sleep "$moment"
    begin=$(now)
    kill -s "$signal" $pid 2>/dev/null || complain "ended before $moment s: $*: $(<err)"
    wait $pid || code=$?
    took=$(minus "$(now)" "$begin")
    if exceeds "$took" $limit && exceeds "$(minus "$took" "$(slowness)")" $limit; then
        complain "$took s after $signal: $*"
    fi
    [[ -z ${VERBOSE-} ]] || printf '%-5s %6.3f s  %s: %s\n' "$signal" "$took" "$*" "$(<err)"
    [[ $code == 130 ]] || complain "$signal: exit $code: $*: $(<err)"
    # A driver whose compiler was interrupted may have its own words about that.
    [[ $(grep -c '^pointspec.*: interrupted' err) == 1 && $(grep -c '^pointspec' err) == 1 ]] ||
        complain "$signal: not one sentence: $*: $(<err)"
    left=$(find work tmp -mindepth 1)
    [[ -z $left ]] || complain "$signal leaves $left: $*"
    rm -rf work/* tmp/*
}

# ---- what takes long, of every command
hemisphere=(--sampler fibonacci-hemisphere --brdf diffuse --smoothness 1.5)
interrupts INT 1 quadrature -n 1e6 "${hemisphere[@]}" -l 8 --weights optimal -o work/a.csv
interrupts TERM 1.5 quadrature -n 15000 "${hemisphere[@]}" -l 8 --weights optimal -o work/a.csv
interrupts INT 0.5 quadrature -n 1e6 "${hemisphere[@]}" -l 8 -o work/a.csv
interrupts HUP 1 pairs --sampler white-sphere -n 20000 -m 100 -l 3000 -o work/a.csv
interrupts INT 1 power --sampler white -d 1 -n 1024 -k 268435456 -o work/a.csv
interrupts INT 0.3 power --sampler white -d 1 -n 1024 -k 268435456 -o work/a.csv
interrupts TERM 1 power --sampler white -d 6 -n 4096 -k 60 --per-ring 100000 -o work/a.csv
interrupts INT 1 sample --sampler white -n 3e8 -o work/a.npy
interrupts TERM 1 sample --sampler sobol -n 1e8 -o work/a.txt
interrupts INT 0.7 power --sampler white -n 65536 -k 300 --engine host_direct -o work/a.csv
interrupts HUP 0.7 angular --sampler white-sphere -n 1e6 -m 100 -l 500 -o work/a.csv
interrupts INT 0.3 truncation --brdf glossy:n=30 --harmonics hemispherical -l 400 -o work/a.csv
interrupts TERM 1 stress
interrupts INT 1 bench
mkfifo endless
interrupts INT 0.3 convert --input-format rps /dev/zero -o work/a.npy
interrupts TERM 0.3 power --input-format csv endless -k 8 -o work/a.csv # nobody writes to the pipe

# ---- what takes long has a name on a terminal, and is never "0 of something at 0/s"
shows() { # PATTERN SECONDS ARGS...
    local pattern=$1 seconds=$2
    shift 2
    script -qec "timeout -s INT $seconds $program $*" /dev/null </dev/null >seen || true
    tr '\r' '\n' <seen | grep -qE "$pattern" || complain "no \"$pattern\": $*: $(tr '\r' '\n' <seen | tail -n 3)"
    if tr '\r' '\n' <seen | grep -qE '(^|[^0-9.])0 (of [0-9]+ )?[a-z]+, 0/s'; then complain "no progress: $*"; fi
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
    interrupts TERM 1 power --sampler white -n 64 -k 4 -o work.csv --plot work/a.png
lives() { [[ -e /proc/$1/stat && $(awk '{ print $3 }' "/proc/$1/stat" 2>/dev/null) != [ZX] ]]; }
[[ -s child ]] || complain "gnuplot was not started"
for _ in 1 2 3 4 5 6 7 8 9 10; do lives "$(<child)" && sleep 0.2; done
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
interrupts INT 0.4 power --sampler white -n 4096 -k 64 -m 1000 -o work/a.csv
interrupts TERM 0.4 angular --sampler white-sphere -n 4096 -l 64 -m 1000 -o work/a.csv

exit $bad

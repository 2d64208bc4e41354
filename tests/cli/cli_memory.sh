#!/usr/bin/env bash
# cli_memory.sh PROGRAM: limits of memory that are typed or found, input that does not end, records that keep the limit.
set -uo pipefail
program=$1
scratch=$(mktemp -d)
group=
trap 'rm -rf "$scratch"; [[ -z $group ]] || rmdir "$group"' EXIT
cd "$scratch" || exit 1
export POINTSPEC_CACHE_DIR=$scratch/cache
unset POINTSPEC_MEMORY

bad=0
complain() {
    printf 'cli_memory: %s\n' "$*" >&2
    bad=1
}
# Exit status and one sentence; the rest is the command.
says() { # STATUS PATTERN COMMAND...
    local wanted=$1 pattern=$2 status
    shift 2
    "$@" >out 2>err
    status=$?
    ((status == wanted)) || complain "$*: exit $status, not $wanted: $(<err)"
    [[ $wanted == 0 ]] || (($(wc -l <err) == 1)) || complain "$*: not one line: $(<err)"
    grep -qE -e "$pattern" "$([[ $wanted == 0 ]] && echo out || echo err)" ||
        complain "$*: \"$pattern\" is not in: $(cat out err)"
}

# ---- input that does not end -----------------------------------------------------------------

limit='set 1 takes more than 20M, the limit of --memory, after [0-9]+ points and goes on$'
says 1 "^pointspec power: /dev/zero: $limit" \
    "$program" power --input-format rps -k 3 --memory 20M /dev/zero
# shellcheck disable=SC2016 # the words are of the inner shells
says 1 "^pointspec power: standard input: $limit" \
    bash -c 'yes 0.5 0.5 | "$1" power -k 3 --memory 20M -' _ "$program"
# shellcheck disable=SC2016
says 1 "^pointspec angular: standard input: $limit" \
    bash -c 'yes 0 0 1 | "$1" angular -l 3 --memory 20M -' _ "$program"
# shellcheck disable=SC2016
says 1 "^pointspec quadrature: standard input: $limit" \
    bash -c 'yes 0 0 1 | "$1" quadrature --brdf diffuse --memory 20M -' _ "$program"
# shellcheck disable=SC2016
says 1 "^pointspec pairs: standard input: $limit" \
    bash -c 'yes 0 0 1 | gzip -1 | "$1" pairs -l 3 --memory 20M -' _ "$program"
# An array in C order may promise what it likes; it is not believed.
# shellcheck disable=SC2016
says 1 "^pointspec power: standard input: $limit" bash -c '
    { printf "\x93NUMPY\x01\x00\x76\x00%-117s\n" \
        "{'\''descr'\'': '\''<f8'\'', '\''fortran_order'\'': False, '\''shape'\'': (1000000000000, 2), }"
      cat /dev/zero; } | "$1" power -k 3 --memory 20M -' _ "$program"
# shellcheck disable=SC2016
says 1 '^pointspec power: /dev/fd/[0-9]+ takes more than 20M, the limit of --memory, after [0-9]+ numbers' \
    bash -c '"$1" power --sampler white --memory 20M --frequencies <(yes 1 2)' _ "$program"
# shellcheck disable=SC2016
says 2 '/dev/fd/[0-9]+ holds more than [0-9]+ weights, and a set has 100 points$' \
    bash -c '"$1" power --sampler white -n 100 --weights <(yes 1)' _ "$program"
# shellcheck disable=SC2016
says 2 '/dev/fd/[0-9]+ holds more than [0-9]+ numbers, more than a table of two columns may have$' \
    bash -c '"$1" truncation --brdf "zonal:file=/dev/fd/63" 63< <(yes 1 2)' _ "$program"

# Nobody typed a limit, and the process may have 2 GB: half of what is left, and the sentence says which limit that is.
if (ulimit -v 1000000) 2>/dev/null; then
    # shellcheck disable=SC2016
    says 1 'set 1 takes more than [0-9.]+[MG], half of what ulimit -v leaves, .*; --memory SIZE would allow more$' \
        bash -c 'ulimit -v 1000000; "$1" power --input-format rps -k 3 /dev/zero' _ "$program"
    # shellcheck disable=SC2016
    says 1 '500000000 points in 2 dimensions take 7.451G of memory, but ulimit -v leaves' \
        bash -c 'ulimit -v 1000000; "$1" sample --sampler white -n 5e8 -o points.npy' _ "$program"
    # shellcheck disable=SC2016
    says 1 'needs 7.[0-9]+G of memory, but ulimit -v leaves .* kept for the OpenCL driver' \
        bash -c 'ulimit -v 1000000; "$1" power --sampler white -n 1000000 -k 5000' _ "$program"
fi

# An image of 256 million pixels, which two questions share, in 1 GB; nothing varies of one that is black.
printf 'Pf 16000 16000 -1\n' >black.pfm
if (ulimit -v 1000000) 2>/dev/null && truncate -s $((18 + 4 * 16000 * 16000)) black.pfm; then
    # shellcheck disable=SC2016
    says 0 '^8,0,0,0,0,0,0,,0$' bash -c 'ulimit -v 1000000; "$1" variance --engine host_direct --sampler white \
        -n 4,8 -m 2 -k 4 --integrand map:file=black.pfm' _ "$program"
    says 1 '^pointspec variance: black.pfm: 16000 x 16000 pixels take 732.4M of memory, above 700M, the limit of --memory$' \
        "$program" variance --sampler white -n 4 -m 2 -k 4 --memory 700M --integrand map:file=black.pfm
fi
rm -f black.pfm

# ---- limits of data and stacks: PoCL aborts with the one, and nothing is safe with the other ----
# shellcheck disable=SC2016
if (ulimit -d 100000) 2>/dev/null; then
    says 1 'an OpenCL driver takes about [0-9]+ bytes of data, which the limit of 102400000 bytes \(ulimit -d\) does not leave' \
        bash -c 'ulimit -d 100000; exec "$1" power --sampler white -n 1000 -k 8' _ "$program"
    says 0 '^8,' bash -c 'ulimit -d 100000; exec "$1" power --sampler white -n 1000 -k 8 --engine host_direct' _ "$program"
fi
# shellcheck disable=SC2016
if (ulimit -s 64) 2>/dev/null; then
    for command in 'power --sampler white -n 1000 -k 8' 'sample --sampler white' devices; do
        says 1 'the limit of stacks, 64 KiB \(ulimit -s\), is below the 256 KiB that this program and its threads need$' \
            bash -c 'ulimit -s 64; exec "$1" $2' _ "$program" "$command"
    done
    says 0 '^8,' bash -c 'ulimit -s 256; exec "$1" power --sampler white -n 1000 -k 8' _ "$program"
fi
# shellcheck disable=SC2016
if (ulimit -v 300000) 2>/dev/null; then # the driver starts, and leaves next to nothing
    code=0
    bash -c 'ulimit -v 300000; exec "$1" power --sampler white -n 1000 -k 8' _ "$program" >out 2>err || code=$?
    ((code == 1)) && grep -qE 'ulimit -v.*host_direct' err || ((code == 0)) || complain "ulimit -v 300000: $code, $(<err)"
    limit=$(sed -nE 's/.*; ulimit -v ([0-9]+) would do.*/\1/p' err)
    if [[ -n $limit ]]; then
        says 0 '^8,' bash -c 'ulimit -v $2; exec "$1" power --sampler white -n 1000 -k 8' _ "$program" "$limit"
    fi
fi

# ---- limits that are typed --------------------------------------------------------------------

says 1 '1000000 points in 2 dimensions take 15.26M of memory, above the limit of 1M$' \
    "$program" sample --sampler white -n 1e6 --memory 1M
large=(--sampler ccvt:M=1024 -n 4096)
says 1 'sample: 4096 points in 2 dimensions take 224.3M of memory with what makes a set of them, above the limit of 100M$' \
    "$program" sample "${large[@]}" --memory 100M
makes_too_much() { # COMMAND...
    says 1 ': sampler ccvt: a set of 4096 points takes 224.3M of memory while it is made, above the limit of 100M$' \
        env POINTSPEC_MEMORY=100M "$program" "$@" "${large[@]}" -k 4
}
makes_too_much power
makes_too_much plan power
makes_too_much variance --integrand disk
says 0 '^host,chosen,[0-9.e+-]*,235225088,' "$program" plan sample "${large[@]}"
says 0 'torus_nufft:single,infeasible,.*needs 2.38e.08 bytes of memory, above the limit of 2.36e.08' "$program" plan power "${large[@]}" -k 100 --memory 225M
says 2 'power: --memory: "4X" is not a size above 0, such as 400M, 1.5G or 2e9$' \
    "$program" power --sampler white --memory 4X
says 2 '^pointspec power: POINTSPEC_MEMORY: "much" is not a size' \
    env POINTSPEC_MEMORY=much "$program" power --sampler white
says 0 'UTK|^[01]\.' env POINTSPEC_MEMORY=1G "$program" sample --sampler white -n 2
says 0 '^# command: pointspec power --memory 1G --sampler white -n 10 -k 2$' \
    env POINTSPEC_MEMORY=1G "$program" power --sampler white -n 10 -k 2
says 0 '^# command: pointspec power --sampler white -n 10 -k 2 --memory 2G$' \
    env POINTSPEC_MEMORY=1G "$program" power --sampler white -n 10 -k 2 --memory 2G
for command in power angular pairs quadrature check sample convert run plan; do
    [[ $("$program" "$command" --help) == *'--memory SIZE'* ]] || complain "$command lacks --memory"
done

# A limit that was typed chooses another engine, which the table says.
engine_of() { sed -n 's/^# engine: //p' "$1"; }
has_limit() { # RECORD NAME LIMIT
    sed -n "/\"name\": \"$2\"/,/}/p" "$1" | grep -q "\"memory\": \[\"$3\"\]"
}
job=(power --sampler white -n 300000 -k 100 --no-self-check)
"$program" "${job[@]}" >free 2>err || complain "${job[*]}: $(<err)"
"$program" "${job[@]}" --memory 32M >typed 2>err || complain "32M: $(<err)"
[[ $(engine_of free) == *torus_nufft* && $(engine_of typed) == *torus_direct* ]] ||
    complain "engines: $(engine_of free), $(engine_of typed)"

# ---- scenes and records -----------------------------------------------------------------------

cat >scene.yaml <<'END'
scene: 1
results:
  - {result: power, name: own, sampler: white, points: 1000, max-frequency: 8, memory: 300M}
  - {result: power, name: other, sampler: white, points: 1000, max-frequency: 8}
  - {result: truncation, brdf: diffuse}
END
POINTSPEC_MEMORY=200M "$program" run scene.yaml -o limited >out 2>err || complain "run: $(<err)"
"$program" run scene.yaml -o unlimited --cache 0 >out 2>err || complain "run: $(<err)"
has_limit limited/record.json own 300M || complain "the key of the scene is lost"
has_limit limited/record.json other 209715200 ||
    complain "POINTSPEC_MEMORY is not in the record"
has_limit unlimited/record.json other '.*' && complain "a limit that nobody typed"
# What is typed now is not for a record, and what is free never was.
for folder in limited unlimited; do
    POINTSPEC_MEMORY=1 "$program" run "$folder/record.json" -o again --cache 0 >out 2>err ||
        complain "$folder repeated under another limit: $(<err)"
    diff <(sed -n '/"digests"/,$p' "$folder/record.json") <(sed -n '/"digests"/,$p' again/record.json) >&2 ||
        complain "$folder: other digests"
    (ulimit -v 4000000; "$program" run "$folder/record.json" -o again --cache 0) >out 2>err ||
        complain "$folder repeated with less memory: $(<err)"
done
says 1 'scene.yaml:4: other: .* above the limit of 1$' "$program" run scene.yaml --memory 1 -o refused

# ---- a memory cgroup, where one can be made ----------------------------------------------------

make_group() { # LIMIT
    local own
    own=$(sed -n 's/^[0-9]*:memory://p' /proc/self/cgroup)
    for group in "/sys/fs/cgroup/memory$own/pointspec-test-$$" \
        "/sys/fs/cgroup$(sed -n 's/^0:://p' /proc/self/cgroup)/pointspec-test-$$"; do
        [[ -w ${group%/*}/cgroup.procs ]] || continue
        mkdir "$group" 2>/dev/null || continue
        { echo "$1" >"$group/memory.limit_in_bytes" || echo "$1" >"$group/memory.max"; } 2>/dev/null &&
            (echo "$BASHPID" >"$group/cgroup.procs") 2>/dev/null && return 0
        rmdir "$group"
    done
    group=
    return 1
}
inside() { # COMMAND...
    # shellcheck disable=SC2016
    bash -c 'echo $$ >"$1/cgroup.procs"; shift; exec "$@"' _ "$group" "$@"
}
if make_group 419430400; then
    # Was killed (137): 484 MB of what the machine had were chosen.
    big=(power --sampler white -n 1000000 -k 1000 --no-self-check)
    says 1 'torus_nufft .* needs [0-9.]+M of memory, but /sys/fs/cgroup.* leaves [0-9.]+M, and 128M of them' \
        inside "$program" "${big[@]}"
    says 1 "half of what $group.* leaves" inside "$program" power --input-format rps -k 3 /dev/zero
    # A repeat with little memory has the same engine and the same bits.
    inside "$program" "${job[@]}" >less 2>err || complain "in a cgroup: $(<err)"
    diff free less >&2 || complain "less memory, other results"
    inside "$program" run limited/record.json -o again --cache 0 >out 2>err ||
        complain "a record in a cgroup: $(<err)"
else
    echo "cli_memory: no memory cgroup can be made here; that part is left out"
fi
exit $bad

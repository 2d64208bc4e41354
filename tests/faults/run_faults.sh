#!/usr/bin/env bash
# run_faults.sh PROGRAM [--sample N [--seed NUMBER]] [--only NAME[,NAME...]] [--fault NAME:CLASS:NUMBER[+]] [--table]:
# makes the allocations, file calls and OpenCL calls of every command line of commands.txt fail one by one, and judges
# what the program does then (see docs/developer/reliability.md). PROGRAM is pointspec_faults. --sample takes about N
# faults, evenly, beginning where --seed says; --fault takes one; --table prints the table of
# docs/developer/reliability.md.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
program=$(realpath "$1")
shift
sample=0 seed='' only='' fault='' wants_table=no
while (($#)); do
    case $1 in
    --sample) sample=$2 && shift ;;
    --seed) seed=$2 && shift ;;
    --only) only=$2 && shift ;;
    --fault) fault=$2 only=${2%%:*} && shift ;;
    --table) wants_table=yes ;;
    *) sed -n '2,6s/^# //p' "$0" >&2 && exit 2 ;;
    esac
    shift
done
# All calls after the first that fails, too, for every 5th of them: what tidies up fails as well.
every_lasting=5
scratch=$(mktemp -d)
# Nobody's figures of the device.
export POINTSPEC_CACHE_DIR=$scratch/no-cache
trap 'rm -rf "$scratch"' EXIT
export FAULTS_PROGRAM=$program FAULTS_SCRATCH=$scratch
# The program's own table of what is outstanding tells leaks; the sanitizer's tracer trips over PoCL.
export ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=0:allocator_may_return_null=1
unset POINTSPEC_FAULT POINTSPEC_FAULT_REPORT POINTSPEC_DEVICE POINTSPEC_KERNEL_DIR

# Whatever our code calls is wrapped or listed as not worth it.
check_symbols() {
    local unknown folder
    folder=$(dirname "$program")
    unknown=$(xargs nm -u <"$folder/objects.txt" | awk '$1 == "U" { print $2 }' | sort -u |
        grep -vxFf "$folder/wrapped.txt" | grep -vxEf <(grep -v '^#' "$here/harmless.txt")) || return 0
    echo "run_faults: neither wrapped in tests/faults/wrap_*.c nor in tests/faults/harmless.txt:" "${unknown//$'\n'/ }" >&2
    return 1
}

# shellcheck source=tests/faults/inputs.sh
. "$here/inputs.sh"
# shellcheck source=tests/faults/same.sh
. "$here/same.sh"

# The run without faults: its outputs, its calls, and again, for both must be the same every time.
prepare_case() { # NAME STDIN [VARIABLE=VALUE...] WORD...
    local name=$1 case=$scratch/cases/$1 run=$scratch/run.0000000 stdin words round code
    read_line "$@"
    mkdir -p "$case"
    printf '%s\n' "${words[@]}" >"$case/words"
    echo "$stdin" >"$case/stdin"
    # Names that a sentence about a file may have: files without endings, since some lie beside others.
    { printf 'standard (in|out)put|temporary file|gnuplot|kernel source|/dev/null'
        printf '%s\n' "${words[@]}" | tr ',' '\n' | sed -nE 's/^([a-zA-Z_:]*[=<])?([a-z]*)\.[a-z]*$/|\2\\./p' | tr -d '\n'; } >"$case/things"
    for round in expected again; do
        mkdir "$run" "$run/tmp"
        cp -r "$scratch/initial" "$run/folder"
        code=0
        (cd "$run/folder" && TMPDIR=$run/tmp POINTSPEC_FAULT_REPORT=$case/$round.report \
            env "${words[@]}" <"$(<"$case/stdin")" >"$run/stdout" 2>"$case/$round.stderr") || code=$?
        # 3: a verdict, with all output
        [[ $code == 0 || $code == 3 ]] ||
            { echo "run_faults: $name fails without faults: $(<"$case/$round.stderr")" >&2; return 1; }
        rmdir "$run/tmp"
        mv "$run" "$case/$round"
        echo $code >"$case/$round.code"
    done
    if grep -q '^leak\|^unknown' "$case/expected.report" || ! diff -r "${same[@]}" "$case/expected" "$case/again" ||
        ! diff "$case/expected.report" "$case/again.report" || ! diff "$case/expected.code" "$case/again.code"; then
        echo "run_faults: $name leaks, or two runs differ:" "$(<"$case/expected.report")" >&2
        return 1
    fi
    awk -v name="$name" -v every=$every_lasting '/^calls/ {
        for (i = 1; i <= $3; i++) {
            print name ":" $2 ":" i
            if (i % every == 1) print name ":" $2 ":" i "+"
        } }' "$case/expected.report" >>"$scratch/faults"
}

prepare_cases() {
    local name words
    while read -r -a words; do
        name=${words[0]-#}
        [[ $name == \#* || (-n $only && ,$only, != *,$name,*) ]] || prepare_case "${words[@]}" || return 1
    done <"$here/commands.txt"
}

# Those that the program lived with must be known; a row of tolerated.txt that no run needed is no error,
# for a sample meets few.
check_tolerated() {
    awk 'NR == FNR { if ($1 !~ /^#/) known[++num] = "^(" $1 ") (" $2 ")$"; next }
        function is_known(pair,   i) {
            for (i = 1; i <= num; i++) if (pair ~ known[i]) return 1
            return 0
        }
        $3 == "tolerated" && $5 !~ /[+]/ && !is_known($1 " " $4) {
            $3 = "FAILED"; $6 = "tolerated, but not in tolerated.txt" }
        { print }' "$here/tolerated.txt" "$scratch/verdicts"
}

print_table() {
    awk '{ count[$1, $2]++; verdicts[$1, $3]++; if (!($1 in seen)) { seen[$1]; name[++num] = $1 } }
        function row(title, memory, file, opencl, tolerated, refused, failed) {
            printf "%-16s %7s %7s %7s %10s %8s %7s\n", title, memory, file, opencl, tolerated, refused, failed
        }
        END {
            row("command line", "memory", "file", "opencl", "tolerated", "refused", "failed")
            for (i = 1; i <= num; i++) {
                n = name[i]
                row(n, m = count[n, "memory"] + 0, f = count[n, "file"] + 0, o = count[n, "opencl"] + 0,
                    t = verdicts[n, "tolerated"] + 0, r = verdicts[n, "refused"] + 0,
                    b = verdicts[n, "FAILED"] + 0)
                sm += m; sf += f; so += o; st += t; sr += r; sb += b
            }
            row("all", sm, sf, so, st, sr, sb)
        }' "$scratch/judged"
}

check_symbols
make_inputs
prepare_cases
[[ -z $fault ]] || echo "$fault" >"$scratch/faults"
total=$(wc -l <"$scratch/faults")
step=$((sample > 0 && total > sample ? total / sample : 1))
# Neighbours go to different workers, which take 16 at a time.
awk -v step=$step -v first=$((${seed:-$((step / 2))} % step)) 'NR % step == first' "$scratch/faults" |
    xargs -P "${JOBS:-$(nproc)}" -n 16 bash "$here/judge_faults.sh" >"$scratch/unsorted"
sort -s -k 1,1 "$scratch/unsorted" | awk -v list="$here/commands.txt" '{ line[$1] = line[$1] $0 "\n" }
    END { while ((getline row < list) > 0) { split(row, word); printf "%s", line[word[1]] } }' >"$scratch/verdicts"
check_tolerated >"$scratch/judged"
[[ -z ${FAULTS_VERDICTS-} ]] || cp "$scratch/judged" "$FAULTS_VERDICTS"
grep ' FAILED ' "$scratch/judged" | head -n 200 >&2 || true
awk '$3 == "FAILED" && num++ < 20 { sub(/:$/, "", $5); print "again: ./dev faults --fault " $1 ":" $2 ":" $5 }' \
    "$scratch/judged" >&2
[[ $wants_table == no ]] || print_table
injected=$(wc -l <"$scratch/judged") failures=$(grep -c ' FAILED ' "$scratch/judged" || true)
echo "run_faults: $injected of $total faults, $failures failures, $SECONDS s" >&2
[[ $failures == 0 && $injected -gt 0 ]]

#!/usr/bin/env bash
# fuzz.sh PROGRAM [--seed NUMBER] SECONDS [TARGET...]: runs libFuzzer on each target, or on those named, for SECONDS (0:
# an hour in total), FUZZ_JOBS of them at a time (1). With --seed a third of the targets, those that NUMBER chooses, have
# SECONDS and the others a tenth, and NUMBER is libFuzzer's seed, too. Prints a table, also kept as table.txt; everything
# goes to fuzz-output/: TARGET/corpus grows from run to run, TARGET/log is what libFuzzer said, and
# TARGET/crash-* (leak-, oom-, timeout-) are inputs that broke something. Those make it exit with 1.
set -euo pipefail
program=$(realpath "$1")
seed=''
[[ $2 != --seed ]] || { seed=$3 && shift 2; }
seconds=$2
shift 2
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
tests=$PWD/tests/fuzz
output=$PWD/fuzz-output
jobs=${FUZZ_JOBS:-1}

declare -A dictionary=()
known=()
while read -r name file; do
    known+=("$name")
    dictionary[$name]=$file
done < <("$program" --list)
(($#)) || set -- "${known[@]}"
for target in "$@"; do
    [[ -n ${dictionary[$target]+known} ]] || {
        echo "fuzz: no target $target; there are ${known[*]}" >&2
        exit 2
    }
done
[[ $seconds =~ ^[0-9]+$ ]] || { echo "fuzz: $seconds is not a number of seconds" >&2; exit 2; }
((seconds > 0)) || seconds=$((3600 * jobs / $#))

# Readers allocate a few MiB, and 64 MiB for arrays in Fortran order: more is a header believed. The
# small quarantine of freed memory keeps AddressSanitizer from mapping these anew for every input.
export ASAN_OPTIONS=quarantine_size_mb=16:${ASAN_OPTIONS-}
export UBSAN_OPTIONS=print_stacktrace=1:${UBSAN_OPTIONS-}
limits=(-malloc_limit_mb=100 -rss_limit_mb=1024 -timeout=10 -max_len=8192)

run_target() { # TARGET SECONDS
    local folder=$output/$1 options=(-seed="${seed:-0}") # 0: another one every time
    [[ ${dictionary[$1]} == - ]] || options=(-dict="$tests/${dictionary[$1]}")
    mkdir -p "$folder/corpus"
    rm -f "$folder"/{crash,leak,oom,timeout,slow-unit}-*
    "$program" "--target=$1" "${limits[@]}" "${options[@]}" -max_total_time="$2" \
        -artifact_prefix="$folder/" -print_final_stats=1 "$folder/corpus" "$tests/corpus/$1" \
        >"$folder/log" 2>&1 || true # the files tell
}

find_crashes() { # TARGET
    find "$output/$1" -maxdepth 1 \( -name 'crash-*' -o -name 'leak-*' -o -name 'oom-*' \
        -o -name 'timeout-*' \) | sort
}

# A row of the table from libFuzzer's lines "#N ... cov: C ft: F corp: N/SIZE ..." and "Done N runs".
show_row() { # TARGET
    local crashes
    crashes=$(find_crashes "$1" | wc -l)
    awk -v target="$1" -v crashes="$crashes" '
        { for (i = 1; i < NF; i++) {
              if ($i == "cov:") edges = $(i + 1)
              if ($i == "corp:") { split($(i + 1), parts, "/"); inputs = parts[1] } } }
        /^stat::number_of_executed_units:/ { runs = $2 }
        /^Done [0-9]+ runs in/ { seconds = $5 }
        END { printf "%-12s %8s %12s %7s %7s %8d\n", target, seconds == "" ? "-" : seconds,
                  runs == "" ? "-" : runs, inputs, edges, crashes }' "$output/$1/log"
}

show_table() {
    printf '%-12s %8s %12s %7s %7s %8s\n' target seconds executions inputs edges crashes
    for target in "$@"; do show_row "$target"; done
}

mkdir -p "$output"
# Another third for every number modulo 3.
every=3 shorter=10 number=${seed:-0}
for target in "$@"; do
    given=$seconds
    [[ -z $seed ]] || ((number++ % every == 0)) || given=$(((seconds + shorter - 1) / shorter))
    while (($(jobs -rp | wc -l) >= jobs)); do wait -n; done
    echo "fuzz: $target, $given s" >&2
    run_target "$target" "$given" &
done
wait
show_table "$@" | tee "$output/table.txt"

failed=0
for target in "$@"; do
    if ! grep -q '^stat::number_of_executed_units' "$output/$target/log"; then
        echo "fuzz: $target did not run to its end; see $output/$target/log" >&2
        failed=1
    fi
    while IFS= read -r crash; do
        echo "fuzz: $target broke on $crash; look with build/asan/tests/fuzz/fuzz_replay $target FILE" >&2
        failed=1
    done < <(find_crashes "$target")
done
exit $failed

#!/usr/bin/env bash
# cli_terminal.sh PROGRAM: tables on a terminal are for people, and those in files and pipes for programs.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" power "$1"
words=(power --sampler jittered -n 64 -m 4 -k 5 --engine host_direct --quiet) # a progress line would be on the terminal, too

# The same words on a terminal of its own, without its carriage returns.
on_terminal() {
    local line
    printf -v line ' %q' "$program" "$@"
    script -qec "$line" /dev/null </dev/null 2>err | tr -d '\r'
}

if ! command -v script >/dev/null; then
    echo "cli_terminal: no script(1): skipped"
    exit 0
fi
"$program" "${words[@]}" >piped.csv
"$program" "${words[@]}" --format text >piped.txt
[[ $(grep -v '^#' piped.csv | head -1) == bin,frequency,* ]] || complain "a pipe has no CSV: $(<piped.csv)"
COLUMNS=200 on_terminal "${words[@]}" --verbose >shown 2>&1
cmp -s <(sed -n '/^pointspec_version/,$p' shown | grep -v '^command') <(grep -v '^command' piped.txt) ||
    complain "a wide terminal shows other than --format text: $(diff shown piped.txt)"

# four lines of the header, those that are seen first, and how many others there are
on_terminal "${words[@]}" >shown
[[ $(sed '/^$/,$d' shown | cut -d: -f1 | tr '\n' ' ') == 'sampler points realizations self_check ' ]] || complain "other lines: $(<shown)"
left=$(($(sed '/^$/,$d' piped.txt | wc -l) - 4))
[[ $(tail -1 shown) == "$left more lines of the header: --verbose" ]] || complain "not $left more lines: $(tail -1 shown)"
on_terminal power --sampler jittered -n 64,256 -m 1 -k 2 --engine host_direct --quiet >shown
[[ $(head -4 shown) == $'standard_error: none: one realization\nsampler: jittered\nrealizations: 1\nself_check: '* ]] || complain "two N: $(<shown)"
on_terminal quadrature --brdf diffuse --sampler white-hemisphere --sampler fibonacci-hemisphere -n 64 -l 2 --engine host_direct --quiet >shown
[[ $(head -1 shown) =~ ^'worst_case_error: '[0-9.]+'; '[0-9.]+$ && $(head -4 shown) == *$'\nbrdf: diffuse\npoints: 64'* ]] || complain "two samplers: $(<shown)"
on_terminal power --sampler jittered -n 1024 -m 8 -k 40 --fit auto --quiet >shown
[[ $(sed '/^$/,$d' shown | wc -l) == 4 && $(cut -d: -f1 shown | head -4 | grep -c '^[a-z]') == 3 && $(head -1 shown) == 'convergence: '* ]] || complain "sentences are not cut to four lines: $(<shown)"
on_terminal truncation --brdf glossy:n=30 -l 4 --verbose >shown
[[ $(head -1 shown) == pointspec_version* && $(grep -c more shown) == 0 ]] || complain "truncation --verbose: $(<shown)"

# points are points, also there
"$program" sample --sampler jittered -n 4 --quiet >points.txt
on_terminal sample --sampler jittered -n 4 --quiet >shown
cmp -s shown points.txt || complain "sample: $(<shown)"
on_terminal convert points.txt --quiet >shown
[[ $(grep -vc '^#' shown) == 4 ]] || complain "convert: $(<shown)"
"$program" sample --sampler jittered -n 64 -m 6 --quiet -o one.txt
on_terminal power one.txt points.txt -k 4 --engine host_direct --quiet >shown
grep -q '^input: 2 files, 7 realizations, one average$' shown || complain "files: $(<shown)"

# no line is wider than the terminal, and no column and no number is lost
for width in 40 50 64 80 100 130; do
    COLUMNS=$width on_terminal "${words[@]}" -m 8 --fit auto >shown
    (($(wc -L <shown) <= width)) || complain "wider than $width: $(<shown)"
    ! grep -q ' $' shown || complain "blanks at ends of lines: $(cat -A shown)"
    numbers=$(awk '$1 == 3 { num += NF - (seen++ > 0) } END { print num }' shown)
    [[ $numbers == 10 ]] || complain "at $width a row has $numbers numbers, not 10: $(<shown)"
done
COLUMNS=60 on_terminal plan power --sampler jittered -n 64 -k 5 >shown
[[ $(wc -L <shown) -le 60 && $(grep -c '^    cheapest within the tolerance$' shown) == 1 ]] || complain "reasons of a plan: $(<shown)"
on_terminal "${words[@]}" --format csv >shown
cmp -s <(grep -v '^# command' shown) <(grep -v '^# command' piped.csv) || complain "--format csv does not win on a terminal"
on_terminal "${words[@]}" -o file.csv >shown
[[ ! -s shown ]] || complain "a table for a file is shown: $(<shown)"
cmp -s <(grep -v '^# command' file.csv) <(grep -v '^# command' piped.csv) || complain "a file is written otherwise on a terminal"

# columns end at one place: numbers to the right, six digits, no blanks at ends of lines
sed '1,/^$/d' piped.txt >rows
[[ $(wc -l <rows) == 6 && $(awk '{ print length }' rows | sort -u | wc -l) == 1 ]] || complain "columns are not aligned: $(<rows)"
! grep -q ' $' piped.txt || complain "blanks at the end of a line"
for column in 2 5; do
    [[ $(awk -v c=$column 'NR > 1 { printf "%s ", $c }' rows) == "$(grep -v '^#' piped.csv | awk -F, -v c=$column 'NR > 1 { printf "%.6g ", $c }')" ]] ||
        complain "column $column has other numbers"
done

# units, blocks, and what is missing
COLUMNS=200 on_terminal plan "${words[@]}" --verbose >shown
grep -qE '^host_direct:extended +chosen +[0-9.]+ (ms|s) +[0-9.]+ (B|kB) ' shown || complain "no units in a plan: $(<shown)"
! grep -qE '^phase: .*([0-9]e[+-]?[0-9]+ s;|[0-9] bytes)' shown || complain "phases have other units: $(grep ^phase shown)"
grep -qE '^phase: .*; [0-9.]+ (ns|us|ms);' shown || complain "phases have no small units: $(grep ^phase shown)"
grep -qE '^seconds: [0-9.]+ m?s$' shown || complain "no unit of all seconds: $(grep '^seconds' shown)"
COLUMNS=70 on_terminal devices >shown
[[ $(wc -L <shown) -le 70 && $(head -1 shown) == pointspec_version* ]] || complain "devices: $(<shown)"
on_terminal devices >shown
[[ $(grep -cE '^name +[^ ]|^global_bytes +[0-9.]+ [GMT]B$' shown) == $((2 * $(grep -c '^index ' shown))) ]] || complain "devices are no blocks: $(<shown)"
"$program" power --sampler white -n 16 -k 2 --engine host_direct --format text >one.txt
[[ $(tail -1 one.txt | awk '{ print $6 }') == - ]] || complain "a missing number is not shown: $(tail -1 one.txt)"
runs 2 "${words[@]:1}" -o out.txt
says 'none of .csv, .json, .jsonl, .npy and .npz'
runs 0 "${words[@]:1}" --format text -o out.txt
cmp -s <(grep -v '^command' out.txt) <(grep -v '^command' piped.txt) || complain "--format text into a file differs"
finish

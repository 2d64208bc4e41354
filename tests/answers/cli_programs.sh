#!/usr/bin/env bash
# cli_programs.sh PROGRAM: programs that print points (exec:COMMAND) are read as files with the same points are, told what
# they are to make, tried twice, stopped, and run by scenes only where that is allowed. Skipped (77) without a device.
# shellcheck disable=SC2016 # programs have shells of their own
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" power "$1"
"$program" devices >out 2>err && grep -q '^[0-9]' out || exit 77
rows() {
    grep -v '^#' out
}
always=(--engine host_direct) # which starts in a few milliseconds instead of a tenth of a second

# one run for all realizations, and one for each: the rows of files with the same points
"$program" sample --sampler jittered -n 16 -m 5 -o all.txt
awk '/^#/ { r++; next } { print > ("mine-" r + 0 "-16.txt") }' all.txt
runs 0 all.txt -k 3
rows >expected
runs 0 --sampler 'exec:head -n 1000 all.txt; : {realizations}' -n 16 -m 5 -k 3
cmp <(rows) expected || complain "one run: $(<out)"
[[ $(key input_format) == 'of a program that prints the same again; utk-text' && $(key realizations) == 5 ]] || complain "one run: $(<out)"
runs 0 --sampler 'exec:cat mine-{realization}-{n}.txt' -n 16 -m 5 -k 3
cmp <(rows) expected || complain "five runs: $(<out)"
[[ $(key input) == '5 runs, 5 realizations, one average' ]] || complain "five runs: $(<out)"
runs 0 --sampler 'exec:cat mine-{realization}-16.txt' -m 3 -k 3 --full three.npy
runs 0 mine-0-16.txt mine-1-16.txt mine-2-16.txt -k 3 --full files.npy
cmp three.npy files.npy || complain 'three runs: other arrays'

# what is put into a command; other braces are the shell's
runs 0 --set told='exec:printf "%s\n" {n} {d} {seed} {realization} {realizations} {other} ${HOME:+{n}} >told.txt; head -n 1000 all.txt' -n 16 -m 5 -s 7 -k 2
[[ $(tr '\n' ' ' <told.txt) == '16 2 7 0 5 {other} 16 ' && $(key sampler) == told ]] || complain "told: $(<told.txt)"

# beside samplers, with several numbers of points; the same points in every run are one realization
printf '#!/bin/sh\nexec "%s" sample --sampler white -n "$1" -s "$2"\n' "$program" >mine.sh
chmod +x mine.sh
runs 0 --set mine='exec:./mine.sh {n} {realization}' --sampler white -n 4,8 -m 3 -k 2
[[ $(rows | cut -d, -f1,2 | uniq | tr '\n' ' ') == 'sampler,points mine,4 mine,8 white,4 white,8 ' ]] || complain "beside: $(<out)"
runs 0 --sampler 'exec:./mine.sh {n} 1; : {realization}' -n 8 -m 3 -k 2
[[ $(key realizations) == 1 && $(key standard_error) == 'none: one realization' && $(key input_format) == *'for realizations 0 and 1, so that one of 3 is taken;'* ]] || complain "alike: $(<out)"
runs 0 --sampler 'exec:echo $$ 1 | { read p q; echo .$p .5; }' -m 2 -k 2
[[ $(key input_format) == 'of a program that prints other points each time; utk-text' ]] || complain "other points: $(<out)"

# a file is no program, whatever its name is, also where programs are allowed
cp all.txt 'exec:touch ran.txt; cat all.txt'
runs 0 --set theirs='*all.txt' --sampler 'exec:./mine.sh {n} {realization}' -m 2 -k 2
[[ ! -e ran.txt && $(rows | cut -d, -f1 | uniq | tr '\n' ' ') == 'sampler theirs exec:./mine.sh {n} {realization} ' ]] || complain "a file: $(<out)"
rm exec:*

# other questions, which read sets twice
for question in 'measure --measures least_distance,peak_power -k 4' 'variance --integrand disk' 'angular --lift sphere -l 3'; do
    # shellcheck disable=SC2086 # words
    "$program" $question --set a='exec:./mine.sh {n} {realization}' -n 16 -m 8 >out 2>err || complain "$question: $(<err)"
    for r in 0 1 2 3 4 5 6 7; do ./mine.sh 16 $r >"set$r.txt"; done
    # shellcheck disable=SC2086
    "$program" $question --set a='set*.txt' >again 2>err || complain "$question: $(<err)"
    cmp <(rows | cut -d, -f2-) <(grep -v '^#' again | cut -d, -f2-) || complain "$question: other rows than of files"
done

# a page, and scenes, which somebody else may have written
"$program" report --sampler 'exec:./mine.sh {n} {realization}' -n 16 -m 2 -o page.html >out 2>err || complain "report: $(<err)"
grep -q 'exec:./mine.sh {n} {realization}' page.html || complain 'report: no name'
printf 'scene: 1\nresults:\n  - {result: power, samplers: ["exec:touch ran; ./mine.sh {n} {realization}", white], points: 8, realizations: 2}\n' >scene.yaml
for words in 'run scene.yaml -o no' 'plan run scene.yaml'; do
    # shellcheck disable=SC2086
    "$program" $words >out 2>err && complain "$words: $(<out)"
    [[ $(<err) == *'is a program, and nobody said that it may be run'* && ! -e ran ]] || complain "$words: $(<err)"
done
"$program" run scene.yaml --allow-exec -o scene >out 2>err || complain "scene: $(<err)"
[[ -e ran && $(cut -d, -f1 scene/power-1.csv | grep -c '^exec:') -gt 0 ]] || complain "scene: $(ls)"
rm ran
"$program" run scene.yaml --allow-exec -o scene >out 2>err || complain "scene: $(<err)"
[[ -e ran ]] || complain 'an answer was kept'

# programs that fail, print nothing, no numbers, too much, too little, or hang
refuses 'failed with exit status 3; its last line: worse' --sampler 'exec:echo bad >&2; echo worse >&2; exit 3'
refuses 'failed with exit status 4, and said nothing' --sampler 'exec:echo .5 .5; exit 4'
refuses 'was ended by signal 9' --sampler 'exec:kill -9 $$'
refuses 'not found' --sampler 'exec:./nothing {n}'
refuses 'printed nothing' --sampler 'exec:true'
refuses 'is not a finite number' --sampler 'exec:echo nan 1'
refuses 'goes on after 64 points, far more than were asked for' --sampler 'exec:yes .5 .25' -n 4
for line in '' '#'; do
    refuses 'has printed 1048576 lines one after the other without a point' --sampler "exec:yes '$line'"
done
refuses 'has printed 1048576 lines' --sampler "exec:echo .5 .5; yes ''"
refuses 'printed 1 set, and 3 are asked for' --sampler 'exec:./mine.sh 4 1; : {realizations}' -m 3
for run in '{realization}' 1; do # the second prints the same for every realization
    refuses 'printed more than one set; {realizations}' --sampler "exec:./mine.sh 4 $run; echo '#'; ./mine.sh 4 1" -m 3
done
refuses 'a command is wanted behind exec:' --sampler 'exec: '
refuses 'another set or sampler has this name' --sampler exec:true --sampler exec:true
refuses 'is told how many realizations there are at most' --sampler 'exec:./mine.sh 4 {realization}' --standard-error 0.1
refuses '--homogenize does not go with programs' --sampler 'exec:./mine.sh 4 1' --homogenize
refuses '--checkpoint does not go with programs' --sampler 'exec:./mine.sh 4 1' --checkpoint job.npz
refuses '--range does not go with programs' --sampler 'exec:./mine.sh 4 {realization}' -m 256 --range 0:128
refuses 'of which a program is told by {n}' --sampler 'exec:./mine.sh 4 {realization}' -n 4,8
refuses 'a program is run 1000000 times at most; with {realizations}' --sampler 'exec:./mine.sh 4 {realization}' -m 1000001
"$program" sample --sampler exec:true >out 2>err && complain 'sample of a program'
[[ $(<err) == *'which prints its points already'* ]] || complain "sample: $(<err)"
runs 0 --sampler 'exec:while cat all.txt; do echo "#"; done; : {realizations}' -n 16 -m 12 -k 2
[[ $(key realizations) == 12 ]] || complain "without an end: $(<out)"
"$program" power --sampler 'exec:echo $$ >pid; sleep 600 | cat' -n 4 >out 2>err &
for _ in $(seq 1000); do [[ ! -s pid ]] || break; sleep 0.01; done
kill -TERM $! # shells let background jobs ignore SIGINT
code=0
wait $! || code=$?
[[ $code == 130 && $(<err) == *'interrupted'* ]] || complain "interrupted: $code $(<err)"
leader=$(<pid)
running() { # processes of the group that have not ended
    cat /proc/[0-9]*/stat 2>/dev/null | awk -v group="$leader" '$5 == group && $3 != "Z"'
}
for _ in $(seq 500); do [[ -n $(running) ]] || break; sleep 0.01; done
[[ -z $(running) ]] || complain "left running: $(running)"
finish

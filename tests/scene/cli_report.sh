#!/usr/bin/env bash
# cli_report.sh PROGRAM: pointspec report of samplers and files on the plane and the sphere: one page without anything beside
# it, what it has, the same numbers as the commands, plans, and what it refuses. Skipped (77) without a device.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" report "$1"
"$program" devices >out 2>err && grep -q '^[0-9]' out || exit 77

has() { # PAGE TEXT...
    local page=$1 text
    shift
    for text; do grep -qF -- "$text" "$page" || complain "$page has no \"$text\""; done
}
is_alone() { # PAGE: it is whole, and names no other file
    [[ $(head -1 "$1") == '<!DOCTYPE html>' && $(tail -1 "$1") == '</body></html>' ]] || complain "$1 is cut"
    ! grep -oE '(src|href)="[^"]*"' "$1" | grep -vE '^href="#[^"]*"$' | head -3 | grep . || complain "$1 needs other files"
}

# a sampler of the plane, beside others
runs 0 --sampler latin-hypercube -n 64 -m 9 -o page.html
[[ $(key page) == page.html ]] || complain "$(<out)"
[[ $(grep -v '^#' out | cut -d, -f1-3 | tr '\n' ' ') == \
    'result,kind,questions points,sample,1 spectrum,power,1 beside,power,5 measures,measure,5 rates,variance,1 integrals,variance,1 ' ]] ||
    complain "results: $(<out)"
is_alone page.html
has page.html '<h1>latin-hypercube</h1>' '<th>jittered</th>' '<th>poisson-disk</th>' '<th>bnot</th>' 'periodic discrepancy' \
    'anisotropy' 'has the least variance' 'made by <code>pointspec report --sampler latin-hypercube'
[[ $(ls) == $'err\nout\npage.html' ]] || complain "files: $(ls)"
"$program" measure --sampler latin-hypercube -n 64 -m 9 --measures mean_distance >table
awk -F, '/^mean_distance/ { printf "%.5g &plusmn; %.2g", $2, $3 }' table >cell
has page.html "$(<cell)"
# the cache has the answers
runs 0 --sampler latin-hypercube -n 64 -m 9 -o again.html
[[ $(grep -v '^#' out | sed 1d | awk -F, '{ n += $3 - $4 } END { print n }') == 0 ]] || complain "cache: $(<out)"

# files, whose name is theirs, of realizations and alone
"$program" sample --sampler jittered -n 36 -m 9 -o 'my set.txt'
runs 0 'my set.txt' -o files.html
is_alone files.html
has files.html '<h1>my_set</h1>' '<th>my_set</th>' '<th>white</th>'
"$program" sample --sampler jittered -n 37 -m 1 --seed 3 2>/dev/null || "$program" sample --sampler white -n 37 -o one.txt
runs 0 one.txt -o one.html
is_alone one.html
printf '0 0\n1 0\n1 3\n' >box.txt
runs 0 --box 0,2,0,4 box.txt -o box.html
has box.html 'N = 3'

"$program" sample --sampler white -n 16 -o white.txt
cp white.txt "$(printf 'x%.0s' {1..90}).txt"
runs 0 white.txt -o white.html
has white.html '<h1>white_set</h1>' '<th>white_set</th>' '<th>white</th>'
runs 0 xxx*.txt -o long.html

# the periodogram in dB; what is no word of pictures
printf 'scene: 1\nresults:\n  - {result: power, files: one.txt, pictures: decibels}\n' >decibels.yaml
"$program" run decibels.yaml -o decibels >out 2>err || complain "decibels: $(<err)"
grep -q 'power in dB' decibels/power-1-decibels-1.svg || complain "decibels: $(ls decibels)"
! grep -q 'power in dB' decibels/power-1-picture-1.svg || complain 'decibels: in the picture of powers'
has one.html 'power in dB'
sed 's/decibels/maybe/' decibels.yaml >maybe.yaml
"$program" run maybe.yaml -o maybe >out 2>err && complain 'pictures: maybe'
[[ $(<err) == *'pictures: true or false or decibels, not "maybe"'* ]] || complain "maybe: $(<err)"

# the sphere
"$program" sample --sampler fibonacci -n 48 -o sphere.txt
runs 0 --domain sphere sphere.txt -o sphere.html
is_alone sphere.html
has sphere.html 'from below' 'separation' '<th>zphi</th>' '<th>healpix-jittered</th>'
runs 0 --sampler zphi -n 48 -m 2 -o zphi.html
has zphi.html '<th>white-sphere</th>' '<th>fibonacci</th>'

"$program" plan report --sampler white -n 64 >out
grep -q '^# phase: near pairs' out || complain "plan: $(<out)"
mkfifo fifo
refuses 'which a pipe cannot' fifo -o page.html
# shellcheck disable=SC2016 # a program of the shell
refuses 'report: spectrum: "[ 2 -lt 2 ]' --sampler 'exec:[ {realization} -lt 2 ] && echo .{realization}1 .5' -n 1 -m 3 -o page.html
rm fifo
refuses 'a page ends in .html' --sampler white -n 16 -m 2 -o mine.csv
refuses '-o PAGE.html is needed' --sampler white
refuses 'a report is of the plane or the whole sphere' --sampler white-hemisphere -o a.html
refuses 'a report is of one number of points' --sampler white -n 4,8 -o a.html
refuses 'nothing to report on' -o a.html
printf '.1 .2 .3\n.4 .5 .6\n' >space.txt
refuses 'these points have 3 coordinates' space.txt -o a.html
refuses 'standard input (-) cannot' - -o a.html
runs 1 --sampler white -o nowhere/a.html
says 'cannot write nowhere/a.html'
[[ ! -e a.html ]] || complain 'a page of nothing'
finish

#!/usr/bin/env bash
# cli_stress.sh PROGRAM: pointspec stress: rows, formats, choices, and what it refuses. (Failures: cli_stress_broken.sh.)
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" stress "$1"

count_rows() { # PATTERN
    grep -cE "$1" <(sed '/^#/d; /^case,/d' out) || true
}

runs 0 --case white --precision single
[[ $(grep '^case' out) == case,engine,precision,error,bound,verdict ]] || complain "columns: $(<out)"
[[ -n $(key device) && -n $(key driver) && $(key schema) == 3 ]] || complain "header: $(<out)"
[[ $(count_rows '^white,torus_(direct|nufft),single,[0-9.e-]+,[0-9.e-]+,pass$') == 2 && $(count_rows .) == 2 ]] ||
    complain "two engines: $(<out)"
[[ ! -s err ]] || complain "nothing to say: $(<err)"
awk -F, '/^white/ && !($4 > 0 && $4 <= $5) { exit 1 }' out || complain "error above its bound: $(<out)"

# an engine is left out where it cannot do the case: torus_nufft makes no lists
runs 0 --case frequencies-1e3
[[ $(count_rows ',torus_direct,') -ge 1 && $(count_rows ',torus_nufft,') == 0 ]] || complain "lists: $(<out)"

# all cases of the host, without a device
export OCL_ICD_VENDORS=/nonexistent
runs 0 --engine host
unset OCL_ICD_VENDORS
[[ $(count_rows ',host,double,.*,pass$') -ge 5 && $(key device) == none ]] || complain "host: $(<out)"
sed '/^#/d' out >expected
runs 0 --engine host -o t.csv
cmp <(sed '/^#/d' t.csv) expected || complain "a file has the rows of standard output"
[[ ! -s out ]] || complain "the table went to the file"
runs 0 --engine host --case eigenvalues --format json
grep -q '"columns": \["case", "engine", "precision", "error", "bound", "verdict"\]' out || complain "json: $(<out)"
grep -q '"case": "eigenvalues", "engine": "host", "precision": "double", .*"verdict": "pass"' out || complain "json: $(<out)"
runs 0 --engine host --quick
[[ $(count_rows .) == $(grep -vc '^case' expected) ]] || complain "quick: $(<out)"

refuses 'there is no case "whit"; the nearest is white' --case whit
refuses 'there is no engine "torus_nuft" to try; the nearest is torus_nufft' --engine torus_nuft
refuses 'there is no engine "host_direct" to try' --engine host_direct # the referee
refuses 'no case is left' --engine host --precision single
refuses 'no case is left' --case white --engine sphere_direct
refuses 'no file is read' points.txt
refuses '"npy" is not one of csv, json' --format npy
refuses '--tol is not an option of this command' --tol 1e-3

# stopped in the middle: whole rows, and no file
runs_long() {
    "$program" stress -o long.csv --quick >out 2>err &
    local pid=$! code=0
    wait_until_it_catches $pid
    sleep 0.5 # and some way into its work
    kill -TERM $pid # the shell has background jobs ignore SIGINT
    wait $pid || code=$?
    [[ $code == 130 && ! -e long.csv && $(<err) == *interrupted* ]] || complain "interrupted: $code, $(<err)"
}
runs_long
finish

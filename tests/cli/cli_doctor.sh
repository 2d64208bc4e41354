#!/usr/bin/env bash
# cli_doctor.sh PROGRAM: what the doctor says of a machine that works, and of one where something is wrong.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" doctor "$1"
mkdir empty missing cache
echo /usr/lib/no-such-driver.so >missing/a.icd
line() { # WORD TOPIC PART
    grep -qE "^$1 +$2 .*$3" out || complain "no line $1 $2 $3: $(<out)"
}
export POINTSPEC_CACHE_DIR=$PWD/cache
if "$program" devices 2>/dev/null | grep -q '^0,'; then
    runs 0
    line ok device 'number [0-9]+, ".*", the default \(.*driver .*compute units.*a kernel builds, and its numbers are right'
    line ok cache "$PWD/cache has room"
    [[ $(grep -vcE '^(ok|note) ' out) == 0 && ! -s err ]] || complain "a machine that works: $(<out)"
fi
line ok cache "$PWD/cache/results has 0 results, 0 bytes; rm -r on it empties it"
"$program" sample --sampler bnot -n 1000 -m 2 -o bnot.txt
"$program" doctor >out 2>err || true
line ok cache "$PWD/cache/sets has 2 kept sets of samplers, 40K bytes; rm -r on it empties it"
line ok drivers 'loads, listed in'
line ok memory 'leaves the least'
line ok threads 'may run on number'
chmod 777 cache
POINTSPEC_CACHE_DIR=$PWD/cache "$program" doctor >out 2>err || true
grep -q "^note  *cache  *$PWD/cache can be written by other users" out || complain "a cache of others: $(<out)"
chmod 700 cache

OCL_ICD_VENDORS=$PWD/empty runs 3
line note drivers "none is listed in $PWD/empty"
line WRONG device 'no OpenCL driver found'
says host_direct
OCL_ICD_VENDORS=$PWD/missing runs 3
line note drivers 'a.icd does not load: /usr/lib/no-such-driver.so: cannot open'
POCL_CACHE_DIR=/proc/none runs 3
line note kernels '/proc/none: No such file'
PATH=/nowhere "$program" doctor >out 2>err || true
line note gnuplot gnuplot
runs 3 --device quantum
line WRONG device 'no OpenCL device fits "quantum"'
refuses 'no file is read' points.txt
finish

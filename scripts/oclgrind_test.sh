#!/usr/bin/env bash
# oclgrind_test.sh PROGRAM [ARGS]: runs PROGRAM on Oclgrind's simulated device instead of the ICD
# loader's devices. Oclgrind exits 0 even when it has found something, so its log decides.
# Local memory stays at Oclgrind's 32 KiB, the least OpenCL 1.2 promises; OCLGRIND_LOCAL_MEM_SIZE
# in the environment changes it, OCLGRIND_CHECKS what is looked for. It knows no prefetch (kernels/shared/ahead.h).
set -uo pipefail
log=$(mktemp)
trap 'rm -f "$log"' EXIT
export OCLGRIND_BUILD_OPTIONS="${OCLGRIND_BUILD_OPTIONS-} -DPS_NO_PREFETCH"
read -r -a checks <<<"${OCLGRIND_CHECKS---data-races --uninitialized --check-api}"
oclgrind "${checks[@]}" --max-errors 50 --log "$log" "$@"
status=$?
if [[ -s $log ]]; then
    echo "oclgrind found, in $(basename "$1"):" >&2
    cat "$log" >&2
    exit 1
fi
exit $status

#!/usr/bin/env bash
# changed_tests.sh SOURCE_DIR BUILD_DIR: scripts/changed_tests.sh names the tests of changed rooms, and of those above while
# there is time.
set -euo pipefail
source_dir=$1 build_dir=$2
fail() { echo "changed tests: $*" >&2; exit 1; }
names() { # SECONDS FILE...
    said=$("$source_dir/scripts/changed_tests.sh" "$build_dir" "$@" 2>&1)
}
has() { grep -qx "$1" <<<"$said" || fail "no $1 in: $said"; }
lacks() { ! grep -qx "$1" <<<"$said" || fail "$1 in: $said"; }

long=1000000
names 0 host/math/linear/cholesky.c
has cholesky && has random && lacks samplers && lacks cli_errors
grep -q '^changed_tests: [0-9]* tests of rooms above are left out, [0-9]* s;' <<<"$said" || fail "nothing is left out: $said"
names $long host/math/linear/cholesky.c
has cholesky && has optimal_weights && has cli_errors && lacks memory && lacks tolerance_sweep && lacks docs
names $long host/cli/help.c
has arguments && has cli_errors && lacks points
names 0 tests/points/test_lists.c kernels/shared/fixed.h dev
has lists && has points_npy && has kernels_fft && has symbols && lacks samplers
names $long README.md
[[ -z $said ]] || fail "README.md: $said"
echo "changed tests: as they should be"

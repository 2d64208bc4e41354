#!/usr/bin/env bash
# leaks.sh BUILD_DIR: the tests of the Python module with a library that has AddressSanitizer inside. An error ends them; of
# leaks, which Python and NumPy have of their own, those count whose memory the library has taken, or that were taken in a
# call of it. Environment as ./dev python has it.
set -euo pipefail
library=$1/libpointspec.so
reports=$1/python-leaks
rm -rf "$reports"
mkdir -p "$reports"

sanitizer=$(clang -print-file-name=libclang_rt.asan-x86_64.so)
# A small quarantine: what is freed and kept in it would look like growth to the test that counts pages.
# Without an exit code of its own that of the tests is left.
export ASAN_OPTIONS=exitcode=0:handle_segv=0:fast_unwind_on_malloc=0:quarantine_size_mb=4:log_path=$PWD/$reports/report
status=0
LD_PRELOAD=$sanitizer POINTSPEC_LIBRARY=$PWD/$library PYTHONMALLOC=malloc \
    /usr/bin/python3 -m pytest -q -p no:cacheprovider python/tests/test_pointspec.py || status=$?

if grep -qh 'ERROR: AddressSanitizer' "$reports"/* || grep -qhw 'in pspec_[a-z_]*' "$reports"/*; then
    grep -h -m 1 -A 30 -e 'ERROR: AddressSanitizer' -e 'in pspec_[a-z_]*' "$reports"/* >&2
    echo "python: errors or leaks of the library; $reports has the reports" >&2
    exit 1
fi
exit $status

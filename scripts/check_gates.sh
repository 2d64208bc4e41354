#!/usr/bin/env bash
# check_gates.sh [ROOT]: what goes through one place stays there, receivers have names, and comments fit.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

bad=0
forbid() { # WHY FOLDERS PATTERN [FILE ALLOWED]...: an extended regular expression that no file of the folders has
    local why=$1 folders=$2 pattern=$3 found allowed
    shift 3
    allowed=$(IFS='|' && echo "${*:-none}")
    # shellcheck disable=SC2086 # several folders
    if found=$(grep -rnE --include='*.[ch]' -e "$pattern" $folders | grep -vE "^($allowed):"); then
        printf '%s\n' "$why" "$found" >&2
        bad=1
    fi
}

forbid "a kind of answer is asked through its interface (answers/kind.h), not by its name:" host '[!=]= &ps_kind_'
forbid "estimators are made by the runner (jobs/runner.c), which plans again where it must:" host \
    'ps_estimator_create\(' host/jobs/estimator.c host/jobs/estimator.h host/jobs/runner.c \
    host/verify/stress_device.c
forbid "a receiver is named for the thing:" "host bench tests" '(^|[^[:alnum:]_])(of|from|to|over|all)->'
names=$(sed -n 's/^    \.name = "\(.*\)",$/\1/p' host/samplers/*/*.c | paste -sd '|')
forbid "what there is to know of a sampler stands in its row (samplers/sampler.h), whose name nobody else knows:" host \
    "\"($names)[\":]" 'host/samplers/.*' 'host/verify/.*' 'host/include/.*' host/commands/doctor_devices.c \
    'host/answers/variance/variance(_figure|_table)?.c' host/answers/compare.c host/integrands/torus/half_plane.c
# `white` is also a column, the variance of white noise, and `step` an alias of an integrand

# Formulas and tables in comments are indented, and strings may be long.
if found=$(find host kernels tests bench \( -name '*.[ch]' -o -name '*.cl' \) -print0 | xargs -0 awk '
    length > 100 && !/^ \*  / && !/"/ { printf "%s:%d: %d columns\n", FILENAME, FNR, length; found = 1 }
    END { exit !found }'); then
    printf '%s\n' "lines have at most 100 columns:" "$found" >&2
    bad=1
fi
exit $bad

#!/usr/bin/env bash
# check_layers.sh [ROOT]: every #include "layer/..." in host/ goes down, never up (design: cli ->
# scene -> job -> analysis -> plan -> engines -> device; samplers, integrands, math, io, base are
# leaves). A folder may include itself and the layers named after it below.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}/host"

leaves="math io base"
engines="device $leaves"
plan="engines integrands $engines"
analysis="plan $plan"
job="analysis samplers $analysis"
scene="job $job"
declare -A may_include=(
    [base]="" [math]="base" [io]="math base" [device]="base" [integrands]="math io base"
    [samplers]="device math base" [engines]=$engines [plan]=$plan [analysis]=$analysis
    [job]=$job [scene]=$scene [cli]="scene $scene"
)

bad=0
while IFS=: read -r file line text; do
    layer=${file%%/*}
    target=${text#*\"}
    target=${target%%/*}
    [[ -n ${may_include[$target]+known} || $target == cli ]] || continue # public, shared/, generated
    if [[ $target != "$layer" && " ${may_include[$layer]-} " != *" $target "* ]]; then
        echo "host/$file:$line: $layer may not include $target" >&2
        bad=1
    fi
done < <(grep -rnE --include='*.[ch]' '^[[:space:]]*#[[:space:]]*include[[:space:]]*"[^"]*/' . |
    sed 's|^\./||')
for folder in */; do
    [[ -n ${may_include[${folder%/}]+known} || $folder == include/ ]] || {
        echo "host/$folder is in no layer; add it to scripts/check_layers.sh" >&2
        bad=1
    }
done
exit $bad

#!/usr/bin/env bash
# cli_units.sh PROGRAM: one compute unit or sixteen, as PoCL is told to have: the same engines, and the same bits.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" units "$1"

questions=(
    'power --sampler white -n 1024 -m 20 -k 64'
    'power --sampler white -n 100000 -k 3000 -d 1 --tol 1e-5'
    'power --sampler white -n 100000 -k 96'
    'power --sampler jittered -n 256 -m 60 -k 32 --tol 1e-10'
    'power --sampler white -n 4096 -m 3 -k 16 -d 3'
    'power --sampler white -n 512 -m 33 -k 20 --engine torus_direct'
    'angular --sampler white-sphere -n 1024 -m 20 -l 128'
    'angular --sampler white-sphere -n 30000 -l 200'
    'angular --sampler white-sphere -n 16 -m 5 -l 300'
    'pairs --sampler white-sphere -n 512 -m 7 -l 64'
    'quadrature --sampler fibonacci-hemisphere -n 2000 --brdf glossy:n=30'
)
answer() { # UNITS WORD...: rows, and the name of the engine
    local units=$1
    shift
    POCL_MAX_PTHREAD_COUNT=$units "$program" "$@" 2>err | sed -E '/^# engine: /s/ .*\((\w+) .*/ \1/; /^#/{/^# engine/!d}'
}

for units in 1 16; do
    POCL_MAX_PTHREAD_COUNT=$units "$program" devices --format jsonl >"devices.$units" 2>err || complain "devices: $(<err)"
done
if cmp -s devices.1 devices.16; then
    echo "cli_units: this driver has as many compute units whatever it is told: skipped"
    exit 0
fi
for question in "${questions[@]}"; do
    read -r -a words <<<"$question"
    answer 1 "${words[@]}" >one
    answer 16 "${words[@]}" >sixteen
    checked=$((checked + 1))
    [[ $(wc -l <one) -gt 8 ]] || complain "no answer: $question: $(<err)"
    cmp -s one sixteen || complain "other bits by 16 compute units: $question: $(diff one sixteen | head -3)"
done
finish

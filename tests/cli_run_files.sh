#!/usr/bin/env bash
# cli_run_files.sh PROGRAM: files of scenes: what may be read, and what may be written.
# shellcheck source=tests/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/harness.sh" run "$1"

# ---- what is read --------------------------------------------------------------------------------
printf '0.1 0.2\n0.3 0.4\n' >a.txt
mkfifo pipe
mkdir folder
: >empty
ln -s /dev/zero link
truncate -s 2T endless
refuses_input() { # PART KEY: LINE OF YAML
    printf 'scene: 1\nresults:\n  - result: %s\n    %s\n' "$2" "$3" >input.yaml
    checked=$((checked + 1))
    local code=0
    timeout 20 "$program" run input.yaml -o refused </dev/null >out 2>err || code=$?
    [[ $code == 2 && $(wc -l <err) == 1 && $(<err) == *"input.yaml:$4"*"$1"* && ! -e refused ]] ||
        complain "exit $code, not \"$1\": $3: $(<err)"
    code=0
    timeout 20 "$program" plan run input.yaml </dev/null >out 2>err || code=$?
    [[ $code == 2 && $(<err) == *"input.yaml:$4"*"$1"* ]] || complain "plan: exit $code: $3: $(<err)"
}
for file in pipe:pipe link:device /dev/null:device /dev/zero:device /dev/stdin:'' folder:folder empty:empty endless:bytes; do
    name=${file%%:*} what=${file#*:}
    refuses_input "$what" power "files: [$name]" '4: files: '
    refuses_input "$what" power "files: [[a.txt, $name]]" '4: files: '
done
refuses_input 'is a pipe' power $'files: [a.txt]\n    weights: pipe' '5: weights: '
refuses_input 'is a device' power $'files: [a.txt]\n    frequencies: /dev/zero' '5: frequencies: '
refuses_input 'is a folder' check $'files: [a.txt]\n    against: folder' '5: against: '
refuses_input 'is a device' quadrature $'sampler: white-hemisphere\n    points: 4\n    brdf: "zonal:file=link"' '6: brdf: '

# ---- what is written -----------------------------------------------------------------------------
cat >same.yaml <<'SCENE'
scene: 1
defaults: {points: 4, max-frequency: 2, engine: host_direct, sampler: white}
results:
  - {result: power, name: a, pictures: true}
  - {result: power, name: a-picture-1}
SCENE
refuses 'same.yaml:5: name: "a" and "a-picture-1" would write the same file a-picture-1.svg' same.yaml -o same
[[ ! -e same ]] || complain "there is a folder for what was refused"
sed 's/a-picture-1}/a-picture-1, plot: false}/' same.yaml >other.yaml
runs 0 --cache 0 other.yaml -o other
finish

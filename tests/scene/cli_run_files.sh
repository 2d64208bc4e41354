#!/usr/bin/env bash
# cli_run_files.sh PROGRAM: files of scenes: what may be read, and what may be written.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" run "$1"

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
    timeout 600 "$program" run input.yaml -o refused </dev/null >out 2>err || code=$?
    [[ $code == 2 && $(wc -l <err) == 1 && $(<err) == *"input.yaml:$4"*"$1"* && ! -e refused ]] ||
        complain "exit $code, not \"$1\": $3: $(<err)"
    code=0
    timeout 600 "$program" plan run input.yaml </dev/null >out 2>err || code=$?
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

# A file that the scene reads is not written over, by whatever name.
mkdir into
printf '0.1,0.2\n0.7,0.4\n' >into/z.csv
cp into/z.csv kept.csv
cat >into.yaml <<'SCENE'
scene: 1
results:
  - {result: power, name: z, files: [into/z.csv], max-frequency: 2, engine: host_direct, plot: false}
SCENE
ln -s into linked
for folder in into linked ./into; do
    refuses "z.csv\" is read by the scene and would be written over" into.yaml -o $folder
done
cmp -s into/z.csv kept.csv || complain "a scene wrote over what it reads"
[[ $(ls into) == z.csv ]] || complain "a refused run left $(ls into)"
runs 0 --cache 0 into.yaml -o beside
runs 0 --cache 0 beside/record.json -o beside

# ---- another scene in the folder -----------------------------------------------------------------
scene_of() { # RESULT...: power spectra of those names, in scene.yaml
    printf 'scene: 1\ndefaults: {points: 4, max-frequency: 2, engine: host_direct}\nresults:\n' >scene.yaml
    printf '  - {result: power, sampler: white, plot: false, name: %s}\n' "$@" >>scene.yaml
}
holds() { # FOLDER NAME...: these files, in the order of names, and no others
    local folder=$1 names
    shift
    names=$(cd "$folder" && shopt -s dotglob && LC_ALL=C && printf '%s ' *)
    [[ $names == "$* " ]] || complain "$folder holds $names, not $*"
}
into() { runs 0 --cache 0 "$@" -o folder-of-runs; }
scene_of a b c
into scene.yaml
holds folder-of-runs a.csv a.summary.csv b.csv b.summary.csv c.csv c.summary.csv index.html record.json
[[ ! -s err ]] || complain "a first run says $(<err)"
into scene.yaml # again: nothing goes, nothing is said
holds folder-of-runs a.csv a.summary.csv b.csv b.summary.csv c.csv c.summary.csv index.html record.json
[[ ! -s err ]] || complain "the same run again says $(<err)"
echo mine >folder-of-runs/mine.csv
echo '# mine' >>folder-of-runs/b.summary.csv
mkdir folder-of-runs/below
scene_of a
into scene.yaml
holds folder-of-runs a.csv a.summary.csv b.summary.csv below index.html mine.csv record.json
[[ $(<folder-of-runs/mine.csv) == mine && $(grep -c removed err) == 3 ]] || complain "not 3 removed: $(<err)"
grep -q 'kept "folder-of-runs/b.summary.csv": it is not what the former run made' err || complain "changed: $(<err)"
# Files that the record does not name are somebody's: refused before anything is written.
before=$(cat folder-of-runs/*.* | cksum)
scene_of a mine
refuses '"folder-of-runs/mine.csv" would be written over' --cache 0 scene.yaml -o folder-of-runs
[[ $(cat folder-of-runs/*.* | cksum) == "$before" ]] || complain "a run that was refused has written"
# The record is run again where it lies, and changed files that it names are written over.
echo '# mine' >>folder-of-runs/a.csv
into folder-of-runs/record.json
! grep -q '# mine' folder-of-runs/a.csv || complain "a repeat leaves a changed table"
[[ ! -s err ]] || complain "a repeat says $(<err)"
# What this scene reads stays, though the former run made it.
scene_of a saved
into scene.yaml 2>/dev/null
printf '0.1,0.2\n0.3,0.4\n' >folder-of-runs/saved.csv
printf 'scene: 1\nresults:\n  - {result: power, name: gate, files: [folder-of-runs/saved.csv], engine: host_direct, plot: false}\n' >scene.yaml
runs 0 --cache 0 scene.yaml -o folder-of-runs
[[ -e folder-of-runs/saved.csv && ! -e folder-of-runs/a.csv && ! -e folder-of-runs/saved.summary.csv ]] ||
    complain "what is read: $(ls folder-of-runs)"
grep -q 'kept "folder-of-runs/saved.csv" of the former run: this scene reads it' err || complain "read: $(<err)"

# A record that somebody edited reaches nothing but plain names of regular files with the digest it says.
scene_of a gone
runs 0 --cache 0 scene.yaml -o forged
line=$(grep -o '"[0-9a-f]* gone.csv"' forged/record.json)
digest=${line:1:32}
[[ ${#digest} == 32 ]] || complain "no digest: $line"
for name in outside hidden link plain; do cp forged/gone.csv "$name"; done
cp forged/gone.csv forged/.hidden
mkdir forged/below
cp forged/gone.csv forged/below/file
ln -s ../link forged/link.csv
forged=
for name in ../outside "$PWD/hidden" .hidden below/file link.csv below . .. ''; do
    forged="$forged\"$digest $name\", "
done
forged="$forged\"${digest}\", "
sed -i -e "s|$line|$forged$line|" -e 's/"[0-9a-f]* a.csv"/"- a.csv"/' -e 's/\( *"[0-9a-f]*\) a.summary.csv"/\10 a.summary.csv"/' forged/record.json
scene_of other
runs 0 --cache 0 scene.yaml -o forged
holds forged .hidden a.csv a.summary.csv below index.html link.csv other.csv other.summary.csv record.json
[[ -e outside && -e hidden && -e link && -L forged/link.csv && -e forged/below/file ]] || complain "a forged record removed"

# Records that name no files, and what is no record: written over, nothing removed.
for former in '{"scene": 1}' 'no record'; do
    rm -rf old
    scene_of a
    runs 0 --cache 0 scene.yaml -o old
    echo "$former" >old/record.json
    runs 0 --cache 0 scene.yaml -o old
    echo "$former" >old/record.json
    scene_of b
    runs 0 --cache 0 scene.yaml -o old
    holds old a.csv a.summary.csv b.csv b.summary.csv index.html record.json
done

# A run that stops while it writes has named its files: it is repeated, and what it did not list with a digest stays.
scene_of a
runs 0 --cache 0 scene.yaml -o broken
echo '{"scene": 1}' >broken/record.json
mkdir broken/b.csv
scene_of a b
runs 1 --cache 0 scene.yaml -o broken
grep -q '"- b.csv"' broken/record.json || complain "the record of a run that stopped does not name b.csv"
rmdir broken/b.csv
runs 0 --cache 0 scene.yaml -o broken
scene_of a
runs 0 --cache 0 scene.yaml -o broken
holds broken a.csv a.summary.csv index.html record.json

# A record names files from its own folder, and so do the rows of several integrands: the same bits all the same, until a
# number is another.
mkdir sc
printf '1,0,1,0\n2,1,.5,.25\n' >light.txt
cat >sc/several.yaml <<'END'
scene: 1
results:
  - {result: interpolation, sampler: fibonacci, points: 16, integrands: ["coefficients:file=../light.txt", cap], plot: false}
  - {result: variance, sampler: fibonacci, points: 16, integrand: ["coefficients:file=../light.txt", cap], max-degree: 8, plot: false}
  - {result: light, integrands: ["coefficients:file=../light.txt", cap], max-degree: 4, plot: false}
END
runs 0 --cache 0 sc/several.yaml -o several
runs 0 --cache 0 several/record.json -o again
! cmp -s several/light.csv again/light.csv || complain "the record says the same paths: nothing is tested"
printf '1,0,1,0\n2,1,.5,.26\n' >light.txt
runs 3 --cache 0 several/record.json -o again
says 'other bits'
finish

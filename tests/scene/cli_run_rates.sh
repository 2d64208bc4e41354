#!/usr/bin/env bash
# cli_run_rates.sh PROGRAM: rates and rank in scenes are those of the command, over all samplers and numbers of points of a result.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" run "$1"

found() { grep '^# \(rate\|measured_rate\|crossing\|ranking\|best_case\|upper_\|lower_\)\|^[^#]' "$1"; }

cat >scene.yaml <<'SCENE'
scene: 1
defaults: {realizations: 12, shifts: 2}
results:
  - {result: variance, name: both, samplers: [white, jittered], points: 64..256, integrands: [gaussian, disk], bounds: auto, rates: auto, rank: true}
  - {result: variance, name: window, samplers: jittered, points: [16, 64..256], integrands: [disk], rates: 64..256}
  - {result: variance, name: cutoffs, samplers: [white, jittered], points: 64, integrands: [disk], max-frequency: [8, 9], rank: true}
  - {result: variance, name: without, samplers: [white, jittered], points: 64..256, integrands: [disk], rank: false}
SCENE
runs 0 scene.yaml -o folder

# ---- the same table as the command, a question for all of it ----
command=variance
runs 0 --sampler white --sampler jittered -n 64..256 --integrand gaussian --integrand disk -m 12 --shifts 2 --bounds auto --rates auto --rank -o all.csv
[[ $(found all.csv | wc -l) -ge 60 && $(found all.csv) == "$(found folder/both.csv)" ]] || complain "both: $(diff <(found all.csv) <(found folder/both.csv))"
runs 0 --sampler jittered -n 16,64..256 --integrand disk -m 12 --shifts 2 --rates 64..256 -o all.csv
[[ $(found all.csv) == "$(found folder/window.csv)" ]] || complain "window: $(diff <(found all.csv) <(found folder/window.csv))"
[[ $(grep -c '^# question\|^# command: pointspec variance' folder/both.csv) == 1 ]] || complain "questions of both: $(grep '^# command' folder/both.csv)"
[[ $(grep -v '^#' folder/both.summary.csv | sed 1d) == '64..256,'* ]] || complain "summary: $(<folder/both.summary.csv)"
# Another key asks one question for each of its values.
[[ $(grep -v '^#' folder/cutoffs.summary.csv | sed 1d | cut -d, -f1 | paste -sd,) == 8,9 && $(grep -c '^# ranking:' folder/cutoffs.csv) == 2 ]] ||
    complain "cutoffs: $(<folder/cutoffs.summary.csv)"
[[ $(grep -v '^#' folder/cutoffs.csv | head -n 1) == max-frequency,sampler,points,* ]] || complain "columns of cutoffs"
# What compares nothing has questions as ever.
[[ $(grep -vc '^#' folder/without.summary.csv) == 7 ]] || complain "without: $(<folder/without.summary.csv)"
! grep -q '^# rank\|,rank' folder/without.csv || complain 'rank: false ranks'

# ---- pages say it, records repeat it, and name an engine only where all had one ----
[[ $(grep -c '<p>gaussian: .*</p>\|<p>gaussian, N = .*</p>\|<p>[a-z]*, gaussian: predicted' folder/index.html) -ge 6 ]] || complain "the page: $(grep '<p>' folder/index.html)"
command=run
runs 0 folder/record.json -o again
runs 0 folder/record.json --recorded-engines -o again
for name in both window cutoffs without; do
    [[ $(found "again/$name.csv") == "$(found "folder/$name.csv")" ]] || complain "$name is another"
done
printf 'scene: 1\nresults:\n  - {result: variance, name: two, samplers: [jittered, zphi], points: 16, integrands: [%s], realizations: 8, rank: true}\n' constant >mixed.yaml
runs 0 mixed.yaml -o mixed
! grep -q '"engine"' mixed/record.json || complain "an engine of the plane and the sphere: $(grep '"engine"' mixed/record.json)"
runs 0 mixed/record.json --recorded-engines -o again

# ---- the picture of the command ----
if command -v gnuplot >/dev/null; then
    command=variance
    runs 0 --sampler white --sampler jittered -n 64..256 --integrand gaussian --integrand disk -m 12 --shifts 2 --bounds auto --rates auto --rank --plot all.svg -o all.csv
    texts() { grep -o '>[^<]*\(slope\|gaussian\|disk\)[^<]*</tspan>' "$1" | sort; }
    [[ $(texts all.svg) == "$(texts folder/both.svg)" && $(texts all.svg) == *'jittered: slope -'*' ('* ]] || complain "pictures: $(texts folder/both.svg)"
    [[ $(grep -c '<path' all.svg) == "$(grep -c '<path' folder/both.svg)" ]] || complain 'the picture has other curves'
    [[ $(texts folder/window.svg) == *'slope -'*' ('* ]] || complain "a sampler alone: $(texts folder/window.svg)"
fi

# ---- refused with its line, before any work ----
command=run
printf 'scene: 1\nresults:\n  - {result: variance, samplers: [white], points: 64, integrands: [disk], realizations: 8, rank: true}\n' >one.yaml
refuses 'one.yaml:3: variance-1: rank compares samplers and sets, which takes two of them' one.yaml -o none
printf 'scene: 1\nresults:\n  - {result: variance, samplers: [white], points: 64..256, integrands: [disk], realizations: 2, rates: auto}\n' >few.yaml
refuses 'few.yaml:3: variance-1: rates has errors, which need 8 realizations' few.yaml -o none
finish

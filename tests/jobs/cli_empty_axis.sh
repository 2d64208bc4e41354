#!/usr/bin/env bash
# cli_empty_axis.sh PROGRAM: points that leave a piece of an axis empty may be of a smaller box, which is said.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" power "$1"
words=(--engine host_direct -k 2)
awk 'BEGIN { for (i = 0; i < 200; i++) printf "%.3f %.3f\n", i * 7919 % 1000 / 1000, i * 10469 % 400 / 1000 }' >box.txt
runs 0 "${words[@]}" box.txt
[[ $(key empty) == 'axis 2 of the first set has no point from 0.395 to 1: '*'--box X0,X1'* ]] || complain "empty: $(key empty)"
runs 0 "${words[@]}" <(cat box.txt) # a stream
[[ $(key empty) == 'axis 2 of '* ]] || complain "empty, of a stream: $(key empty)"
runs 0 "${words[@]}" --box 0,2 box.txt
[[ -z $(key empty) ]] || complain "empty with a box: $(key empty)"
runs 0 "${words[@]}" --sampler white -n 200
[[ -z $(key empty) ]] || complain "empty of a sampler: $(key empty)"
head -n 20 box.txt >few.txt # may be chance
runs 0 "${words[@]}" few.txt
[[ -z $(key empty) ]] || complain "empty of few points: $(key empty)"
finish

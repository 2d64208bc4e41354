#!/usr/bin/env bash
# cli_different_points.sh PROGRAM: sets of different N: every set counts with its own N, or as integrals want it.
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
# shellcheck source=tests/harness/harness.sh
. "$here/../harness/harness.sh" power "$1"
field=$here/../field
engine=(--engine host_direct)

power() { # COLUMN_MEAN or the powers of the rings, blank-separated
    grep -v '^#' out | awk -F, -v mean="${1-}" 'NR > 1 { sum += $5; printf mean == "" ? "%.3f " : "", $5 }
        END { if (mean != "") printf "%.4f", sum / (NR - 1) }'
}
is() { # WHAT FOUND EXPECTED
    [[ $2 == "$3" ]] || complain "$1: $2, not $3"
}

# A Poisson process of mean 6 is white: E[|S|^2 / N] = 1 whatever N.
runs 0 -k 24 "$field/poisson_process.txt"
is 'Poisson process' "$(power mean)" 1.0004
[[ $(key normalization) == 'power: N |S|^2 / (sum w)^2, N of each set' ]] || complain "$(key normalization)"
[[ $(key points) == 5.886666666666667 && $(key points_smallest) == 1 && $(key points_largest) == 13 &&
    $(key different_points) == *'white noise is 1'* ]] || complain "$(<out)"
runs 0 -k 24 --normalize integral "$field/poisson_process.txt"
is 'Poisson process, for integrals' "$(power mean)" 1.2180

# N = 8, 64, 512
runs 0 "${engine[@]}" -k 3 "$field/different_n.txt"
is 'different N' "$(power)" '0.658 1.328 1.295 '
runs 0 "${engine[@]}" -k 3 --normalize integral "$field/different_n.txt" -o integral.npz
runs 0 "${engine[@]}" -k 3 --normalize integral "$field/different_n.txt"
is 'different N, for integrals' "$(power)" '3.403 12.590 12.172 '
[[ $(key normalization) == integral:* && $(key different_points) == *integrals* ]] || complain "$(<out)"

# P(0) = N of each set: its mean has a standard error; that of integrals has none.
middle() { tail -c $((8 * 25)) "$1" | head -c $((8 * 13)) | tail -c 8 | od -An -t f8 | tr -d ' '; }
runs 0 "${engine[@]}" -k 2 --full f.npy "$field/different_n.txt"
is 'N at DC' "$(middle f.npy | cut -c 1-8) $(middle f.standard_error.npy | cut -c 1-8)" '194.6666 159.4880'
runs 0 "${engine[@]}" -k 2 --normalize integral --full f.npy "$field/different_n.txt"
is 'mean N at DC' "$(middle f.npy | cut -c 1-8) $(middle f.standard_error.npy)" '194.6666 0'

# The same sets, one N: both are one, and nothing is said.
runs 0 "${engine[@]}" --sampler white -n 7 -m 3 -k 3 --normalize integral
cp out integral.csv
runs 0 "${engine[@]}" --sampler white -n 7 -m 3 -k 3
is 'one N' "$(power)" "$(cp integral.csv out && power)"
[[ -z $(key different_points) ]] || complain "one N: $(key different_points)"

# A check asks for the normalization of the saved spectrum.
command=check
runs 0 "${engine[@]}" "$field/different_n.txt" --against integral.npz
[[ $(key normalization) == integral:* ]] || complain "check: $(key normalization)"

# The sphere: Q(l) alike. Points of z = 1 and a pair: Q = N^2 by each set's own N.
command=angular
printf '0 0 1\n#\n0 0 1\n0 0 1\n0 0 1\n' >poles.txt
runs 0 "${engine[@]}" -l 2 poles.txt
is 'sphere' "$(grep -v '^#' out | tail -n +2 | cut -d, -f3 | tr '\n' ' ')" '2 2 '
[[ $(key normalization) == 'power: N Q(l) / (sum w)^2, N of each set' ]] || complain "$(key normalization)"
finish

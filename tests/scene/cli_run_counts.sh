#!/usr/bin/env bash
# cli_run_counts.sh PROGRAM: numbers of points in scenes.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" run "$1"

result_is() { # LINE OF YAML
    printf 'scene: 1\ndefaults: {engine: host_direct}\nresults:\n  - {name: r, plot: false, %s}\n' "$1" >scene.yaml
}
columns_of() { # NAME... of the summary, row by row
    awk -F, -v names="$*" 'BEGIN { num = split(names, name, " ") } /^#/ { next }
        !seen++ { for (i = 1; i <= NF; i++) at[$i] = i; next }
        { for (i = 1; i <= num; i++) printf "%s ", name[i] in at ? $at[name[i]] : "none" }' run/r.summary.csv
}
# shellcheck disable=SC2317 # called by eval
means_of() { # OPTION...: mean, smallest and largest N as the header of the command has them
    "$program" "$@" | awk -F': ' '/^# points(_smallest|_largest)?:/ { printf "%s ", $2 }'
}

# ---- N that varies from set to set: the mean, the smallest and the largest are columns of the summary ----
for what in 'power, sampler: poisson-disk, max-frequency: 4' 'angular, sampler: poisson-disk-sphere, max-degree: 4' \
    'pairs, sampler: poisson-disk-sphere, max-degree: 4' 'quadrature, sampler: "poisson-disk:lift=hemisphere", brdf: diffuse, max-degree: 4'; do
    result_is "result: $what, points: 16..32, realizations: 5, seed: 3"
    runs 0 scene.yaml -o run
    sed -n 's/^# command: pointspec //p' run/r.csv >commands
    found=$(columns_of points points_smallest points_largest)
    expected=
    while read -r line; do
        expected+=$(eval "means_of $line")
    done <commands
    [[ -n $found && $found == "$expected" && $found != "16 "* ]] || complain "$what: $found, not $expected"
    # the rows have N that was asked for, as they have the sampler
    [[ $(awk -F, '!/^#/ && $1 ~ /^[0-9]/ { print $1 }' run/r.csv | uniq | tr '\n' ' ') == '16 32 ' ]] || complain "$what: $(head -40 run/r.csv)"
done
# the check of such a set, too; what has one N has no such columns
"$program" power --engine host_direct --sampler poisson-disk -n 16 -m 9 -k 4 -o saved.npz
result_is 'result: check, sampler: poisson-disk, against: saved.npz'
runs 0 scene.yaml -o run
[[ $(columns_of points_largest) =~ ^[0-9]+\ $ ]] || complain "check: $(<run/r.summary.csv)"
result_is 'result: power, sampler: white, points: 16, max-frequency: 4'
runs 0 scene.yaml -o run
[[ $(columns_of points points_smallest) == '16 none ' ]] || complain "one N: $(<run/r.summary.csv)"
finish

#!/usr/bin/env bash
# cli_run_keys.sh PROGRAM: what the cache of results has is found again, and whatever changes a result is another key.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" run "$1"
unset POINTSPEC_KERNEL_DIR
shopt -s extglob

cached() { # questions, as standard output says
    awk -F, '!/^#/ && NR > 1 && $4 ~ /^[0-9]+$/ { sum += $4 } END { print sum + 0 }' out
}
result_is() { # LINE OF YAML
    printf 'scene: 1\ndefaults: {engine: host_direct}\nresults:\n  - {name: r, %s}\n' "$1" >scene.yaml
}
is_computed() { # WHAT: nothing of it comes from the cache, and all that is written is what no cache gives
    local file
    rm -rf with without
    runs 0 scene.yaml -o with
    [[ $(cached) == 0 ]] || complain "$1: the key does not know it"
    runs 0 scene.yaml -o without --cache 0
    [[ $(ls with) == "$(ls without)" ]] || complain "$1: $(ls with), not $(ls without)"
    for file in without/*.csv without/*.npy; do
        [[ ! -e $file ]] || cmp -s "with/${file##*/}" "$file" || complain "$1: ${file##*/} is another"
    done
    # and what is not changed is found
    runs 0 scene.yaml -o with
    [[ $(cached) == 1 ]] || complain "$1: a second run computes again"
}

# ---- what is in the files, of the same name and length ----
changes() { # FILE OLD NEW RESULT: the content of an input file
    result_is "$4"
    rm -rf with
    runs 0 scene.yaml -o with
    sed -i "s/$2/$3/" "$1"
    is_computed "the content of $1"
}
printf '0.1 0.2\n0.3 0.4\n0.8 0.7\n' >points.txt
printf '1\n2\n3\n' >weights.txt
printf '1 2\n-3 0\n' >vectors.txt
printf '0 0.25\n0.5 0.5\n1 1\n' >lobe.txt
"$program" power --engine host_direct --sampler white -n 16 -m 20 -k 5 -s 1 -o saved.npz
"$program" power --engine host_direct --sampler white -n 16 -m 20 -k 5 -s 2 -o other.npz
changes points.txt 0.8 0.9 'result: power, files: [points.txt], max-frequency: 3'
changes weights.txt 3 4 'result: power, files: [points.txt], weights: weights.txt, max-frequency: 3'
changes vectors.txt 2 4 'result: power, sampler: white, points: 8, frequencies: vectors.txt'
changes vectors.txt 4 5 'result: power, sampler: white, points: 8, frequencies: vectors.txt, arrays: coefficients'
changes lobe.txt '0.5 0.5' '0.5 0.6' 'result: truncation, brdf: "zonal:file=lobe.txt", max-degree: 3'
result_is 'result: check, sampler: white, points: 16, realizations: 20, against: saved.npz'
runs 0 scene.yaml -o with
cp other.npz saved.npz
is_computed 'the content of saved.npz'

# ---- what a result asks for ----
power='result: power, sampler: white, points: 16, max-frequency: 3'
result_is "$power"
is_computed 'a power spectrum'
for more in 'arrays: true' 'arrays: coefficients' 'pictures: true' 'seed: 2' 'points: 17' 'max-frequency: 4' 'no-skip: true' 'normalize: effective' 'bins: shells' 'scatter: "1,1"' 'scatter: "1,2"'; do
    key=${more%%:*}
    result_is "${power/, $key: +([0-9])/}, $more"
    is_computed "$more"
done
quadrature='result: quadrature, sampler: white-hemisphere, points: 8, weights: optimal, brdf: diffuse, max-degree: 4'
result_is "$quadrature"
is_computed 'a rule'
result_is "$quadrature, arrays: true"
is_computed 'the weights of a rule'
finish

#!/usr/bin/env bash
# cli_counts.sh PROGRAM: several numbers of points in one command: every one is answered as alone, to the bit; what takes one refuses several.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" power "$1"

rows() { sed '/^#/d' "$1" | sed 1d; }
names() { sed '/^#/d' "$1" | head -n 1; }
header() { # KEY...: their values in the order of the header, one a line
    grep -E "^# ($(IFS='|' && echo "$*")): " out || true
}
alone() { # COLUMN NUMBERS ARGS...: rows of one command for each number, behind it; their header lines in `facts`
    local column=$1 n=0 numbers=$2
    shift 2
    : >rows_alone
    : >facts
    for n in $numbers; do
        runs 0 "$@" -n "$n"
        rows out | awk -v n="$n" -v column="$column" 'BEGIN { FS = OFS = "," }
            { if (column == 1) print n, $0; else { first = $1; sub(/^[^,]*,/, ""); print first, n, $0 } }' >>rows_alone
        header engine max_frequency max_degree predicted_error points worst_case_error >>facts
    done
}
same_as_alone() { # NUMBERS OF-THE-OPTION ARGS...
    local numbers=$1 option=$2
    shift 2
    alone 1 "$numbers" "$@"
    runs 0 "$@" -n "$option"
    [[ $(names out) == points,* ]] || complain "$command $option: columns $(names out)"
    cmp -s <(rows out) rows_alone || complain "$command $* -n $option: $(diff <(rows out) rows_alone | head -4)"
    cmp -s <(header engine max_frequency max_degree predicted_error points worst_case_error) facts ||
        complain "$command $* -n $option: $(diff <(header engine max_frequency max_degree predicted_error points worst_case_error) facts | head -4)"
}

# ---- every number as alone, with its own K or L, its own engine, to the bit ----
command=power
same_as_alone '64 128' 64,128 --sampler jittered -m 3
same_as_alone '16 32 64 100' 16..64,100 --sampler white -m 2 -d 3
same_as_alone '128 64' 128,64 --sampler poisson-disk -m 4 --normalize effective
same_as_alone '27 64' 27,64 --sampler halton --bins relative=1/4
same_as_alone '64 128' 64,128 --sampler halton --homogenize -m 9 -k 6 --bins shells --standard-error 0.9
same_as_alone '4 8' 4..15 --sampler white -k 9 --per-ring 8 -d 4
printf '1 0\n-3 5\n' >vectors.txt
same_as_alone '16 32' 16..32 --sampler sobol --frequencies vectors.txt
command=angular
same_as_alone '64 128' 64..128 --sampler zphi -m 3
same_as_alone '12 48' 12,48 --sampler healpix-jittered -m 3 -l 9
same_as_alone '16 32' 16..32 --sampler fibonacci-hemisphere --hemisphere -l 8
command=pairs
same_as_alone '64 128' 64,128 --sampler white-sphere -m 2
command=quadrature
same_as_alone '32 64' 32..64 --sampler white-hemisphere -m 3 --brdf diffuse
same_as_alone '16 20' 16,20 --sampler fibonacci-hemisphere --brdf glossy:n=10 --weights optimal

# ---- several samplers: the samplers first, then their numbers ----
command=power
: >expected
for sampler in white jittered; do
    for n in 16 32; do
        runs 0 --sampler "$sampler" -n "$n" -k 3
        rows out | sed "s/^/$sampler,$n,/" >>expected
    done
done
runs 0 --sampler white --sampler jittered -n 16..32 -k 3
cmp -s <(rows out) expected || complain "two samplers: $(diff <(rows out) expected | head -4)"
[[ $(names out) == sampler,points,bin,* ]] || complain "two samplers: $(names out)"
[[ $(header sampler points | tr '\n' ' ') == '# sampler: white # points: 16 # sampler: white # points: 32 # sampler: jittered # points: 16 # sampler: jittered # points: 32 ' ]] ||
    complain "headers: $(header sampler points)"
runs 0 --sampler white -n 16,32 -k 3 --format json
[[ $(grep -c '"points": \[16, 32\]' out) == 1 && $(grep -c '{"points": 32, "bin": ' out) == 3 ]] || complain "json: $(<out)"
# where N varies the column has what was asked for and the header what was made; the range is there for all of them
runs 0 --sampler poisson-disk --sampler jittered -n 64,128 -m 5 -k 4
[[ $(rows out | cut -d, -f1-2 | uniq | tr '\n' ' ') == 'poisson-disk,64 poisson-disk,128 jittered,64 jittered,128 ' ]] || complain "disks: $(rows out)"
[[ $(header points_smallest | wc -l) == 4 && $(header points | sed -n 3p) == '# points: 64' && $(header points_largest | sed -n 4p) == '# points_largest: 128' ]] ||
    complain "disks: $(header points points_smallest points_largest)"
# one number is no list
runs 0 --sampler white -n 16..31 -k 3
cp out one
runs 0 --sampler white -n 16 -k 3
cmp -s <(grep -v '^# command' one) <(grep -v '^# command' out) || complain "16..31 is not 16"

# ---- a plan for every number, as alone ----
command=plan
for what in 'power --sampler jittered' 'quadrature --sampler white-hemisphere --brdf diffuse'; do
    read -r -a words <<<"$what"
    : >expected
    for n in 64 4096; do
        runs 0 "${words[@]}" -n "$n"
        rows out | cut -d, -f1,2,4- | sed "s/^/$n,/" >>expected
    done
    runs 0 "${words[@]}" -n 64,4096
    # seconds have the start of the device once, and so have the ratios of all of them
    in_all='s/(as long|[0-9.e+]+ times slower) in all/x in all/'
    cmp -s <(rows out | grep -v ',phase,\|,skip,' | cut -d, -f1-3,5- | sed -E "$in_all") <(sed -E "$in_all" expected) ||
        complain "plan $what: $(diff <(rows out) expected)"
    [[ $(names out) == points,engine,verdict,* && $(header points | tr '\n' ' ') == '# points: 64 # points: 4096 ' ]] || complain "plan $what: $(names out)"
    [[ $(rows out | grep -c '^4096,,phase,.*4096 of ') -gt 0 ]] || complain "plan $what: no phases of rows: $(rows out)"
done

# ---- pictures: what varies is said of a curve; E against N is a line of a slope ----
if command -v gnuplot >/dev/null; then
    command=power
    runs 0 --sampler white --sampler jittered -n 16,64 -k 8 --plot curves.svg
    for label in 'white, N = 16' 'white, N = 64' 'jittered, N = 16' 'jittered, N = 64' '2 samplers, N = 16 to 64, '; do
        grep -q "$label" curves.svg || complain "no curve $label"
    done
    runs 0 --sampler white -n 16,64 -k 8 --plot curves.svg
    for label in '>N = 16<' '>N = 64<' 'white, N = 16 to 64, '; do
        grep -q "$label" curves.svg || complain "no curve $label"
    done
    command=quadrature
    runs 0 --sampler white-hemisphere --sampler fibonacci-hemisphere -n 16..64 --brdf diffuse -l 4 --plot errors.svg
    slopes=$(grep -o 'hemisphere: slope -[0-9.]*' errors.svg | tr '\n' ' ')
    # the scene draws the same of the same questions
    printf 'scene: 1\nresults:\n  - {name: r, result: quadrature, samplers: [white-hemisphere, fibonacci-hemisphere], points: 16..64, brdf: diffuse, max-degree: 4}\n' >scene.yaml
    command=run
    runs 0 scene.yaml -o scene
    [[ -n $slopes && $slopes == "$(grep -o 'hemisphere: slope -[0-9.]*' scene/r-convergence.svg | tr '\n' ' ')" ]] ||
        complain "slopes: $slopes, not $(grep -o 'slope[^<]*' scene/r-convergence.svg)"
    command=quadrature
    runs 0 --sampler white-hemisphere -n 16..64 --brdf diffuse -l 4 --plot errors.svg
    [[ $(<errors.svg) == *'>slope -'* && $(<errors.svg) == *'N = 16 to 64, '* ]] || complain "one line: $(grep -o 'slope[^<]*' errors.svg)"
fi

# ---- bad lists ----
for command in power angular pairs quadrature sample check plan; do
    first=(--sampler white)
    [[ $command != plan ]] || first=(power --sampler white)
    refuses ' -n: "16..8": the first number is the larger one' "${first[@]}" -n 16..8
    refuses ' -n: "..8": a range has two ends, as 16..256 has, which is 16,32,64,128,256' "${first[@]}" -n ..8
    refuses ' -n: "8..": a range has two ends' "${first[@]}" -n 8..
    refuses ' -n: 0 is not between 1 and 10000000000' "${first[@]}" -n 0..4
    refuses ' -n: "64,,128": a number is missing beside a comma' "${first[@]}" -n 64,,128
    refuses ' -n: "1e3..1e2": the first number is the larger one' "${first[@]}" -n 1e3..1e2
    refuses ' --points: 64 stands there twice' "${first[@]}" --points 16..64,64
    refuses ' --points: 1e11 is not between 1 and 10000000000' "${first[@]}" --points=1..1e11
    refuses ' -n: "'"$(seq -s, 1 65)"'" has more than 64 numbers' "${first[@]}" -n "$(seq -s, 1 65)"
done

# ---- what takes one number ----
printf '0.1 0.2\n0.7 0.4\n' >two.txt
command=power
refuses '-n names 2 numbers of points, and point files have their own' two.txt -n 64,128
refuses '-n names 2 numbers of points, and point files have their own' --input-format rps two.txt -n 64,128
refuses '--full does not go with several numbers of points' --sampler white -n 64,128 --full x.npy
refuses '--coefficients does not go with several numbers of points' --sampler white -n 64,128 --coefficients x.npy
refuses '-n names 2 numbers of points, and a file of weights is for one' --sampler white -n 2,4 --weights two.txt
refuses '62 points cannot be laid out' --sampler regular -n 64,62
refuses 'strata=8x8 does not make one stratum for each of 128 points' --sampler jittered:strata=8x8 -n 64,128
refuses '--plot: 2 samplers and sets with 9 numbers of points are 18 curves, and a picture has 16 at most; pointspec run' \
    --sampler white --sampler sobol -n 1..256 --plot x.svg
[[ ! -e x.npy && ! -e x.svg ]] || complain "files are there"
command=angular
refuses 'nside=2 makes 48 points, but 192 were asked for; leave one of the two away' --sampler healpix:nside=2 -n 48,192
command=quadrature
refuses '-n names 2 numbers of points, and point files have their own' two.txt -n 64,128 --brdf diffuse
refuses '--weights-out has the weights of one rule' --sampler white-hemisphere -n 4,8 --brdf diffuse --weights-out w.txt
refuses '-n names 2 numbers of points, and a file of weights is for one' --sampler white-hemisphere -n 2,4 --brdf diffuse --weights two.txt
command=convert
refuses '-n names 3 numbers of points, and point files have their own' two.txt -n 1..4 -o three.txt
command=sample
refuses '-n names 2 numbers of points, and an output has sets of one, for what reads it averages over them; use a command for each' \
    --sampler white -n 64,128 -o three.txt
[[ ! -e three.txt ]] || complain "three.txt is there"
command=plan
refuses '-n names 2 numbers of points, and an output has sets of one' sample --sampler white -n 64,128
command=check
"$program" power --engine host_direct --sampler white -n 16 -m 9 -k 4 -o saved.npz
refuses '-n names 2 numbers of points, and a saved spectrum is of one' --sampler white -n 16..32 --against saved.npz
refuses '-n names 2 numbers of points, and sets of one are checked at a time' --sampler white -n 16..32 --homogeneous
"$program" power --engine host_direct --sampler white -n 16,32 -m 9 -k 4 -o several.npz
refuses '"several.npz": this is the table of several samplers or numbers of points; save one of them alone' --sampler white --against several.npz
finish

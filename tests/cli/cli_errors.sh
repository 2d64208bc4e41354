#!/usr/bin/env bash
# cli_errors.sh PROGRAM: bad input. Every row of the tables below gives the exit code and a part of
# the sentence; it must be one line on standard error that begins with the name of the command,
# nothing may be on standard output and no file may be left.
set -euo pipefail
program=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
in=$scratch/in work=$scratch/work
mkdir "$in" "$work"
cd "$work"
unset POINTSPEC_DEVICE

# The leak sanitizer may trip over threads of PoCL when a run is short. That is no finding: once more
# without it.
tripped='LeakSanitizer has encountered a fatal error'
checked=0 bad=0
complain() { # LINE...
    printf '%s\n' "$@" >&2
    bad=1
}

# refuses EXIT PART COMMAND ARGS...: standard input is empty.
refuses() {
    local expected=$1 part=$2 code left
    shift 2
    for leaks in 1 0; do
        code=0
        ASAN_OPTIONS=${ASAN_OPTIONS-}:detect_leaks=$leaks \
            "$program" "$@" </dev/null >"$scratch/out" 2>"$scratch/err" || code=$?
        grep -q "$tripped" "$scratch/err" || break
    done
    checked=$((checked + 1))
    local said
    said=$(<"$scratch/err")
    [[ $code == "$expected" ]] || complain "exit $code, not $expected: pointspec $*" "    $said"
    [[ $(wc -l <"$scratch/err") == 1 && $said == pointspec* ]] ||
        complain "not one line of the program: pointspec $*" "    $said"
    [[ $said == *"$part"* ]] || complain "\"$part\" is missing: pointspec $*" "    $said"
    [[ ! -s $scratch/out ]] || complain "something on standard output: pointspec $*"
    left=$(ls -A "$work")
    [[ -z $left ]] || complain "left behind: $left: pointspec $*"
    rm -rf "${work:?}"/* "$work"/.[!.]*
}

printf '0.1 0.2\n0.3 0.4\n' >"$in/good.txt"
printf '0.1 0.2\n0.3 0.4\n0.5 0.6\n' >"$in/other.txt"
: >"$in/empty.txt"
printf '#\n#\n' >"$in/marks.txt"
printf '0.1 0.2\n0.3 nan\n' >"$in/nan.txt"
printf '0.1 0.2\ninf 0.4\n' >"$in/inf.txt"
printf '0.1 0.2\n0.3 0.4 0.5\n' >"$in/columns.txt"
printf '0.1 0.2\n1.5 0.4\n' >"$in/outside.txt"
printf '0.1 0.2 1\n0.3 0.4 -1\n' >"$in/balanced.txt"
printf '0.6 0 -0.8\n0 0 1\n' >"$in/sphere.txt"
printf '0.1 0.2\n0.3 x\n' >"$in/word.txt"
printf '\x89PNG\r\n\x1a\n\x00\x00' >"$in/picture.txt"
printf '1 2\n3 4.5\n' >"$in/vectors.txt"
printf '1\n' >"$in/weights.txt"
"$program" sample --sampler white -n 16 -o "$in/good.npy"
head -c 200 "$in/good.npy" >"$in/truncated.npy"
head -c 20 "$in/good.npy" >"$in/header.npy"

# ---- the line itself
refuses 2 'unknown command "powre"; did you mean power?' powre
refuses 2 'unknown command ""' ''
refuses 2 'unknown option --versoin; did you mean --version?' --versoin
refuses 2 'unknown command "sampl"; did you mean sample?' help sampl
refuses 2 'unknown option --pionts; did you mean --points?' power --pionts 5
refuses 2 'is not an option of this command' sample --tol 1e-3
refuses 2 'is not an option of this command' devices -n 5
refuses 2 '-n needs a value' sample --sampler white -n
refuses 2 'but the option --seed follows' sample -o --seed 1
refuses 2 '--wrap takes no value' power --wrap=yes
# An output whose ending no format has, before anything is computed; --format makes the name free.
none='the ending .foo is none of .csv, .json, .jsonl, .npy and .npz'
for command in 'power --sampler white -n 1e9 -k 4' 'angular --sampler fibonacci -n 1e9 -l 4' 'truncation --brdf diffuse' devices \
    'plan power --sampler white -n 16 -k 4' 'bench --quick'; do
    read -r -a words <<<"$command"
    refuses 2 "\"out.foo\": $none, by which the format is chosen; with --format the name is free" "${words[@]}" -o out.foo
done
refuses 2 '"some.d/out.foo": no format of points has the ending .foo' sample --sampler white -n 16 -o some.d/out.foo
refuses 2 '"out.foo": no format of points has the ending .foo' convert no-such-file.txt -o out.foo
for name in out.foo .hidden some.d/out; do
    mkdir -p some.d
    options=()
    [[ $name == *.foo ]] && options=(--format csv)
    "$program" devices -o $name "${options[@]}" || complain "devices -o $name"
    "$program" sample --sampler white -n 16 -o $name "${options[@]}" || complain "sample -o $name"
    [[ -s $name ]] || complain "no $name"
    rm $name
done
rmdir some.d
refuses 2 'unknown option --a?b' sample $'--a\nb'
refuses 2 ' -n: "1.5" is not a whole number' sample --sampler white -n 1.5
refuses 2 ' -n: 1e30 is not between 1 and' sample --sampler white -n 1e30
refuses 2 ' -d: 7 is not between 1 and 6' sample --sampler white -d 7
refuses 2 ' -d: 0 is not between 1 and 6' sample --sampler white -d 0
refuses 2 ' -k: -3 is not between 1 and' power --sampler white -k -3
refuses 2 '--tol: 0 is not above 0' power --sampler white --tol 0
refuses 2 '--tol: "nan" is not a finite number' power --sampler white --tol nan
refuses 2 '"half" is not one of auto, single, double' power --sampler white --precision half
refuses 2 'csv, json, npy' power --sampler white --format tsv

# ---- samplers
refuses 2 'there are white, regular' sample -n 16
refuses 2 '2 samplers were given' sample --sampler white --sampler sobol
refuses 2 'no file is read' sample --sampler white points.txt
for command in sample power; do
    refuses 2 'unknown sampler "wite"; did you mean white?' $command -o r --sampler wite
    refuses 2 'has no parameters' $command -o r --sampler white:strata=3
    refuses 2 'did you mean scramble?' $command -o r --sampler sobol:scrambel=owen
    refuses 2 'scramble' $command -o r --sampler sobol:scramble=maybe
    refuses 2 'start' $command -o r --sampler halton:start=-1
    refuses 2 'strata' $command -o r --sampler jittered:strata=3x5 -n 16
    refuses 2 'sampler jittered' $command -o r --sampler jittered -n 1021
    refuses 2 'is not between 2 and 2' $command -o r --sampler larcher-pillichshammer -d 3
    refuses 2 'not a power of 2' $command -o r --sampler larcher-pillichshammer -n 1000
    refuses 2 'without lift=' $command -o r --sampler spiral:lift=sphere
    refuses 2 'lift=ball is not one of none, sphere, hemisphere' $command -o r --sampler halton:lift=ball
done
refuses 2 'leave the dimension away' sample -o r --sampler fibonacci -d 2
refuses 2 'leave the dimension away' sample -o r --sampler jittered:lift=sphere -d 2
refuses 2 'use 972 (nside=9) or 1200 (nside=10)' sample -o r --sampler healpix -n 1000
refuses 2 'needs a number of points 12 nside^2, or nside=' sample -o r --sampler healpix-jittered
refuses 2 'nside=8 makes 768 points, but 1000' sample -o r --sampler healpix:nside=8 -n 1000
refuses 2 'gbn does not hold vectors' sample -o r --sampler fibonacci --format gbn
for sampler in fibonacci healpix sobol:lift=hemisphere; do
    refuses 2 'makes points of the sphere, and this spectrum is of the torus' power -o r --sampler $sampler
    refuses 2 'makes points of the sphere, and this spectrum is of the torus' plan power --sampler $sampler
done

# ---- names are suggested where they are near
# says_exactly SENTENCE COMMAND ARGS...
says_exactly() {
    local sentence=$1
    shift
    refuses 2 "$sentence" "$@"
    [[ $(<"$scratch/err") == *"$sentence" ]] || complain "more than \"$sentence\": pointspec $*"
}
refuses 2 'unknown sampler "bluenoise"; there are white, regular, ' sample --sampler bluenoise -n 16
says_exactly 'unknown command "xylophone"' xylophone
says_exactly 'unknown option --zebra' power --zebra
says_exactly '--brdf is not an option of this command' power --brdf diffuse
says_exactly 'unknown option --zebra; options of a command stand after its name' --zebra
says_exactly 'there is no engine "torus_nuft"' angular --sampler white-sphere -n 16 -l 4 --engine torus_nuft
says_exactly 'the nearest is sphere_nufft' pairs --sampler white-sphere -n 16 -l 4 --engine sphere_nuft
says_exactly 'there is no engine "quantum"' power --sampler white -n 16 -k 4 --engine quantum
says_exactly 'unknown BRDF "velvet-cloth"' quadrature --brdf velvet-cloth --sampler fibonacci -n 8
says_exactly 'sampler sobol has no parameter "mix"' sample --sampler sobol:mix=1 -n 16

# ---- weights whose squares are no numbers
for weight in 1e160 1e-170 5e-324; do
    printf '0.6 0 0.8 %s\n0 0 1 %s\n' $weight $weight >"$in/range.txt"
    refuses 2 'multiply all weights by a constant' pairs -l 4 --weights column --columns xyzw "$in/range.txt"
done
printf '0.6 0 0.8 1e160\n0 0 1 1\n' >"$in/range.txt"
refuses 2 'multiply all weights by a constant' quadrature --brdf diffuse -l 4 --weights column --columns xyzw "$in/range.txt"

# ---- a word of --weights is no file, but for commands that do not have that word
refuses 2 'are the same file' pairs -l 4 -o optimal --weights optimal "$in/sphere.txt"
(
    cd "$scratch"
    "$program" quadrature --brdf diffuse -l 4 -o optimal --weights optimal --sampler fibonacci-hemisphere -n 8 2>/dev/null &&
        [[ -s optimal ]]
) || complain 'quadrature -o optimal --weights optimal'

# ---- point files
power() { # EXIT PART ARGS...
    local expected=$1 part=$2
    shift 2
    refuses "$expected" "$part" power -k 8 -o result.csv "$@"
}
power 2 'nothing to take a spectrum of'
power 2 'empty.txt' "$in/empty.txt"
power 2 'marks.txt' "$in/marks.txt"
power 2 'standard input' -
power 2 'nan.txt, line 2' "$in/nan.txt"
power 2 'inf.txt, line 2' "$in/inf.txt"
power 2 'columns.txt, line 2: 3 columns' "$in/columns.txt"
power 2 'line 2: "nan" is not a finite number' --wrap "$in/nan.txt"
power 2 'outside.txt, line 2: coordinate 1.5 is outside [0,1); --wrap would reduce it mod 1' "$in/outside.txt"
power 2 'word.txt, line 2: "x" is not a number' "$in/word.txt"
power 2 'picture.txt is a PNG image, which is not read' "$in/picture.txt"
power 2 'truncated.npy' "$in/truncated.npy"
power 2 'header.npy' "$in/header.npy"
power 2 'good.txt' --input-format npy "$in/good.txt"
power 2 'the dimension asked for is 3' -d 3 "$in/good.txt"
power 2 'balanced.txt' "$in/good.txt" "$in/balanced.txt"
power 2 'use --normalize effective' --weights column "$in/balanced.txt"
power 2 'weights.txt' --weights "$in/weights.txt" "$in/good.txt"
power 1 "$in: Is a directory" "$in"
power 1 'missing.txt: No such file' missing.txt
power 1 'missing.txt: No such file' --weights missing.txt "$in/good.txt"
power 1 'missing.txt: No such file' "$in/good.txt" missing.txt
if [[ $EUID != 0 ]]; then # root reads everything
    cp "$in/good.txt" "$in/secret.txt"
    chmod 0 "$in/secret.txt"
    power 1 'secret.txt: Permission denied' "$in/secret.txt"
fi

# ---- requests that do not fit together, or cannot be met
power 2 '--sampler' --sampler white "$in/good.txt"
power 2 'set 1 has 2 points, but 5 are asked for' -n 5 "$in/good.txt"
power 2 'it says how point files are read' --columns xy --sampler white
power 2 'holds 1 set; set 2 is asked for' --select-sets 2 "$in/good.txt"
power 2 'Points of the torus are meant here' "$in/sphere.txt"
power 2 'a unit vector?' --wrap "$in/sphere.txt"
power 2 'columns theta-phi are points of the sphere; this is about the torus' --columns theta-phi "$in/good.txt"
power 2 '2 columns, but xyw means 3' --columns xyw "$in/good.txt"
power 2 '--weights column' --weights column --sampler white
power 2 'nearest is torus_direct' --sampler white --engine torus_drect
refuses 2 'vectors.txt' power --frequencies "$in/vectors.txt" "$in/good.txt"
refuses 2 '--frequencies does not go with -k: ' power --frequencies "$in/vectors.txt" -k 8 "$in/good.txt"
refuses 2 'does not go with --max-frequency: ' power --frequencies "$in/vectors.txt" --max-frequency=8 "$in/good.txt"
refuses 2 ' -s does not go with point files' power -k 4 -s 2 "$in/good.txt"
power 3 'tolerance' --sampler white -n 64 --tol 1e-30
power 2 'can be indexed' --sampler white -n 16 -d 6 -k 2e8
power 2 '--per-ring' --sampler white -n 16 -d 6 -k 20
power 2 '--plot-log, --plot-range and --plot-points are about --plot, which was not given' --sampler white -n 16 -k 4 --plot-log x
power 2 'are about --plot, which was not given' --sampler white -n 16 -k 4 --plot-points no
power 2 '--plot-points' --sampler white -n 16 -k 4 --plot x.png --plot-points maybe
power 2 '--plot-range: "2" is not one of X0..X1,Y0..Y1' --sampler white -n 16 -k 4 --plot x.png --plot-range 2
power 2 '--plot-range: 2..1 is no interval' --sampler white -n 16 -k 4 --plot x.png --plot-range ,2..1
# before the work, which these would take very long for
power 2 '--plot-range: the x axis is logarithmic by --plot-log, and cannot begin at 0' \
    --sampler white -n 1e9 -k 4 --plot x.png --plot-log xy --plot-range 0..5
power 2 '--plot-range: the y axis is logarithmic by --plot-log, and cannot begin at -1' \
    --sampler white -n 1e9 -k 4 --plot x.png --plot-log y --plot-range 0..5,-1..1
power 2 '--coefficients does not go with --standard-error: coefficients are of sets whose number is known before' \
    --sampler white -n 16 -k 4 --coefficients c.npy --standard-error 0.1
power 2 '--plot-log: "z" is not one of x, y, xy, none' --sampler white -n 16 -k 4 --plot x.png --plot-log z
power 2 '--bins: "width=0" is none of round|floor|' --sampler white -n 16 -k 4 --bins width=0
power 2 '--bins: "rings" is none of ' --sampler white -n 16 -k 4 --bins rings
power 2 'none of them is complete' --sampler white -n 16 -k 4 --bins relative=2
refuses 2 '--frequencies does not go with --bins: ' power --frequencies "$in/vectors.txt" --bins floor "$in/good.txt"
refuses 2 'all sets must have one number of points' power -k 4 --bins relative=1/8 "$in/good.txt" "$in/other.txt"
refuses 2 '--per-ring' power --sampler white -n 16 -d 4
power 2 '--per-ring: 0 is not between 2' --sampler white -n 16 -k 4 --per-ring 0
power 2 '--per-ring: 1 is not between 2' --sampler white -n 16 -k 4 --per-ring 1
power 2 'between 1 and 2000' --sampler white -n 16 -d 4 -k 2001 --per-ring 9
# Drawing from the rings up to 2000 takes minutes, and refusing must not: a limit of processor seconds, of which it takes
# 0.2, and 5 with sanitizers.
(
    ulimit -t 30
    power 2 'which can be indexed' --sampler white -n 16 -d 5 -k 2000 --per-ring 536870912
    power 2 'which can be indexed' --sampler white -n 16 -d 5 -k 2000 --per-ring 300000
    power 2 'which can be indexed' --sampler white -n 16 -d 3 -k 2000 --per-ring 400000
    power 2 'more than can be counted' --sampler white -n 16 -d 6 -k 1300 --per-ring 9
    power 2 'more than can be counted' --sampler white -n 16 -d 6 -k 2000 --per-ring 2
    large=(--sampler white -n 16 -d 4 -k 900 --per-ring 600000)
    power 2 'there is no engine "nonsense"' "${large[@]}" --engine nonsense
    power 2 'is not for points on the torus' "${large[@]}" --engine sphere_nufft
    power 2 'no OpenCL device fits "nonsense"' "${large[@]}" --device nonsense
    power 1 'missing.txt: No such file' "${large[@]}" --weights missing.txt
    power 1 'No such file' "${large[@]}" -o missing/result.csv
    power 2 '--full does not go with --per-ring' "${large[@]}" --full full.npy
    exit $bad
) || bad=1
# What is wrong with a name is said before a file is read, here one that never ends and holds no points.
refuses 2 'there is no engine "nonsense"' power -k 8 --engine nonsense /dev/zero
refuses 2 'no OpenCL device fits "nonsense"' power -k 8 --device nonsense /dev/zero
refuses 1 'missing.txt: No such file' power -k 8 --weights missing.txt /dev/zero
refuses 1 'missing.txt: No such file' power --frequencies missing.txt /dev/zero
refuses 1 'missing.txt: No such file' angular -l 8 /dev/zero missing.txt
refuses 2 'there is no engine "nonsense"' quadrature --brdf diffuse -l 8 --engine nonsense /dev/zero
refuses 1 'missing.txt: No such file' quadrature --brdf diffuse -l 8 --weights missing.txt /dev/zero
refuses 2 'no OpenCL device fits "nonsense"' quadrature --brdf diffuse -l 8 --device nonsense /dev/zero
refuses 2 'no OpenCL device fits "nonsense"' plan quadrature --brdf diffuse -l 8 --device nonsense /dev/zero
refuses 2 'no OpenCL device fits "nonsense"' pairs -l 8 --device nonsense /dev/zero
refuses 2 'no OpenCL device fits "nonsense"' angular -l 8 --device nonsense /dev/zero
says_exactly 'can be indexed; a list of frequencies has no such limit' power --sampler white -n 16 -d 2 -k 100000
says_exactly '(--per-ring) and lists of frequencies have no such limit' power --sampler white -n 16 -d 5 -k 200
says_exactly 'in dimension 5 can be indexed' power --sampler white -n 16 -d 5 -k 200 --full full.npy
says_exactly 'in dimension 5 can be indexed' power --sampler white -n 16 -d 5 -k 200 --standard-error 0.1
says_exactly '(--per-ring) has no such limit' power --sampler white -n 16 -d 5 -k 200 --bins shells
says_exactly 'in dimension 6 can be indexed; a list of frequencies has no such limit' power --sampler white -n 16 -d 6 -k 1300
says_exactly 'must be given: -k K' power --sampler white -n 16 -d 4 --full full.npy
power 2 '--standard-error: 0 is not above 0' --sampler white -n 16 -k 4 --standard-error 0
power 2 '--standard-error: 2 is not above 0 and at most 1' --sampler white -n 16 -k 4 --standard-error 2
power 2 '--per-ring does not go with --standard-error' --sampler white -n 16 -k 4 --per-ring 9 --standard-error 0.1
refuses 2 '--frequencies does not go with --standard-error' power --frequencies "$in/vectors.txt" --standard-error 0.1 "$in/good.txt"
power 2 '--full does not go with --per-ring' --sampler white -n 16 -k 4 --per-ring 9 --full full.npy
refuses 2 '--frequencies does not go with --full' power --frequencies "$in/vectors.txt" --full full.npy "$in/good.txt"
refuses 2 '--frequencies does not go with --plot' power --frequencies "$in/vectors.txt" --plot x.svg "$in/good.txt"
power 2 '--coefficients does not go with --per-ring' --sampler white -n 16 -k 4 --per-ring 9 --coefficients c.npy
refuses 2 '--frequencies does not go with --per-ring' power --frequencies "$in/vectors.txt" --per-ring 9 "$in/good.txt"
refuses 2 '--seed does not go with point files' power -k 4 --seed 2 "$in/good.txt"
planned=$("$program" plan --help | sed -n 's/^Usage: pointspec plan \([a-z|]*\) .*/\1/p')
[[ $planned == power\|*\|convert ]] || complain "plan --help names \"$planned\""
for kind in ${planned//|/ }; do # the sentence names all of them, and each can be planned
    refuses 2 "$kind" plan devices
    [[ $("$program" plan "$kind" </dev/null 2>&1) != *'name the command'* ]] || complain "plan does not take $kind"
done
refuses 2 'run, report, sample and convert can be planned' plan
refuses 2 'name the command to plan first' plan devices
refuses 2 'one --sampler NAME is needed' plan sample -n 16
refuses 2 'nothing to convert' plan convert

# ---- outputs
white=(--sampler white -n 16)
power 2 '.png, .svg' "${white[@]}" --plot picture.bmp
power 2 'NPY needs a file name' "${white[@]}" --format npy -o -
power 1 'No such file' "${white[@]}" -o missing/result.csv
power 1 'No space left' "${white[@]}" -o /dev/full
power 1 'Is a directory' "${white[@]}" -o "$in"
power 1 'No such file' "${white[@]}" --full missing/full.npy
power 1 'No such file' "${white[@]}" --plot missing/picture.png
power 2 'are the same file' -o "$in/good.txt" "$in/good.txt"
refuses 2 ' -o "' power -k 8 -o "$in/good.txt" "$in/good.txt"
refuses 2 ' --output "' power -k 8 --output "$in/good.txt" "$in/good.txt"
power 2 'are the same file' --full array.npy -o array.npy "$in/good.txt"
power 2 'are the same file' --full array.npy -o array.standard_error.npy "$in/good.txt"
power 2 'are the same file' --plot result.png -o result.png "$in/good.txt"
refuses 1 'No such file' sample "${white[@]}" -o missing/points.txt
refuses 1 'No space left' sample "${white[@]}" -o /dev/full
refuses 1 'Is a directory' sample "${white[@]}" -o "$in"
refuses 2 'name of an output is empty' sample "${white[@]}" -o ''
refuses 2 '"ply" is not one of utk-text, csv, psa-text' sample "${white[@]}" --format ply

# ---- devices
refuses 2 'no OpenCL device fits "quantum"' devices --device quantum
refuses 2 'no OpenCL device fits "99"' devices --device 99
refuses 2 'gzip is read, but not written' sample --sampler white -n 4 -o out.txt.gz
refuses 2 'gzip is read, but not written' power --engine host_direct --sampler white -n 4 -k 2 -o out.csv.gz
refuses 2 'standard input (-) is named 2 times' angular -l 3 - -
refuses 2 '"npy" is not one of csv, json' devices --format npy
refuses 2 'no file is read' devices list
POINTSPEC_DEVICE=quantum refuses 2 'no OpenCL device fits "quantum"' devices
refuses 2 'no OpenCL device fits "quantum"' plan power --engine host_direct --sampler white --sampler step -n 64 -k 4 --device quantum --kept-sets 0
OCL_ICD_VENDORS=$scratch/none refuses 1 'no OpenCL driver can be found' power --sampler white -n 4 -k 2 # devices: cli_no_device

echo "cli_errors: $checked command lines"
exit $bad

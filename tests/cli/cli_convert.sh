#!/usr/bin/env bash
# cli_convert.sh PROGRAM: every format to every other and back, with the bits of the source, through
# files, pipes and gzip; what a format cannot hold is refused; memory stays small; all test data
# convert. What files of other tools look like is in cli_formats.sh.
set -euo pipefail
program=$(realpath "$1")
# shellcheck source=tests/harness/moments.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/moments.sh"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

checked=0 bad=0
complain() { # LINE...
    printf '%s\n' "$@" >&2
    bad=1
}
convert() {
    "$program" convert "$@"
}
# refuses PART ARGS...: exit 2, one line that holds PART, no output.
refuses() {
    local part=$1 code=0
    shift
    convert "$@" </dev/null >out 2>err || code=$?
    checked=$((checked + 1))
    [[ $code == 2 && $(wc -l <err) == 1 && $(<err) == *"$part"* && ! -s out ]] ||
        complain "exit $code, \"$part\" expected: convert $*" "    $(<err)"
}
# refuses_pipe PART ARGS...: the same of standard input
refuses_pipe() {
    local part=$1 code=0
    shift
    convert "$@" >out 2>err || code=$?
    [[ $code == 2 && $(<err) == *"$part"* ]] ||
        complain "exit $code, \"$part\" expected: convert $*" "    $(<err)"
}
# same EXPECTED ARGS...: the text that comes out of standard input or a file, and no message but, with
# weights of the torus, how they are read.
same() {
    local expected=$1 code=0 remark=
    shift
    [[ " $* " != *' --weights column '* ]] ||
        remark='pointspec convert: the file does not say that its last column holds weights: read it with --weights column'
    convert "$@" >out 2>err || code=$?
    checked=$((checked + 1))
    if [[ $code != 0 || (-s err && $(<err) != "$remark") ]] || ! cmp -s "$expected" out; then
        complain "exit $code or other points than $expected: convert $*" "    $(<err)"
    fi
}
# says PART ARGS...: exit 0 and a remark that holds PART.
says() {
    local part=$1 code=0
    shift
    convert "$@" >out 2>err || code=$?
    checked=$((checked + 1))
    [[ $code == 0 && $(<err) == "pointspec convert: "*"$part"* ]] ||
        complain "exit $code, remark \"$part\" expected: convert $*" "    $(<err)"
}

# ---- what formats hold: ending of a file, dimensions, and s sets, w weights, t torus, v vectors,
# a angles
formats=(utk-text csv psa-text gbn edat eps utk-binary rps npy openquad)
declare -A ending=([utk-text]=txt [csv]=csv [psa-text]=psa.txt [gbn]=gbn.txt [edat]=edat [eps]=eps
    [utk-binary]=bin [rps]=rps [npy]=npy [openquad]=openquad.npy)
declare -A dimensions=([utk-text]=1236 [csv]=1236 [psa-text]=2 [gbn]=1236 [edat]=1236 [eps]=2
    [utk-binary]=1236 [rps]=1236 [npy]=1236 [openquad]=2)
declare -A abilities=([utk-text]=swtva [csv]=swtva [psa-text]=wt [gbn]=t [edat]=swt [eps]=t
    [utk-binary]=stv [rps]=st [npy]=swtva [openquad]=wa)
points=9 # in each set

# The kind of points is t, v or a; weights are column or equal (none).
holds() { # FORMAT KIND DIMENSION SETS WEIGHTS
    local can=${abilities[$1]}
    [[ $can == *$2* && ($2 != t || ${dimensions[$1]} == *$3*) && ($4 == 1 || $can == *s*) &&
        ($5 == equal || $can == *w*) ]]
}
# Sets the array options to what tells the columns of a file of these points; the format is found out.
options_to_read() { # FORMAT KIND DIMENSION SETS WEIGHTS
    options=()
    case $1,$2,$5 in
    rps,*) options=(-n "$points" -d "$3") ;;
    openquad,*,column) options=(--columns theta-phi-w --to-columns theta-phi) ;;
    openquad,*) options=(--columns theta-phi --to-columns theta-phi) ;;
    *,a,column) options=(--columns theta-phi-w --to-columns theta-phi) ;;
    *,a,*) options=(--columns theta-phi --to-columns theta-phi) ;;
    *,column) options=(--weights column) ;;
    esac
}

# One format: the file itself, standard input, gzip.
reads_everywhere() { # EXPECTED FORMAT FILE OPTIONS...
    local expected=$1 format=$2 file=$3 unnamed=()
    shift 3
    [[ $format != rps && $format != edat ]] || unnamed=(--input-format "$format") # names tell these
    same "$expected" "$file" "$@"
    same "$expected" - "${unnamed[@]}" "$@" <"$file"
    gzip -c "$file" >"$file.gz"
    same "$expected" "$file.gz" "$@"
    same "$expected" - "${unnamed[@]}" "$@" < <(cat "$file.gz")
}

# round_trips KIND DIMENSION SETS WEIGHTS: of the points in the file source, as text.
round_trips() {
    local from to file expected=source options from_options
    options_to_read utk-text "$@"
    local source_options=("${options[@]}")
    for from in "${formats[@]}"; do
        file=from.${ending[$from]}
        if ! holds "$from" "$@"; then # openquad makes angles of vectors
            [[ $from$1 == openquadv ]] || refuses "$from" source "${source_options[@]}" --format "$from" \
                -o refused
            continue
        fi
        convert source "${source_options[@]}" --format "$from" -o "$file" 2>err || complain "$(<err)"
        options_to_read "$from" "$@"
        from_options=("${options[@]}")
        expected=source
        if [[ $from == rps ]]; then
            grep -q "of $(($3 * points * $2)) coordinates were rounded to float32" err ||
                complain "rps says no loss: $(<err)"
            convert "$file" "${from_options[@]}" >narrow
            expected=narrow
        fi
        reads_everywhere $expected "$from" "$file" "${from_options[@]}"
        for to in "${formats[@]}"; do
            if ! holds "$to" "$@" || [[ $to == rps && $from != rps ]]; then continue; fi
            convert "$file" "${from_options[@]}" --quiet --format "$to" -o "to.${ending[$to]}"
            options_to_read "$to" "$@"
            same $expected "to.${ending[$to]}" "${options[@]}"
        done
    done
}

# As few digits as are read back, as pointspec writes them.
shortest='function shortest(x, digits, text) {
    for (digits = 15; digits < 17; digits++) {
        text = sprintf("%." digits "g", x)
        if (text + 0 == x) return text
    }
    return sprintf("%.17g", x)
}'
with_weights() { # not all positive
    awk "$shortest"' /^#/ { print; next } { print $0, shortest(1.25 - NR / 7) }'
}
for dimension in 1 2 3 6; do
    for sets in 1 3; do
        "$program" sample --sampler white -n $points -d $dimension -m $sets >source
        round_trips t $dimension $sets equal
        with_weights <source >weighted
        mv weighted source
        round_trips t $dimension $sets column
    done
done
for sets in 1 3; do
    "$program" sample --sampler white -n $points -m $sets |
        awk "$shortest"' /^#/ { print; next } { z = 2 * $1 - 1; r = sqrt(1 - z * z); phi = 6.28 * $2
             print shortest(r * cos(phi)), shortest(r * sin(phi)), shortest(z) }' >source
    round_trips v 3 $sets equal
    with_weights <source >weighted
    mv weighted source
    round_trips v 3 $sets column
    "$program" sample --sampler white -n $points -m $sets |
        awk "$shortest"' /^#/ { print; next } { print shortest(3.14 * $1), shortest(6.28 * $2) }' >source
    round_trips a 2 $sets equal
    with_weights <source >weighted
    mv weighted source
    round_trips a 2 $sets column
done

# ---- losses that are said
"$program" sample --sampler white -n 1024 >torus.txt
printf '0 0 1\n0.6 0 0.8\n0 1 0\n' >vectors.txt
says 'of 2048 coordinates were rounded to float32, by at most' torus.txt -o torus.rps
says 'read it with -n 1024' torus.txt torus.txt -o torus.rps
says 'directions were computed anew' vectors.txt --to-columns lon-lat
says 'angles became vectors' --columns lon-lat torus.txt
convert torus.txt --quiet -o torus.rps 2>err
[[ ! -s err ]] || complain "--quiet: $(<err)"

# ---- several files, and parts of them
"$program" sample --sampler white -n 4 -m 3 >three.txt
awk '/^#/ { n++; next } n == 1' three.txt >second.txt
awk '!/^#/' three.txt >merged.txt
same three.txt <(sed '/^#/,$d' three.txt) second.txt <(sed '1,/^#/d; 1,/^#/d' three.txt)
same second.txt --select-sets 2 three.txt
same second.txt --select-sets 2..2 -o - three.txt
same merged.txt --merge three.txt
same merged.txt --merge --select-sets ..3 three.txt
same <(sed '1,5d' three.txt) --select-sets 2.. three.txt
same <(sed -n '2,3p; 5p; 7,8p; 10p; 12,13p' three.txt) --select-points 2..3 three.txt
same <(tail -n 1 three.txt) --select-sets 3 --select-points 4.. three.txt
same <(printf '0.25 0.5\n') --wrap --select-points 1 <(printf -- '-0.75 1.5\n0.1 0.2\n')
same <(printf '0 0 1\n') --normalize-vectors <(printf '0 0 7\n')
same second.txt --columns xyw --weights equal <(sed 's/$/ 3/' second.txt)
refuses 'three.txt holds 3 sets; set 4 is asked for' --select-sets 4 three.txt
refuses 'three.txt holds 3 sets; set 9 is asked for' --select-sets 2..9 three.txt -o out.txt
refuses 'a set has 4 points; point 5 is asked for' --select-points 5.. three.txt -o out.txt
refuses 'not one of' --columns uvw three.txt
refuses '"FILE" is not one of equal, column' --weights FILE three.txt
refuses 'sets: 0 is not between 1' --select-sets 0 three.txt
refuses '--select-points: "x" is not a whole number' --select-points x..3 three.txt
refuses 'says neither end: A..B, or A, A.., ..B' --select-points .. three.txt
refuses 'the first number is the larger one' --select-sets 3..2 three.txt
refuses 'set 1 has 4 points, but 5 are asked for' -n 5 three.txt
refuses 'set 1 has 4 points, but 3 are asked for' -n 3 three.txt -o out.txt
refuses 'nothing to convert' --merge
refuses 'gzip is read, but not written' three.txt -o out.txt.gz
refuses 'standard input (-) is named 2 times, but can be read once' - three.txt -
refuses 'are the same file' three.txt -o ./three.txt
refuses 'eps holds one set per file, and there are more; --select-sets takes one, --merge' \
    three.txt -o out.eps
refuses 'instead of 4, and all sets of npy have the same number' three.txt torus.txt -o out.npy
refuses 'instead of 4, and all sets of rps have the same number' three.txt torus.txt -o out.rps
refuses '"torus.txt" holds points of the torus in 2 dimensions, but "vectors.txt" unit vectors' \
    vectors.txt torus.txt -o out.npy
refuses 'of the sphere; these are of the torus' three.txt --to-columns lon-lat
refuses 'need weights, and these points have none' vectors.txt --to-columns lon-lat-w
left=$(find . -name 'out.*' -o -name refused -o -name '.pointspec*')
[[ -z $left ]] || complain "left behind: $left"

# ---- a set that does not fit into memory; the limit is above what the program itself takes
limit=24000 # KiB; the file has 32 MB
if (ulimit -v $limit && "$program" --version >/dev/null 2>&1); then
    "$program" sample --sampler white -n 2e6 -o large.bin
    for format in utk-binary npy utk-text; do
        (ulimit -v $limit && convert large.bin --format $format -o large.out) ||
            complain "memory: utk-binary to $format"
    done
    (ulimit -v $limit && convert large.out -o again.bin) || complain "memory: utk-text to utk-binary"
    cmp large.bin again.bin || complain "2e6 points change on their way through text"
    rm -f large.* again.bin
else
    echo "cli_convert: a sanitizer's program does not start in $limit KiB: no test of memory"
fi

# ---- --memory counts what openquad keeps, too
"$program" sample --sampler white-sphere -n 1e5 -o large.txt # 1.6 MB of angles
code=0
convert large.txt --memory 1M --format openquad >out 2>err || code=$?
[[ $code == 1 && ! -s out && $(<err) == *'set 1 takes more than 1M, the limit of --memory, and openquad needs it whole'* ]] ||
    complain "openquad in 1M: exit $code: $(<err)"
convert large.txt --memory 4M --format openquad --quiet -o large.npy || complain "openquad in 4M"
rm -f large.*

# ---- interruption
mkdir interrupted
mkfifo endless
yes '0.5 0.25' >endless &
feeder=$!
env --default-signal=INT "$program" convert endless -o interrupted/points.npy 2>err &
reader=$!
wait_until_it_catches $reader
sleep 0.5 # and some way into its work
kill -s INT $reader
code=0
wait $reader || code=$?
kill $feeder 2>/dev/null || true
wait $feeder 2>/dev/null || true
[[ $code == 130 && $(wc -l <err) == 1 && -z $(ls -A interrupted) ]] ||
    complain "interrupted: exit $code: $(<err) $(ls -A interrupted)"

# ---- standard output that is an input would grow without an end
cp torus.txt grows.txt
code=0
input=grows.txt
convert $input >>grows.txt 2>err || code=$?
if [[ $code != 2 || $(<err) != *'also the standard output'* ]] || ! cmp -s torus.txt grows.txt; then
    complain "appending to the input: exit $code: $(<err)"
fi
# two signals of one moment, as timeout sends them, are one
mkdir twice
code=0
timeout -s INT 0.5 "$program" convert --input-format rps /dev/zero -o twice/x.npy 2>err || code=$?
[[ -z $(ls -A twice) ]] || complain "timeout leaves $(ls -A twice)"
# a pipe that ends inside a number
head -c 17 /dev/zero | refuses_pipe 'ends inside a number' --input-format rps -

# ---- points of the plane on the sphere: the bits of a sampler that lifts them
for lift in sphere hemisphere; do
    "$program" sample --sampler hammersley -n 100 -m 2 -o plane.npy
    "$program" sample --sampler hammersley:lift=$lift -n 100 -m 2 -o lifted.npy
    convert plane.npy --lift $lift | cmp -s - <(convert lifted.npy) || complain "--lift $lift: other points"
    convert plane.npy -o plane.txt
    convert plane.txt --lift $lift -o text.npy
    cmp -s text.npy lifted.npy || complain "--lift $lift of text: other points"
done
"$program" sample --sampler hammersley:lift=hemisphere,morph=phong,n=7.5 -n 100 -m 2 -o lifted.npy
convert plane.npy --lift hemisphere --morph phong:n=7.5 -o morphed.npy
cmp -s morphed.npy lifted.npy || complain "--morph: other points"
printf '0.25 0.5 3\n1.25 -0.5 4\n' >weighted.txt
[[ $(convert weighted.txt --columns xyw --wrap --lift hemisphere | cut -d' ' -f4 | tr '\n' ' ') == "3 4 " ]] || complain "lifted weights are others"
[[ $(convert weighted.txt --columns xyw --wrap --lift hemisphere | cut -d' ' -f1-3 | uniq | wc -l) == 1 ]] || complain "lifted points are not wrapped first"

# ---- all test data
data=${POINTSPEC_TEST_DATA-}
if [[ -d $data/pointsets ]]; then
    files=0 total=0
    for file in "$data"/pointsets/*.txt "$data"/spherical/*.txt; do
        convert "$file" -o data.bin 2>err || complain "$file is refused"
        [[ ! -s err ]] || complain "$file: $(<err)"
        convert data.bin >data.txt
        convert "$file" | cmp -s - data.txt || complain "$file: other points than in UTK binary"
        # the numbers of the file itself, whatever stands between them
        [[ $(wc -l <data.txt) == $(grep -c '[0-9]' "$file") ]] || complain "$file: other count"
        files=$((files + 1))
        total=$((total + $(wc -l <data.txt)))
    done
    echo "cli_convert: $files files of the test data, $total points"
else
    echo "cli_convert: no test data (POINTSPEC_TEST_DATA is ${data:-not set}): these files are skipped"
fi
echo "cli_convert: $checked conversions"
exit $bad

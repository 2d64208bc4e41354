#!/usr/bin/env bash
# cli_angular.sh PROGRAM: pointspec angular from files of every kind to tables; what it refuses, and how it says it.
data=$(realpath -m "${POINTSPEC_TEST_DATA:-../shared/data}")
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" angular "$1"

powers() { # of the table in out, with 9 decimals
    awk -F, '!/^#/ && !/^degree/ { printf "%s:%.9f ", $1, $3 }' out
}

# The octahedron with one vertex heavier, in every coordinates that there are.
cat >octahedron.txt <<'EOF'
1 0 0 2
-1 0 0 1
0 1 0 1
0 -1 0 1
0 0 1 1
0 0 -1 1
EOF
printf '%s\n' '1.5707963267948966 0 2' '1.5707963267948966 3.1415926535897931 1' \
    '1.5707963267948966 1.5707963267948966 1' '1.5707963267948966 4.7123889803846897 1' \
    '0 0 1' '3.1415926535897931 0 1' >angles.txt
printf '%s\n' '0 0 2' '180 0 1' '90 0 1' '270 0 1' '0 90 1' '0 -90 1' >degrees.txt
# P = 6 Q / 49; Q = 1 for l = 1, 2, 3; for l = 4 it is 17 (pairs on a line) + 32 * 3/8 (at right angles)
expected='1:0.122448980 2:0.122448980 3:0.122448980 4:3.551020408 '
runs 0 --engine host_direct -l 4 --columns xyzw octahedron.txt
[[ $(powers) == "$expected" ]] || complain "vectors: $(powers), not $expected"
grep -qx 'degree,normalized_degree,power,standard_error' out || complain "column names: $(<out)"
[[ $(key domain) == sphere && $(key max_degree) == 4 && $(key weight_sum) == 7 ]] ||
    complain "header: $(grep '^#' out)"
runs 0 --engine host_direct -l 4 --columns theta-phi-w angles.txt
[[ $(powers) == "$expected" ]] || complain "theta, phi: $(powers)"
runs 0 --engine host_direct -l 4 --columns lon-lat-w degrees.txt
[[ $(powers) == "$expected" ]] || complain "longitude, latitude: $(powers)"
"$program" convert --columns xyzw octahedron.txt -o octahedron.npy
runs 0 --engine host_direct -l 4 --columns xyzw octahedron.npy
[[ $(powers) == "$expected" ]] || complain "npy: $(powers)"
runs 0 --engine host_direct -l 5 --hemisphere --columns xyzw octahedron.txt
[[ $(powers) == '2:0.122448980 4:3.551020408 ' && $(key domain) == hemisphere* ]] ||
    complain "hemisphere: $(powers)"

# Several sets are realizations; one has no standard error; formats.
cut -d' ' -f1-3 octahedron.txt >plain.txt
{ cat plain.txt; echo '#'; sed 's/^1 0 0/0 0.6 0.8/' plain.txt; } >two.txt
runs 0 --engine host_direct -l 3 two.txt
[[ $(key realizations) == 2 ]] || complain "realizations: $(key realizations)"
awk -F, '/^[0-9]/ && ($4 == "" || $4 + 0 < 0) { exit 1 }' out || complain "standard errors: $(<out)"
runs 0 --engine host_direct -l 3 --format json plain.txt
grep -q '"command":"angular"\|"command": "angular"' out || complain "json: $(head -c 300 out)"
grep -q 'null' out || complain "json: no null for the standard error of one realization"

# Lengths: directions count, and the header says how far off they were.
sed 's/^1 0 0/1.0000005 0 0/' plain.txt >long.txt
runs 0 --engine host_direct -l 3 long.txt
[[ $(key vectors) == *'up to 5e-07' ]] || complain "vectors: $(key vectors)"
runs 0 --engine host_direct -l 3 plain.txt
[[ -z $(key vectors) ]] || complain "vectors of length 1: $(key vectors)"

# Samplers: what sample writes has the same spectrum; what is skipped changes nothing.
for sampler in healpix-jittered:nside=2 fibonacci-hemisphere jittered:lift=sphere; do
    for domain in '' --hemisphere; do
        options=(--engine host_direct -l 6 ${domain:+"$domain"})
        [[ $sampler == *nside* ]] || number=(-n 48)
        [[ $sampler != *nside* ]] || number=()
        "$program" sample --sampler $sampler "${number[@]}" -m 3 --homogenize -o sampled.npy
        runs 0 "${options[@]}" sampled.npy
        from_file=$(powers)
        for skip in '' --no-skip; do
            runs 0 "${options[@]}" --sampler $sampler "${number[@]}" -m 3 --homogenize ${skip:+"$skip"}
            [[ $(powers) == "$from_file" ]] || complain "$sampler $domain $skip: $(powers), not $from_file"
        done
    done
done
runs 2 --engine host_direct --sampler white
says '--sampler white makes points of the torus, and this spectrum is of the sphere; lift=sphere or'

# Coefficients of one set: (L + 1)(L + 2) / 2 complex numbers after the header of 128 bytes.
runs 0 --engine host_direct -l 3 plain.txt --coefficients c.npy -o table.csv
[[ $(stat -c %s c.npy) == $((128 + 10 * 16)) ]] || complain "c.npy: $(stat -c %s c.npy) bytes"
head -c 128 c.npy | grep -aq "<c16.*(10,)" || complain "c.npy: $(head -c 128 c.npy | tr -d '\0')"
runs 2 --engine host_direct -l 3 two.txt --coefficients d.npy
says '--select-sets'
[[ ! -e d.npy ]] || complain 'coefficients of two sets were written'
runs 0 --engine host_direct -l 3 two.txt --select-sets 2 --coefficients d.npy
runs 2 --engine host_direct -l 3 --sampler white-sphere -n 9 -m 2 --coefficients e.npy
says '2 realizations'
[[ ! -e e.npy ]] || complain 'coefficients of two realizations were written'
# Powers do not change with a rotation, but coefficients do: none is left out then.
"$program" sample --sampler fibonacci -n 48 --homogenize -o turned.npy
runs 0 --engine host_direct -l 6 turned.npy --coefficients of_file.npy
runs 0 --engine host_direct -l 6 --sampler fibonacci -n 48 --homogenize --coefficients of_sampler.npy
cmp -s of_file.npy of_sampler.npy || complain 'coefficients of a turned set are not those of its points'
runs 2 --engine host_direct -l 3 plain.txt --coefficients d.csv
says 'does not end in .npy'
runs 2 --engine host_direct -l 3 plain.txt --harmonics hemispherical
says '--coefficients'
runs 2 --engine host_direct -l 3 plain.txt --harmonics hemispherical --coefficients h.npy
says 'below the horizon'
grep -v -- '-1' plain.txt >upper.txt
runs 0 --engine host_direct -l 3 upper.txt --harmonics hemispherical --coefficients h.npy

# The table has the same bits with and without, by every engine.
for engine in host_direct sphere_direct sphere_nufft sphere_grid; do
    for harmonics in spherical hemispherical; do
        runs 0 --engine $engine -l 9 upper.txt
        without=$(grep -v '^#' out)
        runs 0 --engine $engine -l 9 upper.txt --harmonics $harmonics --coefficients h.npy
        [[ $(grep -v '^#' out) == "$without" ]] || complain "$engine: --coefficients $harmonics changes powers"
    done
done

# A set alone is known to be alone, whatever else is in the file, and as text or array.
"$program" sample --sampler white-sphere -n 40 -m 2 -o both.npy
"$program" sample --sampler white-sphere -n 40 -m 2 -o both.txt
"$program" sample --sampler white-sphere -n 40 -o alone.npy
runs 0 --engine sphere_nufft -l 250 alone.npy
alone=$(grep -v '^#' out)
for file in both.npy both.txt; do
    runs 0 --engine sphere_nufft -l 250 $file --select-sets 1
    [[ $(grep -v '^#' out) == "$alone" ]] || complain "$file: the first set alone has other powers"
    runs 0 --engine sphere_nufft -l 250 $file
    grep -q '^# .*realizations.* 2' out || complain "$file: not two realizations"
done

# The title of a picture tells of all sets.
if command -v gnuplot >/dev/null; then
    runs 0 --engine host_direct --sampler healpix:nside=1 --sampler fibonacci --sampler zphi -l 2 --plot picture.svg
    grep -q '3 samplers, N = 12 to 1024, 1 realization<' picture.svg ||
        complain "title: $(grep -o '[^>]*samplers[^<]*' picture.svg)"
    runs 0 --engine host_direct -l 2 plain.txt two.txt --plot picture.svg
    grep -q '2 files, N = 6, 3 realizations<' picture.svg ||
        complain "title: $(grep -o '[^>]*realization[^<]*' picture.svg)"
fi

# Hours are announced; a signal ends them while coefficients are summed, and nothing is left behind.
(
    trap - INT TERM
    exec "$program" angular --engine host_direct --sampler white-hemisphere -n 2e5 -l 3000 \
        --harmonics hemispherical --coefficients long.npy -o long.csv </dev/null >out 2>err
) &
wait_until $! grep -q hours err
wait_until_it_catches $!
kill -TERM $!
code=0
wait $! || code=$?
checked=$((checked + 1))
[[ $code == 130 && ! -e long.npy && ! -e long.csv ]] || complain "interrupted: exit $code, files $(echo long.*)"
[[ $(head -1 err) == *'host_direct will take about'*'hours to degree 3000'* ]] || complain "hours: $(<err)"
[[ $(tail -1 err) == *interrupted* ]] || complain "interrupted: $(<err)"
runs 0 --engine host_direct -l 3 plain.txt
[[ ! -s err ]] || complain "without reason: $(<err)"

# What is refused, with the line.
sed 's/^0 1 0/0 0 0/' plain.txt >zero.txt
runs 2 --engine host_direct -l 3 zero.txt
says 'zero.txt'
says 'line 3'
sed 's/^0 1 0/1e300 0 0/' plain.txt >huge.txt
runs 2 --engine host_direct -l 3 huge.txt
says 'line 3'
sed 's/^0 1 0/0 1.1 0/' plain.txt >short.txt
runs 2 --engine host_direct -l 3 short.txt
says 'line 3'
runs 0 --engine host_direct -l 3 --normalize-vectors short.txt
for degree in 0 -1; do
    runs 2 -l $degree plain.txt
    says "-l: $degree leaves no degree, the first is 1"
done
runs 2 -l 2.5 plain.txt
says '-l: "2.5" is not a whole number'
runs 2 -l 100000 plain.txt
says '32768'
runs 2 -l 32768 --engine sphere_nufft plain.txt
says 'the largest degree that fits is'
runs 2 -l 800 --engine sphere_grid plain.txt
says 'the table of cells would take more than 64 MiB; the largest degree that fits is'
runs 2 -l 1 --hemisphere plain.txt
says 'odd degrees vanish'
runs 2 -k 5 plain.txt
says 'not an option of this command'
runs 2 --engine torus_direct -l 3 plain.txt
runs 3 --engine host_direct -l 3 --tol 1e-30 plain.txt
says 'tolerance'
printf '0.1 0.2\n0.3 0.4\n' >plane.txt
runs 2 -l 3 plane.txt

# Columns instead of rows, as healpy makes them: vectors where they have length 1, and nothing else without a word.
array() { # BYTE: eight columns (x, 0, 0), x being -1 or 0.5
    printf '\x93NUMPY\x01\x00\x76\x00%-117s\n' "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 8), }"
    for ((i = 0; i < 8; i++)); do printf '%b' "\\0\\0\\0\\0\\0\\0$1"; done
    head -c 128 /dev/zero
}
array '\xf0\xbf' >columns.npy
array '\xe0\x3f' >angles.npy
runs 0 --engine host_direct -l 3 columns.npy
[[ $(powers) == '1:8.000000000 2:8.000000000 3:8.000000000 ' ]] || complain "columns: $(powers)"
runs 2 -l 3 angles.npy
says 'no unit vectors; are they points, or its rows angles? --transpose or --columns theta-phi-w'

# Degree 0 of many regular points rounds into low degrees by more than the mean of all degrees: the
# self-check does not take that for a device that computes wrongly, and it is no more than it allows.
for degree in 150 300; do
    runs 0 --sampler fibonacci -n 1e5 -l $degree --precision single
    awk -F, '/^[0-9]/ && $1 <= 6 { print $1, $3 }' out >single.txt
    runs 0 --sampler fibonacci -n 1e5 -l $degree --precision double --tol 1e-12
    awk -F, '/^[0-9]/ && $1 <= 6 { print $3 }' out | paste -d' ' single.txt - |
        awk '{ off = sqrt($2) - sqrt($3); off = off < 0 ? -off : off
               largest = off > largest ? off : largest
               if (off > 8e-6 + 8 * 2^-24 * sqrt(1e5 / (2 * $1 + 1))) exit 1 }
             END { exit !(largest > 1e-6) }' || complain "degree $degree: $(cat single.txt)"
done

# Designs of others: powers vanish up to the degree, and the next does not.
designs=$data/spherical
design() { # FILE DEGREE LEVEL
    runs 0 --tol 1e-12 -l $(($2 + 1)) "$designs/$1"
    awk -F, -v t="$2" -v level="$3" '/^[0-9]/ && ($1 <= t ? $3 > level : $3 < 1e-3) { exit 1 }' out ||
        complain "$1: $(tail -3 out)"
}
if [[ -d $designs ]]; then
    design womersley_sf_t044_N01014.txt 44 1e-20
    design sloane_des3-120-15.txt 15 1e-8
else
    echo "cli_angular: no $designs, designs are left out" >&2
fi

finish

#!/usr/bin/env bash
# cli_field.sh PROGRAM FOLDER: every file of the folder, which has what files of the field have, is read to the points or
# the powers that are known of it, or refused by the sentence that names the cure.
set -euo pipefail
program=$(realpath "$1")
folder=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

checked=0 bad=0
complain() { # LINE...
    printf '%s\n' "$@" >&2
    bad=1
}
# powers "P P ..." ARGS...: the column power of a table, each within 1e-4, or as many of its first rows as are named.
powers() {
    local expected=$1 code=0
    shift
    "$program" "$@" --engine host_direct </dev/null >table 2>err || code=$?
    checked=$((checked + 1))
    grep -v '^#' table | awk -F, -v expected="$expected" '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i == "power") column = i; num = split(expected, p, " "); next }
        NR <= num + 1 { d = $column - p[NR - 1]; if (d > 1e-4 || d < -1e-4) exit 1; good++ }
        END { if (good != num) exit 1 }' || code=1
    [[ $code == 0 ]] || complain "exit $code: $*: not $expected" "    $(<err)"
}
# columns TEXT ARGS...: what the header says of the columns.
columns() {
    local expected=$1
    shift
    "$program" "$@" --engine host_direct </dev/null >table 2>err || complain "$*" "    $(<err)"
    checked=$((checked + 1))
    [[ $(sed -n 's/^# input_columns: //p' table) == "$expected" ]] || complain "$*: not $expected" "$(grep input_ table)"
}
# reads "LINE|LINE..." ARGS...: the points that come out of convert, with ten digits.
reads() {
    local expected=$1 code=0
    shift
    "$program" convert "$@" </dev/null 2>err |
        awk '!/^#/ { for (i = 1; i <= NF; i++) $i = sprintf("%.10g", $i + 0 == 0 ? 0 : $i) } { print }' >out || code=$?
    checked=$((checked + 1))
    [[ $code == 0 && $(tr '\n' '|' <out) == "$expected|" ]] ||
        complain "exit $code: convert $*: $(tr '\n' '|' <out), not $expected" "    $(<err)"
}
# refuses PART[;PART...] ARGS...: exit 2 and one line with these parts.
refuses() {
    local parts part code=0
    IFS=';' read -ra parts <<<"$1"
    shift
    "$program" "$@" </dev/null >out 2>err || code=$?
    checked=$((checked + 1))
    [[ $code == 2 && $(wc -l <err) == 1 ]] || complain "exit $code: $*" "    $(<err)"
    for part in "${parts[@]}"; do
        [[ $(<err) == *"$part"* ]] || complain "\"$part\" is missing: $*" "    $(<err)"
    done
}

# ---- angles in degrees: a rule of degree 7, azimuth first; other orders of its columns
lebedev=$folder/lebedev_026.txt
exact='0 0 0 0 0 0 0 5.1375'
powers "$exact" angular -l 8 --columns phi-theta-w:degrees "$lebedev"
awk '{ print $2, $1, $3 }' "$lebedev" >turned.txt
awk '{ print $1, 90 - $2, $3 }' "$lebedev" >latitudes.txt
awk -v d=57.295779513082323 '{ printf "%.17g %.17g %s\n", $1 / d, $2 / d, $3 }' "$lebedev" >radians.txt
powers "$exact" angular -l 8 --columns theta-phi-w:degrees turned.txt
powers "$exact" angular -l 8 --columns lon-lat-w latitudes.txt
powers "$exact" angular -l 8 --columns phi-theta-w radians.txt
refuses 'line 1: 0, 90 are not phi (up to 2 pi) and theta (0 to pi);are these degrees? --columns phi-theta-w:degrees' \
    angular --columns phi-theta-w "$lebedev"
refuses 'line 1: 90, 0 are not theta (0 to pi);are these degrees? --columns theta-phi-w:degrees' \
    angular --columns theta-phi-w turned.txt
refuses 'line 2: 181, 0 are not theta (0 to 180) and phi (up to 360), in degrees' \
    angular --columns theta-phi:degrees <(printf '9 9\n181 0\n')
refuses 'a direction is below the horizon' \
    quadrature --brdf diffuse --columns theta-phi:degrees <(printf '89 0\n91 0\n')
reads '90 30|0 0' --columns theta-phi:degrees --to-columns theta-phi:degrees <(printf '90 30\n0 0\n')
reads '30 90 2' --columns theta-phi-w:degrees --to-columns phi-theta-w:degrees <(printf '90 30 2\n')
reads '0 1 0|0 0 -1' --columns theta-phi:degrees <(printf '90 90\n180 45\n')
reads '30 0' --columns phi-theta:degrees --to-columns lon-lat <(printf '30 90\n')

# ---- angles by their names
catalogue='.26472 1.31095 1.10913'
powers "$catalogue" angular -l 3 --columns ra,dec "$folder/cat.csv"
powers "$catalogue" angular -l 3 --columns ra,dec=lon-lat "$folder/cat.csv"
powers "$catalogue" angular -l 3 --columns dec,ra "$folder/cat.csv"
columns 'lon-lat (columns ra,dec)' angular -l 3 --columns ra,dec "$folder/cat.csv"
refuses 'line 1: are these all coordinates? --columns ra,dec,z' angular "$folder/cat.csv"
refuses 'columns lon-lat are points of the sphere' power --columns ra,dec "$folder/cat.csv"
refuses '--columns: "lonlat" is not one of' angular --columns ra,dec=lonlat "$folder/cat.csv"
angles=$(tail -n +2 "$folder/cat.csv" | cut -d, -f1,2)
for names in ra,dec RA,DEC RAJ2000,DEJ2000 ra_deg,dec_deg lon,lat longitude,latitude glon,glat l,b az,alt az_deg,alt_deg; do
    printf '%s\n%s\n' "$names" "$angles" >named.csv
    powers "$catalogue" angular -l 3 named.csv
    columns lon-lat angular -l 3 named.csv
done
for names in lat,lon latitude,longitude dec_deg,ra_deg; do
    printf '%s\n%s\n' "$names" "$(awk -F, '{ print $2 "," $1 }' <<<"$angles")" >named.csv
    powers "$catalogue" angular -l 3 named.csv
done
{ echo theta_deg,phi_deg,weight && awk -F, '{ print 90 - $2 "," $1 ",1" }' <<<"$angles"; } >named.csv
powers "$catalogue" angular -l 3 named.csv
columns theta-phi-w:degrees angular -l 3 named.csv
refuses 'are these all coordinates?' angular <(printf 'ra_deg,dec\n1,2\n')
reads '1 2|3 4' --columns theta,phi=lon-lat --to-columns lon-lat <(printf 'theta,phi\n1,2\n3,4\n')

[[ $bad == 0 ]] || exit 1
echo "cli_field: $checked files"

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
refuses 'line 1: (0, 90, 0.047619047619) is not a unit vector;are these degrees? --columns phi-theta-w:degrees' angular "$lebedev"
refuses 'line 1: coordinate 90 is outside [0,1);are these degrees? --columns phi-theta-w:degrees' convert "$lebedev"
refuses 'line 1: coordinate 90 is outside [0,1);in other units? --box' power "$lebedev"
refuses 'line 1: (0, 3, 0.5) is not a unit vector;--normalize-vectors' angular <(printf '0 3 .5\n')
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

# ---- columns by their numbers, in texts with names and without
reads '0.5 0.25|0.75 0.125' --columns 4,2 <(printf '9 .25 9 .5\n9 .125 9 .75\n')
reads '0.5|0.75' --columns 4, <(printf '9 .25 9 .5\n9 .125 9 .75\n')
reads '0.5 0.25 3' --columns 2,1,3=xyw <(printf '.25 .5 3\n')
reads '0.25 0.5' --columns 1,2 <(printf 'x,y,r\n.25,.5,3\n')
reads '0.25 0.5' --columns 2,3 <(printf ',x,y\n0,.25,.5\n')
reads '0.25 0.5' --columns 1,2 <(printf ',0,1,2\n9,9,.25,.5\n') # names that are numbers
columns 'xy (columns 3,7)' power -k 2 --columns 3,7 "$folder/ten_columns.txt"
[[ $("$program" convert --columns 3,7 "$folder/ten_columns.txt") == "$(awk '{ print $3 + 0, $7 + 0 }' OFMT=%.9g CONVFMT=%.9g "$folder/ten_columns.txt")" ]] ||
    complain 'ten_columns.txt: other numbers than those of columns 3 and 7'
refuses '10 columns; at most 6 dimensions;--columns chooses among them by number' power "$folder/ten_columns.txt"
refuses '10 columns, and --columns asks for 11' convert --columns 1,11 "$folder/ten_columns.txt"
refuses '--columns asks for column 2 twice' convert --columns 2,2 "$folder/ten_columns.txt"
refuses 'line 2: 2 columns, where the first row has 3' convert --columns 1,2 <(printf '.1 .2 9\n.3 .4\n') -o none
refuses 'labels of columns, or a point?;--header yes or no' convert --columns 1,2 <(printf '0 1 2\n.1 .2 .3\n')
refuses 'columns by number are --columns 1,2' convert --columns x,y "$folder/ten_columns.txt"
refuses '--columns chooses columns (1,2), and gbn has none to choose' convert --columns 1,2 <(printf '1 2\n.5 .5\n')

# ---- numbers one a line, a count before vectors, quotes, Fortran, tabs, an index with a name, blank lines
powers '0 0 0 3.5' angular -l 4 --columns xyz "$folder/des.3.6.3.txt"
powers '0 0 0 3.5' angular -l 4 --columns xyz "$folder/n_then_xyz.txt"
refuses '1 column;one number a line? --columns xyz' angular "$folder/des.3.6.3.txt"
refuses '3 columns after a count; --columns xyz, or xyw' angular "$folder/n_then_xyz.txt"
reads '0.1 0.2|0.3 0.4' "$folder/quoted.csv"
reads '0.1 0.2|0.3 0.4' <(printf '"","x","y"\n"0","0.1","0.2"\n"1","0.3","0.4"\n')
reads '0.1 0.2' <(printf '"0.1" "0.2"\n')
refuses 'line 2: "a" is not a number' convert <(printf '"0.1","0.2"\n"a","0.2"\n') -o none
reads '0.1 0.25' <(printf '1.0D-01 2.5d-1\n')
printf 'x\ty\n.1\t.2\n' >tabs.csv && reads '0.1 0.2' tabs.csv
printf '.1\t.2\n' >bare.csv && reads '0.1 0.2' bare.csv
reads '0.1 0.2|0.1 0.3' <(printf 'ID,x,y\n7,.1,.2\n3,.1,.3\n')
reads '0.1 0.2|0.1 0.3' <(printf 'x,y\n.1,.2\n\n.1,.3\n\n')
reads '0.1 0.2|0.1 0.3' <(printf 'x,y\n\n.1,.2\n\n.1,.3\n')
reads '0.1 0.2|0.1 0.3' <(printf '\r\n \r\nx,y\r\n\t\r\n\r\n.1,.2\r\n.1,.3\r\n')
reads '0.1 0.2|0.1 0.3' <(printf '\n.1,.2\n\n.1,.3\n')
reads '0.1 0.2|0.1 0.3' --columns x,y <(printf '\n#\n\n"x","r","y"\n\n"0.1","a","0.2"\n"0.1","","0.3"\n')
reads '0.1 0.2' <(printf '\nx y\n\n.1 .2\n\n')
reads '0.1 0.2' <(printf 'x,y\n' && printf '\n%.0s' {1..5000} && printf '.1,.2\n')
refuses 'line 5002: coordinate 2 is outside' convert <(printf 'x,y\n' && printf '\n%.0s' {1..5000} && printf '2,.2\n') -o none
printf '\nx,y\n\n.1,.2\n' >blank.csv && reads '0.1 0.2' blank.csv
refuses 'line 5: coordinate 2 is outside' convert <(printf '\nx,y\n\n.1,.2\n.1,2\n') -o none
refuses 'line 4: coordinate 2 is outside' convert <(printf 'x,y\n.1,.2\n\n.1,2\n') -o none
refuses 'line 1: commas in numbers; decimals are written with a point' power "$folder/decimal_commas.txt"
refuses 'line 2: commas in numbers; decimals are written with a point' convert <(printf 'x y\n0,1 0,2\n')
refuses 'line 3: commas in numbers' convert <(printf 'x\ty\n\n-0,1\t1,2\n')
refuses 'line 2: commas in numbers' convert <(printf 'x,y\n0,1 0,2\n')
reads '0' --columns x, --wrap <(printf 'x,y,z\n1,2 3,4\n') # not to be judged: no column that is read
printf 'weight\n1\n2\n' >w.csv && printf '.1 .2\n.3 .4\n' >points.txt
"$program" power -k 2 points.txt --weights w.csv | grep -q '^[^#]' || complain 'a header in weights'
printf '"","w"\n"0","1"\n"1","2"\n' >w.csv
"$program" power -k 2 points.txt --weights w.csv | grep -q '^# weight_sum: 3' || complain 'quoted weights with an index'
printf 'w,v\n1,2\n' >w.csv
refuses 'line 1: columns w,v;weights are one' power -k 2 points.txt --weights w.csv

# ---- what parts the fields of a text with names; a count of them that differs from the names'
reads '0.1 0.2|0.3 0.4|0.5 0.6' --columns x,y "$folder/trees.tsv"
reads '0.1 0.2|0.3 0.4' --columns x,y "$folder/doubled_quotes.csv"
reads '0.1 0.2' --columns x,y --select 'place=3 km E of "A"' "$folder/doubled_quotes.csv"
reads '0.1 0.2|0.3 0.4' --columns x,y <(printf '\tx\t\ty\n0\t.1\t\t.2\n1\t.3\ta b, c\t.4\n')
reads '0.1 0.2|0.3 0.4' --columns x,y <(printf 'x\ty\tplace, m\n.1\t.2\tN, O, P\n.3\t.4\t\n')
reads '0.1 0.2' --columns x,y <(printf 'x;y;n\n.1;.2;a, b, c\n')
reads '0.1 0.2' --columns x,y <(printf 'x y species\n.1\t.2\tFagus sylvatica\n')
reads '0.1 0.2|0.3 0.4|0.5 0.6' --columns x,y <(printf '\xef\xbb\xbf"x","y","n"\r\n.1,.2,"a\r\n9,9,""b"\r\n.3,.4,c\r\n.5,.6,5" d\r\n')
reads '0.1 0.2' --columns 1,2 <(printf '"x\nm","y\nm"\n.1,.2\n')
reads '0.1 0.2|0.3 0.4' <(printf 'x,y,\n.1,.2,\n.3,.4,\n') # a separator at the end of every line
reads '0.1 0.2|0.3 0.4' --columns x,y <(printf '"mag" "x" "y"\n"1" 5 .1 .2\n"2" 6 .3 .4\n') # write.table
reads '0.1 0.2|0.3 0.4' --columns x,y <(printf 'x y n\n1 .1 .2 a\n2 .3 .4 b\n') # without quotes
reads '0.1 0.2|0.3 0.4' --columns x,y <(printf '   mag   x   y\n0  5.2  .1  .2\n1  5.2  .3  .4\n') # to_string
reads '0.1 0.2|0.3 0.4' --columns x,y <(printf 'mag,x,y\na,5,.1,.2\nb,6,.3,.4\n')
awk 'BEGIN { print "x,y,n"; for (i = 0; i < 40000; i++) print i / 40000 ",.5,\"a\nb\"" }' >long.csv # beyond a buffer
[[ $("$program" convert --columns x,y long.csv) == "$(awk 'BEGIN { for (i = 0; i < 40000; i++) print i / 40000, 0.5 }')" ]] ||
    complain 'long.csv: other points than it has'
shifted='and the row after has;nothing says that it is the first that has no name;by number'
refuses "4 names of columns, $shifted" convert --columns x,y <(printf 'id,x,y,z\n1,.1,.2,.3,\n2,.4,.5,.6,\n') # a separator at the end
refuses "3 names of columns, $shifted" convert --columns x,y <(printf 'id,x,y\n1,.1,.2,.3\n')
refuses "3 names of columns, $shifted" convert --columns x,y <(printf 'tree,x,y\n1,.1,.2,.3\n')
tr '\t' ' ' <"$folder/trees.tsv" >blanks.txt
refuses "5 names of columns, $shifted" convert --columns x,y blanks.txt
reads '0.1 0.2|0.3 0.4|0.5 0.6' --columns 2,3 blanks.txt
refuses 'line 3: 4 columns, where the header names 3' convert --columns x,y <(printf 'x,y,n\n.1,.2,a\n.3,.4,b,c\n') -o none
refuses 'is not a number' convert <(printf 'x;"y\n1;2"\n') -o none # quotes take the only row
refuses '"0.2"a" is not a number' convert <(printf 'x,y\n"0.1","0.2"a\n')
refuses 'line 3: a quote begins a column, and none closes it within 1000 lines' \
    convert --columns x,y <(printf 'x,y,n\n.1,.2,a\n.3,.4,"b\n.5,.6,c\n') -o none

# ---- rows of texts with names by what a column holds, as text or as a number
printf 'type,x,y\n1,.1,.2\n2,.3,.4\n1,.5,.6\n' >types.csv
reads '0.1 0.2|0.5 0.6' --select type=1 types.csv
reads '0.3 0.4' --select type=2.0 types.csv
reads '0.3' --select type=2 --columns x, types.csv
reads '0.1 0.2 1|0.5 0.6 1' --select type=1 --columns x,y,type=xyw types.csv
reads '0.5 0.6' --select x=.5 --columns x,y types.csv
columns 'xy (columns x,y)' power -k 1 --select type=1 types.csv
reads '0.2 0.1|#|0.8 0.7' --select kind=a <(printf '"","x","y","kind"\n0,.2,.1,"a"\n1,.4,.3,"b c"\n#\n0,.8,.7,a\n')
reads '0.4 0.3' --select 'kind=b c' <(printf '"","x","y","kind"\n0,.2,.1,"a"\n1,.4,.3,"b c"\n')
reads '0.1 0.2' --select s=u <(printf 'x y s\n.1 .2 u\n.3 .4 v\n')
reads '0.1 0.2' --select s=u <(printf 'x y s\nrow .1 .2 u\nother .3 .4 v\n') # a name less than columns
reads '0.3 0.4' --select s=v --select-points 1 <(printf 'x,y,s\n.1,.2,u\n\n.3,.4,v\n.5,.6,v\n')
refuses 'set 2 has no row with kind=a' convert --select kind=a <(printf 'x,y,kind\n.1,.2,a\n#\n.3,.4,b\n')
refuses 'set 1 has no row with kind=c' convert --select kind=c <(printf 'x,y,kind\n.1,.2,a\n#\n.3,.4,c\n')
refuses '--select mass=1, and the columns are "type,x,y"' convert --select mass=1 types.csv
refuses 'set 1, row 1: coordinate 3 is outside' convert --select type=2 <(printf 'type,x,y\n1,.1,.2\n2,3,.4\n')
refuses 'is about a column with a name, and utk-binary has no names' convert --select type=1 --input-format utk-binary types.csv

# ---- what is known of the other files
[[ $("$program" convert "$folder/poisson_process.txt" | grep -c '#') == 149 ]] || complain 'poisson_process.txt: not 150 sets'
powers 1 power -k 2 -d 2 "$folder/pts-a"
refuses '4 numbers and no other line;-d 2' power "$folder/pts-a"
powers '9.38938 5.53389' angular -l 2 "$folder/vec_3x12.npy"
refuses 'are its columns the points? --transpose' power "$folder/plane_2x20.npy"
[[ $("$program" convert --transpose "$folder/plane_2x20.npy" | wc -l) == 20 ]] || complain 'plane_2x20.npy: not 20 points'

# ---- a box whose axes have intervals of their own: its lattice has no power but at multiples of (8, 4)
awk 'BEGIN { for (y = 0; y < 4; y++) for (x = -7; x < 8; x++) if (x * x / 64 + y * y / 16 < 1 && (x || y)) print x, y }' >below.txt
powers "$(sed 's/.*/0/' below.txt)" power --frequencies below.txt --box 0,8,0,4 "$folder/box84.txt"
powers '32 32 32 0' power --frequencies <(printf '8 0\n0 4\n8 4\n8 2\n') --box 0,8,0,4 "$folder/box84.txt"
reads '0.0625 0.125|0.0625 0.375' --box 0,8,0,4 --select-points ..2 "$folder/box84.txt"
[[ $("$program" power -k 2 --box 0,8,0,4 "$folder/box84.txt" --engine host_direct | sed -n 's/^# box: //p') == 0,8,0,4 ]] ||
    complain 'the header does not have the box'
refuses 'coordinate 4.5 is outside [0,4) of --box' power --box 0,8,0,4 <(printf '4.5 3\n3 4.5\n')

# ---- UTK 1
reads '0.1 0.2|0.6 0.7|#|0.3 0.4|0.8 0.9' "$folder/utk1.pts"
reads '0.1 0.2|#|0.3 0.4' --input-format utk1 <(printf 'mpts2 2 n unit-tor\r\n.1 .2\r\n#patch-separator\r\n.3 .4\r\n')
refuses 'line 1: "mpts3 2", where UTK 1 has "mpts2 2 n unit-tor"' convert <(printf 'mpts3 2\n.1 .2\n')
refuses 'holds no points' convert <(printf 'mpts2 2 n unit-tor\n')
refuses '--format: "utk1" is not one of' convert "$folder/utk1.pts" --format utk1

# ---- frames of simulations: coordinates in units of the box become those of [0,1), every axis by itself
dump=$folder/two_frames.dump
scaled='0.1 0.2 0.3|0.6 0.2 0.8|0.1 0.7 0.8|0.6 0.7 0.3|#|0.11 0.2 0.3|0.6 0.21 0.8|0.1 0.7 0.81|0.6 0.7 0.3'
reads "$scaled" "$dump"
columns xyz power -k 1 "$dump"
awk 'NF == 5 && $1 != "ITEM:" { $3 *= 10; $4 *= 10; $5 *= 10 } { sub(/xs ys zs/, "x y z"); print }' "$dump" >absolute.dump
reads "$scaled" absolute.dump
sed 's/x y z/xu yu zu/; s/^0.0 10.0/-10 10/' absolute.dump >unwrapped.dump
reads '0.55 0.6 0.65|0.8 0.6 0.9' --select-points ..2 --select-sets 1 unwrapped.dump
# atoms that left the box, however far, are wrapped: --box would be refused
refuses 'line 14: coordinate 3.1 is outside [0,1) of the box; --wrap would reduce it mod 1' power "$folder/unwrapped.dump"
reads '0.1 0.05 0.75|0.1 0.25 0.25|0.5 0.5 0.5' --wrap "$folder/unwrapped.dump"
reads '0.1 0.7 0.8|0.6 0.7 0.3|#|0.1 0.7 0.81|0.6 0.7 0.3' --select type=2 "$dump"
reads '0.2 0.1|0.7 0.6' --columns ys,xs --select id=1 <(sed -n '1,9p; 10p; 13p' "$dump" | sed 's/^4$/2/; s/^4 2/1 2/')
reads '0.1 0.2|0.6 0.2' -d 2 --select type=1 --select-sets 1 "$dump"
refuses 'set 1 has no row with type=3' convert --select type=3 "$dump"
refuses '--select mass=3, and the columns are "id type xs ys zs"' convert --select mass=3 "$dump"
refuses '--select: "type" is not NAME=VALUE' convert --select type "$dump"
refuses 'box84.txt: --select type=1 is about a column with a name, and the first line has no names' convert --select type=1 "$folder/box84.txt"
refuses 'line 11: 4 columns, where the header names 5' convert <(sed '11s/ 0.80$//' "$dump")
refuses '5 names of columns, and the row after has 6' power <(sed '10s/$/ 9/' "$dump")
refuses 'is truncated: it ends inside set 2' power <(head -n -1 "$dump")
refuses 'a box that is no cuboid' convert <(sed 's/BOUNDS/BOUNDS xy xz yz/' "$dump")
refuses 'line 6: two bounds of the box' convert <(sed '6s/10.0/0.0/' "$dump")
refuses 'line 4: this is no number of atoms' convert <(sed '4s/4/0/' "$dump")
refuses 'line 5: atoms before their number and the bounds' convert <(sed '5,8d' "$dump")
refuses 'is not a unit vector' angular "$dump"
refuses '--box, and the file states the box itself' convert --box 0,1 "$dump"

# ---- boxes: rings of wave vectors. A lattice of spacing 1 in 8 x 4 x 2 has its six shortest at 1/1, 4 in units of the
# cube of edge 4, and none before; so in any order of the axes, and with the box from the command line
cuboid=$folder/cuboid_8x4x2.dump
awk 'NR > 9 { print $3, $4, $5 }' "$cuboid" >cuboid.txt
shell='shell 28: |k| 4, 1 normalized, 6 of power 64'
header() { # LINE: the table has it
    grep -qxF "# $1" table || complain "no line \"$1\"" "$(grep '^# [ber]' table)"
}
spectrum() { # ARGS...
    "$program" power --engine host_direct "$@" </dev/null >table 2>err || complain "power $*" "    $(<err)"
    checked=$((checked + 1))
}
for args in "$cuboid" "--columns z,x,y $cuboid" '--box 0,8,0,4,0,2 cuboid.txt'; do
    # shellcheck disable=SC2086 # words
    spectrum -k 5 --bins shells $args
    said=$(awk -F, '$5 > 1e-6 && $5 ~ /^[0-9]/ { printf "shell %d: |k| %.6g, %.6g normalized, %d of power %.6g", $1, $2, $3, $4, $5 }' table)
    [[ $said == "$shell" ]] || complain "power $args: $said, not $shell"
done
powers '0 0 0 1.959184 0' power -k 5 "$cuboid" # 64 times 6 of the 196 up to 4.5
header 'box: 0,8,0,4,0,2'
header 'max_frequency: 5'
header 'rings: of |k| in cycles per edge of the cube of the same volume V: k_i V^(1/3) / L_i, with |k_i| up to 11'
! grep '^# \(box_changes\|empty\)' table || complain 'one box that the file states is no doubt'
spectrum -k 2 "$folder/ext.xyz"
header 'box: 0,10,0,20,0,20'
spectrum -k 2 <(cat "$cuboid" && sed 's/^0 8$/0 9/' "$cuboid")
header 'box_changes: edges of the sets are 8 to 9, 4 to 4, 2 to 2; rings are those of the first'
spectrum -k 2 <(cat "$dump" && sed 's/^0.0 10.0/0 11/' "$dump")
header 'box_changes: edges of the sets are 10 to 11, 10 to 11, 10 to 11'
! grep '^# rings' table || complain 'cubes have rings of whole numbers'
refuses 'the box is no cube, and rings up to 400 need |k_i| = 801' power -k 400 "$cuboid"
refuses '--per-ring draws from rings of a cube' power --per-ring 8 "$cuboid"
# no default is refused; a ring below 1/2, and what check makes of it
sed 's/^0 8$/0 80/; s/^0 2$/0 .02/' "$cuboid" >slab.dump
"$program" plan power --wrap slab.dump >table
header 'max_frequency: 10'
spectrum -k 2 --wrap "$folder/unwrapped.dump" -o ring_0.npz
"$program" check --against ring_0.npz --wrap "$folder/unwrapped.dump" >table 2>err || complain 'check of ring 0' "    $(<err)"
grep -q '^0,' table || complain 'no ring 0'
atoms='0.1 0.1 0.15|0.6 0.1 0.4|0.1 0.35 0.4|0.6 0.35 0.15'
reads "$atoms" "$folder/ext.xyz"
reads "$atoms|#|$atoms" <(cat "$folder/ext.xyz" "$folder/ext.xyz")
reads '0.1 0.35 0.4|0.6 0.35 0.15' --select element=Kr "$folder/ext.xyz"
reads '0.1 0.1 0.15|0.6 0.1 0.4' --select species=Ar "$folder/ext.xyz"
reads '0.15 0.1 0.15' --select-points 1 <(sed 's/Properties/Origin="-0.5 0 0" Properties/' "$folder/ext.xyz")
reads '0.1 0.15' --columns x,z --select-points 1 "$folder/ext.xyz"
reads '0.1 0.35 0.4 2' --columns x,y,z,mass=xyzw --domain torus --select element=Kr --select-points 1 \
    <(sed 's/pos:R:3/pos:R:3:mass:R:1/; s/^[AK]r.*/& 2/' "$folder/ext.xyz")
reads '0 0 1|0 1 0' <(printf '2\nwater\nH 0 0 1\nO 0 1 0\n')
reads '0.1 0.2 0.3' --box 0,10 <(printf '1\n\nH 1 2 3 0.5\n')
refuses 'in other units? --box X0,X1' power <(printf '1\n\nH 4 5 6\n')
refuses 'a lattice that is no cuboid' convert <(sed 's/10.0 0/10.0 1/' "$folder/ext.xyz")
refuses 'line 2: Properties are no NAME:TYPE:COUNT' convert <(sed 's/R:3/R:x/' "$folder/ext.xyz")
refuses 'is truncated: it ends inside set 1' power <(head -n 5 "$folder/ext.xyz")

# ---- columns of arrays by their numbers: 20 points of two coordinates in rows, and columns of one
plane=$folder/plane_2x20.npy
"$program" convert --transpose "$plane" -o rows.npy
whole=$("$program" convert rows.npy)
swapped=$(awk '{ print $2, $1 }' <<<"$whole")
[[ $("$program" convert --columns 2,1 rows.npy) == "$swapped" ]] || complain 'rows.npy: other columns than 2,1'
[[ $("$program" convert --columns 2,1 - <rows.npy) == "$swapped" ]] || complain 'rows.npy by a pipe: other columns than 2,1'
[[ $("$program" convert --columns 2,1 --transpose "$plane") == "$swapped" ]] || complain 'plane_2x20.npy: other columns than 2,1'
[[ $("$program" convert --columns 2,1 --transpose <(cat "$plane")) == "$swapped" ]] || complain 'plane_2x20.npy by a pipe'
[[ $("$program" convert --columns 2, rows.npy) == "$(cut -d ' ' -f 2 <<<"$whole")" ]] || complain 'rows.npy: not column 2'
columns 'xy (columns 2,1)' power -k 1 --columns 2,1 --input-format npy rows.npy
refuses 'are its rows the points, or its columns?;--transpose' power --columns 2,1 "$plane"
refuses '--columns asks for a column that is not there' power --columns 1,3 --input-format npy rows.npy
refuses '--columns names columns (x,y), and npy has no names' power --columns x,y rows.npy

# ---- vertices of PLY, as text and as numbers of either byte order
header='format FORMAT 1.0\ncomment by hand\nelement vertex 2\nproperty float x\nproperty uchar red\nproperty double y\nproperty short z\n'
faces='element face 1\nproperty list uchar int vertex_indices\nend_header\n'
printf '%b' "ply\n${header/FORMAT/ascii}${faces}0 7 0 1\n1 8 0 0\n3 0 1 1\n" >ascii.ply
rows='\0\0\0\0\a\0\0\0\0\0\0\0\0\1\0\0\0\x80\x3f\b\0\0\0\0\0\0\0\0\0\0'
printf '%b' "ply\n${header/FORMAT/binary_little_endian}$faces${rows}faces" >little.ply
rows='\0\0\0\0\a\0\0\0\0\0\0\0\0\0\1\x3f\x80\0\0\b\xbf\xf0\0\0\0\0\0\0\xff\xff'
printf '%b' "ply\r\n${header/FORMAT/binary_big_endian}$faces$rows" >big.ply
reads '0 0 1|1 0 0' ascii.ply
reads '0 0 1|1 0 0' little.ply
reads '0 0 1|1 0 0' <(cat little.ply)
reads '0.5 0.5 0.75|0.75 0.25 0.25' -d 3 --box -2,2 big.ply
reads '0 0.7|0.1 0.8' --columns x,red --box 0,10 ascii.ply
reads '0 0.7|0.1 0.8' --columns x,red --box 0,10 little.ply
reads '1 0 0' --select red=8.0 --domain sphere ascii.ply
reads '1 0 0' --select red=8.0 --domain sphere little.ply
for mesh in ascii.ply little.ply big.ply; do
    reads '0 0 1' --select red=7 --domain sphere "$mesh"
    refuses 'set 1 has no row with red=9' convert --select red=9 --domain sphere "$mesh"
    refuses '--select mass=3, and the columns are "x red y z"' convert --select mass=3 --domain sphere "$mesh"
done
reads '0.75 0.25 0.25' -d 3 --box -2,2 --select x=1 big.ply
refuses 'set 1 has no row with red=seven' convert --select red=seven little.ply
printf '%b' "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nend_header\n\xcd\xcc\xcc\x3d\0\0\0\0\0\0\0\0\0\0\0\x3f" >tenths.ply
reads '0' --select x=0.1 --columns y, --box 0,1 tenths.ply # as a float32, which a file of floats has
refuses 'is not a unit vector' angular big.ply
refuses 'is truncated: 1 vertices are not there' angular <(head -c -20 little.ply)
refuses 'line 13: 3 columns, where the header names 4' angular <(sed 's/^1 8 0 0/1 8 0/' ascii.ply)
refuses 'a property of vertices that is no number' angular <(sed 's/uchar red/list uchar int red/' ascii.ply)
refuses 'vertices must be the first element' angular <(sed 's/element vertex/element camera/' ascii.ply)
refuses 'ends inside the header of PLY' angular <(head -n 5 ascii.ply)
refuses 'a format of PLY that is not known' angular <(sed 's/ascii/text/' ascii.ply)

# ---- vertices of OBJ, whatever stands before them
for first in '' '# Blender\no Sphere\n' 'o Sphere\n' 'g\n' 'g default lid\r\n' 's off\n' 's 1\n' 'mtllib cube.mtl\n' 'usemtl red\n' \
    'vn 0 0 1\n' 'vt .5 .5\n' '\n\n# made by hand\n\n#\no a\n\ng b\n# 2 vertices\ns 1\n'; do
    printf '%b' "${first}v 0 0 1\nvt 1 0\n# more\nv\t0 1.0  0 0.5 0.5 0.5\ng c\nv 1 0 0 1\r\n\nl 1 2\nf 1//1 2//1 3//1" >mesh.obj
    reads '0 0 1|0 1 0|1 0 0' mesh.obj
    reads '0 0 1|0 1 0|1 0 0' <(cat mesh.obj)
done
reads '0 0 1|0 0 -1' "$folder/blender_no_materials.obj"
reads '0.5 0.5 0.75|0.5 0.5 0.25' -d 3 --box -2,2 "$folder/blender_no_materials.obj"
powers '0 2 0 2' angular -l 4 "$folder/blender_no_materials.obj" # (1 + (-1)^l)^2 / 2
refuses 'line 3: a vertex of OBJ is v and three numbers' convert <(printf 'o a\nv 0 0 1\nv 0 1\n')
refuses 'is an OBJ file without vertices' convert <(printf 'o a\nvn 0 0 1\nf 1 2 3\n')
refuses 'names columns (x,y), and obj has no names' convert --columns x,y mesh.obj
reads '0.1 0.2 0.3' --columns o,g,s <(printf 'o g s\n.1 .2 .3\n')

# ---- formats that are not read: one sentence with the name and what would do
foreign() { # NAME;PART BYTES
    local advice=${1#*;} name=${1%%;*}
    printf '%b' "$2" >foreign
    refuses "foreign is $name, which is not read;$advice" convert foreign
}
foreign 'an HDF5 file;numpy.save' '\x89HDF\r\n\x1a\n0'
foreign 'a NetCDF file;numpy.save' 'CDF\x01'
foreign 'a FITS file;numpy.save' 'SIMPLE  =                    T'
foreign 'a Parquet file;CSV' PAR1
foreign 'a VTK file;x y z on a line' '# vtk DataFile Version 3.0\n'
foreign 'a VTK file;x y z on a line' '<VTKFile type="PolyData">\n'
foreign 'an XML file;CSV' '<?xml version="1.0"?>\n'
foreign 'an OFF file;x y z on a line' 'OFF\n1 0 0\n0 0 1\n'
foreign 'an OFF file;x y z on a line' '# mesh\nCOFF \n1 0 0\n'
foreign 'a JSON file;CSV' '{"points": [[0.1, 0.2]]}\n'
foreign 'a JSON file;CSV' '[[0.1, 0.2], [0.3, 0.4]]\n'
foreign 'a JSON file;CSV' '{\n'
# ---- simulations, clouds and packed files: what to run stands in the sentence
atoms() { # NAME;FORMAT BYTES: from a file, and from standard input
    foreign "${1%;*} file; ase convert -i ${1#*;} FILE atoms.xyz makes extended XYZ" "$2"
    ! "$program" convert - <foreign >out 2>err || complain "$1 is read from standard input"
    [[ $(<err) == *"standard input is ${1%;*} file, which is not read; ase convert "* ]] || complain "$1, standard input: $(<err)"
}
atoms 'a PDB;proteindatabank' 'CRYST1   10.000   20.000   20.000  90.00  90.00  90.00 P 1\nATOM      1   Na MOL     1       1.000   2.000   3.000  1.00  0.00          NA  \nEND\n'
atoms 'a PDB;proteindatabank' 'HEADER    HYDROLASE                               04-FEB-96   4HHB\nTITLE     A, B\nREMARK   4\n'
atoms 'a PDB;proteindatabank' 'REMARK original generated coordinate pdb file\r\nATOM      1  N   ALA A   1      11.104   6.134  -6.504\r\n'
atoms 'a PDB;proteindatabank' 'ATOM      1  N   ALA A   1      11.104   6.134  -6.504\nTER\n'
atoms 'a CIF;cif' 'data_image0\n_chemical_formula_sum   "Na1 Cl1"\n_cell_length_a  10.0\n'
atoms 'a CIF;cif' '# made by hand\n\ndata_4HHB\r\n# \r\nloop_\r\n_atom_site.id\r\n'
vasp='10 0 0\n0 20.0 0\n 0 0 20\n'
atoms 'a POSCAR;vasp' "Na Cl\\n 1.0\\n${vasp} Na Cl\\n 1 1\\nCartesian\\n 1 2 3\\n"
atoms 'a POSCAR;vasp' "cubic, two atoms\\n-4000\\n${vasp}1 1\\nSelective dynamics\\nDirect\\n .1 .1 .15 T T F\\n"
atoms 'a POSCAR;vasp' "# a title\\n1.0\\n${vasp}Si\\n2\\ndirect\\n0 0 0\\n.5 .5 .5\\n"
water='    1SOL     OW    1   0.100   0.200  -0.300\n'
atoms 'a GROMACS;gromacs' "Water, t= 0.0\\n    1\\n$water   1.0 2.0 2.0\\n"
atoms 'a GROMACS;gromacs' "# water\\n1\\n    1SOL    OW1    1   0.12639   1.62425-100.67991  0.1227 -0.0580  0.0434\\n   1.0 2.0 2.0\\n"
# what ASE 3.26 makes of the first file, but for columns
reads '0.1 0.1 0.15' <(printf '1\nLattice="10.0 0.0 0.0 0.0 20.0 0.0 0.0 0.0 20.0" Properties=species:S:1:pos:R:3:residuenames:S:1 pbc="T T T"\nNa       1.00000000       2.00000000       3.00000000 MOL\n')
# tried COMMAND FILE NAME: it is refused as what has that name, and COMMAND, which the sentence has, is run into tried.out
tried() {
    refuses "is ${3-}" convert "$2"
    [[ $(<err) == *"$1"* ]] || complain "not \"$1\": $(<err)"
    checked=$((checked + 1))
    pointspec() { "$program" "$@" --engine host_direct -k 4; }
    [[ $1 != *convert* ]] || pointspec() { "$program" "$@"; }
    eval "${1//FILE/$2}" >tried.out 2>err || complain "$1: $(<err)"
}
pcd='VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA'
# shellcheck disable=SC2016 # the text of awk
ascii='awk '\''/^DATA ascii/ { on = 1; next } on { print $1, $2, $3 }'\'' FILE | pointspec convert -'
printf '%b' "# .PCD v0.7 - Point Cloud Data file format\\n$pcd ascii\\n.1 .2 .3\\n.4 .5 .6\\n" >cloud.pcd
tried "$ascii" cloud.pcd 'a PCD file'
[[ $(<tried.out) == $'0.1 0.2 0.3\n0.4 0.5 0.6' ]] || complain "of PCD: $(<tried.out)"
foreign 'a PCD file; awk ;pcl_pcd2ply FILE points.ply' "$pcd binary\\n\\x80\\0\\x81"
foreign 'a PCD file' "${pcd#*n}"
printf '.1 .2\n.3 .4\n' >plain.txt
for packer in xz:an bzip2:a zstd:a; do
    command -v "${packer%:*}" >/dev/null || continue
    "${packer%:*}" -c <plain.txt >packed
    tried "${packer%:*} -dc FILE | pointspec power -" packed "${packer#*:} ${packer%:*} file"
    "$program" power -k 4 --engine host_direct plain.txt | grep -v '^#' | cmp -s - <(grep -v '^#' tried.out) || complain "$packer: other powers"
done
foreign 'an xz file' '\xfd7zXZ\0\0\x04'
foreign 'a zstd file' '\x28\xb5\x2f\xfd\x04'
foreign 'a bzip2 file' 'BZh11AY&SY\x86'
foreign 'a bzip2 file' 'BZh9\x17\x72\x45\x38\x50\x90\0\0\0\0'
# texts that are none of these
reads '0.1|0.2' <(printf 'data_x\n.1\n.2\n')
reads '0.1|0.3' <(printf 'TITLE\n.1\n.3\n')
reads '0.1 0.2' --columns ATOM,TER <(printf 'ATOM TER\n.1 .2\n')
reads '0.1 0.2' --columns BZh9,BZ <(printf 'BZh9 BZ\n.1 .2\n')
reads '0.1 0.2|0.3 0.4|0.5 0.6|0.7 0.8' <(printf '4\n.1 .2\n.3 .4\n.5 .6\n.7 .8\n')
reads '0.1 0.2 0.3|0.4 0.5 0.6|0.7 0.8 0.9' -d 3 <(printf '3\n.1 .2 .3\n.4 .5 .6\n.7 .8 .9\n1 1\n')
foreign 'a PNG image;no pictures' '\x89PNG\r\n'
foreign 'a JPEG image;no pictures' '\xff\xd8\xff\xe0'
foreign 'a TIFF image;no pictures' 'II*\0'
foreign 'an EXR image;no pictures' 'v/1\x01'
foreign 'a Radiance image;no pictures' '#?RADIANCE\n'
foreign 'a PFM image;no pictures' 'PF\n2 2\n'
foreign 'a PBM image;no pictures' 'P1\n# CREATOR: GIMP\n# 24 7\n24 7\n0 0 1 0\n'
foreign 'a PGM image;no pictures' 'P2 4 4 255\n0 0 0 0\n'
foreign 'a PPM image;no pictures' 'P3\r\n4 4\r\n255\r\n0 0 0\r\n'
foreign 'a PBM image;no pictures' 'P4\n16 1\n\0\0'
foreign 'a PGM image;no pictures' 'P5\n4 4\n255\n\1\2'
foreign 'a PPM image;no pictures' 'P6\n4 4\n255\n\1\2'
foreign 'a BMP image;no pictures' 'BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0'
foreign 'an SVG image;no pictures' '<svg width="4">\n'
foreign 'an SVG image;no pictures' '<?xml version="1.0"?>\n<!-- drawn -->\n<svg width="4">\n'
foreign 'an XML file;CSV' '<?xml version="1.0"?>\n<vector>\n'
reads '0.1 0.2' <(printf '# a comment\n.1 .2\n')
reads '0.1' <(printf 'P\n.1\n')
reads '0.1|0.2' <(printf 'P5\n.1\n.2\n')
reads '0.2|0.4' <(printf 'P5\n0 .2\n1 .4\n')
reads '0|0.5' --box 0,24 <(printf 'P2\n0 0\n1 12\n')
reads '0.1 0.2' <(printf 'P1,P2\n.1,.2\n')
reads '0.1 0.2' <(printf 'P1 P2\n.1 .2\n')
reads '0.1 0.2' --columns BMI,BM <(printf 'BM,BMI\n.2,.1\n')

[[ $bad == 0 ]] || exit 1
echo "cli_field: $checked files"

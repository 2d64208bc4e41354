#!/usr/bin/env bash
# cli_formats.sh PROGRAM: files as other tools write them, made here byte by byte, and the points that
# come out; and files that could be two things, refused with the options that settle it.
set -euo pipefail
program=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

checked=0 bad=0
complain() { # LINE...
    printf '%s\n' "$@" >&2
    bad=1
}
# file NAME TEXT: TEXT with escapes as printf %b takes them.
file() {
    printf '%b' "$2" >"$1"
}
# reads "LINE|LINE..." ARGS...: the text that comes out.
reads() {
    local expected=$1 code=0
    shift
    "$program" convert "$@" </dev/null >out 2>err || code=$?
    checked=$((checked + 1))
    [[ $code == 0 && $(tr '\n' '|' <out) == "$expected|" ]] ||
        complain "exit $code: convert $*: $(tr '\n' '|' <out), not $expected" "    $(<err)"
}
# near "LINE|LINE..." ARGS...: the same with 6 decimals, for what is computed.
near() {
    local expected=$1 code=0 said
    shift
    "$program" convert "$@" </dev/null 2>err |
        awk '/^#/ { print; next } { for (i = 1; i <= NF; i++) { $i = sprintf("%.6f", $i + 0); sub(/^-0.000000$/, "0.000000", $i) }
             print }' >out || code=$?
    said=$(tr '\n' '|' <out)
    checked=$((checked + 1))
    [[ $code == 0 && $said == "$expected|" ]] ||
        complain "exit $code: convert $*: $said, not $expected" "    $(<err)"
}
# refuses PART[;PART...] ARGS...: exit 2 and one line with these parts.
refuses() {
    local parts part code=0
    IFS=';' read -ra parts <<<"$1"
    shift
    "$program" convert "$@" </dev/null >out 2>err || code=$?
    checked=$((checked + 1))
    [[ $code == 2 && $(wc -l <err) == 1 ]] || complain "exit $code: convert $*" "    $(<err)"
    for part in "${parts[@]}"; do
        [[ $(<err) == *"$part"* ]] || complain "\"$part\" is missing: convert $*" "    $(<err)"
    done
}

# ---- UTK text: sets, marks in front, a mark at the end, CR LF, tabs, no end of line
square='0.5 0.25|0.75 0.125'
file utk.dat '0.5 0.25\n0.75 0.125\n'
file sets.dat '#\n# two\n0.5 0.25\n0.75 0.125\n#\n0 0.5\n#\n'
file loose.dat '0.5\t0.25\r\n 0.75   0.125 '
file blank.dat '0.5 0.25\n\n0.75 0.125\n'
reads "$square" utk.dat
reads "$square|#|0 0.5" sets.dat
reads "$square" loose.dat
refuses 'line 2: a blank line;sets are separated by a' blank.dat
# pbrt: stdin.dat is text, stdin.binary float32 pairs; the number of points comes with both
reads "$square" -n 2 utk.dat
refuses 'set 2 has 1 point, but 2 are asked for' -n 2 sets.dat -o none

# ---- UTK binary: every type, sets, repeated sets, long double
word() { printf '\\x%02x' $(($1 & 255)) $(($1 >> 8 & 255)) $(($1 >> 16 & 255)) $(($1 >> 24 & 255)); }
header() { # TYPE SETS POINTS DIMENSION
    printf 'UTK!\\x%02x\\0\\0\\0%s%s%s' "$1" "$(word "$2")" "$(word "$3")" "$(word "$4")"
}
zero4='\0\0\0\0' zero8='\0\0\0\0\0\0\0\0'
half='\0\0\0\0\0\0\xe0\x3f' quarter='\0\0\0\0\0\0\xd0\x3f' # float64
half4='\0\0\0\x3f' quarter4='\0\0\x80\x3e'                 # float32
minus4='\xff\xff\xff\xff'
for type in 0 2; do file whole$type.bin "$(header $type 1 2 1)$zero4$zero4"; done
for type in 1 3; do file whole$type.bin "$(header $type 1 2 1)$zero8$zero8"; done
for type in 0 1 2 3; do reads '0.0|0' whole$type.bin; done
file int32.bin "$(header 0 1 3 3)$(word 1)$zero4$zero4$zero4$minus4$zero4$zero4$zero4$(word 1)"
file uint64.bin "$(header 3 1 1 3)$zero8$zero8\1\0\0\0\0\0\0\0"
file uint32.bin "$(header 2 1 1 1)$minus4"
file float32.bin "$(header 4 1 2 2)$half4$quarter4$quarter4$half4"
file double.bin "$(header 5 2 1 2)$half$quarter$quarter$half"
file repeated.bin "$(header 5 2 1 2)$half$quarter$half$quarter"
file long.bin "$(header 5 1 1 1)$zero8$zero8"
file short.bin "$(header 5 2 1 1)$zero8"
file future.bin "$(header 6 1 1 1)$zero8"
reads '1 0 0|0 -1 0|0 0 1' int32.bin # -1 in a signed type, and not scaled
reads '0 0 1' uint64.bin
refuses 'coordinate 4294967295 is outside [0,1)' uint32.bin
reads '0.5 0.25|0.25 0.5' float32.bin
reads '0.5 0.25|#|0.25 0.5' double.bin
refuses 'set 2 repeats set 1;UTK 2.0.1;--select-sets 1;1..2' repeated.bin
reads '0.5 0.25' --select-sets 1 repeated.bin
reads '0.5 0.25|#|0.5 0.25' --select-sets 1..2 repeated.bin
refuses '16 bytes (long double)' long.bin
refuses 'is truncated' short.bin
refuses 'type 6' future.bin

# ---- PSA text and GBN
file psa.txt '2\n0.5 0.25\n0.75 0.125\n'
file one_line.txt '2 0.5 0.25 0.75 0.125\n'
file few_lines.txt '3\n0.5 0.25 0.75\n0.125 0 0.5\n'
file extra.txt '2\n0.5 0.25\n0.75 0.125\n0.9 0.9\n'
file gbnw.txt '2\n0.5 0.25 3\n0.75 0.125 -1\n'
file gbn3.txt '2 3\n0.5 0.25 0.125\n0.75 0.125 0\n'
file gbn1.txt '2 1\n0.5\n0.75\n'
file gbn_or_point.txt '2 2\n0.5 0.25\n0.75 0.125\n'
file promised.txt '3\n0.5 0.25\n0.75 0.125\n'
reads "$square" psa.txt
reads "$square" --input-format psa-text one_line.txt
reads "$square|0 0.5" --input-format psa-text --columns xy few_lines.txt
reads "$square" extra.txt
reads '0.5 0.25 3|0.75 0.125 -1' --columns xyw gbnw.txt
reads '0.5 0.25 3|0.75 0.125 -1' --weights column gbnw.txt
reads "$square" --columns xyw --weights equal gbnw.txt
reads '0.5 0.25 0.125|0.75 0.125 0' gbn3.txt
reads '0.5|0.75' gbn1.txt
reads "$square" gbn_or_point.txt
reads "$square" --input-format gbn --wrap gbn_or_point.txt
reads "0 0|$square" --input-format utk-text --wrap gbn_or_point.txt
refuses 'promises 3 points, and point 3 is not there' promised.txt

# ---- PSA raw, pbrt's binary, EPS
file points.rps "$half4$quarter4$quarter4$half4"
cp points.rps stdin.binary
cp points.rps unnamed
file odd.rps "$half4$quarter4$half4"
file points.eps '%!PS-Adobe-3.0 EPSF-3.0\n/p { 0 360 arc fill } def\n500 500 scale\n0.5 0.25 p\n0.75 0.125 p\nshowpage\n'
reads '0.5 0.25|0.25 0.5' points.rps
reads '0.5 0.25|#|0.25 0.5' -n 1 points.rps
reads '0.5|0.25|0.25|0.5' -d 1 points.rps
reads '0.5 0.25|#|0.25 0.5' -n 1 stdin.binary
reads '0.5 0.25|0.25 0.5' --input-format rps unnamed
refuses 'not whole sets of 3' -n 3 points.rps
refuses 'not whole points' odd.rps
reads "$square" points.eps

# ---- pbrt's pspec: tokens
file pts-a '0 0 0.5 0.5\n'
file tokens.dat '0 0 0.5 0.5\n#\n0.25 0\n0.75\n0.5\n'
refuses 'pts-a, line 1: 4 numbers and no other line: one point, or one after the other?;-d' pts-a
reads '0 0 0.5 0.5' --quiet -d 4 pts-a
reads '0 0|0.5 0.5' -d 2 pts-a
reads '0.0|0|0.5|0.5' -d 1 pts-a
reads '0 0|0.5 0.5|#|0.25 0|0.75 0.5' -d 2 tokens.dat
refuses 'set 1, row 1' --columns xyz --domain sphere <(printf '0 0 2 0 1 0\n') -o none

# ---- deepsampling: bare text of 6 decimals, or numpy's %.18e
file pcf.txt '0.500000 0.250000\n7.500000000000000000e-01 1.250000000000000000e-01\n'
reads "$square" pcf.txt

# ---- the sphere: P15, Womersley, Sloane
file random_000001.txt '0 0 1\n0.6 0 0.8\n'
file printed_000002.txt '0.577350 0.577350 0.577350\n-0.577350 0.577350 -0.577350\n'
file sf003.00004 '0 0 1\n0.94280904158206336 0 -0.33333333333333333\n'
file md001.00002 ' 0 0 1 6.2831853071795862\n 0 0 -1 6.2831853071795862\n'
file des3-12-5.txt '0,0,1\n0.6,0,-0.8\n'
file longer.txt '0 0 2\n3 0 4\n'
reads '0 0 1|0.6 0 0.8' random_000001.txt
near '0.577350 0.577350 0.577350|-0.577350 0.577350 -0.577350' printed_000002.txt
near '0.000000 0.000000 1.000000|0.942809 0.000000 -0.333333' sf003.00004
reads '0 0 1 6.283185307179586|0 0 -1 6.283185307179586' md001.00002
reads '0 0 1|0 0 -1' --weights equal md001.00002
reads '0 0 1|0.6 0 -0.8' des3-12-5.txt
refuses 'line 1;not a unit vector; --normalize-vectors would' --domain sphere longer.txt
near '0.000000 0.000000 1.000000|0.600000 0.000000 0.800000' --normalize-vectors longer.txt
refuses 'a unit vector? --wrap is about points of the torus; -d 3' --wrap random_000001.txt

# ---- angles: openquad, Graef, healpix
npy() { # SHAPE DATA: version 1.0, float64, C order
    local text="{'descr': '<f8', 'fortran_order': False, 'shape': $1, }"
    text=$(printf '%-117s' "$text")
    printf '\\x93NUMPY\\1\\0\\x76\\0%s\\n%s' "$text" "$2"
}
eight() { printf '%s' "$1$1$1$1$1$1$1$1"; }
file gauss.npy "$(npy '(3, 8)' "$(eight "$zero8")$(eight "$zero8")$(eight "$half")")"
file quad.npy "$(npy '(2, 8)' "$(eight "$half")$(eight "$quarter")")"
file square.npy "$(npy '(2, 2)' "$half$quarter$quarter$zero8")"
file torus.npy "$(npy '(1, 2, 2)' "$half$quarter$quarter$zero8")"
file weighted.npy "$(npy '(2, 3)' "$half$quarter$quarter$zero8$half$half")"
# Rows of (2, N) and (3, N) may be coordinates, too: nothing but the options, or unit vectors, tell.
poles='0 0 1 0.5|0 0 1 0.5|0 0 1 0.5|0 0 1 0.5|0 0 1 0.5|0 0 1 0.5|0 0 1 0.5|0 0 1 0.5'
many() { printf "$1|%.0s" 1 2 3 4 5 6 7; printf '%s' "$1"; }
refuses 'no unit vectors;--transpose or --columns theta-phi-w' gauss.npy
reads "$poles" --columns theta-phi-w gauss.npy
reads "$poles" --input-format openquad gauss.npy
reads "$(many '0 0 0.5')" --transpose gauss.npy
reads "$(many '0 0 0.5')" --columns xyz gauss.npy
reads "$(many '0 0 0.5')" -d 3 gauss.npy
refuses 'shape (2, 8): are its columns points of the plane, or its rows angles?;--transpose;--columns theta-phi, phi-theta or lon-lat' quad.npy
refuses 'shape (2, 8): are its columns points of the plane' --domain sphere quad.npy
refuses 'shape (2, 8): are its columns the points? --transpose' --domain torus quad.npy
reads "$(many '0.5 0.25')" --transpose quad.npy
reads "$(many '0.5 0.25')" -d 2 quad.npy
reads '0.5 0.25' --select-points 8 --columns theta-phi --to-columns theta-phi quad.npy
reads '0.25 0.5' --select-points 8 --columns theta-phi --to-columns phi-theta quad.npy
reads '0.5 0.25' --select-points 8 --columns phi-theta --to-columns phi-theta quad.npy
refuses 'are its rows the points, or its columns?;--input-format npy or --transpose, or openquad' square.npy
reads '0.5 0.25|0.25 0' --input-format npy square.npy
reads '0.5 0.25|0.25 0' --transpose <(cat square.npy) # a symmetric array
refuses '--input-format npy or --transpose' --domain torus square.npy
refuses '--input-format npy or --transpose' -d 2 square.npy
reads '0.5 0.25|0.25 0' --input-format openquad --to-columns theta-phi square.npy
reads '0.5 0.25|0.25 0' torus.npy
refuses 'shape (1, 2, 2): --transpose is for arrays of two axes' --transpose torus.npy
refuses '--transpose is for arrays, and this is utk-text' --transpose utk.dat
refuses '--transpose does not go with openquad' --transpose --input-format openquad square.npy
refuses '--input-format npy or --transpose' weighted.npy
reads '0.5 0.25 0.25|0 0.5 0.5' --columns xyw weighted.npy
reads '0.5 0|0.25 0.5|0.25 0.5' --transpose weighted.npy
refuses '3 columns, but the dimension asked for is 2' -d 2 weighted.npy
one='\0\0\0\0\0\0\xf0\x3f' minus='\0\0\0\0\0\0\xf0\xbf' o=$zero8
file axes.npy "$(npy '(3, 8)' "$one$minus$o$o$o$o$one$o$o$o$one$minus$o$o$o$one$o$o$o$o$one$minus$o$o")"
file bent.npy "$(npy '(3, 8)' "$one$minus$o$o$o$o$one$o$o$o$one$minus$o$o$o$one$o$o$o$o$one$minus$o$half")"
axes='1 0 0|-1 0 0|0 1 0|0 -1 0|0 0 1|0 0 -1|1 0 0|0 1 0'
reads "$axes" axes.npy
reads "$axes" --domain sphere axes.npy
reads "$axes" <(cat axes.npy)
refuses 'set 1, row 8: (0, 1, 0.5) is not a unit vector;--transpose reads other points, --columns theta-phi-w' bent.npy -o none
file graef.dat '0 0\n1.5707963267948966 1.5707963267948966\n'
file healpix.txt '0 90\n90 0\n180 0\n270 -90\n'
refuses '2 columns; which angles are they?;theta-phi, phi-theta or lon-lat' --domain sphere graef.dat
near '0.000000 0.000000 1.000000|0.000000 1.000000 0.000000' --columns phi-theta graef.dat
reads '0 0|1.5707963267948966 1.5707963267948966' --columns phi-theta --to-columns theta-phi graef.dat
near '0.000000 0.000000 1.000000|0.000000 1.000000 0.000000|-1.000000 0.000000 0.000000|0.000000 0.000000 -1.000000' \
    --columns lon-lat healpix.txt
refuses 'line 3: 180, 0 are not theta (0 to pi)' --columns theta-phi <(sed '1,2s/.*/0 0/' healpix.txt) -o none
refuses 'coordinate 90 is outside [0,1)' healpix.txt

# ---- UTK edat: corners of the domain and its toricity before every set, or nothing at all
file corners.edat '-1 -1\n1 1\n0\n0 -0.5\n0.5 -0.75\n'
file weights.edat '0 0\n1 1\n1\n0.5 0.25 0.5\n0.75 0.125 0.25\n'
file wrong.edat '1 1\n0 0\n1\n0.5 0.25\n'
file toricity.edat '0.0\t0.0\n1.0\t1.0\n1\n0.375\t0.1875\n0.75\t0.5625\n0.125\t0.8125\n0.5\t0.4375\n'
file two_sets.edat '0 0\n1 1\n1\n0.1 0.2\n0.6 0.7\n#\n0 0\n1 1\n1\n0.3 0.4\n0.8 0.9\n'
file no_header.edat '0.10\t0.20\n0.90\t0.95\n0.5\t0.4\n0.7\t0.6\n'
file no_toricity.edat '0 0\n1 1\n0.5 0.25\n'
reads "$square" corners.edat
reads '0.375 0.1875|0.75 0.5625|0.125 0.8125|0.5 0.4375' toricity.edat
reads '0.1 0.2|0.6 0.7|#|0.3 0.4|0.8 0.9' two_sets.edat
reads '0 0|1 1|1|0.1 0.2|0.6 0.7|#|0 0|1 1|1|0.3 0.4|0.8 0.9' --format edat two_sets.edat
reads '0.1 0.2|0.9 0.95|0.5 0.4|0.7 0.6' no_header.edat
refuses 'set 1 does not begin with the three lines of EDAT;--input-format utk-text' --input-format edat no_header.edat
refuses 'look like corners of a domain;--input-format utk-text' no_toricity.edat
reads '0 0|0 0|0.5 0.25' --wrap --input-format utk-text no_toricity.edat
reads '0.5 0.25 0.5|0.75 0.125 0.25' weights.edat
reads "$square" --weights equal weights.edat
refuses 'enclose nothing' wrong.edat

# ---- other boxes
file pixels.txt '256 128\n384 64\n'
file centred.txt '0 -0.5\n0.5 -0.75\n'
file nearly.txt '0.99999999999999989 -1\n'
reads "$square" --box 0,512 pixels.txt
reads "$square" --box -1,1 centred.txt
reads '0.9999999999999999 0' --box -1,1 nearly.txt # x + 1 rounds to 2
refuses 'line 2: coordinate 384 is outside [0,300) of --box; --wrap would reduce it' --box 0,300 pixels.txt -o none
reads '0.25 0.5|0.5 0' --wrap --box 1,2 <(printf '0.25 0.5\n1.5 2\n')
refuses '--box: 1,1 is no interval: X0 must be below X1' --box 1,1 pixels.txt
refuses '--box: 0,1e-309 is 1e-309 wide, and must be at least 1e-300' --box 0,1e-309 pixels.txt
refuses '--box: -1e-308,1e-308 is 2e-308 wide, and must be at least 1e-300' --box -1e-308,1e-308 pixels.txt
refuses '--box: "1" has 1 number; an interval of all axes has two, X0,X1' --box 1 pixels.txt
refuses '--box: "0,8,0" has 3 numbers;the axes may have one each, X0,X1,Y0,Y1' --box 0,8,0 pixels.txt
refuses 'has 14 numbers' --box 0,8,0,8,0,8,0,8,0,8,0,8,0,8 pixels.txt
refuses '--box: 0,8,4,0 is no interval: Y0 must be below Y1' --box 0,8,4,0 pixels.txt
refuses '--box has 3 intervals, and points of 2 coordinates need one of all axes, or 2' --box 0,8,0,4,0,2 pixels.txt
reads '0.25 0.5|0.75 0.125' --box 0,512,-256,768 <(printf '128 256\n384 -128\n')
reads '0.25 0.5 3' --box 0,512,0,8 --columns xyw <(printf '128 4 3\n')
reads '0.25 0.5' --wrap --box 0,512,0,8 <(printf -- '-384 12\n')
refuses 'line 2: coordinate 9 is outside [0,8) of --box' --box 0,512,0,8 <(printf '128 4\n9 9\n') -o none
reads '0.5 0.5 0.5|0.25 0.25 0.5|0.25 0.5 0.625' --domain torus --box -1,3,-2,2,-4,4 int32.bin
refuses '"inf" is not a finite number' --box 0,inf pixels.txt
refuses '--box is for points of the torus, and these are of the sphere' --box 0,2 --domain sphere <(printf '0 0 1\n')
refuses 'in other units? --box X0,X1' pixels.txt

# ---- tables with names in the first line
file frame.csv ',x,y\n0,0.5,0.25\n1,0.75,0.125\n'
file wide.csv 'id;y;label;x\n1;0.25;"a;b";0.5\n2;0.125;c;0.75\n'
file decimals.csv 'x;y\n0,5;0,25\n'
file short.csv 'a,b,c\n0.5,0.25\n'
file ragged.csv ',x,y\n0,0.5,0.25\n1,0\n'
file words.csv ',x,y\n0,0.5,0.25\n1,zero,0.75\n'
file alone.csv 'x,y\n'
reads "$square" frame.csv
reads "$square" --columns x,y frame.csv
reads "$square" --columns x,y wide.csv
reads '0.25 0.5|0.125 0.75' --columns y,x wide.csv
refuses 'there is no column "z", or it is named twice; the names are "id", "y", "label", "x"' --columns x,z wide.csv
refuses 'there is no column "x", or it is named twice' --columns x,x wide.csv
# a list of names ends behind a whole name, of any alphabet
long=$(printf 'a\u00e9%.0s' {1..50})
file long.csv "$long,$long,x\n0.5,0.25,0.125\n"
refuses "the names are \"$long\", and more" --columns x,z long.csv
file longest.csv "$long$long,x\n0.5,0.25\n"
refuses 'the names are too long to be shown' --columns x,z longest.csv
refuses 'a comma in a number; decimals are written with a point' decimals.csv
refuses 'line 1: 3 names of columns, but the line after it has 2' short.csv
refuses 'ragged.csv, line 3: 2 columns, where the header names 3' ragged.csv
refuses 'words.csv, line 3: "zero" is not a number' words.csv
refuses 'alone.csv, line 1: "x" is not a number' alone.csv
refuses 'names columns (x,y), and the first line has no names' --columns x,y utk.dat
refuses 'and npy has no names' --columns x,y torus.npy
# a column without a name is an index: text, or the rows counted from 0 or 1 on, of the file or of a set
file three.csv 'x,y\n0.5,0.25,0.125\n0.75,0.125,0\n'
file unnamed.csv ',x,y\n3,0.5,0.25\n7,0.75,0.125\n'
file zeros.csv ',x,y\n0,0.5,0.25\n0,0.75,0.125\n'
file from_1.csv 'x,y\n1,0.5,0.25\n2,0.75,0.125\n#\n1,0,0.5\n#\n2,0.5,0\n'
file text_index.csv 'x,y\na,0.5,0.25\nb,0.75,0.125\n'
file text_ends.csv 'x,y\na,0.5,0.25\n3,0.75,0.125\n'
file quoted_index.txt '"x" "y"\n"3" 0.5 0.25\n"7" 0.75 0.125\n'
refuses 'three.csv, line 2: "0.5" in a column without a name;names 2 of 3 columns' three.csv
refuses 'three.csv, line 2: "0.5" in a column without a name;names 2 of 3 columns' --columns x,y three.csv
refuses 'line 2: "3" in a column without a name;--columns with names' unnamed.csv
reads "$square" --columns x,y unnamed.csv
refuses 'line 3: "0" in a column without a name' zeros.csv -o none
reads "$square|#|0 0.5|#|0.5 0" from_1.csv
reads "$square" text_index.csv
refuses 'line 3: "3" in a column without a name' text_ends.csv -o none
reads "$square" quoted_index.txt
# labels that nobody gave, 0,1 and so on, or a first point: rows of decimals leave it open
file labels.csv '0,1\n0.5,0.25\n0.75,0.125\n'
file label.txt '0\n0.5\n#\n0.75\n'
file zero_again.txt '0\n0.5\n#\n0\n'
file zero_point.txt '0.0\n0.5\n'
file labels3.txt '0 1 2\n0.5 0.25 0.125\n'
refuses 'labels.csv, line 1: labels of columns, or a point?;--header yes or no' labels.csv
refuses '--header yes or no' --wrap labels.csv
refuses '--header yes or no' --normalize-vectors labels3.txt
reads "$square" --header yes labels.csv
reads '0.25 0.5|0.125 0.75' --columns 1,0 labels.csv
reads "0 0|$square" --wrap --header no labels.csv
refuses 'coordinate 1 is outside' --header no labels.csv
refuses 'label.txt, line 1: labels of columns, or a point?' label.txt
reads '0.5|#|0.75' --header yes label.txt
reads '0.0|0.5|#|0.75' --header no label.txt # which is read without the option
reads '0.0|0.5|#|0' zero_again.txt
reads '0.0|0.5' zero_point.txt
reads '0.75 0.125' --header yes -d 2 utk.dat
refuses '--header yes is about names of columns, and npy has no names' --header yes torus.npy
refuses '--header: "maybe" is not one of yes, no' --header maybe labels.csv
"$program" sample --sampler sobol -d 1 -n 4 -m 2 >first
reads "$(tr '\n' '|' <first | sed 's/|$//')" first
[[ $(head -n 1 first) == 0.0 ]] || complain "the first point of sobol is $(head -n 1 first)"
# names that count are coordinates; others could be anything
file radii.txt 'x y r\n0.5 0.25 0.125\n'
file counted.csv 'x9,x10,x11\n0.5,0.25,0.125\n'
file letters.csv 'px,py\n0.5,0.25\n'
file sky.csv 'alpha,delta\n0.5,0.25\n'
file uvw.csv 'u,v,w\n0.5,0.25,0.125\n'
for name in radii.txt sky.csv uvw.csv; do refuses "$name, line 1: are these all coordinates?;--columns" $name; done
refuses '"x" is not a number' --header no radii.txt
reads '0.5 0.25 0.125' --columns x,y,r radii.txt
reads '0.5 0.25' --columns x,y radii.txt
reads '0.5 0.25 0.125' -d 3 radii.txt
reads '0.5 0.25 0.125' --quiet --columns xyw radii.txt
reads '0.5 0.25 0.125' --quiet --weights column radii.txt
reads '0.5 0.25 0.125' counted.csv
reads '0.5 0.25' letters.csv
"$1" power -k 2 --engine host_direct frame.csv >table.csv 2>err || { echo "cli_formats: power refuses the table of a data frame: $(<err)" && bad=1; }
grep -q '^# input_columns: xy (columns x,y)$' table.csv || { echo "cli_formats: $(grep input_ table.csv)" && bad=1; }

# ---- what is nothing of all that
file picture.txt 'GIF89a\1\0\n'
cp utk.dat text.bin
cp double.bin double.npy
refuses 'is a GIF image, which is not read' picture.txt
refuses 'neither text nor begins like a format that is known;--input-format rps' <(printf '\x8aPIC\1\n')
refuses 'ends in .bin, but does not begin like utk-binary;--input-format' text.bin
reads "$square" --input-format utk-text text.bin
reads '0.5 0.25|#|0.25 0.5' double.npy # what it begins with counts, not its name
head -c 20 <(gzip -c utk.dat) >cut.gz
refuses 'cut.gz' cut.gz
printf 'x' | gzip -c >word.gz
refuses '"x" is not a number' word.gz

echo "cli_formats: $checked conversions"
exit $bad

#!/usr/bin/env bash
# make_corpus.sh: writes the seeds of all fuzz targets into corpus/TARGET/seed-*. Files of other names
# there are inputs that once broke something, and stay. The option bytes in front of point files are
# explained in points.c.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
corpus=$PWD/corpus

# seed TARGET NAME OPTIONS: OPTIONS, in the notation of printf, and then standard input
seed() {
    mkdir -p "$corpus/$1"
    { printf '%b' "$3"; cat; } >"$corpus/$1/seed-$2"
}
# The six bytes of options: FLAGS COLUMNS MORE POINTS_PER_SET SETS BLOCK, two hexadecimal digits each
options() {
    printf '\\x%s' "$@"
}
torus=$(options 00 00 00 00 00 01)
sphere=$(options 01 00 20 00 00 00)
any=$(options 02 00 28 00 00 02) # blocks through a pipe, counts told
weights=$(options 04 00 10 00 00 00)
wrap=$(options 12 00 00 00 00 03)
normalize=$(options 22 00 08 00 00 00)
second=$(options 00 00 08 02 22 01) # only set 2, sets of two points
theta_phi=$(options 43 05 20 00 00 01)
lon_lat=$(options 03 0a 20 00 00 01) # with weights
degrees=$(options 43 0e 20 00 00 01) # phi-theta-w, angles are kept

# Little-endian numbers as bytes
f64() { perl -e 'print pack("d<*", @ARGV)' -- "$@"; }
f32() { perl -e 'print pack("f<*", @ARGV)' -- "$@"; }
u32() { perl -e 'print pack("V*", @ARGV)' -- "$@"; }

# npy DESCR FORTRAN SHAPE: a header of version 1
npy() {
    local text="{'descr': '$1', 'fortran_order': $2, 'shape': ($3), }"
    perl -e 'my $text = $ARGV[0]; $text .= " " while (length($text) + 11) % 64;
        print "\x93NUMPY\x01\x00", pack("v", length($text) + 1), $text, "\n"' "$text"
}
utk() { # TYPE SETS POINTS DIMENSION
    printf 'UTK!%b\0\0\0' "\\x0$1"
    u32 "$2" "$3" "$4"
}

# ---- text ------------------------------------------------------------------------------------

points='0.5 0.25\n1e-3 0.75\n0 0.33333333333333331\n'
printf '%b' "$points" | seed utk-text plane "$torus"
printf '%b#\n%b' "$points" '0.1 0.2\n' | seed utk-text sets "$any"
printf '# comment\r\n0.5\t.5 2\r\n0.1 0.9 -1e3\r\n\r\n' | seed utk-text weights "$weights"
printf '%b#\n%b#\n' "$points" "$points" | seed utk-text second "$second"
printf -- '-0.25 7.5 1e18\n1 1 -1e-20\n' | seed utk-text wrap "$wrap"
printf '0 0 1\n0.6 0.8 0\n' | seed utk-text vectors "$sphere"
printf '0 0 2\n1e-200 0 0\n' | seed utk-text normalize "$normalize"
printf '0.5 6.2\n3.1 0\n' | seed utk-text angles "$theta_phi"
printf '180 -90 2\n-360 45.5 0.5\n' | seed utk-text degrees "$lon_lat"
printf -- '-180 90 2\n45.5 180 0.5\n' | seed utk-text polar-degrees "$degrees"
printf 'Dec_deg,RA_deg,weight\n45,200.25,1\n-3.2,10.5,2\n' | seed csv catalogue "$sphere"
printf '0.1 0.2 0.3 0.4 0.5 0.6\n' | seed utk-text six "$torus"
printf '0.1 0.2 nan\n' | seed utk-text nan "$torus"
printf '0.5 0.5\n0 1\n' | seed utk-text upper-edge "$torus"
printf '0 0 1\n1.000003 0 0\n' | seed utk-text nearly-unit "$sphere"
printf '0.5 0.5 1e400\n' | seed utk-text infinite-weight "$weights"
printf '\x1f\x7f\n' | seed utk-text control "$torus"

printf '0.5, 0.25\n1e-3,0.75\n#\n0,0.1\n' | seed csv plane "$torus"
printf '0,0,1,2.5\n0.6,0.8,0,-1\n' | seed csv vectors "$sphere"
printf '1.5,0.1\n3,6' | seed csv angles "$theta_phi"
printf '0.5,,0.25\n' | seed csv gap "$torus"
printf ',x,y\n0,0.5,0.25\n1,0,0.75\n' | seed csv index "$torus"
printf '\xef\xbb\xbf"u";"v;"\r\n0.5;0.25\r\n' | seed csv names "$torus"
printf ',0,1\n,0.5,\n' | seed csv labels "$torus"
printf '0,1\n0.5,0.25\n0.1,0.2\n' | seed csv numbered "$torus"
printf 'x,y\n1,0.5,0.25\n2,0.1,0.2\n#\n1,0,0.5\n' | seed csv rows "$torus"
printf 'x1,x10,x\n0.5,0.25,0.1\n' | seed csv similar "$torus"
printf '9,0.5,0.25\n9,0.1,0.2\n' | seed csv numbers "$(options 00 0f 00 00 00 01)"
printf 'a,y,x\n9,0.5,0.25\n\n9,0.1,0.2\n' | seed csv named-numbers "$(options 00 0f 00 00 00 01)"
printf '"0.5","0.25"\n"1D-1","0.2"\n' | seed csv quoted "$torus"
printf 'id\tx\ty\n7\t0.5\t0.25\n' | seed csv tabs "$torus"
printf '\n"x","y"\r\n\r\n\n0.5,0.25\n\n0.1,0.2\n' | seed csv blank-lines "$torus"
printf '0,5 0,25\n' | seed csv decimal-commas "$torus"
printf '0.5 6.2 3\n0.1 0 2\n' | seed utk-text numbers "$(options 43 10 20 00 00 01)"
printf '0.5,1\n0.5,0.25\n' | seed csv header "$(options 00 00 40 00 00 01)"
printf '0\n0.5\n' | seed utk-text no-header "$(options 00 00 80 00 00 01)"

printf '3\n%b' "$points" | seed psa-text plane "$torus"
printf '2\n0.5 0.25 2\n0.5 0.75 -1\nand more' | seed psa-text weights "$weights"
printf '2\n0 0 1\n0 1 0\n' | seed psa-text vectors "$(options 01 03 00 00 00 01)"
printf '2 0.5 0.25\n0.1\n\n0.2' | seed psa-text broken-lines "$any"
printf '1000000000000000\n0.5 0.5\n' | seed psa-text promise "$torus"

light='#?RADIANCE\n# a comment\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n'
printf '%b' "$light-Y 2 +X 2\nabc\200def\200\1\1\1\1ghi\0" | seed image flat '\0'
printf '%b' "$light+Y 1 -X 8\n\2\2\0\10\210a\1b\207c\204d\4efgh\210i" | seed image runs '\0'
printf '%b' "$light-Y 32767 +X 8000\nabcd" | seed image promise '\1'
{ printf 'PF\n1 2\n-1.0\n'; f32 0.5 nan 1e30 -1 0 2; } | seed image floats '\0'
{ printf 'Pf 2 1 1e0\n'; f32 0.5 0.25; } | seed image grey '\1'
printf '\x76\x2f\x31\x01' | seed image exr '\0'
printf 'v 0 0 0\nv 1 0 0 1\nv 1 1 \\\n0\nv 0 1 0\nf 1//2 2/1 -2/1/1 4\n' | seed mesh obj '\0'
printf 'camera position 0 0 -8 direction 0 0 1 up 0 1 0 focal .035 width .025\nquad a b 0 0 0 1 0 0 1 1 0 0 1 0\n' | seed mesh quad '\1'

printf '2 3\n0.1 0.2 0.3\n0.4 0.5 0.6\n' | seed gbn space "$torus"
printf '2 3\n0 0 1 1\n0 0\n' | seed gbn vectors "$sphere"
printf '2 1\n0.5\n' | seed gbn short "$any"

printf '0 0\n1 1\n1\n%b' "$points" | seed edat unit "$torus"
printf -- '-1 -2\n1 2\n0\n0.5 1.5 3\n#\n0 0\n1 1\n1\n0 0 4\n' | seed edat weights "$weights"
printf '0 0\n1e308 1e-320\n1\n0.5 0\n' | seed edat extreme "$wrap"
printf '0\n1\n1\n0.5\n#\n' | seed edat line "$torus"
printf '0 0\n1 1\n1\n0.5 0.5\n#\n0.5 0.5\n' | seed edat second-without "$any"

printf '%%!PS-Adobe\n%%%%EndComments\n500 500 scale\n0.5 0.25 p\n.1\t.2 p\r\nshowpage\n' |
    seed eps picture "$torus"
printf '%%!\n' | seed eps nothing "$any"

printf 'mpts2 2 n unit-tor\n0.1 0.2\n#patch-separator\n0.3 0.4\n' | seed utk1 sets "$torus"
printf 'mpts2 2 n unit-tor\n0 0 1\n' | seed utk1 vectors "$sphere"
printf 'mpts2 2 n unit-square\n0.1 0.2\n' | seed utk1 domain "$any"
printf 'mpts2 2 n unit-tor\n' | seed utk1 nothing "$any"
frame='ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 10\n-1 1e1\n0 10\nITEM: ATOMS id type'
selected=$(options 02 80 00 00 00 01)
printf '%b' "$frame xs ys zs\n1 1 0.1 0.2 0.3\n2 2 .5 .5 .5\n" | seed lammps scaled "$any"
printf '%b' "$frame x y z\n1 1 1 2 3\n2 2 9.5 5 5\n$frame x y z\n1 1 1 2 3\n2 1 9.5 5 5\n" | seed lammps selected "$selected"
printf '%b' "$frame xu yu zu\n1 1 11 2 3\n2 2 -9.5 5 5" | seed lammps wrap "$wrap"
printf '%b' "$frame xs ys zs\n1 1 0.1 0.2 0.3\n" | seed lammps short "$any"
printf 'ITEM: UNITS\nlj\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 1 0\n' | seed lammps tilted "$any"
printf '2\nwater\nH 0 0 1\nO 0 1 0 2\n' | seed xyz ragged "$sphere"
printf '2\n\nH 0 0 1\nO 0 1 0\n1\n\nH 1 0 0\n' | seed xyz vectors "$sphere"
lattice='Lattice="10.0 0 0 0 20.0 0 0 0 20.0" Properties=species:S:1:pos:R:3:velo:R:3'
printf '%b' "2\n$lattice\nAr 1 2 3 0 0 0\nKr 5 5 5 0 0 0\n" | seed xyz extended "$selected"
printf '%b' "1\n$lattice\nAr 1 2 3 0 0 0\n" | seed xyz selected "$(options 02 81 00 00 00 01)"
printf '1\nProperties=pos:R:x\nAr 1 2 3\n' | seed xyz properties "$any"
printf '%b' "2\n$lattice\nAr 1 2 3 0 0 0\nKr 5 5 5 0 0 0\n" | seed detection xyz "$any"
vertices='ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 2\nproperty float x\nproperty uchar red\nproperty double y\n'
printf '%b' "${vertices}element face 1\nproperty list uchar int vertex_indices\nend_header\n.5 1 .25\n.1 2 .2\n3 0 1 1\n" |
    seed ply ascii "$(options 00 0f 00 00 00 01)"
printf '%b' "${vertices}property float z\nend_header\n.5 1 .25 0\n.1 2 .2 .3\n" | seed ply space "$torus"
printf '%b' "${vertices}property float z\nend_header\n.5 1 .25 0\n" | seed ply short "$any"
little=${vertices/ascii/binary_little_endian}
{ printf '%b' "${little}property float z\nend_header\n"; f32 0.5; printf a; f64 0.25; f32 0 .1; printf b; f64 .2; f32 .3; } | seed ply binary "$any"
{ printf '%b' "${little}property short z\nend_header\n"; f32 0.5; } | seed ply binary-short "$any"
printf 'ply\nelement vertex 1\nproperty list uchar int x\nend_header\n' | seed ply list "$any"
number=$(options 02 82 00 00 00 01)
printf 'type,x,y\n1,.1,.2\n2,.3,.4\n#\n1.0,.5,.6\n' | seed csv of-type "$selected"
printf 'x,y,type\n.1,.2,1\n#\n.3,.4,2\n' | seed csv lost "$selected"
printf 'x y type\nrow .1 .2 1\n' | seed utk-text of-type "$selected"
printf '%b' "${vertices}property float z\nend_header\n.5 1 .25 0\n.1 2 .2 .3\n" | seed ply ascii-selected "$number"
{ printf '%b' "${little}property float z\nend_header\n"; f32 0.5; printf a; f64 0.25; f32 0 .1; printf b; f64 .2; f32 .3; } | seed ply selected "$number"
printf '6 1\n2 3\n' | seed utk-text box "$(options 00 83 00 00 00 01)"
printf '{"points": [[0.1, 0.2]]}\n' | seed detection json "$any"
for target in detection obj; do
    printf '# Blender\no Sphere\nv 0 0 1\nv 0 1 0 1.0\nf 1 2 1\n' | seed "$target" obj "$any"
    printf 'g\n\ns off\nvn 0 0 1\nv .1 .2 .3 1 0 0\nv 1 2' | seed "$target" obj-short "$any"
done
printf 'ATOM      1  N   ALA A   1      11.104   6.134  -6.504\nTER\n' | seed detection pdb "$any"
printf 'data_a\n\n_cell_length_a 10\n' | seed detection cif "$any"
printf 'Si\n1.0\n10 0 0\n0 10 0\n0 0 10\nSi\n2\nSelective\nDirect\n0 0 0\n' | seed detection poscar "$any"
printf 'water\n1\n    1SOL     OW    1   0.100   0.200  -0.300\n' | seed detection gromacs "$any"
printf 'VERSION 0.7\nFIELDS x y z\n' | seed detection pcd "$any"
printf 'OFF\n1 0 0\n0 0 1\n' | seed detection off "$any"
printf '\x89HDF\r\n\x1a\n' | seed detection hdf5 "$any"
printf 'P5\n# made by hand\n4 4\n255\n\1\2' | seed detection pgm "$any"
printf 'P5\n0 .2\n1 .4\n' | seed detection no-pgm "$any"
printf 'BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0' | seed detection bmp "$any"
printf '<?xml version="1.0"?>\n<svg width="4">\n' | seed detection svg "$any"
printf '\n x,y\n\n.1,.2\n' | seed detection blank-lines "$any"
printf 'SIMPLE  =                    T' | seed detection fits "$any"

# ---- binary ----------------------------------------------------------------------------------

{ utk 5 1 2 2; f64 0.5 0.25 0 0.999; } | seed utk-binary double "$torus"
{ utk 4 2 1 2; f32 0.5 0.25 0 0.75; } | seed utk-binary float "$any"
{ utk 5 2 1 1; f64 0.5 0.5; } | seed utk-binary repeats "$torus"
{ utk 2 1 1 2; u32 0 7; } | seed utk-binary whole-numbers "$torus"
{ utk 5 1 1 3; f64 0 0 1; } | seed utk-binary vectors "$sphere"
utk 5 4294967295 4294967295 6 | seed utk-binary promise "$any"

# Sets of more than 1024 points, as many as are read before room is made for the whole set
{ utk 4 1 1040 1; head -c 4160 /dev/zero; } | seed utk-binary long "$torus"
{ utk 4 1 4294967295 1; head -c 4160 /dev/zero; } | seed utk-binary long-promise "$torus"
{ npy '<f4' False '1040,'; head -c 4160 /dev/zero; } | seed npy long "$torus"
{ npy '<f4' False '100000000000,'; head -c 4160 /dev/zero; } | seed npy long-promise "$torus"

f32 0.5 0.25 0 0.75 0.1 0.2 | seed rps plane "$torus"
f32 0.5 0.25 0 0.75 0.1 0.2 0.3 0.4 | seed rps second "$second"
f32 0.5 | seed rps half "$any"
f32 -1e-10 0.5 | seed rps below-1 "$wrap"

{ npy '<f8' False '2, 2'; f64 0.5 0.25 0 0.75; } | seed npy plane "$torus"
{ npy '<f8' False '3, 2'; f64 0.5 0.25 0 0.75 .1 .2; } | seed npy numbers "$(options 00 0f 00 00 00 01)"
{ npy '<f8' True '2, 2, 2'; f64 0.5 0.25 0 0.75 .1 .2 .3 .4; } | seed npy numbered-sets "$(options 00 0f 08 00 00 01)"
{ npy '<f8' False '2, 3'; f64 0.5 0.25 0 0.75 .1 .2; } | seed npy numbered-columns "$(options 00 0f c0 00 00 01)"
{ npy '<f8' False '2, 2, 1'; f64 0.5 0.25 0 0.75; } | seed npy sets "$any"
{ npy '<f8' True '2, 2, 2'; f64 0.5 0.25 0 0.75 0.1 0.2 0.3 0.4; } | seed npy fortran-sets "$any"
{ npy '<f4' True '3, 2'; f32 0.5 0.25 0 0.75 0.1 0.2; } | seed npy fortran "$any"
{ npy '<f8' False '2, 3'; f64 0.5 0.25 2 0 0.75 3; } | seed npy weights "$weights"
{ npy '<f8' False '2, 3'; f64 0 0 1 0 1 0; } | seed npy vectors "$sphere"
{ npy '>f8' False '1,'; printf '\x3f\xe0\0\0\0\0\0\0'; } | seed npy big-endian "$torus"
npy '<f8' False '18446744073709551615, 2' | seed npy promise "$any"
{ printf '\x93NUMPY\x02\x00\xff\xff\xff\xff'; } | seed npy long-header "$torus"
# archive LEVEL NAME: standard input as a member of a zip archive, 0 stored, else deflated
archive() {
    perl -MIO::Compress::Zip=:all -e 'binmode STDIN; my $in = do { local $/; <STDIN> };
        zip \$in => "-", Name => $ARGV[1], Time => 315532800, Minimal => 1,
            Method => $ARGV[0] ? ZIP_CM_DEFLATE : ZIP_CM_STORE or die' -- "$1" "$2"
}
{ npy '<f8' False '2, 2'; f64 0.5 0.25 0 0.75; } | archive 1 points.npy | seed npy archive "$torus"
{ npy '<f8' False '2, 2'; f64 0.5 0.25 0 0.75; } | archive 0 arr_0.npy | seed npy archive-stored "$torus"

# coordinates as rows
{ npy '<f8' False '3, 2'; f64 0 1 0 0 1 0; } | seed npy transposed "$(options 00 00 c0 00 00 01)"
{ npy '<f8' False '3, 8'; f64 1 -1 0 0 0 0 1 0 0 0 1 -1 0 0 0 1 0 0 0 0 1 -1 0 0; } | seed detection columns "$any"
{ npy '<f8' False '3, 8'; f64 1 -1 0 0 0 0 1 0 0 0 1 -1 0 0 0 1 0 0 0 0 1 -1 0 0.5; } | seed detection bent "$sphere"
{ npy '<f8' False '2, 8'; f64 0 1 2 3 0 1 2 3 0 1 2 3 4 5 6 0; } | seed detection theta-phi "$theta_phi"
angles=$(options 43 00 20 00 00 01)
{ npy '<f8' False '2, 2'; f64 0.5 1.5 0 6; } | seed openquad angles "$angles"
{ npy '<f8' False '3, 2'; f64 0.5 1.5 0 6 1 2; } | seed openquad weights "$sphere"
{ npy '<f8' True '2, 2'; f64 0.5 1.5 0 6; } | seed openquad fortran "$any"

# ---- what tells the format by itself ---------------------------------------------------------

printf '%b' "$points" | seed detection text "$torus"
printf '0.1,0.2\n' | seed detection csv "$any"
printf '3\n%b' "$points" | seed detection psa "$any"
printf '2 3\n0.1 0.2 0.3\n0.4 0.5 0.6\n' | seed detection gbn "$any"
printf '0 0 0.5 0.5\n#\n0.1 0\n0.5\n' | seed detection tokens "$(options 00 00 02 00 00 00)"
printf '0 0 0.5 0.5 0.1 0.2' | seed detection tokens-piped "$(options 00 00 0a 00 00 01)"
printf '0 0\n1 2\n1\n0.5 0.25\n' | seed detection edat "$any"
printf '%%!PS\n0.5 0.25 p\n' | seed detection eps "$any"
{ utk 5 1 1 2; f64 0.5 0.25; } | seed detection utk "$any"
{ npy '<f8' False '2, 8'; f64 0 1 2 3 0 1 2 3 0 1 2 3 4 5 6 0; } | seed detection openquad "$any"
{ npy '<f8' False '1, 2'; f64 0 0.5; } | seed detection npy "$any"
f32 0.3 0.7 | seed detection raw "$any"
printf '%b' "$points" | gzip -n | seed detection gzip "$any"
{ printf '0.5 0.25\n' | gzip -n; printf '0.1 0.2\n' | gzip -n; } | seed detection gzip-members "$torus"
{ utk 5 1 64 1; f64 $(seq 0 0.01 0.63); } | gzip -n | seed detection gzip-utk "$any"
printf '%b' "$points" | gzip -n | head -c 20 | seed detection gzip-short "$any"
printf '\x1f\x8b' | seed detection gzip-magic "$torus"

# ---- lists -----------------------------------------------------------------------------------

printf '0 0\n0.5,2\n1 1\n' | seed brdf table '\0'
printf '1 1\n0 0\n-1 0\n' | seed brdf falling '\0'
printf '0 1\n0 1\n' | seed brdf twice '\0'
printf '0 1e308\n1 1e308\n' | seed brdf huge '\0'
printf 'glossy:n=30,cut=none' | seed brdf glossy '\1'
printf 'phong:n=1e6' | seed brdf phong '\1'
printf 'glossy:n=-1' | seed brdf negative '\1'
printf '1 0\n-3 7\n' | seed frequencies plane '\0'
printf '# k\n1,2,3\r\n4 , 5 , -1073741824\n' | seed frequencies commas '\1'
printf '1e3\n1.5\n' | seed frequencies fraction '\0'
printf '1\n2.5 -1e-3\n' | seed weights text '\0'
printf '"","w"\n"0","1"\n\n"1","-2.5"\r\n' | seed weights quoted '\0'
printf '"1" 2\n"3"\n' | seed weights quotes '\1'
printf ';w\na;1\nb;1e999\n' | seed weights infinite '\0'
{ npy '<f8' False '2,'; f64 1 -2; } | seed weights npy '\1'
npy '<f8' False '1152921504606846976,' | seed weights promise '\1'
printf '1\n2\n' | gzip -n | seed weights gzip '\0'

# ---- numbers ---------------------------------------------------------------------------------

i=0
for number in 0.5 -0 .25 5. 1e23 9007199254740993 0.1e-5 1e400 4.9e-324 123456789.123456789 \
    12345678901234567890123 18446740742.00054741 0.000000000000000000000000000001 2.2250738585072011e-308 +1e+5x 1e nan; do
    i=$((i + 1))
    printf '%s' "$number" | seed decimal "$i" ''
done
f64 0.1 | seed decimal bits ''

# ---- words -----------------------------------------------------------------------------------

i=0
for text in white sobol:scramble=owen,skip=3 jittered:strata=4x4 halton regular latin-hypercube \
    hammersley larcher-pillichshammer:scramble=none wite 'sobol:skip=1,skip=2' 'white:x=' ':'; do
    i=$((i + 1))
    printf '%s' "$text" | seed sampler "$i" '\x10\0\2'
done
# Nothing but the text: what is left open is 0.
for text in white-sphere white-hemisphere zphi:strata=16x64 healpix healpix-jittered:nside=3 fibonacci \
    fibonacci-hemisphere spiral sobol:scramble=owen,lift=hemisphere 'regular:lift=ball' healpix:nside=1e9 \
    fibonacci-hemisphere:morph=glossy,n=5 halton:lift=hemisphere,morph=phong,n=1e6; do
    i=$((i + 1))
    printf '%s' "$text" | seed sampler "$i" '\0\0\0'
done

printf -- '--sampler\nwhite\n-n\n1e3\n-m16\n-k\n64\n-o\nout.csv' | seed arguments power '\0'
printf -- '--sampler\nsobol:scramble=owen\n--sampler=jittered\n-n4096\n-d3\n--tol=1e-9\n--plot=a.png' |
    seed arguments samplers '\0'
printf -- '--sampler=white\n-n\n16..64,100\n--points=8,4' | seed arguments counts '\0'
printf -- '--frequencies=f.txt\n--weights\ncolumn\n--wrap\n-\n--\n-x' | seed arguments files '\0'
printf -- '--sampler\nhalton\n-n\n1000\n--format\nnpy\n-s\n18446744073709551615' |
    seed arguments sample '\1'
printf -- 'power\n--precision\nextended\na\nb' | seed arguments plan '\2'
printf -- '--verbose\n--help' | seed arguments devices '\3'
printf -- 'variance\n--sampler=jittered\n--integrand\ndisk:radius=0.25\n--integrand=gaussian\n-n\n16..64\n--shifts=3' |
    seed arguments variance '\xff'
printf -- 'pwer\n--pints=5' | seed arguments typing '\xff'
printf -- '--points=0\n' | seed arguments range '\0'
printf -- '--tol=0\n' | seed arguments tolerance '\0'

# ---- tables as NPZ ----------------------------------------------------------------------------

# array KIND EXTENTS [WIDTH]: of a table in an NPZ file, its kind (0 to 4: f, i, u, c, U) and extents, and then its data
array() {
    local extents
    read -ra extents <<<"$2"
    perl -e 'print pack("C*", @ARGV)' "${3:-1}" "$1" "${#extents[@]}" "${extents[@]}" && cat
}
# fields LIST: with | for the NUL behind each text
fields() { printf %s "$1" | tr '|' '\0' | array 2 ${#1}; }
{
    fields '1|power|ca|cb|cc|7sampler|white|0empty||1x|-inf|2n|7|b'
    printf '\0\3\2\1\2\2' | array 2 '2 3'
    f64 nan 0.5 | array 0 2
    printf 'a\0\0\0001\0\0\0' | array 4 2
    u32 1 0 4294967295 4294967295 | array 1 2
} | seed table rows '\1'
{ fields '1|power|' && printf '' | array 2 '0 0'; } | seed table empty '\1'
{ fields '1|power|aa|sb|' && printf '' | array 2 '0 0' && f64 1 2 | array 3 1 && f64 1 | array 0 ''; } | seed table arrays '\1'
printf 'PK\3\4' | seed table cut '\0'

# figures ENTRIES NAME: with a row of 1.25 and no other precision
figures() {
    fields "1|figures|cname|csingle|cdouble|cextended|3date|today|$1"
    printf '\3\1\0\0' | array 2 '1 4'
    perl -e 'print pack("V*", map ord, split //, $ARGV[0])' "$2" | array 4 1 "${#2}"
    f64 1.25 | array 0 1
    f64 nan | array 0 1
    f64 nan | array 0 1
}
figures '1flops_single|3e11|1copied_bytes|5e10|0launches||' torus_nufft | seed figures whole '\1'
figures '1launches|0.5|' torus_nufft | seed figures numbers '\1'
figures '' host:white | seed figures host '\1'

# saved ENTRIES KEYS: rows of these rings, a digit each, in a table of power
saved() {
    local num=${#2}
    fields "1|power|cbin|cpower|cfrequency|ccount|cstandard_error|3normalization|power: x|2realizations|3|1predicted_error|0.001|$1"
    for ((i = 0; i < num; i++)); do printf '\2\1\1\2\1'; done | array 2 "$num 5"
    perl -e 'print pack("q<*", split //, $ARGV[0])' "$2" | array 1 "$num"
    perl -e 'print pack("d<*", (0.5) x $ARGV[0])' "$num" | array 0 "$num"
    perl -e 'print pack("d<*", (1.25) x $ARGV[0])' "$num" | array 0 "$num"
    perl -e 'print pack("q<*", (8) x $ARGV[0])' "$num" | array 1 "$num"
    f64 0.1 0.2 | head -c $((8 * num)) | array 0 "$num"
}
plane='2points|8|2dimension|2|2max_frequency|2|'
saved "$plane" 12 | seed saved rings '\1'
saved "2points|8|2dimension|3|2max_frequency|1|2per_ring|2|2seed|5|" 1 | seed saved shells '\1'
saved "1points|7.5|2points_smallest|7|2points_largest|8|2dimension|2|2max_frequency|1|" 1 | seed saved range '\1'
saved "${plane}3bins|relative=1/2|" 1 | seed saved objects '\1'
saved "${plane}3bins|width=3/2|" 0 | seed saved inner '\1'

# ---- scenes ----------------------------------------------------------------------------------

seed scene torus '' <<'EOF'
# reduced from docs/scenes
scene: 1
title: Samplers of the torus
description: >
  Averaged periodograms,
  and radial means.
defaults: {points: 64, seed: 1, tol: 1e-5}
results:
  - result: power
    name: stochastic
    title: Random and stratified
    samplers: [white, jittered, "sobol:scramble=owen"]
    max-frequency: 96
    pictures: true
  - result: angular
    samplers: "hammersley:lift=sphere"
    homogenize: true
    plot: false
EOF
seed scene rules '' <<'EOF'
scene: 1
results:
  - {result: quadrature, brdf: "glossy:n=30", weights: [equal, optimal, w.txt], samplers: fibonacci-hemisphere, points: 64..512}
  - {result: truncation, brdf: [diffuse, "zonal:file=a.lobe"], harmonics: [spherical, hemispherical], max-degree: 20}
  - {result: pairs, files: [[a.txt, b.txt], /c.npy], select-sets: 1..2, weights: column}
EOF
seed scene joined '' <<'EOF'
scene: 1
defaults: {points: [16..64, 100], rank: true}
results:
  - {result: variance, samplers: [white, jittered], integrands: [disk, gaussian], rates: 16..64, bounds: [auto, 0.5..1]}
  - {result: variance, samplers: [zphi, spiral], integrand: cap, rank: false}
EOF
seed scene gate '' <<'EOF'
scene: 1
results:
  - result: check
    against: saved.json
    samplers: jittered
    false-alarm-rate: 1e-3
EOF
seed scene aliases '' <<'EOF'
scene: 1
defaults: &d {points: &n [16, 32]}
results: [&r {result: power, points: *n, title: "\u2028\x80\N"}, {result: power, files: &f [-a, "b 'c"], seed: *n}]
EOF
printf '{"scene": "1", "results": [{"result": "power", "name": "a", "plot": "true", "files": [["a", "b"]]}], "record": {"folder": "/x/",
"device": "d", "pointspec_version": "0", "kind": "k", "questions": [{"seed": "1", "engine": "(host_direct)", "precision": "extended"}], "digests": ["0a", "0b"]}}\n' | seed scene record ''
printf 'scene: 1\nresults:\n  - {result: power, sets: {a: [b.txt, c.txt], d: e.txt}, samplers: [white, halton], points: 4, wrap: true, seed: 2}\n' | seed scene sets ''
printf 'scene: 1\nresults: &a\n  - *a\n' | seed scene itself ''
printf '[[[[[[[[[[[[[[[[[[[[[' | seed scene nest ''
printf 'scene: 1\nresults:\n  - {result: power, pionts: 3}\n' | seed scene typing ''
printf 'scene: 1\nresults:\n  - {result: power, points: [1, [2]], points: 3}\n---\n' | seed scene twice ''
printf 'a: &a [h,h,h]\nb: &b [*a,*a,*a]\nc: [*b,*b,*b]\n' | seed scene laughs ''
printf 'scene: 1\nresults: [\n' | seed scene cut ''
printf '\xef\xbb\xbfscene: "1\\0"\n' | seed scene nul ''

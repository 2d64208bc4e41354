#!/usr/bin/env bash
# Sourced: read_line takes a line of commands.txt apart; make_inputs makes the files that these lines want, in
# $scratch/initial, with $program.
# shellcheck disable=SC2154,SC2103,SC2034 # variables are the caller's, who is in a folder

# Sets words, what is run, and stdin, a path, from the fields of a line; the program and the kernels are the caller's.
read_line() { # NAME STDIN [VARIABLE=VALUE...] WORD...
    stdin=/dev/null words=()
    [[ $2 == - ]] || stdin=$scratch/initial/$2
    shift 2
    while [[ $1 =~ ^[A-Z_]+= ]]; do
        set -- "${1//@cache@/$scratch/cache}" "${@:2}"
        words+=("${1//@kernels@/$here/../../kernels}")
        shift
    done
    words+=("$program" "$@")
}

# Two points and their weights, zeros, column by column: magic, length of the header, header, numbers.
make_fortran_array() {
    local header="{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3), }"
    printf '\x93NUMPY\x01\x00\x76\x00%-117s\n' "$header"
    head -c 24 /dev/zero
}

# A zip archive of one deflated member, from what gzip makes of it: ten bytes before the data, CRC and size behind them.
make_archive() { # FILE NAME
    local size packed
    little() { # VALUE BYTES: the lowest byte first
        local i
        for ((i = 0; i < $2; i++)); do printf '%b' "\\x$(printf %02x $(($1 >> 8 * i & 255)))"; done
    }
    facts() { # from the method to the length of the name
        little 8 2 && little 0 4
        gzip -n <"$1" | tail -c 8 | head -c 4
        little "$packed" 4 && little "$size" 4 && little ${#2} 2
    }
    size=$(wc -c <"$1") packed=$(($(gzip -n <"$1" | wc -c) - 18))
    printf 'PK\3\4' && little 20 2 && little 0 2 && facts "$1" "$2" && little 0 2 && printf %s "$2"
    gzip -n <"$1" | tail -c +11 | head -c "$packed"
    printf 'PK\1\2' && little 20 4 && little 0 2 && facts "$1" "$2" && little 0 16 && printf %s "$2"
    printf 'PK\5\6' && little 0 4 && little 1 2 && little 1 2
    little $((46 + ${#2})) 4 && little $((30 + ${#2} + packed)) 4 && little 0 2
}

make_inputs() {
    mkdir "$scratch/initial"
    cd "$scratch/initial" || return
    "$program" sample --sampler white -n 8 -o points.txt
    "$program" sample --sampler white -n 6 -m 2 -s 2 -o more.txt
    "$program" sample --sampler white -n 8 -m 2 -o points.npy
    "$program" sample --sampler white -n 1500 -o many.txt
    printf '1 2 -1 0.5 1 2 1 0.5\n' | tr ' ' '\n' >weights.txt
    printf '0 0\n0.5 2\n1 1\n' >weighted.lobe
    paste -d ' ' points.txt weights.txt | grep -v '#' >weighted.txt
    printf '1 0\n0 1\n1000 -3\n' >vectors.txt
    gzip -n <points.txt >packed.gz
    printf '0,90\n45,0\n-30,-60\n' >angles.csv
    printf 'ITEM: %s\n' 'NUMBER OF ATOMS' 2 'BOX BOUNDS pp pp pp' '0 2' '0 2' '0 2' 'ATOMS type x y z' |
        sed -E '/^ITEM: [0-9]/s/ITEM: //' >atoms.dump
    printf '1 0 1 1.5\n2 1 1 1\n' >>atoms.dump
    printf '2\nLattice="2 0 0 0 2 0 0 0 2"\nAr 0 1 1.5\nKr 1 1 1\n' >atoms.xyz
    printf '%s\n' ply 'format binary_little_endian 1.0' 'element vertex 1' 'property uchar '{x,y,z} end_header >mesh.ply
    printf '\0\1\0' >>mesh.ply
    make_fortran_array >columns.npy
    printf '#?RADIANCE\n\n-Y 1 +X 2\n\101\102\103\200\144\145\146\200' >light.hdr
    make_archive points.npy arr_0.npy >packed.npz
    "$program" power --engine host_direct --sampler white -n 8 -m 3 -k 2 -o saved.npz
    "$program" power --engine host_direct --sampler white -n 8 -m 3 -k 2 -o again.npz
    "$program" angular --engine host_direct --sampler zphi -n 6 -m 3 -l 2 -o sphere.npz
    "$program" pairs --engine host_direct --sampler zphi -n 6 -m 3 -l 2 -o pairs.npz
    "$program" power --engine host_direct --sampler white -n 8 -m 3 -k 2 --per-ring 2 -o rings.npz
    # An older program (scripts/same_bits.sh) may not know ranges; then the line that merges them has no input.
    "$program" power --engine host_direct --sampler white -n 4 -m 130 -k 1 --range 0:128 -o early.npz || :
    "$program" power --engine host_direct --sampler white -n 4 -m 130 -k 1 --range 128:130 -o late.npz || :
    "$program" quadrature --engine host_direct --sampler white-hemisphere -n 4 --brdf diffuse -l 2 -m 4 --range 0:1 -o front.npz || :
    "$program" quadrature --engine host_direct --sampler white-hemisphere -n 4 --brdf diffuse -l 2 -m 4 --range 1:4 -o back.npz || :
    POINTSPEC_CACHE_DIR=$scratch/cache "$program" bench --calibrate --case list --quick -o /dev/null
    printf '0 0 1 0\n1 2 .5 .25\n-1 -2 .5 -.25\n' >own.txt
    printf '2 1 1 .5\n0 0 1 0\n' >lm.txt
    printf 'v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 5 4\n' >corner.obj
    "$program" power --engine host_direct --sampler white -n 8 -k 1 --coefficients own.npy -o own.csv
    for ending in csv json npy npz png txt; do echo "an earlier result" >old.$ending; done
    cat >points.yaml <<'EOF'
scene: 1
defaults: {engine: host_direct, no-self-check: true}
results:
  - {result: power, files: points.txt, max-frequency: 2, plot: false, arrays: true}
  - {result: truncation, brdf: diffuse, max-degree: 1, plot: false}
EOF
    printf 'scene: 1\nresults:\n  - {result: pairs, engine: host_direct, samplers: zphi, points: 8, max-degree: 4}\n' >drawn.yaml
    # A sentence must have the name of a file that the command line names: the ends of these are.
    for name in sets asets bsets; do cp points.txt $name.txt; done
    cp more.txt amore.txt
    printf 'scene: 1\nresults:\n  - {result: power, engine: host_direct, no-self-check: true, sets: {a: [asets.txt, bsets.txt], b: se*.txt}, samplers: white, points: 4, max-frequency: 2, plot: false}\n' >sets.yaml
    printf 'scene: 1\nresults:\n  - {result: sample, samplers: [white, zphi], points: 8, arrays: true}\n' >sampled.yaml
    printf 'scene: 1\nresults:\n  - {result: variance, engine: host_direct, samplers: [zphi, white-sphere], points: 8, max-degree: 2, integrands: [cap, square]}\n' >charted.yaml
    printf 'scene: 1\nresults:\n  - {result: variance, engine: host_direct, samplers: [white, jittered], points: [4, 9], max-frequency: 2, realizations: 8, integrands: disk, shifts: 0, rates: auto, rank: true, bounds: [0..1, 0.5..1]}\n' >joined.yaml
    POINTSPEC_CACHE_DIR=$scratch/cache "$program" run points.yaml -o "$scratch/warm" >/dev/null
    POINTSPEC_CACHE_DIR=$scratch/cache "$program" run drawn.yaml -o "$scratch/warm" >/dev/null
    sed 's/"folder": ".*"/"folder": "."/' "$scratch/warm/record.json" >points.json
    cd - >/dev/null || return
}

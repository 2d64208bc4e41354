#!/usr/bin/env bash
# static.sh PROGRAM FOLDER [--sample NUMBER]: what compilers for GPUs make of every kernel with the parameters that it has
# there, without a GPU. PROGRAM, pointspec, takes the lines of scripts/same_bits.txt and those below, once more in double, for
# jobs on an H100 (bench/gpu/launches.c), whose launches, not run, say the sources, options, work-groups and local memory.
# Each program of them is compiled for sm_80, sm_90 (clang, libclc, ptxas: NVIDIA's last stage) and, unless it has PTX, gfx90a.
# Standard output: a table, the most registers first; FOLDER has all else. --sample: every tenth line, chosen by
# NUMBER. Exit code 1 when registers are spilled to memory, or without --sample a source that PROGRAM has is never launched,
# and static_listed.txt does not say why; or says it of one that is. JOBS compilers at a time.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
program=$(realpath "$1") jobs=${JOBS:-$(nproc)} sample=
[[ ${3-} != --sample ]] || sample=$(($4 % 10))
mkdir -p "$2/runs"
cd "$2"
folder=$PWD patience=60 # seconds for one line, as in run.sh; they take two

# That of PATH, else the same version from PyPI: others have other registers. Where tools cannot be had, that is all there is to say.
find_ptxas() { command -v ptxas || find "$PWD/venv" -path '*/bin/ptxas' 2>/dev/null | grep .; }
ptxas=$(find_ptxas) || {
    { python3 -m venv venv && venv/bin/pip install --no-deps nvidia-cuda-nvcc==13.0.88; } >tools.log 2>&1 || true
    ptxas=$(find_ptxas) || { echo "gpu-static: not asked, for want of ptxas: $(tail -n 1 tools.log)"; exit 0; }
}
for tool in "$(command -v clang-15 || echo clang-15)" /usr/lib/clc/nvptx64--nvidiacl.bc /usr/lib/clc/amdgcn--amdhsa.bc; do
    [[ -e $tool ]] || { echo "gpu-static: not asked, for want of $tool"; exit 0; }
done
export ptxas

# ---- what is launched on a GPU -----------------------------------------------------------------

# Powers of zeros fail every check; a command without the option has its say without it.
record() { # WORD...
    local code=0
    { LD_PRELOAD=$folder/launches.so timeout "$patience" "$program" "$@" --no-self-check || code=$?
        ((code != 2)) || LD_PRELOAD=$folder/launches.so timeout "$patience" "$program" "$@"; } >>log.txt 2>&1 </dev/null || true
}
list_lines() { # CAPABILITY WORD...; that of cards without matrix units is 0
    local lines=$here/../../scripts/same_bits.txt
    grep -E '^(power|angular|pairs|variance) ' "$lines" | sed 's/--precision [a-z]*//; s/.*/9 & --precision auto\n9 & --precision double/'
    grep -E '^(quadrature|sample) ' "$lines" | sed 's/^/9 /'
    cat <<'END'
9 sample --sampler gaussian-blue-noise -n 4096 --kept-sets 0
9 bench --quick --case list --engine torus_direct --precision single
9 occlusion --mesh quad.obj --image 16x16 --reference 64 --sampler white-sphere -n 64
9 measure --sampler white -n 4096 --measures number_variance,star_discrepancy
9 measure --sampler white-sphere -n 1024 --measures separation
9 power --sampler white -n 256 -m 20 -k 32 --engine torus_direct --precision single
0 power --sampler white -n 300 -m 20 -k 40 --engine torus_direct --precision single
0 power --sampler white -n 300 -m 20 -k 40 --engine torus_direct --precision double
END
}
record_all() {
    local words
    while read -r -a words; do
        POINTSPEC_CAPABILITY=${words[0]} record "${words[@]:1}"
    done < <(list_lines | awk -v turn="$sample" 'turn == "" || NR % 10 == turn')
}
"${CC:-cc}" -std=gnu11 -Wall -Wextra -Werror -shared -fPIC -DCL_TARGET_OPENCL_VERSION=120 "$here/launches.c" -o launches.so
export POINTSPEC_LAUNCHES=$folder/launched.txt POINTSPEC_CACHE_DIR=$folder/no-cache
rm -f ./*.txt
printf '%s\n' 'v -1 -1 -2' 'v 1 -1 -2' 'v 1 1 -2' 'v -1 1 -2' 'f 1 2 3 4' >runs/quad.obj
(cd runs && record_all)
# Of launches of one kernel with the same options the largest: SOURCE KERNEL GROUP LOCAL OPTIONS
sort -u launched.txt | awk '{ key = $1 " " $2; options = ""
    for (i = 5; i <= NF; i++) options = options " " $i
    key = key SUBSEP options
    if ($3 > group[key]) group[key] = $3
    if ($4 + 0 >= bytes[key]) bytes[key] = $4 }
    END { for (key in group) { split(key, part, SUBSEP); print part[1], group[key], bytes[key] part[2] } }' | sort >launches.txt

# ---- what it is compiled to --------------------------------------------------------------------

# Lines TARGET SOURCE KERNEL REGISTERS LOCAL STACK SPILLED OPTIONS, bytes of an item but for LOCAL.
compile() { # SOURCE OPTION...
    local source=$1 object
    object=$(mktemp)
    shift
    local clang=(clang-15 -x cl -O3 "-I$kernels" "$@" -Xclang -mlink-bitcode-file -Xclang)
    { "${clang[@]}" /usr/lib/clc/nvptx64--nvidiacl.bc -target nvptx64--nvidiacl -Xclang -target-cpu -Xclang sm_80 \
        -Xclang -target-feature -Xclang +ptx75 -Dcl_khr_fp64 -S -o "$object" "$kernels/$source" &&
        "$ptxas" -arch=sm_80 -v -o /dev/null "$object" && "$ptxas" -arch=sm_90 -v -o /dev/null "$object" &&
        { [[ "$*" == *UNITS_PTX* ]] ||
            "${clang[@]}" /usr/lib/clc/amdgcn--amdhsa.bc -target amdgcn--amdhsa -mcpu=gfx90a -nogpulib -S -o - "$kernels/$source"; }
    } >"$object.said" 2>&1 || { echo "$source $*: $(grep -m 3 error "$object.said")" >>failed.txt; }
    awk -v source="$source" -v options="$*" '
        function put(target) { print target, source, kernel, registers, local + 0, stack, spilled, options }
        /Compiling entry function/ { gsub("\047", ""); kernel = $7; target = $9 }
        /bytes stack frame/ { stack = $1; spilled = $5 }
        /Used [0-9]+ registers/ { registers = $5; local = match($0, /[0-9]+ bytes smem/) ? substr($0, RSTART) : 0; put(target) }
        /^    \.group_segment_fixed_size:/ { local = $2 }
        /^    \.name:/ { kernel = $2 }
        /^    \.private_segment_fixed_size:/ { stack = $2 }
        /^    \.vgpr_count:/ { registers = $2 }
        /^    \.vgpr_spill_count:/ { spilled = 4 * $2; put("gfx90a") }' "$object.said"
    rm -f "$object" "$object.said"
}
export -f compile
export kernels=$here/../../kernels
awk '{ $2 = $3 = $4 = ""; print }' launches.txt | sort -u >programs.txt
# shellcheck disable=SC2016 # words of the inner shell
xargs -P "$jobs" -I{} bash -c 'compile $1' _ {} <programs.txt >compiled.txt
[[ ! -s failed.txt ]] || { cat failed.txt >&2; exit 1; }

# ---- what is said of it ------------------------------------------------------------------------

# static_listed.txt: lines "NAME BYTES REASON": a kernel may spill so many of an item, a source has no launch (BYTES is "-").
# Of a multiprocessor a quarter has 512 registers for each lane, in eights, and 16 warps of 32 items (AMD: 8 of 64).
awk -v sources="$(grep -rhoE '"[a-z_/]+\.cl"' "$here/../../host" | tr -d '"' | sort -u | paste -sd ' ')" -v is_sample="$sample" '
    function least(a, b) { return a < b ? a : b }
    function occupancy(target, registers, items, bytes) {
        width = target == "gfx90a" ? 64 : 32
        waves = int((items + width - 1) / width)
        groups = least(32, int(4 * least(512 / width, int(512 / (8 * int((registers + 7) / 8)))) / waves))
        if (bytes > 0) groups = least(groups, int(1024 * memory[target] / (bytes + (width == 32 ? 1024 : 0))))
        return sprintf("%.0f", 100 * groups * items / 2048)
    }
    function join_targets(what, row) { return what["sm_80", row] " / " what["sm_90", row] " / " what["gfx90a", row] }
    function complain(text) { print "gpu-static: " text >"/dev/stderr"; failed = 1 }
    BEGIN { memory["sm_80"] = 164; memory["sm_90"] = 228; memory["gfx90a"] = 64 }
    FILENAME ~ /listed/ { if (NF && !/^#/) may[$1] = $2; next }
    FILENAME ~ /launches/ { launched[$1] = 1; options = ""
        for (i = 5; i <= NF; i++) options = options " " $i
        group[$2 options] = $3; bytes[$2 options] = $4; next }
    { options = ""
        for (i = 8; i <= NF; i++) options = options " " $i
        row = $3 options
        registers[$1, row] = $4; stack[$1, row] = $6; spilled[$1, row] = $7
        filled[$1, row] = row in group ? occupancy($1, $4, group[row], bytes[row] + $5) : "-"
        local[row] = bytes[row] + $5
        most[row] = most[row] > $4 ? most[row] : $4
        if ($7 > 0) does[$3] = 1
        if ($7 > ($3 in may ? may[$3] : 0)) complain($3 " spills " $7 " bytes of an item on " $1 " with" options) }
    END {
        split(sources, all, " ")
        for (i in all) if (is_sample == "" && !(all[i] in launched) && !(all[i] in may)) complain("no line launches " all[i])
        for (name in may) if (may[name] == "-" ? name in launched : is_sample == "" && !(name in does))
            complain(name " is listed, and need not be")
        print "| kernel | options | items | local, bytes | registers | occupancy, % | stack, bytes | spilled, bytes |"
        print "|---|---|---:|---:|---:|---:|---:|---:|"
        for (row in most) { name = options = row
            sub(/ .*/, "", name); sub(/[^ ]* -cl-std=CL1.2 -w ?/, "", options); gsub(/-D/, "", options)
            printf "| %s | %s | %s | %d | %s | %s | %s | %s |\n", name, options, row in group ? group[row] : "-", local[row],
                join_targets(registers, row), join_targets(filled, row), join_targets(stack, row),
                join_targets(spilled, row) | "sort -t/ -k2,2nr" }
        close("sort -t/ -k2,2nr")
        exit failed }' "$here/static_listed.txt" launches.txt compiled.txt

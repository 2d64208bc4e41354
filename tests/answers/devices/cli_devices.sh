#!/usr/bin/env bash
# cli_devices.sh PROGRAM: several devices of one process write what one device writes, to the bit; what is not shared is done by
# the first; devices of other kinds are refused. The devices are shares of a CPU. Skipped (77) where none is split.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" devices "$1"

if ! "$program" power --engine torus_direct --sampler white -n 4 -k 1 --device cpu:split=2/1 >out 2>err; then
    echo "cli_devices: skipped: $(<err)" >&2
    exit 77
fi

table=answer.npz # of averages
devices=(cpu:split=2 'cpu:split=2/1,cpu:split=2/0')
is_same() { # ARGS...: tables and arrays of one device and of two, in either order
    local file
    rm -rf one several
    mkdir one several
    devices=("${devices[1]}" "${devices[0]}")
    (cd one && "$program" "$@" --device cpu -o "$table") || complain "one device: $*"
    (cd several && "$program" "$@" --device "${devices[0]}" -o "$table" 2>err) || complain "two devices: $*: $(<several/err)"
    [[ ! -s several/err ]] || complain "$(<several/err)"
    rm several/err
    checked=$((checked + 1))
    [[ $(ls one) == "$(ls several)" ]] || complain "files of two devices: $(ls several)"
    for file in one/*; do
        case $file in
        *.csv) cmp <(grep -v '^# command' "$file") <(grep -v '^# command' "several/${file#one/}") || complain "$file is another: $*" ;;
        *answer.npz) # its answers, and sums, go on to be merged
            cmp <("$program" merge "$file" 2>&1 | grep -v '^# \(command\|merged\)') \
                <("$program" merge "several/${file#one/}" 2>&1 | grep -v '^# \(command\|merged\)') || complain "$file is another: $*" ;;
        *) cmp "$file" "several/${file#one/}" || complain "$file is another: $*" ;;
        esac
    done
}

awk 'BEGIN { srand(5); for (s = 0; s < 700; s++) { if (s) print "#"
    for (i = 0; i < 5 + s % 3; i++) printf "%.9f %.9f %.9f\n", rand(), rand(), 0.5 + rand() } }' >sets.txt
sets=$PWD/sets.txt
is_same power -m 1300 --sampler jittered --sampler white -n 16,64 -k 8 --precision single
is_same power -m 1300 --sampler white -n 64 -k 8 --precision double --full full.npy
is_same power --columns xyw -k 2 --normalize integral "$sets"
is_same angular -m 700 --sampler white-sphere -n 40 -l 12
is_same pairs --columns xyw --lift sphere -l 3 "$sets"
is_same power --engine host_direct -m 300 --sampler white -n 4 -k 1
# Powers of all parts decide together on another plan, each question for itself.
awk 'BEGIN { for (r = 0; r < 300; r++) { if (r) print "#"
    for (j = 0; j < 300; j++) print 0.5 + 1e-4 * (j % 17) + 1e-6 * r, 0.5 + 1e-4 * (j % 19) } }' >clusters.txt
is_same power -k 8 "$PWD/clusters.txt"
"$program" merge several/answer.npz 2>&1 | grep -q planned_twice || complain 'clusters are planned once'
is_same power --sampler white --sampler regular -n 64,256 --no-skip --no-self-check -m 300 -k 20

# Rows of realizations.
table=answer.csv
printf '2,0,1,0\n' >light.txt
printf 'v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 5 4\n' >corner.obj
light=coefficients:file=$PWD/light.txt
is_same variance --integrand disk --integrand gaussian --sampler jittered -n 16,64 -m 100 -k 4
is_same variance --integrand disk --columns xyw -k 3 "$sets"
is_same quadrature --sampler white-hemisphere -n 64 -m 60 --brdf glossy:n=30 -l 20
is_same quadrature --columns xyw --lift hemisphere --brdf diffuse -l 5 "$sets"
is_same shade --sampler white-hemisphere -n 16 -m 20 --brdf diffuse --integrand "$light"
is_same interpolation --sampler white-sphere -n 16 -m 7 --integrand "$light"
is_same measure --sampler jittered -n 16 -m 7 -k 5
is_same occlusion --mesh "$PWD/corner.obj" --image 8x8 --reference 64 --sampler white-sphere -n 4 -m 7

# What the first device does alone, what has fewer blocks, a range.
job=(power --engine torus_direct --sampler white -n 16 -k 2)
alone() { # SENTENCE ARGS...
    local sentence=$1
    shift
    checked=$((checked + 1))
    "$program" "$@" --device cpu >one.csv
    "$program" "$@" --device cpu:split=2 >out 2>err || complain "two devices: $(<err)"
    [[ $(wc -l <err) == 1 && $(<err) == *"$sentence"* ]] || complain "not \"$sentence\": $(<err)"
    cmp <(grep -v '^# command' one.csv) <(grep -v '^# command' out) || complain "the first of two devices: $*"
}
alone 'the first of 2 devices works alone: realizations are shared in blocks of 128, and there are 100' "${job[@]}" -m 100
alone 'works alone: all realizations of a sampler have the same powers' power --sampler sobol -n 4 -k 1 -m 300
alone 'works alone: one realization is not shared' quadrature --brdf diffuse -n 16 --sampler white-hemisphere
"$program" "${job[@]}" -m 200 -o saved.npz
is_same check --against "$PWD/saved.npz" --sampler white -n 16 --precision single # whose price is others' on half of a processor
is_same variance --integrand disk --sampler jittered -n 16 -m 200 -k 8
alone 'works alone: phases of every set are kept' check --homogeneous --sampler white -n 16 -m 40 -k 2
checked=$((checked + 1))
for range in 0:256 256:600; do
    "$program" "${job[@]}" -m 600 --range $range --device cpu:split=2 -o "${range%:*}.npz"
done
"$program" "${job[@]}" -m 600 >one.csv
cmp <(grep -v '^# command' one.csv) <("$program" merge 0.npz 256.npz | grep -v '^# \(command\|merged\)') || complain 'ranges of two devices'

# A job of two devices goes on by one.
checked=$((checked + 1))
"$program" "${job[@]}" -m 40000 >one.csv
{ timeout -s KILL 0.5 "$program" "${job[@]}" -m 40000 --device cpu:split=2 --checkpoint job.npz --checkpoint-interval 0; } >/dev/null 2>&1 || true
"$program" "${job[@]}" -m 40000 --checkpoint job.npz >out
cmp <(grep -v '^# command' one.csv) <(grep -v '^# command' out) || complain 'a job that one device ends'
[[ -z $(ls job* 2>/dev/null) ]] || complain "checkpoints are left: $(ls job*)"

refused() { # SENTENCE SELECTOR
    checked=$((checked + 1))
    "$program" "${job[@]}" -m 600 --device "$2" >out 2>err && complain "$2 is no error"
    [[ $(wc -l <err) == 1 && $(<err) == *"$1"* && ! -s out ]] || complain "of $2: $(<err)"
}
refused 'is named twice' cpu,cpu
refused 'is not split into 64 shares' cpu:split=64
refused '9 is not between 0 and 1' cpu:split=2/9
refused 'no OpenCL device fits' cpu,tpu

# Other names of one kind; other kinds, where there is a simulator, which makes the same powers but for last digits.
checked=$((checked + 2))
"$program" "${job[@]}" -m 600 >one.csv
POCL_DEVICES="pthread basic" "$program" "${job[@]}" -m 600 --device 0,1 >out
cmp <(grep -v '^# \(command\|device\)' one.csv) <(grep -v '^# \(command\|device\)' out) || complain 'two devices of PoCL'
grep -q '^# device: .*basic.* + .*pthread\|^# device: .*pthread.* + .*basic' out || complain "the names of both: $(grep '^# device' out)"
# In a scene the names of both are those of what both answer alone.
checked=$((checked + 1))
cat >scene.yaml <<'END'
scene: 1
results:
  - {result: power, name: shared, samplers: white, points: 16, realizations: 600, max-frequency: 2}
  - {result: quadrature, name: rows, samplers: white-hemisphere, points: 4, realizations: 20, brdf: diffuse}
  - {result: quadrature, name: alone, samplers: white-hemisphere, points: 4, realizations: 1, brdf: diffuse}
END
POCL_DEVICES="pthread basic" "$program" run scene.yaml -o folder --device 0,1 --cache 0 >out 2>err || complain "a scene: $(<err)"
for name in shared rows; do
    [[ $(grep -c '^# device: .* + ' folder/$name.csv) == 1 ]] || complain "$name: $(grep '^# device' folder/$name.csv)"
done
[[ $(grep '^# device' folder/alone.csv) != *' + '* ]] || complain "alone: $(grep '^# device' folder/alone.csv)"
simulator=$(find /usr/lib* -name 'liboclgrind-rt-icd.so' | head -1)
if [[ -n $simulator && -d /etc/OpenCL/vendors ]]; then
    mkdir vendors
    cp /etc/OpenCL/vendors/* vendors
    echo "$simulator" >vendors/simulator.icd
    export OCL_ICD_VENDORS=$PWD/vendors
    refused '--mixed lets them share the work' cpu,oclgrind
    checked=$((checked + 1))
    "$program" "${job[@]}" -m 300 --device cpu,oclgrind --mixed >out || complain '--mixed'
    "$program" "${job[@]}" -m 300 --device cpu | grep -v '^#' | tail -n +2 | paste -d, - <(grep -v '^#' out | tail -n +2) |
        awk -F, '{ for (i = 1; i <= NF / 2; i++) { off = $i - $(i + NF / 2); if (off * off > 1e-10) bad = 1 } } END { exit bad || NR == 0 }' ||
        complain "--mixed: $(<out)"
fi
finish

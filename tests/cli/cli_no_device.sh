#!/usr/bin/env bash
# cli_no_device.sh PROGRAM: why there is no device is said as it is; plan and devices work without one.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" power "$1"
mkdir empty missing
echo /usr/lib/no-such-driver.so >missing/a.icd
long=$PWD/$(printf 'x%.0s' {1..100})/$(printf '%0900d' 0)
power=("$program" power --sampler white -n 16 -k 4)

refused() { # SENTENCE VARIABLE=VALUE...
    local sentence=$1 code=0
    shift
    env "$@" timeout 600 "${power[@]}" >out 2>err || code=$?
    [[ $code == 1 && $(wc -l <err) == 1 && $(<err) == *"$sentence"* && $(<err) == *host_direct* ]] ||
        complain "$*: exit $code: $(<err)"
}
refused "no OpenCL driver found: OCL_ICD_VENDORS names $PWD/empty, where no file" OCL_ICD_VENDORS="$PWD/empty"
refused "$PWD/nowhere cannot be read: No such file" OCL_ICD_VENDORS="$PWD/nowhere"
refused "no OpenCL driver starts: $PWD/missing/a.icd: /usr/lib/no-such-driver.so: cannot open" OCL_ICD_VENDORS="$PWD/missing"
! grep -q "install" err || complain "install: $(<err)"
# a scene of the host's engine asks for no device
printf 'scene: 1\nresults:\n  - {result: power, samplers: white, points: 16, max-frequency: 4, engine: host_direct, plot: false}\n' >host.yaml
POINTSPEC_CACHE_DIR=$PWD/cache OCL_ICD_VENDORS=$PWD/empty "$program" run host.yaml -o host --quiet >out 2>err ||
    complain "a scene without a device: $(<err)"
if "$program" devices 2>/dev/null | grep -q ',Portable Computing Language,'; then
    warm=${POCL_CACHE_DIR:-$PWD/warm}
    unset POCL_CACHE_DIR XDG_CACHE_HOME
    refused "POCL_DEVICES names, \"none\"" POCL_DEVICES=none
    refused "PoCL cannot keep kernels in /proc/none/.cache/pocl/kcache: /proc/none: No such file" HOME=/proc/none
    refused "PoCL cannot keep kernels in /proc/none" POCL_CACHE_DIR=/proc/none
    refused "letters, above its limit" POCL_CACHE_DIR="$long"
    # PoCL ends the process where it cannot compile, or where what it has kept is cut.
    for limit in '-n 12 ulimit -n' '-f 1 ulimit -f'; do
        read -r option number word <<<"$limit"
        code=0
        (ulimit "$option" "$number"; POCL_CACHE_DIR=$PWD/cold exec "${power[@]}" 2>err >/dev/null) || code=$?
        [[ $code == 1 && $(wc -l <err) == 1 && $(<err) == *"$word"*host_direct* ]] || complain "$limit: exit $code: $(<err)"
    done
    # A real kernel, cut to each of these lengths; copied, since others use it.
    POCL_CACHE_DIR=$warm "${power[@]}" --engine torus_direct >out
    object=$(find "$warm/" -name torus_fold.so -print -quit)
    mkdir -p kept/AB
    cp -a "${object%/*/*/*}" kept/AB/CDE
    object=$(find "$PWD/kept" -name torus_fold.so -print -quit)
    size=$(stat -c %s "$object")
    for bytes in $((size - 1)) $((size / 2)) 100 0; do
        truncate -s $bytes "$object"
        code=0
        POCL_CACHE_DIR=$PWD/kept "${power[@]}" --engine torus_direct >out 2>err || code=$?
        [[ $code == 1 && $(wc -l <err) == 1 && $(<err) == *"$object is damaged; remove that file"*POCL_CACHE_DIR* ]] ||
            complain "a kernel cut to $bytes bytes: exit $code: $(<err)"
    done
    code=0
    POCL_CACHE_DIR=$PWD/kept "$program" doctor >out 2>err || code=$?
    [[ $code == 3 && $(<out) == *WRONG*device*"$object is damaged"* ]] || complain "doctor: a kernel that is cut: exit $code: $(<out)"
    for kib in 200000 250000 300000 350000; do # PoCL ends the process where its threads get no stacks
        code=0
        # Sanitizers map more than that before the program begins.
        (ulimit -v $kib && "$program" --version) >/dev/null 2>&1 || continue
        (ulimit -v $kib; timeout -s KILL 600 "${power[@]}" >out 2>err) || code=$?
        [[ $code == 0 || ($code == 1 && $(wc -l <err) == 1 && $(<err) == *"ulimit -v"*) ]] ||
            complain "ulimit -v $kib: exit $code: $(<err)"
        ((kib > 200000)) || [[ $(<err) == *host_direct* ]] || complain "ulimit -v $kib: $(<err)"
    done
fi

# A simulator says that it is a GPU, and is listed first; whoever does not name it wants something faster.
simulator=$(dirname "$(dirname "$(command -v oclgrind || echo /none/none)")")/lib/oclgrind/liboclgrind-rt-icd.so
if [[ -e $simulator && -e /etc/OpenCL/vendors/pocl.icd ]]; then
    mkdir both
    echo "$simulator" >both/a.icd
    cp /etc/OpenCL/vendors/pocl.icd both/b.icd
    OCL_ICD_VENDORS=$PWD/both "$program" devices >out 2>err || complain "devices: $(<err)"
    [[ $(grep -c '^0,0,Oclgrind Simulator,gpu,' out) == 1 && $(grep -c '^1,1,.*,Portable Computing Language,' out) == 1 ]] ||
        complain "a simulator is the default: $(<out)"
fi

export OCL_ICD_VENDORS=$PWD/empty
# Kinds that may lack a device give the rows of their commands in a scene, too; beside one that needs it, that is refused.
printf 'v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 5 4\n' >corner.obj
cat >both.yaml <<'SCENE'
scene: 1
results:
  - {result: occlusion, name: corner, mesh: corner.obj, image: 6x4, reference: 64, sampler: white-sphere, points: 8, plot: false}
  - {result: interpolation, name: lobe, integrand: diffuse, sampler: fibonacci, points: 16, plot: false}
SCENE
"$program" plan run both.yaml >out 2>err || complain "plan of kinds that may lack a device: $(<err)"
"$program" run both.yaml -o lacking --cache 0 --quiet >out 2>err || complain "kinds that may lack a device: $(<err)"
"$program" occlusion --mesh corner.obj --image 6x4 --reference 64 --sampler white-sphere -n 8 -o corner.csv
"$program" interpolation --integrand diffuse --sampler fibonacci -n 16 -o lobe.csv
for name in corner lobe; do
    [[ $(tail -1 lacking/$name.csv) == $(tail -1 $name.csv) ]] || complain "$name: $(tail -1 lacking/$name.csv) $(tail -1 $name.csv)"
done
"$program" interpolation --integrand diffuse --sampler fibonacci -n 700,701 --memory 2.5M -o large.csv 2>err ||
    complain "two numbers of points without a matrix: $(<err)"
grep -q '^# engine: conjugate gradients' large.csv || complain "engine: $(<large.csv)"
code=0
"$program" run both.yaml -o named --cache 0 --quiet --device cpu >out 2>err || code=$?
[[ $code == 1 && $(<err) == *"no OpenCL driver found"* ]] || complain "a device was named: exit $code: $(<err)"
printf '  - {result: power, samplers: white, points: 16, max-frequency: 4, plot: false}\n' >>both.yaml
code=0
"$program" run both.yaml -o needed --cache 0 --quiet >out 2>err || code=$?
[[ $code == 1 && $(<err) == *"no OpenCL driver found"*host_direct* ]] || complain "one needs a device: exit $code: $(<err)"
"$program" plan power --sampler white -n 16 -k 4 >out 2>err || complain "plan: $(<err)"
[[ $(<out) == *"# no_device: no OpenCL driver found"*$'\nhost_direct:extended,chosen'* &&
    $(grep -c 'needs an OpenCL device' out) == 4 ]] || complain "plan: $(<out)"
"$program" plan quadrature --sampler fibonacci-hemisphere -n 16 --brdf diffuse >out 2>err || complain "plan quadrature: $(<err)"
grep -q '^host_direct:extended,chosen' out || complain "plan quadrature: $(<out)"
cat >small.yaml <<'SCENE'
scene: 1
results:
  - {result: power, samplers: white, points: 16, max-frequency: 4}
SCENE
"$program" plan run small.yaml >out 2>err || complain "plan run: $(<err)"
grep -q 'host_direct:extended,chosen' out || complain "plan run: $(<out)"
"$program" devices >out 2>err || complain "devices: exit $?"
[[ $(grep -vc '^#' out) == 1 && $(<err) == "pointspec devices: no OpenCL driver found"* ]] || complain "devices: $(<out) $(<err)"
"${power[@]}" --engine host_direct >out 2>err || complain "host_direct: $(<err)"

# Sets that only a device makes are refused, those that the host makes as well are not: nobody chose "".
code=0
"$program" plan power --engine host_direct --sampler step -n 64 -k 4 >out 2>err || code=$?
[[ $code == 1 && $(<err) == *"no OpenCL driver found"* ]] || complain "plan of step: exit $code: $(<err)"
POINTSPEC_DEVICE="" "$program" sample --sampler gaussian-blue-noise -n 270 -o points.txt 2>err || complain "gaussian: $(<err)"
finish

#!/usr/bin/env bash
# cli_occlusion.sh PROGRAM: pointspec occlusion of samplers and files: columns, the same bits beside other questions and in
# scenes, images, pictures, plans, and what it refuses.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" occlusion "$1"

printf 'v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 1 0\nv 0 1 1\nf 1 2 3 4\nf 1 5 6 2\n' >corner.obj
{ echo 'camera position .5 5 .5 direction 0 -1 0 up 0 0 1 focal 1 width .25' && echo 'quad floor grey 0 0 0 1 0 0 1 0 1 0 0 1'; } >floor.txt
asked=(--mesh corner.obj --image 12x10 --reference 256)

# a row for each sampler and number of points, whatever else is asked beside it
runs 0 "${asked[@]}" --sampler white-sphere --sampler fibonacci-hemisphere -n 8,16 -m 3
grep -v '^#' out >both
[[ $(head -1 both) == 'sampler,points,mse,mse_error,visibility' ]] || complain "$(head -1 both)"
[[ $(cut -d, -f1,2 both | sed 1d | tr '\n' ' ') == 'white-sphere,8 white-sphere,16 fibonacci-hemisphere,8 fibonacci-hemisphere,16 ' ]] ||
    complain "rows: $(<both)"
awk -F, 'NR > 1 && !($3 > 0 && $4 > 0 && $5 > .4 && $5 < .8) { exit 1 }' both || complain "numbers: $(<both)"
[[ $(key triangles) == 4 && $(key width) == 12 && $(key height) == 10 && $(key reference_rays) == 256 && $(key radius) == infinite ]] ||
    complain "header: $(<out)"
runs 0 "${asked[@]}" --sampler fibonacci-hemisphere -n 16 -m 3
[[ $(tail -1 out) == $(tail -1 both | cut -d, -f3-) ]] || complain "alone: $(tail -1 out)"
POCL_MAX_PTHREAD_COUNT=1 runs 0 "${asked[@]}" --sampler fibonacci-hemisphere -n 16 -m 3
[[ $(tail -1 out) == $(tail -1 both | cut -d, -f3-) ]] || complain "one thread: $(tail -1 out)"
mkdir empty
OCL_ICD_VENDORS=$PWD/empty runs 0 "${asked[@]}" --sampler fibonacci-hemisphere -n 16 -m 3
[[ $(tail -1 out) == $(tail -1 both | cut -d, -f3-) && $(key device) == none ]] || complain "without a device: $(tail -1 out)"

# above a plane everything is seen: by every ray of a hemisphere, which files have by --lift or --hemisphere, too
for points in '0 0 1' '.6 0 -.8' '0 0 -1'; do echo "$points"; done >points.txt
cp points.txt again.txt
runs 0 --mesh floor.txt --image 5x4 --sampler white-hemisphere -n 7 -m 2
[[ $(tail -1 out) == 0,0,1 ]] || complain "floor: $(<out)"
runs 0 --mesh floor.txt --image 5x4 --hemisphere points.txt
[[ $(tail -1 out) == 0,0,1 && $(key points) == 3 ]] || complain "files: $(<out)"
echo '.25 .5' >plane.txt
runs 0 --mesh floor.txt --image 5x4 --lift hemisphere plane.txt
[[ $(tail -1 out) == 0,0,1 ]] || complain "lifted: $(<out)"
runs 0 "${asked[@]}" --set a=points.txt --set b=again.txt --sampler white-sphere -n 3 --seed 5
[[ $(grep -c '^[ab],' out) == 2 ]] || complain "sets: $(<out)"

# a corner whose walls hide nothing beyond a small radius, but near the edge
runs 0 "${asked[@]}" --radius 1e-6 --sampler white-hemisphere -n 64 --camera 3,3,3,0.5,0,0.5,20
awk -F, 'END { exit !($3 > .99) }' out || complain "radius: $(<out)"

# images: the same numbers everywhere
runs 0 "${asked[@]}" --sampler white-sphere -n 16 --image-out a.npy
runs 0 "${asked[@]}" --sampler white-sphere -n 16 --image-out a.pfm -o a.npz
[[ $(head -c 14 a.pfm) == $'Pf\n12 10\n-1.0' ]] || complain "PFM: $(head -c 14 a.pfm)"
perl -e '
    local $/; open N, "a.npy"; open P, "a.pfm"; my ($n, $p) = (<N>, <P>);
    my @n = unpack("d<*", substr($n, 128)); my @p = unpack("f<*", substr($p, -480));
    exit(@n != 120 || grep { my $q = $p[12 * (9 - int($_ / 12)) + $_ % 12]; abs($n[$_] - $q) > 1e-7 || $q < 0 || $q > 2 } 0 .. 119)
' || complain 'a.npy and a.pfm differ'
runs 0 "${asked[@]}" --sampler white-sphere --sampler fibonacci -n 16 --image-out a.npy
[[ $(head -c 128 a.npy | tr -d '\0') == *'(2, 10, 12)'* ]] || complain 'images'

# pictures, plans and scenes
if command -v gnuplot >/dev/null; then
    runs 0 "${asked[@]}" --sampler white-sphere -n 16 --plot a.svg
    grep -q 'error, MSE' a.svg || complain 'picture of the image'
    runs 0 "${asked[@]}" --sampler white-sphere -n 16,32 --plot a.svg
    grep -q 'slope' a.svg || complain 'picture of errors'
fi
"$program" plan occlusion "${asked[@]}" --sampler white-sphere -n 16 >planned || complain 'plan'
grep -q '^# phase: rays; .* 120 pixels, 4 triangles' planned || complain "plan: $(<planned)"
cat >scene.yaml <<'EOF'
scene: 1
results:
  - {result: occlusion, mesh: corner.obj, image: 12x10, reference: 256, samplers: [white-sphere, fibonacci-hemisphere], points: [8, 16], realizations: 3, pictures: true}
EOF
"$program" run scene.yaml -o folder --quiet >/dev/null || complain 'scene'
[[ $(grep -h '^fibonacci-hemisphere,16' folder/*.csv | head -1) == "$(tail -1 both)" ]] || complain "scene: $(ls folder)"
if command -v gnuplot >/dev/null; then
    [[ -s folder/occlusion-1-picture-1.svg && $(<folder/occlusion-1-mse.svg) == *slope* ]] || complain "pictures of a scene: $(ls folder)"
fi

# memory: what is planned is refused where less is allowed, and enough where it is, with a set of a file, too
"$program" plan occlusion "${asked[@]}" --sampler white-sphere -n 5000 --format csv >planned || complain 'plan'
bytes=$(awk -F, '$2 == "chosen" { print $4 }' planned)
((bytes > 3 * 8 * 5000 + 120 * 28)) || complain "planned bytes: $bytes"
"$program" sample --sampler white-sphere -n 5000 -o many.txt
runs 0 "${asked[@]}" --sampler white-sphere -n 5000 --memory "$bytes"
[[ $(<planned) == *"# device: $(key device)"*"$(key engine),chosen,"* ]] || complain "engine of the plan: $(<planned)"
for source in '--sampler white-sphere -n 5000' many.txt; do
    # shellcheck disable=SC2086
    runs 1 "${asked[@]}" $source --memory $((bytes - 1))
    says "sets of 5000 directions take $bytes bytes, more than the memory limit (--memory) of $((bytes - 1))"
done
runs 1 --mesh corner.obj --image 4096x4096 --sampler white-sphere -n 4 --memory 100M
says '4096 x 4096 pixels and sets of 1024 directions take'
runs 1 "${asked[@]}" --reference 400000 --sampler white-sphere -n 4 --memory 1M

# what is refused
refuses 'is not an option of this command' "${asked[@]}" --sampler white-sphere --tol 1e-6
refuses '--mesh FILE is needed' --sampler white-sphere
refuses 'makes points of the torus' "${asked[@]}" --sampler white
refuses 'morphed points are denser' "${asked[@]}" --sampler white-hemisphere:morph=diffuse
refuses 'does not end in .pfm or .npy' "${asked[@]}" --sampler white-sphere --image-out a.exr
refuses 'a .pfm has one image' "${asked[@]}" --sampler white-sphere -n 4,8 --image-out a.pfm
refuses 'is not WIDTHxHEIGHT' --mesh corner.obj --image 12 --sampler white-sphere
refuses 'is not WIDTHxHEIGHT' --mesh corner.obj --image 4097x1 --sampler white-sphere
refuses 'has 5 numbers; a camera has 6' "${asked[@]}" --camera 1,2,3,4,5 --sampler white-sphere
refuses 'a field of view of 180 degrees' "${asked[@]}" --camera 3,3,3,0,0,0,180 --sampler white-sphere
refuses 'sees nothing of the mesh' "${asked[@]}" --camera 3,3,3,6,6,6 --sampler white-sphere
refuses 'looks at the point where it is' "${asked[@]}" --camera 3,3,3,3,3,3 --sampler white-sphere
refuses 'looks at the point where it is' "${asked[@]}" --camera 0,0,0,0,0,0,40,0,1,0 --sampler white-sphere
refuses 'looks along the direction that is to be up' "${asked[@]}" --camera 3,3,3,3,0,3 --sampler white-sphere
runs 1 --mesh nothing.obj --sampler white-sphere
says 'nothing.obj'
echo 'f 1 2 3' >bad.obj
refuses 'bad.obj, line 1: vertex 1 of a face is none of the 0 before it' --mesh bad.obj --sampler white-sphere
finish

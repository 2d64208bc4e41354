#!/usr/bin/env bash
# cli_mpi_rows.sh PROGRAM: ranks under mpirun that give each other rows of realizations (variance, quadrature, shade,
# interpolation, occlusion) write what one process writes, to the bit, also where others have begun. Skipped (77) where
# there is no mpirun or no module.
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
# shellcheck source=tests/harness/harness.sh
. "$here/../../harness/harness.sh" mpi_rows "$1"
# shellcheck source=tests/answers/ranks/ranks.sh
. "$here/ranks.sh"

printf '2,0,1,0\n' >light.txt
printf 'v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 5 4\n' >corner.obj
awk 'BEGIN { srand(5); for (s = 0; s < 41; s++) { if (s) print "#"
    for (i = 0; i < 5 + s % 3; i++) printf "%.9f %.9f %.9f\n", rand(), rand(), 0.5 + rand() } }' >sets.txt
sets=$PWD/sets.txt
light=coefficients:file=$PWD/light.txt
is_as_one 2 variance --engine host_direct --integrand disk --integrand gaussian --sampler jittered --sampler white -n 4,9 -m 40 -k 3
is_as_one 3 variance --engine host_direct --integrand disk --columns xyw -k 3 "$sets"
is_as_one 2 variance --engine host_direct --integrand disk --sampler sobol -n 16 -m 20 -k 3
is_as_one 2 variance --engine host_direct --integrand disk --sampler white -d 1 -n 9 -m 20 -k 8
"$program" power --engine host_direct --sampler jittered -n 9 -m 20 -k 5 -o saved.npz
"$program" angular --engine host_direct --lift hemisphere --columns xyw -l 5 "$sets" -o sphere.npz
is_as_one 3 check --engine host_direct --against "$PWD/saved.npz" --sampler jittered
is_as_one 2 check --engine host_direct --against "$PWD/sphere.npz" --lift hemisphere --columns xyw "$sets"
is_as_one 5 quadrature --engine host_direct --sampler white-hemisphere -n 9,16 -m 41 --brdf diffuse -l 5
is_as_one 3 quadrature --engine host_direct --sampler white-hemisphere -n 16 -m 9 --brdf glossy:n=5 -l 5 --weights optimal
is_as_one 3 quadrature --engine host_direct --columns xyw --lift hemisphere --brdf diffuse -l 5 "$sets"
is_as_one 3 quadrature --engine host_direct --sampler white-hemisphere -n 9 -m 20 --range 3:19 --brdf diffuse -l 5
is_as_one 2 quadrature --engine host_direct --sampler fibonacci-hemisphere -n 16 -m 9 --brdf diffuse -l 5
is_as_one 2 quadrature --engine host_direct --sampler white-hemisphere -n 9 -m 4000 --brdf diffuse -l 5 --standard-error 0.2
is_as_one 3 shade --engine host_direct --sampler white-hemisphere -n 9 -m 20 --brdf diffuse --integrand "$light"
is_as_one 2 interpolation --sampler white-sphere -n 16 -m 7 --integrand "$light" --smoothness 1.1,1.5
is_as_one 2 interpolation --lift sphere --columns xyw --integrand "$light" "$sets"
is_as_one 3 measure --sampler jittered -n 16 -m 7 -k 5
is_as_one 3 occlusion --mesh "$PWD/corner.obj" --image 8x8 --reference 64 --sampler white-sphere -n 4,9 -m 7
if "$program" devices >out 2>err && grep -q '^[0-9]' out; then
    is_as_one 3 quadrature --sampler white-hemisphere -n 64 -m 50 --brdf glossy:n=30 -l 20
    is_as_one 2 quadrature --lift hemisphere --columns xyw --brdf diffuse -l 8 "$sets"
    is_as_one 3 variance --integrand disk --integrand gaussian --sampler jittered -n 64 -m 200 -k 16
    is_as_one 2 variance --integrand cap --sampler white-sphere -n 30 -m 100 -l 12
    is_as_one 2 check --against "$PWD/saved.npz" --sampler jittered
fi

# What is there is the checkpoint of one process.
is_ended 'kept*.npz' variance --engine host_direct --integrand disk --sampler jittered -n 64 -m 2000 -k 3
is_ended 'kept*.npz' quadrature --engine host_direct --sampler white-hemisphere -n 64 -m 1500 --brdf diffuse -l 12

# Who is not alike.
job=(interpolation --sampler white-sphere -n 100 -m 60 --integrand "$light")
"$program" "${job[@]}" --checkpoint kept.npz --checkpoint-interval 0 >/dev/null 2>&1 &
wait_until $! test -e kept.npz
kill -9 $! 2>/dev/null || true
wait $! 2>/dev/null || true
if [[ -e kept.npz ]]; then
    mkdir elsewhere
    checked=$((checked + 1))
    kept=("${job[@]}" --checkpoint kept.npz --checkpoint-interval 0)
    mpirun -n 1 "$program" "${kept[@]}" : -n 1 -wdir "$PWD/elsewhere" "$program" "${kept[@]}" </dev/null >out 2>err && complain 'a checkpoint for one rank'
    grep '^pointspec' err >sentences
    sentence 'rank 1 has "0 realizations of a checkpoint", and rank 0 '
    rm -f kept*
fi

# What is not shared, and errors: one sentence, and the exit status of one process.
ranks 0 2 "${job[@]}" -m 1
sentence 'rank 0 works alone, and the others of 2 ranks wait: one realization is not shared'
ranks 0 2 check saved.npz --against saved.npz
sentence 'rank 0 works alone, and the others of 2 ranks wait: nothing is computed'
ranks 0 2 check --homogeneous --engine host_direct --sampler white -n 9 -m 40 -k 2
sentence 'rank 0 works alone, and the others of 2 ranks wait: phases of every set are kept'
ranks 3 2 check --engine host_direct --against saved.npz --sampler white -n 9 -m 40
sentence 'pointspec check: not the spectrum of "saved.npz"'
ranks 0 3 "${job[@]}" -m 2
sentence '1 of 3 ranks have nothing to do: there is work for 2'
ranks 1 2 "${job[@]}" -o nowhere/answer.csv
sentence 'pointspec interpolation: cannot write nowhere/answer.csv'
awk '/^#/ { s++ } s == 20 && !/^#/ { $3 = 0 } { print }' sets.txt >zero.txt
ranks 2 3 quadrature --engine host_direct --columns xyw --lift hemisphere --brdf diffuse -l 5 zero.txt
sentence 'set 21: all weights are 0'
[[ ! -s out ]] || complain "after an error: $(<out)"
finish

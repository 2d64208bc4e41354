/* What bench_plan asks: command lines of every command that can be planned, each longer than 50 ms.
 * Files named in them are made by the first table, in a folder of their own. */
#ifndef BENCH_PLAN_QUESTIONS_H
#define BENCH_PLAN_QUESTIONS_H

/* clang-format off */
static const struct {
    const char *name, *text;
} plan_scenes[] = {
    {"torus.yaml", "scene: 1\nresults:\n  - {result: power, name: spectra, samplers: [white, jittered, sobol], points: "
                   "[256, 1024], realizations: 200, max-frequency: 64}\n"},
    {"sphere.yaml", "scene: 1\nresults:\n  - {result: angular, name: degrees, samplers: [white-sphere, healpix-jittered], "
                    "points: [768, 3072], realizations: 50, max-degree: 64}\n  - {result: pairs, name: sums, samplers: "
                    "white-sphere, points: 512, realizations: 50, max-degree: 32}\n"},
    {"rules.yaml", "scene: 1\nresults:\n  - {result: quadrature, name: rules, brdf: [diffuse, 'glossy:n=30'], samplers: "
                   "[white-hemisphere, fibonacci-hemisphere], points: [256, 1024], realizations: 50}\n  - {result: "
                   "truncation, name: series, brdf: diffuse, max-degree: 10}\n"},
};

static const char *const plan_files[] = {
    "sample --sampler white -n 1000000 -o white.txt",
    "sample --sampler white -n 1000000 -o white.csv",
    "sample --sampler white -n 3000000 -o white.npy",
    "sample --sampler white -n 6000000 -o white.rps",
    "sample --sampler white -n 4096 -m 64 -o sets.txt",
    "sample --sampler white -n 4096 -m 512 -o sets.npy",
    "sample --sampler white-sphere -n 800000 -o sphere.txt",
    "sample --sampler white-sphere -n 1000000 -o sphere.npy",
    "sample --sampler white-sphere -n 1024 -m 256 -o rules.npy",
    "convert white.txt -o white.utkb --format utk-binary",
    "power --sampler jittered -n 1024 -m 400 -k 64 -o jittered.npz",
    "angular --sampler white-sphere -n 1024 -m 100 -l 64 -o angular.npz",
    NULL
};

/* What was off by 100 and more when only the engine's sums were counted, and one of each command:
 * for the tests. */
static const char *const plan_quick[] = {
    "power --sampler white -n 1e6 -k 64",
    "power --sampler sobol:scramble=owen -n 4096 -m 500 -k 64",
    "power --sampler white -n 1e5 -k 1000 --per-ring 4",
    "power white.txt -k 32",
    "angular --sampler white-sphere -n 1e6 -l 64",
    "pairs --sampler white-sphere -n 1024 -m 200 -l 128",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 70000",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 30000 --smoothness 1.7",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 4000 --weights optimal",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 8000 --weights optimal --memory 1e8",
    "truncation --brdf diffuse -l 12",
    "sample --sampler white -n 1e7 -o out.npy",
    "sample --sampler white -n 1e6 -o out.txt",
    "convert white.txt -o out.npy",
    NULL
};

static const char *const plan_questions[] = {
    /* the plane: one set and many, loose and tight, every engine */
    "power --sampler white -n 256 -m 20000 -k 32",
    "power --sampler white -n 1024 -m 4000 -k 64",
    "power --sampler white -n 4096 -m 1000 -k 64",
    "power --sampler white -n 4096 -m 500 -k 256",
    "power --sampler white -n 16384 -m 50 -k 512",
    "power --sampler white -n 65536 -m 10 -k 256",
    "power --sampler white -n 1e6 -k 256",
    "power --sampler white -n 1e7 -k 512",
    "power --sampler white -n 1e6 -k 1024 --tol 1e-9",
    "power --sampler white -n 4096 -m 300 -k 128 --tol 1e-12",
    "power --sampler white -n 1024 -m 100 -k 64 --engine torus_direct",
    "power --sampler white -n 2048 -m 20 -k 100 --engine torus_direct --precision double",
    "power --sampler white -n 512 -m 2 -k 20 --engine host_direct",
    "power --sampler jittered -n 1024 -m 2000 -k 64",
    "power --sampler sobol:scramble=owen -n 4096 -m 500 -k 64",
    "power --sampler sobol:scramble=xor -n 4096 -m 500 -k 64",
    "power --sampler halton -n 65536 -m 10 -k 128 --homogenize --no-skip",
    "power --sampler latin-hypercube -n 16384 -m 40 -k 128",
    "power --sampler larcher-pillichshammer:scramble=owen -n 4096 -m 300 -k 64",
    "power --sampler regular -n 1e6 -k 600",
    "power --sampler white -n 1024 -m 500 -k 200 --full full.npy",
    "power --sampler white -n 1024 -k 2000 --full full.npy",
    "power --sampler white -n 1024 -m 64 -k 64 --plot power.png",
    "power --sampler white -n 1024 -m 64 -k 64 --plot power.svg",
    "power --sampler white --sampler jittered -n 1024 -m 500 -k 64",
    "power --sampler white -n 1024 -m 3000 -k 64 --standard-error 0.02",
    "power --sampler white -n 1024 -m 200 -k 64 --bins shells",
    "power --sampler white -n 1e5 -k 1000 --per-ring 8",
    /* other dimensions */
    "power --sampler white -d 1 -n 16384 -m 200 -k 8192",
    "power --sampler white -d 1 -n 1e6 -k 1e5",
    "power --sampler white -d 3 -n 4096 -m 100 -k 16",
    "power --sampler white -d 3 -n 1e6 -k 50",
    "power --sampler white -d 3 -n 4096 -m 8 -k 64",
    "power --sampler sobol -d 4 -n 4096 -k 8 --homogenize",
    "power --sampler white -d 5 -n 1024 -k 6",
    "power --sampler white -d 6 -n 1024 -k 20 --per-ring 200",
    /* files of the torus */
    "power white.txt -k 128",
    "power white.csv -k 128",
    "power white.npy -k 256",
    "power white.rps -k 256",
    "power white.utkb -k 128",
    "power sets.txt -k 64",
    "power sets.npy -k 64",
    "power sets.npy -k 64 --normalize effective",
    /* the sphere */
    "angular --sampler white-sphere -n 1024 -m 2000 -l 64",
    "angular --sampler white-sphere -n 1024 -m 500 -l 128",
    "angular --sampler white-sphere -n 4096 -m 200 -l 256",
    "angular --sampler white-sphere -n 16384 -m 20 -l 512",
    "angular --sampler white-sphere -n 1e6 -l 512",
    "angular --sampler white-sphere -n 1e6 -l 1000 --tol 1e-9",
    "angular --sampler white-sphere -n 3e6 -l 64",
    "angular --sampler fibonacci -n 1e6 -l 256",
    "angular --sampler spiral -n 1e6 -l 256",
    "angular --sampler healpix:nside=128 -l 384",
    "angular --sampler healpix-jittered:nside=64 -m 10 -l 256",
    "angular --sampler zphi:strata=64x64 -n 4096 -m 100 -l 128",
    "angular --sampler white-hemisphere -n 1024 -m 500 -l 128 --hemisphere",
    "angular --sampler fibonacci-hemisphere:morph=diffuse -n 65536 -l 512 --hemisphere",
    "angular --sampler white-sphere -n 1024 -m 100 -l 128 --engine sphere_direct",
    "angular --sampler white-sphere -n 4096 -m 10 -l 256 --engine sphere_direct --precision double",
    "angular --sampler white-sphere -n 1000 -l 64 --engine host_direct",
    "angular --sampler white-sphere -n 65536 -l 1024 --coefficients c.npy",
    "angular --sampler jittered:lift=sphere -n 4096 -m 300 -l 128",
    "angular sphere.txt -l 256",
    "angular sphere.npy -l 256",
    "angular rules.npy -l 128",
    /* pairs */
    "pairs --sampler white-sphere -n 1024 -m 200 -l 128",
    "pairs --sampler white-sphere -n 4096 -m 10 -l 256",
    "pairs --sampler white-sphere -n 16384 -l 512",
    "pairs --sampler white-sphere -n 2000 -m 20 -l 64 --engine pairs_direct",
    "pairs --sampler white-sphere -n 2000 -m 20 -l 64 --engine pairs_histogram --tol 1e-3",
    "pairs --sampler fibonacci -n 20000 -l 100",
    "pairs --sampler white-hemisphere -n 1024 -m 100 -l 100 --hemisphere",
    "pairs rules.npy -l 64",
    "pairs --sampler white-sphere -n 1e6 -l 300",
    /* quadrature */
    "quadrature --brdf diffuse --sampler white-hemisphere -n 256 -m 2000",
    "quadrature --brdf diffuse --sampler white-hemisphere -n 1024 -m 500",
    "quadrature --brdf glossy:n=30 --sampler white-hemisphere -n 1024 -m 500",
    "quadrature --brdf glossy:n=1000 --sampler fibonacci-hemisphere -n 8192",
    "quadrature --brdf phong:n=40 --sampler white-hemisphere -n 512 -m 500",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 20000",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 100000",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 60000 --smoothness 1.9",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 30000 --smoothness 1.7",
    "quadrature --brdf diffuse --sampler white-hemisphere -n 30000 -m 3",
    "quadrature --brdf glossy:n=30 --sampler white-hemisphere -n 256 -m 200 --weights optimal",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 1000 --weights optimal",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 4000 --weights optimal",
    "quadrature --brdf diffuse --sampler white-hemisphere -n 2000 -m 3 --weights optimal",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 4000 --weights optimal --smoothness 1.9",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 8000 --weights optimal --memory 1e8",
    "quadrature --brdf diffuse --sampler fibonacci-hemisphere -n 20001 --weights optimal",
    "quadrature --brdf glossy:n=30 --sampler white-hemisphere -n 1024 -m 2000 --standard-error 0.05",
    "quadrature --brdf diffuse rules.npy --drop-below-horizon",
    /* truncation */
    "truncation --brdf diffuse",
    "truncation --brdf glossy:n=30 -l 40",
    "truncation --brdf glossy:n=100 -l 40",
    "truncation --brdf phong:n=30 -l 30",
    "truncation --brdf phong:n=5 --harmonics hemispherical -l 12",
    "truncation --brdf glossy:n=30 --harmonics hemispherical -l 20",
    "truncation --brdf diffuse -l 300 --smoothness 1.9",
    /* points */
    "sample --sampler white -n 1e7 -o out.npy",
    "sample --sampler white -n 1e6 -o out.txt",
    "sample --sampler white -n 1e6 -o out.csv",
    "sample --sampler sobol:scramble=owen -n 3e6 -o out.npy",
    "sample --sampler sobol -n 3e6 -d 4 -o out.npy",
    "sample --sampler halton -n 3e6 -d 3 -o out.npy",
    "sample --sampler jittered -n 4e6 -o out.npy",
    "sample --sampler latin-hypercube -n 2e6 -o out.npy",
    "sample --sampler healpix:nside=512 -o out.npy",
    "sample --sampler healpix-jittered:nside=512 -o out.npy",
    "sample --sampler fibonacci -n 2e6 -o out.npy",
    "sample --sampler spiral -n 2e6 -o out.npy",
    "sample --sampler white-sphere -n 4e6 -o out.npy",
    "sample --sampler white-hemisphere:morph=glossy,n=30 -n 2e6 -o out.npy",
    "convert white.txt -o out.npy",
    "convert white.npy -o out.txt",
    "convert white.csv -o out.txt",
    "convert white.rps -o out.npy",
    "convert white.npy -o out.csv",
    "convert sphere.txt -o out.npy",
    "convert sphere.npy -o out.csv",
    /* scenes */
    "run torus.yaml --cache 0",
    "run sphere.yaml --cache 0",
    "run rules.yaml --cache 0",
    /* against what was saved */
    "check --against jittered.npz --sampler jittered -n 1024 -m 400",
    "check --against jittered.npz --sampler jittered -n 1024 -m 2000",
    "check --against angular.npz --sampler white-sphere -n 1024 -m 1000",
    NULL
};
/* clang-format on */

#endif

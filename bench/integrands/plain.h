/* Values of integrands at points of the plane as plain loops have them: one thread, libm, compiled
 * with -O3 -march=native, in the precision of the points. What bench_integrands is measured
 * against.
 */
#ifndef BENCH_INTEGRANDS_PLAIN_H
#define BENCH_INTEGRANDS_PLAIN_H

#include <stddef.h>

/* Centre, then what it has: radius; two sides; 1/(2 sigma^2) and images on each side; a wave has
 * two numbers of its vector instead of a centre, and a phase; a map has its width and height, and
 * the rows of kernels/integrands/map.h. */
typedef struct bench_plain_numbers {
    double a[2], b[2];
    const float *singles;
    const double *doubles;
} bench_plain_numbers;

/* The sum over num points, [num][2]; of a map [num][3]. */
typedef double bench_plain_single(const float *points, size_t num, bench_plain_numbers of);
typedef double bench_plain_double(const double *points, size_t num, bench_plain_numbers of);

bench_plain_single bench_plain_disk_single, bench_plain_box_single, bench_plain_gaussian_single,
    bench_plain_wave_single, bench_plain_map_single;
bench_plain_double bench_plain_disk_double, bench_plain_box_double, bench_plain_gaussian_double,
    bench_plain_wave_double, bench_plain_map_double;

#endif

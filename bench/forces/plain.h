/* All pairs of step blue noise by plain C loops, each pair once, compiled with -O3 -march=native in
 * one thread: what bench_step is measured against. */
#ifndef BENCH_FORCES_PLAIN_H
#define BENCH_FORCES_PLAIN_H

#include <stddef.h>
#include <stdint.h>

/* Pairs of points x [num][2] by distance, in num_bins bins of [0, 1/2). */
void bench_plain_counts(size_t num, const double *x, size_t num_bins, uint64_t *counts);
/* Sums of differences times table[bin], [num][2]. */
void bench_plain_forces(size_t num, const double *x, size_t num_bins, const double *table,
                        double *force);

#endif

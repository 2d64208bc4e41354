/* What sets of the plane are judged by: powers in bins, distances to the nearest. Plain sums, so
 * that nothing of the engines is in them. */
#ifndef BENCH_FORCES_MEASURES_H
#define BENCH_FORCES_MEASURES_H

#include <stddef.h>

/* nu = |k| / sqrt(N) in bins of this width. */
enum { BENCH_POWER_BINS = 34 };
#define BENCH_POWER_BIN_WIDTH 0.04

typedef struct bench_powers {
    double sum[BENCH_POWER_BINS], num[BENCH_POWER_BINS];
} bench_powers;

void bench_powers_add(bench_powers *powers, size_t num, const double *x);
/* Mean over the bin that holds nu. */
double bench_powers_mean(const bench_powers *powers, double nu);
/* Pairs nearer than a distance, in units of 1/sqrt(N). */
size_t bench_pairs_within(size_t num, const double *x, double distance);
/* Mean distance to the nearest neighbour, in units of that of hexagonal packing. */
double bench_nearest(size_t num, const double *x);

#endif

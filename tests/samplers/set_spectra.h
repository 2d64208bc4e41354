/* What a set of the plane is judged by: distances and powers, by plain sums. */
#ifndef TEST_SET_SPECTRA_H
#define TEST_SET_SPECTRA_H

#include <math.h>
#include <stddef.h>

typedef struct set_distances {
    double least, mean; /* to the nearest neighbour, in units of hexagonal packing's */
} set_distances;

static inline set_distances measure_distances(size_t num, const double *points) {
    const double hexagonal = sqrt(2 / (sqrt(3) * (double)num));
    set_distances found = {HUGE_VAL, 0};
    for (size_t i = 0; i < num; i++) {
        double nearest = HUGE_VAL;
        for (size_t j = 0; j < num; j++) {
            if (j != i) {
                double dx = points[2 * i] - points[2 * j];
                double dy = points[2 * i + 1] - points[2 * j + 1];
                dx -= rint(dx);
                dy -= rint(dy);
                nearest = fmin(nearest, dx * dx + dy * dy);
            }
        }
        found.least = fmin(found.least, sqrt(nearest) / hexagonal);
        found.mean += sqrt(nearest) / hexagonal / (double)num;
    }
    return found;
}

/* Sums of power over frequencies with |k| / sqrt(N) in bins of this width. */
enum { POWER_BINS = 30 };
#define POWER_BIN_WIDTH 0.04

typedef struct power_bins {
    double sum[POWER_BINS], num[POWER_BINS];
} power_bins;

static inline double power_at(size_t num, const double *points, int kx, int ky) {
    double c = 0;
    double s = 0;
    for (size_t i = 0; i < num; i++) {
        const double turns = kx * points[2 * i] + ky * points[2 * i + 1];
        const double angle = 2 * acos(-1) * (turns - rint(turns));
        c += cos(angle);
        s += sin(angle);
    }
    return (c * c + s * s) / (double)num;
}

/* Frequencies up to POWER_BINS bins; k and -k are one. */
static inline void add_power(power_bins *bins, size_t num, const double *points) {
    const double root = sqrt((double)num);
    const int most = (int)(POWER_BINS * POWER_BIN_WIDTH * root);
    for (int kx = 0; kx <= most; kx++) {
        for (int ky = kx == 0 ? 1 : -most; ky <= most; ky++) {
            const int bin = (int)(hypot(kx, ky) / root / POWER_BIN_WIDTH);
            if (bin < POWER_BINS) {
                bins->sum[bin] += power_at(num, points, kx, ky);
                bins->num[bin]++;
            }
        }
    }
}

/* Mean over the bin that holds nu. */
static inline double mean_power(const power_bins *bins, double nu) {
    const int bin = (int)(nu / POWER_BIN_WIDTH);
    return bins->sum[bin] / bins->num[bin];
}

/* The centre of the bin with the largest mean. */
static inline double peak_of(const power_bins *bins) {
    int peak = 1;
    for (int b = 1; b < POWER_BINS; b++) {
        peak = bins->sum[b] / bins->num[b] > bins->sum[peak] / bins->num[peak] ? b : peak;
    }
    return (peak + 0.5) * POWER_BIN_WIDTH;
}

#endif

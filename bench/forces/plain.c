#include "forces/plain.h"

#include <math.h>
#include <string.h>

void bench_plain_counts(size_t num, const double *x, size_t num_bins, uint64_t *counts) {
    memset(counts, 0, num_bins * sizeof *counts);
    for (size_t i = 0; i < num; i++) {
        for (size_t j = i + 1; j < num; j++) {
            double dx = x[2 * i] - x[2 * j];
            double dy = x[2 * i + 1] - x[2 * j + 1];
            dx -= rint(dx);
            dy -= rint(dy);
            const double r = sqrt(dx * dx + dy * dy);
            if (r < 0.5) {
                counts[(size_t)(r * 2 * (double)num_bins)]++;
            }
        }
    }
}

void bench_plain_forces(size_t num, const double *x, size_t num_bins, const double *table,
                        double *force) {
    memset(force, 0, 2 * num * sizeof *force);
    for (size_t i = 0; i < num; i++) {
        for (size_t j = i + 1; j < num; j++) {
            double dx = x[2 * i] - x[2 * j];
            double dy = x[2 * i + 1] - x[2 * j + 1];
            dx -= rint(dx);
            dy -= rint(dy);
            const double r = sqrt(dx * dx + dy * dy);
            if (r < 0.5) {
                const double f = table[(size_t)(r * 2 * (double)num_bins)];
                force[2 * i] += f * dx;
                force[2 * i + 1] += f * dy;
                force[2 * j] -= f * dx;
                force[2 * j + 1] -= f * dy;
            }
        }
    }
}

#include "forces/measures.h"

#include <math.h>

static const double TWICE_PI = 6.283185307179586477;

static double power_at(size_t num, const double *x, int kx, int ky) {
    double real = 0;
    double imaginary = 0;
    for (size_t i = 0; i < num; i++) {
        const double turns = kx * x[2 * i] + ky * x[2 * i + 1];
        const double angle = TWICE_PI * (turns - rint(turns));
        real += cos(angle);
        imaginary += sin(angle);
    }
    return (real * real + imaginary * imaginary) / (double)num;
}

/* k and -k are one. */
void bench_powers_add(bench_powers *powers, size_t num, const double *x) {
    const double root = sqrt((double)num);
    const int most = (int)(BENCH_POWER_BINS * BENCH_POWER_BIN_WIDTH * root);
    for (int kx = 0; kx <= most; kx++) {
        for (int ky = kx == 0 ? 1 : -most; ky <= most; ky++) {
            const int bin = (int)(hypot(kx, ky) / root / BENCH_POWER_BIN_WIDTH);
            if (bin < BENCH_POWER_BINS) {
                powers->sum[bin] += power_at(num, x, kx, ky);
                powers->num[bin]++;
            }
        }
    }
}

double bench_powers_mean(const bench_powers *powers, double nu) {
    const int bin = (int)(nu / BENCH_POWER_BIN_WIDTH);
    return powers->sum[bin] / powers->num[bin];
}

static double distance2(const double *a, const double *b) {
    const double dx = a[0] - b[0] - rint(a[0] - b[0]);
    const double dy = a[1] - b[1] - rint(a[1] - b[1]);
    return dx * dx + dy * dy;
}

size_t bench_pairs_within(size_t num, const double *x, double distance) {
    size_t pairs = 0;
    for (size_t i = 0; i < num; i++) {
        for (size_t j = 0; j < i; j++) {
            pairs += distance2(x + 2 * i, x + 2 * j) * (double)num < distance * distance;
        }
    }
    return pairs;
}

double bench_nearest(size_t num, const double *x) {
    double sum = 0;
    for (size_t i = 0; i < num; i++) {
        double nearest = HUGE_VAL;
        for (size_t j = 0; j < num; j++) {
            nearest = j == i ? nearest : fmin(nearest, distance2(x + 2 * i, x + 2 * j));
        }
        sum += sqrt(nearest);
    }
    return sum / (double)num / sqrt(2 / (sqrt(3) * (double)num));
}

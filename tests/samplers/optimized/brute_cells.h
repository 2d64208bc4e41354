/* Power cells of a torus by all images of all sites, and what sets are judged by, with nothing of
 * the library: slow, in long double, one cell at a time.
 */
#ifndef BRUTE_CELLS_H
#define BRUTE_CELLS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#define assert_close(a, b, tolerance)                                                              \
    assert_numbers_close((a), (b), (tolerance), __FILE__, __LINE__)
static inline void assert_numbers_close(double a, double b, double tolerance, const char *file,
                                        int line) {
    if (!(fabs(a - b) <= tolerance)) {
        print_error("%s:%d: %.17g is not %.17g to %g\n", file, line, a, b, tolerance);
        _fail(file, line);
    }
}

enum { BRUTE_ROOM = 512, BRUTE_IMAGES = 2 /* periods to either side */ };

typedef struct brute_polygon {
    int num;
    long double x[BRUTE_ROOM], y[BRUTE_ROOM];
} brute_polygon;

typedef struct brute_cell {
    double area, x, y; /* centroid relative to the site */
} brute_cell;

/* Sutherland and Hodgman: places p with p.d <= h stay. */
static inline void brute_cut(brute_polygon *polygon, long double dx, long double dy,
                             long double h) {
    brute_polygon out = {.num = 0};
    for (int k = 0; k < polygon->num; k++) {
        const int next = (k + 1) % polygon->num;
        const long double here = polygon->x[k] * dx + polygon->y[k] * dy - h;
        const long double there = polygon->x[next] * dx + polygon->y[next] * dy - h;
        if (here <= 0) {
            out.x[out.num] = polygon->x[k];
            out.y[out.num++] = polygon->y[k];
        }
        if ((here <= 0) != (there <= 0)) {
            const long double t = here / (here - there);
            out.x[out.num] = polygon->x[k] + t * (polygon->x[next] - polygon->x[k]);
            out.y[out.num++] = polygon->y[k] + t * (polygon->y[next] - polygon->y[k]);
        }
        assert_true(out.num + 2 < BRUTE_ROOM);
    }
    *polygon = out;
}

static inline brute_cell brute_moments(const brute_polygon *polygon) {
    long double area = 0;
    long double x = 0;
    long double y = 0;
    for (int k = 0; k < polygon->num; k++) {
        const int next = (k + 1) % polygon->num;
        const long double cross =
            polygon->x[k] * polygon->y[next] - polygon->x[next] * polygon->y[k];
        area += cross / 2;
        x += cross * (polygon->x[k] + polygon->x[next]) / 6;
        y += cross * (polygon->y[k] + polygon->y[next]) / 6;
    }
    return area > 0 ? (brute_cell){(double)area, (double)(x / area), (double)(y / area)}
                    : (brute_cell){0, 0, 0};
}

/* Of sites x, y with weights w: the cell of site i. No two sites may coincide. */
static inline brute_cell brute_clip(size_t num, const double *x, const double *y, const double *w,
                                    size_t i) {
    brute_polygon polygon = {4, {2, 2, -2, -2}, {-2, 2, 2, -2}};
    for (size_t j = 0; j < num; j++) {
        for (int image = 0; image < (2 * BRUTE_IMAGES + 1) * (2 * BRUTE_IMAGES + 1); image++) {
            const int a = image / (2 * BRUTE_IMAGES + 1) - BRUTE_IMAGES;
            const int b = image % (2 * BRUTE_IMAGES + 1) - BRUTE_IMAGES;
            const long double dx = (long double)x[j] + a - x[i];
            const long double dy = (long double)y[j] + b - y[i];
            if (polygon.num > 0 && (j != i || a != 0 || b != 0)) {
                brute_cut(&polygon, dx, dy, (dx * dx + dy * dy + w[i] - w[j]) / 2);
            }
        }
    }
    return brute_moments(&polygon);
}

/* ---- what a set is judged by ---- */

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

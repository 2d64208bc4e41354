/* What a set of the plane is judged by: distances, and powers by plain sums. */
#ifndef TEST_SET_DISTANCES_H
#define TEST_SET_DISTANCES_H

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

#endif

#include "math/lift.h"

#include "base/wide.h"
#include "shared/sphere_point.h"

#include <math.h>

ps_height ps_height_of_ratio(double numerator, double denominator) {
    return (ps_height){numerator / denominator, (denominator - fabs(numerator)) / denominator};
}

ps_height ps_height_of_area(bool on_hemisphere, double x) {
    /* Doubling is exact, and so is 1 - x from 1/2 on: each number is rounded once at most. */
    if (on_hemisphere) {
        return (ps_height){x, 1 - x};
    }
    return (ps_height){2 * x - 1, 2 * (x < 1 - x ? x : 1 - x)};
}

void ps_sphere_point(ps_height height, ps_turns azimuth, double point[PS_VECTOR_DIMENSION]) {
    double cosine = 0;
    double sine = 0;
    ps_turns_cosine_sine(azimuth, &cosine, &sine);
    ps_sphere_point_of(height.z, height.t, cosine, sine, point);
}

enum { BLOCK = 64 }; /* points that are lifted side by side */

#define LIFT_BLOCK(on_hemisphere, x, y, out)                                                       \
    for (size_t j = 0; j < BLOCK; j++) {                                                           \
        double point[PS_VECTOR_DIMENSION];                                                         \
        ps_sphere_point_of_area(on_hemisphere, x[j], y[j], point);                                 \
        out[0][j] = point[0];                                                                      \
        out[1][j] = point[1];                                                                      \
        out[2][j] = point[2];                                                                      \
    }

PS_WIDE_BODY(size_t, lift, (bool on_hemisphere, const double *pairs, double *vectors)) {
    double x[BLOCK];
    double y[BLOCK];
    double out[PS_VECTOR_DIMENSION][BLOCK];
    for (size_t j = 0; j < BLOCK; j++) {
        x[j] = pairs[2 * j];
        y[j] = pairs[2 * j + 1];
    }
    if (on_hemisphere) { /* known in each loop, which is vectorised then */
        LIFT_BLOCK(true, x, y, out);
    } else {
        LIFT_BLOCK(false, x, y, out);
    }
    for (size_t j = 0; j < BLOCK; j++) {
        for (size_t i = 0; i < PS_VECTOR_DIMENSION; i++) {
            vectors[PS_VECTOR_DIMENSION * j + i] = out[i][j];
        }
    }
    return BLOCK;
}
PS_WIDE(size_t, lift, (bool on_hemisphere, const double *pairs, double *vectors),
        (on_hemisphere, pairs, vectors))

/* From the end: a vector takes more room than its pair. */
void ps_sphere_lift(bool on_hemisphere, size_t first, size_t end, double *points) {
    size_t j = end;
    while (j - first >= BLOCK) {
        j -= BLOCK;
        lift(on_hemisphere, points + 2 * j, points + PS_VECTOR_DIMENSION * j);
    }
    while (j-- > first) {
        ps_sphere_point_of_area(on_hemisphere, points[2 * j], points[2 * j + 1],
                                points + PS_VECTOR_DIMENSION * j);
    }
}

void ps_sphere_fold(size_t num_points, double *points) {
    for (size_t j = 0; j < num_points; j++) {
        double *const point = points + PS_VECTOR_DIMENSION * j;
        if (point[2] < 0) {
            for (unsigned i = 0; i < PS_VECTOR_DIMENSION; i++) {
                point[i] = 0 - point[i]; /* no -0 */
            }
        }
    }
}

#include "math/lift.h"

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

static void place(ps_height height, double cosine, double sine, double *point) {
    const double sine_theta = sqrt(height.t * (2 - height.t));
    point[0] = sine_theta * cosine + 0.0; /* adding 0 makes a -0 positive */
    point[1] = sine_theta * sine + 0.0;
    point[2] = height.z + 0.0;
}

void ps_sphere_point(ps_height height, ps_turns azimuth, double point[PS_VECTOR_DIMENSION]) {
    double cosine = 0;
    double sine = 0;
    ps_turns_cosine_sine(azimuth, &cosine, &sine);
    place(height, cosine, sine, point);
}

void ps_sphere_point_portable(ps_height height, ps_turns azimuth,
                              double point[PS_VECTOR_DIMENSION]) {
    double cosine = 0;
    double sine = 0;
    ps_turns_portable(azimuth, &cosine, &sine);
    place(height, cosine, sine, point);
}

void ps_sphere_lift(bool on_hemisphere, size_t first, size_t end, double *points) {
    for (size_t j = end; j-- > first;) { /* from the end: a vector takes more room than its pair */
        const double x = points[2 * j];
        const double y = points[2 * j + 1];
        ps_sphere_point(ps_height_of_area(on_hemisphere, x), ps_turns_of(y),
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

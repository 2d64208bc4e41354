#include "engines/host/host_direct.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

typedef struct direction {
    long double u[PS_SPHERE_DIMENSION], weight;
} direction;

static pspec_status make_directions(const pspec_pattern *pattern, int exponent, direction **out,
                                    ps_error *error) {
    PS_TRY(PS_NEW(out, pattern->num_points, "directions", error));
    for (size_t j = 0; j < pattern->num_points; j++) {
        const double *u = pattern->points + j * PS_SPHERE_DIMENSION;
        const long double x = u[0], y = u[1], z = u[2];
        const long double length = sqrtl(x * x + y * y + z * z);
        const long double weight = pattern->weights != NULL ? pattern->weights[j] : 1;
        (*out)[j] = (direction){{x / length, y / length, z / length}, ldexpl(weight, -exponent)};
    }
    return PSPEC_OK;
}

/* |a - side b|^2 */
static long double square_distance(const direction *a, const direction *b, int side) {
    long double square = 0;
    for (int axis = 0; axis < PS_SPHERE_DIMENSION; axis++) {
        const long double d = a->u[axis] - side * b->u[axis];
        square += d * d;
    }
    return square;
}

static void add_pair(long double *sums, int32_t max_degree, const direction *a,
                     const direction *b) {
    long double cosine = 0;
    for (int axis = 0; axis < PS_SPHERE_DIMENSION; axis++) {
        cosine += a->u[axis] * b->u[axis];
    }
    const int side = cosine < 0 ? -1 : 1;
    const long double t = square_distance(a, b, side) / 2;
    const long double weight = 2 * a->weight * b->weight;
    long double p = 1;
    long double d = 0;
    sums[0] += weight;
    for (int32_t l = 1; l <= max_degree; l++) {
        d = ((long double)(l - 1) * d - (2 * l - 1) * t * p) / l;
        p += d;
        sums[l] += (l % 2 != 0 ? side : 1) * weight * p;
    }
}

pspec_status ps_host_pairs(const pspec_pattern *pattern, int exponent, int32_t max_degree,
                           long double *sums, ps_error *error) {
    direction *all = NULL;
    PS_TRY(make_directions(pattern, exponent, &all, error));
    for (int32_t l = 0; l <= max_degree; l++) {
        sums[l] = 0;
    }
    for (size_t i = 0; i < pattern->num_points; i++) {
        for (int32_t l = 0; l <= max_degree; l++) {
            sums[l] += all[i].weight * all[i].weight;
        }
        for (size_t j = 0; j < i; j++) {
            add_pair(sums, max_degree, &all[i], &all[j]);
        }
    }
    free(all);
    return PSPEC_OK;
}

pspec_status ps_host_chords(const pspec_pattern *pattern, double power, long double *sum,
                            ps_error *error) {
    direction *all = NULL;
    PS_TRY(make_directions(pattern, 0, &all, error));
    *sum = 0;
    for (size_t i = 0; i < pattern->num_points; i++) {
        for (size_t j = 0; j < i; j++) {
            *sum += 2 * all[i].weight * all[j].weight *
                    powl(square_distance(&all[i], &all[j], 1), power);
        }
    }
    free(all);
    return PSPEC_OK;
}

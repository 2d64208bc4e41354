/* What tests of capacity-constrained sets share: both spaces, with distances of the test's own. */
#ifndef CCVT_CASES_H
#define CCVT_CASES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "samplers/ccvt/ccvt.h"

/* The square of the angle of unit vectors, by their chord: right also where it is small. */
static inline double ccvt_square_angle(const double *u, const double *v) {
    const double x = u[0] - v[0];
    const double y = u[1] - v[1];
    const double z = u[2] - v[2];
    const double angle = 2 * asin(fmin(1, sqrt(x * x + y * y + z * z) / 2));
    return angle * angle;
}

static inline double ccvt_square_wrapped(const double *u, const double *v) {
    const double x = u[0] - v[0];
    const double y = u[1] - v[1];
    return (x - rint(x)) * (x - rint(x)) + (y - rint(y)) * (y - rint(y));
}

typedef struct ccvt_case {
    const char *name;
    unsigned axes;
    const ps_ccvt_space *space;
    double (*square)(const double *, const double *);
} ccvt_case;

static const ccvt_case ccvt_cases[] = {{"torus", 2, &ps_torus_ccvt_space, ccvt_square_wrapped},
                                       {"sphere", 3, &ps_sphere_ccvt_space, ccvt_square_angle}};
enum { CCVT_CASES = sizeof ccvt_cases / sizeof ccvt_cases[0] };

static inline void ccvt_assert_ok(pspec_status status, const ps_error *error) {
    if (status != PSPEC_OK) {
        fail_msg("%s", error->message);
    }
}

/* Sites and background of a realization, not yet optimised. */
static inline void ccvt_begin_case(ps_ccvt *c, const ccvt_case *which, size_t num, size_t capacity,
                                   uint64_t realization) {
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, realization);
    ps_error error = {0};
    ccvt_assert_ok(ps_ccvt_create(c, which->space, num, capacity, &random, NULL, &error), &error);
}

static inline ps_ccvt_outcome ccvt_make_case(const ccvt_case *which, size_t num, size_t capacity,
                                             uint64_t realization, double *points) {
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, realization);
    ps_ccvt_outcome outcome = {0};
    ps_error error = {0};
    ccvt_assert_ok(
        ps_ccvt_make(which->space, num, capacity, &random, NULL, points, &outcome, &error), &error);
    return outcome;
}

/* The square of the distance from point k to site i by the test's own formula. */
static inline double ccvt_square(const ps_ccvt *c, const ccvt_case *which, size_t k, size_t i) {
    double point[PS_CCVT_AXES] = {0};
    double site[PS_CCVT_AXES] = {0};
    ps_ccvt_place(c->at, k, which->axes, point);
    ps_ccvt_place(c->site, i, which->axes, site);
    return which->square(point, site);
}

#endif

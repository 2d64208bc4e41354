#include "samplers/ccvt/ccvt.h"

#include "base/memory.h"
#include "math/lift.h"
#include "math/pi.h"
#include "math/random/rotation.h"
#include "samplers/sphere/spherical_fibonacci.h"

#include <math.h>
#include <stdlib.h>

/* The square of an angle, of the square c of its chord: sum over n of 2 c^n / (n^2 binomial(2n,n)),
 * the series of the square of the arc sine. Eight terms are right to 2e-9 up to 41 degrees, which
 * regions of 16 sites and more do not reach, and grow like the angle everywhere: only + and *
 * decide. */
enum { TERMS = 8 };
static const double SERIES[TERMS] = {1,          1.0 / 12,    1.0 / 90,    1.0 / 560,
                                     1.0 / 3150, 1.0 / 16632, 1.0 / 84084, 1.0 / 411840};

/* Points whose background is made at a time. */
enum { PIECE = 1 << 10 };

static inline double square_chord(double *const *at, size_t k, const double *place) {
    const double x = at[0][k] - place[0];
    const double y = at[1][k] - place[1];
    const double z = at[2][k] - place[2];
    return x * x + y * y + z * z;
}

static void costs(double *const *at, size_t first, size_t num, const double *place, double *out) {
    for (size_t k = 0; k < num; k++) {
        const double c = square_chord(at, first + k, place);
        double sum = SERIES[TERMS - 1];
        for (unsigned n = TERMS - 1; n-- > 0;) {
            sum = sum * c + SERIES[n];
        }
        out[k] = sum * c;
    }
}

/* The derivative by c. */
static inline double slope(double c) {
    double sum = TERMS * SERIES[TERMS - 1];
    for (unsigned n = TERMS - 1; n-- > 0;) {
        sum = sum * c + (n + 1) * SERIES[n];
    }
    return sum;
}

/* Where the sum of squared angles is least, the sum of slopes times vectors to points is along the
 * place. False where that sum has no direction: points all around the sphere move nothing. */
static bool step(double *const *at, size_t first, size_t num, double *place) {
    double sum[PS_CCVT_AXES] = {0, 0, 0};
    for (size_t k = first; k < first + num; k++) {
        const double weight = slope(square_chord(at, k, place));
        for (unsigned a = 0; a < PS_CCVT_AXES; a++) {
            sum[a] += weight * at[a][k];
        }
    }
    const double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    for (unsigned a = 0; a < PS_CCVT_AXES && length > 0; a++) {
        place[a] = sum[a] / length;
    }
    return length > 0;
}

/* A step is too long by a sixth of the mean squared angle in the region, 1 % for 48 sites; two are
 * right to the square of that. */
static void move(double *const *at, size_t first, size_t num, double *place) {
    enum { STEPS = 2 };
    for (unsigned k = 0; k < STEPS && step(at, first, num, place); k++) {
    }
}

static double height(const double *place) {
    return place[2];
}

/* Grows with the azimuth, from the negative x axis on. */
static double along(const double *place) {
    const double x = place[0];
    const double y = place[1];
    const double sum = fabs(x) + fabs(y);
    const double quarter = sum > 0 ? x / sum : 0; /* 1 on the x axis */
    return y < 0 ? quarter - 1 : 1 - quarter;
}

/* numbers: [..][3], of points first and following. */
static void keep(double *const *at, size_t first, size_t num, const double *numbers) {
    for (size_t k = 0; k < num; k++) {
        for (unsigned a = 0; a < PS_CCVT_AXES; a++) {
            at[a][first + k] = numbers[PS_CCVT_AXES * k + a];
        }
    }
}

static pspec_status make_background(ps_ccvt *c, const ps_rotation *rotation, double *piece,
                                    ps_error *error) {
    const size_t num = c->num * c->capacity;
    for (size_t first = 0; first < num; first += PIECE) {
        const size_t end = first + PIECE < num ? first + PIECE : num;
        for (size_t j = first; j < end; j++) {
            ps_fibonacci_point(j, num, piece + PS_CCVT_AXES * (j - first));
        }
        ps_rotate(rotation, piece, end - first);
        keep(c->at, first, end - first, piece);
        PS_TRY(ps_ccvt_go_on(c, end - first, error));
    }
    return PSPEC_OK;
}

static pspec_status draw_sites(ps_ccvt *c, ps_random *random, ps_error *error) {
    for (size_t i = 0; i < c->num; i++) {
        double point[PS_CCVT_AXES];
        const ps_height height = ps_height_of_area(false, ps_random_uniform(random));
        const ps_turns azimuth = ps_turns_of(ps_random_uniform(random));
        ps_sphere_point(height, azimuth, point);
        keep(c->site, i, 1, point);
        PS_TRY(ps_ccvt_go_on(c, 1, error));
    }
    return PSPEC_OK;
}

static pspec_status draw(ps_ccvt *c, ps_random *random, ps_error *error) {
    double *piece = NULL;
    PS_TRY(PS_NEW(&piece, PIECE * PS_CCVT_AXES, "background points", error));
    pspec_status status = draw_sites(c, random, error);
    if (status == PSPEC_OK) {
        const ps_rotation rotation = ps_rotation_random_portable(random);
        status = make_background(c, &rotation, piece, error);
    }
    free(piece);
    return status;
}

/* B bands of N/B parts have the height 2/B and at the equator the width 2 pi B/N. */
const ps_ccvt_space ps_sphere_ccvt_space = {
    .room = {.axes = 3, .low = -1, .width = 2},
    .phase = "sampler: ccvt-sphere, passes over all pairs",
    .draw = draw,
    .costs = costs,
    .move = move,
    .height = height,
    .along = along,
    .aspect = 1 / PS_PI,
};

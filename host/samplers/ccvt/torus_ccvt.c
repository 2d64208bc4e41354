#include "samplers/ccvt/ccvt.h"

#include <math.h>

enum { X, Y, PLANE };
/* Generators that are drawn to take the best. */
enum { GENERATORS = 128 };

/* Of two places of [0,1) the difference of the nearest images, with nothing rounded but itself. */
static inline double wrapped(double difference) {
    const double half = 0.5;
    return difference > half ? difference - 1 : difference < -half ? difference + 1 : difference;
}

static void costs(double *const *at, size_t first, size_t num, const double *place, double *out) {
    for (size_t k = 0; k < num; k++) {
        const double x = wrapped(at[X][first + k] - place[X]);
        const double y = wrapped(at[Y][first + k] - place[Y]);
        out[k] = x * x + y * y;
    }
}

static double into_unit(double x) {
    const double inside = x < 0 ? x + 1 : x;
    return inside >= 1 ? inside - 1 : inside;
}

static void move(double *const *at, size_t first, size_t num, double *place) {
    double sum[PLANE] = {0, 0};
    for (size_t k = first; k < first + num; k++) {
        sum[X] += wrapped(at[X][k] - place[X]);
        sum[Y] += wrapped(at[Y][k] - place[Y]);
    }
    for (unsigned a = 0; a < PLANE; a++) {
        place[a] = into_unit(place[a] + sum[a] / (double)num);
    }
}

static double height(const double *place) {
    return place[Y];
}

static double along(const double *place) {
    return place[X];
}

/* ---- background ---------------------------------------------------------------------------- */

/* The largest number of the continued fraction of g / num; num where they have a common divisor. */
static uint64_t worst_quotient(uint64_t g, uint64_t num) {
    uint64_t above = num;
    uint64_t below = g;
    uint64_t worst = 0;
    while (below > 1) {
        const uint64_t quotient = above / below;
        const uint64_t rest = above % below;
        worst = quotient > worst ? quotient : worst;
        above = below;
        below = rest;
    }
    const uint64_t last = below == 1 ? above : num;
    return last > worst ? last : worst;
}

uint64_t ps_torus_ccvt_generator(uint64_t num, ps_random *random) {
    uint64_t best = 1;
    uint64_t least = worst_quotient(best, num);
    for (unsigned k = 0; k < GENERATORS; k++) {
        const uint64_t g = 1 + ps_random_below(random, num - 1);
        const uint64_t worst = worst_quotient(g, num);
        best = worst < least ? g : best;
        least = worst < least ? worst : least;
    }
    return best;
}

static pspec_status make_background(ps_ccvt *c, ps_random *random, ps_error *error) {
    const uint64_t num = (uint64_t)c->num * c->capacity;
    const uint64_t generator = ps_torus_ccvt_generator(num, random);
    double shift[PLANE];
    ps_random_fill_uniform(random, shift, PLANE);
    uint64_t multiple = 0;
    for (uint64_t j = 0; j < num; j++) {
        c->at[X][j] = into_unit((double)j / (double)num + shift[X]);
        c->at[Y][j] = into_unit((double)multiple / (double)num + shift[Y]);
        multiple += generator;
        multiple -= multiple >= num ? num : 0;
        PS_TRY(ps_ccvt_go_on(c, 1, error));
    }
    return PSPEC_OK;
}

static pspec_status draw(ps_ccvt *c, ps_random *random, ps_error *error) {
    for (size_t i = 0; i < c->num; i++) {
        c->site[X][i] = ps_random_uniform(random);
        c->site[Y][i] = ps_random_uniform(random);
        PS_TRY(ps_ccvt_go_on(c, 1, error));
    }
    return make_background(c, random, error);
}

const ps_ccvt_space ps_torus_ccvt_space = {
    .room = {.axes = PLANE, .is_periodic = true, .low = 0, .width = 1},
    .phase = "sampler: ccvt, passes over all pairs",
    .draw = draw,
    .costs = costs,
    .move = move,
    .height = height,
    .along = along,
    .aspect = 1,
};

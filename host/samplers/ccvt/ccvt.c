#include "samplers/ccvt/ccvt.h"

#include "base/memory.h"
#include "samplers/list.h"
#include "base/text.h"
#include "samplers/values.h"

#include <math.h>
#include <stdlib.h>
#include <stdio.h>

/* Of the mean squared distance to the own site: an exchange that gains less may be one of rounding,
 * and these could go on for ever. Squared distances of coordinates up to 1 are right to 1e-16 of
 * the distance, which is 1e-12 of its square where regions are as small as 1e-4. */
static const double LEAST_GAIN = 1e-10;
/* Sites stay where they were drawn for so many passes: if they move to the middle of what the bands
 * gave them at once, the bands stay in the spectrum, at 1024 points as 6 dB of anisotropy at |k| =
 * 32; after 2 passes nothing of that is left in 40 sets. */
enum { PASSES_BEFORE_MOVES = 2 };
/* Passes until it is given up: 70 are usual with M = 256, 1000 with 4096. */
enum { MOST_PASSES = 50000 };

pspec_status ps_ccvt_check(size_t num, uint64_t capacity, ps_error *error) {
    if (capacity < PS_CCVT_LEAST_CAPACITY || capacity > PS_CCVT_MOST_CAPACITY) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "M = %llu background points a site: it is from %d to %d",
                       (unsigned long long)capacity, PS_CCVT_LEAST_CAPACITY, PS_CCVT_MOST_CAPACITY);
    }
    if (num > PS_CCVT_MOST_BACKGROUND / capacity) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%zu points with M = %llu background points each: with that M there are at "
                       "most %llu points",
                       num, (unsigned long long)capacity,
                       (unsigned long long)(PS_CCVT_MOST_BACKGROUND / capacity));
    }
    return PSPEC_OK;
}

/* ---- memory -------------------------------------------------------------------------------- */

static pspec_status allocate(ps_ccvt *c, ps_error *error) {
    const size_t num_points = c->num * c->capacity;
    for (unsigned a = 0; a < c->space->room.axes; a++) {
        PS_TRY(PS_NEW(&c->site[a], c->num, "sites", error));
        PS_TRY(PS_NEW(&c->at[a], num_points, "background points", error));
    }
    PS_TRY(PS_NEW(&c->own, num_points, "distances of background points", error));
    PS_TRY(PS_NEW(&c->reach, c->num, "reaches of sites", error));
    PS_TRY(PS_NEW(&c->changed, c->num, "changes of sites", error));
    PS_TRY(PS_NEW(&c->near, c->num, "sites about one", error));
    for (unsigned k = 0; k < 2; k++) {
        PS_TRY(PS_NEW(&c->other[k], c->capacity, "distances to another site", error));
        PS_TRY(PS_NEW(&c->pile[k], c->capacity, "points to exchange", error));
    }
    return ps_ccvt_grid_create(&c->grid, c->space->room, c->num, error);
}

/* What ps_ccvt_make allocates, 56 and 64 bytes of a background point and more of few sites: two
 * orders of all points while they are sorted, 16 bytes each (ccvt_start.c), and a
 * grid of four cells a site. */
static double bytes_of(const ps_ccvt_space *space, size_t num, size_t capacity) {
    const size_t order = 16;
    const size_t grid = 24;
    const size_t place = space->room.axes * sizeof(double);
    const size_t of_point = place + sizeof(double) + 2 * order;
    const size_t of_site = place + sizeof(double) + 2 * sizeof(uint32_t) + grid;
    const size_t of_slot = 2 * (sizeof(double) + sizeof(ps_ccvt_offer));
    return (double)num * (double)capacity * (double)of_point + (double)num * (double)of_site +
           (double)capacity * (double)of_slot;
}

pspec_status ps_ccvt_create(ps_ccvt *c, const ps_ccvt_space *space, size_t num, size_t capacity,
                            ps_random *random, const ps_watch *watch, ps_error *error) {
    *c = (ps_ccvt){.space = space, .num = num, .capacity = capacity, .watch = watch};
    PS_TRY(ps_ccvt_check(num, capacity, error));
    PS_TRY(allocate(c, error));
    return space->draw(c, random, error);
}

void ps_ccvt_destroy(ps_ccvt *c) {
    for (unsigned a = 0; a < PS_CCVT_AXES; a++) {
        free(c->site[a]);
        free(c->at[a]);
    }
    for (unsigned k = 0; k < 2; k++) {
        free(c->other[k]);
        free(c->pile[k]);
    }
    free(c->own);
    free(c->reach);
    free(c->changed);
    free(c->near);
    ps_ccvt_grid_destroy(&c->grid);
    *c = (ps_ccvt){0};
}

/* ---- passes -------------------------------------------------------------------------------- */

/* Distances of the points of a site after it moved. */
static void measure(ps_ccvt *c, size_t i) {
    const size_t first = i * c->capacity;
    double place[PS_CCVT_AXES] = {0};
    double most = 0;
    ps_ccvt_place(c->site, i, c->space->room.axes, place);
    c->space->costs(c->at, first, c->capacity, place, c->own + first);
    for (size_t k = first; k < first + c->capacity; k++) {
        most = c->own[k] > most ? c->own[k] : most;
    }
    c->reach[i] = sqrt(most);
}

/* In the order of points; partial sums by sites. */
double ps_ccvt_energy(const ps_ccvt *c) {
    double energy = 0;
    for (size_t i = 0; i < c->num; i++) {
        double sum = 0;
        for (size_t k = i * c->capacity; k < (i + 1) * c->capacity; k++) {
            sum += c->own[k];
        }
        energy += sum;
    }
    return energy;
}

/* Balls about two sites that hold their points: where they do not meet, no exchange lowers the sum,
 * by the triangle inequality. */
static bool can_meet(const ps_ccvt *c, const double *place, uint32_t i, uint32_t j) {
    const double both = c->reach[i] + c->reach[j];
    double square = 0;
    c->space->costs(c->site, j, 1, place, &square);
    return square < both * both;
}

static pspec_status visit(ps_ccvt *c, uint32_t i, ps_error *error) {
    const size_t num_near = ps_ccvt_grid_later(&c->grid, i, c->near);
    double place[PS_CCVT_AXES] = {0};
    ps_ccvt_place(c->site, i, c->space->room.axes, place);
    for (size_t k = 0; k < num_near; k++) {
        const uint32_t j = c->near[k];
        const bool is_new =
            c->changed[i] + 1 >= c->num_passes || c->changed[j] + 1 >= c->num_passes;
        if (is_new && can_meet(c, place, i, j)) {
            ps_ccvt_exchange(c, i, j);
            PS_TRY(ps_ccvt_go_on(c, 2 * c->capacity, error));
        }
    }
    return ps_ccvt_go_on(c, num_near, error);
}

static void change_all(ps_ccvt *c) {
    for (size_t i = 0; i < c->num; i++) {
        c->changed[i] = c->num_passes;
    }
}

pspec_status ps_ccvt_begin(ps_ccvt *c, ps_error *error) {
    PS_TRY(ps_ccvt_start(c, error));
    for (size_t i = 0; i < c->num; i++) {
        measure(c, i);
        PS_TRY(ps_ccvt_go_on(c, c->capacity, error));
    }
    c->num_passes = 0;
    change_all(c);
    return PSPEC_OK;
}

pspec_status ps_ccvt_pass(ps_ccvt *c, ps_error *error) {
    double most = 0;
    for (size_t i = 0; i < c->num; i++) {
        most = c->reach[i] > most ? c->reach[i] : most;
    }
    c->least_gain = LEAST_GAIN * ps_ccvt_energy(c) / ((double)c->num * (double)c->capacity);
    PS_TRY(ps_ccvt_go_on(c, c->num * c->capacity, error));
    ps_ccvt_grid_fill(&c->grid, c->site, 2 * most);
    c->num_passes++;
    for (size_t i = 0; i < c->num; i++) {
        PS_TRY(visit(c, (uint32_t)i, error));
    }
    return PSPEC_OK;
}

pspec_status ps_ccvt_move(ps_ccvt *c, ps_error *error) {
    double place[PS_CCVT_AXES] = {0};
    if (c->num_passes == PASSES_BEFORE_MOVES) {
        change_all(c);
    }
    for (size_t i = 0; i < c->num; i++) {
        if (c->changed[i] == c->num_passes && c->num_passes >= PASSES_BEFORE_MOVES) {
            ps_ccvt_place(c->site, i, c->space->room.axes, place);
            c->space->move(c->at, i * c->capacity, c->capacity, place);
            for (unsigned a = 0; a < c->space->room.axes; a++) {
                c->site[a][i] = place[a];
            }
            measure(c, i);
            PS_TRY(ps_ccvt_go_on(c, 2 * c->capacity, error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_ccvt_run(ps_ccvt *c, ps_error *error) {
    PS_TRY(ps_ccvt_begin(c, error));
    for (;;) {
        const uint64_t before = c->num_swaps;
        PS_TRY(ps_ccvt_pass(c, error));
        if (c->num_swaps == before && c->num_passes > PASSES_BEFORE_MOVES) {
            return PSPEC_OK;
        }
        if (c->num_passes == MOST_PASSES) {
            return ps_fail(error, PSPEC_ERROR_CHECK,
                           "%zu sites with %zu points each still exchange points after %d passes",
                           c->num, c->capacity, MOST_PASSES);
        }
        PS_TRY(ps_ccvt_move(c, error));
    }
}

void ps_ccvt_give(const ps_ccvt *c, double *points, ps_ccvt_outcome *outcome) {
    const unsigned axes = c->space->room.axes;
    for (size_t i = 0; i < c->num; i++) {
        ps_ccvt_place(c->site, i, axes, points + axes * i);
    }
    if (outcome != NULL) {
        *outcome = (ps_ccvt_outcome){c->num_passes, ps_ccvt_energy(c)};
    }
}

pspec_status ps_ccvt_make(const ps_ccvt_space *space, size_t num, size_t capacity,
                          ps_random *random, const ps_watch *watch, double *points,
                          ps_ccvt_outcome *outcome, ps_error *error) {
    ps_ccvt c;
    pspec_status status = ps_ccvt_create(&c, space, num, capacity, random, watch, error);
    if (status == PSPEC_OK) {
        status = ps_ccvt_run(&c, error);
    }
    if (status == PSPEC_OK) {
        ps_ccvt_give(&c, points, outcome);
    }
    ps_ccvt_destroy(&c);
    return status;
}

/* ---- the rows -------------------------------------------------------------------------------- */

enum { CAPACITY };

#define CAPACITY_PARAMETER(preset)                                                                 \
    { "M", preset, "4 to 16384, background points of every site; more are more regular" }
#define CAPACITY_RANGE                                                                             \
    { PS_CCVT_LEAST_CAPACITY, PS_CCVT_MOST_CAPACITY, true }

static size_t capacity_of(const ps_sampler_request *request) {
    return (size_t)ps_sampler_number(request, CAPACITY);
}

/* The limits of all background points. */
static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    return ps_ccvt_check(request->num_points, capacity_of(request), error);
}

/* N (each + root sqrt(N)) microseconds with M = 64, which grow with M as M (1 + (M/450)^1.15):
 * passes become more. M = 1024 takes 50 times as long as 64, and 4096 and 8192 take 15 and 64 times
 * as long as 1024 (bench_cells ccvt, two cores of an Intel Xeon with AVX-512). That points take
 * longer where there are more is of sites drawn at random, whose numbers differ the more from those
 * of equal capacities, the larger the part of the room. */
static double count_seconds(const ps_sampler_request *request, double each, double root) {
    const double microsecond = 1e-6;
    const double few = 64;
    const double many = 450;
    const double power = 1.15;
    const double num = (double)request->num_points;
    const double m = (double)capacity_of(request);
    const double growth = m / few * (1 + pow(m / many, power)) / (1 + pow(few / many, power));
    return num * (each + root * sqrt(num)) * growth * microsecond;
}

static double torus_seconds(const ps_sampler_request *request) {
    const double each = 27;
    const double root = 1.65;
    return count_seconds(request, each, root);
}

static double sphere_seconds(const ps_sampler_request *request) {
    const double each = 42;
    const double root = 4.3;
    return count_seconds(request, each, root);
}

static const ps_ccvt_space *space_of(const ps_sampler_request *request) {
    return ps_sampler_is_on_sphere(request) ? &ps_sphere_ccvt_space : &ps_torus_ccvt_space;
}

static double work_bytes(const ps_sampler_request *request) {
    return bytes_of(space_of(request), request->num_points, capacity_of(request));
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    return ps_ccvt_make(space_of(request), request->num_points, capacity_of(request), &random,
                        request->watch, points, NULL, error);
}

const ps_sampler ps_sampler_ccvt = {
    .name = "ccvt",
    .summary = "blue noise through cells of equal capacity",
    .aliases = {"capacity"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .minimum_points = PS_TORUS_CCVT_LEAST_POINTS,
    .parameters = {CAPACITY_PARAMETER("256")},
    .ranges = {CAPACITY_RANGE},
    .version = 1,
    .seconds = torus_seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .check = check,
    .generate = generate,
};

const ps_sampler ps_sampler_ccvt_sphere = {
    .name = "ccvt-sphere",
    .summary = "blue noise through cells of equal capacity",
    .aliases = {"capacity-sphere"},
    .domain = PS_SAMPLES_SPHERE,
    .minimum_points = PS_SPHERE_CCVT_LEAST_POINTS,
    .parameters = {CAPACITY_PARAMETER("64")},
    .ranges = {CAPACITY_RANGE},
    .version = 3,
    .seconds = sphere_seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .check = check,
    .generate = generate,
};

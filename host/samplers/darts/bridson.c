/* Bridson's Poisson disk points of the torus: each new point lies between one and two radii from an
 * earlier one, which is given up after so many tries in a row that failed (R. Bridson, "Fast
 * Poisson disk sampling in arbitrary dimensions", 2007). Not maximal: holes are left.
 */
#include "samplers/list.h"

#include "base/memory.h"
#include "samplers/darts/torus_grid.h"
#include "samplers/values.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_DIMENSION = PS_GRID_MOST_DIMENSION,
    PARENTS_TOLD = 1 << 10, /* between two words to the watch, 3 ms in the plane */
    PLANE = 2,
    STEPS_AHEAD = 512 /* drawn; those of the shell are kept */
};

/* From a parent to the farthest point that may refuse its child, in radii. */
static const double WIDE_RADII = 3;

typedef struct bridson {
    const ps_blue_noise *asked;
    ps_random *random;
    double *points;
    size_t num_points;
    ps_torus_grid grid;
    uint32_t *active; /* numbers of points that may still have children */
    size_t num_active;
    double expected; /* points, for the watch */
    /* In the plane, points within three radii of a parent: differences of the two, by axes. */
    double *rivals[PLANE];
    size_t num_rivals;
    uint32_t *numbers; /* of points that may be rivals */
    /* Places of children relative to their parents, made ahead. */
    double steps[STEPS_AHEAD * MOST_DIMENSION];
    unsigned num_steps, num_used;
} bridson;

/* Uniform between one and two radii from the origin: what of a cube is there, without a cosine. */
static void make_steps(bridson *work) {
    const unsigned dimension = work->grid.dimension;
    const double least = work->grid.square_radius;
    const double side = 4 * work->asked->radius;
    const double middle = 0.5;
    double *step = work->steps;
    ps_random_fill_uniform(work->random, work->steps, (size_t)STEPS_AHEAD * dimension);
    for (size_t i = 0; i < STEPS_AHEAD; i++) {
        double square = 0;
        for (unsigned a = 0; a < dimension; a++) {
            step[a] = (work->steps[i * dimension + a] - middle) * side;
            square += step[a] * step[a];
        }
        step += square >= least && square <= 4 * least ? dimension : 0; /* or written over */
    }
    work->num_steps = (unsigned)((size_t)(step - work->steps) / dimension);
    work->num_used = 0;
}

static inline const double *next_step(bridson *work) {
    while (work->num_used == work->num_steps) {
        make_steps(work);
    }
    return work->steps + (size_t)work->num_used++ * work->grid.dimension;
}

static pspec_status put(bridson *work, const uint32_t *indices, const double *place,
                        ps_error *error) {
    if (work->num_points == work->asked->most_points) {
        return ps_blue_noise_fail_room(work->asked, error);
    }
    memcpy(work->points + work->num_points * work->grid.dimension, place,
           work->grid.dimension * sizeof *place);
    ps_torus_grid_put(&work->grid, ps_torus_grid_cell(&work->grid, indices), work->num_points);
    work->active[work->num_active++] = (uint32_t)work->num_points++;
    return PSPEC_OK;
}

static inline void take_step(const unsigned dimension, const double *parent, const double *step,
                             double *place) {
    for (unsigned a = 0; a < dimension; a++) {
        place[a] = parent[a] + step[a];
        place[a] -= floor(place[a]);
        place[a] = place[a] < 1 ? place[a] : 0; /* a small negative number, rounded */
    }
}

static bool is_well_inside(const ps_torus_grid *grid, const uint32_t *indices) {
    const uint32_t reach = (uint32_t)grid->reach;
    return indices[0] >= reach && indices[0] + reach < grid->num_side && indices[1] >= reach &&
           indices[1] + reach < grid->num_side;
}

/* Keeps it if a child of the parent may be too near to it. */
static inline void keep_rival(bridson *work, double x, double y) {
    const double square_reach = WIDE_RADII * WIDE_RADII * work->grid.square_radius;
    work->rivals[0][work->num_rivals] = x;
    work->rivals[1][work->num_rivals] = y;
    work->num_rivals += x * x + y * y < square_reach; /* or written over */
}

static void gather_inside(bridson *work, const uint32_t *indices, const double *parent) {
    const ps_torus_grid *const grid = &work->grid;
    const uint32_t *const middle = grid->numbers + ps_torus_grid_cell(grid, indices);
    size_t num = 0;
    for (size_t i = 1; i < grid->wide.num; i++) { /* without the parent itself */
        work->numbers[num] = middle[grid->wide.items[i].cells];
        num += work->numbers[num] != 0; /* no branch, which would be guessed wrong */
    }
    for (size_t i = 0; i < num; i++) {
        const double *const point = work->points + (size_t)(work->numbers[i] - 1) * PLANE;
        keep_rival(work, point[0] - parent[0], point[1] - parent[1]);
    }
}

static void gather_at_edge(bridson *work, const uint32_t *indices, const double *parent) {
    const ps_torus_grid *const grid = &work->grid;
    for (size_t i = 1; i < grid->wide.num; i++) {
        int shifts[PLANE];
        const uint32_t number =
            ps_torus_grid_neighbour(grid, indices, grid->wide.items + i, shifts);
        if (number != 0) {
            const double *const point = work->points + (size_t)(number - 1) * PLANE;
            keep_rival(work, (point[0] - parent[0]) + shifts[0],
                       (point[1] - parent[1]) + shifts[1]);
        }
    }
}

static void gather_rivals(bridson *work, const double *parent) {
    uint32_t indices[PLANE];
    ps_torus_grid_locate(&work->grid, parent, indices);
    work->num_rivals = 0;
    if (is_well_inside(&work->grid, indices)) {
        gather_inside(work, indices, parent);
    } else {
        gather_at_edge(work, indices, parent);
    }
}

/* Differences to the parent are rounded otherwise than those that decide: who passes is asked
 * again. */
static inline bool has_rival(const bridson *work, const double *step) {
    const double least = work->grid.square_radius;
    const double *const x = work->rivals[0];
    const double *const y = work->rivals[1];
    uint64_t has = 0; /* as wide as a number, so that the loop is made by vectors */
    for (size_t i = 0; i < work->num_rivals; i++) {
        const double from_x = x[i] - step[0];
        const double from_y = y[i] - step[1];
        has |= from_x * from_x + from_y * from_y < least ? 1 : 0;
    }
    return has != 0;
}

/* A parent has a child, or none after all its tries and is left behind. */
static inline pspec_status visit(bridson *work, const unsigned dimension, size_t chosen,
                                 ps_error *error) {
    const double *const parent = work->points + work->active[chosen] * (size_t)dimension;
    if (dimension == PLANE) {
        gather_rivals(work, parent);
    }
    for (unsigned i = 0; i < work->asked->tries; i++) {
        const double *const step = next_step(work);
        double place[MOST_DIMENSION];
        uint32_t indices[MOST_DIMENSION];
        if (dimension == PLANE && has_rival(work, step)) {
            continue;
        }
        take_step(dimension, parent, step, place);
        ps_torus_grid_locate(&work->grid, place, indices);
        if (ps_torus_grid_is_free(&work->grid, indices, place)) {
            return put(work, indices, place, error);
        }
    }
    work->active[chosen] = work->active[--work->num_active];
    return PSPEC_OK;
}

static pspec_status visit_any(bridson *work, ps_error *error) {
    /* Two words at a time keep blocks of the generator whole. The product of a number below 1 that
     * has 53 digits stays below. */
    const size_t chosen = (size_t)(ps_random_uniform(work->random) * (double)work->num_active);
    switch (work->grid.dimension) {
    case 2:
        return visit(work, 2, chosen, error);
    case 3:
        return visit(work, 3, chosen, error);
    default:
        return visit(work, MOST_DIMENSION, chosen, error);
    }
}

/* ---- numbers of points ---------------------------------------------------------------------- */

/* N r^d of Bridson's points after so many tries, means of 60 sets of 4096 points, with standard
 * errors of 0.0003 to 0.0007 (bench_blue_noise means); after 30 tries of sets of 16384. */
typedef struct filled {
    unsigned tries;
    double products[PS_GRID_MOST_DIMENSION + 1];
} filled;
static const filled FILLED[] = {
    {2, {0, 0, 0.4347, 0.3615, 0.3237}},    {3, {0, 0, 0.4941, 0.4113, 0.3760}},
    {5, {0, 0, 0.5350, 0.4616, 0.4307}},    {10, {0, 0, 0.5735, 0.5143, 0.4929}},
    {20, {0, 0, 0.6018, 0.5556, 0.5439}},   {30, {0, 0, 0.6151, 0.5758, 0.5700}},
    {50, {0, 0, 0.6298, 0.5980, 0.5977}},   {100, {0, 0, 0.6472, 0.6241, 0.6318}},
    {200, {0, 0, 0.6622, 0.6458, 0.6620}},  {400, {0, 0, 0.6734, 0.6628, 0.6879}},
    {1000, {0, 0, 0.6848, 0.6828, 0.7168}},
};
enum { NUM_FILLED = sizeof FILLED / sizeof FILLED[0] };

/* With a single one chains of points end before they fill anything. */
enum { LEAST_TRIES = 2, MOST_TRIES = 1000 };

static pspec_status check_tries(unsigned tries, ps_error *error) {
    if (tries >= LEAST_TRIES && tries <= MOST_TRIES) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%u tries are not between %d and %d", tries,
                   LEAST_TRIES, MOST_TRIES);
}

/* Between tries that were measured it is nearly straight in 1/sqrt(tries). */
static double filled_product(unsigned dimension, unsigned tries) {
    unsigned i = 0;
    while (i < NUM_FILLED - 2 && FILLED[i + 1].tries < tries) {
        i++;
    }
    const double from = 1 / sqrt(FILLED[i].tries);
    const double to = 1 / sqrt(FILLED[i + 1].tries);
    const double share = (1 / sqrt(tries) - from) / (to - from);
    return FILLED[i].products[dimension] +
           share * (FILLED[i + 1].products[dimension] - FILLED[i].products[dimension]);
}

static double radius(const ps_blue_noise *asked, size_t num_points) {
    return ps_torus_radius_of(asked->dimension, filled_product(asked->dimension, asked->tries),
                              num_points);
}

static double expected(const ps_blue_noise *asked) {
    return filled_product(asked->dimension, asked->tries) /
           ps_torus_radius_power(asked->radius, asked->dimension);
}

static pspec_status check(const ps_blue_noise *asked, ps_error *error) {
    PS_TRY(ps_torus_radius_check(asked->dimension, asked->radius, error));
    PS_TRY(check_tries(asked->tries, error));
    return ps_torus_grid_check(asked->dimension, asked->radius, error);
}

static pspec_status fill(bridson *work, ps_error *error) {
    uint32_t indices[MOST_DIMENSION];
    PS_TRY(check(work->asked, error));
    work->expected = expected(work->asked);
    PS_TRY(ps_torus_grid_create(&work->grid, work->asked->dimension, work->asked->radius,
                                work->asked->dimension == PLANE ? WIDE_RADII : 0, work->points,
                                error));
    PS_TRY(PS_NEW(&work->numbers, work->grid.wide.num + 1, "near points", error));
    for (unsigned a = 0; a < PLANE; a++) {
        PS_TRY(PS_NEW(&work->rivals[a], work->grid.wide.num + 1, "near points", error));
    }
    PS_TRY(PS_NEW(&work->active, work->asked->most_points, "active points", error));
    double first[MOST_DIMENSION];
    ps_random_fill_uniform(work->random, first, MOST_DIMENSION);
    ps_torus_grid_locate(&work->grid, first, indices);
    PS_TRY(put(work, indices, first, error));
    for (size_t i = 0; work->num_active > 0; i++) {
        if (i % PARENTS_TOLD == 0) {
            PS_TRY(ps_blue_noise_tell(work->asked, work->num_points, work->expected, error));
        }
        PS_TRY(visit_any(work, error));
    }
    return PSPEC_OK;
}

static pspec_status make(const ps_blue_noise *asked, ps_random *random, double *points,
                         size_t *num_points, ps_error *error) {
    bridson work = {.asked = asked, .random = random, .points = points};
    const pspec_status status = fill(&work, error);
    *num_points = status == PSPEC_OK ? work.num_points : 0;
    ps_torus_grid_free(&work.grid);
    free(work.active);
    free(work.numbers);
    free(work.rivals[0]);
    free(work.rivals[1]);
    return status;
}

/* ---- the row --------------------------------------------------------------------------------- */

/* By dimension, N = 4096 and 10 to 1000 tries. */
static double nanoseconds(const ps_blue_noise *asked) {
    static const double first[PS_GRID_MOST_DIMENSION + 1] = {0, 0, 600, 500, 5000};
    static const double per_try[PS_GRID_MOST_DIMENSION + 1] = {0, 0, 50, 130, 270};
    return first[asked->dimension] + asked->tries * per_try[asked->dimension];
}

const ps_distance_kind ps_bridson_kind = {
    .radius = radius,
    .expected = expected,
    .most_points = ps_torus_radius_most_points,
    .nanoseconds = nanoseconds,
    .check = check,
    .make = make,
};

const ps_sampler ps_sampler_bridson = {
    .name = "bridson",
    .summary = "random points that keep a distance, each within two of it from another",
    .minimum_dimension = 2,
    .maximum_dimension = PS_GRID_MOST_DIMENSION,
    .version = 2,
    .parameters = {PS_DISTANCE_RADIUS, PS_DISTANCE_EXACT, PS_DISTANCE_TRIES},
    .distance = &ps_bridson_kind,
    PS_DISTANCE_MEMBERS,
};

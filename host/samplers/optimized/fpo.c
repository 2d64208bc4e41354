#include "samplers/optimized/fpo.h"

#include "base/memory.h"
#include "samplers/optimized/fpo_mesh.h"
#include "samplers/list.h"
#include "base/text.h"
#include "math/random/subset.h"
#include "samplers/optimized/cells.h"
#include "samplers/values.h"

#include <math.h>
#include <stdlib.h>

/* A place must be better by more than rounding, or points would change places without end. */
static const double BETTER = 1 + 1e-12;
/* Points between two looks at the watch: some milliseconds. */
enum { POINTS_AT_A_TIME = 1 << 11 };

pspec_status ps_fpo_check(size_t num, double distance, ps_error *error) {
    if (!(distance >= PS_FPO_LEAST_DISTANCE && distance <= PS_FPO_MOST_DISTANCE)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "distance = %g: it is from %g to %g of hexagonal packing's", distance,
                       PS_FPO_LEAST_DISTANCE, PS_FPO_MOST_DISTANCE);
    }
    return ps_power_cells_check(num, error);
}

/* Takes p to the farthest place, or back to its own. True when it moved. */
static bool move_point(ps_fpo_mesh *mesh, uint32_t p) {
    const double own_x = mesh->x[p];
    const double own_y = mesh->y[p];
    double x;
    double y;
    ps_image nearest = 0;
    ps_image beside;
    const double own = ps_fpo_mesh_nearest(mesh, p, &nearest);
    ps_fpo_mesh_remove(mesh, p);
    const bool moves = ps_fpo_mesh_farthest(mesh, &x, &y, &beside) > own * BETTER;
    if (moves) {
        ps_fpo_mesh_insert(mesh, p, x, y, beside);
    } else {
        ps_fpo_mesh_insert(mesh, p, own_x, own_y, nearest);
    }
    return moves;
}

static pspec_status fail_room(const ps_fpo_mesh *mesh, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT, "a cell of %zu points has more than %d edges",
                   mesh->num, PS_FPO_MOST_EDGES);
}

static pspec_status pass(ps_fpo_mesh *mesh, const uint32_t *order, const ps_watch *watch,
                         ps_fpo_outcome *outcome, ps_error *error) {
    for (size_t k = 0; k < mesh->num; k++) {
        if (k % POINTS_AT_A_TIME == 0) {
            PS_TRY(ps_watch_tell(watch, "sampler: fpo, passes over all points", outcome->passes, 0,
                                 NULL, error));
        }
        outcome->moves += move_point(mesh, order[k]);
        if (mesh->has_no_room) {
            return fail_room(mesh, error);
        }
    }
    outcome->passes++;
    return PSPEC_OK;
}

static void measure(const ps_fpo_mesh *mesh, ps_fpo_outcome *outcome) {
    const double hexagonal = sqrt(2 / (sqrt(3.0) * (double)mesh->num));
    double least2 = 1;
    double sum = 0;
    for (size_t i = 0; i < mesh->num; i++) {
        ps_image nearest;
        const double d2 = ps_fpo_mesh_nearest(mesh, (uint32_t)i, &nearest);
        least2 = d2 < least2 ? d2 : least2;
        sum += sqrt(d2);
    }
    outcome->distance = sqrt(least2) / hexagonal;
    outcome->mean_nearest = sum / ((double)mesh->num * hexagonal);
}

static pspec_status run(ps_fpo_mesh *mesh, double distance, const uint32_t *order,
                        const ps_watch *watch, ps_fpo_outcome *outcome, ps_error *error) {
    measure(mesh, outcome);
    while (outcome->distance < distance && outcome->passes < PS_FPO_MOST_PASSES) {
        const size_t before = outcome->moves;
        PS_TRY(pass(mesh, order, watch, outcome, error));
        measure(mesh, outcome);
        if (outcome->moves == before) {
            break;
        }
    }
    return PSPEC_OK;
}

static pspec_status optimise(ps_fpo_mesh *mesh, double distance, ps_random *random,
                             const ps_watch *watch, ps_fpo_outcome *outcome, ps_error *error) {
    uint32_t *order;
    PS_TRY(PS_NEW(&order, mesh->num, "the order of points", error));
    ps_random_order(random, order, mesh->num);
    const pspec_status status = run(mesh, distance, order, watch, outcome, error);
    free(order);
    return status;
}

pspec_status ps_fpo_optimise(size_t num, double distance, ps_random *random, const ps_watch *watch,
                             double *points, ps_fpo_outcome *outcome, ps_error *error) {
    ps_fpo_mesh *mesh = NULL;
    ps_fpo_outcome found = {0};
    PS_TRY(ps_fpo_check(num, distance, error));
    PS_TRY(PS_NEW(&mesh, 1, "cells of points", error));
    pspec_status status = ps_fpo_mesh_create(mesh, num, points, error);
    if (status == PSPEC_OK) {
        status = optimise(mesh, distance, random, watch, &found, error);
        for (size_t i = 0; i < num && status == PSPEC_OK; i++) {
            points[2 * i] = mesh->x[i];
            points[2 * i + 1] = mesh->y[i];
        }
        ps_fpo_mesh_destroy(mesh);
    }
    free(mesh);
    if (outcome != NULL) {
        *outcome = found;
    }
    return status;
}

pspec_status ps_fpo_make(size_t num, double distance, ps_random *random, const ps_watch *watch,
                         double *points, ps_error *error) {
    PS_TRY(ps_fpo_check(num, distance, error));
    ps_random_fill_uniform(random, points, 2 * num);
    return ps_fpo_optimise(num, distance, random, watch, points, NULL, error);
}

/* ---- the row --------------------------------------------------------------------------------- */

enum { DISTANCE };

/* 1024 points take 2 passes to 0.8, 10 to 0.9, 34 to 0.92, 60 to 0.925 and 700 to 0.93, at 4 us a
 * point; passes and the time of a point grow together like sqrt(N), right to a factor of 2
 * (bench_cells fpo). */
static double seconds(const ps_sampler_request *request) {
    const double num = (double)request->num_points;
    const double root = sqrt(num / 1024);
    const double distance = ps_sampler_number(request, DISTANCE);
    return num * (1 + 0.34 / (0.931 - distance)) * 4e-6 * (root < 1 ? 1 : root);
}

static double work_bytes(const ps_sampler_request *request) {
    return ps_fpo_mesh_bytes(request->num_points);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    return ps_fpo_make(request->num_points, ps_sampler_number(request, DISTANCE), &random,
                       request->watch, points, error);
}

const ps_sampler ps_sampler_fpo = {
    .name = "fpo",
    .summary = "farthest-point optimisation",
    .aliases = {"farthest-point"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .minimum_points = PS_CELLS_LEAST_POINTS,
    .maximum_points = PS_CELLS_MOST_POINTS,
    .parameters = {{"distance", "0.925",
                    "0.5 to 0.93 of hexagonal packing's, least distance of two points"}},
    .ranges = {{PS_FPO_LEAST_DISTANCE, PS_FPO_MOST_DISTANCE, false}},
    .version = 1,
    .seconds = seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .generate = generate,
};

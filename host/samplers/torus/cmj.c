/* Correlated multi-jittered points (A. Kensler 2013): jittered points of m_1 x m_2 cells that are a
 * Latin hypercube, too, on both axes. All columns have the rows in one random order, and all rows
 * the columns:
 *
 *     x = (i + (p(j) + xi)/m_2)/m_1,    y = (j + (q(i) + eta)/m_1)/m_2
 */
#include "samplers/list.h"

#include "base/memory.h"
#include "samplers/pace.h"
#include "samplers/torus/strata.h"
#include "samplers/values.h"

#include <stdlib.h>

enum { STRATA, PLANE = 2 };

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    uint64_t counts[PS_MAX_DIMENSION];
    return ps_strata_resolve(request, STRATA, counts, error);
}

/* Fisher-Yates. */
static void permute(ps_random *random, uint64_t *order, uint64_t num) {
    for (uint64_t i = 0; i < num; i++) {
        order[i] = i;
    }
    for (uint64_t i = num; i > 1; i--) {
        const uint64_t other = ps_random_below(random, i);
        const uint64_t kept = order[other];
        order[other] = order[i - 1];
        order[i - 1] = kept;
    }
}

/* orders: that of the rows, then that of the columns; points have xi and eta. */
static pspec_status place(const ps_sampler_request *request, const uint64_t *counts,
                          const uint64_t *orders, double *points, ps_error *error) {
    const double num = (double)request->num_points;
    const uint64_t *const rows = orders;
    const uint64_t *const columns = orders + counts[1];
    for (uint64_t j = 0; j < request->num_points; j++) {
        const uint64_t column = j / counts[1];
        const uint64_t row = j % counts[1];
        double *const point = points + PLANE * j;
        PS_TRY(ps_sampler_go_on(request, "sampler: points in strata", j, error));
        point[0] = ps_stratum_point((double)(column * counts[1] + rows[row]), point[0], num);
        point[1] = ps_stratum_point((double)(row * counts[0] + columns[column]), point[1], num);
    }
    return PSPEC_OK;
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    uint64_t counts[PS_MAX_DIMENSION];
    uint64_t *orders = NULL;
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    ps_random of_orders = ps_random_init(request->seed, PS_STREAM_PERMUTATION, realization);
    PS_TRY(ps_strata_resolve(request, STRATA, counts, error));
    PS_TRY(ps_sampler_fill_uniform(request, &random, PLANE, points, error));
    PS_TRY(PS_NEW(&orders, counts[0] + counts[1], "orders of strata", error));
    permute(&of_orders, orders, counts[1]);
    permute(&of_orders, orders + counts[1], counts[0]);
    const pspec_status status = place(request, counts, orders, points, error);
    free(orders);
    return status;
}

static double work_bytes(const ps_sampler_request *request) {
    uint64_t counts[PS_MAX_DIMENSION];
    return ps_strata_resolve(request, STRATA, counts, NULL) == PSPEC_OK
               ? (double)(counts[0] + counts[1]) * (double)sizeof(uint64_t)
               : 0;
}

const ps_sampler ps_sampler_cmj = {
    .name = "cmj",
    .summary = "correlated multi-jittered: jittered, and a Latin hypercube",
    .aliases = {"correlated-multi-jittered"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .parameters = {PS_STRATA_PARAMETER},
    .nanoseconds = 8,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .check = check,
    .generate = generate,
};

/* Solutions of kernel systems and the interpolant that they make. */
#include "rules/kernel/kernel_private.h"

#include "base/memory.h"
#include "base/workers.h"
#include "math/linear/cholesky.h"
#include "math/sobolev.h"

#include <stdlib.h>
#include <string.h>

/* ---- solutions --------------------------------------------------------------------------- */

static pspec_status solve_dense(ps_kernel_system *system, const double *right, double *x,
                                double *residual, ps_error *error) {
    const size_t n = system->num;
    const ps_watch *const watch = system->options.watch;
    memcpy(x, right, n * sizeof *x);
    PS_TRY(ps_cholesky_solve(n, system->matrix, x, watch, error));
    PS_TRY(ps_kernel_matrix_residual(system, right, x, residual, error));
    PS_TRY(ps_cholesky_solve(n, system->matrix, residual, watch, error));
    for (size_t i = 0; i < n; i++) {
        x[i] += residual[i];
    }
    return ps_kernel_matrix_residual(system, right, x, residual, error);
}

pspec_status ps_kernel_system_solve(ps_kernel_system *system, const double *right, double *x,
                                    double *defect, ps_error *error) {
    const size_t n = system->num;
    double *const solution = system->rows;
    double *const residual = system->rows + n;
    double *distinct = NULL;
    PS_TRY(PS_NEW(&distinct, n, "a right side", error));
    pspec_status status = PSPEC_OK;
    for (size_t j = system->num_points; j-- > 0;) { /* the first one of a group is written last */
        distinct[system->group[j]] = right[j];
    }
    if (system->matrix != NULL) {
        PS_TRY_OUT(status, solve_dense(system, distinct, solution, residual, error));
    } else {
        PS_TRY_OUT(status, ps_kernel_gradients_solve(system, distinct, solution, residual, error));
    }
    for (size_t j = 0; j < system->num_points; j++) {
        x[j] = solution[system->group[j]] * system->shares[system->group[j]];
    }
    if (defect != NULL) {
        *defect = ps_kernel_dot(n, solution, residual);
    }
out:
    free(distinct);
    return status;
}

typedef struct interpolation {
    size_t num_points;
    const double *points, *x, *at;
    double smoothness, sum;
    double *values;
    size_t num;
} interpolation;

static void interpolate_share(void *payload, unsigned index, unsigned count) {
    const interpolation *const work = payload;
    const size_t end = ps_share_begin(work->num, index + 1, count);
    for (size_t i = ps_share_begin(work->num, index, count); i < end; i++) {
        work->values[i] = ps_sobolev_constant(work->smoothness) * work->sum -
                          ps_sobolev_distance_sum(work->smoothness, work->at + 3 * i,
                                                  work->num_points, work->points, work->x);
    }
}

void ps_kernel_interpolate(size_t num_points, const double *points, double smoothness,
                           const double *x, size_t num, const double *at, double *values) {
    interpolation work = {.num_points = num_points,
                          .points = points,
                          .x = x,
                          .at = at,
                          .smoothness = smoothness,
                          .sum = ps_kernel_dot(num_points, x, NULL),
                          .values = values,
                          .num = num};
    ps_workers_share(num * num_points, interpolate_share, &work);
}

#include "rules/kernel/kernel_private.h"

#include "base/memory.h"
#include "math/linear/cholesky.h"
#include "math/sobolev.h"
#include "base/workers.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* eps times this is 1e-4: four digits are left. */
static const double ILL_CONDITION = 1e-4 / DBL_EPSILON;

/* ---- the matrix ---------------------------------------------------------------------------- */

static pspec_status factorize(ps_kernel_system *system, ps_error *error) {
    bool is_definite = false;
    size_t bad = 0;
    const ps_watch *const watch = system->options.watch;
    PS_TRY(ps_kernel_matrix_fill(system, error));
    PS_TRY(ps_kernel_matrix_norm(system, error));
    PS_TRY(ps_cholesky(system->num, system->matrix, 0, watch, &is_definite, &bad, error));
    if (!is_definite) {
        double distance = 0;
        const size_t nearest = ps_kernel_points_nearest(system, bad, &distance);
        return ps_kernel_points_refuse(system, bad, nearest, distance, error);
    }
    return ps_cholesky_condition(system->num, system->matrix, system->norm, watch,
                                 &system->facts.condition, error);
}

/* ---- creation ------------------------------------------------------------------------------ */

uint64_t ps_kernel_system_bytes(size_t num_points, bool is_dense) {
    const uint64_t num = num_points;
    const uint64_t rows = is_dense ? PS_KERNEL_DENSE_ROWS : PS_KERNEL_GRADIENT_ROWS;
    const uint64_t lists = num * ((3 + 1 + rows) * sizeof(double) + sizeof(size_t));
    return lists + (is_dense ? num * num * sizeof(double) + ps_cholesky_bytes(num_points)
                             : ps_kernel_factor_bytes(num_points) + ps_kernel_product_bytes(num));
}

size_t ps_kernel_most_dense(const ps_device *device) {
    return ps_kernel_product_is_on_gpu(device) ? PS_KERNEL_MOST_DENSE_ON_GPU : PS_KERNEL_MOST_DENSE;
}

bool ps_kernel_system_is_dense(size_t num_points, size_t most_dense, uint64_t memory_limit) {
    return num_points <= (most_dense > 0 ? most_dense : PS_KERNEL_MOST_DENSE) &&
           (memory_limit == 0 || ps_kernel_system_bytes(num_points, true) <= memory_limit);
}

static pspec_status allocate(ps_kernel_system *system, bool is_dense, ps_error *error) {
    const size_t num = system->num_points;
    const size_t num_rows = is_dense ? PS_KERNEL_DENSE_ROWS : PS_KERNEL_GRADIENT_ROWS;
    PS_TRY(ps_allocate_for(&system->points, num, 3 * sizeof(double), "distinct points", error));
    PS_TRY(PS_NEW(&system->group, num, "duplicates", error));
    PS_TRY(PS_NEW(&system->shares, num, "duplicates", error));
    PS_TRY(ps_allocate_for(&system->rows, num, num_rows * sizeof(double), "solutions", error));
    return PSPEC_OK;
}

/* What the machine has free does not choose the way, for weights would depend on it; it may
 * refuse. */
static pspec_status allocate_matrix(double **matrix, size_t num, ps_error *error) {
    ps_error refusal = {0};
    if (ps_allocate_for(matrix, num, num * sizeof(double), "a kernel matrix", &refusal) ==
        PSPEC_OK) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_MEMORY,
                   "%s; with a memory limit (--memory) below %llu bytes the weights of %zu points "
                   "are found without a matrix",
                   refusal.message, (unsigned long long)ps_kernel_system_bytes(num, true), num);
}

static pspec_status prepare_dense(ps_kernel_system *system, ps_error *error) {
    PS_TRY(allocate_matrix(&system->matrix, system->num, error));
    ps_memory_use_large_pages(system->matrix, system->num * system->num * sizeof(double));
    return factorize(system, error);
}

/* The points given decide which way, not how many are left of them: so says the plan. */
static pspec_status build(ps_kernel_system *system, const double *points, ps_error *error) {
    const bool is_dense = ps_kernel_system_is_dense(system->num_points, system->options.most_dense,
                                                    system->options.memory_limit);
    PS_TRY(allocate(system, is_dense, error));
    PS_TRY(ps_kernel_points_merge(system, points, error));
    system->facts = (ps_kernel_facts){.num_distinct = system->num,
                                      .is_dense = is_dense,
                                      .bytes = ps_kernel_system_bytes(system->num_points, is_dense),
                                      .condition = NAN};
    PS_TRY(is_dense ? prepare_dense(system, error) : ps_kernel_gradients_prepare(system, error));
    system->facts.is_ill_conditioned = !(system->facts.condition <= ILL_CONDITION);
    return PSPEC_OK;
}

pspec_status ps_kernel_system_create(ps_kernel_system **out, size_t num_points,
                                     const double *points, double smoothness,
                                     const ps_kernel_options *options, ps_error *error) {
    *out = NULL;
    PS_TRY(ps_sobolev_check(smoothness, error));
    ps_kernel_system *system = NULL;
    PS_TRY(PS_NEW(&system, 1, "a kernel system", error));
    system->num_points = num_points;
    system->smoothness = smoothness;
    system->constant = ps_sobolev_constant(smoothness);
    system->options = options != NULL ? *options : (ps_kernel_options){0};
    const pspec_status status = build(system, points, error);
    if (status != PSPEC_OK) {
        ps_kernel_system_destroy(system);
        return status;
    }
    *out = system;
    return PSPEC_OK;
}

void ps_kernel_system_destroy(ps_kernel_system *system) {
    if (system != NULL) {
        free(system->points);
        free(system->group);
        free(system->shares);
        free(system->matrix);
        free(system->rows);
        ps_kernel_factor_free(&system->factor);
        ps_kernel_product_destroy(system->product);
        free(system);
    }
}

ps_kernel_facts ps_kernel_system_facts(const ps_kernel_system *system) {
    return system->facts;
}

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
    size_t num_points, num_functions;
    const double *points, *x, *at;
    double smoothness;
    double all[PS_SOBOLEV_MOST_SUMS]; /* c sum_i x_i */
    double *values;
    size_t num;
} interpolation;

static void interpolate_share(void *payload, unsigned index, unsigned count) {
    const interpolation *const work = payload;
    const size_t end = ps_share_begin(work->num, index + 1, count);
    for (size_t i = ps_share_begin(work->num, index, count); i < end; i++) {
        double sums[PS_SOBOLEV_MOST_SUMS];
        ps_sobolev_distance_sums(work->smoothness, work->at + 3 * i, work->num_points, work->points,
                                 work->num_functions, work->x, sums);
        for (size_t f = 0; f < work->num_functions; f++) {
            work->values[f * work->num + i] = work->all[f] - sums[f];
        }
    }
}

void ps_kernel_interpolate(size_t num_points, const double *points, double smoothness,
                           size_t num_functions, const double *x, size_t num, const double *at,
                           double *values) {
    interpolation work = {.num_points = num_points,
                          .num_functions = num_functions,
                          .points = points,
                          .x = x,
                          .at = at,
                          .smoothness = smoothness,
                          .values = values,
                          .num = num};
    for (size_t f = 0; f < num_functions; f++) {
        work.all[f] =
            ps_sobolev_constant(smoothness) * ps_kernel_dot(num_points, x + f * num_points, NULL);
    }
    ps_workers_share(num * num_points, interpolate_share, &work);
}

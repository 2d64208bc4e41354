/* Kernel systems by conjugate gradients, with the matrix made on the fly, by a device or in
 * threads, and the sparse inverse of kernel_private.h as preconditioner. */
#include "rules/kernel/kernel_private.h"

#include "base/memory.h"
#include "base/pieces.h"
#include "math/neumaier.h"
#include "math/sobolev.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double DEFAULT_RESIDUAL = 1e-12;
static const size_t DEFAULT_STEPS = 2000;
/* A residual of so many roundings of |K| |x| cannot be made smaller in double precision. */
static const double ROUNDINGS = 16;

double ps_kernel_dot(size_t num, const double *a, const double *b) {
    ps_neumaier sum = {0, 0};
    for (size_t i = 0; i < num; i++) {
        ps_neumaier_add(&sum, b != NULL ? a[i] * b[i] : a[i]);
    }
    return ps_neumaier_value(&sum);
}

/* ---- progress ------------------------------------------------------------------------------ */

static const char STEPS[] = "iterations of conjugate gradients";

/* How many there will be nobody knows. */
static pspec_status tell_steps(const ps_kernel_system *system, ps_error *error) {
    char detail[32];
    snprintf(detail, sizeof detail, "residual %.2g", system->facts.residual);
    return ps_watch_tell(system->options.watch, STEPS, system->facts.num_steps, 0,
                         system->facts.residual > 0 ? detail : NULL, error);
}

/* ---- products ------------------------------------------------------------------------------ */

typedef struct rows_work {
    const ps_kernel_system *system;
    const double *x;
    double *out;
} rows_work;

static void multiply_row(void *payload, size_t i) {
    const rows_work *const work = payload;
    const ps_kernel_system *const system = work->system;
    work->out[i] = ps_sobolev_distance_sum(system->smoothness, system->points + 3 * i, system->num,
                                           system->points, work->x);
}

/* A product may take longer than people wait. It is a part of a step, as who listens hears again
 * and again. */
static int tell_step(const ps_watch_report *report, void *payload) {
    const ps_kernel_system *const system = payload;
    (void)report;
    return tell_steps(system, NULL) == PSPEC_OK ? 0 : 1;
}

static pspec_status multiply(const ps_kernel_system *system, const double *x, double *out,
                             ps_error *error) {
    const double sum = system->constant * ps_kernel_dot(system->num, x, NULL);
    const ps_watch watch = {tell_step, (void *)system};
    if (system->product != NULL) {
        PS_TRY(ps_kernel_product_apply(system->product, x, out, &watch, error));
    } else {
        rows_work work = {system, x, out};
        PS_TRY(ps_pieces_share(&watch, "rows of a product", system->num * system->num, system->num,
                               multiply_row, &work, error));
    }
    for (size_t i = 0; i < system->num; i++) {
        out[i] = sum - out[i];
    }
    return PSPEC_OK;
}

/* K x = right less what x leaves of it. */
static pspec_status find_residual(const ps_kernel_system *system, const double *right,
                                  const double *x, double *residual, ps_error *error) {
    PS_TRY(multiply(system, x, residual, error));
    for (size_t i = 0; i < system->num; i++) {
        residual[i] = right[i] - residual[i];
    }
    return PSPEC_OK;
}

/* ---- preparation --------------------------------------------------------------------------- */

/* Two points at a distance d leave an eigenvalue of at most d^(2s-2). */
static double bound_eigenvalue(const ps_kernel_system *system) {
    return system->num > 1 ? pow(system->factor.nearest, 2 * system->smoothness - 2)
                           : system->constant;
}

static pspec_status refuse(const ps_kernel_system *system, ps_error *error) {
    const ps_kernel_factor *const factor = &system->factor;
    return ps_kernel_points_refuse(system, factor->near[0], factor->near[1], factor->nearest,
                                   error);
}

static pspec_status find_condition(ps_kernel_system *system, ps_error *error) {
    double *const ones = system->rows;
    double *const sums = system->rows + system->num;
    const double smallest = bound_eigenvalue(system);
    if (smallest <= DBL_EPSILON * system->constant) {
        return refuse(system, error);
    }
    for (size_t i = 0; i < system->num; i++) {
        ones[i] = 1;
    }
    PS_TRY(multiply(system, ones, sums, error));
    for (size_t i = 0; i < system->num; i++) {
        system->norm = fmax(system->norm, sums[i]);
    }
    /* 1 K 1 / N is at most the largest eigenvalue */
    system->facts.condition =
        ps_kernel_dot(system->num, sums, NULL) / (double)system->num / smallest;
    return PSPEC_OK;
}

pspec_status ps_kernel_gradients_prepare(ps_kernel_system *system, ps_error *error) {
    PS_TRY(ps_kernel_factor_create(&system->factor, system->smoothness, system->num, system->points,
                                   system->options.watch, error));
    if (ps_kernel_product_is_possible(system->options.device)) {
        PS_TRY(ps_kernel_product_create(&system->product, system->options.device,
                                        system->smoothness - 1, system->num, system->points,
                                        error));
    }
    return find_condition(system, error);
}

/* ---- gradients ----------------------------------------------------------------------------- */

typedef struct gradients {
    ps_kernel_system *system;
    double *x, *residual, *direction, *image, *better;
    double target; /* of |residual| */
    double size;   /* of the right side */
} gradients;

static double length_of(size_t num, const double *a) {
    return sqrt(ps_kernel_dot(num, a, a));
}

static pspec_status check_step(const gradients *solution, double residual, ps_error *error) {
    const ps_kernel_options *const options = &solution->system->options;
    const size_t step = solution->system->facts.num_steps;
    const size_t most = options->most_steps > 0 ? options->most_steps : DEFAULT_STEPS;
    solution->system->facts.residual = residual;
    PS_TRY(tell_steps(solution->system, error));
    if (step >= most) {
        return ps_fail(error, PSPEC_ERROR_TOLERANCE,
                       "conjugate gradients reached a residual of %.3g in %zu steps, not the %.3g "
                       "asked for; the two nearest points are %.3g from each other",
                       residual, step, solution->target / solution->size,
                       solution->system->factor.nearest);
    }
    return PSPEC_OK;
}

static void add_scaled(size_t num, double *sum, double factor, const double *term) {
    for (size_t i = 0; i < num; i++) {
        sum[i] += factor * term[i];
    }
}

/* From the residual of x on until the recurrence says that the target is met. */
static pspec_status descend(const gradients *solution, ps_error *error) {
    ps_kernel_system *const system = solution->system;
    const size_t n = system->num;
    ps_kernel_factor_apply(&system->factor, solution->residual, solution->direction);
    double square = ps_kernel_dot(n, solution->residual, solution->direction);
    double left = length_of(n, solution->residual);
    while (left > solution->target) {
        PS_TRY(check_step(solution, left / solution->size, error));
        PS_TRY(multiply(system, solution->direction, solution->image, error));
        const double curvature = ps_kernel_dot(n, solution->direction, solution->image);
        if (!(curvature > 0)) {
            return refuse(system, error);
        }
        add_scaled(n, solution->x, square / curvature, solution->direction);
        add_scaled(n, solution->residual, -square / curvature, solution->image);
        ps_kernel_factor_apply(&system->factor, solution->residual, solution->better);
        const double next = ps_kernel_dot(n, solution->residual, solution->better);
        for (size_t i = 0; i < n; i++) {
            solution->direction[i] = solution->better[i] + next / square * solution->direction[i];
        }
        square = next;
        left = length_of(n, solution->residual);
        system->facts.num_steps++;
    }
    return PSPEC_OK;
}

/* The residual itself is not that of the recurrence: where it is larger the descent begins again
 * with it, until rounding lets nothing more be gained. */
static pspec_status descend_again(const gradients *solution, const double *right, ps_error *error) {
    enum { MOST_TIMES = 4 };
    const double slack = 2; /* of the residual itself over the recurrence's */
    ps_kernel_system *const system = solution->system;
    const size_t n = system->num;
    double left = length_of(n, solution->residual);
    for (int i = 0; i < MOST_TIMES && left > slack * solution->target; i++) {
        PS_TRY(descend(solution, error));
        PS_TRY(find_residual(system, right, solution->x, solution->residual, error));
        left = length_of(n, solution->residual);
        if (left <= ROUNDINGS * DBL_EPSILON * system->norm * length_of(n, solution->x)) {
            break;
        }
    }
    system->facts.residual = solution->size > 0 ? left / solution->size : 0;
    const double floor = ROUNDINGS * DBL_EPSILON * system->norm * length_of(n, solution->x);
    return left <= fmax(slack * solution->target, floor)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_TOLERANCE,
                         "conjugate gradients end at a residual of %.3g, not the %.3g asked for: "
                         "rounding lets no more be gained",
                         left / solution->size, solution->target / solution->size);
}

pspec_status ps_kernel_gradients_solve(ps_kernel_system *system, const double *right, double *x,
                                       double *residual, ps_error *error) {
    const size_t n = system->num;
    const double wanted =
        system->options.residual > 0 ? system->options.residual : DEFAULT_RESIDUAL;
    const double size = length_of(n, right);
    const gradients solution = {.system = system,
                                .x = x,
                                .residual = residual,
                                .direction = system->rows + 2 * n,
                                .image = system->rows + 3 * n,
                                .better = system->rows + 4 * n,
                                .target = wanted * size,
                                .size = size};
    memset(x, 0, n * sizeof *x);
    memcpy(residual, right, n * sizeof *x);
    system->facts.num_steps = 0;
    system->facts.residual = 1;
    return descend_again(&solution, right, error);
}

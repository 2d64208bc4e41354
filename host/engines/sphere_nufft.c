#include "engines/sphere_nufft.h"

#include "base/memory.h"
#include "base/round.h"
#include "engines/nufft_fft.h"
#include "engines/nufft_plan.h"
#include "engines/reals.h"
#include "engines/sphere_nufft_points.h"
#include "engines/sphere_nufft_tables.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double four_pi = 12.566370614359172954;

/* Bits of kernels/sphere/orders.cl. */
enum { STEP_SPREAD = 1, STEP_AROUND = 2, STEP_RINGS = 4 };

typedef struct sphere_nufft {
    ps_device *device;
    ps_problem problem;
    ps_precision precision;
    ps_sphere_shape shape;
    ps_sphere_places points;
    ps_sphere_tables tables;
    cl_kernel orders, sum, fold;
    ps_buffer grids, rows, values;             /* of orders.cl */
    ps_buffer states, scales, diagonals, sums; /* of orders_sum.cl */
    ps_buffer powers;
    double *host_powers; /* [at_once][2][half_pitch] */
    double *host_rows;   /* [batch][degrees] */
} sphere_nufft;

/* ---- what the planner asks --------------------------------------------------------------- */

static bool applicable(const ps_problem *problem, const ps_device_limits *limits,
                       ps_precision precision, const char **why_not) {
    if (!ps_engine_on_device(limits, precision, why_not)) {
        return false;
    }
    if (!limits->has_fp64) {
        *why_not = "Legendre functions need double precision, which the device does not have";
        return false;
    }
    if (problem->num_points > UINT32_MAX) {
        *why_not = "too many points for 32-bit places";
        return false;
    }
    const ps_sphere_shape shape = ps_sphere_shape_make(problem, limits, precision);
    if (shape.lanes == 0) {
        *why_not = "a meridian of the fine grid does not fit into local memory";
        return false;
    }
    if (shape.largest_buffer > limits->max_allocation_bytes) {
        *why_not = "needs a larger buffer than the device allows";
        return false;
    }
    *why_not = NULL;
    return true;
}

static ps_work work(const ps_problem *problem, const ps_device_limits *limits,
                    ps_precision precision) {
    const ps_sphere_shape shape = ps_sphere_shape_make(problem, limits, precision);
    const double realizations =
        problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    const double launches_of_some = 4;
    const double row = (double)problem->frequencies->num * sizeof(double);
    return (ps_work){.transform_flops =
                         realizations * ps_sphere_nufft_flops(&shape, precision,
                                                              (double)problem->num_points,
                                                              realizations),
                     .launches = launches_of_some * ceil(realizations / (double)shape.at_once),
                     .fixed_bytes = (double)shape.fixed_bytes,
                     .host_bytes = (double)shape.host_bytes,
                     .bytes_per_realization = row,
                     .row_bytes = row,
                     .largest_buffer_per_realization = row};
}

static double error_of(const ps_problem *problem, const ps_device_limits *limits,
                       ps_precision precision, double mean_power) {
    const ps_sphere_shape shape = ps_sphere_shape_make(problem, limits, precision);
    return shape.lanes == 0 ? HUGE_VAL
                            : ps_sphere_nufft_error(&shape.axis, problem, precision, mean_power);
}

static double error_of_state(const void *state, double mean_power) {
    const sphere_nufft *self = state;
    return ps_sphere_nufft_error(&self->shape.axis, &self->problem, self->precision, mean_power);
}

/* ---- create and destroy ------------------------------------------------------------------ */

static void destroy(void *state) {
    sphere_nufft *self = state;
    if (self == NULL) {
        return;
    }
    const cl_kernel kernels[] = {self->orders, self->sum, self->fold};
    for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; i++) {
        if (kernels[i] != NULL) {
            clReleaseKernel(kernels[i]);
        }
    }
    ps_buffer *const buffers[] = {&self->grids,  &self->rows,      &self->values, &self->states,
                                  &self->scales, &self->diagonals, &self->sums,   &self->powers};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++) {
        ps_buffer_release(buffers[i]);
    }
    ps_sphere_places_free(&self->points);
    ps_sphere_tables_free(&self->tables);
    free(self->host_powers);
    free(self->host_rows);
    free(self);
}

static pspec_status create_kernels(sphere_nufft *self, ps_error *error) {
    const unsigned bits = self->precision == PS_SINGLE ? 32 : 64;
    char options[64];
    snprintf(options, sizeof options, "-DPRECISION=%u -DLANES=%u", bits, self->shape.lanes);
    PS_TRY(ps_kernel_create(self->device, &self->orders, "sphere/orders.cl", "sphere_orders",
                            options, error));
    snprintf(options, sizeof options, "-DPRECISION=%u -DLANES=%u", bits, self->shape.sum_lanes);
    PS_TRY(ps_kernel_create(self->device, &self->sum, "sphere/orders_sum.cl", "sphere_orders_sum",
                            options, error));
    return ps_kernel_create(self->device, &self->fold, "sphere/orders_sum.cl", "sphere_orders_fold",
                            options, error);
}

static pspec_status create_buffers(sphere_nufft *self, ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const size_t real_bytes = ps_real_bytes(self->precision);
    const size_t rings = (size_t)PS_SPHERE_GROUPS * shape->ring_pitch;
    const size_t grid = (size_t)shape->grid_rows * shape->pitch * real_bytes;
    const size_t sums = PS_SPHERE_GROUPS * (shape->at_once + 1) * 4 * PS_SPHERE_RUN_VECTORS *
                        shape->sum_lanes * real_bytes;
    const struct {
        ps_buffer *buffer;
        size_t bytes;
        const char *what;
    } wanted[] = {{&self->grids, shape->slots * grid, "grids of the sphere"},
                  {&self->rows, shape->slots * (shape->slot_bytes - grid), "tiles of orders"},
                  {&self->values, shape->at_once * shape->value_bytes, "values on rings"},
                  {&self->states, 2 * rings * sizeof(double), "states of rings"},
                  {&self->scales, 2 * rings * sizeof(int32_t), "scales of rings"},
                  {&self->diagonals, rings * sizeof(double), "first degrees of rings"},
                  {&self->sums, sums, "sums over rings"},
                  {&self->powers,
                   PS_SPHERE_GROUPS * shape->at_once * 2 * shape->half_pitch * sizeof(double),
                   "powers of orders"}};
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        PS_TRY(ps_buffer_create(self->device, wanted[i].buffer, wanted[i].bytes, wanted[i].what,
                                error));
    }
    return PSPEC_OK;
}

static pspec_status create_parts(sphere_nufft *self, size_t batch, ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, shape->at_once * 2 * shape->half_pitch, sizeof(double),
                       "powers of degrees", error));
    self->host_powers = memory;
    PS_TRY(ps_allocate(&memory, batch * self->problem.frequencies->num, sizeof(double),
                       "powers of a batch", error));
    self->host_rows = memory;
    PS_TRY(create_kernels(self, error));
    PS_TRY(ps_sphere_places_create(&self->points, shape, self->problem.num_points, self->precision,
                                   self->device, error));
    PS_TRY(ps_sphere_tables_create(&self->tables, shape, self->problem.tolerance, self->precision,
                                   self->device, error));
    return create_buffers(self, error);
}

static pspec_status create(void **state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *device, ps_error *error) {
    void *memory = NULL;
    *state = NULL;
    PS_TRY(ps_allocate(&memory, 1, sizeof(sphere_nufft), "an engine", error));
    sphere_nufft *self = memory;
    self->device = device;
    self->problem = *problem;
    self->precision = precision;
    self->shape = ps_sphere_shape_make(problem, ps_device_get_limits(device), precision);
    self->shape.at_once = batch < self->shape.at_once ? batch : self->shape.at_once;
    if (self->shape.slots > self->shape.at_once) {
        self->shape.shares *= ps_divide_up(self->shape.slots, self->shape.at_once);
        self->shape.slots = self->shape.at_once;
    }
    const pspec_status status = create_parts(self, batch, error);
    if (status != PSPEC_OK) {
        destroy(self);
        return status;
    }
    *state = self;
    return PSPEC_OK;
}

static void get_slots(const void *state, uint32_t *slots) {
    const sphere_nufft *self = state;
    for (size_t i = 0; i < self->problem.frequencies->num; i++) {
        slots[i] = (uint32_t)i;
    }
}

static size_t get_stride(const void *state) {
    return ((const sphere_nufft *)state)->problem.frequencies->num;
}

/* ---- run --------------------------------------------------------------------------------- */

/* Work-groups of one item on CPUs, where lanes are vectors. */
static ps_range group_range(const sphere_nufft *self, size_t groups, double flops) {
    return ps_range_heavy(self->device, 1, groups, 1, flops, 0);
}

/* Realizations first .. end - 1 of those whose points are on the device, as many at a time as there are slots. */
static pspec_status run_steps(sphere_nufft *self, size_t first, size_t end, unsigned steps,
                              size_t shares, ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const ps_sphere_tables *tables = &self->tables;
    const ps_nufft_plan *plan = &tables->plan;
    const ps_sphere_local local = ps_sphere_local_bytes(shape, ps_real_bytes(self->precision));
    const size_t slots = end - first < shape->slots ? end - first : shape->slots;
    const double transforms = (double)(end - first) * shape->pairs * 4.0 * shape->lanes;
    const ps_range range =
        group_range(self, slots * shares, transforms * ps_fft_flops(shape->axis.n));
    return PS_LAUNCH(
        self->device, self->orders, &range, error, PS_BUFFER(self->points.turns),
        PS_BUFFER(self->points.weights), PS_BUFFER(self->points.offsets), PS_U32(first),
        PS_U32(end), PS_BUFFER(plan->coefficients), PS_U32(plan->axis.n),
        PS_U32(plan->axis.window.width), PS_U32(plan->degree), PS_U32(plan->bins),
        PS_BUFFER(plan->fft.radices), PS_BUFFER(plan->fft.twiddles), PS_BUFFER(plan->fft.position),
        PS_BUFFER(tables->rings.radices), PS_BUFFER(tables->rings.twiddles),
        PS_BUFFER(tables->rings.position), PS_U32(shape->rings), PS_BUFFER(tables->around_gains),
        PS_BUFFER(tables->along_gains), PS_U32(shape->max_degree), PS_U32(steps), PS_U32(shares),
        PS_U32(shape->pitch), PS_U32(shape->grid_rows), PS_U32(shape->pole), PS_U32(shape->columns),
        PS_U32(shape->num_rings), PS_U32(shape->ring_pitch), PS_BUFFER(self->grids),
        PS_BUFFER(self->rows), PS_BUFFER(self->values), PS_LOCAL(local.data),
        PS_LOCAL(local.spectrum), PS_LOCAL(local.windows), PS_LOCAL(local.cells));
}

/* All steps in one go where there is a realization for every work-group; else slot by slot, each shared. */
static pspec_status make_values(sphere_nufft *self, size_t num, ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    if (shape->shares == 1) {
        return run_steps(self, 0, num, STEP_SPREAD | STEP_AROUND | STEP_RINGS, 1, error);
    }
    for (size_t first = 0; first < num; first += shape->slots) {
        const size_t end = num - first < shape->slots ? num : first + shape->slots;
        PS_TRY(run_steps(self, first, end, STEP_SPREAD, 1, error));
        PS_TRY(run_steps(self, first, end, STEP_AROUND, shape->shares, error));
        PS_TRY(run_steps(self, first, end, STEP_RINGS, shape->shares, error));
    }
    return PSPEC_OK;
}

/* To powers, or with the kernel that keeps them to coefficients. */
static pspec_status sum_rings(sphere_nufft *self, cl_kernel kernel, const ps_buffer *to, size_t num,
                              ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const ps_sphere_tables *tables = &self->tables;
    const ps_sphere_local local = ps_sphere_local_bytes(shape, ps_real_bytes(self->precision));
    const double degrees = shape->max_degree;
    const double flops = 4 * degrees * degrees / 2 * shape->num_rings * (double)num;
    const ps_range range = group_range(self, PS_SPHERE_GROUPS, flops);
    return PS_LAUNCH(self->device, kernel, &range, error, PS_BUFFER(self->values), PS_U32(num),
                     PS_BUFFER(tables->starts), PS_BUFFER(tables->start_scales),
                     PS_BUFFER(tables->steps), PS_BUFFER(tables->step_scales),
                     PS_BUFFER(tables->ratios), PS_BUFFER(tables->distances),
                     PS_U32(shape->max_degree), PS_U32(shape->num_rings), PS_U32(shape->ring_pitch),
                     PS_U32(self->problem.frequencies->degree_step == 2), PS_U32(shape->block),
                     PS_U32(shape->half_pitch), PS_BUFFER(self->states), PS_BUFFER(self->scales),
                     PS_BUFFER(self->diagonals), PS_BUFFER(self->sums), PS_BUFFER(*to),
                     PS_LOCAL(local.table), PS_LOCAL(local.coefficients), PS_LOCAL(local.begins));
}

static pspec_status fold_powers(sphere_nufft *self, size_t num, ps_error *error) {
    const size_t entries = num * 2 * self->shape.half_pitch;
    const ps_range range = ps_range_light(self->device, entries / self->shape.sum_lanes, 1, 1,
                                          (double)(PS_SPHERE_GROUPS * entries), 0);
    PS_TRY(PS_LAUNCH(self->device, self->fold, &range, error, PS_BUFFER(self->powers),
                     PS_U32(PS_SPHERE_GROUPS), PS_U64(entries), PS_U32(self->shape.half_pitch)));
    return ps_buffer_read(self->device, &self->powers, 0, self->host_powers,
                          entries * sizeof(double), error);
}

static void write_rows(sphere_nufft *self, size_t first, const ps_batch *some) {
    const ps_frequencies *set = self->problem.frequencies;
    const size_t pitch = self->shape.half_pitch;
    for (size_t r = 0; r < some->num_patterns; r++) {
        const double *powers = self->host_powers + r * 2 * pitch;
        double *row = self->host_rows + (first + r) * set->num;
        for (size_t i = 0; i < set->num; i++) {
            const size_t l = (size_t)set->vectors[i];
            row[i] =
                some->scales[r] * four_pi / (2 * (double)l + 1) * powers[l % 2 * pitch + l / 2];
        }
    }
}

static pspec_status run(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    sphere_nufft *self = state;
    const size_t at_once = self->shape.at_once;
    for (size_t first = 0; first < batch->num_patterns; first += at_once) {
        const size_t rest = batch->num_patterns - first;
        ps_batch some = *batch;
        some.num_patterns = rest < at_once ? rest : at_once;
        some.patterns += first;
        some.scales += first;
        some.exponents = batch->exponents != NULL ? batch->exponents + first : NULL;
        PS_TRY(ps_batch_go_on(batch, error));
        PS_TRY(ps_sphere_places_make(&self->points, &some, error));
        PS_TRY(make_values(self, some.num_patterns, error));
        PS_TRY(sum_rings(self, self->sum, &self->powers, some.num_patterns, error));
        PS_TRY(fold_powers(self, some.num_patterns, error));
        write_rows(self, first, &some);
    }
    *rows = (ps_rows){.num_rows = batch->num_patterns,
                      .stride = self->problem.frequencies->num,
                      .precision = PS_DOUBLE,
                      .host = self->host_rows};
    return PSPEC_OK;
}

/* ---- coefficients ------------------------------------------------------------------------ */

/* The largest weight is below 2^exponent: sums of them do not overflow. */
static int largest_exponent(const pspec_pattern *pattern) {
    double largest = 0;
    int exponent = 0;
    for (size_t j = 0; pattern->weights != NULL && j < pattern->num_points; j++) {
        largest = fmax(largest, fabs(pattern->weights[j]));
    }
    frexp(largest, &exponent);
    return exponent;
}

/* From [order][even, odd l - m][re, im][half_pitch]; the kernels sum conjugates. */
static void write_coefficients(const sphere_nufft *self, const double *from, int exponent,
                               double *out) {
    const size_t L = (size_t)self->shape.max_degree;
    const size_t pitch = self->shape.half_pitch;
    const bool only_even = self->problem.frequencies->degree_step == 2;
    for (size_t m = 0; m <= L; m++) {
        for (size_t l = m; l <= L; l++) {
            const double *at = from + (m * 2 + (l - m) % 2) * 2 * pitch + (l - m) / 2;
            double *to = out + 2 * (m * (2 * L + 1 - m) / 2 + l);
            const bool is_there = !only_even || l % 2 == 0;
            to[0] = is_there ? ldexp(at[0], exponent) : 0;
            to[1] = is_there ? -ldexp(at[pitch], exponent) : 0;
        }
    }
}

static pspec_status make_coefficients(sphere_nufft *self, const pspec_pattern *pattern,
                                      cl_kernel kernel, const ps_buffer *kept, int exponent,
                                      double *host, ps_error *error) {
    const ps_batch one = {.num_patterns = 1, .patterns = pattern, .exponents = &exponent};
    PS_TRY(ps_sphere_places_make(&self->points, &one, error));
    PS_TRY(make_values(self, 1, error));
    PS_TRY(sum_rings(self, kernel, kept, 1, error));
    return ps_buffer_read(self->device, kept, 0, host, kept->bytes, error);
}

/* Room for all of them only where they are asked for. */
static pspec_status coefficients(void *state, const pspec_pattern *pattern, double *out,
                                 ps_error *error) {
    sphere_nufft *self = state;
    const size_t num = ((size_t)self->shape.max_degree + 1) * 4 * self->shape.half_pitch;
    const int exponent = largest_exponent(pattern);
    char options[64];
    void *host = NULL;
    cl_kernel kernel = NULL;
    ps_buffer kept = {0};
    snprintf(options, sizeof options, "-DPRECISION=%u -DLANES=%u -DKEEP=1",
             self->precision == PS_SINGLE ? 32u : 64u, self->shape.sum_lanes);
    pspec_status status = ps_kernel_create(self->device, &kernel, "sphere/orders_sum.cl",
                                           "sphere_orders_sum", options, error);
    if (status == PSPEC_OK) {
        status = ps_allocate(&host, num, sizeof(double), "coefficients", error);
    }
    if (status == PSPEC_OK) {
        status = ps_buffer_create(self->device, &kept, num * sizeof(double), "coefficients", error);
    }
    if (status == PSPEC_OK) {
        status = make_coefficients(self, pattern, kernel, &kept, exponent, host, error);
    }
    if (status == PSPEC_OK) {
        write_coefficients(self, host, exponent, out);
    }
    if (kernel != NULL) {
        clReleaseKernel(kernel);
    }
    ps_buffer_release(&kept);
    free(host);
    return status;
}

static void describe(const void *state, ps_text *text) {
    const sphere_nufft *self = state;
    const ps_sphere_shape *shape = &self->shape;
    ps_text_append(text,
                   "(sphere_nufft precision=%s lanes=%u grid=%lu sigma=%.3g width=%u degree=%u "
                   "rings=%lu at_once=%zu)",
                   ps_precision_name(self->precision), shape->lanes, (unsigned long)shape->axis.n,
                   shape->axis.n / (2.0 * shape->max_degree), shape->axis.window.width,
                   self->tables.plan.degree, (unsigned long)shape->num_rings, shape->at_once);
}

const ps_engine ps_sphere_nufft = {
    .name = "sphere_nufft",
    .summary = "fast spherical-harmonic sums: points spread on a grid, rings, Legendre products",
    .domains = PS_ON_SPHERE,
    .needs_device = true,
    .rows_on_host = true,
    .has_precision = {true, true, false},
    .applicable = applicable,
    .work = work,
    .error = error_of,
    .error_of_state = error_of_state,
    .create = create,
    .get_slots = get_slots,
    .get_stride = get_stride,
    .run = run,
    .coefficients = coefficients,
    .describe = describe,
    .destroy = destroy,
};

/* Two engines that differ in what they make of the grid: sphere_nufft and sphere_grid. */
#include "engines/engine.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/sphere/nufft/variants.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

/* ---- what the planner asks --------------------------------------------------------------- */

/* Why there is no shape, before and after it is made; NULL: there is one. */
static const char *refuse(const ps_problem *problem, const ps_device_limits *limits,
                          ps_precision precision) {
    const char *why_not = NULL;
    if (!ps_engine_on_device(limits, precision, &why_not)) {
        return why_not;
    }
    if (!limits->has_fp64) {
        return "Legendre functions need double precision, which the device does not have";
    }
    return problem->num_points > UINT32_MAX ? "too many points for 32-bit places" : NULL;
}

static const char *refuse_shape(const ps_sphere_shape *shape, const ps_device_limits *limits,
                                ps_precision precision) {
    if (shape->lanes == 0) {
        return "the degree is too large, or local memory too small";
    }
    if (shape->table_reals * ps_real_bytes(precision) > PS_SPHERE_MOST_TABLE_BYTES) {
        return "the table of cells would take more than 64 MiB";
    }
    return shape->largest_buffer > limits->max_allocation_bytes
               ? "needs a larger buffer than the device allows"
               : NULL;
}

/* Refuses before axes are tried, which takes long where tables would be far too large anyway. */
static const char *refuse_cells(const ps_problem *problem, const ps_device_limits *limits) {
    const int32_t most_degree = 1024;
    if (limits->has_dedicated_local_memory) {
        return "its table is for the caches of CPUs; GPUs have sphere_nufft for these degrees, too";
    }
    if (problem->frequencies->max_frequency > most_degree) {
        return "the table of cells would take more than 64 MiB";
    }
    return problem->num_points >= PS_SPHERE_LEAST_SORTED
               ? "sphere_nufft sorts so many points, this engine does not"
               : NULL;
}

static const ps_sphere_variant *variant_of(const ps_sphere_shape *shape) {
    return shape->route == PS_SPHERE_BY_CELLS ? &ps_sphere_cells
           : shape->route == PS_SPHERE_ON_GPU ? &ps_sphere_gridded
           : shape->is_sorted                 ? &ps_sphere_sorted_rings
                                              : &ps_sphere_rings;
}

static ps_work work_of(const ps_sphere_shape *shape, const ps_problem *problem,
                       ps_precision precision) {
    const double realizations =
        problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    /* Of places, sums and powers; on GPUs also boxes, passes of the grid and of rings, and
     * coefficients. */
    const bool on_gpu = shape->route == PS_SPHERE_ON_GPU;
    const double launches_of_some =
        on_gpu ? 6 + shape->plane.grid.num_passes + ps_nufft_order_launches(&shape->plane.order)
               : 4;
    const double row = (double)problem->frequencies->num * sizeof(double);
    /* coefficients as the kernel keeps them, on the device and on the host */
    const double kept = problem->harmonics == PS_NO_HARMONICS
                            ? 0
                            : (double)(((size_t)shape->max_degree + 1) * 4 * shape->half_pitch) *
                                  (double)sizeof(double);
    const ps_sphere_variant *variant = variant_of(shape);
    const double programs = variant->programs + (problem->harmonics != PS_NO_HARMONICS ? 1 : 0) +
                            (variant->has_sums_one && shape->is_one_set ? 1 : 0);
    const double flops = ps_sphere_nufft_flops(shape, problem, precision, realizations);
    const double of_table =
        variant->count_table_flops != NULL ? variant->count_table_flops(shape) : 0;
    return (ps_work){.transform_flops = realizations * flops + of_table,
                     .programs = programs,
                     .launches = launches_of_some * ceil(realizations / (double)shape->at_once),
                     .fixed_bytes = (double)shape->fixed_bytes + 2 * kept,
                     .host_bytes = (double)shape->host_bytes + kept,
                     .twin_bytes = 2.0 * (double)shape->most_points * 3 * sizeof(double),
                     .bytes_per_realization = row + (double)shape->each_bytes,
                     .row_bytes = row,
                     .wanted_batch = (double)shape->at_once,
                     .largest_buffer_per_realization = row};
}

static double error_of(const ps_sphere_shape *shape, const ps_problem *problem,
                       ps_precision precision, double mean_power) {
    const double error =
        ps_sphere_nufft_error(&shape->axis, problem, precision, mean_power, shape->route);
    return shape->is_single_chain
               ? hypot(error, ps_sphere_chain_error(&shape->axis, problem, mean_power))
               : error;
}

static ps_survey survey_route(const ps_problem *problem, const ps_device_limits *limits,
                              ps_precision precision, ps_sphere_route route, const char *why_not) {
    if (why_not != NULL) {
        return (ps_survey){.why_not = why_not};
    }
    const ps_sphere_shape shape = ps_sphere_shape_make(problem, limits, precision, route);
    ps_survey result = {.why_not = refuse_shape(&shape, limits, precision)};
    if (result.why_not == NULL) {
        result.work = work_of(&shape, problem, precision);
        result.error = error_of(&shape, problem, precision, ps_expected_power(problem));
    }
    return result;
}

/* limits: NULL without a device, which refuse() says. */
static ps_sphere_route ring_route(const ps_device_limits *limits) {
    const bool on_gpu = limits != NULL && limits->has_dedicated_local_memory;
    return on_gpu ? PS_SPHERE_ON_GPU : PS_SPHERE_BY_RINGS;
}

static ps_survey survey_rings(const ps_problem *problem, const ps_device_limits *limits,
                              ps_precision precision) {
    return survey_route(problem, limits, precision, ring_route(limits),
                        refuse(problem, limits, precision));
}

static ps_survey survey_cells(const ps_problem *problem, const ps_device_limits *limits,
                              ps_precision precision) {
    const char *why_not = refuse(problem, limits, precision);
    return survey_route(problem, limits, precision, PS_SPHERE_BY_CELLS,
                        why_not != NULL ? why_not : refuse_cells(problem, limits));
}

static double error_of_state(const void *state, double mean_power, double weight_share) {
    const ps_sphere_state *self = state;
    (void)weight_share;
    return error_of(&self->shape, &self->problem, self->precision, mean_power);
}

/* ---- create and destroy ------------------------------------------------------------------ */

static void destroy(void *state) {
    ps_sphere_state *self = state;
    if (self->own != NULL) {
        self->variant->free(self->own);
    }
    free(self->own);
    PS_BUFFERS_RELEASE(&self->grids, &self->scratch, &self->values, &self->sums);
    ps_sphere_places_free(&self->points);
    ps_sphere_tables_free(&self->tables);
    ps_late_rows_free(&self->rows);
}

static void make_row(const void *engine, const void *sums, double scale, double square,
                     double *row) {
    const ps_sphere_state *self = engine;
    const ps_frequencies *set = self->problem.frequencies;
    const size_t pitch = self->shape.half_pitch;
    const double *const powers = sums;
    (void)square;
    for (size_t i = 0; i < set->num; i++) {
        const size_t l = (size_t)set->vectors[i];
        row[i] = scale * PS_FOUR_PI / (2 * (double)l + 1) * powers[l % 2 * pitch + l / 2];
    }
}

static pspec_status create_rows(ps_sphere_state *self, size_t batch, ps_error *error) {
    self->rows = (ps_late_rows){.engine = self,
                                .make = make_row,
                                .num = self->problem.frequencies->num,
                                .batch = batch,
                                .most = self->shape.at_once,
                                .sum_bytes = 2 * self->shape.half_pitch * sizeof(double)};
    return ps_late_rows_create(&self->rows, self->device, error);
}

static pspec_status create_buffers(ps_sphere_state *self, ps_error *error) {
    const ps_sphere_bytes bytes = ps_sphere_bytes_of(&self->shape, ps_real_bytes(self->precision));
    const ps_wanted_buffer wanted[] = {{&self->grids, bytes.grids, "grids of the sphere"},
                                       {&self->scratch, bytes.scratch, "rows of transforms"}};
    PS_TRY(ps_buffer_create(
        self->device, &self->values, self->shape.at_once * bytes.values + bytes.gaps,
        self->shape.route == PS_SPHERE_BY_CELLS ? "values on angles" : "values on rings", error));
    return self->shape.route == PS_SPHERE_ON_GPU ? PSPEC_OK
                                                 : PS_BUFFERS_CREATE(self->device, wanted, error);
}

static pspec_status create_parts(ps_sphere_state *self, size_t batch, ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    PS_TRY(create_rows(self, batch, error));
    PS_TRY(ps_sphere_places_create(&self->points, shape, self->variant->program, self->precision,
                                   self->device, error));
    PS_TRY(ps_sphere_tables_create(&self->tables, shape, self->problem.tolerance, self->precision,
                                   self->device, error));
    PS_TRY(ps_allocate(&self->own, 1, self->variant->own_bytes, "an engine", error));
    PS_TRY(self->variant->create(self, error)); /* takes more for a while: before what follows */
    PS_TRY(ps_sphere_powers_create(self, error));
    return create_buffers(self, error);
}

static pspec_status create_route(ps_sphere_state *self, const ps_problem *problem,
                                 ps_precision precision, size_t batch, ps_device *device,
                                 ps_sphere_route route, ps_error *error) {
    self->device = device;
    self->problem = *problem;
    self->precision = precision;
    self->only_even = problem->frequencies->degree_step == 2;
    self->shape = ps_sphere_shape_make(problem, ps_device_get_limits(device), precision, route);
    ps_sphere_shape_shrink(&self->shape, batch);
    self->variant = variant_of(&self->shape);
    return create_parts(self, batch, error);
}

static pspec_status create_rings(void *state, const ps_problem *problem, ps_precision precision,
                                 size_t batch, ps_device *device, ps_error *error) {
    return create_route(state, problem, precision, batch, device,
                        ring_route(ps_device_get_limits(device)), error);
}

static pspec_status create_cells(void *state, const ps_problem *problem, ps_precision precision,
                                 size_t batch, ps_device *device, ps_error *error) {
    return create_route(state, problem, precision, batch, device, PS_SPHERE_BY_CELLS, error);
}

/* ---- run --------------------------------------------------------------------------------- */

/* Values of at most at_once patterns. */
static pspec_status make_values(ps_sphere_state *self, const ps_batch *batch, ps_error *error) {
    const size_t together = self->shape.together;
    for (size_t first = 0; first < batch->num_patterns; first += together) {
        const ps_batch some = ps_batch_part(batch, first, together);
        PS_TRY(ps_batch_go_on(batch, error));
        PS_TRY(self->variant->make_values(self, first, &some, error));
    }
    return PSPEC_OK;
}

static pspec_status run(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    ps_sphere_state *self = state;
    const size_t at_once = self->shape.at_once;
    for (size_t first = 0; first < batch->num_patterns; first += at_once) {
        const ps_batch some = ps_batch_part(batch, first, at_once);
        PS_TRY(make_values(self, &some, error));
        PS_TRY(ps_sphere_powers_sum(self, some.num_patterns, error));
        PS_TRY(ps_late_rows_read(&self->rows, &self->sums, first, some.num_patterns, some.scales,
                                 NULL, error));
    }
    *rows = ps_late_rows_give(&self->rows, batch->num_patterns);
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

/* Reads [order][even, odd l - m][re, im][half_pitch]; the kernels sum conjugates. */
static void write_coefficients(const ps_sphere_state *self, const double *from, int exponent,
                               double *out) {
    const size_t L = (size_t)self->shape.max_degree;
    const size_t pitch = self->shape.half_pitch;
    for (size_t m = 0; m <= L; m++) {
        for (size_t l = m; l <= L; l++) {
            const double *at = from + (m * 2 + (l - m) % 2) * 2 * pitch + (l - m) / 2;
            double *to = out + 2 * (m * (2 * L + 1 - m) / 2 + l);
            const bool is_there = !self->only_even || l % 2 == 0;
            to[0] = is_there ? ldexp(at[0], exponent) : 0;
            to[1] = is_there ? -ldexp(at[pitch], exponent) : 0;
        }
    }
}

static pspec_status coefficients(void *state, const ps_batch *one, ps_rows *rows, double *out,
                                 ps_error *error) {
    ps_sphere_state *self = state;
    const int of_batch = one->exponents != NULL ? one->exponents[0] : 0;
    /* Rows beside them are those of a run, with the exponent of the batch. */
    const int exponent = rows != NULL ? of_batch : largest_exponent(one->patterns);
    ps_batch scaled = *one;
    void *host = NULL;
    scaled.exponents = &exponent;
    PS_TRY(rows != NULL ? run(state, one, rows, error) /* its values stay there */
                        : make_values(self, &scaled, error));
    PS_TRY(ps_batch_go_on(one, error));
    PS_TRY(ps_allocate(&host, ((size_t)self->shape.max_degree + 1) * 4 * self->shape.half_pitch,
                       sizeof(double), "coefficients", error));
    const pspec_status status = ps_sphere_powers_keep(self, host, error);
    if (status == PSPEC_OK) {
        write_coefficients(self, host, exponent, out);
    }
    free(host);
    return status;
}

static void describe(const ps_sphere_state *self, const char *name, ps_text *text) {
    const ps_sphere_shape *shape = &self->shape;
    ps_text_append(text, "(%s precision=%s lanes=%u grid=%lu sigma=%.3g width=%u degree=%u ", name,
                   ps_precision_name(self->precision), shape->lanes, (unsigned long)shape->axis.n,
                   shape->axis.n / (2.0 * shape->max_degree), shape->axis.window.width,
                   self->tables.plan.degree);
    self->variant->describe(self, text);
    ps_text_append(text, ")");
}

static void describe_rings(const void *state, ps_text *text) {
    describe(state, ps_sphere_nufft.name, text);
}

static void describe_cells(const void *state, ps_text *text) {
    describe(state, ps_sphere_grid.name, text);
}

/* ---- the engines ------------------------------------------------------------------------- */

const ps_engine ps_sphere_nufft = {
    .name = "sphere_nufft",
    .domains = PS_ON_SPHERE,
    .needs_device = true,
    .rows_on_host = true,
    .takes_sets = true,
    .has_precision = {true, true, false},
    .survey = survey_rings,
    .error_of_state = error_of_state,
    .state_bytes = sizeof(ps_sphere_state),
    .create = create_rings,
    .run = run,
    .coefficients = coefficients,
    .describe = describe_rings,
    .destroy = destroy,
};

const ps_engine ps_sphere_grid = {
    .name = "sphere_grid",
    .domains = PS_ON_SPHERE,
    .needs_device = true,
    .rows_on_host = true,
    .takes_sets = true,
    .has_precision = {true, true, false},
    .survey = survey_cells,
    .error_of_state = error_of_state,
    .state_bytes = sizeof(ps_sphere_state),
    .create = create_cells,
    .run = run,
    .coefficients = coefficients,
    .describe = describe_cells,
    .destroy = destroy,
};

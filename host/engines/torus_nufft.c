/* The engine: for some realizations at a time, sort points by cells of the fine grid, make their windows and
 * phases, spread and transform tiles into powers. docs/torus_nufft.md. */
#include "engines/torus_nufft.h"

#include "base/memory.h"
#include "engines/nufft_layout.h"
#include "engines/nufft_places.h"
#include "engines/nufft_plan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct torus_nufft {
    ps_device *device;
    const ps_frequencies *frequencies;
    ps_precision precision;
    ps_nufft_layout layout;
    size_t batch;
    ps_nufft_plan plans[PS_NUFFT_MAX_AXES];
    ps_nufft_places places;
    cl_kernel tile, rows, columns;
    ps_buffer means, pattern, grid, scales, power;
    double *means_of_parts;
} torus_nufft;

/* ---- what the planner asks --------------------------------------------------------------- */

static bool applicable_to_problem(const ps_problem *problem, const char **why_not) {
    const ps_frequencies *set = problem->frequencies;
    if (set->kind == PS_FREQUENCIES_LIST) {
        *why_not = "full grids only, not lists of frequencies";
    } else if (set->dimension > 3) {
        *why_not = "up to three dimensions only";
    } else if (problem->num_points > UINT32_MAX) {
        *why_not = "too many points for 32-bit places";
    } else {
        return true;
    }
    return false;
}

static bool applicable(const ps_problem *problem, const ps_device_limits *limits,
                       ps_precision precision, const char **why_not) {
    if (limits == NULL) {
        *why_not = "needs an OpenCL device";
        return false;
    }
    if (precision == PS_EXTENDED) {
        *why_not = "single and double precision only";
        return false;
    }
    if (precision == PS_DOUBLE && !limits->has_fp64) {
        *why_not = "the device has no double precision";
        return false;
    }
    if (!applicable_to_problem(problem, why_not)) {
        return false;
    }
    const ps_nufft_layout layout = ps_nufft_layout_make(problem, limits, precision);
    if (layout.lanes == 0) {
        *why_not = "a row of the fine grid does not fit into local memory";
        return false;
    }
    if (layout.largest_buffer > limits->max_allocation_bytes ||
        layout.largest_buffer_per_realization > limits->max_allocation_bytes) {
        *why_not = "needs a larger buffer than the device allows";
        return false;
    }
    *why_not = NULL;
    return true;
}

static ps_work work(const ps_problem *problem, const ps_device_limits *limits,
                    ps_precision precision) {
    const ps_nufft_layout layout = ps_nufft_layout_make(problem, limits, precision);
    const double realizations =
        problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    const double num_kernels = layout.choice.num_axes == 1 ? 2 : 3;
    return (ps_work){
        .transform_flops =
            realizations * ps_nufft_flops(&layout.choice, precision, (double)problem->num_points),
        .launches = num_kernels * ceil(realizations / (double)layout.parts),
        .fixed_bytes = (double)layout.fixed_bytes,
        .bytes_per_realization = (double)layout.bytes_per_realization,
        .largest_buffer_per_realization = (double)layout.largest_buffer_per_realization};
}

static double error_of(const ps_problem *problem, ps_precision precision, double mean_power) {
    const ps_nufft_choice choice = ps_nufft_choose(problem, precision);
    return ps_nufft_error(&choice, problem, precision, mean_power);
}

/* ---- create and destroy ------------------------------------------------------------------ */

static void destroy(void *state) {
    torus_nufft *self = state;
    if (self == NULL) {
        return;
    }
    const cl_kernel kernels[] = {self->tile, self->rows, self->columns};
    ps_buffer *const buffers[] = {&self->means, &self->pattern, &self->grid, &self->scales,
                                  &self->power};
    for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; i++) {
        if (kernels[i] != NULL) {
            clReleaseKernel(kernels[i]);
        }
    }
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++) {
        ps_buffer_release(buffers[i]);
    }
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        ps_nufft_plan_free(&self->plans[i]);
    }
    ps_nufft_places_free(&self->places);
    free(self->means_of_parts);
    free(self);
}

static pspec_status create_kernels(torus_nufft *self, ps_error *error) {
    char options[64];
    snprintf(options, sizeof options, "-DPRECISION=%u -DLANES=%u",
             self->precision == PS_SINGLE ? 32u : 64u, self->layout.lanes);
    if (self->layout.choice.num_axes == 1) {
        return ps_kernel_create(self->device, &self->tile, "nufft/tile.cl", "nufft_tile", options,
                                error);
    }
    PS_TRY(
        ps_kernel_create(self->device, &self->rows, "nufft/rows.cl", "nufft_rows", options, error));
    return ps_kernel_create(self->device, &self->columns, "nufft/columns.cl", "nufft_columns",
                            options, error);
}

/* How frequency 0 turns from cell to cell of the first axis: by -K turns around it where that axis makes
 * frequencies of axis 0 (its frequency -K is that one), not at all otherwise. */
static pspec_status create_pattern(torus_nufft *self, ps_error *error) {
    const ps_nufft_choice *choice = &self->layout.choice;
    const uint32_t n = choice->axes[0].n;
    const uint64_t turns = choice->stride != 0 ? (uint64_t)choice->axes[0].max_frequency : 0;
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, n, 2 * sizeof(double), "a pattern", error));
    double *pattern = memory;
    for (uint32_t m = 0; m < n; m++) {
        const double two_pi = 6.283185307179586;
        const double angle = two_pi * (double)(turns * m % n) / n;
        pattern[2 * m] = cos(angle);
        pattern[2 * m + 1] = -sin(angle);
    }
    const pspec_status status = ps_nufft_upload(self->device, &self->pattern, self->precision,
                                                pattern, 2 * (size_t)n, "a pattern", error);
    free(memory);
    return status;
}

static pspec_status create_buffers(torus_nufft *self, size_t rows, ps_error *error) {
    const ps_nufft_layout *layout = &self->layout;
    const size_t vector_bytes = 2 * layout->lanes * layout->real_bytes;
    const struct {
        ps_buffer *buffer;
        size_t bytes;
        const char *what;
    } all[] = {
        {&self->means, layout->parts * layout->real_bytes, "means"},
        {&self->grid, layout->parts * layout->grid_cells * vector_bytes, "transformed rows"},
        {&self->scales, rows * layout->real_bytes, "scales"},
        {&self->power, rows * layout->stride * layout->real_bytes, "powers of a batch"},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        PS_TRY(ps_buffer_create(self->device, all[i].buffer, all[i].bytes, all[i].what, error));
    }
    return ps_buffer_clear(self->device, &self->power, error);
}

static pspec_status create_parts(torus_nufft *self, const ps_problem *problem, ps_error *error) {
    const ps_nufft_choice *choice = &self->layout.choice;
    const size_t rows =
        (self->batch + self->layout.lanes - 1) / self->layout.lanes * self->layout.lanes;
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, self->layout.parts, sizeof(double), "means", error));
    self->means_of_parts = memory;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        PS_TRY(ps_nufft_plan_create(&self->plans[i], &choice->axes[i], problem->tolerance,
                                    self->precision, self->device, error));
    }
    PS_TRY(create_kernels(self, error));
    PS_TRY(create_pattern(self, error));
    PS_TRY(ps_nufft_places_create(&self->places, &self->layout, self->frequencies->dimension,
                                  self->precision, self->device, error));
    return create_buffers(self, rows, error);
}

static pspec_status create(void **state, const ps_problem *problem, ps_precision precision,
                           size_t batch, ps_device *device, ps_error *error) {
    void *memory = NULL;
    *state = NULL;
    PS_TRY(ps_allocate(&memory, 1, sizeof(torus_nufft), "an engine", error));
    torus_nufft *self = memory;
    self->device = device;
    self->frequencies = problem->frequencies;
    self->precision = precision;
    self->batch = batch;
    self->layout = ps_nufft_layout_make(problem, ps_device_get_limits(device), precision);
    self->layout.parts = self->layout.parts < batch ? self->layout.parts : batch;
    const pspec_status status = create_parts(self, problem, error);
    if (status != PSPEC_OK) {
        destroy(self);
        return status;
    }
    *state = self;
    return PSPEC_OK;
}

static void get_slots(const void *state, uint32_t *slots) {
    const torus_nufft *self = state;
    const ps_frequencies *set = self->frequencies;
    for (size_t i = 0; i < set->num; i++) {
        slots[i] = ps_nufft_slot(&self->layout, set->vectors + i * set->dimension, set->dimension);
    }
}

static size_t get_stride(const void *state) {
    return ((const torus_nufft *)state)->layout.stride;
}

/* ---- run --------------------------------------------------------------------------------- */

/* What frequency 0 leaves in a cell, to be taken off: it then does not round into the others. */
static double mean_of_cells(const torus_nufft *self, const pspec_pattern *pattern, int exponent) {
    const ps_nufft_choice *choice = &self->layout.choice;
    double mean = 0;
    for (size_t j = 0; pattern->weights != NULL && j < pattern->num_points; j++) {
        mean += ldexp(pattern->weights[j], -exponent);
    }
    mean = pattern->weights != NULL ? mean : (double)pattern->num_points;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const ps_nufft_axis *axis = &choice->axes[i];
        const double q = i == 0 && choice->stride != 0 ? axis->max_frequency : 0;
        mean *= ps_nufft_window_transform(&axis->window, q / axis->n) / axis->n;
    }
    return mean;
}

static pspec_status upload_means(torus_nufft *self, const ps_batch *some, ps_error *error) {
    for (size_t r = 0; r < some->num_patterns; r++) {
        self->means_of_parts[r] = mean_of_cells(self, &some->patterns[r],
                                                some->exponents != NULL ? some->exponents[r] : 0);
    }
    return ps_nufft_write(self->device, &self->means, self->precision, self->means_of_parts,
                          some->num_patterns, error);
}

/* Work-groups of one item on CPUs, where lanes are vectors; of several that share a row on GPUs, and where
 * tests say so. */
static ps_range group_range(const torus_nufft *self, size_t num_groups, size_t num_realizations,
                            const ps_nufft_axis *axis, size_t rows_of_group) {
    const double transforms =
        (double)(num_groups * num_realizations * rows_of_group) * self->layout.lanes;
    return ps_range_heavy(self->device, 1, num_groups, num_realizations,
                          transforms * ps_fft_flops(axis->n), 0);
}

static size_t row_bytes(const torus_nufft *self, const ps_nufft_axis *axis) {
    return ps_nufft_row_cells(axis) * 2 * self->layout.lanes * self->layout.real_bytes;
}

/* Neighbours in the order of cells are nearly always so close. */
static uint32_t gap_of(const torus_nufft *self) {
    const double density = (double)self->layout.part_points / self->layout.choice.axes[0].n;
    return density > 5 ? 1 : density > 2.5 ? 2 : 4;
}

/* Arguments of an axis, as kernels/nufft/window.h has them. */
#define WINDOW_ARGUMENTS(plan)                                                                     \
    PS_U32((plan)->axis.n), PS_U32((plan)->axis.window.width), PS_U32((plan)->axis.axis),          \
        PS_U64((plan)->axis.factor), PS_U32((plan)->degree), PS_U32((plan)->bins),                 \
        PS_U32((plan)->pitch)

/* Local memory of a work-group, as kernels/nufft/spread.h has it. */
#define LOCAL_ARGUMENTS(self, axis)                                                                \
    PS_LOCAL((self)->layout.group *row_bytes(self, axis)),                                         \
        PS_LOCAL((self)->layout.chunk_reals *(self)->layout.real_bytes),                           \
        PS_LOCAL(PS_NUFFT_CHUNK * sizeof(uint64_t)), PS_LOCAL(PS_NUFFT_CHUNK * sizeof(uint32_t))

static size_t num_groups(const torus_nufft *self) {
    return (self->layout.num_tiles + self->layout.group - 1) / self->layout.group;
}

static pspec_status make_tiles(torus_nufft *self, size_t num_realizations, size_t first_row,
                               ps_error *error) {
    const ps_nufft_plan *plan = &self->plans[0];
    const ps_nufft_places *places = &self->places;
    const ps_range range =
        group_range(self, num_groups(self), num_realizations, &plan->axis, self->layout.group);
    return PS_LAUNCH(
        self->device, self->tile, &range, error, PS_BUFFER(places->places),
        PS_BUFFER(places->sorted), PS_BUFFER(places->heights), PS_BUFFER(plan->coefficients),
        PS_BUFFER(plan->fft.radices), PS_BUFFER(plan->fft.twiddles), PS_BUFFER(plan->fft.position),
        PS_BUFFER(plan->gains), PS_BUFFER(self->means), PS_BUFFER(self->pattern),
        PS_BUFFER(self->scales), PS_BUFFER(self->power), PS_U32(first_row),
        PS_U64(self->layout.stride), PS_U32(ps_nufft_base(&self->layout.choice)),
        PS_U32(self->layout.num_tiles), PS_U32(self->layout.group),
        PS_U32(self->frequencies->dimension), WINDOW_ARGUMENTS(plan), PS_U32(gap_of(self)),
        PS_U32(plan->axis.max_frequency), LOCAL_ARGUMENTS(self, &plan->axis));
}

static pspec_status make_rows(torus_nufft *self, size_t num_realizations, ps_error *error) {
    const ps_nufft_plan *across = &self->plans[0];
    const ps_nufft_plan *along = &self->plans[1];
    const ps_nufft_places *places = &self->places;
    const ps_range range = group_range(self, num_groups(self) * across->axis.n, num_realizations,
                                       &along->axis, self->layout.group);
    return PS_LAUNCH(
        self->device, self->rows, &range, error, PS_BUFFER(places->places),
        PS_BUFFER(places->sorted), PS_BUFFER(places->heights), PS_BUFFER(places->starts),
        PS_BUFFER(across->coefficients), WINDOW_ARGUMENTS(across), PS_BUFFER(along->coefficients),
        WINDOW_ARGUMENTS(along), PS_BUFFER(along->fft.radices), PS_BUFFER(along->fft.twiddles),
        PS_BUFFER(along->fft.position), PS_BUFFER(self->means), PS_BUFFER(self->grid),
        PS_U32(ps_nufft_base(&self->layout.choice)), PS_U32(self->layout.num_tiles),
        PS_U32(self->layout.group), PS_U32(self->frequencies->dimension),
        PS_U32(along->axis.max_frequency), LOCAL_ARGUMENTS(self, &along->axis));
}

static pspec_status make_columns(torus_nufft *self, size_t num_realizations, size_t first_row,
                                 ps_error *error) {
    const ps_nufft_plan *across = &self->plans[0];
    const ps_nufft_plan *along = &self->plans[1];
    const size_t kept = 2 * (size_t)along->axis.max_frequency + 1;
    const ps_range range =
        group_range(self, self->layout.num_tiles * kept, num_realizations, &across->axis, 1);
    return PS_LAUNCH(self->device, self->columns, &range, error, PS_BUFFER(self->grid),
                     PS_BUFFER(across->fft.radices), PS_BUFFER(across->fft.twiddles),
                     PS_BUFFER(across->fft.position), PS_BUFFER(across->gains),
                     PS_BUFFER(along->gains), PS_BUFFER(self->scales), PS_BUFFER(self->power),
                     PS_U32(first_row), PS_U64(self->layout.stride), PS_U32(across->axis.n),
                     PS_U32(across->axis.max_frequency), PS_U32(along->axis.max_frequency),
                     PS_LOCAL(row_bytes(self, &across->axis)));
}

static pspec_status transform(torus_nufft *self, const ps_batch *some, size_t first_row,
                              ps_error *error) {
    PS_TRY(ps_nufft_places_make(&self->places, some, error));
    PS_TRY(upload_means(self, some, error));
    if (self->layout.choice.num_axes == 1) {
        return make_tiles(self, some->num_patterns, first_row, error);
    }
    PS_TRY(make_rows(self, some->num_patterns, error));
    return make_columns(self, some->num_patterns, first_row, error);
}

static pspec_status run(void *state, const ps_batch *batch, ps_rows *rows, ps_error *error) {
    torus_nufft *self = state;
    PS_TRY(ps_nufft_write(self->device, &self->scales, self->precision, batch->scales,
                          batch->num_patterns, error));
    for (size_t row = 0; row < batch->num_patterns; row += self->layout.parts) {
        const size_t rest = batch->num_patterns - row;
        ps_batch some = *batch;
        some.num_patterns = rest < self->layout.parts ? rest : self->layout.parts;
        some.patterns += row;
        some.exponents = batch->exponents != NULL ? batch->exponents + row : NULL;
        PS_TRY(ps_batch_go_on(batch, error));
        PS_TRY(transform(self, &some, row, error));
    }
    *rows = (ps_rows){.num_rows = batch->num_patterns,
                      .stride = self->layout.stride,
                      .precision = self->precision,
                      .device = self->power};
    return PSPEC_OK;
}

static void describe(const void *state, ps_text *text) {
    const torus_nufft *self = state;
    const ps_nufft_choice *choice = &self->layout.choice;
    ps_text_append(text, "(torus_nufft precision=%s lanes=%u tiles=%lu",
                   ps_precision_name(self->precision), self->layout.lanes,
                   (unsigned long)self->layout.num_tiles);
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const ps_nufft_axis *axis = &choice->axes[i];
        ps_text_append(text, " grid=%lu sigma=%.3g width=%u degree=%u", (unsigned long)axis->n,
                       axis->n / (2.0 * axis->max_frequency), axis->window.width,
                       self->plans[i].degree);
    }
    ps_text_append(text, " group=%lu at_once=%zu)", (unsigned long)self->layout.group,
                   self->layout.parts);
}

const ps_engine ps_torus_nufft = {
    .name = "torus_nufft",
    .summary =
        "fast transforms of points spread on a grid, on the device; grids in 1 to 3 dimensions",
    .needs_device = true,
    .has_precision = {true, true, false},
    .applicable = applicable,
    .work = work,
    .error = error_of,
    .create = create,
    .get_slots = get_slots,
    .get_stride = get_stride,
    .run = run,
    .describe = describe,
    .destroy = destroy,
};

#include "engines/sphere/nufft/variants.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/nufft/window.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is there only while the table is made. */
typedef struct making {
    const ps_sphere_shape *shape; /* of the table */
    ps_sphere_shape rings;        /* where Lambda_lm is made, in double precision */
    bool only_even;
    ps_precision precision;
    ps_device *device;
    uint32_t angle_pitch;
    ps_kernel *make, *begin;
    ps_sphere_starts starts;
    ps_buffer filters, states, scales, diagonals, diagonal_scales;
} making;

/* ---- filters ------------------------------------------------------------------------------ */

/* From Lambda_lm on a circle of n' rings to V on the angles t_i of the grid, where the window is
 * undone:
 *
 *     V(t) = sum_j Lambda(s_j) h(t - s_j),   h(t) = sum_|k|<=L g_k cos(k t) / n',   g_k = 1 / window^(k)
 *
 * Rings s, -s, pi - s and pi + s are one by the parities of m and of l + m: what is left of cos(k
 * (t - s)) is 4 cos(k t) cos(k s) for even m, 4 sin(k t) sin(k s) for odd ones, for frequencies k
 * of one parity, and half of that where a ring is its own mirror image. An angle that is its own,
 * at the equator, is two of one place: it counts half. */
typedef struct waves {
    double *angles; /* [cosine, sine][L + 1][angle_pitch], with g_k / n' */
    double *rings;  /* [cosine, sine][L + 1][num_rings], with 4 or 2 */
    size_t num_frequencies, num_angles, num_rings;
} waves;

/* cos and sin of i half cells of a circle of `length`, i < 2 length: [i][cosine, sine] */
static pspec_status create_turns(double **out, uint32_t length, ps_error *error) {
    const size_t num = 2 * (size_t)length;
    PS_TRY(PS_NEW(out, 2 * num, "turns", error));
    for (size_t i = 0; i < num; i++) {
        const long double angle = PS_TWO_PI_L * (long double)i / (long double)num;
        (*out)[2 * i] = (double)cosl(angle);
        (*out)[2 * i + 1] = (double)sinl(angle);
    }
    return PSPEC_OK;
}

/* Fills waves at angles of 2 i + odd half cells. */
static pspec_status fill_waves(double *out, size_t pitch, uint32_t length, bool odd, size_t num,
                               const double *factors, size_t num_frequencies, ps_error *error) {
    double *turns = NULL;
    PS_TRY(create_turns(&turns, length, error));
    for (size_t k = 0; k < num_frequencies; k++) {
        for (size_t i = 0; i < num; i++) {
            const size_t place = 2 * i + odd;
            const double *turn = turns + k * place % (2 * (size_t)length) * 2;
            const double factor = factors[k] * (2 * place == length ? 0.5 : 1);
            out[k * pitch + i] = turn[0] * factor;
            out[(num_frequencies + k) * pitch + i] = turn[1] * factor;
        }
    }
    free(turns);
    return PSPEC_OK;
}

static pspec_status create_waves(waves *out, const making *self, ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const size_t num = (size_t)shape->max_degree + 1;
    *out = (waves){.num_frequencies = num,
                   .num_angles = self->angle_pitch,
                   .num_rings = self->rings.num_rings};
    const size_t of_angles = 2 * num * out->num_angles;
    const size_t of_rings = 2 * num * out->num_rings;
    PS_TRY(PS_NEW(&out->angles, of_angles + of_rings + num, "waves", error));
    out->rings = out->angles + of_angles;
    double *const factors = out->rings + of_rings;
    for (size_t k = 0; k < num; k++) {
        const double gain =
            1 / ps_nufft_window_transform(&shape->axis.window, (long double)k / shape->axis.n);
        factors[k] = (k == 0 ? 1 : 2) * gain / self->rings.rings;
    }
    PS_TRY(fill_waves(out->angles, out->num_angles, shape->axis.n, true, shape->num_angles, factors,
                      num, error));
    for (size_t k = 0; k < num; k++) {
        factors[k] = 4;
    }
    PS_TRY(fill_waves(out->rings, out->num_rings, self->rings.rings, false, out->num_rings, factors,
                      num, error));
    for (size_t k = 0; k < 2 * num; k++) {
        out->rings[k * out->num_rings] /= 2; /* the poles are their own mirror images */
    }
    return PSPEC_OK;
}

/* [order modulo 2][even, odd l - m][ring][angle_pitch] */
static void fill_filters(double *out, const waves *parts) {
    const size_t num = parts->num_frequencies;
    for (size_t i = 0; i < 4; i++) {
        const size_t is_sine = i / 2;
        const double *angles = parts->angles + is_sine * num * parts->num_angles;
        const double *rings = parts->rings + is_sine * num * parts->num_rings;
        for (size_t j = 0; j < parts->num_rings; j++) {
            double *row = out + (i * parts->num_rings + j) * parts->num_angles;
            for (size_t k = (i + is_sine) % 2; k < num; k += 2) {
                const double factor = rings[k * parts->num_rings + j];
                for (size_t angle = 0; angle < parts->num_angles; angle++) {
                    row[angle] += factor * angles[k * parts->num_angles + angle];
                }
            }
        }
    }
}

static size_t num_filters(const making *self) {
    return 4 * (size_t)self->rings.num_rings * self->angle_pitch;
}

static pspec_status create_filters(making *self, ps_error *error) {
    waves of = {0};
    void *memory = NULL;
    pspec_status status = create_waves(&of, self, error);
    if (status == PSPEC_OK) {
        status = ps_allocate(&memory, num_filters(self), sizeof(double), "filters", error);
    }
    if (status == PSPEC_OK) {
        fill_filters(memory, &of);
        status = ps_reals_upload(self->device, &self->filters, PS_DOUBLE, memory, num_filters(self),
                                 "filters", error);
    }
    free(memory);
    free(of.angles);
    return status;
}

/* ---- where things are --------------------------------------------------------------------- */

static pspec_status create_offsets(ps_sphere_grid_table *table, const making *self,
                                   ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const size_t num = 2 * ((size_t)shape->max_degree + 1);
    uint64_t *offsets = NULL;
    PS_TRY(PS_NEW(&offsets, num, "places of orders", error));
    uint64_t place = 0;
    for (size_t i = 0; i < num; i++) {
        const size_t least = i / 2 + i % 2; /* the first degree */
        offsets[i] = place;
        place += least < num / 2
                     ? ps_divide_up((num / 2 - least + 1) / 2, shape->lanes) * shape->num_angles
                     : 0;
    }
    const pspec_status status = ps_buffer_upload(self->device, &table->offsets, offsets,
                                                 num * sizeof(uint64_t), "places of orders", error);
    free(offsets);
    return status;
}

static size_t num_begins(const ps_sphere_shape *shape) {
    return 2 * ((size_t)shape->max_degree + 1) * shape->most_runs;
}

/* Runs that an order does not have begin where no angle counts. */
static pspec_status create_begins(ps_sphere_grid_table *table, const making *self,
                                  ps_error *error) {
    const size_t bytes = num_begins(self->shape) * sizeof(uint32_t);
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, bytes, 1, "first angles of orders", error));
    memset(memory, 0xFF, bytes);
    const pspec_status status = ps_buffer_upload(self->device, &table->begins, memory, bytes,
                                                 "first angles of orders", error);
    free(memory);
    return status;
}

static pspec_status create_buffers(ps_sphere_grid_table *table, making *self, ps_error *error) {
    const size_t pitch = self->rings.ring_pitch;
    const ps_wanted_buffer wanted[] = {
        {&table->numbers, self->shape->table_reals * ps_real_bytes(self->precision),
         "the table of cells"},
        {&self->states, PS_SPHERE_GROUPS * 4 * pitch * sizeof(double), "states of rings"},
        {&self->scales, PS_SPHERE_GROUPS * 2 * pitch * sizeof(int32_t), "scales of rings"},
        {&self->diagonals, PS_SPHERE_GROUPS * pitch * sizeof(double), "first degrees of rings"},
        {&self->diagonal_scales, PS_SPHERE_GROUPS * pitch * sizeof(int32_t),
         "scales of first degrees"},
    };
    return PS_BUFFERS_CREATE(self->device, wanted, error);
}

/* ---- kernels ------------------------------------------------------------------------------ */

static pspec_status create_kernels(making *self, ps_error *error) {
    const size_t target_bytes = ps_real_bytes(self->precision);
    ps_defines making_defines = ps_defines_of(sizeof(double), self->rings.lanes);
    const ps_defines target = ps_sphere_defines(self->shape, self->precision);
    ps_defines_add(&making_defines, "-DRUN_VECTORS=%u -DTARGET_PRECISION=%zu",
                   self->rings.run_vectors, 8 * target_bytes);
    ps_defines_add(&making_defines, "-DTARGET_LANES=%u -DTARGET_VECTORS=%u", self->shape->lanes,
                   self->shape->run_vectors);
    PS_TRY(ps_kernel_get(self->device, &self->make, "sphere/grid/table.cl", "sphere_grid_table",
                         making_defines.text, error));
    return ps_kernel_get(self->device, &self->begin, "sphere/grid/values.cl", "sphere_grid_begins",
                         target.text, error);
}

static pspec_status make_numbers(const ps_sphere_grid_table *table, const making *self,
                                 ps_error *error) {
    const ps_sphere_shape *rings = &self->rings;
    const ps_sphere_starts *starts = &self->starts;
    const ps_sphere_local local = ps_sphere_local_bytes(rings, sizeof(double));
    const double flops = ps_sphere_grid_table_flops(self->shape);
    const grid_table_numbers numbers = {.rings = ps_sphere_ring_numbers(rings, self->only_even),
                                        .num_angles = self->shape->num_angles,
                                        .angle_pitch = self->angle_pitch};
    const ps_range range = ps_range_alone(PS_SPHERE_GROUPS, flops);
    return PS_LAUNCH(
        self->device, self->make, &range, error, PS_STRUCT(numbers), PS_BUFFER(starts->starts),
        PS_BUFFER(starts->start_scales), PS_BUFFER(starts->steps), PS_BUFFER(starts->step_scales),
        PS_BUFFER(starts->ratios), PS_BUFFER(starts->cosines), PS_BUFFER(starts->distances),
        PS_BUFFER(starts->squares), PS_BUFFER(self->states), PS_BUFFER(self->scales),
        PS_BUFFER(self->diagonals), PS_BUFFER(self->diagonal_scales), PS_BUFFER(self->filters),
        PS_BUFFER(table->offsets), PS_BUFFER(table->numbers), PS_LOCAL(local.table),
        PS_LOCAL(local.coefficients), PS_LOCAL(local.begins));
}

static pspec_status find_begins(const ps_sphere_grid_table *table, const making *self,
                                ps_error *error) {
    const ps_sphere_shape *shape = self->shape;
    const ps_range range = ps_range_light(self->device, (size_t)shape->max_degree + 1, 2, 1,
                                          (double)shape->table_reals, 0);
    return PS_LAUNCH(self->device, self->begin, &range, error, PS_BUFFER(table->numbers),
                     PS_BUFFER(table->offsets), PS_BUFFER(table->begins), PS_U32(shape->most_runs),
                     PS_U32(shape->max_degree), PS_U32(shape->num_angles), PS_U32(self->only_even));
}

/* ---- all ---------------------------------------------------------------------------------- */

double ps_sphere_grid_table_flops(const ps_sphere_shape *shape) {
    const double flops_of_rings = 40; /* of a number of Lambda_lm */
    const double numbers = (double)shape->table_reals;
    const double rings = shape->num_rings;
    return numbers * 2 * rings + numbers / shape->num_angles * rings * flops_of_rings;
}

static void free_making(making *self) {
    PS_BUFFERS_RELEASE(&self->filters, &self->states, &self->scales, &self->diagonals,
                       &self->diagonal_scales);
    ps_sphere_starts_free(&self->starts);
}

static pspec_status make(ps_sphere_grid_table *table, making *self, ps_error *error) {
    PS_TRY(create_kernels(self, error));
    PS_TRY(ps_sphere_starts_create(&self->starts, &self->rings, self->device, error));
    PS_TRY(create_filters(self, error));
    PS_TRY(create_offsets(table, self, error));
    PS_TRY(create_begins(table, self, error));
    PS_TRY(create_buffers(table, self, error));
    PS_TRY(make_numbers(table, self, error));
    return find_begins(table, self, error);
}

/* Chooses the rings where Lambda_lm is made: all rings in one block if local memory has room for
 * them, as on CPUs, since numbers of the table are rounded once for each block. */
static ps_sphere_shape choose_rings(int32_t max_degree, const ps_device_limits *limits) {
    const ps_sphere_shape rings = ps_sphere_rings_shape(max_degree, limits, PS_DOUBLE);
    ps_sphere_shape whole = rings;
    whole.block = (uint32_t)ps_round_up(rings.num_rings, PS_SPHERE_RING_VECTORS * rings.lanes);
    return ps_sphere_rings_fit(&whole, limits, sizeof(double)) ? whole : rings;
}

pspec_status ps_sphere_grid_table_create(ps_sphere_grid_table *out, const ps_sphere_shape *shape,
                                         bool only_even, ps_precision precision, ps_device *device,
                                         ps_error *error) {
    making self = {.shape = shape,
                   .rings = choose_rings(shape->max_degree, ps_device_get_limits(device)),
                   .only_even = only_even,
                   .precision = precision,
                   .device = device,
                   .angle_pitch = (uint32_t)ps_round_up(shape->num_angles, PS_SPHERE_TABLE_ANGLES)};
    *out = (ps_sphere_grid_table){0};
    const pspec_status status = make(out, &self, error);
    free_making(&self);
    if (status != PSPEC_OK) {
        ps_sphere_grid_table_free(out);
    }
    return status;
}

void ps_sphere_grid_table_free(ps_sphere_grid_table *table) {
    PS_BUFFERS_RELEASE(&table->numbers, &table->offsets, &table->begins);
}

/* By rings: from points on the device to values on rings (kernels/sphere/nufft/orders.cl), and from
 * these to powers or coefficients (orders_sum.cl there, of a set alone orders_sum_one.cl). */
#include "engines/sphere/nufft/variants.h"

#include "base/round.h"
#include "device/reals.h"
#include "engines/nufft/fft.h"
#include "sphere/nufft/orders.h"

/* Bits of kernels/sphere/nufft/orders.cl. */
enum { STEP_SPREAD = 1, STEP_AROUND = 2, STEP_RINGS = 4 };

typedef struct rings {
    ps_sphere_ring_tables tables;
    ps_kernel *orders, *bands;        /* bands: of sorted points */
    ps_buffer rows;                   /* of orders.cl */
    ps_buffer staged, staged_heights; /* of orders_bands.cl */
    ps_buffer strip_turns, strip_weights, strips, strip_starts;
    ps_buffer states, scales, diagonals, diagonal_scales, sums; /* of orders_sum.cl */
} rings;

static rings *of(const ps_sphere_state *self) {
    return self->own;
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_kernels(ps_sphere_state *self, ps_error *error) {
    PS_TRY(ps_sphere_kernel_get(self, &of(self)->orders, "sphere_orders", error));
    return self->shape.is_sorted
               ? ps_sphere_kernel_get(self, &of(self)->bands, "sphere_orders_bands", error)
               : PSPEC_OK;
}

static pspec_status create(ps_sphere_state *self, ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const ps_sphere_bytes bytes = ps_sphere_bytes_of(shape, ps_real_bytes(self->precision));
    rings *const own = of(self);
    const ps_wanted_buffer wanted[] = {
        {&own->rows, bytes.rows, "tiles of orders"},
        {&own->strip_turns, bytes.strip_turns, "points of strips"},
        {&own->strip_weights, bytes.strip_weights, "weights of strips"},
        {&own->strips, bytes.strips, "strips of points"},
        {&own->strip_starts, bytes.strip_starts, "starts of strips"},
        {&own->staged, bytes.staged, "points of bands"},
        {&own->staged_heights, bytes.staged_heights, "weights of bands"},
        {&own->states, bytes.states, "states of rings"},
        {&own->scales, bytes.scales, "scales of rings"},
        {&own->diagonals, bytes.diagonals, "first degrees of rings"},
        {&own->diagonal_scales, bytes.diagonals / 2, "scales of first degrees"},
        {&own->sums, (shape->at_once + 1) * bytes.sums, "sums over rings"}};
    PS_TRY(ps_sphere_ring_tables_create(&own->tables, shape, self->precision, self->device, error));
    PS_TRY(create_kernels(self, error));
    return PS_BUFFERS_CREATE(self->device, wanted, error);
}

static void free_own(void *own) {
    rings *const self = own;
    PS_BUFFERS_RELEASE(&self->rows, &self->strip_turns, &self->strip_weights, &self->strips,
                       &self->states, &self->scales, &self->diagonals, &self->diagonal_scales,
                       &self->sums, &self->strip_starts, &self->staged, &self->staged_heights);
    ps_sphere_ring_tables_free(&self->tables);
}

/* ---- run --------------------------------------------------------------------------------- */

/* Some of the realizations whose points are on the device. */
typedef struct some_realizations {
    size_t first, end;
    size_t first_value; /* where values of the first of all of them go */
} some_realizations;

static orders_numbers numbers_of(const ps_sphere_state *self, some_realizations some,
                                 unsigned steps, size_t shares) {
    const ps_sphere_shape *shape = &self->shape;
    const ps_nufft_plan *plan = &self->tables.plan;
    return (orders_numbers){.most_points = shape->set_points,
                            .window = ps_nufft_window_numbers(plan),
                            .first_realization = (uint32_t)some.first,
                            .end_realization = (uint32_t)some.end,
                            .steps = steps,
                            .shares = (uint32_t)shares,
                            .L = (uint32_t)shape->max_degree,
                            .only_even = self->only_even,
                            .pitch = (uint32_t)shape->pitch,
                            .grid_rows = (uint32_t)shape->grid_rows,
                            .bands = (uint32_t)shape->bands,
                            .pole = (uint32_t)shape->pole,
                            .columns = (uint32_t)shape->columns,
                            .strip = (uint32_t)shape->strip,
                            .rings = (uint32_t)shape->rings,
                            .num_rings = (uint32_t)shape->num_rings,
                            .ring_pitch = (uint32_t)shape->ring_pitch,
                            .first_value = (uint32_t)some.first_value,
                            .value_sets = (uint32_t)shape->at_once};
}

/* Runs the steps for as many realizations at a time as there are slots. */
static pspec_status run_steps(ps_sphere_state *self, some_realizations some, unsigned steps,
                              size_t shares, ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const ps_sphere_tables *tables = &self->tables;
    const rings *own = of(self);
    const ps_sphere_local local = ps_sphere_local_bytes(shape, ps_real_bytes(self->precision));
    const orders_numbers numbers = numbers_of(self, some, steps, shares);
    const size_t num = some.end - some.first;
    const size_t slots = num < shape->slots ? num : shape->slots;
    const double transforms = (double)num * shape->pairs * 4.0 * shape->lanes;
    const ps_range range = ps_range_alone(slots * shares, transforms * ps_fft_flops(shape->axis.n));
    return PS_LAUNCH(self->device, own->orders, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(self->points.turns), PS_BUFFER(self->points.weights),
                     PS_BUFFER(self->points.offsets), PS_BUFFER(tables->plan.coefficients),
                     PS_FFT_TABLES(tables->halves), PS_FFT_TABLES(own->tables.transforms),
                     PS_BUFFER(own->tables.turns), PS_BUFFER(own->tables.ring_turns),
                     PS_BUFFER(tables->around_gains), PS_BUFFER(own->tables.along_gains),
                     PS_BUFFER(own->strip_turns), PS_BUFFER(own->strip_weights),
                     PS_BUFFER(own->strips), PS_BUFFER(own->strip_starts), PS_BUFFER(self->grids),
                     PS_BUFFER(own->rows), PS_BUFFER(self->values), PS_BUFFER(self->scratch),
                     PS_LOCAL(local.windows), PS_LOCAL(local.cells));
}

/* All steps in one go where there is a realization for every work-group; else slot by slot, each
 * shared. Strips are spread by who transforms them. */
static pspec_status make_values(ps_sphere_state *self, size_t first_value, const ps_batch *all_sets,
                                ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const size_t num = all_sets->num_patterns;
    PS_TRY(ps_sphere_places_make(&self->points, all_sets, error));
    if (shape->shares == 1) {
        const some_realizations all = {0, num, first_value};
        return run_steps(self, all, STEP_SPREAD | STEP_AROUND | STEP_RINGS, 1, error);
    }
    for (size_t first = 0; first < num; first += shape->slots) {
        const size_t end = num - first < shape->slots ? num : first + shape->slots;
        const some_realizations some = {first, end, first_value};
        if (ps_sphere_has_strips(shape)) {
            PS_TRY(run_steps(self, some, STEP_SPREAD | STEP_AROUND, shape->shares, error));
        } else {
            PS_TRY(run_steps(self, some, STEP_SPREAD, 1, error));
            PS_TRY(run_steps(self, some, STEP_AROUND, shape->shares, error));
        }
        PS_TRY(run_steps(self, some, STEP_RINGS, shape->shares, error));
    }
    return PSPEC_OK;
}

static pspec_status add_sorted(ps_sphere_state *self, bool is_first, ps_error *error) {
    const ps_sphere_shape *shape = &self->shape;
    const ps_sphere_places *points = &self->points;
    const ps_nufft_plan *plan = &self->tables.plan;
    const ps_sphere_local local = ps_sphere_local_bytes(shape, ps_real_bytes(self->precision));
    const double flops_per_point = 2000;
    const orders_bands_numbers numbers = {
        .part_points = PS_SPHERE_PART_POINTS,
        .window = ps_nufft_window_numbers(plan),
        .num_parts = (uint32_t)ps_divide_up(points->num_points, PS_SPHERE_PART_POINTS),
        .tiles = shape->tiles,
        .is_first = is_first,
        .bands = shape->bands,
        .band_rows = shape->band_rows,
        .pitch = shape->pitch,
        .has_weights = !points->has_unit_weights};
    const ps_range range =
        ps_range_alone(shape->bands, flops_per_point * (double)points->num_points);
    return PS_LAUNCH(
        self->device, of(self)->bands, &range, error, PS_STRUCT(numbers), PS_BUFFER(points->sorted),
        PS_BUFFER(points->heights), PS_BUFFER(points->starts), PS_BUFFER(plan->coefficients),
        PS_BUFFER(self->grids), PS_BUFFER(of(self)->staged), PS_BUFFER(of(self)->staged_heights),
        PS_LOCAL(local.windows), PS_LOCAL(local.cells));
}

/* Points of the only pattern, a chunk at a time. Once they are sorted, they may go. */
static pspec_status add_chunks(ps_sphere_state *self, const ps_batch *one, ps_error *error) {
    const size_t most = self->shape.most_points;
    const size_t num_points = one->patterns[0].num_points;
    for (size_t at = 0; at < num_points; at += most) {
        pspec_pattern part;
        const ps_batch some = ps_batch_chunk(one, at, most, &part);
        PS_TRY(ps_batch_go_on(one, error));
        PS_TRY(ps_sphere_places_make(&self->points, &some, error));
        PS_TRY(num_points - at <= most ? ps_sphere_places_return(&self->points, error) : PSPEC_OK);
        PS_TRY(add_sorted(self, at == 0, error));
    }
    return PSPEC_OK;
}

static pspec_status make_sorted(ps_sphere_state *self, size_t first_value, const ps_batch *one,
                                ps_error *error) {
    const size_t shares = self->shape.shares;
    const some_realizations whole = {0, 1, first_value};
    PS_TRY(ps_sphere_places_lend(&self->points, one->patterns, error));
    const pspec_status added = add_chunks(self, one, error);
    /* no longer lent unless something failed */
    const pspec_status returned =
        ps_sphere_places_return(&self->points, added == PSPEC_OK ? error : NULL);
    PS_TRY(added);
    PS_TRY(returned);
    PS_TRY(run_steps(self, whole, STEP_AROUND, shares, error));
    return run_steps(self, whole, STEP_RINGS, shares, error);
}

static pspec_status launch_sums(ps_sphere_state *self, ps_kernel *kernel, const ps_buffer *to,
                                size_t num, ps_error *error) {
    const rings *own = of(self);
    const ps_sphere_shape *shape = &self->shape;
    const ps_sphere_starts *starts = &own->tables.starts;
    const ps_sphere_local local = ps_sphere_local_bytes(shape, ps_real_bytes(self->precision));
    const double degrees = shape->max_degree;
    const double flops = 4 * degrees * degrees / 2 * shape->num_rings * (double)num;
    const ps_range range = ps_range_alone(PS_SPHERE_GROUPS, flops);
    const orders_sum_numbers numbers = {.rings = ps_sphere_ring_numbers(shape, self->only_even),
                                        .value_sets = (uint32_t)shape->at_once,
                                        .num_realizations = (uint32_t)num,
                                        .half_pitch = shape->half_pitch};
    return PS_LAUNCH(
        self->device, kernel, &range, error, PS_STRUCT(numbers), PS_BUFFER(self->values),
        PS_BUFFER(starts->starts), PS_BUFFER(starts->start_scales), PS_BUFFER(starts->steps),
        PS_BUFFER(starts->step_scales), PS_BUFFER(starts->ratios), PS_BUFFER(starts->cosines),
        PS_BUFFER(starts->distances), PS_BUFFER(starts->squares), PS_BUFFER(own->states),
        PS_BUFFER(own->scales), PS_BUFFER(own->diagonals), PS_BUFFER(own->diagonal_scales),
        PS_BUFFER(own->sums), PS_BUFFER(*to), PS_LOCAL(local.table), PS_LOCAL(local.coefficients),
        PS_LOCAL(local.begins));
}

/* ---- the rows ---------------------------------------------------------------------------- */

static void describe(const ps_sphere_state *self, ps_text *text) {
    const ps_sphere_shape *shape = &self->shape;
    ps_text_append(text, "rings=%lu at_once=%zu bands=%lu strip=%lu",
                   (unsigned long)shape->num_rings, shape->at_once, (unsigned long)shape->bands,
                   (unsigned long)shape->strip);
    if (shape->is_single_chain) {
        ps_text_append(text, " lambda=single");
    }
}

#define RINGS_ROW(MAKE_VALUES)                                                                     \
    {                                                                                              \
        .programs = 1, .program = "sphere/nufft/orders.cl", .own_bytes = sizeof(rings),            \
        .create = create, .free = free_own, .make_values = (MAKE_VALUES),                          \
        .sums = "sphere_orders_sum", .has_sums_one = true, .launch_sums = launch_sums,             \
        .describe = describe                                                                       \
    }

const ps_sphere_variant ps_sphere_rings = RINGS_ROW(make_values);
const ps_sphere_variant ps_sphere_sorted_rings = RINGS_ROW(make_sorted);

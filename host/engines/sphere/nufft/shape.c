#include "engines/sphere/nufft/shape.h"

#include "base/round.h"
#include "device/reals.h"
#include "engines/nufft/fft.h"
#include "engines/nufft/grid_axis.h"

#include <math.h>

/* ---- sizes ------------------------------------------------------------------------------- */

/* Rings of a block of the table: 24 KiB for each parity of l - m, what the nearest cache holds. */
static const size_t block_bytes = 24 << 10;

static uint32_t choose_block(const ps_sphere_shape *shape, size_t real_bytes) {
    const uint32_t unit = PS_SPHERE_RING_VECTORS * shape->lanes;
    const size_t row = (size_t)shape->run_vectors * shape->lanes * real_bytes;
    const uint64_t most = block_bytes / row / unit;
    const uint64_t chunks = ps_divide_up(shape->num_rings, unit);
    const uint64_t blocks = ps_divide_up(chunks, most > 0 ? most : 1);
    return (uint32_t)ps_divide_up(chunks, blocks) * unit;
}

/* Sums of two realizations, real and imaginary parts of each vector of degrees, stay in 16
 * registers when there are two, in 32 when there are four. With three in 16 they went through
 * memory: 1.1 to 1.2 times the time of all at L = 2000, R = 10 (Zen 3, PoCL 3.1). */
static uint32_t choose_run_vectors(const ps_sphere_shape *shape, size_t real_bytes) {
    const size_t bytes_of_32 = 64; /* of a vector: AVX-512 */
    return shape->lanes * real_bytes >= bytes_of_32 ? 4 : 2;
}

/* Bytes of a band of longitudes: with the tiles that its points are sorted by, the second cache
 * holds what they touch. */
static const size_t band_bytes = 384 << 10;

/* Windows behind a band end in the next one. */
enum { LEAST_BAND = PS_NUFFT_MAX_WIDTH };

/* Enough for all cores; of more, rows behind bands would be most of the grid. */
enum { MOST_BANDS = 64 };

/* A set has bands where its windows cover every cell a few times. Not measured near the limit:
 * 1e7 points on 4096 x 2100 cells, which cover each 170 times, took a third of the time of one core
 * and cells in any order (Zen 3, PoCL 3.1). */
static const double least_covers = 2;

static void choose_bands(ps_sphere_shape *shape, double points, size_t real_bytes) {
    const double width = shape->axis.window.width;
    const double n = shape->axis.n;
    const size_t fitting = band_bytes / (shape->pitch * real_bytes);
    const uint32_t in_cache = fitting > LEAST_BAND + shape->axis.window.width
                                  ? (uint32_t)fitting - shape->axis.window.width
                                  : LEAST_BAND;
    const uint32_t of_many = shape->axis.n / MOST_BANDS;
    const uint32_t least = in_cache > of_many ? in_cache : of_many;
    shape->is_sorted =
        points >= PS_SPHERE_LEAST_SORTED && points * width * width > least_covers * n * n / 2;
    shape->bands = shape->is_sorted && least < shape->axis.n ? shape->axis.n / least : 1;
    shape->band_rows =
        (uint32_t)ps_divide_up(shape->axis.n, shape->bands) + shape->axis.window.width;
    shape->tiles = shape->pitch / PS_SPHERE_TILE_CELLS + 1;
}

/* Bytes of a strip: the second cache of a core holds it, beside what is transformed. */
static const size_t strip_bytes = 384 << 10;

static void choose_strip(ps_sphere_shape *shape, size_t real_bytes) {
    const uint32_t lanes = shape->lanes;
    const uint64_t rows = (uint64_t)shape->axis.n + shape->axis.window.width;
    const uint64_t behind = ps_round_up(ps_nufft_bins(&shape->axis), lanes);
    const uint64_t fitting = strip_bytes / (rows * real_bytes);
    const uint64_t strip =
        fitting > behind + 2 * lanes ? (fitting - behind) / lanes * lanes : 2 * (uint64_t)lanes;
    const bool is_small = rows * shape->pitch * real_bytes <= strip_bytes;
    if (!shape->is_sorted && !is_small && strip < shape->columns) {
        shape->strip = (uint32_t)strip;
        shape->pitch = (uint32_t)(strip + behind);
    }
}

/* A grid as a whole, in groups of `unit` columns. */
static void measure_grid(ps_sphere_shape *shape, uint32_t unit) {
    const ps_nufft_axis *axis = &shape->axis;
    const uint32_t bins = ps_nufft_bins(axis);
    shape->pole = (axis->window.width + 1) / 2;
    const uint32_t with_cells = axis->n / 2 + 2 * shape->pole + 1;
    const uint32_t touched = axis->n / 2 + shape->pole + bins + 2;
    shape->columns = (uint32_t)ps_round_up(with_cells, unit);
    shape->pitch = (uint32_t)ps_round_up(touched > shape->columns ? touched : shape->columns, unit);
    shape->pairs = (uint32_t)shape->max_degree / unit + 1;
    shape->strip = shape->columns;
    shape->bands = 1;
    shape->band_rows = axis->n + axis->window.width;
}

/* Rings at the pole and at the equator whose Lambda_lm goes by differences. The rest is off by
 * 6e-13 of the first ring and by 6e-14 of the 16th at L = 2000, and by 1e-13 of the 8th from the
 * equator; the error formula allows 3e-13 for all together. */
enum { POLAR_RINGS = 16, EQUATORIAL_RINGS = 12 };

/* In units of rings. */
static void choose_recurrences(ps_sphere_shape *shape, uint32_t unit) {
    const uint32_t num = shape->ring_lead + shape->num_rings;
    const uint32_t last = num > EQUATORIAL_RINGS ? num - EQUATORIAL_RINGS : 0;
    shape->polar = (uint32_t)ps_round_up(shape->ring_lead + POLAR_RINGS, unit);
    shape->crossing = (shape->ring_lead + shape->num_rings / 2) / unit * unit;
    shape->equatorial = last / unit * unit;
}

static void measure_rings_in_memory(ps_sphere_shape *shape, size_t real_bytes) {
    enum { LARGEST_UNIT = 48 };
    shape->ring_pitch =
        (uint32_t)ps_round_up((uint64_t)shape->ring_lead + shape->num_rings, LARGEST_UNIT);
    shape->value_bytes =
        4 * (uint64_t)shape->ring_pitch * ((size_t)shape->max_degree + 1) * real_bytes;
}

static void measure_sums(ps_sphere_shape *shape, size_t real_bytes) {
    enum { LARGEST_LANES = 16 };
    measure_rings_in_memory(shape, real_bytes);
    shape->block = choose_block(shape, real_bytes);
    shape->half_pitch = (uint32_t)ps_round_up(
        (uint64_t)shape->max_degree / 2 + 1 + shape->run_vectors * shape->lanes, LARGEST_LANES);
}

/* Measures the table as kernels/sphere/grid/table.h lays it out. */
static void measure_table(ps_sphere_shape *shape, size_t real_bytes) {
    const uint64_t num_orders = (uint64_t)shape->max_degree + 1;
    uint64_t vectors = 0;
    for (uint64_t m = 0; m < num_orders; m++) {
        for (uint64_t odd = 0; odd < 2 && m + odd < num_orders; odd++) {
            vectors += ps_divide_up((num_orders - m - odd + 1) / 2, shape->lanes);
        }
    }
    shape->num_angles = (shape->axis.n / 2 + 1) / 2;
    shape->table_reals = vectors * shape->num_angles * shape->lanes;
    shape->most_runs = (uint32_t)ps_divide_up(ps_divide_up((num_orders + 1) / 2, shape->lanes),
                                              shape->run_vectors);
    shape->value_bytes = 4 * ps_round_up(shape->num_angles, shape->lanes) * num_orders * real_bytes;
}

/* Whether the tolerance has room for Lambda_lm in single precision. */
static bool chain_is_exact(const ps_sphere_shape *shape, const ps_problem *problem) {
    const double power = ps_expected_power(problem);
    const double rest =
        ps_sphere_nufft_error(&shape->axis, problem, PS_SINGLE, power, PS_SPHERE_BY_RINGS);
    return hypot(rest, ps_sphere_chain_error(&shape->axis, problem, power)) <= problem->tolerance;
}

/* A realization alone needs no table that others would share. Not a set that comes in blocks, after
 * which nobody knows whether others follow. */
static void choose_sums(ps_sphere_shape *shape, const ps_problem *problem,
                        const ps_device_limits *limits, size_t real_bytes) {
    const unsigned lanes = ps_engine_lanes(limits, PS_DOUBLE);
    if (problem->num_realizations == 1 && problem->block_points == 0) {
        shape->is_one_set = true;
        shape->sum_lanes = lanes;
        shape->is_single_chain = real_bytes == sizeof(float) && chain_is_exact(shape, problem);
        const uint32_t vectors = ps_sphere_one_vectors(shape);
        const uint32_t unit = vectors * lanes * (shape->is_single_chain ? 2 : 1);
        shape->ring_lead = (unit - shape->num_rings % unit) % unit;
        measure_rings_in_memory(shape, real_bytes);
        choose_recurrences(shape, unit);
    }
}

/* Of orders_sum_one.cl the table has sums of each degree of a run, real and imaginary. */
static size_t table_bytes(const ps_sphere_shape *shape, size_t run, size_t real_bytes) {
    return shape->is_one_set ? run * 2 * shape->sum_lanes * sizeof(double)
                             : shape->block * run * real_bytes;
}

ps_sphere_local ps_sphere_local_bytes(const ps_sphere_shape *shape, size_t real_bytes) {
    const unsigned lanes = shape->is_one_set ? shape->sum_lanes : shape->lanes;
    const size_t run =
        2 * (size_t)(shape->is_one_set ? PS_SPHERE_ONE_RUN : shape->run_vectors) * lanes;
    const size_t bins = ps_nufft_bins(&shape->axis);
    return (ps_sphere_local){
        .windows = PS_NUFFT_CHUNK * (2 * bins + 3) * real_bytes,
        .cells = 2 * PS_NUFFT_CHUNK * sizeof(uint32_t),
        .table = table_bytes(shape, run, real_bytes),
        .coefficients = (PS_SPHERE_COEFFICIENTS * run + PS_SPHERE_CHAIN_AHEAD) * sizeof(double),
        .begins = shape->block / shape->lanes * sizeof(uint32_t)};
}

static bool spreading_fits(const ps_sphere_shape *shape, const ps_device_limits *limits,
                           size_t real_bytes) {
    const ps_sphere_local local = ps_sphere_local_bytes(shape, real_bytes);
    return local.windows + local.cells <= limits->local_bytes;
}

bool ps_sphere_rings_fit(const ps_sphere_shape *shape, const ps_device_limits *limits,
                         size_t real_bytes) {
    const ps_sphere_local local = ps_sphere_local_bytes(shape, real_bytes);
    return local.table + local.coefficients + local.begins <= limits->local_bytes;
}

/* ---- the routes -------------------------------------------------------------------------- */

static bool measure_rings(ps_sphere_shape *shape, const ps_device_limits *limits,
                          const ps_problem *problem, size_t real_bytes) {
    const uint32_t unit = 2 * shape->lanes;
    const double points = ps_planned_points(problem);
    measure_grid(shape, unit);
    choose_sums(shape, problem, limits, real_bytes);
    choose_bands(shape, points, real_bytes);
    choose_strip(shape, real_bytes);
    shape->grid_rows = shape->bands * shape->band_rows;
    shape->transform_rings = shape->rings;
    shape->half_poles = 2 * shape->pole;
    shape->grid_bytes = (uint64_t)shape->grid_rows * shape->pitch * real_bytes;
    shape->row_bytes = 2 * (uint64_t)shape->pairs * shape->columns * unit * real_bytes;
    return ps_sphere_rings_fit(shape, limits, real_bytes) &&
           spreading_fits(shape, limits, real_bytes);
}

/* The table is made of rings in double precision. */
static bool measure_cells(ps_sphere_shape *shape, const ps_device_limits *limits,
                          const ps_problem *problem, size_t real_bytes) {
    const ps_sphere_shape rings = ps_sphere_rings_shape(shape->max_degree, limits, PS_DOUBLE);
    const bool is_whole =
        shape->lanes % rings.lanes == 0 && rings.run_vectors * rings.lanes % shape->lanes == 0;
    (void)problem;
    measure_grid(shape, shape->lanes);
    measure_table(shape, real_bytes);
    shape->grid_rows = shape->band_rows;
    shape->half_poles = 2 * shape->pole - 1;
    shape->grid_bytes = ((uint64_t)shape->grid_rows * shape->pitch + 2 * shape->lanes) * real_bytes;
    return is_whole && ps_sphere_rings_fit(&rings, limits, sizeof(double)) &&
           spreading_fits(shape, limits, real_bytes);
}

/* On GPUs torus_nufft measures the grid, once it is known of how many sets (memory.c). */
static bool measure_on_gpu(ps_sphere_shape *shape, const ps_device_limits *limits,
                           const ps_problem *problem, size_t real_bytes) {
    const uint64_t lines = 2 * ((uint64_t)shape->max_degree + 1);
    const uint32_t most = shape->rings; /* lengths up to twice as long are tried */
    uint32_t half = shape->rings / 2;
    bool fits = ps_nufft_pass_measure(&shape->ring_pass, half, lines, limits, real_bytes);
    while (!fits && half < most) {
        half = ps_fft_length((uint64_t)half + 1);
        fits = ps_nufft_pass_measure(&shape->ring_pass, half, lines, limits, real_bytes);
    }
    shape->rings = 2 * half;
    shape->num_rings = shape->rings / 4 + 1;
    measure_rings_in_memory(shape, real_bytes);
    shape->degrees = ps_sphere_degrees_measure(problem->num_realizations == 1, limits, real_bytes);
    return fits && shape->degrees.rings > 0;
}

/* Each returns false where local memory is too small. */
static bool (*const measures[])(ps_sphere_shape *, const ps_device_limits *, const ps_problem *,
                                size_t real_bytes) = {[PS_SPHERE_BY_RINGS] = measure_rings,
                                                      [PS_SPHERE_BY_CELLS] = measure_cells,
                                                      [PS_SPHERE_ON_GPU] = measure_on_gpu};

ps_sphere_shape ps_sphere_rings_shape(int32_t max_degree, const ps_device_limits *limits,
                                      ps_precision precision) {
    const size_t real_bytes = ps_real_bytes(precision);
    const unsigned lanes = ps_engine_lanes(limits, precision);
    ps_sphere_shape shape = {.max_degree = max_degree, .lanes = lanes > 1 ? lanes : 2};
    shape.rings = ps_sphere_ring_length(shape.max_degree);
    shape.num_rings = shape.rings / 4 + 1;
    shape.run_vectors = choose_run_vectors(&shape, real_bytes);
    measure_sums(&shape, real_bytes);
    choose_recurrences(&shape, (precision == PS_DOUBLE ? PS_SPHERE_RING_VECTORS : 1) * shape.lanes);
    return shape;
}

ps_sphere_shape ps_sphere_shape_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision, ps_sphere_route route) {
    const size_t real_bytes = ps_real_bytes(precision);
    const ps_nufft_axis axis = ps_sphere_choose_axis(problem, precision, route);
    if (axis.n == 0) {
        return (ps_sphere_shape){0};
    }
    ps_sphere_shape shape =
        ps_sphere_rings_shape(problem->frequencies->max_frequency, limits, precision);
    shape.axis = axis;
    shape.route = route;
    if (!measures[route](&shape, limits, problem, real_bytes)) {
        shape.lanes = 0;
        return shape;
    }
    ps_sphere_count_memory(&shape, problem, limits, real_bytes);
    return shape;
}

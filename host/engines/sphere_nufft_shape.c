#include "engines/sphere_nufft_shape.h"

#include "base/round.h"
#include "engines/nufft_fft.h"
#include "engines/nufft_kernels.h"
#include "engines/nufft_plan.h"
#include "engines/reals.h"

#include <math.h>

/* Fine grids from sigma = n / 2L on, as in nufft_choice.c. */
static const double least_sigma = 1.2;
static const double largest_sigma = 4;

/* Windows in front of a pole and behind it must not meet. */
enum { LEAST_CELLS = 4 * PS_NUFFT_MAX_WIDTH };

/* A grid of all cells has 32-bit indices. */
enum { MOST_CELLS = 1 << 16 };

/* Of candidates, each longer than the one before by this part at least. */
enum { NEXT_LENGTH = 32 };

/* ---- grid and rings ---------------------------------------------------------------------- */

/* The cheapest even length from `least` on; 0: beyond 32 bits. */
static uint32_t even_length(uint64_t least) {
    return 2 * ps_fft_good_length((least + 1) / 2);
}

static uint32_t ring_length(int32_t max_degree) {
    uint32_t half = ps_fft_length((uint64_t)max_degree + 1);
    return 2 * half;
}

static ps_nufft_axis make_axis(int32_t max_degree, uint32_t n, unsigned width) {
    ps_nufft_axis axis = {.factor = 1, .max_frequency = max_degree, .n = n};
    uint32_t radices[PS_FFT_MAX_PASSES];
    axis.window = ps_nufft_window_make(width, max_degree, n);
    axis.loss = ps_nufft_window_loss(&axis.window, max_degree, n);
    ps_sphere_nufft_loss(&axis, &axis.loss.aliasing, &axis.loss.worst);
    ps_fft_radices(n, radices);
    while (radices[axis.passes] != 0) {
        axis.passes++;
    }
    return axis;
}

/* Of a length: the narrowest window that keeps the tolerance, else the most exact one. */
static ps_nufft_axis choose_width(const ps_problem *problem, uint32_t n, ps_precision precision,
                                  double *least_error) {
    ps_nufft_axis best = {0};
    *least_error = HUGE_VAL;
    for (unsigned width = PS_NUFFT_MIN_WIDTH;
         width <= PS_NUFFT_MAX_WIDTH && *least_error > problem->tolerance; width++) {
        const ps_nufft_axis axis = make_axis(problem->frequencies->max_frequency, n, width);
        const double error =
            ps_sphere_nufft_error(&axis, problem, precision, ps_expected_power(problem));
        if (error < *least_error) {
            best = axis;
            *least_error = error;
        }
    }
    return best;
}

/* Cycles on a core, of what depends on the grid (Zen 5, PoCL 3.1, 2026-11, steps of kernels/sphere/orders.cl left
 * out in turn, N = 1024 L = 128 and N = 4096 L = 256); spreading as in nufft_whole_shape.c, and two arc tangents. */
static double grid_cycles(const ps_nufft_axis *axis, ps_precision precision, double num_points) {
    const double cycles_per_point = 16;
    const double cycles_per_row = 2.4;
    const double cycles_per_polynomial = 0.6;
    const double cycles_per_turned = 14; /* of a vector of cells, into tiles of two parities */
    const double cycles_per_cell = 5;
    const double cycles_per_meridian_cell =
        20; /* fetched from two tiles, taken to the other transform */
    const double lanes = ps_nufft_nominal_lanes(precision);
    const double width = axis->window.width;
    const double bins = ps_nufft_bins(axis);
    const double n = axis->n;
    const double groups = ceil((n / 2 + width + 1) / (2 * lanes));
    const double pairs = floor(axis->max_frequency / (2 * lanes)) + 1;
    const double spread =
        num_points * (cycles_per_point + cycles_per_polynomial * 2 * (width + 2) * bins / lanes +
                      cycles_per_row * width * ceil(bins / lanes));
    const double around = groups * (ps_fft_cycles(axis->n) + cycles_per_cell * n +
                                    pairs * 2 * 2 * lanes * cycles_per_turned);
    return spread + around + pairs * (ps_fft_cycles(axis->n) + cycles_per_meridian_cell * n) +
           n * n / 2 / lanes;
}

static ps_nufft_axis choose_axis(const ps_problem *problem, ps_precision precision) {
    const double twice = 2.0 * problem->frequencies->max_frequency;
    const double points = ps_nufft_points(problem);
    const uint64_t last = (uint64_t)fmax(LEAST_CELLS, largest_sigma * twice);
    ps_nufft_axis best = {0};
    double best_error = HUGE_VAL;
    double best_cycles = HUGE_VAL;
    for (uint32_t n = even_length((uint64_t)fmax(LEAST_CELLS, ceil(least_sigma * twice + 1)));
         n != 0 && n <= MOST_CELLS && (best.n == 0 || n <= last);
         n = even_length((uint64_t)n + 1 + n / NEXT_LENGTH)) {
        double error = 0;
        const ps_nufft_axis axis = choose_width(problem, n, precision, &error);
        const double cycles = grid_cycles(&axis, precision, points);
        const bool is_enough = error <= problem->tolerance;
        const bool was_enough = best_error <= problem->tolerance;
        if (best.n == 0 ||
            (was_enough ? is_enough && cycles < best_cycles : is_enough || error < best_error)) {
            best = axis;
            best_error = error;
            best_cycles = cycles;
        }
    }
    return best;
}

/* ---- sizes ------------------------------------------------------------------------------- */

/* Rings of a block of the table: 32 KiB for each parity of l - m, what the nearest cache holds. */
static const size_t block_bytes = 24 << 10;

static uint32_t choose_block(const ps_sphere_shape *shape, size_t real_bytes) {
    const size_t row = PS_SPHERE_RUN_VECTORS * shape->sum_lanes * real_bytes;
    const uint64_t most = block_bytes / row / shape->sum_lanes;
    const uint64_t chunks = shape->ring_pitch / shape->sum_lanes;
    const uint64_t blocks = ps_divide_up(chunks, most > 0 ? most : 1);
    return (uint32_t)ps_divide_up(chunks, blocks) * shape->sum_lanes;
}

static void measure(ps_sphere_shape *shape, size_t real_bytes) {
    const ps_nufft_axis *axis = &shape->axis;
    const uint32_t unit = 2 * shape->lanes;
    const uint32_t bins = ps_nufft_bins(axis);
    shape->pole = (axis->window.width + 1) / 2;
    const uint32_t with_cells = axis->n / 2 + 2 * shape->pole + 1;
    const uint32_t touched = axis->n / 2 + shape->pole + bins + 2;
    shape->columns = (uint32_t)ps_round_up(with_cells, unit);
    shape->pitch = (uint32_t)ps_round_up(touched > shape->columns ? touched : shape->columns, unit);
    shape->grid_rows = axis->n + axis->window.width;
    shape->pairs = (uint32_t)shape->max_degree / unit + 1;
    shape->slot_bytes = ((uint64_t)shape->grid_rows * shape->pitch +
                         2 * (uint64_t)shape->pairs * shape->columns * unit) *
                        real_bytes;
}

static void measure_sums(ps_sphere_shape *shape, size_t real_bytes) {
    enum { LARGEST_LANES = 16 };
    shape->ring_pitch = (uint32_t)ps_round_up(shape->num_rings, LARGEST_LANES);
    shape->block = choose_block(shape, real_bytes);
    shape->half_pitch = (uint32_t)ps_round_up((uint64_t)shape->max_degree / 2 + 1 +
                                                  PS_SPHERE_RUN_VECTORS * shape->sum_lanes,
                                              LARGEST_LANES);
    shape->value_bytes =
        4 * (uint64_t)shape->ring_pitch * ((size_t)shape->max_degree + 1) * real_bytes;
}

ps_sphere_local ps_sphere_local_bytes(const ps_sphere_shape *shape, size_t real_bytes) {
    const size_t cell = 2 * (size_t)shape->lanes * real_bytes;
    const size_t run = 2 * (size_t)PS_SPHERE_RUN_VECTORS * shape->sum_lanes;
    const size_t bins = ps_nufft_bins(&shape->axis);
    return (ps_sphere_local){.data = shape->axis.n * cell,
                             .spectrum = shape->rings * cell,
                             .windows = PS_NUFFT_CHUNK * (2 * bins + 3) * real_bytes,
                             .cells = 2 * PS_NUFFT_CHUNK * sizeof(uint32_t),
                             .table = shape->block * run * real_bytes,
                             .coefficients = 3 * run * sizeof(double),
                             .begins = shape->block / shape->sum_lanes * sizeof(uint32_t)};
}

static bool fits(const ps_sphere_shape *shape, const ps_device_limits *limits, size_t real_bytes) {
    const ps_sphere_local local = ps_sphere_local_bytes(shape, real_bytes);
    return local.data + local.spectrum + local.windows + local.cells <= limits->local_bytes &&
           local.table + local.coefficients + local.begins <= limits->local_bytes;
}

/* ---- memory ------------------------------------------------------------------------------ */

/* Values on rings of so many realizations share one table of Lambda_lm: more of them cost no less. */
enum { MOST_AT_ONCE = 64 };

/* Bytes for all points, all values on rings, and all grids, unless one needs more. */
static const double point_budget = 128 << 20;
static const double value_budget = 128 << 20;
static const double grid_budget = 256 << 20;

/* Work-groups for each core: so few that grids stay in the cache, so many that no core waits long for another. */
enum { GROUPS_PER_CORE = 4 };

static size_t fitting(double budget, uint64_t bytes, size_t most) {
    const double number = floor(budget / (double)bytes);
    return number >= (double)most ? most : number > 1 ? (size_t)number : 1;
}

static void count_memory(ps_sphere_shape *shape, const ps_problem *problem,
                         const ps_device_limits *limits, size_t real_bytes) {
    const size_t cores = limits->compute_units > 0 ? limits->compute_units : 1;
    const uint64_t known = problem->num_realizations;
    const size_t most = known > 0 && known < MOST_AT_ONCE ? (size_t)known : MOST_AT_ONCE;
    const size_t groups = PS_SPHERE_GROUPS;
    const uint64_t set_bytes =
        problem->num_points * (3 * sizeof(double) + 2 * sizeof(uint64_t) + real_bytes);
    shape->at_once = fitting(value_budget, shape->value_bytes,
                             fitting(point_budget, set_bytes > 0 ? set_bytes : 1, most));
    shape->slots = fitting(grid_budget, shape->slot_bytes,
                           shape->at_once < GROUPS_PER_CORE * cores ? shape->at_once
                                                                    : GROUPS_PER_CORE * cores);
    shape->shares = shape->slots < GROUPS_PER_CORE * cores
                        ? ps_divide_up(GROUPS_PER_CORE * cores, shape->slots)
                        : 1;
    const uint64_t points = shape->at_once * problem->num_points;
    const uint64_t scratch =
        groups * shape->ring_pitch * (4 * sizeof(double) + 3 * sizeof(int32_t));
    const uint64_t powers = groups * shape->at_once * 2 * shape->half_pitch * sizeof(double);
    const uint64_t sums =
        groups * (shape->at_once + 1) * 4 * PS_SPHERE_RUN_VECTORS * shape->sum_lanes * real_bytes;
    const uint64_t values = shape->at_once * shape->value_bytes;
    shape->host_bytes =
        points * real_bytes + shape->at_once * 2 * shape->half_pitch * sizeof(double);
    shape->fixed_bytes = shape->host_bytes + shape->slots * shape->slot_bytes + values + scratch +
                         powers + sums + points * (5 * sizeof(double) + real_bytes);
    const uint64_t buffers[] = {shape->slots * shape->slot_bytes, values, powers,
                                points * 3 * sizeof(double)};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++) {
        shape->largest_buffer =
            buffers[i] > shape->largest_buffer ? buffers[i] : shape->largest_buffer;
    }
}

ps_sphere_shape ps_sphere_shape_make(const ps_problem *problem, const ps_device_limits *limits,
                                     ps_precision precision) {
    const size_t real_bytes = ps_real_bytes(precision);
    const unsigned lanes = ps_engine_lanes(limits, precision);
    ps_sphere_shape shape = {.max_degree = problem->frequencies->max_frequency,
                             .axis = choose_axis(problem, precision),
                             .lanes = lanes > 1 ? lanes : 2};
    shape.sum_lanes = shape.lanes;
    if (shape.axis.n == 0) {
        shape.lanes = 0;
        return shape;
    }
    shape.rings = ring_length(shape.max_degree);
    shape.num_rings = shape.rings / 4 + 1;
    measure_sums(&shape, real_bytes);
    measure(&shape, real_bytes);
    while (shape.lanes > 1 && !fits(&shape, limits, real_bytes)) {
        shape.lanes /= 2;
        measure(&shape, real_bytes);
    }
    if (shape.lanes < 2) {
        shape.lanes = 0;
        return shape;
    }
    count_memory(&shape, problem, limits, real_bytes);
    return shape;
}

/* ---- cost -------------------------------------------------------------------------------- */

double ps_sphere_nufft_flops(const ps_sphere_shape *shape, ps_precision precision,
                             double num_points, double num_realizations) {
    const double flops_per_lane = 4;    /* two fused operations in a cycle */
    const double cycles_of_table = 14;  /* of a vector of Lambda_lm */
    const double cycles_of_product = 2; /* of it and one realization */
    const double cycles_per_ring =
        12; /* of a value on a circle, on its way to rings of both hemispheres */
    const double cycles_per_order = 250; /* whatever the degrees */
    const double share = 0.7;            /* of rings where Lambda_lm is more than zero */
    const double lanes = ps_nufft_nominal_lanes(precision);
    const double L = shape->max_degree;
    const double vectors = (L + 1) * (L / 2 + lanes) / lanes * shape->num_rings * share;
    const double sharing = fmax(1, fmin(num_realizations, (double)shape->at_once));
    const double rings = shape->pairs * (double)shape->lanes / lanes *
                         (ps_fft_cycles(shape->rings) + cycles_per_ring * shape->rings);
    const double cycles = grid_cycles(&shape->axis, precision, num_points) + rings +
                          vectors * (cycles_of_table / sharing + cycles_of_product) +
                          cycles_per_order * (L + 1);
    return cycles * lanes * flops_per_lane;
}

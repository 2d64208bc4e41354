#include "engines/sphere/nufft/shape.h"

#include "base/round.h"
#include "device/reals.h"
#include "engines/nufft/fft.h"
#include "engines/nufft/kernels.h"
#include "engines/nufft/plan.h"

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
static uint32_t choose_run_vectors(const ps_sphere_shape *shape, const ps_device_limits *limits,
                                   size_t real_bytes) {
    const size_t bytes_of_32 = 64; /* of a vector: AVX-512 */
    return limits->has_dedicated_local_memory || shape->lanes * real_bytes >= bytes_of_32 ? 4 : 2;
}

/* Bytes of a band of longitudes: with the tiles that its points are sorted by, the second cache
 * holds what they touch. */
static const size_t band_bytes = 384 << 10;

/* Windows behind a band end in the next one. */
enum { LEAST_BAND = PS_NUFFT_MAX_WIDTH };

/* A set has bands where its windows cover every cell a few times. Not measured near the limit:
 * 1e7 points on 4096 x 2100 cells, which cover each 170 times, took a third of the time of one core
 * and cells in any order (Zen 3, PoCL 3.1). */
static const double least_covers = 2;

static void choose_bands(ps_sphere_shape *shape, double points, size_t real_bytes) {
    const double width = shape->axis.window.width;
    const double n = shape->axis.n;
    const size_t fitting = band_bytes / (shape->pitch * real_bytes);
    const uint32_t least = fitting > LEAST_BAND + shape->axis.window.width
                               ? (uint32_t)fitting - shape->axis.window.width
                               : LEAST_BAND;
    shape->is_sorted = shape->route == PS_SPHERE_BY_RINGS && points >= PS_SPHERE_LEAST_SORTED &&
                       points * width * width > least_covers * n * n / 2;
    shape->bands = shape->is_sorted && least < shape->axis.n ? shape->axis.n / least : 1;
    shape->band_rows =
        (uint32_t)ps_divide_up(shape->axis.n, shape->bands) + shape->axis.window.width;
    shape->tiles = shape->pitch / PS_SPHERE_TILE_CELLS + 1;
    shape->grid_rows = shape->bands * shape->band_rows;
}

/* Bytes of a strip: the second cache of a core holds it, beside what is transformed. */
static const size_t strip_bytes = 384 << 10;

/* Not where a realization has many work-items, which would wait for the one that sorts. */
static void choose_strip(ps_sphere_shape *shape, const ps_device_limits *limits,
                         size_t real_bytes) {
    const uint32_t lanes = shape->lanes;
    const uint64_t rows = (uint64_t)shape->axis.n + shape->axis.window.width;
    const uint64_t behind = ps_round_up(ps_nufft_bins(&shape->axis), lanes);
    const uint64_t fitting = strip_bytes / (rows * real_bytes);
    const uint64_t strip =
        fitting > behind + 2 * lanes ? (fitting - behind) / lanes * lanes : 2 * (uint64_t)lanes;
    const bool is_small = rows * shape->pitch * real_bytes <= strip_bytes;
    shape->strip = shape->columns;
    if (shape->route == PS_SPHERE_BY_RINGS && !shape->is_sorted && !is_small &&
        !limits->has_dedicated_local_memory && strip < shape->columns) {
        shape->strip = (uint32_t)strip;
        shape->pitch = (uint32_t)(strip + behind);
    }
}

static void measure(ps_sphere_shape *shape, const ps_device_limits *limits, double points,
                    size_t real_bytes) {
    const ps_nufft_axis *axis = &shape->axis;
    const bool by_rings = shape->route == PS_SPHERE_BY_RINGS;
    const uint32_t unit = by_rings ? 2 * shape->lanes : shape->lanes;
    const uint32_t bins = ps_nufft_bins(axis);
    shape->pole = (axis->window.width + 1) / 2;
    const uint32_t with_cells = axis->n / 2 + 2 * shape->pole + 1;
    const uint32_t touched = axis->n / 2 + shape->pole + bins + 2;
    shape->columns = (uint32_t)ps_round_up(with_cells, unit);
    shape->pitch = (uint32_t)ps_round_up(touched > shape->columns ? touched : shape->columns, unit);
    choose_bands(shape, points, real_bytes);
    shape->pairs = (uint32_t)shape->max_degree / unit + 1;
    choose_strip(shape, limits, real_bytes);
    shape->grid_bytes =
        ((uint64_t)shape->grid_rows * shape->pitch + (by_rings ? 0 : 2 * shape->lanes)) *
        real_bytes;
    shape->row_bytes =
        by_rings ? 2 * (uint64_t)shape->pairs * shape->columns * unit * real_bytes : 0;
}

/* Rings at the pole and at the equator whose Lambda_lm goes by differences. The rest is off by
 * 6e-13 of the first ring and by 6e-14 of the 16th at L = 2000, and by 1e-13 of the 8th from the
 * equator; the error formula allows 3e-13 for all together. */
enum { POLAR_RINGS = 16, EQUATORIAL_RINGS = 12 };

static void choose_recurrences(ps_sphere_shape *shape, ps_precision precision) {
    const uint32_t unit = (precision == PS_DOUBLE ? PS_SPHERE_RING_VECTORS : 1) * shape->lanes;
    const uint32_t last =
        shape->num_rings > EQUATORIAL_RINGS ? shape->num_rings - EQUATORIAL_RINGS : 0;
    shape->polar = (uint32_t)ps_round_up(POLAR_RINGS, unit);
    shape->crossing = shape->num_rings / 2 / unit * unit;
    shape->equatorial = last / unit * unit;
}

static void measure_sums(ps_sphere_shape *shape, size_t real_bytes) {
    enum { LARGEST_LANES = 16 };
    const uint32_t ring_unit = PS_SPHERE_RING_VECTORS * LARGEST_LANES;
    shape->ring_pitch = (uint32_t)ps_round_up(shape->num_rings, ring_unit);
    shape->block = choose_block(shape, real_bytes);
    shape->half_pitch = (uint32_t)ps_round_up(
        (uint64_t)shape->max_degree / 2 + 1 + shape->run_vectors * shape->lanes, LARGEST_LANES);
    shape->value_bytes =
        4 * (uint64_t)shape->ring_pitch * ((size_t)shape->max_degree + 1) * real_bytes;
}

/* Measures the table as kernels/sphere/nufft/grid_table.h lays it out. */
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

ps_sphere_local ps_sphere_local_bytes(const ps_sphere_shape *shape, size_t real_bytes) {
    const size_t run = 2 * (size_t)shape->run_vectors * shape->lanes;
    const size_t bins = ps_nufft_bins(&shape->axis);
    return (ps_sphere_local){
        .windows = PS_NUFFT_CHUNK * (2 * bins + 3) * real_bytes,
        .cells = 2 * PS_NUFFT_CHUNK * sizeof(uint32_t),
        .table = shape->block * run * real_bytes,
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

/* ---- memory ------------------------------------------------------------------------------ */

/* Values on rings of so many realizations share one table of Lambda_lm: more of them cost no less,
 * unless they are so small that launches count (L = 64: 0.86 of the time; L = 128, where 64 leave
 * the last cache: 1.2). */
enum { MOST_AT_ONCE = 32, MOST_SMALL_AT_ONCE = 64 };
static const double small_values = 4 << 20;

/* Bytes for all points on the device, all grids, and all points of realizations at once on the
 * host, unless one needs more. */
static const double point_budget = 128 << 20;
static const double grid_budget = 256 << 20;
static const double set_budget = 128 << 20;

/* Values on rings are part of the fixed memory as long as they fit here; else each realization of a
 * batch brings its own, so that a limit on memory makes batches smaller. */
static const double fixed_budget = 128 << 20;
static const double value_budget = 768 << 20;

/* Work-groups for each core: so few that grids stay in the cache, so many that no core waits long
 * for another. */
enum { GROUPS_PER_CORE = 4 };

static size_t fitting(double budget, uint64_t bytes, size_t most) {
    const double number = bytes > 0 ? floor(budget / (double)bytes) : (double)most;
    return number >= (double)most ? most : number > 1 ? (size_t)number : 1;
}

/* Realizations side by side. */
static void choose_at_once(ps_sphere_shape *shape, const ps_problem *problem, size_t cores,
                           size_t real_bytes) {
    const uint64_t known = problem->num_realizations;
    const bool is_small = (double)shape->value_bytes * MOST_SMALL_AT_ONCE <= small_values;
    const size_t wanted = is_small ? MOST_SMALL_AT_ONCE : MOST_AT_ONCE;
    const size_t most = known > 0 && known < wanted ? (size_t)known : wanted;
    const uint64_t vectors = problem->num_points * 3 * sizeof(double);
    const uint64_t set_bytes = vectors + problem->num_points * (2 * sizeof(uint64_t) + real_bytes);
    shape->at_once = fitting(value_budget, shape->value_bytes, fitting(set_budget, vectors, most));
    shape->together = shape->is_sorted ? 1 : fitting(point_budget, set_bytes, shape->at_once);
    shape->most_points = shape->together * problem->num_points;
    if (shape->is_sorted && shape->most_points > PS_SPHERE_PARTS * PS_SPHERE_PART_POINTS) {
        shape->most_points = PS_SPHERE_PARTS * PS_SPHERE_PART_POINTS;
    }
    const size_t groups = GROUPS_PER_CORE * cores;
    shape->set_points = ps_sphere_has_strips(shape) ? problem->num_points : 0;
    shape->slots = fitting(grid_budget, shape->grid_bytes + shape->row_bytes,
                           shape->together < groups ? shape->together : groups);
    shape->shares = shape->route == PS_SPHERE_BY_RINGS && shape->slots < groups
                        ? ps_divide_up(groups, shape->slots)
                        : 1;
}

ps_sphere_bytes ps_sphere_bytes_of(const ps_sphere_shape *shape, size_t real_bytes) {
    const uint64_t groups = PS_SPHERE_GROUPS;
    const uint64_t points = ps_round_up(shape->most_points, shape->lanes);
    const uint64_t parts = ps_divide_up(shape->most_points, PS_SPHERE_PART_POINTS);
    const uint64_t keys = (uint64_t)shape->bands * shape->tiles;
    const bool has_strips = ps_sphere_has_strips(shape);
    const uint64_t work_groups = shape->slots * shape->shares;
    const uint64_t strips = ps_divide_up(shape->columns, shape->strip);
    /* No buffer may be empty, so that one place is there without strips, too. */
    const uint64_t strip_points =
        has_strips ? work_groups * ps_round_up(shape->set_points, shape->lanes) : 1;
    /* On the way by cells rings are there only while the table is made, before most of the rest. */
    const uint64_t rings = shape->route == PS_SPHERE_BY_RINGS ? shape->rings : 0;
    const uint64_t pitch = rings > 0 ? shape->ring_pitch : 0;
    const uint64_t run = (uint64_t)shape->run_vectors * shape->lanes;
    return (ps_sphere_bytes){
        .vectors = points * 3 * sizeof(double),
        .turns = points * 2 * sizeof(uint64_t),
        .weights = points * real_bytes,
        .keys = shape->is_sorted ? points * sizeof(uint32_t) : 0,
        .starts = shape->is_sorted ? parts * (keys + 1) * sizeof(uint32_t) : 0,
        .grids = (has_strips ? work_groups : shape->slots) * shape->grid_bytes,
        .rows = shape->slots * shape->row_bytes,
        .strip_turns = strip_points * 2 * sizeof(uint64_t),
        .strip_weights = strip_points * real_bytes,
        .strips = strip_points * sizeof(uint32_t),
        .strip_starts = work_groups * (strips + 1) * sizeof(uint32_t),
        .scratch = work_groups * 2 * shape->lanes * (shape->axis.n + rings / 2) * real_bytes,
        .values = shape->value_bytes,
        .gaps = ((uint64_t)shape->max_degree + 1) * 2 * shape->lanes * real_bytes,
        .powers = groups * 2 * shape->half_pitch * sizeof(double),
        .sums = pitch > 0 ? groups * 4 * run * real_bytes : 0,
        .states = groups * 4 * pitch * sizeof(double),
        .scales = groups * 2 * pitch * sizeof(int32_t),
        .diagonals = groups * pitch * sizeof(double),
        .table = shape->table_reals * real_bytes};
}

/* The tables of tables.c take for a cell of the transforms twiddles, turns and a place; gains; what
 * Lambda_mm begins with. */
static uint64_t table_bytes(const ps_sphere_shape *shape, size_t real_bytes) {
    const bool by_rings = shape->route == PS_SPHERE_BY_RINGS;
    const uint64_t cells = (shape->axis.n + (uint64_t)(by_rings ? shape->rings : 0)) / 2;
    const uint64_t orders = (uint64_t)shape->max_degree + 1;
    const uint64_t ring_tables = 3; /* cosines, distances, squares */
    const uint64_t starts = by_rings ? (PS_SPHERE_GROUPS + 1) * (uint64_t)shape->ring_pitch : 0;
    const uint64_t places =
        by_rings ? 0 : orders * 2 * (sizeof(uint64_t) + shape->most_runs * sizeof(uint32_t));
    return cells * (4 * real_bytes + sizeof(uint32_t)) +
           orders * (4 * real_bytes + sizeof(double)) + places +
           starts * (sizeof(double) + sizeof(int32_t)) +
           (by_rings ? ring_tables * shape->ring_pitch * sizeof(double) : 0);
}

/* What is there while sphere_grid makes its table, and given back before the rest is taken. */
static uint64_t making_bytes(const ps_sphere_shape *shape) {
    const uint64_t of_ring =
        7 * sizeof(double) + 4 * sizeof(int32_t); /* states, diagonals, starts */
    const uint64_t filters = 4 * shape->num_rings *
                             ps_round_up(shape->num_angles, PS_SPHERE_TABLE_ANGLES) *
                             sizeof(double);
    return shape->route == PS_SPHERE_BY_CELLS
               ? PS_SPHERE_GROUPS * shape->ring_pitch * of_ring + filters
               : 0;
}

static void count_memory(ps_sphere_shape *shape, const ps_problem *problem,
                         const ps_device_limits *limits, size_t real_bytes) {
    const size_t cores = limits->compute_units > 0 ? limits->compute_units : 1;
    choose_at_once(shape, problem, cores, real_bytes);
    const ps_sphere_bytes bytes = ps_sphere_bytes_of(shape, real_bytes);
    const uint64_t sorted = shape->is_sorted ? bytes.turns + bytes.weights : 0;
    const uint64_t host_each = 2 * shape->half_pitch * sizeof(double);
    const uint64_t each = bytes.values + bytes.powers + bytes.sums + host_each;
    const uint64_t rest = bytes.grids + bytes.scratch + bytes.gaps + shape->at_once * each;
    const uint64_t making = making_bytes(shape);
    const bool is_fixed = (double)(each * shape->at_once) <= fixed_budget;
    shape->each_bytes = is_fixed ? 0 : each;
    shape->host_bytes = bytes.weights + (is_fixed ? shape->at_once * host_each : 0);
    shape->fixed_bytes = bytes.weights + bytes.vectors + bytes.turns + bytes.weights + sorted +
                         bytes.keys + bytes.starts + bytes.grids + bytes.rows + bytes.scratch +
                         bytes.strip_turns + bytes.strip_weights + bytes.strips +
                         bytes.strip_starts + table_bytes(shape, real_bytes) + bytes.sums +
                         bytes.states + bytes.scales + bytes.diagonals + bytes.diagonals / 2 +
                         bytes.table + bytes.gaps + (making > rest ? making - rest : 0) +
                         (is_fixed ? shape->at_once * each : 0);
    const uint64_t buffers[] = {bytes.table,
                                bytes.grids,
                                bytes.rows,
                                shape->at_once * bytes.values + bytes.gaps,
                                shape->at_once * bytes.powers,
                                bytes.vectors};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++) {
        shape->largest_buffer =
            buffers[i] > shape->largest_buffer ? buffers[i] : shape->largest_buffer;
    }
}

void ps_sphere_shape_shrink(ps_sphere_shape *shape, size_t batch) {
    const size_t groups = shape->slots * shape->shares;
    shape->at_once = batch < shape->at_once ? batch : shape->at_once;
    if (shape->together > shape->at_once) {
        shape->most_points = shape->most_points / shape->together * shape->at_once;
        shape->together = shape->at_once;
    }
    if (shape->slots > shape->together) {
        shape->shares =
            shape->route == PS_SPHERE_BY_RINGS ? ps_divide_up(groups, shape->together) : 1;
        shape->slots = shape->together;
    }
}

ps_sphere_shape ps_sphere_rings_shape(int32_t max_degree, const ps_device_limits *limits,
                                      ps_precision precision) {
    const size_t real_bytes = ps_real_bytes(precision);
    const unsigned lanes = ps_engine_lanes(limits, precision);
    ps_sphere_shape shape = {.max_degree = max_degree, .lanes = lanes > 1 ? lanes : 2};
    shape.rings = ps_sphere_ring_length(shape.max_degree);
    shape.num_rings = shape.rings / 4 + 1;
    shape.run_vectors = choose_run_vectors(&shape, limits, real_bytes);
    measure_sums(&shape, real_bytes);
    choose_recurrences(&shape, precision);
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
    measure(&shape, limits, ps_planned_points(problem), real_bytes);
    bool fits = spreading_fits(&shape, limits, real_bytes);
    if (route == PS_SPHERE_BY_CELLS) { /* the table is made of rings in double precision */
        const ps_sphere_shape rings = ps_sphere_rings_shape(shape.max_degree, limits, PS_DOUBLE);
        const bool is_whole =
            shape.lanes % rings.lanes == 0 && rings.run_vectors * rings.lanes % shape.lanes == 0;
        fits = fits && is_whole && ps_sphere_rings_fit(&rings, limits, sizeof(double));
        measure_table(&shape, real_bytes);
    } else {
        fits = fits && ps_sphere_rings_fit(&shape, limits, real_bytes);
    }
    if (!fits) {
        shape.lanes = 0;
        return shape;
    }
    count_memory(&shape, problem, limits, real_bytes);
    return shape;
}

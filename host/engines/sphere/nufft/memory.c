/* What sphere_nufft and sphere_grid keep in memory, and how many realizations side by side. */
#include "base/round.h"
#include "device/kind.h"
#include "device/reals.h"
#include "engines/nufft/fft.h"
#include "engines/sphere/nufft/shape.h"
#include "sphere/nufft/numbers.h"

#include <math.h>

/* ---- tables ------------------------------------------------------------------------------ */

/* The tables of tables.c take, for a cell of a transform, twiddles, turns and a place. */
static uint64_t transform_bytes(uint64_t cells, size_t real_bytes) {
    return cells * (4 * real_bytes + sizeof(uint32_t));
}

/* And what Lambda_mm begins with, cosines, distances and squares. */
static uint64_t ring_table_bytes(const ps_sphere_shape *shape, size_t real_bytes) {
    const uint64_t starts = (PS_SPHERE_GROUPS + 1) * (uint64_t)shape->ring_pitch;
    return transform_bytes(shape->rings / 2, real_bytes) +
           starts * (sizeof(double) + sizeof(int32_t)) + 3 * shape->ring_pitch * sizeof(double);
}

static uint64_t cell_table_bytes(const ps_sphere_shape *shape, size_t real_bytes) {
    const uint64_t orders = (uint64_t)shape->max_degree + 1;
    (void)real_bytes;
    return orders * 2 * (sizeof(uint64_t) + shape->most_runs * sizeof(uint32_t));
}

static uint64_t no_bytes(const ps_sphere_shape *shape) {
    (void)shape;
    return 0;
}

/* What is there while sphere_grid makes its table, and given back before the rest is taken. */
static uint64_t making_bytes(const ps_sphere_shape *shape) {
    const uint64_t of_ring =
        7 * sizeof(double) + 4 * sizeof(int32_t); /* states, diagonals, starts */
    const uint64_t filters = 4 * shape->num_rings *
                             ps_round_up(shape->num_angles, PS_SPHERE_TABLE_ANGLES) *
                             sizeof(double);
    return PS_SPHERE_GROUPS * shape->ring_pitch * of_ring + filters;
}

static const struct {
    uint64_t (*tables)(const ps_sphere_shape *, size_t real_bytes);
    uint64_t (*making)(const ps_sphere_shape *);
    bool shares_grids; /* between work-groups, where there are more of these */
} routes[] = {[PS_SPHERE_BY_RINGS] = {ring_table_bytes, no_bytes, true},
              [PS_SPHERE_BY_CELLS] = {cell_table_bytes, making_bytes, false},
              [PS_SPHERE_ON_GPU] = {ring_table_bytes, no_bytes, false}};

/* ---- realizations side by side ----------------------------------------------------------- */

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

/* GPUs have work-groups side by side instead, and each launch costs the time of some hundred sets
 * of 1024 points: four realizations for each unit, as far as the grid has room for them. Counted,
 * not measured: 20000 sets of (1024, 64) take 63 rounds of launches instead of the 313 of 64 sets
 * each. */
enum { SETS_PER_UNIT = 4 };

static size_t fitting(double budget, uint64_t bytes, size_t most) {
    const double number = bytes > 0 ? floor(budget / (double)bytes) : (double)most;
    return number >= (double)most ? most : number > 1 ? (size_t)number : 1;
}

/* Between the values of orders (kernels/sphere/values.h). */
static uint64_t gap_bytes(const ps_sphere_shape *shape, size_t real_bytes) {
    return ((uint64_t)shape->max_degree + 1) * 2 * shape->lanes * real_bytes;
}

/* The grid on GPUs: as many realizations as its boxes and lines have room for go all the way. */
static void choose_plane(ps_sphere_shape *shape, const ps_problem *problem,
                         const ps_device_limits *limits, size_t real_bytes) {
    const ps_precision precision = real_bytes == sizeof(float) ? PS_SINGLE : PS_DOUBLE;
    shape->plane = ps_sphere_plane_layout(shape, problem, limits, precision, shape->together);
    if (shape->plane.lanes == 0) {
        shape->lanes = 0;
        return;
    }
    shape->at_once = shape->together = shape->plane.parts; /* memory is in proportion to it */
    shape->most_points = shape->together * shape->plane.part_points;
    shape->plane_bytes = ps_divide_up(shape->plane.fixed_bytes, shape->plane.parts);
}

static void choose_at_once(ps_sphere_shape *shape, const ps_problem *problem,
                           const ps_device_limits *limits, size_t real_bytes) {
    const size_t cores = ps_device_typical(limits).served_units;
    const uint64_t known = problem->num_realizations;
    const bool is_small = (double)shape->value_bytes * MOST_SMALL_AT_ONCE <= small_values;
    const size_t wanted = shape->route == PS_SPHERE_ON_GPU ? SETS_PER_UNIT * cores
                          : is_small                       ? MOST_SMALL_AT_ONCE
                                                           : MOST_AT_ONCE;
    const size_t most = known > 0 && known < wanted ? (size_t)known : wanted;
    const uint64_t vectors = problem->num_points * 3 * sizeof(double);
    const uint64_t set_bytes = vectors + problem->num_points * (2 * sizeof(uint64_t) + real_bytes);
    const double largest =
        (double)limits->max_allocation_bytes - (double)gap_bytes(shape, real_bytes);
    shape->at_once = fitting(fmin(value_budget, largest), shape->value_bytes,
                             fitting(set_budget, vectors, most));
    shape->together = shape->is_sorted ? 1 : fitting(point_budget, set_bytes, shape->at_once);
    shape->slots = shape->shares = 1;
    shape->most_points = shape->together * problem->num_points;
    if (shape->route == PS_SPHERE_ON_GPU) {
        choose_plane(shape, problem, limits, real_bytes);
        return;
    }
    if (shape->is_sorted && shape->most_points > PS_SPHERE_PARTS * PS_SPHERE_PART_POINTS) {
        shape->most_points = PS_SPHERE_PARTS * PS_SPHERE_PART_POINTS;
    }
    const size_t groups = GROUPS_PER_CORE * cores;
    shape->set_points = ps_sphere_has_strips(shape) ? problem->num_points : 0;
    shape->slots = fitting(grid_budget, shape->grid_bytes + shape->row_bytes,
                           shape->together < groups ? shape->together : groups);
    shape->shares = routes[shape->route].shares_grids && shape->slots < groups
                        ? ps_divide_up(groups, shape->slots)
                        : 1;
}

/* ---- bytes ------------------------------------------------------------------------------- */

/* Beside the grid, which is plane_bytes for each of plane.parts. */
static ps_sphere_bytes gpu_bytes_of(const ps_sphere_shape *shape, size_t real_bytes) {
    const uint64_t points = ps_round_up(shape->most_points, shape->lanes);
    return (ps_sphere_bytes){.vectors = points * 3 * sizeof(double),
                             .turns = points * 2 * sizeof(uint64_t),
                             .weights = points * real_bytes,
                             .values = shape->value_bytes,
                             .powers = PS_SPHERE_GROUPS * 2 * shape->half_pitch * sizeof(double),
                             .sums = ps_sphere_degrees_bytes(shape, real_bytes)};
}

ps_sphere_bytes ps_sphere_bytes_of(const ps_sphere_shape *shape, size_t real_bytes) {
    if (shape->route == PS_SPHERE_ON_GPU) {
        return gpu_bytes_of(shape, real_bytes);
    }
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
    const uint64_t staged = shape->is_sorted ? (uint64_t)shape->bands * STAGED_POINTS : 1;
    const uint64_t rings = shape->transform_rings;
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
        .gaps = gap_bytes(shape, real_bytes),
        .powers = groups * 2 * shape->half_pitch * sizeof(double),
        .sums = pitch > 0 && !shape->is_one_set ? groups * 4 * run * real_bytes : 0,
        .staged = staged * 2 * sizeof(uint64_t),
        .staged_heights = staged * real_bytes,
        .states = groups * 4 * pitch * sizeof(double),
        .scales = groups * 2 * pitch * sizeof(int32_t),
        .diagonals = groups * pitch * sizeof(double),
        .table = shape->table_reals * real_bytes};
}

static uint64_t table_bytes(const ps_sphere_shape *shape, size_t real_bytes) {
    const uint64_t gains = ((uint64_t)shape->max_degree + 1) * (4 * real_bytes + sizeof(double));
    return transform_bytes(shape->axis.n / 2, real_bytes) + gains +
           routes[shape->route].tables(shape, real_bytes);
}

/* What there is for at_once realizations, as fixed bytes and those of each. */
static void add_up(ps_sphere_shape *shape, size_t real_bytes) {
    const ps_sphere_bytes bytes = ps_sphere_bytes_of(shape, real_bytes);
    const uint64_t sorted = shape->is_sorted ? bytes.turns + bytes.weights : 0;
    const uint64_t read = PS_READINGS * 2 * shape->half_pitch * sizeof(double);
    const uint64_t each = bytes.values + bytes.powers + bytes.sums + read;
    const uint64_t rest = bytes.grids + bytes.scratch + bytes.gaps + shape->at_once * each;
    const uint64_t making = routes[shape->route].making(shape);
    const bool is_fixed = (double)(each * shape->at_once) <= fixed_budget;
    shape->each_bytes = is_fixed ? 0 : each;
    shape->host_bytes = bytes.weights;
    shape->fixed_bytes =
        shape->plane.parts * shape->plane_bytes + bytes.weights + 2 * bytes.vectors + bytes.turns +
        bytes.weights + sorted + bytes.keys + bytes.starts + bytes.grids + bytes.rows +
        bytes.scratch + bytes.strip_turns + bytes.strip_weights + bytes.strips +
        bytes.strip_starts + bytes.staged + bytes.staged_heights + table_bytes(shape, real_bytes) +
        bytes.sums + bytes.states + bytes.scales + bytes.diagonals + bytes.diagonals / 2 +
        bytes.table + bytes.gaps + (making > rest ? making - rest : 0) +
        (is_fixed ? shape->at_once * each : 0);
    const uint64_t buffers[] = {shape->plane.largest_buffer,
                                bytes.table,
                                bytes.grids,
                                bytes.rows,
                                shape->at_once * bytes.values + bytes.gaps,
                                shape->at_once * bytes.powers,
                                (shape->at_once + 1) * bytes.sums,
                                bytes.vectors};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++) {
        shape->largest_buffer =
            buffers[i] > shape->largest_buffer ? buffers[i] : shape->largest_buffer;
    }
}

/* Batches of hundreds of sets become smaller where memory is little: what a set has of points and
 * grids is its own, too. */
static void spread_over_sets(ps_sphere_shape *shape, size_t real_bytes) {
    ps_sphere_shape one = *shape;
    ps_sphere_shape_shrink(&one, 1);
    add_up(&one, real_bytes);
    const uint64_t least = one.fixed_bytes + one.each_bytes;
    const uint64_t all = shape->fixed_bytes + shape->at_once * shape->each_bytes;
    if (shape->at_once > 1 && all > least) {
        shape->each_bytes = (all - least) / (shape->at_once - 1) + 1;
        shape->fixed_bytes = least > shape->each_bytes ? least - shape->each_bytes : 0;
    }
}

void ps_sphere_count_memory(ps_sphere_shape *shape, const ps_problem *problem,
                            const ps_device_limits *limits, size_t real_bytes) {
    choose_at_once(shape, problem, limits, real_bytes);
    if (shape->lanes == 0) {
        return; /* the grid has no such sizes */
    }
    add_up(shape, real_bytes);
    if (shape->route == PS_SPHERE_ON_GPU) {
        spread_over_sets(shape, real_bytes);
    }
}

void ps_sphere_shape_shrink(ps_sphere_shape *shape, size_t batch) {
    const size_t groups = shape->slots * shape->shares;
    shape->at_once = batch < shape->at_once ? batch : shape->at_once;
    if (shape->together > shape->at_once) {
        shape->most_points = shape->most_points / shape->together * shape->at_once;
        shape->together = shape->at_once;
    }
    if (shape->plane.parts > shape->together) {
        ps_nufft_layout_shrink(&shape->plane, shape->together);
    }
    if (shape->slots > shape->together) {
        shape->shares =
            routes[shape->route].shares_grids ? ps_divide_up(groups, shape->together) : 1;
        shape->slots = shape->together;
    }
}

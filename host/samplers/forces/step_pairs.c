#include "samplers/forces/step_pairs.h"

#include "base/memory.h"
#include "samplers/forces/loan.h"

#include <stdlib.h>
#include <string.h>

/* Points of a block: of fewer, a tile has too little work for a work-item, which costs PoCL 0.25
 * us; 64 blocks are enough for the threads of a CPU, and their forces take 1 KB a point. */
enum { AXES = 2, LEAST_BLOCK = 64, MOST_BLOCKS = 64 };
/* Operations of a pair, and pairs of a launch, between two of which the watch hears of it: 30 ms of
 * a core at 1.3 ns a pair. On GPUs, which draw nothing meanwhile and may be reset after seconds, 20
 * ms of one with a fp64 unit for every 64 others (0.15 Tflop/s). */
static const double PAIR_FLOPS = 14;
static const double LAUNCH_PAIRS = 2e7;
static const double SHARED_LAUNCH_PAIRS = 2e8;

static step_layout make_layout(size_t num, size_t num_bins) {
    const size_t least = (num + MOST_BLOCKS - 1) / MOST_BLOCKS;
    const size_t wanted = least > LEAST_BLOCK ? least : LEAST_BLOCK;
    const size_t block = (wanted + STEP_LANES - 1) / STEP_LANES * STEP_LANES;
    const size_t num_blocks = (num + block - 1) / block;
    return (step_layout){.num_points = (ps_u32)num,
                         .stride = (ps_u32)(num_blocks * block),
                         .block = (ps_u32)block,
                         .num_blocks = (ps_u32)num_blocks,
                         .num_bins = (ps_u32)num_bins};
}

/* Rows of tiles come in twos: the first and the last, and so on. */
static size_t count_copies(const step_layout *layout) {
    return (layout->num_blocks + 1) / 2;
}

double ps_step_pairs_bytes(size_t num, size_t num_bins) {
    const step_layout l = make_layout(num, num_bins);
    const double plane = (double)(AXES * sizeof(double)) * l.stride;
    const double copies = (double)count_copies(&l) * (double)(num_bins + 1) * sizeof(uint32_t);
    return plane * (3 + l.num_blocks) + 2 * copies + (double)(num_bins + 1) * sizeof(double);
}

static pspec_status create_kernels(ps_step_pairs *p, ps_error *error) {
    const char *const options = p->has_shared_counts ? "-DSHARED=1" : "-DSHARED=0";
    static const char program[] = "samplers/step_forces.cl";
    PS_TRY(ps_kernel_get(p->device, &p->count, program, "step_counts", options, error));
    PS_TRY(ps_kernel_get(p->device, &p->force, program, "step_forces", options, error));
    return ps_kernel_get(p->device, &p->fold, program, "step_fold", options, error);
}

static pspec_status create_buffers(ps_step_pairs *p, ps_error *error) {
    const step_layout *const l = &p->layout;
    const size_t plane = (size_t)AXES * l->stride;
    const size_t num_counts = count_copies(l) * (l->num_bins + 1);
    PS_TRY(PS_NEW(&p->coordinates, plane, "points", error));
    PS_TRY(PS_NEW(&p->copies, num_counts, "counts of pairs", error));
    const ps_wanted_buffer wanted[] = {
        {&p->points, plane * sizeof(double), "points"},
        {&p->counts, num_counts * sizeof(uint32_t), "counts of pairs"},
        {&p->table, (l->num_bins + 1) * sizeof(double), "forces over distances"},
        {&p->forces, l->num_blocks * plane * sizeof(double), "forces of blocks"},
        {&p->sums, plane * sizeof(double), "forces"}};
    return PS_BUFFERS_CREATE(p->device, wanted, error);
}

pspec_status ps_step_pairs_create(ps_step_pairs *p, ps_device *device, size_t num, size_t num_bins,
                                  ps_error *error) {
    *p = (ps_step_pairs){.device = device,
                         .layout = make_layout(num, num_bins),
                         .has_shared_counts = !ps_range_is_alone(device)};
    p->launch_pairs = p->has_shared_counts ? SHARED_LAUNCH_PAIRS : LAUNCH_PAIRS;
    PS_TRY(ps_forces_need_doubles(ps_device_get_limits(device), "step", error));
    PS_TRY(create_kernels(p, error));
    return create_buffers(p, error);
}

void ps_step_pairs_destroy(ps_step_pairs *p) {
    PS_BUFFERS_RELEASE(&p->points, &p->counts, &p->table, &p->forces, &p->sums);
    free(p->coordinates);
    free(p->copies);
}

/* What launches have: some rows of tiles, and of each tile some points of its first block. */
typedef struct launches {
    size_t num_rows, rows_at_once;
    size_t firsts_at_once;
} launches;

static size_t clamp(double wanted, size_t most) {
    return wanted < 1 ? 1 : wanted > (double)most ? most : (size_t)wanted;
}

/* Pairs of one point of each block with all points, each once. */
static double pairs_of_firsts(const step_layout *l) {
    return (double)l->num_points * (l->num_blocks + 1) / 2;
}

/* Work-items have all their rows, so that none of them waits for others. */
static launches plan_counts(const ps_step_pairs *p) {
    const step_layout *const l = &p->layout;
    const size_t copies = count_copies(l);
    return (launches){copies, copies, clamp(p->launch_pairs / pairs_of_firsts(l), l->block)};
}

/* On CPUs rows of tiles one after the other: what is added to stays in the caches. */
static launches plan_forces(const ps_step_pairs *p) {
    const step_layout *const l = &p->layout;
    const double row = (double)l->block * l->num_points;
    return p->has_shared_counts
               ? (launches){l->num_blocks, l->num_blocks,
                            clamp(p->launch_pairs / pairs_of_firsts(l), l->block)}
               : (launches){l->num_blocks, clamp(p->launch_pairs / row, l->num_blocks), l->block};
}

typedef pspec_status launch_part(ps_step_pairs *p, const step_layout *part, size_t row,
                                 size_t num_rows, ps_error *error);

static pspec_status let_know(ps_step_pairs *p, size_t done, size_t num, const ps_watch *watch,
                             ps_error *error) {
    PS_TRY(ps_device_finish(p->device, error));
    return ps_watch_tell(watch, "sampler: step, parts of a move", done, num, NULL, error);
}

static pspec_status launch_all(ps_step_pairs *p, const launches *plan, launch_part *launch,
                               const ps_watch *watch, ps_error *error) {
    const size_t num_firsts = p->layout.block;
    const size_t parts_of_rows = (num_firsts + plan->firsts_at_once - 1) / plan->firsts_at_once;
    const size_t num =
        (plan->num_rows + plan->rows_at_once - 1) / plan->rows_at_once * parts_of_rows;
    for (size_t part = 0; part < num; part++) {
        const size_t row = part / parts_of_rows * plan->rows_at_once;
        const size_t left = plan->num_rows - row;
        step_layout layout = p->layout;
        layout.first = (ps_u32)(part % parts_of_rows * plan->firsts_at_once);
        layout.num_firsts = (ps_u32)plan->firsts_at_once;
        PS_TRY(
            launch(p, &layout, row, left < plan->rows_at_once ? left : plan->rows_at_once, error));
        if (part + 1 < num) {
            PS_TRY(let_know(p, part + 1, num, watch, error));
        }
    }
    return PSPEC_OK;
}

/* Work-items are alone in their group on CPUs: they run long. */
static ps_range make_range(const ps_step_pairs *p, size_t first, size_t second, double pairs) {
    const ps_range alone = {
        .rank = 3, .global = {first, second, 1}, .local = {1, 1, 1}, .flops = pairs * PAIR_FLOPS};
    return p->has_shared_counts ? ps_range_heavy(p->device, first, second, 1, pairs * PAIR_FLOPS, 0)
                                : alone;
}

static pspec_status launch_counts(ps_step_pairs *p, const step_layout *part, size_t row,
                                  size_t num_rows, ps_error *error) {
    const double pairs = (double)part->num_firsts * pairs_of_firsts(part);
    ps_range range = make_range(p, num_rows, p->has_shared_counts ? part->num_blocks : 1, pairs);
    range.offset[0] = row;
    return PS_LAUNCH(p->device, p->count, &range, error, PS_STRUCT(*part), PS_BUFFER(p->points),
                     PS_BUFFER(p->counts));
}

static void add_copies(const ps_step_pairs *p, uint64_t *counts) {
    const size_t num_bins = p->layout.num_bins;
    memset(counts, 0, num_bins * sizeof *counts);
    for (size_t c = 0; c < count_copies(&p->layout); c++) {
        for (size_t b = 0; b < num_bins; b++) {
            counts[b] += p->copies[c * (num_bins + 1) + b];
        }
    }
}

/* Numbers behind the last point are 0, since 0 times them is added. */
static pspec_status write_points(ps_step_pairs *p, const double *x, ps_error *error) {
    const size_t stride = p->layout.stride;
    for (size_t i = 0; i < stride; i++) {
        const bool is_there = i < p->layout.num_points;
        p->coordinates[i] = is_there ? x[AXES * i] : 0;
        p->coordinates[stride + i] = is_there ? x[AXES * i + 1] : 0;
    }
    return ps_buffer_write(p->device, &p->points, 0, p->coordinates, p->points.bytes, error);
}

pspec_status ps_step_pairs_count(ps_step_pairs *p, const double *x, uint64_t *counts,
                                 const ps_watch *watch, ps_error *error) {
    const launches plan = plan_counts(p);
    PS_TRY(write_points(p, x, error));
    memset(p->copies, 0, p->counts.bytes); /* Oclgrind does not see what clears buffers */
    PS_TRY(ps_buffer_write(p->device, &p->counts, 0, p->copies, p->counts.bytes, error));
    PS_TRY(launch_all(p, &plan, launch_counts, watch, error));
    PS_TRY(ps_buffer_read(p->device, &p->counts, 0, p->copies, p->counts.bytes, error));
    add_copies(p, counts);
    return PSPEC_OK;
}

static pspec_status launch_forces(ps_step_pairs *p, const step_layout *part, size_t row,
                                  size_t num_rows, ps_error *error) {
    const double pairs = (double)num_rows * part->num_firsts * part->num_points / 2;
    ps_range range = make_range(p, part->num_blocks, num_rows, pairs);
    range.offset[1] = row;
    return PS_LAUNCH(p->device, p->force, &range, error, PS_STRUCT(*part), PS_BUFFER(p->points),
                     PS_BUFFER(p->table), PS_BUFFER(p->forces));
}

static pspec_status fold(ps_step_pairs *p, double *force, ps_error *error) {
    const step_layout *const l = &p->layout;
    const ps_range range =
        ps_range_light(p->device, l->num_points, 1, 1, (double)AXES * l->num_points * l->num_blocks,
                       (double)p->forces.bytes);
    PS_TRY(PS_LAUNCH(p->device, p->fold, &range, error, PS_STRUCT(p->layout), PS_BUFFER(p->forces),
                     PS_BUFFER(p->sums)));
    PS_TRY(ps_buffer_read(p->device, &p->sums, 0, p->coordinates, p->sums.bytes, error));
    for (size_t i = 0; i < l->num_points; i++) {
        force[AXES * i] = p->coordinates[i];
        force[AXES * i + 1] = p->coordinates[l->stride + i];
    }
    return PSPEC_OK;
}

pspec_status ps_step_pairs_force(ps_step_pairs *p, const double *x, const double *table,
                                 double *force, const ps_watch *watch, ps_error *error) {
    const launches plan = plan_forces(p);
    PS_TRY(write_points(p, x, error)); /* which need not be those that were counted */
    PS_TRY(ps_buffer_write(p->device, &p->table, 0, table, p->table.bytes, error));
    PS_TRY(launch_all(p, &plan, launch_forces, watch, error));
    return fold(p, force, error);
}

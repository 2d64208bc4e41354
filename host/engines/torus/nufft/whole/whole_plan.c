/* Realizations that one work-group does whole: what they take (whole.c does it). */
#include "base/round.h"
#include "device/kind.h"
#include "device/reals.h"
#include "engines/torus/nufft/local.h"
#include "engines/torus/nufft/measure.h"
#include "engines/torus/nufft/layout.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>

/* Realizations that are done whole come to the device in one piece, and one core has each. */
static const double most_points[PS_NUFFT_MAX_AXES] = {1 << 20, 1 << 18, -1};

/* The nearest cache of a core (Zen 5), nominal. */
static const double near_bytes = 32 << 10;

/* The grid stays in the cache of a core (1 MB, Zen 5), or nearly. Nominal, whatever the device has,
 * so that choices depend on nothing else. */
static const double most_bytes = 1.25 * (1 << 20);

/* ---- cost -------------------------------------------------------------------------------- */

static void count_whole_transforms(ps_nufft_counts *counts, const ps_nufft_choice *choice) {
    const unsigned lanes = choice->lanes;
    uint32_t kept[2];
    ps_nufft_whole_kept(choice, kept);
    const double groups = (double)ps_divide_up(choice->lengths[1], 2 * lanes);
    const double tiles = (double)ps_divide_up(choice->span, lanes);
    const double shared = ps_nufft_whole_shared(choice, lanes);
    const double turned = tiles - (shared > 0 ? 1 : 0);
    const double second = turned + shared / lanes; /* of a shared tile, its part */
    ps_nufft_add_transforms(counts, groups, choice->lengths[0]);
    ps_nufft_add_transforms(counts, second, choice->lengths[1]);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_CELL,
                 groups * choice->lengths[0] + second * choice->lengths[1]);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_TURNED, groups * turned * lanes);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_SHARED, shared * choice->lengths[1]);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_POWER, tiles * (2.0 * kept[1] + 1));
}

static double transform_cycles(const ps_nufft_choice *choice) {
    ps_nufft_counts counts = {{0}};
    count_whole_transforms(&counts, choice);
    return ps_nufft_cycles_of(&counts);
}

static void count(ps_nufft_counts *counts, const ps_nufft_choice *choice, ps_precision precision,
                  double num_points) {
    const unsigned lanes = choice->lanes;
    const ps_nufft_whole_sizes sizes = ps_nufft_whole_measure(choice, lanes);
    const ps_nufft_axis *last = &choice->axes[choice->num_axes - 1];
    const bool is_near = (double)(sizes.grid_reals * ps_real_bytes(precision)) <= near_bytes;
    const double rows = choice->num_axes > 1 ? choice->axes[0].window.width : 1;
    const double vectors = fmax(1, ps_nufft_cells_of_row(last, precision) / (double)lanes);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_POINT, num_points);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_POLYNOMIAL, num_points * ps_nufft_polynomials(choice));
    ps_nufft_add(counts, is_near ? PS_NUFFT_WHOLE_ROW : PS_NUFFT_WHOLE_FAR_ROW,
                 num_points * rows * vectors);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_CLEARED, (double)sizes.grid_reals / lanes);
    count_whole_transforms(counts, choice);
}

/* ---- choice ------------------------------------------------------------------------------ */

static bool offer(const ps_problem *problem, unsigned lanes, unsigned which,
                  ps_nufft_choice *choice) {
    (void)lanes;
    *choice = ps_nufft_choice_of_axes(problem, 0);
    return which == 0 && ps_planned_points(problem) <= most_points[choice->num_axes - 1];
}

/* Chooses the factors of the grid of one dimension by what the transforms take. The optimum is flat
 * (first lengths of 128 to 4096 of 131072 cells take the same time within 5 %), so it is looked for
 * up to twice the root. */
static void choose_lengths(ps_nufft_choice *choice) {
    const uint32_t n = choice->axes[0].n;
    double least = HUGE_VAL;
    for (uint32_t first = 2; first * first <= 4 * n; first++) {
        ps_nufft_choice other = *choice;
        uint32_t kept[2];
        if (n % first != 0) {
            continue;
        }
        other.lengths[0] = first;
        other.lengths[1] = n / first;
        other.span = first / 2 + 1;
        ps_nufft_whole_kept(&other, kept);
        const double cycles = transform_cycles(&other);
        if (2 * kept[1] + 1 <= other.lengths[1] && cycles < least) {
            least = cycles;
            *choice = other;
        }
    }
}

/* Gives a choice whose axes have grids the lengths of the transforms, and the span of axis 0. False
 * where the cache of a core is too small for it. */
static bool complete(ps_nufft_choice *choice, const ps_problem *problem, ps_precision precision,
                     unsigned which) {
    (void)problem;
    choice->lengths[0] = 0;
    if (which > 0) {
        return false;
    }
    if (choice->num_axes == 1) {
        choose_lengths(choice);
    } else {
        choice->lengths[0] = choice->axes[0].n;
        choice->lengths[1] = choice->axes[1].n;
    }
    if (choice->lengths[0] == 0) {
        return false;
    }
    const ps_nufft_whole_sizes sizes = ps_nufft_whole_measure(choice, choice->lanes);
    return (double)(sizes.grid_reals + sizes.row_reals) * (double)ps_real_bytes(precision) <=
           most_bytes;
}

/* ---- sizes ------------------------------------------------------------------------------- */

static size_t local_bytes(const ps_nufft_layout *layout) {
    return ps_nufft_local_sum(ps_nufft_windows_local(layout, layout->whole.window_reals));
}

/* Gains, turns of one dimension, plans of the windows and of the two transforms. */
static uint64_t whole_table_bytes(const ps_nufft_layout *layout) {
    enum { SMALL = 1536 };
    const ps_nufft_choice *choice = &layout->choice;
    const uint64_t turns = choice->num_axes == 1 ? 2 * (uint64_t)choice->lengths[1] *
                                                       (layout->lanes + layout->num_tiles)
                                                 : 0;
    const uint64_t cells = (uint64_t)choice->lengths[0] + choice->lengths[1];
    const uint64_t reals = layout->stride + turns + 2 * cells;
    return reals * layout->real_bytes + cells * sizeof(uint32_t) + choice->num_axes * SMALL;
}

/* Points on the host and on the device, grids and rows of the work-groups, tables. Parts are
 * realizations: as many as keep all cores at work. */
static void count_memory(ps_nufft_layout *layout, const ps_problem *problem,
                         const ps_device_limits *limits) {
    const size_t cores = ps_device_typical(limits).served_units;
    const uint64_t point = problem->frequencies->dimension * sizeof(uint64_t) + layout->real_bytes;
    const double each = 2 * (double)(layout->part_points * point);
    layout->parts = ps_nufft_fitting_parts(problem, limits, each, cores);
    layout->groups = layout->parts < PS_NUFFT_GROUPS_PER_CORE * cores
                         ? layout->parts
                         : PS_NUFFT_GROUPS_PER_CORE * cores;
    const uint64_t grids = layout->groups * layout->whole.grid_reals * layout->real_bytes;
    const uint64_t rows = layout->groups * layout->whole.row_reals * layout->real_bytes;
    layout->host_bytes = layout->parts * layout->real_bytes * layout->part_points;
    layout->fixed_bytes = 2 * layout->parts * layout->part_points * point + grids + rows +
                          whole_table_bytes(layout) +
                          layout->parts * (sizeof(uint64_t) + 2 * layout->real_bytes);
    const uint64_t buffers[] = {grids, rows,
                                layout->parts * layout->part_points *
                                    problem->frequencies->dimension * sizeof(uint64_t)};
    layout->largest_buffer = ps_nufft_largest(buffers, sizeof buffers / sizeof buffers[0]);
}

static void measure(ps_nufft_layout *layout, const ps_problem *problem,
                    const ps_device_limits *limits) {
    const ps_nufft_choice *choice = &layout->choice;
    uint32_t kept[2];
    ps_nufft_whole_kept(choice, kept);
    layout->whole = ps_nufft_whole_measure(choice, layout->lanes);
    while (layout->lanes > 0 && local_bytes(layout) > limits->local_bytes) {
        layout->lanes /= 2;
        layout->whole =
            layout->lanes > 0 ? ps_nufft_whole_measure(choice, layout->lanes) : layout->whole;
    }
    if (layout->lanes == 0) {
        return;
    }
    layout->num_tiles = (uint32_t)ps_divide_up(choice->span, layout->lanes);
    layout->stride = (size_t)layout->num_tiles * layout->lanes * (2 * (size_t)kept[1] + 1);
    layout->bytes_per_realization = layout->stride * layout->real_bytes;
    layout->largest_buffer_per_realization = layout->bytes_per_realization;
    layout->part_points = problem->num_points;
    count_memory(layout, problem, limits);
}

/* k or -k, whichever has its rest modulo the first length in the first half. */
static uint32_t line_slot(const ps_nufft_layout *layout, uint32_t k) {
    const uint32_t first = layout->choice.lengths[0];
    const uint32_t rest = k % first;
    uint32_t kept[2];
    ps_nufft_whole_kept(&layout->choice, kept);
    const uint32_t k_1 = rest <= first / 2 ? rest : first - rest;
    const uint32_t q = rest <= first / 2 ? kept[1] + k / first : kept[1] - k / first - 1;
    return (k_1 / layout->lanes * (2 * kept[1] + 1) + q) * layout->lanes + k_1 % layout->lanes;
}

static uint32_t slot(const ps_nufft_layout *layout, const int32_t *k, unsigned dimension) {
    return dimension == 1 ? line_slot(layout, (uint32_t)(k[0] < 0 ? -k[0] : k[0]))
                          : ps_nufft_tile_slot(layout, k, dimension);
}

static double count_launches(const ps_nufft_layout *layout, double num_points,
                             double realizations) {
    (void)num_points;
    return ceil(realizations / (double)layout->parts);
}

static void describe(const ps_nufft_layout *layout, ps_text *text) {
    const uint32_t *const lengths = layout->choice.lengths;
    ps_text_append(text, " whole=%lux%lu", (unsigned long)lengths[0], (unsigned long)lengths[1]);
}

const ps_nufft_variant ps_nufft_whole = {.on_cpus = true,
                                         .most_cells = PS_NUFFT_MOST_ROW_CELLS,
                                         .is_gridded = true,
                                         .are_alike = true,
                                         .offer = offer,
                                         .complete = complete,
                                         .count = count,
                                         .turning_roundings = 2,
                                         .measure = measure,
                                         .local_bytes = local_bytes,
                                         .slot = slot,
                                         .count_launches = count_launches,
                                         .programs = {1, 1},
                                         .describe = describe,
                                         .launcher = &ps_nufft_whole_launcher};

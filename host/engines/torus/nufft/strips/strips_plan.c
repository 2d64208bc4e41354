/* Realizations on strips of a grid in two dimensions: what they take (strips.c does it). */
#include "base/round.h"
#include "device/kind.h"
#include "device/reals.h"
#include "engines/torus/nufft/local.h"
#include "engines/torus/nufft/measure.h"
#include "engines/torus/nufft/layout.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>

/* They come to the device in one piece, and one core has each. */
static const double most_points = 1 << 18;

/* Tiles of a realization in strips that still are in a cache when they are transformed (Zen 4):
 * beyond it, a K of 512 took 1.3 to 1.5 times what K up to 256 says. Nominal, too. */
static const double strips_bytes = 4 << 20;

/* ---- choice ------------------------------------------------------------------------------ */

static bool offer(const ps_problem *problem, unsigned lanes, unsigned which,
                  ps_nufft_choice *choice) {
    const bool has_one = problem->num_realizations == 1; /* it would keep one core busy */
    (void)lanes;
    *choice = ps_nufft_choice_of_axes(problem, 0);
    return which == 0 && choice->num_axes == 2 && !has_one &&
           ps_planned_points(problem) <= most_points;
}

static uint32_t unit(const ps_nufft_choice *choice, unsigned axis) {
    (void)axis;
    return ps_nufft_strip_columns(choice->lanes);
}

static bool complete(ps_nufft_choice *choice, const ps_problem *problem, ps_precision precision,
                     unsigned which) {
    (void)problem;
    return which == 0 && ps_nufft_strips_fit(choice, precision);
}

/* ---- cost -------------------------------------------------------------------------------- */

static void count(ps_nufft_counts *counts, const ps_nufft_choice *choice, ps_precision precision,
                  double num_points) {
    const unsigned lanes = choice->lanes;
    const ps_nufft_axis *axes = choice->axes;
    const ps_nufft_strip_sizes sizes = ps_nufft_strips_measure(choice, lanes);
    const double groups = axes[1].n / (2.0 * lanes);
    const double tiles = (double)ps_divide_up(choice->span, lanes);
    const double strips = (double)axes[1].n / sizes.columns;
    const double vectors = fmax(1, ps_nufft_cells_of_row(&axes[1], precision) / (double)lanes);
    const double added = num_points * (1 + 1 / strips); /* those of the last strip twice */
    const double bytes = (double)sizes.tile_reals * (double)ps_real_bytes(precision);
    const bool are_far = bytes > strips_bytes;
    ps_nufft_add(counts, PS_NUFFT_SORTED, num_points);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_POINT, added);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_POLYNOMIAL, added * ps_nufft_polynomials(choice));
    ps_nufft_add(counts, PS_NUFFT_WHOLE_FAR_ROW, added * axes[0].window.width * vectors);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_CLEARED, 2 * strips * (double)sizes.strip_reals / lanes);
    ps_nufft_add_transforms(counts, groups, axes[0].n);
    ps_nufft_add_transforms(counts, tiles, axes[1].n);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_CELL, groups * axes[0].n + tiles * axes[1].n);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_TURNED, groups * tiles * lanes);
    ps_nufft_add(counts, PS_NUFFT_WHOLE_POWER, tiles * (2.0 * axes[1].max_frequency + 1));
    ps_nufft_add(counts, PS_NUFFT_STRIP_FAR, are_far ? bytes / PS_NUFFT_WORD_BYTES : 0);
}

/* ---- sizes ------------------------------------------------------------------------------- */

static size_t local_bytes(const ps_nufft_layout *layout) {
    return ps_nufft_local_sum(ps_nufft_windows_local(layout, layout->strips.window_reals));
}

/* Strips and tiles of all work-groups together. */
enum { MOST_STRIP_BYTES = 1 << 27 };

static size_t choose_strip_groups(const ps_nufft_layout *layout, size_t cores) {
    const size_t reals = layout->strips.strip_reals + layout->strips.tile_reals;
    const size_t fitting = MOST_STRIP_BYTES / (reals * layout->real_bytes);
    const size_t most =
        fitting < PS_NUFFT_GROUPS_PER_CORE * cores ? fitting : PS_NUFFT_GROUPS_PER_CORE * cores;
    return layout->parts < most ? layout->parts : most;
}

/* Sorted points, strips and tiles of work-groups. */
static void count_memory(ps_nufft_layout *layout, const ps_problem *problem,
                         const ps_device_limits *limits) {
    const size_t cores = ps_device_typical(limits).served_units;
    const unsigned dimension = problem->frequencies->dimension;
    const uint64_t part = ps_nufft_part_bytes(layout, dimension);
    layout->parts = ps_nufft_fitting_parts(problem, limits, (double)part, cores);
    layout->groups = choose_strip_groups(layout, cores);
    const uint64_t strips = layout->groups * layout->strips.strip_reals * layout->real_bytes;
    const uint64_t tiles = layout->groups * layout->strips.tile_reals * layout->real_bytes;
    layout->fixed_bytes = layout->parts * part + strips + tiles + ps_nufft_table_bytes(layout);
    const uint64_t buffers[] = {strips, tiles,
                                layout->parts * layout->part_places * dimension * sizeof(uint64_t)};
    layout->largest_buffer = ps_nufft_largest(buffers, sizeof buffers / sizeof buffers[0]);
}

static void measure(ps_nufft_layout *layout, const ps_problem *problem,
                    const ps_device_limits *limits) {
    layout->strips = ps_nufft_strips_measure(&layout->choice, layout->lanes);
    if (local_bytes(layout) > limits->local_bytes) {
        layout->lanes = 0;
        return;
    }
    ps_nufft_measure_axes(layout);
    layout->first_key = 1;
    layout->num_keys = layout->choice.axes[1].n;
    layout->bytes_per_realization = layout->stride * layout->real_bytes;
    layout->largest_buffer_per_realization = layout->bytes_per_realization;
    ps_nufft_set_part_points(layout, problem->num_points, limits);
    count_memory(layout, problem, limits);
    layout->host_bytes = layout->parts * layout->real_bytes * layout->part_places;
}

/* Sorting and all the rest. */
static double count_launches(const ps_nufft_layout *layout, double num_points,
                             double realizations) {
    (void)num_points;
    return 2 * ceil(realizations / (double)layout->parts);
}

static void describe(const ps_nufft_layout *layout, ps_text *text) {
    ps_text_append(text, " strips=%lu", (unsigned long)layout->strips.columns);
}

/* Kernels: the sort and strips.cl. */
const ps_nufft_variant ps_nufft_strips = {.on_cpus = true,
                                          .most_cells = PS_NUFFT_MOST_ROW_CELLS,
                                          .is_gridded = true,
                                          .are_alike = true,
                                          .offer = offer,
                                          .unit = unit,
                                          .complete = complete,
                                          .count = count,
                                          .measure = measure,
                                          .local_bytes = local_bytes,
                                          .slot = ps_nufft_tile_slot,
                                          .count_launches = count_launches,
                                          .programs = {2, 2},
                                          .describe = describe,
                                          .launcher = &ps_nufft_strips_launcher};

#include "engines/torus/nufft/measure.h"

#include "base/round.h"
#include "device/kind.h"
#include "device/reals.h"
#include "engines/torus/nufft/local.h"

#include <math.h>

/* Places and grids of the realizations that are worked on at a time: on CPUs a share of the
 * last-level cache, on GPUs enough to fill the device. */
static const double work_share = 0.25;
static const double gpu_work_bytes = 512.0 * 1024 * 1024;
enum { MOST_AT_ONCE = 1024 };

uint64_t ps_nufft_starts_bytes(const ps_nufft_layout *layout) {
    return ((uint64_t)layout->num_keys + 2) * sizeof(uint32_t);
}

uint64_t ps_nufft_part_bytes(const ps_nufft_layout *layout, unsigned dimension) {
    enum { COPIES = 3, BEGINNINGS = 4, MEANS = 2 };
    const uint64_t point = dimension * sizeof(uint64_t) + layout->real_bytes;
    return COPIES * layout->part_places * point + ps_nufft_starts_bytes(layout) +
           ps_nufft_order_bytes(&layout->order) + (BEGINNINGS + MEANS) * sizeof(uint64_t);
}

uint64_t ps_nufft_table_bytes(const ps_nufft_layout *layout) {
    enum { SMALL = 1536 };
    uint64_t bytes = 0;
    for (unsigned i = 0; i < layout->choice.num_axes; i++) {
        const ps_nufft_axis *axis = &layout->choice.axes[i];
        const uint64_t reals = 4 * (uint64_t)axis->n + (uint64_t)axis->max_frequency + 1;
        bytes += reals * layout->real_bytes + axis->n * sizeof(uint32_t) + SMALL;
    }
    return bytes;
}

uint64_t ps_nufft_largest(const uint64_t *numbers, size_t num) {
    uint64_t largest = 0;
    for (size_t i = 0; i < num; i++) {
        largest = numbers[i] > largest ? numbers[i] : largest;
    }
    return largest;
}

size_t ps_nufft_fitting_parts(const ps_problem *problem, const ps_device_limits *limits,
                              double each, size_t unit) {
    const double budget = limits->has_dedicated_local_memory
                              ? gpu_work_bytes
                              : work_share * ps_device_typical(limits).cache_bytes;
    const double fitting = fmin(budget / each, MOST_AT_ONCE);
    const size_t units = fitting > (double)unit ? (size_t)fitting / unit : 1;
    const uint64_t known = problem->num_realizations;
    return known > 0 && known < units * unit ? (size_t)known : units * unit;
}

void ps_nufft_measure_axes(ps_nufft_layout *layout) {
    const ps_nufft_choice *choice = &layout->choice;
    unsigned num_last = 0;
    const ps_nufft_axis *last = ps_nufft_last_axes(choice, &num_last);
    layout->num_tiles =
        layout->lanes > 0 ? (uint32_t)ps_divide_up(ps_nufft_tiled(choice), layout->lanes) : 0;
    layout->row_bytes = 0;
    layout->stride = (size_t)layout->num_tiles * layout->lanes;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const size_t bytes =
            ps_nufft_row_cells(&choice->axes[i]) * 2 * layout->lanes * layout->real_bytes;
        const size_t numbers = ps_nufft_pitch(&choice->axes[i]) + 2 * (size_t)layout->lanes + 2;
        layout->row_bytes = bytes > layout->row_bytes ? bytes : layout->row_bytes;
        layout->chunk_reals = PS_NUFFT_CHUNK * numbers;
    }
    for (unsigned i = 0; i < num_last; i++) {
        layout->stride *= 2 * (size_t)last[i].max_frequency + 1;
    }
    layout->line = ps_nufft_lines_measure(choice, layout->lanes);
    layout->first_line_power = layout->stride;
    layout->stride += layout->line.powers;
    layout->num_keys = choice->axes[0].n;
    if (num_last == 2) { /* in the order of cells, rows are filled from end to end */
        layout->num_keys = last[0].n * last[1].n;
        layout->grid_cells =
            (size_t)layout->num_tiles * last[0].n * (2 * (size_t)last[1].max_frequency + 1);
    }
}

/* Tiles of a work-group share windows and phases: what local memory holds, in groups of equal size,
 * but work for all cores. */
static uint32_t choose_group(const ps_nufft_layout *layout, const ps_problem *problem,
                             const ps_device_limits *limits) {
    uint64_t groups =
        ps_divide_up(layout->num_tiles, ps_nufft_fitting_tiles(layout, limits->local_bytes));
    const bool has_one = problem->num_realizations == 1 && layout->choice.num_axes == 1;
    const size_t cores = ps_device_typical(limits).served_units;
    groups = has_one && groups < cores ? cores : groups;
    return (uint32_t)ps_divide_up(layout->num_tiles, groups);
}

bool ps_nufft_measure_rows(ps_nufft_layout *layout, const ps_problem *problem,
                           const ps_device_limits *limits) {
    ps_nufft_measure_axes(layout);
    while (layout->lanes > 0 && ps_nufft_fitting_tiles(layout, limits->local_bytes) < 1) {
        layout->lanes /= 2;
        ps_nufft_measure_axes(layout);
    }
    if (layout->lanes == 0) {
        return false;
    }
    layout->group = choose_group(layout, problem, limits);
    layout->bytes_per_realization = layout->stride * layout->real_bytes;
    layout->largest_buffer_per_realization = layout->bytes_per_realization;
    return true;
}

void ps_nufft_set_part_points(ps_nufft_layout *layout, size_t part_points,
                              const ps_device_limits *limits) {
    layout->part_points = part_points;
    layout->part_places = ps_round_up(part_points, PS_NUFFT_PLACE_UNIT);
    layout->order =
        ps_nufft_order_measure(limits, part_points, layout->num_keys, layout->num_keys + 2);
}

#include "engines/torus/nufft/cost.h"

#include "base/round.h"
#include "engines/nufft/fft.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>

/* Two fused operations in a cycle. */
static const double flops_per_lane = 4;

/* Local memory for rows to choose for, whatever the device has; the rest is for a chunk of points.
 */
static const double nominal_local_bytes = (1 << 20) - (8 << 10);

void ps_nufft_add(ps_nufft_counts *counts, ps_nufft_part part, double num) {
    counts->num[part] += num;
}

void ps_nufft_add_transforms(ps_nufft_counts *counts, double num, uint32_t length) {
    ps_nufft_add(counts, PS_NUFFT_OPERATION, num * ps_fft_flops(length));
    ps_nufft_add(counts, PS_NUFFT_PASSED, num * ps_fft_passed(length));
}

double ps_nufft_rows_at_once(const ps_nufft_axis *axis) {
    const double vector_bytes = 64;
    return nominal_local_bytes / (2 * vector_bytes * axis->n);
}

double ps_nufft_num_tiles(const ps_nufft_choice *choice) {
    const ps_nufft_axis *last = &choice->axes[choice->num_axes - 1];
    const double narrower = ceil(1 / fmin(1, ps_nufft_rows_at_once(last)));
    return (double)ps_divide_up(ps_nufft_tiled(choice), choice->lanes) * narrower;
}

void ps_nufft_add_tiles(ps_nufft_counts *counts, const ps_nufft_choice *choice, double num_points) {
    unsigned num = 0;
    const ps_nufft_axis *axes = ps_nufft_last_axes(choice, &num);
    const ps_nufft_axis *last = &axes[num - 1];
    const double num_tiles = ps_nufft_num_tiles(choice);
    const double kept = 2.0 * last->max_frequency + 1;
    const double rows = num_tiles * (num == 1 ? 1 : axes[0].n);
    ps_nufft_add(counts, PS_NUFFT_SORTED, num_points);
    ps_nufft_add_transforms(counts, rows, last->n);
    ps_nufft_add(counts, PS_NUFFT_CLEARED, rows * last->n);
    ps_nufft_add(counts, PS_NUFFT_POWER, rows * kept);
    if (num > 1) {
        ps_nufft_add_transforms(counts, num_tiles * kept, axes[0].n);
        ps_nufft_add(counts, PS_NUFFT_POWER, num_tiles * kept * kept);
    }
}

double ps_nufft_cells_of_row(const ps_nufft_axis *axis, ps_precision precision) {
    enum { OF_DOUBLES = 12 };
    const bool is_short = precision == PS_DOUBLE && axis->window.width <= OF_DOUBLES;
    return fmin(ps_nufft_bins(axis), is_short ? OF_DOUBLES : HUGE_VAL);
}

double ps_nufft_polynomials(const ps_nufft_choice *choice) {
    double sum = 0;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const ps_nufft_axis *axis = &choice->axes[i];
        const double mirrored = i + 1 < choice->num_axes ? 2 : 1;
        sum += (axis->window.width + 2.0) * ps_nufft_bins(axis) / (choice->lanes * mirrored);
    }
    return sum;
}

/* ---- all --------------------------------------------------------------------------------- */

ps_nufft_counts ps_nufft_count(const ps_nufft_choice *choice, ps_precision precision,
                               double num_points) {
    ps_nufft_counts counts = {{0}};
    choice->variant->count(&counts, choice, precision, num_points);
    return counts;
}

double ps_nufft_cycles_of(const ps_nufft_counts *counts) {
    double cycles = 0;
    for (size_t i = 0; i < PS_NUFFT_NUM_PARTS; i++) {
        cycles += ps_nufft_cycles[i] * counts->num[i];
    }
    return cycles;
}

static double flops_of(const ps_nufft_counts *counts, const ps_nufft_choice *choice) {
    return ps_nufft_cycles_of(counts) * choice->lanes * flops_per_lane;
}

double ps_nufft_flops(const ps_nufft_choice *choice, ps_precision precision, double num_points) {
    const ps_nufft_counts counts = ps_nufft_count(choice, precision, num_points);
    return flops_of(&counts, choice);
}

/* The part of a nominal GPU that has work while points are spread on its grid: a box is added to by
 * one work-group, and an H200 is taken to want two for each of its 132 processors (predicted, not
 * measured). */
static double busy_share(const ps_nufft_layout *layout) {
    enum { NOMINAL_GROUPS = 2 * 132 };
    const double groups = (double)layout->parts * (double)ps_nufft_grid_boxes(&layout->grid);
    return layout->grid.num_passes > 0 ? fmin(1, groups / NOMINAL_GROUPS) : 1;
}

double ps_nufft_flops_of_layout(const ps_nufft_layout *layout, ps_precision precision,
                                double num_points) {
    ps_nufft_counts counts = ps_nufft_count(&layout->choice, precision, num_points);
    counts.num[PS_NUFFT_GPU_POINT] /= busy_share(layout);
    counts.num[PS_NUFFT_GPU_STEP] /= busy_share(layout);
    return flops_of(&counts, &layout->choice);
}

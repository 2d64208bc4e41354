#include "jobs/spectrum/power_sets.h"

#include <math.h>

void ps_axis_cells_add(ps_axis_cells *cells, const pspec_pattern *block) {
    cells->dimension = block->dimension;
    cells->num_points += block->num_points;
    for (size_t j = 0; j < block->num_points; j++) {
        for (unsigned axis = 0; axis < block->dimension; axis++) {
            const double x = block->points[j * block->dimension + axis];
            if (x >= 0 && x < 1) { /* others are refused by who checks them */
                cells->has_point[axis][(size_t)(x * PS_AXIS_CELLS)] = true;
            }
        }
    }
}

/* Cells of the longest run without a point, around the end; *first is its first one. */
static size_t find_run(const bool *has_point, size_t *first) {
    size_t longest = 0;
    size_t run = 0;
    for (size_t i = 0; i < 2 * (size_t)PS_AXIS_CELLS; i++) {
        run = has_point[i % PS_AXIS_CELLS] ? 0 : run + 1;
        if (run > longest && run <= PS_AXIS_CELLS) {
            longest = run;
            *first = (i + 1 - run) % PS_AXIS_CELLS;
        }
    }
    return longest;
}

/* Of N uniform points one is followed by an empty piece of length g with probability (1 - g)^(N -
 * 1): at most N times that for any, on any of d axes. */
static bool is_rare(double length, uint64_t num_points, unsigned dimension) {
    const double least = 1e-9;
    const double num = (double)num_points;
    return log(num * dimension) + (num - 1) * log1p(-length) < log(least);
}

bool ps_axis_cells_find_empty(const ps_axis_cells *cells, ps_empty_axis *out) {
    const double notable = 0.1;
    size_t longest = 0;
    for (unsigned axis = 0; axis < cells->dimension; axis++) {
        size_t first = 0;
        const size_t run = find_run(cells->has_point[axis], &first);
        if (run > longest && run < PS_AXIS_CELLS) {
            longest = run;
            *out = (ps_empty_axis){axis, (double)first / PS_AXIS_CELLS,
                                   (double)((first + run - 1) % PS_AXIS_CELLS + 1) / PS_AXIS_CELLS};
        }
    }
    const double length = (double)longest / PS_AXIS_CELLS;
    return length > notable && is_rare(length, cells->num_points, cells->dimension);
}

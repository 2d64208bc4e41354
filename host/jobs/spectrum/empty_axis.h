/* Do points leave a piece of an axis empty, as points of a smaller box do? */
#ifndef PS_JOBS_SPECTRUM_EMPTY_AXIS_H
#define PS_JOBS_SPECTRUM_EMPTY_AXIS_H

#include "frequencies/frequencies.h"

#include <stdbool.h>
#include <stdint.h>

enum { PS_AXIS_CELLS = 256 };

/* Which cells of every axis of the unit cube have a point; {0} before the first. */
typedef struct ps_axis_cells {
    unsigned dimension;
    uint64_t num_points;
    bool has_point[PS_MAX_DIMENSION][PS_AXIS_CELLS];
} ps_axis_cells;

/* A piece of an axis from `begin` to `end`, which is below `begin` where it goes on at 0. */
typedef struct ps_empty_axis {
    unsigned axis; /* from 0 on */
    double begin, end;
} ps_empty_axis;

/* Points of the torus. */
void ps_axis_cells_add(ps_axis_cells *cells, const pspec_pattern *block);
/* The longest empty piece, where it is more than a tenth of its axis and where as many uniform
 * points leave so long a one on any axis with a probability below 1e-9. */
bool ps_axis_cells_find_empty(const ps_axis_cells *cells, ps_empty_axis *out);

#endif

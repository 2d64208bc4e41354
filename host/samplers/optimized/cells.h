/* Power cells of points of the unit torus of the plane, by clipping: each site against the periodic
 * images of others, nearest first by squares of a grid, until no further one can reach its cell.
 *
 * Sites lie in the order of the grid, so that those of neighbouring squares are neighbours in
 * memory. Only + - * / sqrt decide, in the order written: same points, same cells on any machine.
 */
#ifndef PS_SAMPLERS_OPTIMIZED_CELLS_H
#define PS_SAMPLERS_OPTIMIZED_CELLS_H

#include "base/status.h"
#include "samplers/optimized/cells_polygon.h"

#include <stddef.h>

/* From how many points on the optimisers that stand on these cells work, and up to how many a site
 * with its images has a number of 32 bits. */
enum { PS_CELLS_LEAST_POINTS = 16, PS_CELLS_MOST_POINTS = 1 << 28 };

typedef struct ps_power_cells {
    size_t num;
    unsigned side;      /* squares along an axis */
    double *x, *y, *w;  /* sites in [0,1)^2 and their weights, in the order of the squares */
    uint32_t *first;    /* of square column + side * row; [side * side + 1] */
    double most_weight; /* the largest of w, for the clipper */
    double *spare[3];   /* of x, y and w while they are sorted */
    uint32_t *square;   /* of a site */
} ps_power_cells;

/* Refuses a number of points outside the limits with a sentence. */
pspec_status ps_power_cells_check(size_t num, ps_error *error) PS_MUST_CHECK;

/* What ps_power_cells_create allocates. */
double ps_power_cells_bytes(size_t num);

/* Takes points [num][2] of [0,1)^2, with weights 0. */
pspec_status ps_power_cells_create(ps_power_cells *cells, size_t num, const double *points,
                                   ps_error *error) PS_MUST_CHECK;
void ps_power_cells_destroy(ps_power_cells *cells);

/* Puts sites, which may have moved, in the order of the squares again, weights with them. */
void ps_power_cells_sort(ps_power_cells *cells);
/* After a change of weights. */
void ps_power_cells_weigh(ps_power_cells *cells);

/* A place on the axis put back into [0,1) by at most one period, which *period counts: x' = x + p.
 */
static inline double ps_power_cells_wrap(double x, int *period) {
    const int p = x < 0 ? 1 : x >= 1 ? -1 : 0;
    const double wrapped = x + p;
    *period = wrapped >= 1 ? 0 : p;
    return wrapped >= 1 ? 0 : wrapped;
}

/* The cell of site i. known[num_known] are images of which it is likely, but need not be true, that
 * they are its neighbours: the cell is the same without them, but for rounding, and takes longer.
 * Of sites at one place with equal weights the first has the cell and the others are empty. */
void ps_power_cells_clip(const ps_power_cells *cells, size_t i, const ps_image *known,
                         size_t num_known, ps_cell *cell);

/* The sentence for a cell that has_no_room. */
pspec_status ps_power_cells_fail_room(const ps_power_cells *cells, size_t i,
                                      ps_error *error) PS_MUST_CHECK;

#endif

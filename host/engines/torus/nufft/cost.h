/* How many parts of each kind a realization of a choice has, and what that costs by the table of
 * cycles.h. What variants count in common is here, the rest in their folders.
 */
#ifndef PS_ENGINES_TORUS_NUFFT_COST_H
#define PS_ENGINES_TORUS_NUFFT_COST_H

#include "engines/nufft/cycles.h"
#include "engines/torus/nufft/layout.h"

typedef struct ps_nufft_counts {
    double num[PS_NUFFT_NUM_PARTS];
} ps_nufft_counts;

/* How many there are in one realization of num_points points. */
ps_nufft_counts ps_nufft_count(const ps_nufft_choice *choice, ps_precision precision,
                               double num_points);
double ps_nufft_cycles_of(const ps_nufft_counts *counts);

/* What a device of its lanes would do at its peak while it works on one realization of num_points
 * points. */
double ps_nufft_flops(const ps_nufft_choice *choice, ps_precision precision, double num_points);
/* The same with what of a GPU idles where sets have few boxes; for choices among engines: grids and
 * windows are chosen by the other. */
double ps_nufft_flops_of_layout(const ps_nufft_layout *layout, ps_precision precision,
                                double num_points);

/* ---- parts of several variants ----------------------------------------------------------- */

/* Bytes of cells and rows of grids are counted in these. */
enum { PS_NUFFT_WORD_BYTES = 4 };

void ps_nufft_add(ps_nufft_counts *counts, ps_nufft_part part, double num);
/* num transforms of a length. */
void ps_nufft_add_transforms(ps_nufft_counts *counts, double num, uint32_t length);

/* Rows of an axis that fit into local memory; less than 1 where tiles must be narrower. */
double ps_nufft_rows_at_once(const ps_nufft_axis *axis);
/* Tiles, as narrow as they must be. */
double ps_nufft_num_tiles(const ps_nufft_choice *choice);
/* Sorting, and transforms of the rows of the tiles, all the way to powers. */
void ps_nufft_add_tiles(ps_nufft_counts *counts, const ps_nufft_choice *choice, double num_points);

/* Cells of a row that a point is added to, kernels/nufft/chunk.h. */
double ps_nufft_cells_of_row(const ps_nufft_axis *axis, ps_precision precision);
/* Polynomials of the windows of a point on all axes, in vectors; mirrored ones count half. */
double ps_nufft_polynomials(const ps_nufft_choice *choice);

#endif

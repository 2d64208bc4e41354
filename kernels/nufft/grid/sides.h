/* Boxes of the grid with the cells behind them that windows touch, one behind the other: a
 * tile. Sizes are compiled in, since every cell is found by them. Device only. */
#ifndef PS_NUFFT_GRID_SIDES_H
#define PS_NUFFT_GRID_SIDES_H

#include "nufft/grid/grid.h"

#ifndef DIMENSION
#define DIMENSION 2
#endif
/* Cells of a box along an axis, powers of 2, and of a window. */
#ifndef EDGE_0
#define EDGE_0 1
#endif
#ifndef EDGE_1
#define EDGE_1 16
#endif
#ifndef EDGE_2
#define EDGE_2 16
#endif
#ifndef WIDTH_0
#define WIDTH_0 1
#endif
#ifndef WIDTH_1
#define WIDTH_1 6
#endif
#ifndef WIDTH_2
#define WIDTH_2 6
#endif

#define SIDE_0 (EDGE_0 + WIDTH_0 - 1)
#define SIDE_1 (EDGE_1 + WIDTH_1 - 1)
#define SIDE_2 (EDGE_2 + WIDTH_2 - 1)
#define TILE_CELLS (SIDE_0 * SIDE_1 * SIDE_2)

/* Sums of many points are kept in pairs of numbers. */
#ifndef PAIRS
#define PAIRS 0
#endif

#endif

/* Cells of points on the sphere, and what stands for the points of a cell. Private to the files
 * distance_*.c. */
#ifndef PS_RULES_DISTANCE_CELLS_H
#define PS_RULES_DISTANCE_CELLS_H

#include "math/sobolev.h"
#include "rules/worst_case_error.h"

#include <stdint.h>

/* Chebyshev points in a row of a cell; their squares are two chunks. With 16 of them and cells as
 * far apart as distance_split.c says, the sum is off by less than rounding. */
enum { PS_CELL_NODES = 16, PS_CELL_PROXIES = PS_CELL_NODES * PS_CELL_NODES };
/* A cell with more points is cut, but not below this level, where its side is 2^-15. */
enum { PS_CELL_MOST = 512, PS_CELL_LEVELS = 16 };
/* Cells above this level have no proxies: their sides are too long for polynomials on the cube to
 * follow the sphere. */
enum { PS_CELL_FLAT = 2 };

typedef struct ps_cell {
    size_t begin, end;           /* points, in the order of the cells */
    size_t children;             /* the first of them */
    unsigned num_children;       /* 0: a leaf */
    unsigned level, face;        /* 0: a whole face of the cube */
    uint32_t a, b;               /* the square of a face, in units of its side */
    double centre[3], radius;    /* every point is at most so far from the centre */
    size_t points, num_points;   /* chunks: of a leaf */
    size_t proxies, num_proxies; /* chunks: of a cell with more points than proxies */
} ps_cell;

typedef struct ps_cells {
    ps_cell *cells;
    size_t num, num_chunks;
    ps_sobolev_chunk *chunks;
    size_t *order;  /* [num_points]: the point that is at a place */
    size_t largest; /* points of a leaf */
} ps_cells;

/* Freed by ps_cells_free, also after an error. */
pspec_status ps_cells_create(ps_cells *out, const ps_rule *rule, ps_error *error) PS_MUST_CHECK;
void ps_cells_free(ps_cells *cells);

/* Fills the chunks. */
pspec_status ps_cells_fill(ps_cells *cells, const ps_rule *rule, ps_error *error) PS_MUST_CHECK;

#endif

/* Power cells of points of the unit torus of the plane, by clipping: each site against the periodic
 * images of others, nearest first by squares of a grid, until no further one can reach its cell.
 *
 * Sites lie in the order of the grid, so that those of neighbouring squares are neighbours in
 * memory. Only + - * / sqrt decide, in the order written: same points, same cells on any machine.
 */
#ifndef PS_SAMPLERS_OPTIMIZED_CELLS_H
#define PS_SAMPLERS_OPTIMIZED_CELLS_H

#include "base/status.h"

#include <stddef.h>
#include <stdbool.h>
#include <stdint.h>

/* One power cell of a torus: a convex polygon around its site that half planes cut smaller.
 *
 * The cell of site i is where |p - x_i|^2 - w_i is least, over all periodic images of all sites.
 * Its own images confine it to the square of side 1 around the site, from which it starts. An image
 * further than 1 along an axis is never nearer to a place of that square than the same site's image
 * one period back, whatever the weights: nine images of each site are all that matter.
 */

/* Edges that a cell may have. Cells of random points have 6 on average and more than 20 with a
 * probability below 1e-11; a hundred points on a circle around one need this room. */
enum { PS_CELL_MOST_EDGES = 256 };

/* A periodic image of a site: 16 times its number, plus 3 (a + 1) + (b + 1) for the one at
 * x + (a, b), a and b in -1..1. */
typedef uint32_t ps_image;
enum { PS_IMAGES_OF_SITE = 16, PS_IMAGE_ITSELF = 4 };

static inline ps_image ps_image_of(uint32_t site, int a, int b) {
    return site * PS_IMAGES_OF_SITE + (uint32_t)(3 * (a + 1) + b + 1);
}
static inline uint32_t ps_image_site(ps_image image) {
    return image / PS_IMAGES_OF_SITE;
}
static inline int ps_image_a(ps_image image) {
    return (int)(image % PS_IMAGES_OF_SITE / 3) - 1;
}
static inline int ps_image_b(ps_image image) {
    return (int)(image % PS_IMAGES_OF_SITE % 3) - 1;
}

/* Vertices anticlockwise, relative to the site; none: the cell is empty. neighbour[k] is beyond the
 * edge from vertex k to the next. */
typedef struct ps_polygon {
    unsigned num;
    double x[PS_CELL_MOST_EDGES], y[PS_CELL_MOST_EDGES];
    ps_image neighbour[PS_CELL_MOST_EDGES];
} ps_polygon;

/* A cell being made: a cut goes from one polygon to the other. */
typedef struct ps_cell {
    ps_polygon polygons[2];
    unsigned current;
    double reach2;    /* the largest |v|^2 of a vertex v; 0 where there is none */
    bool has_no_room; /* a cut was left out since the cell has too many edges */
} ps_cell;

static inline const ps_polygon *ps_cell_polygon(const ps_cell *cell) {
    return &cell->polygons[cell->current];
}

/* The square of side 1 around a site. */
void ps_cell_start(ps_cell *cell, uint32_t site);

/* Keeps the places p with p.(dx,dy) <= height, of a neighbour at (dx,dy). */
void ps_cell_cut(ps_cell *cell, double dx, double dy, double height, ps_image neighbour);

/* Can a half plane with that height of a neighbour at distance sqrt(d2) reach the cell at all? */
static inline bool ps_cell_is_reached(const ps_cell *cell, double d2, double height) {
    return height <= 0 || height * height < cell->reach2 * d2;
}

/* Is the neighbour beyond an edge of the polygon? */
bool ps_polygon_has(const ps_polygon *polygon, ps_image neighbour);

/* The site and those moments of a cell that optimisers want, relative to the site. */
typedef struct ps_cell_moments {
    double area;
    double x, y; /* centroid; 0 of an empty cell */
} ps_cell_moments;

ps_cell_moments ps_polygon_moments(const ps_polygon *polygon);

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

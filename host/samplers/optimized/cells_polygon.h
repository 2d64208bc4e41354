/* One power cell of a torus: a convex polygon around its site that half planes cut smaller.
 *
 * The cell of site i is where |p - x_i|^2 - w_i is least, over all periodic images of all sites.
 * Its own images confine it to the square of side 1 around the site, from which it starts. An image
 * further than 1 along an axis is never nearer to a place of that square than the same site's image
 * one period back, whatever the weights: nine images of each site are all that matter.
 */
#ifndef PS_SAMPLERS_OPTIMIZED_CELLS_POLYGON_H
#define PS_SAMPLERS_OPTIMIZED_CELLS_POLYGON_H

#include <stdbool.h>
#include <stdint.h>

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

#endif

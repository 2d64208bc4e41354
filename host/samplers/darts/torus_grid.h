/* Points of the torus in cells so small that each holds one of them at most, for the question
 * whether a place is at least a radius away from all of them.
 */
#ifndef PS_SAMPLERS_DARTS_TORUS_GRID_H
#define PS_SAMPLERS_DARTS_TORUS_GRID_H

#include "base/status.h"
#include "samplers/darts/distance.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PS_GRID_LEAST_DIMENSION = 2, PS_GRID_MOST_DIMENSION = 4 };

/* The g cells of an axis with `reach` more on both sides: which cell of the torus each of them is,
 * and how much is to be added to the coordinates of its point. */
typedef struct ps_grid_wrap {
    uint32_t cell;
    int shift;
} ps_grid_wrap;

/* A cell of the neighbourhood, seen from the middle. */
typedef struct ps_grid_offset {
    int of_axis[PS_GRID_MOST_DIMENSION];
    ptrdiff_t cells; /* where nothing is wrapped */
    int gap;         /* square of the least distance to the middle cell, in sides of a cell */
} ps_grid_offset;

typedef struct ps_grid_offsets {
    size_t num;
    ps_grid_offset *items; /* the middle first, then by distance */
    int reach;             /* along an axis */
} ps_grid_offsets;

/* Axis 0 is the slowest. A place is what coordinates and radius say, without further rounding:
 * differences are x - x' and then a whole number more. */
typedef struct ps_torus_grid {
    unsigned dimension;
    uint32_t num_side; /* g = ceil(sqrt(d)/r), so that the diagonal of a cell is not above r */
    size_t num_cells;
    double square_radius;
    const double *points; /* [..][dimension], of the caller */
    uint32_t *numbers;    /* of the points in the cells, from 1; 0: none */
    ps_grid_offsets near; /* cells that a disk around a place in the middle cell may reach */
    ps_grid_offsets wide; /* the same for a disk of so many radii as were asked for */
    int reach;            /* of the wider of the two */
    ps_grid_wrap *wraps;
    size_t strides[PS_GRID_MOST_DIMENSION];
} ps_torus_grid;

/* Cells and points have numbers of 32 bits: a radius that needs more than 2^32 cells is refused. */
pspec_status ps_torus_grid_check(unsigned dimension, double radius, ps_error *error) PS_MUST_CHECK;

/* An empty grid over points that will be written to the array, with a wide neighbourhood of so many
 * radii unless that is 0. The radius is positive and at most sqrt(d)/2, and ps_torus_grid_check
 * lets it pass. ps_torus_grid_free also after an error. */
pspec_status ps_torus_grid_create(ps_torus_grid *grid, unsigned dimension, double radius,
                                  double wide_radii, const double *points,
                                  ps_error *error) PS_MUST_CHECK;
void ps_torus_grid_free(ps_torus_grid *grid);

/* The cell of a place in [0,1)^d by its indices along the axes. */
size_t ps_torus_grid_cell(const ps_torus_grid *grid, const uint32_t *indices);
void ps_torus_grid_indices(const ps_torus_grid *grid, size_t cell, uint32_t *indices);
/* Indices of the cell in which coordinates lie. */
void ps_torus_grid_locate(const ps_torus_grid *grid, const double *point, uint32_t *indices);

/* Point number i_point of the array now lies in this cell. */
static inline void ps_torus_grid_put(ps_torus_grid *grid, size_t cell, size_t i_point) {
    grid->numbers[cell] = (uint32_t)i_point + 1;
}

/* The number, or 0, of the point in the cell at this offset from a cell; shifts, one for each axis,
 * are to be added to its coordinates. */
static inline uint32_t ps_torus_grid_neighbour(const ps_torus_grid *grid, const uint32_t *indices,
                                               const ps_grid_offset *offset, int *shifts) {
    const ps_grid_wrap *const first = grid->wraps + grid->reach;
    size_t cell = 0;
    for (unsigned a = 0; a < grid->dimension; a++) {
        const ps_grid_wrap *const wrap = first + indices[a] + offset->of_axis[a];
        shifts[a] = wrap->shift;
        cell += wrap->cell * grid->strides[a];
    }
    return grid->numbers[cell];
}

/* Is every point at least the radius away from a place in this empty cell, and the cell empty? */
bool ps_torus_grid_is_free(const ps_torus_grid *grid, const uint32_t *indices, const double *place);

/* ---- least distances: from numbers of points and back --------------------------------------- */

/* A radius may be above 0 and up to sqrt(d)/2, the farthest that two points of [0,1)^d are apart,
 * wrapped. */
pspec_status ps_torus_radius_check(unsigned dimension, double radius,
                                   ps_error *error) PS_MUST_CHECK;

/* More points than this are never at the radius from each other: the densest packing of balls.
 * SIZE_MAX for radii that no grid has. */
size_t ps_torus_radius_most_points(const ps_blue_noise *asked);

/* x^exponent: the same bits on any machine, and so is the radius at which num_points make
 * N r^d = product, at most sqrt(d)/2. */
double ps_torus_radius_power(double x, unsigned exponent);
double ps_torus_radius_of(unsigned dimension, double product, size_t num_points);

#endif

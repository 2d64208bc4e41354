#include "samplers/darts/torus_grid.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <stdint.h>

static const double MOST_CELLS = 0x1p32; /* cells and points have numbers of 32 bits */

/* ---- the neighbourhood --------------------------------------------------------------------- */

static int gap_of(const ps_grid_offset *offset, unsigned dimension) {
    int gap = 0;
    for (unsigned a = 0; a < dimension; a++) {
        const int between = abs(offset->of_axis[a]) - 1;
        gap += between > 0 ? between * between : 0;
    }
    return gap;
}

static int square_of(const ps_grid_offset *offset) {
    int square = 0;
    for (unsigned a = 0; a < PS_GRID_MOST_DIMENSION; a++) {
        square += offset->of_axis[a] * offset->of_axis[a];
    }
    return square;
}

/* By distance of the centres, since near cells are the likeliest to refuse a place; then by axes,
 * so that any sort gives one order. */
static int compare_offsets(const void *a, const void *b) {
    const ps_grid_offset *const x = (const ps_grid_offset *)a;
    const ps_grid_offset *const y = (const ps_grid_offset *)b;
    const int difference = square_of(x) - square_of(y);
    for (unsigned i = 0; difference == 0 && i < PS_GRID_MOST_DIMENSION; i++) {
        if (x->of_axis[i] != y->of_axis[i]) {
            return x->of_axis[i] - y->of_axis[i];
        }
    }
    return difference;
}

/* Number i of the (2 reach + 1)^d cells around the middle. */
static ps_grid_offset offset_of_number(const ps_torus_grid *grid, int reach, size_t i) {
    const size_t width = 2 * (size_t)reach + 1;
    ps_grid_offset offset = {{0}, 0, 0};
    for (unsigned a = grid->dimension; a-- > 0; i /= width) {
        offset.of_axis[a] = (int)(i % width) - reach;
        offset.cells += offset.of_axis[a] * (ptrdiff_t)grid->strides[a];
    }
    offset.gap = gap_of(&offset, grid->dimension);
    return offset;
}

static pspec_status make_offsets(const ps_torus_grid *grid, double radius, ps_grid_offsets *out,
                                 ps_error *error) {
    const double reach = radius * grid->num_side; /* in cells */
    size_t num = 1;
    out->reach = (int)ceil(reach);
    for (unsigned a = 0; a < grid->dimension; a++) {
        num *= 2 * (size_t)out->reach + 1;
    }
    PS_TRY(PS_NEW(&out->items, num, "neighbourhood", error));
    for (size_t i = 0; i < num; i++) {
        const ps_grid_offset offset = offset_of_number(grid, out->reach, i);
        if (offset.gap <= reach * reach) {
            out->items[out->num++] = offset;
        }
    }
    qsort(out->items, out->num, sizeof *out->items, compare_offsets);
    return PSPEC_OK;
}

/* A neighbourhood wider than the torus has cells more than once: every image counts by itself. */
static pspec_status make_wraps(ps_torus_grid *grid, ps_error *error) {
    const int num_side = (int)grid->num_side;
    const int num = num_side + 2 * grid->reach;
    PS_TRY(PS_NEW(&grid->wraps, (size_t)num, "cells of an axis", error));
    for (int i = 0; i < num; i++) {
        const int cell = i - grid->reach;
        const int shift = cell < 0 ? -((-cell + num_side - 1) / num_side) : cell / num_side;
        grid->wraps[i] = (ps_grid_wrap){(uint32_t)(cell - shift * num_side), shift};
    }
    return PSPEC_OK;
}

/* ---- the grid ------------------------------------------------------------------------------ */

static double side_of(unsigned dimension, double radius) {
    return ceil(sqrt(dimension) / radius);
}

pspec_status ps_torus_grid_check(unsigned dimension, double radius, ps_error *error) {
    double num_cells = 1;
    for (unsigned a = 0; a < dimension; a++) {
        num_cells *= side_of(dimension, radius);
    }
    if (num_cells <= MOST_CELLS) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "radius %g needs %.3g cells in %u dimensions, more than 2^32", radius, num_cells,
                   dimension);
}

pspec_status ps_torus_grid_create(ps_torus_grid *grid, unsigned dimension, double radius,
                                  double wide_radii, const double *points, ps_error *error) {
    *grid =
        (ps_torus_grid){.dimension = dimension, .square_radius = radius * radius, .points = points};
    PS_TRY(ps_torus_grid_check(dimension, radius, error));
    grid->num_side = (uint32_t)side_of(dimension, radius);
    grid->num_cells = 1;
    for (unsigned a = dimension; a-- > 0;) {
        grid->strides[a] = grid->num_cells;
        grid->num_cells *= grid->num_side;
    }
    PS_TRY(make_offsets(grid, radius, &grid->near, error));
    if (wide_radii > 0) {
        PS_TRY(make_offsets(grid, wide_radii * radius, &grid->wide, error));
    }
    grid->reach = grid->near.reach > grid->wide.reach ? grid->near.reach : grid->wide.reach;
    PS_TRY(make_wraps(grid, error));
    return PS_NEW(&grid->numbers, grid->num_cells, "cells", error);
}

void ps_torus_grid_free(ps_torus_grid *grid) {
    free(grid->near.items);
    free(grid->wide.items);
    free(grid->wraps);
    free(grid->numbers);
    *grid = (ps_torus_grid){0};
}

size_t ps_torus_grid_cell(const ps_torus_grid *grid, const uint32_t *indices) {
    size_t cell = 0;
    for (unsigned a = 0; a < grid->dimension; a++) {
        cell += indices[a] * grid->strides[a];
    }
    return cell;
}

void ps_torus_grid_indices(const ps_torus_grid *grid, size_t cell, uint32_t *indices) {
    uint32_t rest = (uint32_t)cell; /* fewer than 2^32, whose division is faster */
    for (unsigned a = grid->dimension; a-- > 0; rest /= grid->num_side) {
        indices[a] = rest % grid->num_side;
    }
}

void ps_torus_grid_locate(const ps_torus_grid *grid, const double *point, uint32_t *indices) {
    for (unsigned a = 0; a < grid->dimension; a++) {
        const uint32_t index = (uint32_t)(point[a] * grid->num_side);
        indices[a] = index < grid->num_side ? index : grid->num_side - 1; /* rounded up */
    }
}

/* ---- places -------------------------------------------------------------------------------- */

/* The dimension is a constant where this is inlined. */
static inline bool is_near(const ps_torus_grid *grid, const unsigned dimension, uint32_t number,
                           const double *place, const int *shifts) {
    const double *const point = grid->points + (size_t)(number - 1) * dimension;
    double square = 0;
    for (unsigned a = 0; a < dimension; a++) {
        const double difference = (place[a] - point[a]) - shifts[a];
        square += difference * difference;
    }
    return square < grid->square_radius;
}

static inline bool is_inside(const ps_torus_grid *grid, const unsigned dimension,
                             const uint32_t *indices) {
    const uint32_t reach = (uint32_t)grid->near.reach;
    bool is = true;
    for (unsigned a = 0; a < dimension; a++) {
        is = is && indices[a] >= reach && indices[a] + reach < grid->num_side;
    }
    return is;
}

static inline bool is_free_inside(const ps_torus_grid *grid, const unsigned dimension,
                                  const uint32_t *middle, const double *place) {
    static const int none[PS_GRID_MOST_DIMENSION] = {0};
    for (size_t i = 1; i < grid->near.num; i++) {
        const uint32_t number = middle[grid->near.items[i].cells];
        if (number != 0 && is_near(grid, dimension, number, place, none)) {
            return false;
        }
    }
    return true;
}

static inline bool is_free_at_edge(const ps_torus_grid *grid, const unsigned dimension,
                                   const uint32_t *indices, const double *place) {
    for (size_t i = 1; i < grid->near.num; i++) {
        int shifts[PS_GRID_MOST_DIMENSION];
        const uint32_t number =
            ps_torus_grid_neighbour(grid, indices, grid->near.items + i, shifts);
        if (number != 0 && is_near(grid, dimension, number, place, shifts)) {
            return false;
        }
    }
    return true;
}

static inline bool is_free(const ps_torus_grid *grid, const unsigned dimension,
                           const uint32_t *indices, const double *place) {
    const uint32_t *const middle = grid->numbers + ps_torus_grid_cell(grid, indices);
    if (*middle != 0) {
        return false;
    }
    return is_inside(grid, dimension, indices) ? is_free_inside(grid, dimension, middle, place)
                                               : is_free_at_edge(grid, dimension, indices, place);
}

bool ps_torus_grid_is_free(const ps_torus_grid *grid, const uint32_t *indices,
                           const double *place) {
    switch (grid->dimension) {
    case 2:
        return is_free(grid, 2, indices, place);
    case 3:
        return is_free(grid, 3, indices, place);
    default:
        return is_free(grid, PS_GRID_MOST_DIMENSION, indices, place);
    }
}

/* ---- least distances ------------------------------------------------------------------------- */

/* N r^d of the densest packings, rounded up: hexagonal, face-centred cubic, and in four dimensions
 * the bound of H. Cohn and N. Elkies (2003). */
static const double PACKED[PS_GRID_MOST_DIMENSION + 1] = {0, 0, 1.15471, 1.41422, 2.1003};

double ps_torus_radius_power(double x, unsigned exponent) {
    double product = 1;
    for (unsigned i = 0; i < exponent; i++) {
        product *= x;
    }
    return product;
}

static double largest(unsigned dimension) {
    return sqrt(dimension) / 2;
}

/* x^(1/d) for x in (0,1] by Newton's method from above: unlike pow(), the same bits on any machine.
 * At first a step takes the share 1/d away, so 200 reach any x that a number of points makes. */
static double root(double x, unsigned dimension) {
    enum { STEPS = 200 };
    double y = 1;
    for (unsigned i = 0; i < STEPS; i++) {
        y -= (y - x / ps_torus_radius_power(y, dimension - 1)) / dimension;
    }
    return y;
}

pspec_status ps_torus_radius_check(unsigned dimension, double radius, ps_error *error) {
    if (radius > 0 && radius <= largest(dimension)) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "radius %g is not above 0 and at most %g, which is the farthest that points of "
                   "the torus in %u dimensions are apart",
                   radius, largest(dimension), dimension);
}

size_t ps_torus_radius_most_points(const ps_blue_noise *asked) {
    const double most =
        PACKED[asked->dimension] / ps_torus_radius_power(asked->radius, asked->dimension);
    const double possible = 0x1p32; /* a grid has no more */
    return most < possible ? (size_t)most : SIZE_MAX;
}

double ps_torus_radius_of(unsigned dimension, double product, size_t num_points) {
    const double radius = root(product / (double)num_points, dimension);
    return radius < largest(dimension) ? radius : largest(dimension);
}

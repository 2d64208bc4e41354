#include "samplers/ccvt/ccvt.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* Cells are at most so many times the sites: those of the sphere lie in few of the cubes. */
enum { CELLS_PER_SITE = 4 };

static size_t cells_of(unsigned side, unsigned axes) {
    size_t cells = 1;
    for (unsigned a = 0; a < axes; a++) {
        cells *= side;
    }
    return cells;
}

pspec_status ps_ccvt_grid_create(ps_ccvt_grid *grid, ps_ccvt_room room, size_t num,
                                 ps_error *error) {
    *grid = (ps_ccvt_grid){.room = room, .num = num, .most_side = 1, .side = 1};
    while (cells_of(grid->most_side + 1, room.axes) <= CELLS_PER_SITE * num) {
        grid->most_side++;
    }
    PS_TRY(PS_NEW(&grid->first, cells_of(grid->most_side, room.axes) + 1, "cells of sites", error));
    PS_TRY(PS_NEW(&grid->sorted, num, "sites by cells", error));
    return PS_NEW(&grid->cell, num, "cells of sites", error);
}

void ps_ccvt_grid_destroy(ps_ccvt_grid *grid) {
    free(grid->first);
    free(grid->sorted);
    free(grid->cell);
    *grid = (ps_ccvt_grid){0};
}

/* A periodic grid of two cells would find the same cell on both sides. */
static unsigned choose_side(const ps_ccvt_grid *grid, double reach) {
    enum { LEAST_PERIODIC = 3 };
    const double fitting = grid->room.width / reach;
    const unsigned side = fitting < (double)grid->most_side ? (unsigned)fitting : grid->most_side;
    const unsigned least = grid->room.is_periodic ? LEAST_PERIODIC : 1;
    return side < least ? 1 : side;
}

/* Coordinates may be off the room by rounding. */
static unsigned column_of(const ps_ccvt_grid *grid, double x) {
    const double column = (x - grid->room.low) * grid->side / grid->room.width;
    return !(column > 0) ? 0 : column < grid->side ? (unsigned)column : grid->side - 1;
}

void ps_ccvt_grid_fill(ps_ccvt_grid *grid, double *const *site, double reach) {
    grid->side = choose_side(grid, reach);
    const size_t cells = cells_of(grid->side, grid->room.axes);
    memset(grid->first, 0, (cells + 1) * sizeof *grid->first);
    for (size_t i = 0; i < grid->num; i++) {
        uint32_t cell = 0;
        for (unsigned a = grid->room.axes; a-- > 0;) {
            cell = cell * grid->side + column_of(grid, site[a][i]);
        }
        grid->cell[i] = cell;
        grid->first[cell + 1]++;
    }
    for (size_t c = 0; c < cells; c++) {
        grid->first[c + 1] += grid->first[c];
    }
    for (size_t i = grid->num; i-- > 0;) { /* first[c + 1] goes down to the begin of cell c */
        grid->sorted[--grid->first[grid->cell[i] + 1]] = (uint32_t)i;
    }
    memmove(grid->first, grid->first + 1, cells * sizeof *grid->first);
    grid->first[cells] = (uint32_t)grid->num;
}

/* Column beside another, or side where there is none. */
static unsigned beside(const ps_ccvt_grid *grid, unsigned column, unsigned step) {
    const unsigned moved = column + step; /* by step - 1 */
    if (moved >= 1 && moved <= grid->side) {
        return moved - 1;
    }
    return !grid->room.is_periodic ? grid->side : moved == 0 ? grid->side - 1 : 0;
}

static size_t append_later(const ps_ccvt_grid *grid, uint32_t cell, uint32_t i, uint32_t *near) {
    size_t num = 0;
    for (uint32_t k = grid->first[cell]; k < grid->first[cell + 1]; k++) {
        near[num] = grid->sorted[k];
        num += grid->sorted[k] > i;
    }
    return num;
}

size_t ps_ccvt_grid_later(const ps_ccvt_grid *grid, uint32_t i, uint32_t *near) {
    enum { STEPS = 3 };
    const unsigned axes = grid->room.axes;
    const unsigned around = grid->side == 1 ? 1 : (unsigned)cells_of(STEPS, axes);
    size_t num = 0;
    if (around == 1) {
        return append_later(grid, 0, i, near);
    }
    for (unsigned k = 0; k < around; k++) {
        uint32_t rest = grid->cell[i];
        uint32_t cell = 0;
        uint32_t stride = 1;
        bool is_there = true;
        for (unsigned a = 0, steps = k; a < axes; a++, steps /= STEPS) {
            const unsigned column = beside(grid, rest % grid->side, steps % STEPS);
            is_there = is_there && column < grid->side;
            cell += column * stride;
            stride *= grid->side;
            rest /= grid->side;
        }
        num += is_there ? append_later(grid, cell, i, near + num) : 0;
    }
    return num;
}

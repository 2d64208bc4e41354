/* Sites in the cells of a grid, to find those about a site. */
#ifndef PS_SAMPLERS_CCVT_CCVT_GRID_H
#define PS_SAMPLERS_CCVT_CCVT_GRID_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PS_CCVT_AXES = 3 /* at most */ };

/* The square or cube that holds all coordinates. */
typedef struct ps_ccvt_room {
    unsigned axes;
    bool is_periodic;
    double low, width;
} ps_ccvt_room;

typedef struct ps_ccvt_grid {
    ps_ccvt_room room;
    size_t num;
    unsigned most_side, side; /* cells along an axis: room for, used now */
    uint32_t *first;          /* of a cell; [cells + 1] */
    uint32_t *sorted;         /* sites by cells */
    uint32_t *cell;           /* of a site */
} ps_ccvt_grid;

/* For num sites. ps_ccvt_grid_destroy also after an error. */
pspec_status ps_ccvt_grid_create(ps_ccvt_grid *grid, ps_ccvt_room room, size_t num,
                                 ps_error *error) PS_MUST_CHECK;
void ps_ccvt_grid_destroy(ps_ccvt_grid *grid);

/* Takes the sites as they are now, for distances up to reach. */
void ps_ccvt_grid_fill(ps_ccvt_grid *grid, double *const *site, double reach);

/* Numbers above i of all sites that may be within reach of site i, and of others. */
size_t ps_ccvt_grid_later(const ps_ccvt_grid *grid, uint32_t i, uint32_t *near);

#endif

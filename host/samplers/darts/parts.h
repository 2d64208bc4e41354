/* Dart throwing to saturation in any space that is made of cells of equal area, each of which can
 * be split into 2^d parts of equal area again and again.
 *
 * Places that may be free are kept as parts of one size, at first all cells. Darts are thrown into
 * parts chosen uniformly, which is uniform over all free places; then parts are split, and those
 * inside one disk dropped. What is left out is covered, so an accepted point is distributed as by
 * plain dart throwing.
 */
#ifndef PS_SAMPLERS_DARTS_PARTS_H
#define PS_SAMPLERS_DARTS_PARTS_H

#include "samplers/darts/distance.h"

#include <stdbool.h>
#include <stdint.h>

enum { PS_PARTS_MOST_DIMENSION = 3, PS_PARTS_MOST_WIDTH = 3 };

/* A part is at[] of its cell along each axis, in its own sides; side: the same in sides of the
 * cell, a power of 1/2. */
typedef struct ps_parts_space {
    unsigned dimension; /* of the cells, 2 or 3 */
    unsigned width;     /* numbers of a point, at most 3 */
    size_t num_cells;   /* at most 2^32 */
    void *self;
    /* The place at the uniform numbers [dimension] of a part, and whether it is free. */
    bool (*throw_dart)(void *self, uint32_t cell, const uint32_t *at, double side,
                       const double *uniforms, double *place);
    /* Point i_point was accepted in the cell. */
    void (*put)(void *self, uint32_t cell, size_t i_point);
    /* Parts of this cell will be split; false when all of it is covered. */
    bool (*enter)(void *self, uint32_t cell);
    /* Bit c: child c of that part, 2 at[a] + (c >> a & 1) on axis a, is not inside a disk. side is
     * that of the children. */
    unsigned (*open_children)(void *self, uint32_t cell, const uint32_t *at, double side);
} ps_parts_space;

/* Points [*num_points][width] in the order of their acceptance. expected: how many, for the watch.
 */
pspec_status ps_parts_saturate(const ps_parts_space *space, const ps_blue_noise *asked,
                               double expected, ps_random *random, double *points,
                               size_t *num_points, ps_error *error) PS_MUST_CHECK;

#endif

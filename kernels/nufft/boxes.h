/* Boxes of cells, by which points of a large set are sorted and spread: what kernels/nufft/sort.cl
 * and boxes.cl agree on with the host.
 *
 * An axis of n cells is cut into `boxes` of nearly equal length. per_cell is 2^32 boxes / n,
 * rounded up: box_of(n - 1) is boxes - 1 and box_begin(boxes) is n where n (n - 1) < 2^32 boxes.
 */
#ifndef PS_NUFFT_BOXES_H
#define PS_NUFFT_BOXES_H

#include "nufft/numbers.h"

#define BOX_AXES 3

static inline ps_u32 box_of(const ps_u32 cell, const ps_u32 per_cell) {
    return (ps_u32)(((ps_u64)cell * per_cell) >> 32);
}

static inline ps_u32 box_begin(const ps_u32 box, const ps_u32 per_cell) {
    return (ps_u32)((((ps_u64)box << 32) + per_cell - 1) / per_cell);
}

/* Boxes of a colour, whose windows meet no others of it, are those whose number is `colour` modulo
 * `colours` on every axis. */
typedef struct box_axis {
    window_numbers window;
    ps_u32 boxes, per_cell, colours, colour;
} box_axis;

typedef struct boxes_numbers {
    box_axis axes[BOX_AXES];
    ps_u32 rows, pitch; /* of a box in local memory: along axis 1, and numbers along axis 2 */
    ps_u32 num_parts;
    ps_u32 first_row, num_rows; /* cells of the first axis that the grid in this launch has */
    ps_u32 unused;              /* fills the size up to whole numbers of eight bytes */
} boxes_numbers;

SAME_SIZE(boxes_numbers, 120);

#endif

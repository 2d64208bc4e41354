/* Boxes of cells in which points of a large set are spread (kernels/nufft/boxes.cl). */
#ifndef PS_ENGINES_TORUS_NUFFT_SIZES_BOXES_H
#define PS_ENGINES_TORUS_NUFFT_SIZES_BOXES_H

#include "engines/torus/nufft/choice.h"

/* By the axes of the kernel: in two dimensions those of the grid are its axes 1 and 2, and axis 0
 * has one cell in one box. */
typedef struct ps_nufft_boxes {
    uint32_t num[PS_NUFFT_MAX_AXES], per_cell[PS_NUFFT_MAX_AXES]; /* kernels/nufft/boxes.h */
    /* Boxes of a colour share no cell; num is a multiple of them */
    uint32_t colours[PS_NUFFT_MAX_AXES];
    /* Numbers of the largest box with the cells behind it that windows touch */
    uint32_t sides[PS_NUFFT_MAX_AXES];
} ps_nufft_boxes;

/* The boxes of a grid of two or three axes; halvings: of their edges, for less local memory. */
ps_nufft_boxes ps_nufft_boxes_measure(const ps_nufft_choice *choice, unsigned halvings);

size_t ps_nufft_boxes_count(const ps_nufft_boxes *boxes);
/* Of one colour. */
size_t ps_nufft_boxes_of_colour(const ps_nufft_boxes *boxes);
size_t ps_nufft_boxes_reals(const ps_nufft_boxes *boxes);

#endif

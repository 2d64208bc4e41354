/* Sizes of the line of frequency 0 of axis 0 (kernels/nufft/line.h), and when a choice has one. */
#ifndef PS_ENGINES_TORUS_NUFFT_SIZES_LINES_H
#define PS_ENGINES_TORUS_NUFFT_SIZES_LINES_H

#include "engines/torus/nufft/choice.h"

typedef struct ps_nufft_line_sizes {
    size_t cells;        /* of a realization */
    size_t grid_reals;   /* between two transforms, of as many realizations as lanes */
    size_t powers;       /* of a realization, up to a whole vector */
    size_t spread_reals; /* local memory, in which points are added */
} ps_nufft_line_sizes;

/* lanes: those of the device, or fewer. All 0 where the choice has no line. */
ps_nufft_line_sizes ps_nufft_lines_measure(const ps_nufft_choice *choice, unsigned lanes);

/* Frequency 0 of axis 0 is a line of real numbers where it would be alone in a tile: for several
 * realizations, which share the transform of lines. Measured (Zen 4): 0.70 to 0.94 of the time
 * in three dimensions, 0.83 to 1.0 in two (docs/engines/torus_nufft.md). */
bool ps_nufft_lines_pay(const ps_nufft_choice *choice, const ps_problem *problem);

#endif

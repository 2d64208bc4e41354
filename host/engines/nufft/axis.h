/* One axis of a fine grid: its cells, its window, what follows from them.
 */
#ifndef PS_ENGINES_NUFFT_AXIS_H
#define PS_ENGINES_NUFFT_AXIS_H

#include "engines/nufft/window.h"

#include <stddef.h>

/* Numbers that kernels/nufft/ and its host code agree on, as the kernels name them. */
enum {
    PS_NUFFT_PLACE_UNIT = 16, /* place.h: a realization fills whole units of places */
    PS_NUFFT_GAP = 4,         /* place.h: zeros on either side of a window */
    PS_NUFFT_CHUNK = 16,      /* place.h: points that are spread together */
    PS_NUFFT_LINE_ROWS = 4    /* line.h: rows on which they are, in turn */
};

typedef struct ps_nufft_axis {
    unsigned axis;         /* of the points */
    uint64_t factor;       /* the coordinate is factor * x[axis] mod 1 */
    int32_t max_frequency; /* K: its frequencies are -K .. K */
    uint32_t n;            /* cells */
    ps_nufft_window window;
    ps_nufft_loss loss;
    unsigned passes; /* of a transform */
} ps_nufft_axis;

/* What undoes the window in the power of frequency k. */
double ps_nufft_gain(const ps_nufft_axis *axis, uint32_t k);

/* Numbers of a window that are computed (whole vectors), and room for one. */
uint32_t ps_nufft_bins(const ps_nufft_axis *axis);
uint32_t ps_nufft_pitch(const ps_nufft_axis *axis);

/* Cells of a row in memory: windows go on behind its end. */
size_t ps_nufft_row_cells(const ps_nufft_axis *axis);

#endif

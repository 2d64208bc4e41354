/* Numbers that kernels/nufft/ and its host code agree on, as the kernels name them. */
#ifndef PS_ENGINES_NUFFT_KERNELS_H
#define PS_ENGINES_NUFFT_KERNELS_H

enum {
    PS_NUFFT_PLACE_UNIT = 16, /* place.h: a realization fills whole units of places */
    PS_NUFFT_GAP = 4,         /* place.h: zeros on either side of a window */
    PS_NUFFT_CHUNK = 16,      /* place.h: points that are spread together */
    PS_NUFFT_LINE_ROWS = 4    /* line.h: rows on which they are, in turn */
};

#endif

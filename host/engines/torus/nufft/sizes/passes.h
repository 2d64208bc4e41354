/* The passes that transform the grid of GPUs (kernels/nufft/grid/lines.cl): the last axis first,
 * an axis at a time, in two halves where its lines are too long for a work-group. */
#ifndef PS_ENGINES_TORUS_NUFFT_SIZES_PASSES_H
#define PS_ENGINES_TORUS_NUFFT_SIZES_PASSES_H

#include "device/device.h"
#include "engines/torus/nufft/choice.h"

enum { PS_NUFFT_PASS_RADICES = 4, PS_NUFFT_MOST_PASSES = 2 * PS_NUFFT_MAX_AXES };

typedef struct ps_nufft_pass {
    unsigned axis;
    uint32_t length;                         /* of lines */
    uint32_t radices[PS_NUFFT_PASS_RADICES]; /* 1: none */
    uint32_t lines_at_once, items;           /* of a work-group */
    bool is_first, is_last;                  /* reads cells, makes powers */
    bool is_turned;                          /* the first half of an axis */
    uint64_t lines, inner;                   /* of a set: kernels/nufft/grid/grid.h */
    uint64_t from, to;                       /* numbers of a set */
    uint32_t apart, neighbours;
} ps_nufft_pass;

/* The passes of a choice, and how many; 0: an axis has no such lengths. */
unsigned ps_nufft_passes_measure(ps_nufft_pass passes[PS_NUFFT_MOST_PASSES],
                                 const ps_nufft_choice *choice, const ps_device_limits *limits,
                                 size_t real_bytes);

/* Numbers of local memory that a line takes (kernels/nufft/grid/stockham.h). */
size_t ps_nufft_line_reals(uint32_t length);

#endif

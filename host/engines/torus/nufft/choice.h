/* How torus_nufft treats a problem: by which variant, which frequencies are summed by direct
 * phases, on which axes points are spread, the fine grid and the window of each. A function of the
 * problem, the precision and the kind of device alone, so that results depend on nothing else.
 * docs/engines/torus_nufft.md.
 *
 * A tile is `lanes` neighbouring frequencies of axis 0, by direct phases; a fast transform makes
 * all frequencies of the other axes. Where axis 0 itself needs one (one dimension, very many
 * points), its frequencies are k_0 = stride (q + K) + t lanes + lane: the transform makes q from
 * stride x_0 mod 1.
 *
 * One very large set is spread on all axes instead, as real numbers, chunk by chunk; a transform
 * along axis 0 makes the tiles, and the rest is the same. So are, on CPUs, realizations with many
 * points for their frequencies, in one and two dimensions, each in one go by one work-group, whole;
 * where grids in two dimensions are larger than the cache of a core, in strips.
 */
#ifndef PS_ENGINES_TORUS_NUFFT_CHOICE_H
#define PS_ENGINES_TORUS_NUFFT_CHOICE_H

#include "engines/engine.h"
#include "engines/nufft/axis.h"

enum { PS_NUFFT_MAX_AXES = 3 };

/* Points of a large set that are sorted and spread at a time. */
enum { PS_NUFFT_MOST_CHUNK_POINTS = 1 << 21 };

typedef struct ps_nufft_variant ps_nufft_variant; /* variant.h */

typedef struct ps_nufft_choice {
    const ps_nufft_variant *variant;
    unsigned lanes; /* whose cost counts: those of the device, nominal ones where it has none */
    unsigned num_axes;
    uint32_t span;       /* number of frequencies on axis 0 that are summed directly; */
    bool has_line;       /* frequency 0 is stored apart, as real numbers: kernels/nufft/line.h */
    uint32_t stride;     /* the same where axis 0 has a transform, else 0 */
    uint32_t lengths[2]; /* of the two transforms of realizations that are done whole; in one
                            dimension the grid is their product */
    /* Points whose numbers are added up in working precision, before pairs of numbers; 0: all,
     * without pairs */
    uint64_t chunk;
    bool keeps_sums; /* on the device, instead of their powers: grids of GPUs alone can */
    ps_nufft_axis axes[PS_NUFFT_MAX_AXES];
} ps_nufft_choice;

/* The axes whose transforms make powers of tiles: all, but for axis 0 of a grid. */
const ps_nufft_axis *ps_nufft_last_axes(const ps_nufft_choice *choice, unsigned *num);

/* A choice of axes first .. dimension - 1 with frequencies -K .. K each, without grids. */
ps_nufft_choice ps_nufft_choice_of_axes(const ps_problem *problem, unsigned first);

/* Frequencies of axis 0 in tiles, and the first in tile 0. */
uint32_t ps_nufft_tiled(const ps_nufft_choice *choice);
uint32_t ps_nufft_base(const ps_nufft_choice *choice);

/* Expected error of a choice for sets of a mean power (ps_survey.error). */
double ps_nufft_error(const ps_nufft_choice *choice, const ps_problem *problem,
                      ps_precision precision, double mean_power);

/* The same of one axis of a choice, as if it were alone and tiles were made of it: what its window
 * is chosen by. */
double ps_nufft_error_of_axis(const ps_nufft_choice *whole, const ps_nufft_axis *axis,
                              const ps_problem *problem, ps_precision precision, double mean_power);

/* The frequencies of a problem, of both signs. */
double ps_nufft_modes(const ps_problem *problem);

/* Which choice a problem gets: a search over variants, lengths and windows by their cost. A
 * function of the problem, the precision and the kind of device alone.
 */

/* The cheapest that keeps the tolerance; the most exact one when none does. num_axes == 0: rows
 * would be too long for any local memory. limits: lanes, and whether local memory is apart, as on
 * GPUs; NULL: it is not. */
ps_nufft_choice ps_nufft_choose(const ps_problem *problem, const ps_device_limits *limits,
                                ps_precision precision);
/* The same among these variants, ended by NULL. */
ps_nufft_choice ps_nufft_choose_among(const ps_nufft_variant *const *variants,
                                      const ps_problem *problem, const ps_device_limits *limits,
                                      ps_precision precision);

#endif

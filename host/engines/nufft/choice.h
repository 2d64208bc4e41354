/* How torus_nufft treats a problem: which frequencies are summed by direct phases, on which axes points are
 * spread, the fine grid and the window of each. A function of the problem, the precision and the kind of device
 * alone, so that results depend on nothing else. docs/engines/torus_nufft.md.
 *
 * A tile is `lanes` neighbouring frequencies of axis 0, by direct phases; a fast transform makes all
 * frequencies of the other axes. Where axis 0 itself needs one (one dimension, very many points), its
 * frequencies are k_0 = stride (q + K) + t lanes + lane: the transform makes q from stride x_0 mod 1.
 *
 * One very large set is spread on all axes instead, as real numbers, chunk by chunk; a transform along axis 0
 * makes the tiles, and the rest is the same. So are, on CPUs, realizations with many points for their frequencies,
 * in one and two dimensions, each in one go by one work-group, whole.
 */
#ifndef PS_ENGINES_NUFFT_CHOICE_H
#define PS_ENGINES_NUFFT_CHOICE_H

#include "engines/engine.h"
#include "engines/nufft/window.h"

enum { PS_NUFFT_MAX_AXES = 3 };

typedef struct ps_nufft_axis {
    unsigned axis;         /* of the points */
    uint64_t factor;       /* the coordinate is factor * x[axis] mod 1 */
    int32_t max_frequency; /* K: its frequencies are -K .. K */
    uint32_t n;            /* cells */
    ps_nufft_window window;
    ps_nufft_loss loss;
    unsigned passes; /* of a transform */
} ps_nufft_axis;

typedef struct ps_nufft_choice {
    unsigned lanes; /* whose cost counts: those of the device, nominal ones where it has none */
    unsigned num_axes;
    uint32_t span;       /* frequencies of axis 0 by direct phases */
    uint32_t stride;     /* the same where axis 0 has a transform, else 0 */
    bool is_gridded;     /* axis 0 is the first of the axes, spread like the others */
    bool is_whole;       /* gridded, kernels/nufft/whole.cl: */
    uint32_t lengths[2]; /* of its two transforms; in one dimension the grid is their product */
    uint64_t chunk;      /* points whose numbers are added up in working precision; 0: all */
    ps_nufft_axis axes[PS_NUFFT_MAX_AXES];
} ps_nufft_choice;

/* One set at a time, chunk by chunk. */
static inline bool ps_nufft_is_large(const ps_nufft_choice *choice) {
    return choice->is_gridded && !choice->is_whole;
}

/* Of a wide CPU: lanes to choose for where there is no device, and on GPUs. */
unsigned ps_nufft_nominal_lanes(ps_precision precision);

/* The axes whose transforms make powers of tiles: all, but for axis 0 of a grid. */
const ps_nufft_axis *ps_nufft_last_axes(const ps_nufft_choice *choice, unsigned *num);

/* The cheapest that keeps the tolerance; the most exact one when none does. num_axes == 0: rows would be
 * too long for any local memory. limits: lanes, and whether local memory is apart, as on GPUs; NULL: it is not. */
ps_nufft_choice ps_nufft_choose(const ps_problem *problem, const ps_device_limits *limits,
                                ps_precision precision);

/* ps_engine.error of a choice. */
double ps_nufft_error(const ps_nufft_choice *choice, const ps_problem *problem,
                      ps_precision precision, double mean_power);

/* Of a problem: frequencies of both signs, and points planned. */
double ps_nufft_modes(const ps_problem *problem);
double ps_nufft_points(const ps_problem *problem);

/* What a device of its lanes would do at its peak while it works on one realization of num_points points. */
double ps_nufft_flops(const ps_nufft_choice *choice, ps_precision precision, double num_points);

/* Of the two transforms of a whole realization: the largest frequency that each keeps. In one dimension, frequency
 * k_1 + lengths[0] k_2, |k_1| <= kept[0], is k_1 of the first and k_2 of the second. */
void ps_nufft_whole_kept(const ps_nufft_choice *choice, uint32_t kept[2]);

/* The first frequency of axis 0 in tile 0. */
uint32_t ps_nufft_base(const ps_nufft_choice *choice);

/* Part of the tolerance (or of roundoff, if that is more) that polynomials of windows may be off by: little,
 * since it adds up in step in sets as regular as the grid. One degree more costs a percent. */
#define PS_NUFFT_POLYNOMIAL_SHARE 0.01

#endif

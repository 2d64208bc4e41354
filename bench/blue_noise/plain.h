/* Points that keep a least distance by plain C loops, beside which bench_blue_noise times ours:
 * 400 N darts on a grid of cells, which come to 97 % of saturation (the last points take any time),
 * and Bridson's paper with cosines and 30 tries.
 */
#ifndef BENCH_BLUE_NOISE_PLAIN_H
#define BENCH_BLUE_NOISE_PLAIN_H

#include "math/random/random.h"

#include <stddef.h>

enum { BENCH_TRIES = 30, BENCH_MOST_POINTS = 1 << 16, BENCH_MOST_CELLS = 1 << 21 };

typedef struct bench_room {
    double *points; /* [BENCH_MOST_POINTS][3] */
    int *cells;     /* [BENCH_MOST_CELLS] */
    int *active;    /* [BENCH_MOST_POINTS] */
} bench_room;

/* Each returns how many points it wrote. */
size_t bench_plain_darts(bench_room *room, double radius, ps_random *random);
size_t bench_plain_bridson(bench_room *room, double radius, ps_random *random);
size_t bench_plain_sphere(bench_room *room, double radius, ps_random *random);

#endif

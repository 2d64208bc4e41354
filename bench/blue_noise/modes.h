/* Modes of bench_blue_noise that make realizations of named samplers. */
#ifndef BENCH_BLUE_NOISE_MODES_H
#define BENCH_BLUE_NOISE_MODES_H

#include "samplers/sampler.h"

#include <stddef.h>

/* "NAME:key=value" with that many points and seed 1. */
ps_sampler_request bench_sampler(const char *text, size_t num_points);
/* One realization; seconds of this thread. points has room for ps_sampler_most_points;
 * num_points may be NULL. */
double bench_make_set(const ps_sampler_request *request, uint64_t realization, double *points,
                      size_t *num_points);

/* Seconds of a set beside those of the prototypes that the samplers were planned with. */
void bench_blue_noise_cost(void);
/* Hours of 1000 realizations on two cores, from num_sets. */
void bench_blue_noise_hours(unsigned num_sets);
/* Beside programs of others, libraries that bench/blue_noise/peers.sh has built in folder;
 * those whose rows begin so. */
void bench_blue_noise_peers(const char *folder, const char *begin);

#endif

/* Random subsets and orders. Subsets are some of many numbers, without listing the many. */
#ifndef PS_MATH_RANDOM_SUBSET_H
#define PS_MATH_RANDOM_SUBSET_H

#include "base/status.h"
#include "math/random/random.h"

/* count different integers below population, in ascending order; every subset of that size has the
 * same probability. 1 <= count <= population < 2^64 - 1. R. Floyd's algorithm (Bentley,
 * "Programming pearls: a sample of brilliance", 1987): for each j from population - count up, t
 * uniform in 0..j is taken, or j when t was taken before. Takes the random numbers of count calls
 * of ps_random_below. */
pspec_status ps_random_subset(uint64_t *out, size_t count, uint64_t population, ps_random *random,
                              ps_error *error) PS_MUST_CHECK;

/* 0 .. num - 1 in a random order, by Fisher and Yates from the last place on. */
void ps_random_order(ps_random *random, uint32_t *order, size_t num);

#endif

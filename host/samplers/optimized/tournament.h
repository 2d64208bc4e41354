/* The largest of many numbers that change one by one: a tree of the winners of pairs, pairs of
 * pairs and so on. A change costs the logarithm of their number, the winner nothing.
 */
#ifndef PS_SAMPLERS_OPTIMIZED_TOURNAMENT_H
#define PS_SAMPLERS_OPTIMIZED_TOURNAMENT_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

typedef struct ps_tournament {
    uint32_t num_leaves; /* a power of two; those without a number have -1 */
    double *keys;        /* of leaves */
    uint32_t *winners;   /* of node k, whose children are 2 k and 2 k + 1; 1 is the root */
} ps_tournament;

/* Numbers 0 .. num - 1, num <= 2^31, all of them 0. */
pspec_status ps_tournament_create(ps_tournament *tournament, size_t num,
                                  ps_error *error) PS_MUST_CHECK;
void ps_tournament_destroy(ps_tournament *tournament);

/* Number i becomes key >= 0. */
void ps_tournament_set(ps_tournament *tournament, uint32_t i, double key);

/* Which number is the largest; of equal ones the first. */
static inline uint32_t ps_tournament_winner(const ps_tournament *tournament) {
    return tournament->winners[1];
}

#endif

/* Blue noise through optimal transport (de Goes, Breeden, Ostromoukhov, Desbrun 2012) on the torus
 * of the plane: points each of which is the centroid of its power cell, all cells of area 1/N.
 *
 * In turns, weights are found that give all cells their area, and every point moves to the centroid
 * of its cell, which lowers the transport cost sum int |x - x_i|^2 each time, so that no move needs
 * a search. It ends where points lie within 0.015 eps / sqrt(N) of their centroids (root mean
 * square), with weights for areas right to the capacity
 * (docs/samplers/optimized.md#bnot).
 */
#ifndef PS_SAMPLERS_OPTIMIZED_BNOT_H
#define PS_SAMPLERS_OPTIMIZED_BNOT_H

#include "base/watch.h"
#include "math/random/random.h"

#include <stddef.h>

/* Below the first, moves are so many that nobody waits for them (340 at 0.05); above the second,
 * points stay as random as they began. */
#define PS_BNOT_LEAST_EPS 0.02
#define PS_BNOT_MOST_EPS 10.0
/* How far areas may be from 1/N in the end, in units of it. */
#define PS_BNOT_CAPACITY 1e-5

typedef struct ps_bnot_outcome {
    unsigned moves;  /* of all points to their centroids */
    unsigned steps;  /* of Newton's method on weights */
    unsigned tries;  /* times that all cells were made */
    double distance; /* from the centroids, root mean square, in units of 1/sqrt(N) */
    double capacity; /* the largest |area N - 1| */
} ps_bnot_outcome;

/* Refuses a number of points and an eps outside the limits with a sentence. */
pspec_status ps_bnot_check(size_t num, double eps, ps_error *error) PS_MUST_CHECK;

/* Points [num][2], from uniform random ones. */
pspec_status ps_bnot_make(size_t num, double eps, ps_random *random, const ps_watch *watch,
                          double *points, ps_error *error) PS_MUST_CHECK;

/* The same from points [num][2] as they are; they come back in another order. weights [num] and
 * outcome may be NULL. PSPEC_ERROR_INPUT where two points coincide. */
pspec_status ps_bnot_optimise(size_t num, double eps, const ps_watch *watch, double *points,
                              double *weights, ps_bnot_outcome *outcome,
                              ps_error *error) PS_MUST_CHECK;

#endif

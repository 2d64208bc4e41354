/* Checks and sums of one pattern, before anything is computed from it. */
#ifndef PS_JOBS_PATTERN_CHECK_H
#define PS_JOBS_PATTERN_CHECK_H

#include "frequencies/frequencies.h"
#include "spectra/normalization.h"

#include <stddef.h>
#include <stdint.h>

/* Pairs and quadrature measure errors in the units of the weights: their fourth powers, summed over
 * points and realizations for a standard error, must be numbers. The range of the largest |w| of a
 * set. */
#define PS_LEAST_ABSOLUTE_WEIGHT 1e-60
#define PS_MOST_ABSOLUTE_WEIGHT 1e60
/* Where weights are not scaled, sum |w| is at most this: then W summed over the 2^53 realizations
 * that there may be, and c_lm, up to a hundred times the sum, are finite. */
#define PS_MOST_WEIGHT_SUM 1e290

/* Weights count as w 2^-exponent, which makes the largest |w| a number in [1/2, 1): so neither the
 * squares of double weights nor sums in single precision overflow or vanish. */
typedef struct ps_pattern_sums {
    int exponent;             /* 0 for unit weights */
    bool is_plain;            /* no weights: all 1 */
    double weight_sum;        /* W 2^-exponent */
    double weight_square_sum; /* V 2^(-2 exponent) */
    double weight_size_sum;   /* sum |w| 2^-exponent */
    double length_error;      /* largest | |u| - 1 | of vectors; 0 on the torus */
} ps_pattern_sums;

/* What is known of a pattern of which some points have been seen; {.realization = r} before the
 * first. realization counts from 0 and is only for messages. */
typedef struct ps_pattern_count {
    uint64_t realization;
    bool on_sphere; /* points are unit vectors */
    uint64_t num_points, num_weights;
    double length_error;             /* so far, as in the sums */
    double largest;                  /* |w| */
    int exponent;                    /* of the largest */
    long double sum, squares, sizes; /* of w, w^2, |w|, divided by powers of two as in the sums */
} ps_pattern_count;

/* Checks coordinates and counts points and weights of a block. Results do not depend on the blocks.
 */
pspec_status ps_pattern_count_add(ps_pattern_count *count, const pspec_pattern *block,
                                  ps_error *error) PS_MUST_CHECK;
/* The same for weights that come without points. */
pspec_status ps_pattern_count_weights(ps_pattern_count *count, const double *weights,
                                      size_t num_weights, ps_error *error) PS_MUST_CHECK;
/* W = 0 where powers are divided by it, and sums that are too large, are PSPEC_ERROR_INPUT. */
pspec_status ps_pattern_count_finish(const ps_pattern_count *count,
                                     pspec_normalization normalization, ps_pattern_sums *sums,
                                     ps_error *error) PS_MUST_CHECK;

/* Is the largest |w| of a set what pairs and quadrature can do? 0 passes: that is for
 * ps_pattern_count_finish. */
pspec_status ps_pattern_check_largest(double largest, uint64_t realization,
                                      ps_error *error) PS_MUST_CHECK;

/* How far from 1 the length of a vector may be that stands for a point on the sphere: what single
 * precision and printed coordinates leave. */
#define PS_UNIT_LENGTH_SLACK 1e-6

/* Vectors whose length is 1 within that slack stand for their directions. */
void ps_pattern_straighten(double u[3]);

/* All sets have one dimension. */
pspec_status ps_pattern_check_dimension(unsigned dimension, unsigned wanted, uint64_t realization,
                                        ps_error *error) PS_MUST_CHECK;
/* Bins relative to a number of points want every set to have it. */
pspec_status ps_pattern_check_size(const ps_frequencies *frequencies, uint64_t num_points,
                                   uint64_t realization, ps_error *error) PS_MUST_CHECK;
/* All of it, for a pattern in memory whose spectrum at these frequencies is asked for. */
pspec_status ps_pattern_check(const pspec_pattern *pattern, const ps_frequencies *frequencies,
                              pspec_normalization normalization, uint64_t realization,
                              ps_pattern_sums *sums, ps_error *error) PS_MUST_CHECK;

#endif

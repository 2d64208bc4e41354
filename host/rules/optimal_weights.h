/* Optimal weights of a quadrature rule (docs/mathematics/quadrature.md#optimal-weights): K
 * w = kappa makes the worst-case error of points smallest, E^2_min = kappa_0 - w.kappa; with sum
 * w = 1 imposed, w + mu K^-1 1. Weights may be negative. */
#ifndef PS_RULES_OPTIMAL_WEIGHTS_H
#define PS_RULES_OPTIMAL_WEIGHTS_H

#include "rules/kernel/kernel_system.h"
#include "rules/representer.h"

typedef struct ps_optimal_weights {
    double squared;    /* E^2 of the weights */
    double weight_sum; /* of the weights */
    double smallest, largest;
    ps_kernel_facts facts; /* condition, memory, duplicates */
} ps_optimal_weights;

/* Writes weights [num_points] for unit vectors [num_points][3]. kappa: of the points, or NULL to
 * have it made here. sum_to_one: impose sum w = 1. */
pspec_status ps_optimal_weights_find(const ps_representer *representer, size_t num_points,
                                     const double *points, const double *kappa, bool sum_to_one,
                                     const ps_kernel_options *options, double *weights,
                                     ps_optimal_weights *out, ps_error *error) PS_MUST_CHECK;

#endif

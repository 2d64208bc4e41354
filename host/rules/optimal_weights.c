#include "rules/optimal_weights.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* w = w0 + mu K^-1 1, mu = (1 - W0)/(1.K^-1 1); E^2 grows by (1 - W0)^2/(1.K^-1 1). ones, flat:
 * [num] each. */
static pspec_status impose_sum(ps_kernel_system *system, size_t num, double *ones, double *flat,
                               double *weights, double *squared, ps_error *error) {
    for (size_t j = 0; j < num; j++) {
        ones[j] = 1;
    }
    PS_TRY(ps_kernel_system_solve(system, ones, flat, NULL, error));
    const double gap = 1 - ps_kernel_dot(num, weights, NULL);
    const double total = ps_kernel_dot(num, flat, NULL);
    for (size_t j = 0; j < num; j++) {
        weights[j] += gap / total * flat[j];
    }
    *squared += gap * gap / total;
    return PSPEC_OK;
}

static void describe(const ps_kernel_system *system, size_t num, const double *weights,
                     ps_optimal_weights *out) {
    out->weight_sum = ps_kernel_dot(num, weights, NULL);
    out->smallest = weights[0];
    out->largest = weights[0];
    for (size_t j = 1; j < num; j++) {
        out->smallest = fmin(out->smallest, weights[j]);
        out->largest = fmax(out->largest, weights[j]);
    }
    out->facts = ps_kernel_system_facts(system);
}

pspec_status ps_optimal_weights_find(const ps_representer *representer, size_t num_points,
                                     const double *points, const double *kappa, bool sum_to_one,
                                     const ps_kernel_options *options, double *weights,
                                     ps_optimal_weights *out, ps_error *error) {
    enum { ARRAYS = 2 };
    ps_kernel_system *system = NULL;
    double *own = NULL;
    double defect = 0;
    pspec_status status = PSPEC_OK;
    PS_TRY(ps_allocate_for(&own, num_points, ARRAYS * sizeof(double), "kappa", error));
    if (kappa == NULL) {
        ps_representer_kappa(representer, num_points, points, own);
        kappa = own;
    }
    PS_TRY_OUT(status, ps_kernel_system_create(&system, num_points, points, representer->smoothness,
                                               options, error));
    PS_TRY_OUT(status, ps_kernel_system_solve(system, kappa, weights, &defect, error));
    /* w.K w - 2 w.kappa + kappa_0 with K w = kappa - r: errors of w count twice only */
    out->squared = representer->kappa_0 - ps_kernel_dot(num_points, weights, kappa) - defect;
    if (sum_to_one) {
        PS_TRY_OUT(status, impose_sum(system, num_points, own, own + num_points, weights,
                                      &out->squared, error));
    }
    describe(system, num_points, weights, out);
out:
    ps_kernel_system_destroy(system);
    free(own);
    return status;
}

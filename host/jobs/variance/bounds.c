#include "jobs/variance/bounds.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* |k| N^(-1/d), or l N^(-1/2). */
static double find_frequency(const ps_frequencies *set, size_t i, double unit) {
    const unsigned dimension = set->dimension;
    return set->kind == PS_FREQUENCIES_DEGREES
               ? set->vectors[i] / unit
               : sqrt((double)ps_frequency_norm2(set->vectors + i * dimension, dimension)) / unit;
}

pspec_status ps_bounds_variance(double *out, const ps_integrand *integrand,
                                const ps_spectrum *spectrum, bool over_shells,
                                const ps_point_way *way, const ps_bound *profile, ps_error *error) {
    const ps_frequencies *const set = &spectrum->frequencies;
    const double num_points = spectrum->mean_points;
    const double unit = set->kind == PS_FREQUENCIES_DEGREES
                            ? sqrt(num_points)
                            : pow(num_points, 1 / (double)set->dimension);
    double *weights = NULL;
    double held = 0;
    long double sum = 0;
    PS_TRY(PS_NEW(&weights, set->num, "weights of a bound", error));
    const pspec_status status =
        ps_prediction_weigh(integrand, set, over_shells, way, weights, &held, error);
    for (size_t i = 0; status == PSPEC_OK && i < set->num; i++) {
        sum += weights[i] * ps_bound_power(profile, find_frequency(set, i, unit));
    }
    free(weights);
    const double tail =
        ps_integrand_factor(integrand) * fmax(ps_integrand_energy(integrand) - held, 0);
    *out = ((double)sum + profile->gamma * tail) / num_points;
    return status;
}

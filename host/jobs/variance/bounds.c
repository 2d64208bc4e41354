#include "jobs/variance/bounds.h"

#include "base/memory.h"
#include "jobs/variance/tails.h"

#include <math.h>
#include <stdlib.h>

/* |k| N^(-1/d), or l N^(-1/2). */
static double find_frequency(const ps_frequencies *set, size_t i, double unit) {
    const unsigned dimension = set->dimension;
    return set->kind == PS_FREQUENCIES_DEGREES
               ? set->vectors[i] / unit
               : sqrt((double)ps_frequency_norm2(set->vectors + i * dimension, dimension)) / unit;
}

/* Between a cut-off and all that lies beyond it: a box ends at K + 1, rings by rounding at
 * K + 1/2, and degrees are whole. */
static const double BEYOND = 0.5;

/* The frequencies of the spectrum, or more of their kind, up to where the profile is flat. */
static pspec_status make_frequencies(ps_frequencies *out, const ps_spectrum *spectrum,
                                     const ps_integrand *integrand, bool over_shells, double flat,
                                     ps_error *error) {
    const ps_frequencies *const set = &spectrum->frequencies;
    const double most = (double)ps_tails_largest_cutoff(integrand, over_shells);
    const double cutoff = fmin(ceil(flat), most);
    if (!(cutoff > set->max_frequency)) {
        return ps_frequencies_copy(out, set, error);
    }
    PS_TRY(set->kind == PS_FREQUENCIES_DEGREES
               ? ps_frequencies_degrees(out, (int64_t)cutoff, set->degree_step > 1, error)
               : ps_frequencies_lattice(out, set->dimension, (int32_t)cutoff,
                                        set->kind == PS_FREQUENCIES_BALL, error));
    return ps_frequencies_enumerate(out, error);
}

pspec_status ps_bounds_variance(double *out, const ps_integrand *integrand,
                                const ps_spectrum *spectrum, bool over_shells,
                                const ps_point_way *way, const ps_bound *profile, bool is_below,
                                ps_error *error) {
    const double num_points = spectrum->mean_points;
    const double unit =
        pow(num_points, 1.0 / ps_frequencies_space_dimension(&spectrum->frequencies));
    ps_frequencies set = {0};
    double *weights = NULL;
    double held = 0;
    long double sum = 0;
    pspec_status status = PSPEC_OK;
    PS_TRY(make_frequencies(&set, spectrum, integrand, over_shells, profile->alpha * unit, error));
    PS_TRY_OUT(status, PS_NEW(&weights, set.num, "weights of a bound", error));
    PS_TRY_OUT(status,
               ps_prediction_weigh(integrand, &set, over_shells, way, weights, &held, error));
    for (size_t i = 0; i < set.num; i++) {
        sum += weights[i] * ps_bound_power(profile, find_frequency(&set, i, unit));
    }
    const double rest =
        ps_integrand_factor(integrand) * fmax(ps_integrand_energy(integrand) - held, 0);
    const double power =
        is_below ? ps_bound_power(profile, (set.max_frequency + BEYOND) / unit) : profile->gamma;
    *out = ((double)sum + power * rest) / num_points;
out:
    free(weights);
    ps_frequencies_free(&set);
    return status;
}

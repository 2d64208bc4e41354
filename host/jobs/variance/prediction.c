#include "jobs/variance/prediction.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

static pspec_status weigh_degrees(const ps_integrand *integrand, const ps_frequencies *frequencies,
                                  double *weights, ps_error *error) {
    const size_t largest = (size_t)frequencies->max_frequency;
    double *degrees = NULL;
    PS_TRY(PS_NEW(&degrees, largest + 1, "degrees of an integrand", error));
    const pspec_status status = ps_integrand_degrees(integrand, largest, degrees, error);
    for (size_t i = 0; status == PSPEC_OK && i < frequencies->num; i++) {
        weights[i] = degrees[frequencies->vectors[i]];
    }
    free(degrees);
    return status;
}

static bool is_in_ball(const ps_frequencies *frequencies, size_t i) {
    const unsigned dimension = frequencies->dimension;
    return ps_frequency_norm2(frequencies->vectors + i * dimension, dimension) <=
           frequencies->max_norm2;
}

/* What is held is counted as it is weighed. */
pspec_status ps_prediction_weigh(const ps_integrand *integrand, const ps_frequencies *frequencies,
                                 bool over_shells, const ps_point_way *way, double *weights,
                                 double *held, ps_error *error) {
    const double factor = ps_integrand_factor(integrand);
    const bool is_on_torus = integrand->place.where == PS_SAMPLES_TORUS;
    long double sum = 0;
    PS_TRY(!is_on_torus ? weigh_degrees(integrand, frequencies, weights, error)
           : ps_integrand_has_points(integrand)
               ? ps_point_powers(integrand, frequencies, way, weights, error)
               : ps_integrand_powers(integrand, frequencies->vectors, frequencies->num, weights,
                                     error));
    for (size_t i = 0; i < frequencies->num; i++) {
        const bool is_in = !over_shells || is_in_ball(frequencies, i);
        weights[i] *= !is_in ? 0 : is_on_torus ? 2 : factor;
        sum += weights[i];
    }
    *held = (double)sum / factor;
    return PSPEC_OK;
}

double ps_prediction_reach(const ps_integrand *const *integrands, size_t num, bool over_shells) {
    const ps_integrand_place place = integrands[0]->place;
    double reach = place.where == PS_SAMPLES_HEMISPHERE ? 2 : 1;
    for (size_t i = 0; i < num; i++) {
        reach = fmax(reach, ps_integrand_reach(integrands[i]));
    }
    return over_shells ? ceil(reach * sqrt(place.dimension)) : reach; /* the ball about the box */
}

/* The largest mean power of a ring or degree, and no less than what predictions have beyond the
 * cut-off, which may lie below the peak. */
static double largest_power(const ps_spectrum *spectrum) {
    double largest = 1;
    for (size_t i = 0; i < spectrum->num_bins; i++) {
        largest = fmax(largest, spectrum->bins[i].power);
    }
    return largest;
}

ps_power_beyond ps_prediction_power_beyond(const ps_sampler_request *sampler,
                                           const ps_spectrum *spectrum, double reach) {
    const bool matters = spectrum->frequencies.max_frequency < reach;
    if (sampler != NULL && ps_sampler_has_constant_power(sampler)) {
        return (ps_power_beyond){1, spectrum->mean_points, true, matters};
    }
    const double most = sampler != NULL ? ps_sampler_most_power(sampler) : 0;
    return most > 0 ? (ps_power_beyond){1, most, true, matters}
                    : (ps_power_beyond){1, largest_power(spectrum), false, matters};
}

ps_prediction ps_prediction_make(const ps_integrand *integrand, ps_mean sum, double held,
                                 double num_points, const ps_power_beyond *beyond) {
    const double factor = ps_integrand_factor(integrand);
    const double energy = ps_integrand_energy(integrand);
    const double tail = factor * fmax(energy - held, 0);
    const double lower = sum.mean / num_points;
    return (ps_prediction){
        .variance = lower + beyond->white * tail / num_points,
        .standard_error = sum.standard_error / num_points,
        .lower = lower,
        .upper = lower + beyond->most * tail / num_points,
        .white = factor * energy / num_points,
    };
}

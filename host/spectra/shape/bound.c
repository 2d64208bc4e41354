#include "spectra/shape/bound.h"

#include "spectra/shape/low_end.h"

#include <math.h>

/* Two texts of one profile, as 0.5,0.5,2 and 2,1,2, differ by roundings. */
static const double ROUNDINGS = 1e-12;
/* No set of a billion points has a normalized frequency below this. */
static const double LEAST_FREQUENCY = 1e-9;
/* Standard errors between a spectrum and its profiles. */
static const double MARGIN = 3;
/* The normalized frequency from which on a spectrum is taken to be flat. */
static const double FLAT_FROM = 0.6;

double ps_bound_power(const ps_bound *self, double normalized_frequency) {
    return normalized_frequency < self->alpha
               ? self->gamma * pow(normalized_frequency / self->alpha, self->exponent)
               : self->gamma;
}

static bool is_crossed(const ps_bounds_spec *self, double nu) {
    return ps_bound_power(&self->below, nu) > ps_bound_power(&self->above, nu) * (1 + ROUNDINGS);
}

/* On logarithmic axes both are made of straight lines, which are farthest apart where one of them
 * bends, or towards 0. */
double ps_bounds_find_crossed(const ps_bounds_spec *self) {
    const double first = fmin(self->below.alpha, self->above.alpha);
    const double last = fmax(self->below.alpha, self->above.alpha);
    if (is_crossed(self, first)) {
        return first;
    }
    for (double nu = last; nu > LEAST_FREQUENCY; nu /= 2) {
        if (is_crossed(self, nu)) {
            return nu;
        }
    }
    return -1;
}

ps_bound_rates ps_bound_find_rates(const ps_bound *self, unsigned dimension) {
    return (ps_bound_rates){1 + self->exponent / dimension,
                            1 + fmin(self->exponent, 1) / dimension};
}

static pspec_status check_errors(const ps_spectrum *spectrum, ps_error *error) {
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        if (!isfinite(spectrum->bins[b].standard_error)) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s %lld has no standard error: a profile needs several realizations",
                           ps_shape_bin_name(spectrum), (long long)spectrum->bins[b].key);
        }
    }
    return spectrum->num_bins > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "there are no powers to find a profile of");
}

/* The power of the bin, that many standard errors away. */
static double edge(const ps_spectrum_bin *bin, double errors) {
    return bin->power + errors * bin->standard_error;
}

/* Where gamma (nu / alpha)^exponent has this power at the bin's frequency. */
static double alpha_through(const ps_spectrum_bin *bin, double power, double gamma,
                            double exponent) {
    return bin->normalized_frequency * pow(gamma / power, 1 / exponent);
}

pspec_status ps_bound_above(ps_bound *out, const ps_spectrum *spectrum, double exponent,
                            ps_error *error) {
    *out = (ps_bound){.exponent = exponent};
    PS_TRY(check_errors(spectrum, error));
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        out->gamma = fmax(out->gamma, edge(&spectrum->bins[b], MARGIN));
    }
    if (!(out->gamma > 0)) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "all powers are 0");
    }
    if (exponent > 0) {
        out->alpha = INFINITY;
        for (size_t b = 0; b < spectrum->num_bins; b++) {
            const ps_spectrum_bin *const bin = &spectrum->bins[b];
            const double alpha = alpha_through(bin, edge(bin, MARGIN), out->gamma, exponent);
            out->alpha = fmin(out->alpha, alpha);
        }
    }
    return PSPEC_OK;
}

static pspec_status fail_low(const ps_spectrum *spectrum, const ps_spectrum_bin *bin,
                             ps_error *error) {
    return ps_fail(
        error, PSPEC_ERROR_INPUT,
        "the power of %s %lld, %.3g, is no more than three standard errors of %.3g: more "
        "realizations are needed",
        ps_shape_bin_name(spectrum), (long long)bin->key, bin->power, bin->standard_error);
}

pspec_status ps_bound_below(ps_bound *out, const ps_spectrum *spectrum, double exponent,
                            ps_error *error) {
    const double from = exponent > 0 ? FLAT_FROM * ps_shape_unit(spectrum) : 0;
    *out = (ps_bound){.gamma = INFINITY, .exponent = exponent};
    PS_TRY(check_errors(spectrum, error));
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        const double power = edge(bin, -MARGIN);
        if (!(power > 0)) {
            return fail_low(spectrum, bin, error);
        }
        out->gamma = bin->normalized_frequency >= from ? fmin(out->gamma, power) : out->gamma;
    }
    if (isinf(out->gamma)) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "no %s is at a normalized frequency of %.3g or above, where a spectrum is "
                       "taken to be flat",
                       ps_shape_bin_name(spectrum), from);
    }
    for (size_t b = 0; exponent > 0 && b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        const double power = edge(bin, -MARGIN);
        if (power < out->gamma) {
            out->alpha = fmax(out->alpha, alpha_through(bin, power, out->gamma, exponent));
        }
    }
    return PSPEC_OK;
}

#include "spectra/shape/shape.h"

#include <math.h>

pspec_status ps_shape_find(ps_shape *out, const ps_spectrum *spectrum, double exponent,
                           ps_error *error) {
    *out = (ps_shape){0};
    const pspec_status status = ps_low_end_fit(&out->low, spectrum, &out->low_reason);
    if (status == PSPEC_ERROR_MEMORY) {
        *error = out->low_reason;
        return status;
    }
    if (isnan(exponent) && status != PSPEC_OK) {
        out->above_reason = out->low_reason;
        out->below_reason = out->low_reason;
        return PSPEC_OK;
    }
    /* That of the law is taken to be whole, as those of P15 are, also where there is a small
     * plateau. */
    const double own = isnan(exponent) ? fmax(round(out->low.exponent), 0) : exponent;
    out->above_reason.status = ps_bound_above(&out->above, spectrum, own, &out->above_reason);
    out->below_reason.status = ps_bound_below(&out->below, spectrum, own, &out->below_reason);
    return PSPEC_OK;
}

/* ---- features -------------------------------------------------------------------------------- */

static void find_peak(ps_features *out, const ps_spectrum *spectrum) {
    out->peak = -1;
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        if (bin->power > out->peak) {
            out->peak = bin->power;
            out->peak_error = bin->standard_error;
            out->peak_frequency = bin->normalized_frequency;
        }
    }
}

/* The definition of Heck et al., 2013, over frequencies of the lattice. */
static double find_nyquist(const ps_spectrum *spectrum) {
    const double quiet = 0.1;
    const double loud = 0.5;
    double sum = 0;
    double count = 0;
    double mean = 0;
    double before = 0; /* the mean, and the frequency, of the bin before */
    double at = 0;
    double last = 0; /* where the mean was the quiet one */
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        sum += (double)bin->count * bin->power;
        count += (double)bin->count;
        mean = sum / count;
        if (before < quiet && mean >= quiet && b > 0) {
            last = at + (bin->normalized_frequency - at) * (quiet - before) / (mean - before);
        }
        if (mean >= loud) {
            return last / 2;
        }
        before = mean;
        at = bin->normalized_frequency;
    }
    return NAN;
}

static const double DECIBELS = 10;

/* The mean of s^2 / P^2 over rings that know it, by their counts; nan: none does. */
static double mean_anisotropy(const ps_spectrum *spectrum, size_t first, size_t end,
                              double *count) {
    double sum = 0;
    *count = 0;
    for (size_t b = first; b < end; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        if (isfinite(bin->anisotropy_db)) {
            sum += (double)bin->count * pow(10, bin->anisotropy_db / DECIBELS);
            *count += (double)bin->count;
        }
    }
    return *count > 0 ? sum / *count : NAN;
}

ps_features ps_features_find(const ps_spectrum *spectrum) {
    ps_features out = {0};
    double count = 0;
    find_peak(&out, spectrum);
    out.effective_nyquist = find_nyquist(spectrum);
    out.anisotropy_db = DECIBELS * log10(mean_anisotropy(spectrum, 0, spectrum->num_bins, &count));
    return out;
}

/* ---- convergence ----------------------------------------------------------------------------- */

/* Standard errors from which on something is not what it may be. */
static const double SIGNIFICANT = 3;
/* Standard deviations of chi^2 above its mean that a fit may be off: of a right model with twenty
 * rings one in 10^5 is. */
static const double MOST_OFF = 5;

static bool fits(const ps_low_end *low) {
    const double freedom = (double)low->degrees_of_freedom;
    const double chi2 = low->shape == PS_LOW_PLATEAU ? low->plateau_chi2 : low->law_chi2;
    return chi2 <= freedom + MOST_OFF * sqrt(2 * freedom);
}

/* A ring in which the power differs from direction to direction by more is none of an isotropic
 * spectrum: it has 0.2 of a Latin hypercube. The first one has two lengths, of which one may be
 * sixteen times the other by a law of nu^8. */
static const double MOST_ANISOTROPY = 0.1;

typedef struct anisotropy {
    double excess; /* nan: unknown */
    double error;  /* of exponential powers */
} anisotropy;

static anisotropy find_anisotropy(const ps_low_end *low, const ps_spectrum *spectrum) {
    const double num = (double)spectrum->num_realizations;
    double count = 0;
    const double mean = mean_anisotropy(spectrum, 1, low->num_bins, &count);
    return (anisotropy){mean - 1 / num, sqrt((2 + 6 / num) / (count / 2)) / num};
}

/* Of the power of the first ring, a plateau has so much at least: ten thousand realizations of
 * jittered points have one of 0.05 that is six standard errors from 0, by what the fits neglect. */
static const double LEAST_PLATEAU = 0.25;

static ps_convergence_kind find_kind(const ps_low_end *low, const ps_spectrum *spectrum,
                                     anisotropy found) {
    const bool is_faint = low->plateau < LEAST_PLATEAU * spectrum->bins[0].power;
    return low->shape == PS_LOW_UNDECIDED                               ? PS_CONVERGENCE_UNKNOWN
           : found.excess > MOST_ANISOTROPY + SIGNIFICANT * found.error ? PS_CONVERGENCE_MIXED
           : !fits(low)                                                 ? PS_CONVERGENCE_UNFIT
           : low->shape == PS_LOW_PLATEAU ? (is_faint ? PS_CONVERGENCE_FAINT : PS_CONVERGENCE_WHITE)
           : low->exponent > 0            ? PS_CONVERGENCE_FAST
                                          : PS_CONVERGENCE_SLOW;
}

/* 1 + b/d, and 1 + min(b, 1)/d. */
static void add_rates(ps_convergence *out, const ps_low_end *low, double dimension) {
    out->smooth = 1 + low->exponent / dimension;
    out->smooth_error = low->exponent_error / dimension;
    out->jump = 1 + fmin(low->exponent, 1) / dimension;
    out->jump_error =
        low->exponent - SIGNIFICANT * low->exponent_error > 1 ? 0 : low->exponent_error / dimension;
    out->most_plateau = fmax(low->plateau, 0) + SIGNIFICANT * low->plateau_error;
}

unsigned ps_convergence_dimension(const ps_spectrum *spectrum) {
    return spectrum->frequencies.kind == PS_FREQUENCIES_DEGREES ? 2
                                                                : spectrum->frequencies.dimension;
}

ps_convergence ps_convergence_find(const ps_low_end *low, const ps_spectrum *spectrum) {
    const anisotropy found = find_anisotropy(low, spectrum);
    ps_convergence out = {.kind = find_kind(low, spectrum, found),
                          .smooth = NAN,
                          .smooth_error = NAN,
                          .jump = NAN,
                          .jump_error = NAN,
                          .most_plateau = NAN,
                          .anisotropy = found.excess};
    if (out.kind == PS_CONVERGENCE_WHITE) {
        out.smooth = 1;
        out.smooth_error = 0;
        out.jump = 1;
        out.jump_error = 0;
    } else if (out.kind == PS_CONVERGENCE_FAST || out.kind == PS_CONVERGENCE_SLOW) {
        add_rates(&out, low, ps_convergence_dimension(spectrum));
    }
    return out;
}
